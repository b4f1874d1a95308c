//! Text, icons and shapes of embedded-graphics over 3D, in the same framebuffer: a picture and an animation.

use std::error::Error;

use embedded_graphics::mono_font::MonoTextStyle;
use embedded_graphics::mono_font::iso_8859_1::{FONT_6X10, FONT_9X15_BOLD};
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{
    Arc, Circle, Polyline, PrimitiveStyle, PrimitiveStyleBuilder, Rectangle, RoundedRectangle,
};
use embedded_graphics::text::{Alignment, Baseline, Text, TextStyleBuilder};
use hither::{DepthBuffer, Frame, Framebuffer, Rgb565Be, Vertex};
use hither_examples::{picture, rgb565};
use hither_scenes::spinning_teapot::{self as scene, Moment};

/// Pixels along each side.
const SIDE: u32 = 240;

/// Frames of a turn.
const FRAMES: u32 = 64;

/// How long a frame is shown.
const FRAME_MILLIS: u16 = 50;

const INK: Rgb565 = Rgb565::WHITE;
const DIM: Rgb565 = Rgb565::new(17, 38, 20);
const ACCENT: Rgb565 = Rgb565::new(31, 42, 6);
const PANEL: Rgb565 = Rgb565::new(2, 6, 5);

fn main() -> Result<(), Box<dyn Error>> {
    // Firmware has these in statics. All frames are drawn into the same buffers.
    let pixels = (SIDE * SIDE) as usize;
    let (mut color_words, mut depth_words) = (vec![0_u16; pixels], vec![0_u16; pixels]);
    let mut cache = vec![Vertex::EMPTY; scene::VERTEX_COUNT];
    let mut pictures = Vec::new();
    for number in 0..FRAMES {
        let buffer = Framebuffer::<Rgb565Be>::try_new(&mut color_words, SIDE, SIDE)?;
        let mut frame = Frame::new(buffer)?
            .with_hither(scene::HITHER)
            .with_depth(DepthBuffer::try_new(&mut depth_words, SIDE, SIDE)?)?
            .with_cull(scene::CULL);
        let drawn = scene::draw(&mut frame, Moment { number, frames: FRAMES }, &mut cache)?;
        // The framebuffer is a `DrawTarget`: whatever embedded-graphics draws goes over the 3D.
        draw_overlay(frame.target_mut(), number, drawn.teapot.drawn)?;
        // Where firmware sends `frame.target().bytes()` to the display.
        let words: Vec<_> = frame.target().words().iter().map(|&word| u16::from_be(word)).collect();
        pictures.push(rgb565::expand_all(&words));
    }
    let folder = picture::target_folder();
    let (still, animation) = (folder.join("text_over_3d.png"), folder.join("text_over_3d.apng"));
    picture::write_png(&still, SIDE, SIDE, &pictures[FRAMES as usize / 5])?;
    picture::write_apng(&animation, SIDE, SIDE, &pictures, FRAME_MILLIS)?;
    println!("Picture    {}\nAnimation  {}", still.display(), animation.display());
    Ok(())
}

/// Draws everything that is not 3D, onto any display of this size.
pub fn draw_overlay<D>(display: &mut D, number: u32, triangles: u32) -> Result<(), D::Error>
where
    D: DrawTarget<Color = Rgb565>,
{
    let title = MonoTextStyle::new(&FONT_9X15_BOLD, INK);
    Text::with_baseline("hither", Point::new(8, 6), title, Baseline::Top).draw(display)?;
    let small = MonoTextStyle::new(&FONT_6X10, DIM);
    Text::with_baseline("text over 3D", Point::new(8, 22), small, Baseline::Top).draw(display)?;
    draw_icons(display)?;

    // A line from the knob of the lid to what is said about it. (Firmware has `heapless::format!`.)
    let line = [Point::new(126, 66), Point::new(145, 47), Point::new(232, 47)];
    let thin = PrimitiveStyle::with_stroke(ACCENT, 1);
    Polyline::new(&line).into_styled(thin).draw(display)?;
    Circle::with_center(line[0], 5).into_styled(PrimitiveStyle::with_fill(ACCENT)).draw(display)?;
    let note = MonoTextStyle::new(&FONT_6X10, INK);
    let text = format!("{triangles} triangles");
    Text::with_alignment(&text, Point::new(232, 43), note, Alignment::Right).draw(display)?;

    draw_rate(display, number)?;
    draw_turn(display, number)
}

