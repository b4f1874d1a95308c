//! An edge that moves one way in steps of 2^-20: each pixel changes once, or never.

use hither::{Frame, NoDepth, NoHither, Perspective, Tier};
use host_tests::oracle::{GRID, Vertex, Viewport};
use host_tests::record::{Mark, Record, clip_vertex, frame};

use super::Named;

/// Rows in which a side moves by 4096 steps a pixel, where `w` is 2^20.
const WIDE: Viewport = Viewport::new(512, 6);

/// Columns of the same.
const HIGH: Viewport = Viewport::new(6, 512);

/// More than two pixels.
const STEPS: i64 = 2 * 4096 + 1500;

/// The pixels that some triangles cover together, at every step; how many changed.
fn sweep<T: Tier>(viewport: Viewport, triangles: impl Fn(i64) -> Vec<[Vertex; 3]>) -> usize {
    let mut frame: Frame<Record<()>, NoDepth, NoHither, T, Perspective> =
        frame(viewport).with_tier(T::default());
    let mut before: Option<Vec<u8>> = None;
    let mut changes = vec![0; (viewport.width * viewport.height) as usize];
    for step in 0..=STEPS {
        let triangles = triangles(step);
        for corners in &triangles {
            let vertices = corners.map(|[x, y, w]| (clip_vertex([x, y, 0, w]), []));
            let _ = frame.draw_triangle(vertices, &Mark);
        }
        let now = frame.target_mut().take_counts();
        assert!(now.iter().all(|&count| count <= 1), "a pixel is drawn twice by {triangles:?}");
        for (change, (before, now)) in changes.iter_mut().zip(before.iter().flatten().zip(&now)) {
            *change += u32::from(before != now);
        }
        if let Some(at) = changes.iter().position(|&change| change > 1) {
            panic!("pixel {at} of {viewport:?} changes again at step {step}: {triangles:?}");
        }
        before = Some(now);
    }
    changes.iter().filter(|&&change| change == 1).count()
}

/// The right side of a square moves to the right; `lean` is how far its lower end is from the upper one.
fn moves<T: Named>() {
    for lean in [0, 1, -1, 7000, -100_003, GRID / 3] {
        let changed = sweep::<T>(WIDE, |step| {
            let top = [step - GRID / 2, GRID, GRID];
            let bottom = [step - GRID / 2 + lean, -GRID, GRID];
            let (left, lower) = ([-GRID, GRID, GRID], [-GRID, -GRID, GRID]);
            vec![[left, lower, bottom], [left, bottom, top]]
        });
        assert!(changed >= 12, "{changed} pixels for a lean of {lean}");
    }
}

/// The right side of a triangle turns about its lower end, which is near, far, at infinity or behind the eye.
fn turns<T: Named>() {
    for end in [
        [0, -GRID, GRID],
        [-77_777, -GRID, GRID / 2],
        [GRID, -GRID, 3],
        [-GRID, -GRID, 0],
        [GRID / 4, -GRID, -GRID / 2],
        [3, -100, -1],
    ] {
        let changed = sweep::<T>(WIDE, |step| {
            let top = [step - GRID / 3, GRID, GRID];
            vec![[[-GRID, GRID, GRID], end, top]]
        });
        assert!(changed >= 3, "{changed} pixels about {end:?}");
    }
}

/// A side that is level, or nearly, moves down.
fn sinks<T: Named>() {
    for lean in [0, 1, -3, 40_000, -GRID] {
        let changed = sweep::<T>(HIGH, |step| {
            let far = GRID / 3 - step;
            let (left, right) = ([-GRID, far, GRID], [GRID, (far - lean).min(GRID), GRID]);
            let (top, corner) = ([-GRID, GRID, GRID], [GRID, GRID, GRID]);
            vec![[top, left, right], [top, right, corner]]
        });
        assert!(changed >= 6, "{changed} pixels for a lean of {lean}");
    }
}

in_every_tier! {
    a_side_that_moves => moves;
    a_side_that_turns => turns;
    a_side_that_sinks => sinks;
}
