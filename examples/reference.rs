//! A reference renderer in `f64`, independent of hither: what a picture should be, to measure pictures against.
//!
//! It is slow and plain. Triangles are rasterized homogeneously by edge functions evaluated at every pixel centre, with
//! no snapping, no incremental steps and no clipping: a vertex may have any `w`. The conventions are hither's: NDC in
//! -1 to 1 with `y` up, pixel row 0 on top, depth `z/w` 0 near and 1 far, front faces counter-clockwise in NDC,
//! top-left fill rule.

use std::fmt;

use crate::rgb565;

/// A vertex in clip space, with what is interpolated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Clip-space `x`, `y`, `z`, `w`.
    pub clip: [f64; 4],
    /// Values that vary linearly over the triangle in space (perspective-correct on the screen), in any units.
    pub varyings: [f64; 3],
}

/// Which triangles are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cull {
    /// Both facings.
    None,
    /// Only front faces: counter-clockwise in NDC.
    Back,
}

/// A picture of `f64` colours with a depth buffer.
#[derive(Clone, Debug, PartialEq)]
pub struct Canvas {
    /// Width and height in pixels.
    size: [usize; 2],
    /// The smallest `w` that is drawn.
    hither: f64,
    colors: Vec<[f64; 3]>,
    depths: Vec<f64>,
}

impl Canvas {
    /// A canvas of `width` by `height` pixels in one colour, at depth 1 (the farthest) everywhere.
    ///
    /// Pixels whose interpolated `w` is below `hither` are discarded. `background` is red, green and blue, from 0 to 1.
    #[must_use]
    pub fn new(width: usize, height: usize, hither: f64, background: [f64; 3]) -> Self {
        Self {
            size: [width, height],
            hither,
            colors: vec![background; width * height],
            depths: vec![1.0; width * height],
        }
    }

    /// Draws triangles in order; returns how many times a pixel was written.
    ///
    /// A pixel is written where its depth `z/w`, clamped to 0 and 1, is less than what the canvas has there. `shade`
    /// makes of the interpolated varyings red, green and blue, from 0 to 1, proportional to the display's values.
    pub fn draw(
        &mut self,
        triangles: &[[Vertex; 3]],
        cull: Cull,
        shade: impl Fn([f64; 3]) -> [f64; 3],
    ) -> usize {
        triangles
            .iter()
            .filter_map(|triangle| Setup::new(triangle, cull))
            .map(|setup| self.fill(&setup, &shade))
            .sum()
    }

    /// Draws one triangle; returns how many pixels were written.
    fn fill(&mut self, setup: &Setup, shade: &impl Fn([f64; 3]) -> [f64; 3]) -> usize {
        let [width, height] = self.size;
        let [columns, rows] = setup.pixel_box(self.size);
        let mut written = 0;
        for row in rows {
            let y = 1.0 - (2 * row + 1) as f64 / height as f64;
            for column in columns.clone() {
                let x = (2 * column + 1) as f64 / width as f64 - 1.0;
                let Some(fragment) = setup.at([x, y, 1.0]) else {
                    continue;
                };
                let depth = fragment.depth.clamp(0.0, 1.0);
                let pixel = row * width + column;
                // `1/w` is above `1/hither` where `w` is below `hither`; without a division, for a `hither` of 0.
                if fragment.inverse_w * self.hither <= 1.0 && depth < self.depths[pixel] {
                    self.depths[pixel] = depth;
                    self.colors[pixel] = shade(fragment.varyings);
                    written += 1;
                }
            }
        }
        written
    }

    /// Red, green and blue of every pixel as shaded, row after row from the top.
    #[must_use]
    pub fn colors(&self) -> &[[f64; 3]] {
        &self.colors
    }

    /// Depth of every pixel, 0 near to 1 far, row after row from the top.
    #[must_use]
    pub fn depths(&self) -> &[f64] {
        &self.depths
    }

    /// The picture in RGB565 words of native byte order, each channel rounded to nearest
    /// (see [`rgb565::pack_unit`]).
    #[must_use]
    pub fn to_rgb565(&self) -> Vec<u16> {
        self.colors.iter().copied().map(rgb565::pack_unit).collect()
    }
}

/// What a triangle is at one pixel.
struct Fragment {
    inverse_w: f64,
    /// `z/w`.
    depth: f64,
    varyings: [f64; 3],
}

