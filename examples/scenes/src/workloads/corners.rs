//! Where the triangles of W1 to W5 are.

use super::{TRIANGLES, W_ONE, Workload};
use hither::{ClipVertex, I16F16};

/// A vertex on a pixel corner.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Corner {
    /// Pixels from the left side.
    pub x: i32,
    /// Pixels from the top.
    pub y: i32,
    /// `z / w`, 0 to 255 of [`DEPTH_ONE`].
    pub depth: i32,
    /// `w`, in hither distances.
    pub w: i32,
}

/// The far plane, in units of [`Corner::depth`].
pub const DEPTH_ONE: i32 = 256;

impl Corner {
    /// The same point of clip space, without rounding: `x = w (2 X - 240)`, `y = w (240 - 2 Y)`, `w` times 240.
    #[must_use]
    pub fn clip(self) -> ClipVertex {
        let whole = |v: i32| I16F16::from_bits(v << 16);
        let x = self.w * (2 * self.x - W_ONE);
        let y = self.w * (W_ONE - 2 * self.y);
        // 16 fraction bits hold 240 w / 256.
        let z = I16F16::from_bits(self.depth * self.w * W_ONE * ((1 << 16) / DEPTH_ONE));
        ClipVertex::new(whole(x), whole(y), z, whole(self.w * W_ONE))
    }
}

/// W1's triangle.
const LARGE: [(i32, i32); 3] = [(10, 10), (230, 40), (100, 230)];

/// Its depths: near, middle and far.
const DEPTHS: [i32; 3] = [32, 128, 224];

/// W5's `w` at the three corners.
const SLANTED: [i32; 3] = [1, 3, 8];

/// The linear congruential generator of the workloads.
struct Random(u32);

impl Random {
    /// A number from `low` to `high`.
    fn range(&mut self, low: i32, high: i32) -> i32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        low + ((self.0 >> 8) % (high - low + 1).unsigned_abs()) as i32
    }
}

/// Small triangles at random places.
struct Small {
    random: Random,
    depths: Random,
    /// Vertices are at most this far from the centre along each axis, in pixels.
    reach: i32,
    /// Least and largest doubled area, in square pixels.
    area: [i32; 2],
}

impl Small {
    /// The next one, clockwise on the screen.
    fn next(&mut self) -> [Corner; 3] {
        let random = &mut self.random;
        let centre = (random.range(20, 219), random.range(20, 219));
        let [least, most] = self.area;
        // Ends as a fair share of all triangles has the area.
        let corners = loop {
            let corners = [(); 3].map(|()| {
                let x = centre.0 + random.range(-self.reach, self.reach);
                (x, centre.1 + random.range(-self.reach, self.reach))
            });
            let [(ax, ay), (bx, by), (cx, cy)] = corners;
            let doubled = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
            if doubled.abs() >= least && doubled.abs() <= most {
                let [a, b, c] = corners;
                break if doubled < 0 { [a, c, b] } else { corners };
            }
        };
        corners.map(|(x, y)| Corner { x, y, depth: self.depths.range(0, DEPTH_ONE - 1), w: 1 })
    }
}

/// Calls `each` with the triangles of W1 to W5, one after the other, numbered from 0; each counter-clockwise in
/// normalized device coordinates. W6 and `snap` have none here.
///
/// W2's and W3's are drawn at random: a centre, then vertices around it until the area is in range. Their depths come
/// from a generator of their own, so that the places are the same with and without.
pub fn corners(workload: Workload, mut each: impl FnMut(usize, [Corner; 3])) {
    let (reach, area, seed) = match workload {
        Workload::W1 | Workload::W1z | Workload::W4 => return each(0, large([1; 3])),
        Workload::W5 => return each(0, large(SLANTED)),
        Workload::W2 | Workload::W2z => (10, [90, 110], 1),
        Workload::W3 | Workload::W3z => (3, [6, 10], 7),
        Workload::W6f | Workload::W6g | Workload::Snap => return,
    };
    let mut small = Small { random: Random(seed), depths: Random(3), reach, area };
    for number in 0..TRIANGLES {
        let [a, b, c] = small.next();
        each(number, [a, c, b]);
    }
}

/// W1's triangle with these `w`, counter-clockwise: first corner, third, second.
fn large(ws: [i32; 3]) -> [Corner; 3] {
    let corner = |i: usize| Corner { x: LARGE[i].0, y: LARGE[i].1, depth: DEPTHS[i], w: ws[i] };
    [corner(0), corner(2), corner(1)]
}
