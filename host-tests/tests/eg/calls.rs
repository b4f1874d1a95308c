//! Whole spans, and the first error.

use crate::display::{Call, Panel};
use crate::triangles::{draw, hither};
use embedded_graphics::pixelcolor;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use hither::{
    ClipVertex, DepthBuffer, Exact, Flat, Frame, Gouraud, I16F16, OnDisplay, Outcome, Quick,
    Rgb565, Rgb888, Target, Tier,
};
use host_tests::oracle::Rng;
use host_tests::record::Record;

const AREA: Rectangle = Rectangle::new(Point::new(-11, 6), Size::new(150, 90));

fn panel() -> Panel<pixelcolor::Rgb565> {
    Panel::new(AREA)
}

/// A triangle anywhere, flat on the screen.
fn flat(rng: &mut Rng) -> [(ClipVertex, [I16F16; 0]); 3] {
    [(); 3].map(|()| {
        let [x, y] = [(); 2].map(|()| I16F16::from_num(rng.between(-1.5, 1.5)));
        (ClipVertex::new(x, y, I16F16::ZERO, I16F16::ONE), [])
    })
}

/// The runs of pixels that are side by side, in order.
fn runs<C>(record: &Record<C>) -> Vec<Rectangle> {
    let mut runs: Vec<Rectangle> = Vec::new();
    for &(x, y, _) in &record.pixels {
        let place = AREA.top_left + Point::new(x as i32, y as i32);
        match runs.last_mut() {
            Some(run) if run.top_left + run.size.x_axis() == place => run.size.width += 1,
            _ => runs.push(Rectangle::new(place, Size::new(1, 1))),
        }
    }
    runs
}

fn a_row_is_one_fill<T: Tier>(seed: u64) {
    let mut rng = Rng::new(seed);
    let mut filled = 0;
    for _ in 0..400 {
        let corners = flat(&mut rng);
        let mut panel = panel();
        let mut frame =
            Frame::new(OnDisplay::new(&mut panel)).expect("1 to 512").with_tier(T::default());
        let outcome = frame.draw_triangle(corners, &Flat(Rgb565::RED));
        assert_eq!(frame.finish(), Ok(()));

        let record = Record::new(AREA.size.width, AREA.size.height);
        let mut frame = Frame::new(record).expect("1 to 512").with_tier(T::default());
        assert_eq!(frame.draw_triangle(corners, &Flat(())), outcome);
        let expected = runs(frame.target());
        let mut rows: Vec<_> = expected.iter().map(|run| run.top_left.y).collect();
        rows.dedup();
        assert_eq!(rows.len(), expected.len(), "a row is one run");
        let expected: Vec<_> =
            expected.into_iter().map(|area| Call { solid: true, area }).collect();
        assert_eq!(panel.calls, expected, "seed {seed}, {corners:?}");
        filled += expected.len();
    }
    assert!(filled > 4000, "{filled} rows");
}

#[test]
fn a_row_of_a_flat_triangle_is_one_fill() {
    a_row_is_one_fill::<Exact>(31);
    a_row_is_one_fill::<Quick<4>>(32);
    a_row_is_one_fill::<Quick<8>>(33);
}

/// Varyings are drawn in blocks of a few pixels, and depth leaves pixels out: the calls are the longest runs there are, cut
/// where there are more than 64 colours.
#[test]
fn runs_are_as_long_as_they_can_be() {
    for seed in 40..60 {
        let mut panel = Panel::<pixelcolor::Rgb888>::new(AREA);
        let frame = Frame::new(OnDisplay::new(&mut panel)).expect("1 to 512");
        let (width, height) = (AREA.size.width, AREA.size.height);
        let pixels = (width * height) as usize;
        let mut words = vec![u16::MAX; pixels];
        let depth = DepthBuffer::try_new(&mut words, width, height).expect("a word a pixel");
        let mut frame = frame.with_hither(hither()).with_depth(depth).expect("of one size");
        let _ = draw(&mut frame, &Gouraud, seed);
        assert_eq!(frame.finish(), Ok(()));

        let mut words = vec![u16::MAX; pixels];
        let depth = DepthBuffer::try_new(&mut words, width, height).expect("a word a pixel");
        let frame = Frame::new(Record::<Rgb888>::new(width, height)).expect("1 to 512");
        let mut frame = frame.with_hither(hither()).with_depth(depth).expect("of one size");
        let _ = draw(&mut frame, &Gouraud, seed);
        let runs = runs(frame.target());
        assert!(runs.len() > 100, "seed {seed}: {} runs", runs.len());

        // Each run is one call, but where it is longer.
        let mut calls = panel.calls.iter();
        for run in runs {
            let mut length = 0;
            let mut pieces = 0;
            while length < run.size.width {
                let call = calls.next().expect("another call");
                assert_eq!(call.area.top_left, run.top_left + Point::new(length as i32, 0));
                assert!(call.solid || call.area.size.width <= 64, "{call:?}");
                length += call.area.size.width;
                pieces += 1;
            }
            assert_eq!(length, run.size.width);
            // A piece of one colour ends where another begins.
            assert!(pieces == 1 || run.size.width > 64, "{pieces} calls for {run:?}");
        }
        assert!(calls.next().is_none());
    }
}

