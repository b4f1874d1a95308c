//! What embedded-graphics draws in a framebuffer is what it draws pixel by pixel.

use crate::display::Plain;
use crate::shapes::{self, AnyColor, color};
use crate::triangles::hither;
use embedded_graphics::mock_display::MockDisplay;
use embedded_graphics::mono_font::MonoTextStyle;
use embedded_graphics::mono_font::ascii::FONT_6X10;
use embedded_graphics::pixelcolor::{self, PixelColor};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use embedded_graphics::text::Text;
use hither::{
    AsPixelColor, Frame, Framebuffer, Gouraud, Gray8, PixelFormat, Rgb565, Rgb565Be, Rgb888,
};
use host_tests::oracle::Rng;

/// The colour of embedded-graphics in a format.
type Own<F> = <<F as PixelFormat>::Color as AsPixelColor>::PixelColor;

/// A buffer's pixels as embedded-graphics has them.
fn pixels<F>(buffer: &Framebuffer<'_, F>) -> Vec<Own<F>>
where
    F: PixelFormat<Color: AsPixelColor<PixelColor: From<F::Color>>>,
{
    buffer
        .bounding_box()
        .points()
        .map(|at| buffer.pixel(at.x as u32, at.y as u32).expect("inside").into())
        .collect()
}

fn drawings<F>(seed: u64)
where
    F: PixelFormat<Color: AsPixelColor<PixelColor: AnyColor + From<F::Color>>>,
{
    let mut rng = Rng::new(seed);
    for case in 0..300 {
        let [width, height] = [(); 2].map(|()| rng.range(1, 90) as u32);
        let background = color::<Own<F>>(&mut rng);
        let mut plain = Plain::new(width, height, background);
        let mut words = vec![F::encode(background.into()); (width * height) as usize];
        let mut buffer =
            Framebuffer::<F>::try_new(&mut words, width, height).expect("a word a pixel");
        for drawing in 0..20 {
            let mut again = rng.clone();
            let size = Size::new(width, height);
            let Ok(()) = shapes::draw(&mut plain, size, &mut rng);
            let Ok(()) = shapes::draw(&mut buffer, size, &mut again);
            assert!(
                pixels(&buffer) == plain.pixels,
                "drawing {drawing} of case {case}, {width} x {height}, seed {seed}"
            );
            assert_eq!(rng.bits(), again.bits(), "the same was drawn");
        }
    }
}

#[test]
fn rgb565() {
    drawings::<Rgb565>(81);
}

#[test]
fn rgb565_big_endian() {
    drawings::<Rgb565Be>(82);
}

#[test]
fn rgb888() {
    drawings::<Rgb888>(83);
}

#[test]
fn gray8() {
    drawings::<Gray8>(84);
}

/// The same in a `MockDisplay`, which is 64 x 64.
#[test]
fn a_mock_display_has_the_same() {
    let mut rng = Rng::new(85);
    for case in 0..200 {
        let mut mock = MockDisplay::<pixelcolor::Rgb565>::new();
        mock.set_allow_overdraw(true);
        mock.set_allow_out_of_bounds_drawing(true);
        let mut words = [0x1234; 64 * 64];
        let mut buffer =
            Framebuffer::<Rgb565Be>::try_new(&mut words, 64, 64).expect("a word a pixel");
        for _ in 0..4 {
            let mut again = rng.clone();
            let Ok(()) = shapes::draw(&mut mock, Size::new(64, 64), &mut rng);
            let Ok(()) = shapes::draw(&mut buffer, Size::new(64, 64), &mut again);
        }
        for point in mock.bounding_box().points() {
            let there = mock.get_pixel(point).map_or(Rgb565(0x1234u16.swap_bytes()), Rgb565::from);
            let here = buffer.pixel(point.x as u32, point.y as u32);
            assert_eq!(here, Some(there), "{point} of case {case}");
        }
    }
}

/// Areas with ends anywhere in the range, against integers that hold them.
#[test]
fn areas_of_any_size_are_cut() {
    let mut rng = Rng::new(86);
    let (width, height) = (7, 5);
    let mut seen = 0;
    for case in 0..4000 {
        let mut end = || match rng.below(4) {
            0 => i32::MIN + rng.below(3) as i32,
            1 => i32::MAX - rng.below(3) as i32,
            _ => rng.range(-9, 9) as i32,
        };
        let top_left = Point::new(end(), end());
        let mut length = || match rng.below(4) {
            0 => u32::MAX - rng.below(3) as u32,
            1 => (1 << 31) + rng.below(12) as u32 - 4,
            _ => rng.below(12) as u32,
        };
        let area = Rectangle::new(top_left, Size::new(length(), length()));
        let mut words = [0; 7 * 5];
        let mut buffer =
            Framebuffer::<Gray8>::try_new(&mut words, width, height).expect("a word a pixel");
        let Ok(()) = buffer.fill_solid(&area, pixelcolor::Gray8::WHITE);
        let holds = |start: i32, length: u32, v: u32| {
            let v = i64::from(v) - i64::from(start);
            (0..i64::from(length)).contains(&v)
        };
        for y in 0..height {
            for x in 0..width {
                let inside =
                    holds(top_left.x, area.size.width, x) && holds(top_left.y, area.size.height, y);
                let color = if inside { Gray8::WHITE } else { Gray8::BLACK };
                assert_eq!(buffer.pixel(x, y), Some(color), "{x} {y} of {area:?}, case {case}");
                seen += u32::from(inside);
            }
        }
    }
    assert!(seen > 10_000, "{seen} pixels");
}

/// Numbers as colours, that may be skipped.
struct Numbers(u64);

impl Iterator for Numbers {
    type Item = pixelcolor::Rgb888;

    fn next(&mut self) -> Option<Self::Item> {
        self.nth(0)
    }

    fn nth(&mut self, count: usize) -> Option<Self::Item> {
        self.0 += count as u64 + 1;
        Some(Self::of(self.0 - 1))
    }
}

impl Numbers {
    fn of(number: u64) -> pixelcolor::Rgb888 {
        Rgb888(number as u32 & 0x00ff_ffff).into()
    }
}

/// Colours for pixels outside are gone through in step: here more than `2^32`, not one by one.
#[test]
fn colours_that_are_outside_are_skipped() {
    let mut words = [0; 3 * 2];
    let mut buffer = Framebuffer::<Rgb888>::try_new(&mut words, 3, 2).expect("a word a pixel");
    let (left, above) = (1 << 20, 1 << 13);
    let area = Rectangle::new(Point::new(-left, -above), Size::new(left as u32 + 2, 1 << 14));
    let Ok(()) = buffer.fill_contiguous(&area, Numbers(0));
    for y in 0..2 {
        for x in 0..2 {
            let (left, row) = (left as u64 + u64::from(x), above as u64 + u64::from(y));
            let expected = Numbers::of(row * u64::from(area.size.width) + left);
            assert_eq!(buffer.pixel(x, y), Some(expected.into()), "{x} {y}");
        }
        assert_eq!(buffer.pixel(2, y), Some(Rgb888::BLACK));
    }
}

/// A word more than there are pixels is not written by areas, however large.
#[test]
fn what_is_behind_the_pixels_stays() {
    let mut words = [7; 3 * 2 + 4];
    let mut buffer = Framebuffer::<Gray8>::try_new(&mut words, 3, 2).expect("enough words");
    let area = Rectangle::new(Point::new(-4, -4), Size::new(100, 100));
    let Ok(()) = buffer.fill_solid(&area, pixelcolor::Gray8::new(1));
    let colors = std::iter::repeat(pixelcolor::Gray8::new(2));
    let Ok(()) = buffer.fill_contiguous(&area, colors);
    assert_eq!(words, [2, 2, 2, 2, 2, 2, 7, 7, 7, 7]);
}

/// Text goes over what a frame has drawn, and more goes over the text.
#[test]
fn text_goes_over_triangles() {
    let mut words = [0; 80 * 50];
    let buffer = Framebuffer::<Rgb565Be>::try_new(&mut words, 80, 50).expect("a word a pixel");
    let mut frame = Frame::new(buffer).expect("1 to 512").with_hither(hither());
    let _ = crate::triangles::draw(&mut frame, &Gouraud, 87);
    let mut expected = Plain::new(80, 50, pixelcolor::Rgb565::BLACK);
    expected.pixels = pixels(frame.target());
    let before = expected.clone();
    let style = MonoTextStyle::new(&FONT_6X10, pixelcolor::Rgb565::CSS_GOLD);
    let text = Text::new("over 3D\nand off the side", Point::new(11, 21), style);
    let Ok(_) = text.draw(frame.target_mut());
    let Ok(_) = text.draw(&mut expected);
    assert_ne!(before, expected);
    assert_eq!(pixels(frame.target()), expected.pixels);
    let counts = crate::triangles::draw(&mut frame, &Gouraud, 88);
    assert!(counts.drawn > 4, "{counts:?}");
}

/// Colours are the same bits.
#[test]
fn a_buffer_is_of_embedded_graphics_colours() {
    fn color_of<D: DrawTarget>(_: &D) -> &'static str {
        std::any::type_name::<D::Color>()
    }
    let mut words = [0u16; 1];
    let name = color_of(&Framebuffer::<Rgb565Be>::try_new(&mut words, 1, 1).expect("a word"));
    assert_eq!(name, std::any::type_name::<pixelcolor::Rgb565>());
    fn bits<C: PixelColor>(_: C) -> usize {
        <C::Raw as embedded_graphics::pixelcolor::raw::RawData>::BITS_PER_PIXEL
    }
    assert_eq!(bits(Own::<Gray8>::new(1)), 8);
}
