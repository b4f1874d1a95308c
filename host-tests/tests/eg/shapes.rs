//! Drawings of embedded-graphics at random places, partly or wholly outside.

use embedded_graphics::image::{Image, ImageRaw};
use embedded_graphics::iterator::raw::RawDataSlice;
use embedded_graphics::mono_font::ascii::{FONT_5X8, FONT_6X10, FONT_10X20};
use embedded_graphics::mono_font::{MonoTextStyle, MonoTextStyleBuilder};
use embedded_graphics::pixelcolor::PixelColor;
use embedded_graphics::pixelcolor::raw::{BigEndian, RawData};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{
    Arc, Circle, Ellipse, Line, PrimitiveStyle, PrimitiveStyleBuilder, Rectangle, RoundedRectangle,
    Triangle,
};
use embedded_graphics::text::Text;
use host_tests::oracle::Rng;
use std::fmt::Debug;

/// A colour that can be made of bits, by itself and from an image's bytes.
pub trait AnyColor: PixelColor + From<Self::Raw> + Debug {
    /// Draws an image of 13 x 9 pixels, or a part of it.
    fn image<D: DrawTarget<Color = Self>>(
        target: &mut D,
        data: &[u8],
        at: Point,
        part: Option<Rectangle>,
    ) -> Result<(), D::Error>;
}

impl<C> AnyColor for C
where
    C: PixelColor + From<C::Raw> + Debug,
    for<'a> RawDataSlice<'a, C::Raw, BigEndian>: IntoIterator<Item = C::Raw>,
{
    fn image<D: DrawTarget<Color = C>>(
        target: &mut D,
        data: &[u8],
        at: Point,
        part: Option<Rectangle>,
    ) -> Result<(), D::Error> {
        let bytes = 13 * 9 * C::Raw::BITS_PER_PIXEL / 8;
        let raw = ImageRaw::<C, BigEndian>::new(&data[..bytes], 13);
        match part {
            None => Image::new(&raw, at).draw(target),
            Some(area) => Image::new(&raw.sub_image(&area), at).draw(target),
        }
    }
}

/// A colour of random bits.
pub fn color<C: AnyColor>(rng: &mut Rng) -> C {
    C::Raw::from_u32(rng.bits() as u32).into()
}

/// A point on a target of this size, or about as far outside.
fn point(rng: &mut Rng, Size { width, height }: Size) -> Point {
    let mut at = |side: u32| rng.range(-i64::from(side), 2 * i64::from(side)) as i32;
    Point::new(at(width), at(height))
}

fn style<C: AnyColor>(rng: &mut Rng) -> PrimitiveStyle<C> {
    let builder = PrimitiveStyleBuilder::new().fill_color(color(rng));
    if rng.once_in(2) {
        return builder.build();
    }
    let builder = if rng.once_in(2) { PrimitiveStyleBuilder::new() } else { builder };
    builder.stroke_color(color(rng)).stroke_width(rng.range(1, 5) as u32).build()
}

/// An area of up to twice a target's sides.
fn area(rng: &mut Rng, size: Size) -> Rectangle {
    let mut side = |side: u32| rng.range(0, 2 * i64::from(side)) as u32;
    let sides = Size::new(side(size.width), side(size.height));
    Rectangle::new(point(rng, size), sides)
}

/// Draws one of everything there is, the same for the same numbers. Points are over a picture of `size`, which may be other
/// than the target.
pub fn draw<D>(target: &mut D, size: Size, rng: &mut Rng) -> Result<(), D::Error>
where
    D: DrawTarget<Color: AnyColor>,
{
    let at = point(rng, size);
    let (one, other) = (color::<D::Color>(rng), color(rng));
    let [width, height] =
        [size.width, size.height].map(|side| rng.range(0, i64::from(side)) as u32);
    let sides = Size::new(width, height);
    match rng.below(15) {
        0 => Text::new("Hither,\nyon", at, MonoTextStyle::new(&FONT_6X10, one))
            .draw(target)
            .map(drop),
        1 => {
            let font = rng.choose(&[&FONT_5X8, &FONT_10X20]);
            let style = MonoTextStyleBuilder::new().font(font).text_color(one);
            let style = style.background_color(other).underline().build();
            Text::new("g|W\n 09", at, style).draw(target).map(drop)
        }
        2 => Rectangle::new(at, sides).into_styled(style(rng)).draw(target),
        3 => Circle::new(at, width).into_styled(style(rng)).draw(target),
        4 => Ellipse::new(at, sides).into_styled(style(rng)).draw(target),
        5 => Line::new(at, point(rng, size)).into_styled(style(rng)).draw(target),
        6 => {
            let triangle = Triangle::new(at, point(rng, size), point(rng, size));
            triangle.into_styled(style(rng)).draw(target)
        }
        7 => {
            let rounded = RoundedRectangle::with_equal_corners(
                Rectangle::new(at, sides),
                Size::new_equal(rng.range(0, 9) as u32),
            );
            rounded.into_styled(style(rng)).draw(target)
        }
        8 => {
            let [start, sweep] =
                [(); 2].map(|()| Angle::from_degrees(rng.between(-360.0, 360.0) as f32));
            Arc::new(at, width, start, sweep).into_styled(style(rng)).draw(target)
        }
        9 => {
            let data: Vec<_> = (0..13 * 9 * 4).map(|_| rng.bits() as u8).collect();
            let corner = Point::new(rng.range(0, 12) as i32, rng.range(0, 8) as i32);
            let part = Rectangle::with_corners(corner, Point::new(12, 8));
            D::Color::image(target, &data, at, (rng.once_in(2)).then_some(part))
        }
        // What drivers are asked for, as it comes.
        10 => target.fill_solid(&area(rng, size), one),
        11 => {
            // As many colours as there are, fewer or more.
            let area = area(rng, size);
            let pixels = u64::from(area.size.width) * u64::from(area.size.height);
            let count = rng.below(pixels + pixels / 4 + 1);
            let colors: Vec<_> = (0..count).map(|_| color(rng)).collect();
            target.fill_contiguous(&area, colors)
        }
        12 => {
            // Without an end.
            let area = area(rng, size);
            let mut rng = Rng::new(rng.bits());
            target.fill_contiguous(&area, std::iter::repeat_with(|| color(&mut rng)))
        }
        13 => {
            let mut rng = Rng::new(rng.bits());
            target.draw_iter((0..50).map(|_| Pixel(point(&mut rng, size), color(&mut rng))))
        }
        _ if rng.once_in(4) => target.clear(one),
        _ => Ok(()),
    }
}
