//! A textured floor through the eye's plane: what clips against the hither plane.

use crate::ground::{BACKGROUND, STONES};
use hither::{
    Correction, Counts, DepthTest, Frame, Hither, I16F16, Mat4, MatrixError, Mesh, Rgb565, Target,
    Textured, Tier,
};

/// Where the frame's hither plane and depth 0 are.
pub const NEAR: I16F16 = I16F16::lit("0.75");

/// Where depth 1 is.
pub const FAR: I16F16 = I16F16::lit("64");

/// Focal length in half picture heights.
pub const FOCAL: I16F16 = I16F16::lit("1.25");

/// The frame's hither plane.
pub const HITHER: Hither = match Hither::new(NEAR) {
    Ok(hither) => hither,
    Err(_) => panic!("the hither plane is not in front of the eye"),
};

/// One below the eye, 60 wide, from 10 behind it to 50 in front.
static POSITIONS: [[i16; 3]; 4] = [[-30, -1, 10], [30, -1, 10], [30, -1, -50], [-30, -1, -50]];

/// A texture every two units.
static COORDINATES: [[I16F16; 2]; 4] = {
    const ACROSS: I16F16 = I16F16::lit("15");
    const BEHIND: I16F16 = I16F16::lit("5");
    const AHEAD: I16F16 = I16F16::lit("-25");
    const LEFT: I16F16 = I16F16::lit("-15");
    [[LEFT, BEHIND], [ACROSS, BEHIND], [ACROSS, AHEAD], [LEFT, AHEAD]]
};

static FLOOR: Mesh<'static, [i16; 3], [I16F16; 2]> =
    match Mesh::try_new(&POSITIONS, 0, &COORDINATES, &[[0, 1, 2], [0, 2, 3]]) {
        Ok(mesh) => mesh,
        Err(_) => panic!("the floor's indices"),
    };

/// Clears a square frame with the hither plane [`HITHER`], and draws the floor.
///
/// # Errors
///
/// None in practice: the numbers are constants in range.
pub fn draw<C, D, T, I>(frame: &mut Frame<C, D, Hither, T, I>) -> Result<Counts, MatrixError>
where
    C: Target<Color = Rgb565>,
    D: DepthTest,
    T: Tier,
    I: Correction,
{
    let transform = Mat4::perspective(FOCAL, I16F16::ONE, NEAR, FAR)?;
    frame.clear(BACKGROUND);
    Ok(frame.draw(&FLOOR, &transform, &Textured(STONES), &mut []))
}
