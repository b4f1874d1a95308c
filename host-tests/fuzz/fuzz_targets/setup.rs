//! Snap and setup, in every tier, in front of the eye and on both sides: what is drawn is what the
//! snapped vertices cover, on any part of any viewport.
#![no_main]

use arbitrary::Arbitrary;
use hither::{
    ClipVertex, Cull, Exact, Facing, Fidelity, Frame, Hither, I16F16, Interpolates, NoDepth,
    Outcome, Perspective, Quick, Tier, Vertex, Viewport,
};
use hither_fuzz::cover::Cover;
use hither_fuzz::number::{Point, Raw};
use hither_fuzz::place::Place;
use hither_fuzz::target::{Checked, Mark};
use libfuzzer_sys::fuzz_target;

#[derive(Arbitrary, Debug)]
struct Input {
    place: Place,
    /// A size that is not necessarily one.
    sides: (u32, u32),
    cull: u8,
    hither: Raw,
    triangles: [[Point; 3]; 2],
    /// A viewport that the second triangle's vertices are taken from, against the documentation.
    other: Place,
}

impl Input {
    fn cull(&self) -> Cull {
        match self.cull % 4 {
            0 => Cull::Front,
            1 => Cull::Back,
            _ => Cull::Neither,
        }
    }

    fn corners(&self, triangle: usize) -> [ClipVertex; 3] {
        let (width, height) = self.place.size;
        self.triangles[triangle].map(|point| point.vertex(width, height))
    }

    fn frame(&self) -> Plain<hither::NoHither, Exact> {
        let target = Checked::new(&self.place);
        Frame::with_viewport(target, self.place.viewport())
            .with_cull(self.cull())
            .with_preset(Fidelity)
    }

    fn hides(&self, facing: Facing) -> bool {
        let hidden = (self.cull(), facing);
        matches!(hidden, (Cull::Front, Facing::Front) | (Cull::Back, Facing::Back))
    }
}

/// A frame without depth.
type Plain<W, T> = Frame<Checked<()>, NoDepth, W, T, Perspective, 0>;

/// Draws a triangle both ways, and says what was written and what became of it.
fn draw<W, T>(frame: &mut Plain<W, T>, vertices: &[Vertex<T>; 3]) -> (Vec<bool>, Outcome)
where
    W: Interpolates<0>,
    T: Tier,
{
    let [a, b, c] = vertices;
    let outcome = frame.draw_snapped([a, b, c], &Mark);
    let written = frame.target_mut().take_written();
    let drawn = matches!(outcome, Outcome::Drawn);
    assert!(drawn || !written.contains(&true), "{outcome:?} but drawn");
    (written, outcome)
}

/// A triangle without a hither plane against its coverage.
fn exact<W, T>(input: &Input, mut frame: Plain<W, T>, parts: &[i128])
where
    W: Interpolates<0>,
    T: Tier,
{
    for triangle in 0..2 {
        let corners = input.corners(triangle);
        let vertices = corners.map(|corner| frame.snap(&corner, []));
        let (written, outcome) = draw(&mut frame, &vertices);
        let again = frame.draw_triangle(corners.map(|corner| (corner, [])), &Mark);
        assert_eq!((&written, outcome), (&frame.target_mut().take_written(), again));
        let cover = Cover::new(vertices.map(|v| v.snapped()), input.place.size);
        let hidden = cover.facing.is_some_and(|facing| input.hides(facing));
        match outcome {
            Outcome::ZeroArea => assert_eq!(cover.facing, None),
            Outcome::Culled => assert!(hidden),
            Outcome::Drawn => assert!(cover.facing.is_some() && !hidden),
            _ => {}
        }
        let [columns, rows] = input.place.shown();
        // All pixels, or some thousands of a large viewport.
        let every = 1 + written.len() / 4096;
        for ((x, y), written) in input.place.pixels().zip(written).step_by(every) {
            let covered = parts.iter().any(|&part| cover.covers(part, x, y));
            let shown = covered && !hidden && columns.contains(&x) && rows.contains(&y);
            assert_eq!(written, shown, "pixel {x} {y}: {cover:?} {outcome:?}");
        }
    }
}

/// Whatever a frame is given, it stays within its pixels.
fn inside<W, T>(mut frame: Plain<W, T>, strangers: &[Vertex<T>; 3])
where
    W: Interpolates<0>,
    T: Tier,
{
    draw(&mut frame, strangers);
    let [a, b, _] = strangers;
    draw(&mut frame, &[*a, *b, Vertex::EMPTY]);
}

fn tier<T: Tier>(input: &Input) {
    exact(input, input.frame().with_tier(T::default()), &[1]);
    exact(input, input.frame().with_tier(T::default()).with_both_sides(), &[1, -1]);
    let other = Frame::with_viewport(Checked::<()>::new(&input.other), input.other.viewport());
    let other = other.with_tier(T::default());
    let strangers = input.corners(1).map(|corner| other.snap(&corner, []));
    inside(input.frame().with_tier(T::default()), &strangers);
    inside(input.frame().with_tier(T::default()).with_both_sides(), &strangers);
    match Hither::new(input.hither.fixed()) {
        Ok(hither) => {
            let frame = || input.frame().with_tier(T::default()).with_hither(hither);
            let own = input.corners(0).map(|corner| frame().snap(&corner, []));
            inside(frame(), &own);
            inside(frame(), &strangers);
        }
        Err(_) => assert!(input.hither.fixed() <= I16F16::ZERO),
    }
}

fuzz_target!(|input: Input| {
    let (width, height) = input.sides;
    let sides = [width, height].iter().all(|side| (1..=512).contains(side));
    assert_eq!(Viewport::new(width, height).is_ok(), sides);
    tier::<Exact>(&input);
    tier::<Quick<4>>(&input);
    tier::<Quick<8>>(&input);
});
