//! Spans under clip planes, a hither plane and bands: every pixel at most once, none that the
//! triangle without the plane does not cover, all of them with a plane and its opposite, and bands
//! that make up the same picture.
#![no_main]

use arbitrary::Arbitrary;
use hither::{
    Correction, DepthBuffer, Exact, Frame, Hither, I16F16, Interpolates, NoDepth, Outcome,
    Perspective, PerspectiveEvery, Plane, Quick, Tier,
};
use hither_fuzz::number::{Coefficients, Point, Raw};
use hither_fuzz::place::Place;
use hither_fuzz::target::{Checked, Mark, Probe};
use libfuzzer_sys::fuzz_target;

#[derive(Arbitrary, Debug)]
struct Input {
    place: Place,
    hither: Raw,
    planes: [Coefficients; 2],
    triangles: [[(Point, Raw); 3]; 2],
    bands: u8,
    every: bool,
}

/// A frame without depth.
type Plain<W, T, const P: usize> = Frame<Checked<()>, NoDepth, W, T, Perspective, P>;

/// What the library hands a fragment with one varying.
type Seen = (i32, i32, [I16F16; 1]);

impl Input {
    /// The pixels of one triangle by itself, and what became of it.
    fn draw<W, T, const P: usize>(
        &self,
        mut frame: Plain<W, T, P>,
        triangle: usize,
    ) -> (Vec<bool>, Outcome)
    where
        W: Interpolates<0>,
        T: Tier,
    {
        let (width, height) = self.place.size;
        let corners = self.triangles[triangle].map(|(point, _)| (point.vertex(width, height), []));
        let outcome = frame.draw_triangle(corners, &Mark);
        let written = frame.target_mut().take_written();
        assert!(outcome == Outcome::Drawn || !written.contains(&true), "{outcome:?} but drawn");
        (written, outcome)
    }

    fn frame<T: Tier>(&self) -> Plain<hither::NoHither, T, 0> {
        let target = Checked::new(&self.place);
        Frame::with_viewport(target, self.place.viewport())
            .with_tier(T::default())
            .with_correction(Perspective)
    }
}

/// Whether all of `part` is in `whole`.
fn within(part: &[bool], whole: &[bool]) -> bool {
    part.iter().zip(whole).all(|(part, whole)| !part || *whole)
}

/// A plane and its opposite: together they keep everything, each no more than that.
fn opposites<W, T>(input: &Input, frame: &dyn Fn() -> Plain<W, T, 0>, triangle: usize)
where
    W: Interpolates<0>,
    T: Tier,
{
    let [first, second] = input.planes;
    let [plane, opposite] = first.planes();
    let (whole, _) = input.draw(frame(), triangle);
    let (kept, _) = input.draw(frame().with_planes([plane]), triangle);
    let (dropped, _) = input.draw(frame().with_planes([opposite]), triangle);
    for (whole, (kept, dropped)) in whole.iter().zip(kept.iter().zip(&dropped)) {
        assert_eq!(*whole, *kept || *dropped);
    }
    let (both, _) = input.draw(frame().with_planes([second.planes()[0], plane]), triangle);
    assert!(within(&both, &kept));
    let (other, _) = input.draw(frame().with_planes([second.planes()[0]]), triangle);
    let expected: Vec<bool> = kept.iter().zip(&other).map(|(a, b)| *a && *b).collect();
    assert_eq!(both, expected);
}

/// A frame's pixels and depths after all triangles.
fn picture<T, I>(input: &Input, place: &Place, hither: Hither) -> (Checked<Seen>, Vec<u16>)
where
    T: Tier,
    I: Correction,
{
    let (width, height) = place.target;
    let mut words = vec![u16::MAX; width as usize * height as usize];
    let depth = DepthBuffer::try_new(&mut words, width, height).expect("sides that are not 0");
    let planes: [Plane; 2] = input.planes.map(|plane| plane.planes()[0]);
    let mut frame = Frame::with_viewport(Checked::new(place), place.viewport())
        .with_hither(hither)
        .with_depth(depth)
        .expect("sides of the target")
        .with_tier(T::default())
        .with_correction(I::default())
        .with_planes(planes);
    for triangle in &input.triangles {
        let corners = triangle
            .map(|(point, varying)| (point.vertex(place.size.0, place.size.1), [varying.fixed()]));
        frame.draw_triangle(corners, &Probe);
        frame.target_mut().take_written();
    }
    let (target, _) = frame.into_parts();
    for ((x, y), seen) in place.pixels().zip(&target.pixels) {
        assert!(seen.is_none_or(|(sx, sy, _)| (i64::from(sx), i64::from(sy)) == (x, y)));
    }
    (target, words)
}

/// Bands against the whole: the same to the bit.
fn bands<T: Tier, I: Correction>(input: &Input, hither: Hither) {
    let size = input.place.size;
    let (whole, depths) = picture::<T, I>(input, &Place::whole(size), hither);
    let rows = size.1.div_ceil(1 + u32::from(input.bands % 4));
    for y in (0..size.1).step_by(rows as usize) {
        let (band, band_depths) = picture::<T, I>(input, &Place::band(size, y, rows), hither);
        let last = (y + rows).min(size.1);
        let at = |row: u32| row as usize * size.0 as usize;
        let range = at(y)..at(last);
        assert_eq!(band.pixels[range.clone()], whole.pixels[range.clone()]);
        assert_eq!(band_depths[..range.len()], depths[range]);
    }
}

/// Everything of one tier. What a hither plane keeps is compared only where the snap does not
/// depend on it.
fn tier<T: Tier>(input: &Input, independent: bool) {
    for triangle in 0..2 {
        opposites(input, &|| input.frame::<T>(), triangle);
        opposites(input, &|| input.frame::<T>().with_both_sides(), triangle);
        if let Ok(hither) = Hither::new(input.hither.fixed()) {
            let clipped = || input.frame::<T>().with_hither(hither);
            opposites(input, &clipped, triangle);
            let (kept, _) = input.draw(clipped(), triangle);
            let (whole, _) = input.draw(input.frame::<T>(), triangle);
            assert!(!independent || within(&kept, &whole));
        }
    }
    if let Ok(hither) = Hither::new(input.hither.fixed()) {
        if input.every {
            bands::<T, PerspectiveEvery<8>>(input, hither);
        } else {
            bands::<T, Perspective>(input, hither);
        }
    }
}

fuzz_target!(|input: Input| {
    tier::<Exact>(&input, true);
    tier::<Quick<4>>(&input, false);
    tier::<Quick<8>>(&input, false);
});
