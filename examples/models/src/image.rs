//! A texture from a PNG: RGB565 words.

use std::fmt;
use std::io::Cursor;

use hither::{Rgb565, Texture};

/// A picture as a texture stores it: rows from the top, a word a texel, in native byte order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Texels of a row, up to 4096.
    pub width: u32,
    /// Rows, up to 4096.
    pub height: u32,
    /// `width * height` words.
    pub words: Vec<u16>,
    /// Whether some texel was not opaque: opacity is left out.
    pub transparent: bool,
}

/// A picture cannot be read.
#[derive(Debug)]
#[non_exhaustive]
pub enum ImageError {
    /// It is no PNG, or one that is broken.
    Png(png::DecodingError),
    /// A side is over 4096 texels.
    Size {
        /// Texels of a row.
        width: u32,
        /// Rows.
        height: u32,
    },
}

impl fmt::Display for ImageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Png(error) => write!(f, "not a PNG that can be read: {error}"),
            Self::Size { width, height } => {
                let most = Image::MAX_SIDE;
                write!(
                    f,
                    "a picture of {width} x {height} pixels: sides of a texture are up to {most}"
                )
            }
        }
    }
}

impl std::error::Error for ImageError {}

impl From<png::DecodingError> for ImageError {
    fn from(error: png::DecodingError) -> Self {
        Self::Png(error)
    }
}

impl Image {
    /// The largest side, in texels.
    pub const MAX_SIDE: u32 = Texture::<Rgb565>::MAX_SIDE;

    /// Reads a PNG of any colour type; each channel is rounded to nearest.
    ///
    /// # Errors
    ///
    /// [`ImageError`] where it is none, or too large.
    pub fn read_png(bytes: &[u8]) -> Result<Self, ImageError> {
        let mut decoder = png::Decoder::new(Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::STRIP_16);
        let mut reader = decoder.read_info()?;
        let (width, height) = reader.info().size();
        if width > Self::MAX_SIDE || height > Self::MAX_SIDE {
            return Err(ImageError::Size { width, height });
        }
        let (color, _) = reader.output_color_type();
        // At most 2^12 2^12 2^2 bytes.
        let mut bytes = vec![0; reader.output_buffer_size().unwrap_or(0)];
        let frame = reader.next_frame(&mut bytes)?;
        let bytes = bytes.get(..frame.buffer_size()).unwrap_or_default();
        let pixels = bytes.chunks_exact(color.samples()).map(|pixel| match *pixel {
            [r, g, b, a] => ([r, g, b], a),
            [r, g, b] => ([r, g, b], 255),
            [y, a] => ([y; 3], a),
            [y] => ([y; 3], 255),
            _ => ([0; 3], 255),
        });
        let transparent = pixels.clone().any(|(_, a)| a < 255);
        let words = pixels.map(|(rgb, _)| pack(rgb)).collect();
        Ok(Self { width, height, words, transparent })
    }

    /// As hither samples it.
    ///
    /// # Panics
    ///
    /// Where the words are not as many as the sides say.
    #[must_use]
    pub fn texture(&self) -> Texture<'_, Rgb565> {
        Texture::try_new(&self.words, self.width, self.height).expect("words as the sides say")
    }
}

/// Each channel of 8 bits to the nearest of 5, 6 and 5.
fn pack([r, g, b]: [u8; 3]) -> u16 {
    let nearest = |channel: u8, most: u16| ((u16::from(channel) * most + 127) / 255) as u8;
    Rgb565::new(nearest(r, 31), nearest(g, 63), nearest(b, 31)).0
}

#[cfg(test)]
mod tests;
