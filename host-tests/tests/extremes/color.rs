//! Colours stepped as one word, from one end of every channel to the other: over half a screen, along strips and in dots.

use hither::{Gouraud, Hither, I16F16, Quick, Rgb565, Tier};
use host_tests::oracle::{GRID, Rng, Space, Surface, Viewport, whole};
use host_tests::record::{clip_vertex, frame};
use host_tests::snapped;

use super::{Named, Packed8, steep, steps};

/// How far colours are from exact channels, in steps of each channel: red, green and blue; and of how many pixels.
fn off<T: Tier>(
    viewport: Viewport,
    corners: [[i64; 3]; 3],
    rgb: [[i64; 3]; 3],
) -> ([f64; 3], usize) {
    let hither = corners.iter().map(|c| c[2]).min().unwrap_or(1);
    let plane = Hither::new(I16F16::from_bits(hither as i32)).expect("above 0");
    let mut frame = frame(viewport)
        .with_tier(T::default())
        .with_correction(Packed8::default())
        .with_hither(plane);
    let vertices = [0, 1, 2].map(|i| {
        let [x, y, w] = corners[i];
        let unit = rgb[i].map(|c| I16F16::from_bits(c as i32));
        frame.snap(&clip_vertex([x, y, 0, w]), unit)
    });
    let [a, b, c] = &vertices;
    let _ = frame.draw_snapped([a, b, c], &Gouraud);
    let snapped = vertices.map(|v| v.snapped());
    let points = snapped.map(|s| whole(snapped::in_pixels(s, viewport)));
    let scales = [0, 1, 2].map(|i| snapped::scale(snapped[i], corners[i][2]));
    let mut largest = [0.0f64; 3];
    let Some(surface) = Surface::from_rationals(&points, &scales, Space::Pixel, viewport) else {
        return (largest, 0);
    };
    let channels = [0, 1, 2].map(|n| surface.attribute(&whole(rgb.map(|rgb| rgb[n]))));
    let pixels = frame.into_parts().0.pixels;
    for &(x, y, color) in &pixels {
        let color: Rgb565 = color;
        let got = [(color.r(), 31.0), (color.g(), 63.0), (color.b(), 31.0)];
        for ((largest, (got, most)), channel) in largest.iter_mut().zip(got).zip(&channels) {
            *largest = largest.max((f64::from(got) - channel.at(x, y) * most / 65_536.0).abs());
        }
    }
    (largest, pixels.len())
}

/// The same corners with `w` from one to another that is up to `more` larger.
fn nearly_level(corners: [[i64; 3]; 3], more: i64, rng: &mut Rng) -> [[i64; 3]; 3] {
    let w = rng.range(GRID / 4, GRID / 2);
    corners.map(|[x, y, old]| {
        let between = rng.range(0, more);
        let new = w + rng.choose(&[0, more, between]);
        [x * new / old, y * new / old, new]
    })
}

/// Half a screen, a strip or a dot.
fn shape(round: usize, rng: &mut Rng) -> (Viewport, [[i64; 3]; 3]) {
    let small = Viewport::new(90, 64);
    match round % 20 {
        0 => (steps::VIEWPORT, steps::half(round % 4, 1, rng)),
        1..12 => (small, steep::strip(small, 1, rng)),
        _ => (small, steep::dot(small, rng)),
    }
}

fn check<T: Named>() {
    let mut rng = Rng::new(31);
    let mut count = 0;
    for round in 0..600 {
        let (viewport, corners) = shape(round, &mut rng);
        // A 32nd more is as far as one line may be taken for a curve: 2^-7 of the range off.
        let is_level = rng.once_in(2);
        let more = if is_level { 0 } else { GRID / 4 / 32 };
        let corners = nearly_level(corners, more, &mut rng);
        let ends = [0, 1 << 16, 1, 0xffff, 1 << 15];
        let rgb = [[0; 3]; 3].map(|none| none.map(|_: i64| rng.choose(&ends)));
        let (steps, pixels) = off::<T>(viewport, corners, rgb);
        count += pixels;
        for (steps, most) in steps.into_iter().zip([31.0, 63.0, 31.0]) {
            let bound = if is_level { 1.0 } else { 1.0 + most / 128.0 };
            assert!(steps <= bound, "{steps} steps: {viewport:?} {corners:?} {rgb:?}");
        }
    }
    assert!(count > 100_000, "{count}");
}

/// The largest error that a search found, with `w` a 32nd larger at one side: a step of 1/2, 1/32 and 23/64, and 2^-7 of the
/// range for the line.
#[test]
fn the_line_and_the_steps_add_up() {
    let viewport = Viewport::new(507, 40);
    let corners =
        [[-270_685, 26_979, 296_479], [240_007, 138_195, 305_742], [40_914, -170_475, 296_479]];
    let rgb = [[1 << 16; 3], [0; 3], [64_341; 3]];
    let (steps, _) = off::<Quick<8>>(viewport, corners, rgb);
    println!("{steps:?} steps");
    for (steps, most) in steps.into_iter().zip([31.0, 63.0, 31.0]) {
        assert!(steps <= 0.5 + 1.0 / 32.0 + 23.0 / 64.0 + most / 128.0, "{steps}");
    }
}

in_every_tier! {
    packed_colors_are_within_a_step_beside_the_line => check;
}
