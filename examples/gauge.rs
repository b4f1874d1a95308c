//! A dial in 2D with smooth edges: a ring of coloured sectors, ticks, a needle and a hub, as polygons; its numbers are text of
//! embedded-graphics.

use std::error::Error;

use embedded_graphics::mono_font::MonoTextStyle;
use embedded_graphics::mono_font::iso_8859_1::{FONT_9X15, FONT_10X20};
use embedded_graphics::pixelcolor;
use embedded_graphics::prelude::*;
use embedded_graphics::text::{Alignment, Baseline, Text, TextStyleBuilder};
use hither::{
    Alpha, Angle, DisplayFrame, Frame, Framebuffer, I16F16, Polygon, PolygonError, Rgb565,
};
use hither_examples::{picture, rgb565};

/// Pixels along each side.
const SIDE: u32 = 240;

/// What the needle shows, 0 to 120.
const SPEED: i32 = 87;

const FACE: Rgb565 = Rgb565::new(3, 7, 5);
const RIM: Rgb565 = Rgb565::new(7, 15, 9);
const GREEN: Rgb565 = Rgb565::new(7, 50, 14);
const AMBER: Rgb565 = Rgb565::new(31, 45, 4);
const RED: Rgb565 = Rgb565::new(30, 14, 8);
const NEEDLE: Rgb565 = Rgb565::new(31, 22, 6);
const TICK: Rgb565 = Rgb565::new(27, 55, 28);

fn main() -> Result<(), Box<dyn Error>> {
    // A word a pixel: a static in firmware.
    let mut words = [0; (SIDE * SIDE) as usize];
    let mut frame = Frame::new(Framebuffer::try_new(&mut words, SIDE, SIDE)?)?;
    frame.clear(Rgb565::BLACK);
    draw_dial(&mut frame)?;
    draw_numbers(frame.target_mut())?;
    draw_needle(&mut frame, SPEED)?;

    // Where firmware sends `frame.target().bytes()` to the display.
    let words: Vec<_> = frame.target().words().iter().map(|&word| u16::from_be(word)).collect();
    let rgb = rgb565::expand_all(&words);
    let path = picture::target_folder().join("gauge.png");
    picture::write_png(&path, SIDE, SIDE, &rgb)?;
    println!("Picture    {}", path.display());
    Ok(())
}

/// A place on the dial: pixels from its middle, and where on the scale, 0 to 120, from lower left over the top to lower right.
fn at(radius: f32, speed: f32) -> [I16F16; 2] {
    let turn = Angle::from_degrees(I16F16::from_num(speed * 2.25 - 135.0)).sin_cos();
    let radius = I16F16::from_num(radius);
    let middle = I16F16::from_num(SIDE / 2);
    [middle + radius * turn.sin, middle - radius * turn.cos]
}

/// Fills a polygon, smoothly, over what is there.
fn fill(
    frame: &mut DisplayFrame,
    corners: &[[I16F16; 2]],
    color: Rgb565,
) -> Result<(), PolygonError> {
    let polygon = Polygon::try_new(corners)?;
    frame.blended().fill_shape_smooth(&polygon, Alpha { color, alpha: 255 });
    Ok(())
}

/// Fills a circle around the middle: 64 corners are within a seventh of a pixel at 115 pixels.
fn disc(frame: &mut DisplayFrame, radius: f32, color: Rgb565) -> Result<(), PolygonError> {
    let corners: [_; 64] = std::array::from_fn(|i| at(radius, i as f32 * 160.0 / 64.0));
    fill(frame, &corners, color)
}

/// Fills a part of a ring: out along one arc, and back along the other.
fn sector(
    frame: &mut DisplayFrame,
    [from, to]: [f32; 2],
    color: Rgb565,
) -> Result<(), PolygonError> {
    let corners: [_; 40] = std::array::from_fn(|i| {
        let (radius, step) = if i < 20 { (108.0, i) } else { (94.0, 39 - i) };
        at(radius, from + (to - from) * step as f32 / 19.0)
    });
    fill(frame, &corners, color)
}

/// Everything that stands still.
fn draw_dial(frame: &mut DisplayFrame) -> Result<(), PolygonError> {
    disc(frame, 117.0, RIM)?;
    disc(frame, 113.0, FACE)?;
    // A gap between, of as many pixels inside as outside.
    for (ends, color) in [([0.0, 69.2], GREEN), ([70.0, 99.2], AMBER), ([100.0, 120.0], RED)] {
        sector(frame, ends, color)?;
    }
    for speed in (0..=120).step_by(5) {
        let (inner, half) = if speed % 20 == 0 { (78.0, 1.25) } else { (84.0, 0.6) };
        let speed = speed as f32;
        // Half a width across, as a part of the scale: it is 2.25 degrees a step.
        let across = |radius: f32| half / radius / 2.25_f32.to_radians();
        let [low, high] = [across(inner), across(90.0)];
        let corners = [
            at(inner, speed - low),
            at(90.0, speed - high),
            at(90.0, speed + high),
            at(inner, speed + low),
        ];
        fill(frame, &corners, TICK)?;
    }
    Ok(())
}

/// The needle and its hub.
fn draw_needle(frame: &mut DisplayFrame, speed: i32) -> Result<(), PolygonError> {
    let speed = speed as f32;
    // A quarter of a turn is 40 of the scale.
    let corners =
        [at(88.0, speed), at(4.0, speed + 40.0), at(22.0, speed + 80.0), at(4.0, speed - 40.0)];
    fill(frame, &corners, NEEDLE)?;
    disc(frame, 11.0, TICK)?;
    disc(frame, 7.5, RIM)
}

/// The numbers, onto any display of this size.
fn draw_numbers<D>(display: &mut D) -> Result<(), D::Error>
where
    D: DrawTarget<Color = pixelcolor::Rgb565>,
{
    let centred = TextStyleBuilder::new().alignment(Alignment::Center).baseline(Baseline::Middle);
    let white = pixelcolor::Rgb565::WHITE;
    let mut text = |text: &str, [x, y]: [I16F16; 2], font| {
        let place = Point::new(x.to_num(), y.to_num());
        let style = MonoTextStyle::new(font, white);
        Text::with_text_style(text, place, style, centred.build()).draw(display)
    };
    for speed in (0..=120).step_by(20) {
        text(&speed.to_string(), at(63.0, speed as f32), &FONT_9X15)?;
    }
    text("km/h", at(72.0, 140.0), &FONT_10X20)?;
    Ok(())
}
