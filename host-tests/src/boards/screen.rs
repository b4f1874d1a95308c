//! What a panel shows.

use hither_examples::picture;
use std::path::Path;

/// The pixels of a panel, 8-bit RGB, row after row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Screen {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Three bytes a pixel.
    pub rgb: Vec<u8>,
}

impl Screen {
    /// Whether two screens are equal to the bit.
    ///
    /// # Errors
    ///
    /// How many pixels differ and which is the first, or both sizes.
    pub fn equals(&self, expected: &Self) -> Result<(), String> {
        let (size, other) = ((self.width, self.height), (expected.width, expected.height));
        if size != other || self.rgb.len() != expected.rgb.len() {
            return Err(format!("the panel is {size:?} pixels, the host's picture {other:?}"));
        }
        let pixels = || self.rgb.chunks_exact(3).zip(expected.rgb.chunks_exact(3)).enumerate();
        let mut different = pixels().filter(|(_, (a, b))| a != b).map(|(at, _)| at as u32);
        let Some(first) = different.next() else {
            return Ok(());
        };
        let (x, y) = (first % self.width, first / self.width);
        let count = 1 + different.count();
        Err(format!("{count} of {} pixels differ, the first at ({x}, {y})", pixels().count()))
    }

    /// Writes a PNG, each pixel `times` as large.
    ///
    /// # Errors
    ///
    /// What the file system says, with the path.
    pub fn write_png(&self, path: &Path, times: u32) -> Result<(), String> {
        let (width, height) = (self.width * times, self.height * times);
        let pixel = |x: u32, y: u32| {
            let at = 3 * ((y / times) * self.width + x / times) as usize;
            [self.rgb[at], self.rgb[at + 1], self.rgb[at + 2]]
        };
        let rgb: Vec<u8> =
            (0..height).flat_map(|y| (0..width).flat_map(move |x| pixel(x, y))).collect();
        picture::write_png(path, width, height, &rgb).map_err(|error| error.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn screen(rgb: &[u8]) -> Screen {
        Screen { width: 2, height: 1, rgb: rgb.to_vec() }
    }

    #[test]
    fn differences_are_counted_and_placed() {
        let a = screen(&[1, 2, 3, 4, 5, 6]);
        assert_eq!(a.equals(&a.clone()), Ok(()));
        let error = a.equals(&screen(&[1, 2, 3, 4, 5, 7])).unwrap_err();
        assert_eq!(error, "1 of 2 pixels differ, the first at (1, 0)");
        let tall = Screen { width: 1, height: 2, ..a.clone() };
        assert!(a.equals(&tall).is_err());
    }
}
