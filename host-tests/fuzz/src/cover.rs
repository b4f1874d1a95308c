//! Coverage of three snapped vertices in 128-bit integers, written apart from the library.

use hither::{Facing, Snapped};

/// Edge functions that are positive inside of the part in front of the eye.
#[derive(Clone, Copy, Debug)]
pub struct Cover {
    edges: [[i128; 3]; 3],
    /// Which way it faces; `None` where it has no area.
    pub facing: Option<Facing>,
}

/// A snapped vertex in pixel space, y down, in any positive scale.
fn in_pixels(snapped: Snapped, (width, height): (u32, u32)) -> [i128; 3] {
    match snapped {
        Snapped::Homogeneous { point, .. } => {
            let [x, y, w] = point.map(i128::from);
            [i128::from(width) * (x + w), i128::from(height) * (w - y), 2 * w]
        }
        Snapped::Projected { point: [x, y], subpixel_bits } => {
            [i128::from(x), i128::from(y), 1 << subpixel_bits]
        }
    }
}

/// The line through two points.
fn line([px, py, pw]: [i128; 3], [qx, qy, qw]: [i128; 3]) -> [i128; 3] {
    [py * qw - pw * qy, pw * qx - px * qw, px * qy - py * qx]
}

impl Cover {
    /// The coverage of a triangle on a viewport of a size.
    #[must_use]
    pub fn new(snapped: [Snapped; 3], size: (u32, u32)) -> Self {
        let [p, q, r] = snapped.map(|snapped| in_pixels(snapped, size));
        let edges = [line(q, r), line(r, p), line(p, q)];
        let determinant = p.iter().zip(edges[0]).map(|(a, b)| a * b).sum::<i128>();
        // y is down: counter-clockwise on the screen is negative.
        let facing = match determinant.signum() {
            0 => None,
            -1 => Some(Facing::Front),
            _ => Some(Facing::Back),
        };
        Self { edges: edges.map(|edge| edge.map(|v| v * determinant.signum())), facing }
    }

    /// Whether the part in front of the eye (`1`) or behind (`-1`) covers a pixel's centre.
    #[must_use]
    pub fn covers(&self, part: i128, x: i64, y: i64) -> bool {
        let (x, y) = (2 * i128::from(x) + 1, 2 * i128::from(y) + 1);
        self.facing.is_some()
            && self.edges.iter().all(|edge| {
                let [a, b, c] = edge.map(|v| v * part);
                let value = a * x + b * y + 2 * c;
                value > 0 || value == 0 && (a > 0 || a == 0 && b > 0)
            })
    }
}