#[test]
fn the_first_error_comes_out_and_nothing_is_drawn_after_it() {
    let draw_on = |panel: &mut Panel<pixelcolor::Rgb565>| {
        let frame = Frame::new(OnDisplay::new(panel)).expect("1 to 512");
        let mut frame = frame.with_hither(hither());
        frame.clear(Rgb565::BLACK);
        let _ = draw(&mut frame, &Gouraud, 61);
        let _ = draw(&mut frame, &Flat(Rgb565::WHITE), 62);
        frame.finish()
    };
    let mut whole = panel();
    assert_eq!(draw_on(&mut whole), Ok(()));
    let calls = whole.calls.len();
    assert!(calls > 200, "{calls}");
    for works in [0, 1, 2, 3, 50, calls / 2, calls - 2, calls - 1] {
        let mut failing = panel();
        failing.works = works;
        assert_eq!(draw_on(&mut failing), Err(works));
        // The one that failed was the last.
        assert_eq!(failing.calls, whole.calls[..=works]);
    }
    let mut enough = panel();
    enough.works = calls;
    assert_eq!(draw_on(&mut enough), Ok(()));
}

/// What waits is drawn, finished or not.
#[test]
fn a_target_that_is_dropped_draws_its_last_run() {
    let mut panel = panel();
    let mut target = OnDisplay::new(&mut panel);
    target.write(3, 4, [Some(Rgb565::RED), None, Some(Rgb565::RED)].into_iter());
    target.write(6, 4, [Some(Rgb565::RED), Some(Rgb565::BLUE)].into_iter());
    drop(target);
    let row = |x, width| Rectangle::new(AREA.top_left + Point::new(x, 4), Size::new(width, 1));
    assert_eq!(
        panel.calls,
        [Call { solid: true, area: row(3, 1) }, Call { solid: false, area: row(5, 3) },]
    );
}

/// What waits is drawn before what is filled after it, and not over what is cleared after it.
#[test]
fn drawing_keeps_its_order() {
    let mut panel = panel();
    let mut target = OnDisplay::new(&mut panel);
    target.write(3, 4, [Some(Rgb565::RED); 2].into_iter());
    target.fill(2, 4, 9, Rgb565::BLUE);
    target.write(5, 4, [Some(Rgb565::RED)].into_iter());
    target.clear(Rgb565::GREEN);
    target.write(6, 4, [Some(Rgb565::RED)].into_iter());
    assert_eq!(target.finish(), Ok(()));
    let row = |x, width| Rectangle::new(AREA.top_left + Point::new(x, 4), Size::new(width, 1));
    let areas: Vec<_> = panel.calls.iter().map(|call| call.area).collect();
    assert_eq!(areas, [row(3, 2), row(2, 9), AREA, row(6, 1)]);
}

/// The first pixel of a row is not beside the last one of the row before.
#[test]
fn runs_end_with_their_row() {
    let mut panel = panel();
    let mut target = OnDisplay::new(&mut panel);
    let last = AREA.size.width as usize - 1;
    target.write(last, 0, [Some(Rgb565::RED)].into_iter());
    target.write(0, 1, [Some(Rgb565::RED)].into_iter());
    assert_eq!(target.finish(), Ok(()));
    assert_eq!(panel.calls.len(), 2);
}

/// A triangle that covers no pixel asks the display for nothing.
#[test]
fn nothing_is_asked_for_where_nothing_is_covered() {
    let mut panel = panel();
    let mut frame = Frame::new(OnDisplay::new(&mut panel)).expect("1 to 512");
    let corner = |x: i32| {
        (ClipVertex::new(I16F16::from_num(x), I16F16::ZERO, I16F16::ZERO, I16F16::ONE), [])
    };
    assert_eq!(frame.draw_triangle([2, 3, 4].map(corner), &Flat(Rgb565::RED)), Outcome::OffScreen);
    assert_eq!(frame.finish(), Ok(()));
    assert_eq!(panel.calls, []);
}