/// A triangle that can be evaluated anywhere on the screen.
struct Setup<'a> {
    vertices: &'a [Vertex; 3],
    /// Row `i` is the cross product of the two other vertices' `(x, y, w)`: at a point `(x, y, 1)` of NDC it is the
    /// barycentric coordinate of vertex `i`, times `determinant / w`.
    edges: [[f64; 3]; 3],
    /// Of the vertices' `(x, y, w)`; positive for a front face.
    determinant: f64,
}

impl<'a> Setup<'a> {
    /// `None` for a triangle that is seen edge-on, is not finite, or is culled.
    fn new(vertices: &'a [Vertex; 3], cull: Cull) -> Option<Self> {
        let [a, b, c] = vertices.map(|Vertex { clip: [x, y, _, w], .. }| [x, y, w]);
        let edges = [cross(b, c), cross(c, a), cross(a, b)];
        let determinant = dot(a, edges[0]);
        let is_drawn = determinant > 0.0 || (determinant < 0.0 && cull == Cull::None);
        (is_drawn && determinant.is_finite()).then_some(Self { vertices, edges, determinant })
    }

    /// The columns and rows outside which no pixel is covered: everything, unless the whole triangle is before the eye.
    fn pixel_box(&self, size: [usize; 2]) -> [std::ops::Range<usize>; 2] {
        if self.vertices.iter().any(|v| v.clip[3] <= 0.0) {
            return size.map(|side| 0..side);
        }
        // In pixels from the left and from the top; casts saturate at 0, and one pixel is added for rounding.
        let range = |side: usize, coordinate: &dyn Fn(&Vertex) -> f64| {
            let pixels = self.vertices.each_ref().map(|v| {
                let ndc = coordinate(v) / v.clip[3];
                (ndc + 1.0) / 2.0 * side as f64
            });
            let low = pixels.into_iter().fold(f64::INFINITY, f64::min) - 1.0;
            let high = pixels.into_iter().fold(f64::NEG_INFINITY, f64::max) + 1.0;
            (low as usize).min(side)..(high.ceil() as usize).min(side)
        };
        [range(size[0], &|v| v.clip[0]), range(size[1], &|v| -v.clip[1])]
    }

    /// The fragment at a point `(x, y, 1)` of NDC, if the triangle covers it before the eye.
    fn at(&self, point: [f64; 3]) -> Option<Fragment> {
        let values = self.edges.map(|edge| dot(edge, point));
        let sign = self.determinant.signum();
        let is_inside = self.edges.iter().zip(values).all(|(&[a, b, _], value)| {
            // NDC has y up: a top edge has the inside below it, where y is less.
            let is_top_left = sign * a > 0.0 || (a == 0.0 && sign * b < 0.0);
            sign * value > 0.0 || (value == 0.0 && is_top_left)
        });
        let inverse_w = values.iter().sum::<f64>() / self.determinant;
        if !is_inside || inverse_w <= 0.0 {
            return None;
        }
        let [a, b, c] = self.vertices;
        let over_w = |at_vertices| dot(at_vertices, values) / self.determinant;
        Some(Fragment {
            inverse_w,
            depth: over_w([a.clip[2], b.clip[2], c.clip[2]]),
            varyings: [0, 1, 2]
                .map(|i| over_w([a.varyings[i], b.varyings[i], c.varyings[i]]) / inverse_w),
        })
    }
}

fn dot([ax, ay, az]: [f64; 3], [bx, by, bz]: [f64; 3]) -> f64 {
    ax * bx + ay * by + az * bz
}

/// The cross product; swapped operands give the exact negative, so that a shared edge decides alike on both sides.
fn cross([ax, ay, az]: [f64; 3], [bx, by, bz]: [f64; 3]) -> [f64; 3] {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

/// How far two RGB565 pictures are from each other, as a display shows them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Pixels compared.
    pub pixels: usize,
    /// Pixels whose words differ.
    pub differing: usize,
    /// The largest difference of a channel, in steps of 1/255 after expansion to 8 bits.
    pub largest: u8,
    /// The mean difference over all channels of all pixels, in steps of 1/255 after expansion to 8 bits.
    pub mean: f64,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} of {} pixels differ, by at most {} and {:.4} in the mean (steps of 1/255)",
            self.differing, self.pixels, self.largest, self.mean
        )
    }
}