/// How good the radio is, and how full the battery.
fn draw_icons<D>(display: &mut D) -> Result<(), D::Error>
where
    D: DrawTarget<Color = Rgb565>,
{
    for bar in 0..4 {
        let height = 3 + 3 * bar;
        let place =
            Rectangle::new(Point::new(178 + 5 * bar, 20 - height), Size::new(3, height as u32));
        let color = if bar < 3 { INK } else { DIM };
        display.fill_solid(&place, color)?;
    }
    let body = RoundedRectangle::with_equal_corners(
        Rectangle::new(Point::new(204, 9), Size::new(25, 11)),
        Size::new(2, 2),
    );
    body.into_styled(PrimitiveStyle::with_stroke(INK, 1)).draw(display)?;
    display.fill_solid(&Rectangle::new(Point::new(229, 12), Size::new(3, 5)), INK)?;
    display.fill_solid(&Rectangle::new(Point::new(206, 11), Size::new(15, 7)), ACCENT)
}

/// The frame rate, and how far the turn is as a bar.
fn draw_rate<D>(display: &mut D, number: u32) -> Result<(), D::Error>
where
    D: DrawTarget<Color = Rgb565>,
{
    let panel = PrimitiveStyleBuilder::new().fill_color(PANEL).stroke_color(DIM).stroke_width(1);
    let place = Rectangle::new(Point::new(8, 194), Size::new(86, 38));
    RoundedRectangle::with_equal_corners(place, Size::new(6, 6))
        .into_styled(panel.build())
        .draw(display)?;
    let text = format!("{} fps", 1000 / FRAME_MILLIS);
    let bold = MonoTextStyle::new(&FONT_9X15_BOLD, INK);
    Text::with_baseline(&text, Point::new(15, 198), bold, Baseline::Top).draw(display)?;
    let bar = Rectangle::new(Point::new(15, 219), Size::new(72, 6));
    display.fill_solid(&bar, Rgb565::new(5, 13, 8))?;
    let done = Size::new(72 * (number + 1) / FRAMES, 6);
    display.fill_solid(&Rectangle::new(bar.top_left, done), ACCENT)
}

/// The angle of the turn on a dial.
fn draw_turn<D>(display: &mut D, number: u32) -> Result<(), D::Error>
where
    D: DrawTarget<Color = Rgb565>,
{
    let degrees = 360.0 * number as f32 / FRAMES as f32;
    let dial = Circle::with_center(Point::new(206, 206), 53);
    dial.into_styled(PrimitiveStyle::with_fill(PANEL)).draw(display)?;
    let ring = Circle::with_center(dial.center(), 45);
    ring.into_styled(PrimitiveStyle::with_stroke(Rgb565::new(5, 13, 8), 5)).draw(display)?;
    Arc::from_circle(ring, Angle::from_degrees(-90.0), Angle::from_degrees(degrees))
        .into_styled(PrimitiveStyle::with_stroke(ACCENT, 5))
        .draw(display)?;
    let centred =
        TextStyleBuilder::new().alignment(Alignment::Center).baseline(Baseline::Middle).build();
    let text = format!("{degrees:.0}°");
    let style = MonoTextStyle::new(&FONT_6X10, INK);
    Text::with_text_style(&text, dial.center(), style, centred).draw(display)?;
    Ok(())
}
