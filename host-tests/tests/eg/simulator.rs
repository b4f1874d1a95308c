//! embedded-graphics-simulator: its display, and the PNG it makes of that.

use base64::prelude::{BASE64_STANDARD, Engine};
use embedded_graphics::pixelcolor;
use embedded_graphics::prelude::*;
use embedded_graphics_simulator::{OutputSettings, SimulatorDisplay};
use hither::{DepthBuffer, Frame, Framebuffer, OnDisplay, Rgb565, Rgb565Be, Target, Vertex};
use hither_examples::rgb565;
use hither_scenes::spinning_teapot::{self as scene, Moment};
use std::io::Cursor;

/// The example, for what it draws over the scene.
#[path = "../../../examples/text_over_3d.rs"]
#[expect(dead_code, reason = "only the overlay is drawn")]
mod text_over_3d;

const SIDE: u32 = 240;
const MOMENT: Moment = Moment { number: 12, frames: 64 };

/// Draws the teapot; its triangles that were drawn.
fn draw<T: Target<Color = Rgb565>>(target: T) -> (T, u32) {
    let mut words = vec![0u16; (SIDE * SIDE) as usize];
    let depth = DepthBuffer::try_new(&mut words, SIDE, SIDE).expect("a word a pixel");
    let frame = Frame::new(target).expect("1 to 512").with_hither(scene::HITHER);
    let mut frame = frame.with_depth(depth).expect("of one size").with_cull(scene::CULL);
    let mut cache = vec![Vertex::EMPTY; scene::VERTEX_COUNT];
    let drawn = scene::draw(&mut frame, MOMENT, &mut cache).expect("numbers in range");
    (frame.into_parts().0, drawn.teapot.drawn)
}

#[test]
fn the_simulator_shows_our_picture() {
    let mut words = vec![0; (SIDE * SIDE) as usize];
    let buffer = Framebuffer::<Rgb565Be>::try_new(&mut words, SIDE, SIDE).expect("a word a pixel");
    let (mut buffer, triangles) = draw(buffer);
    let Ok(()) = text_over_3d::draw_overlay(&mut buffer, MOMENT.number, triangles);

    let mut display = SimulatorDisplay::<pixelcolor::Rgb565>::new(Size::new_equal(SIDE));
    let (target, same) = draw(OnDisplay::new(&mut display));
    assert_eq!((target.finish(), same), (Ok(()), triangles));
    let Ok(()) = text_over_3d::draw_overlay(&mut display, MOMENT.number, triangles);

    let pixels: Vec<_> = (0..SIDE * SIDE)
        .map(|at| buffer.pixel(at % SIDE, at / SIDE).expect("inside"))
        .map(pixelcolor::Rgb565::from)
        .collect();
    let shown = display.bounding_box().points().map(|point| display.get_pixel(point));
    assert!(shown.eq(pixels.iter().copied()));

    let image = display.to_rgb_output_image(&OutputSettings::default());
    let png = BASE64_STANDARD.decode(image.to_base64_png().expect("a PNG")).expect("base 64");
    let expected = pixels.iter().map(|&pixel| pixelcolor::Rgb888::from(pixel));
    let expected: Vec<_> = expected.flat_map(|color| [color.r(), color.g(), color.b()]).collect();
    assert!(decode(&png) == expected);

    // And what the documents show.
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/text_over_3d.png");
    let docs = decode(&std::fs::read(path).expect("the picture is there"));
    let native: Vec<_> = buffer.words().iter().map(|&word| u16::from_be(word)).collect();
    assert!(
        docs == rgb565::expand_all(&native),
        "the example's picture is another: copy it to docs"
    );
}

/// The bytes of a PNG's pixels.
fn decode(png: &[u8]) -> Vec<u8> {
    let mut reader = png::Decoder::new(Cursor::new(png)).read_info().expect("a PNG");
    let mut rgb = vec![0; reader.output_buffer_size().expect("it fits")];
    let info = reader.next_frame(&mut rgb).expect("a picture");
    assert_eq!((info.width, info.height), (SIDE, SIDE));
    assert_eq!(info.color_type, png::ColorType::Rgb);
    rgb
}