/// Compares two pictures of RGB565 words (native byte order) pixel by pixel.
///
/// # Panics
///
/// If they have different numbers of pixels.
#[must_use]
pub fn compare(ours: &[u16], reference: &[u16]) -> Difference {
    assert_eq!(ours.len(), reference.len(), "pictures of different sizes cannot be compared");
    let mut differing = 0;
    let mut largest = 0;
    let mut sum = 0_u64;
    for (&a, &b) in ours.iter().zip(reference) {
        differing += usize::from(a != b);
        for (a, b) in rgb565::expand(a).into_iter().zip(rgb565::expand(b)) {
            largest = largest.max(a.abs_diff(b));
            sum += u64::from(a.abs_diff(b));
        }
    }
    Difference {
        pixels: ours.len(),
        differing,
        largest,
        // No pixels, no difference.
        mean: sum as f64 / (3 * ours.len()).max(1) as f64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: [f64; 3] = [1.0, 0.0, 0.0];
    const BLACK: [f64; 3] = [0.0; 3];

    /// A vertex at a place of NDC, with one varying.
    fn vertex([x, y, z]: [f64; 3], w: f64, varying: f64) -> Vertex {
        Vertex { clip: [x * w, y * w, z * w, w], varyings: [varying, 0.0, 0.0] }
    }

    /// A triangle in NDC at one depth, in one colour of red.
    fn flat(corners: [[f64; 2]; 3], z: f64, red: f64) -> [Vertex; 3] {
        corners.map(|[x, y]| vertex([x, y, z], 1.0, red))
    }

    /// Rows of text: what is not black is `#`.
    fn rows(canvas: &Canvas) -> Vec<String> {
        let mark = |&c: &[f64; 3]| if c == BLACK { ' ' } else { '#' };
        canvas.colors.chunks(canvas.size[0]).map(|row| row.iter().map(mark).collect()).collect()
    }

    #[test]
    fn a_known_triangle() {
        let mut canvas = Canvas::new(8, 8, 0.5, BLACK);
        // The left edge goes through pixel centres and is in, the diagonal as well and is out.
        let triangle = flat([[-0.875, -0.875], [0.875, -0.875], [-0.875, 0.875]], 0.5, 1.0);
        let written = canvas.draw(&[triangle], Cull::Back, |_| RED);
        assert_eq!(
            rows(&canvas),
            [
                "        ", "#       ", "##      ", "###     ", "####    ", "#####   ", "######  ",
                "        ",
            ]
        );
        assert_eq!(written, 21);
        assert_eq!(canvas.depths()[8], 0.5);
        assert_eq!(canvas.depths()[0], 1.0);
    }

    #[test]
    fn perspective_in_the_middle_of_an_edge_drawn_once() {
        let near = vertex([-1.0, -1.0, 0.0], 1.0, 0.0);
        let far = vertex([1.0, 1.0, 0.6], 3.0, 1.0);
        let left = vertex([-1.0, 1.0, 0.0], 1.0, 0.0);
        let right = vertex([1.0, -1.0, 0.0], 1.0, 0.0);
        let mut canvas = Canvas::new(1, 1, 0.5, BLACK);
        let written = canvas.draw(&[[near, far, left], [near, right, far]], Cull::Back, |v| v);
        assert_eq!(written, 1);
        // (0/1 + 1/3) / (1/1 + 1/3), and z/w is linear on the screen.
        assert!((canvas.colors()[0][0] - 0.25).abs() < 1e-15);
        assert!((canvas.depths()[0] - 0.3).abs() < 1e-15);
    }

    #[test]
    fn the_nearer_wins_in_any_order() {
        let everywhere = [[-3.0, -3.0], [9.0, -3.0], [-3.0, 9.0]];
        let near = flat(everywhere, 0.25, 0.25);
        let far = flat(everywhere, 0.75, 0.75);
        for order in [[near, far], [far, near]] {
            let mut canvas = Canvas::new(3, 2, 0.5, BLACK);
            canvas.draw(&order, Cull::Back, |v| v);
            assert!(canvas.colors().iter().all(|c| (c[0] - 0.25).abs() < 1e-15));
        }
        // Equal depth: the first stays. At or behind the far end: nothing is drawn.
        let mut canvas = Canvas::new(3, 2, 0.5, BLACK);
        assert_eq!(canvas.draw(&[near, near], Cull::Back, |v| v), 6);
        let behind = flat(everywhere, 1.0, 1.0);
        assert_eq!(Canvas::new(3, 2, 0.5, BLACK).draw(&[behind], Cull::Back, |v| v), 0);
    }

    #[test]
    fn back_faces_are_culled_on_request() {
        let mut back = flat([[-3.0, -3.0], [9.0, -3.0], [-3.0, 9.0]], 0.5, 1.0);
        back.swap(0, 1);
        let mut canvas = Canvas::new(4, 4, 0.5, BLACK);
        assert_eq!(canvas.draw(&[back], Cull::Back, |v| v), 0);
        assert_eq!(canvas.draw(&[back], Cull::None, |v| v), 16);
    }

    #[test]
    fn a_ground_through_the_eye_ends_at_the_horizon_and_at_the_hither_plane() {
        // A plane one unit below the eye, which looks along -z with 90 degrees: clip x, y, w = x, -1, -z.
        let at =
            |x: f64, z: f64| Vertex { clip: [x, -1.0, -z * 0.5, -z], varyings: [-z, 0.0, 0.0] };
        let far = 1e6;
        let ground = [
            [at(-far, far), at(far, far), at(far, -far)],
            [at(-far, far), at(far, -far), at(-far, -far)],
        ];
        let mut canvas = Canvas::new(6, 16, 1.5, BLACK);
        canvas.draw(&ground, Cull::Back, |v| v);
        for (pixel, color) in canvas.colors().iter().enumerate() {
            // The ground's w at a row is 1 over how far the row is below the middle.
            let w = -1.0 / (1.0 - (2.0 * (pixel / 6) as f64 + 1.0) / 16.0);
            let expected = if w >= 1.5 { w } else { 0.0 };
            assert!((color[0] - expected).abs() < 1e-6, "{pixel}: {color:?} {expected}");
        }
    }

    #[test]
    fn a_fan_covers_every_pixel_once() {
        // The middle on a pixel centre, and off it.
        for middle in [[1.0 / 9.0, 1.0 / 9.0], [0.123, -0.321]] {
            let ring =
                [[-5.0, -5.0], [0.3, -7.0], [5.0, -5.0], [7.0, 0.1], [5.0, 5.0], [-5.0, 5.0]];
            let fan: Vec<_> =
                (0..6).map(|i| flat([middle, ring[i], ring[(i + 1) % 6]], 0.5, 1.0)).collect();
            let once = fan
                .iter()
                .map(|&t| Canvas::new(9, 9, 0.5, BLACK).draw(&[t], Cull::Back, |v| v))
                .sum::<usize>();
            let together = Canvas::new(9, 9, 0.5, BLACK).draw(&fan, Cull::Back, |v| v);
            assert_eq!((once, together), (81, 81), "{middle:?}");
        }
    }

    #[test]
    fn what_is_not_a_number_draws_nothing() {
        let mut canvas = Canvas::new(4, 4, 0.5, BLACK);
        for bad in [f64::NAN, f64::INFINITY] {
            let triangle = flat([[-1.0, -1.0], [bad, -1.0], [-1.0, 1.0]], 0.5, 1.0);
            assert_eq!(canvas.draw(&[triangle], Cull::None, |v| v), 0);
        }
        let line = flat([[-1.0, -1.0], [0.0, 0.0], [1.0, 1.0]], 0.5, 1.0);
        assert_eq!(canvas.draw(&[line], Cull::None, |v| v), 0);
    }

    #[test]
    fn differences_are_counted_in_8_bit_steps() {
        // Red 31 and 30 expand to 255 and 247, green 0 and 1 to 0 and 4.
        let ours = [0xffff, 0xf800, 0x0000, 0x1234];
        let reference = [0xffff, 0xf000, 0x0020, 0x1234];
        let difference = compare(&ours, &reference);
        assert_eq!((difference.pixels, difference.differing), (4, 2));
        assert_eq!(difference.largest, 8);
        assert!((difference.mean - 1.0).abs() < 1e-15);
        assert_eq!(
            difference.to_string(),
            "2 of 4 pixels differ, by at most 8 and 1.0000 in the mean (steps of 1/255)"
        );
        assert_eq!(compare(&[], &[]).mean, 0.0);
    }

    #[test]
    fn a_canvas_quantizes_to_nearest() {
        let canvas = Canvas::new(2, 1, 0.5, [0.5, 0.5, 1.5 / 31.0]);
        // 15.5 and 31.5 round up, as does 1.5.
        assert_eq!(canvas.to_rgb565(), [16 << 11 | 32 << 5 | 2; 2]);
    }
}
