//! A frame drawn in bands, through a scissor or with its origin moved is the same picture to the
//! bit.

use hither::{
    Always, DepthBuffer, Exact, Frame, Hither, I16F16, Plane, Quick, Rect, Tier, Viewport,
};
use host_tests::oracle::{self, Category, GRID, Rng, random_viewport, triangle};
use host_tests::record::{Place, Probe, Record, clip_vertex};

/// A triangle, what clips it, and the screen it is on.
#[derive(Clone, Debug)]
struct Case {
    size: (u32, u32),
    /// `[x, y, z, w]`.
    corners: [[i64; 4]; 3],
    attribute: [i32; 3],
    hither: i64,
    plane: [i64; 4],
}

impl Case {
    fn random(rng: &mut Rng) -> Self {
        let any = random_viewport(rng);
        let viewport = oracle::Viewport::new(any.width.min(70), any.height.min(50));
        let category = rng.choose(&Category::ALL);
        let corners = triangle(category, viewport, rng);
        let far = corners.iter().map(|c| c[2]).max().unwrap_or(1).max(1);
        Self {
            size: (viewport.width, viewport.height),
            corners: corners.map(|[x, y, w]| [x, y, rng.signed(GRID), w]),
            attribute: [(); 3].map(|()| rng.signed(1 << 31).min(i64::from(i32::MAX)) as i32),
            hither: rng.magnitude(far),
            plane: [(); 4].map(|()| rng.signed(1 << 10)),
        }
    }

    fn viewport(&self) -> Viewport {
        Viewport::new(self.size.0, self.size.1).expect("1 to 512")
    }

    /// Column, row, raw attribute and depth of each pixel drawn, in the viewport's pixels and in
    /// order.
    fn draw<T: Tier>(
        &self,
        viewport: Viewport,
        target: (u32, u32),
        origin: (i16, i16),
    ) -> Vec<Pixel> {
        let (width, height) = target;
        let raw = |v: i64| I16F16::from_bits(v as i32);
        let mut words = vec![0u16; (width * height) as usize];
        let depth = DepthBuffer::try_new(&mut words, width, height).expect("a word a pixel");
        let viewport = viewport.with_origin(origin.0, origin.1);
        let mut frame = Frame::with_viewport(Record::new(width, height), viewport)
            .with_tier(T::default())
            .with_planes([Plane::new(self.plane.map(raw))])
            .with_hither(Hither::new(raw(self.hither)).expect("above 0"))
            .with_depth(depth.with_compare(Always))
            .expect("the same size");
        let vertices = [0, 1, 2]
            .map(|i| (clip_vertex(self.corners[i]), [I16F16::from_bits(self.attribute[i])]));
        let _ = frame.draw_triangle(vertices, &Probe);
        let (record, depth) = frame.into_parts();
        let words = depth.words();
        let mut pixels: Vec<_> = record
            .pixels
            .iter()
            .map(|&(x, y, [value])| {
                let place = (x as i32 - i32::from(origin.0), y as i32 - i32::from(origin.1));
                (place.1, place.0, value.to_bits(), words[(y * width + x) as usize])
            })
            .collect();
        pixels.sort_unstable();
        pixels
    }
}

/// Row, column, raw attribute and depth.
type Pixel = (i32, i32, i32, u16);

fn check<T: Tier>(seed: u64, cases: usize) {
    let mut rng = Rng::new(seed);
    let mut drawn = 0;
    for _ in 0..cases {
        let case = Case::random(&mut rng);
        let (width, height) = case.size;
        let whole = case.draw::<T>(case.viewport(), case.size, (0, 0));
        drawn += whole.len();

        let rows = rng.range(1, i64::from(height)) as u32;
        let mut bands = Vec::new();
        for top in (0..height).step_by(rows as usize) {
            bands.extend(case.draw::<T>(case.viewport(), (width, rows), (0, -(top as i16))));
        }
        assert_eq!(bands, whole, "bands of {rows} rows, seed {seed}, {case:?}");

        let mut side = || rng.range(-5, 75) as i32;
        let scissor = Rect { x0: side(), y0: side(), x1: side(), y1: side() };
        let inside = |&(y, x, _, _): &Pixel| {
            (scissor.x0..scissor.x1).contains(&x) && (scissor.y0..scissor.y1).contains(&y)
        };
        let expected: Vec<_> = whole.iter().copied().filter(inside).collect();
        let cut = case.draw::<T>(case.viewport().with_scissor(scissor), case.size, (0, 0));
        // Runs start elsewhere, so their steps round elsewhere: the places are the same, the values
        // nearly.
        let places = |pixels: &[Pixel]| pixels.iter().map(|p| (p.0, p.1)).collect::<Vec<_>>();
        assert_eq!(places(&cut), places(&expected), "{scissor:?}, seed {seed}, {case:?}");

        let origin = (rng.range(0, 9) as i16, rng.range(0, 9) as i16);
        let moved = case.draw::<T>(case.viewport(), (width + 9, height + 9), origin);
        assert_eq!(moved, whole, "{origin:?}, seed {seed}, {case:?}");
    }
    assert!(drawn > 30 * cases, "{drawn} pixels");
}

#[test]
fn exact_tier() {
    check::<Exact>(31, 1500);
}

#[test]
fn quick4() {
    check::<Quick<4>>(32, 1000);
}

#[test]
fn quick8() {
    check::<Quick<8>>(33, 1000);
}

/// The pixel a fragment is told is the viewport's, wherever it is in the target.
#[test]
fn fragments_are_told_the_viewports_pixel() {
    let viewport = Viewport::new(6, 5).expect("1 to 512").with_origin(2, -1);
    let mut frame = Frame::with_viewport(Record::new(9, 3), viewport);
    let all = [[-8, -8, 0, 4], [24, -8, 0, 4], [-8, 24, 0, 4]].map(|v| (clip_vertex(v), []));
    let _ = frame.draw_triangle(all, &Place);
    let pixels = &frame.target().pixels;
    assert_eq!(pixels.len(), 6 * 3);
    for &(x, y, (column, row)) in pixels {
        assert_eq!((x as i32, y as i32), (column + 2, row - 1));
    }
}
