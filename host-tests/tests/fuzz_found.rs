//! What the fuzz targets found, each as a test of its own.

use hither::{ClipVertex, Frame, Outcome, Target, Viewport};
use host_tests::record::{Mark, Record, clip_vertex};

/// A target that says it is of a size, and holds nothing.
#[derive(Debug)]
struct Vast(u32, u32);

impl Target for Vast {
    type Color = ();

    fn size(&self) -> (u32, u32) {
        (self.0, self.1)
    }

    fn write(&mut self, x: usize, y: usize, colors: impl Iterator<Item = Option<()>>) {
        assert!(y < self.1 as usize && x + colors.count() <= self.0 as usize);
    }
}

/// `setup` and `spans`: a side of about `i32::MAX` less a negative origin overflowed.
#[test]
fn a_target_of_any_size_takes_any_origin() {
    let corners = [[-5, -3], [5, -4], [0, 7]].map(|[x, y]| (clip_vertex([x, y, 0, 5]), []));
    for side in [i32::MAX as u32, i32::MAX as u32 - 1, 1 << 31, u32::MAX, 0x7fff_8000] {
        for origin in [-1, -5, i16::MIN, i16::MAX, 0] {
            for (target, x, y) in [(Vast(side, 8), origin, 0), (Vast(8, side), 0, origin)] {
                let viewport = Viewport::new(8, 8).unwrap().with_origin(x, y);
                let mut frame = Frame::with_viewport(target, viewport);
                let outcome = frame.draw_triangle(corners, &Mark);
                let shown = if origin > -8 { Outcome::Drawn } else { Outcome::OffScreen };
                assert_eq!(outcome, shown, "side {side}, origin {origin}");
            }
        }
    }
}

/// `setup`: a `w` of nearly 2^63 raw, rounded up by its shift, counted as behind the eye.
#[test]
fn a_vertex_of_any_distance_is_in_front() {
    for w in [i64::MAX, i64::MAX - 1194, 1 << 62, (1 << 62) - 1] {
        let corners = [[-w, -w], [w, -w], [0, w]];
        let corners = corners.map(|[x, y]| (ClipVertex::from_wide([x, y, 0, w]), []));
        let mut frame = Frame::new(Record::new(4, 4)).unwrap();
        assert_eq!(frame.draw_triangle(corners, &Mark), Outcome::Drawn, "w = {w}");
    }
}
