//! A triangle with a colour at each vertex, as the README shows it.

use hither::{Frame, Framebuffer, Gouraud, Hither, I16F16, Mat4, Mesh, Rgb565};
use hither_examples::{picture, rgb565};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = [0; 240 * 240];
    let buffer = Framebuffer::<Rgb565>::try_new(&mut words, 240, 240)?;
    let mut frame = Frame::new(buffer)?.with_hither(Hither::new(I16F16::ONE)?);

    // Coordinates are in units of 2^-3: 8 is 1, the edge of the picture.
    let positions = [[-7_i16, -6, 0], [7, -6, 0], [0, 7, 0]];
    let colors = [[255_u8, 0, 0], [0, 255, 0], [0, 0, 255]];
    let mesh = Mesh::try_new(&positions, 3, &colors, &[[0, 1, 2]])?;

    frame.clear(Rgb565::BLACK);
    let counts = frame.draw(&mesh, &Mat4::IDENTITY, &Gouraud, &mut []);

    let path = picture::target_folder().join("triangle.png");
    picture::write_png(&path, 240, 240, &rgb565::expand_all(frame.target().words()))?;
    println!("{} triangle drawn: {}", counts.drawn, path.display());
    Ok(())
}
