//! What is drawn on each band of a picture is on all of it.

use crate::display::Plain;
use crate::shapes::{self, color};
use crate::triangles::hither;
use embedded_graphics::pixelcolor;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use hither::{Frame, Framebuffer, Gouraud, PixelFormat, Rgb565, Rgb565Be, Viewport};
use host_tests::oracle::Rng;

#[test]
fn drawings_go_across_bands() {
    let mut rng = Rng::new(91);
    for case in 0..150 {
        let [width, height] = [(); 2].map(|()| rng.range(1, 90) as u32);
        let background = color::<pixelcolor::Rgb565>(&mut rng);
        let seed = rng.bits();
        let mut whole = Plain::new(width, height, background);
        let size = whole.size();
        let mut drawings = Rng::new(seed);
        for _ in 0..12 {
            let Ok(()) = shapes::draw(&mut whole, size, &mut drawings);
        }
        let rows = rng.range(1, i64::from(height) + 3) as usize;
        let mut words = vec![0; width as usize * rows];
        let picture = Viewport::new(width, height).expect("1 to 512");
        let mut bands = Vec::new();
        for band in picture.bands(words.len()).expect("a row or more") {
            let mut buffer = band.framebuffer::<Rgb565Be>(&mut words).expect("it holds the band");
            let mut target = band.draw_target(&mut buffer);
            let place =
                Rectangle::new(Point::new(0, band.y() as i32), Size::new(width, band.rows()));
            assert_eq!(target.bounding_box(), place);
            let Ok(()) = target.clear(background);
            let mut drawings = Rng::new(seed);
            for _ in 0..12 {
                let Ok(()) = shapes::draw(&mut target, size, &mut drawings);
            }
            let words = &words[..band.pixels()];
            bands
                .extend(words.iter().map(|word| pixelcolor::Rgb565::from(Rgb565Be::decode(*word))));
        }
        assert!(bands == whole.pixels, "case {case}, {width} x {height}, bands of {rows} rows");
    }
}

/// Text over triangles, in bands and in one.
#[test]
fn text_over_triangles_goes_across_bands() {
    let picture = Viewport::new(120, 77).expect("1 to 512");
    let draw = |words: &mut [u16]| {
        let mut all = Vec::new();
        for band in picture.bands(words.len()).expect("a row or more") {
            let target = band.framebuffer::<Rgb565>(words).expect("it holds the band");
            let mut frame = Frame::with_viewport(target, band.viewport()).with_hither(hither());
            frame.clear(Rgb565::BLUE);
            let _ = crate::triangles::draw(&mut frame, &Gouraud, 92);
            let mut drawings = Rng::new(93);
            for _ in 0..8 {
                let mut target = band.draw_target(frame.target_mut());
                let Ok(()) = shapes::draw(&mut target, Size::new(120, 77), &mut drawings);
            }
            let (target, _) = frame.into_parts();
            all.extend_from_slice(&Framebuffer::into_words(target)[..band.pixels()]);
        }
        all
    };
    let whole = draw(&mut [0; 120 * 77]);
    for rows in [1, 2, 13, 76] {
        assert!(draw(&mut vec![0; 120 * rows]) == whole, "bands of {rows} rows");
    }
}
