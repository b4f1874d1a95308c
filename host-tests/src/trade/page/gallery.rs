//! Pictures within the page: equal ones are stored once, each as a class whose background it is, so that they show without
//! scripts and are decoded only when they do.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use std::collections::HashMap;

/// How much larger a difference is shown.
pub(super) const MAGNIFIED: u8 = 8;

/// Pictures that were seen, and the style sheet that shows them.
#[derive(Debug, Default)]
pub(super) struct Gallery {
    seen: HashMap<(u32, Vec<u8>), usize>,
    style: String,
}

impl Gallery {
    /// The number of a picture of 8-bit RGB: its class is `i` and that.
    pub(super) fn add(&mut self, width: u32, height: u32, pixels: Vec<u8>) -> usize {
        let next = self.seen.len();
        let key = (width, pixels);
        if let Some(&known) = self.seen.get(&key) {
            return known;
        }
        let data = STANDARD.encode(packed(width, height, &key.1));
        self.style += &format!(".i{next}{{background-image:url(data:image/png;base64,{data})}}\n");
        self.seen.insert(key, next);
        next
    }

    /// A rule a picture.
    pub(super) fn style(&self) -> &str {
        &self.style
    }
}

/// What differs, [`MAGNIFIED`] times and at most white.
pub(super) fn difference(drawn: &[u8], ideal: &[u8]) -> Vec<u8> {
    let magnified = |(a, b): (&u8, &u8)| a.abs_diff(*b).saturating_mul(MAGNIFIED);
    drawn.iter().zip(ideal).map(magnified).collect()
}

/// The smallest of some ways to store a picture as PNG.
fn packed(width: u32, height: u32, pixels: &[u8]) -> Vec<u8> {
    let size = (width, height);
    let plain = |filter| png_of(size, pixels, png::ColorType::Rgb, None, filter);
    let mut ways = vec![plain(png::Filter::NoFilter), plain(png::Filter::Adaptive)];
    if let Some((palette, indices)) = indexed(pixels) {
        let (color, filter) = (png::ColorType::Indexed, png::Filter::NoFilter);
        ways.push(png_of(size, &indices, color, Some(palette), filter));
    }
    ways.into_iter().min_by_key(Vec::len).unwrap_or_default()
}

/// A palette and each pixel's index, where there are few enough colours.
fn indexed(pixels: &[u8]) -> Option<(Vec<u8>, Vec<u8>)> {
    let mut palette = Vec::new();
    let mut known: HashMap<&[u8], u8> = HashMap::new();
    let mut indices = Vec::with_capacity(pixels.len() / 3);
    for pixel in pixels.chunks_exact(3) {
        let index = match known.get(pixel) {
            Some(&index) => index,
            None => {
                let next = u8::try_from(known.len()).ok()?;
                known.insert(pixel, next);
                palette.extend_from_slice(pixel);
                next
            }
        };
        indices.push(index);
    }
    Some((palette, indices))
}

/// Into memory, where nothing but a picture of another size than its pixels can fail.
fn png_of(
    (width, height): (u32, u32),
    data: &[u8],
    color: png::ColorType,
    palette: Option<Vec<u8>>,
    filter: png::Filter,
) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(color);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    encoder.set_filter(filter);
    if let Some(palette) = palette {
        encoder.set_palette(palette);
    }
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(data));
    written.expect("a picture has as many pixels as it says");
    file
}

#[cfg(test)]
mod tests {
    use super::{Gallery, difference, packed};

    /// Of a PNG, as RGB.
    fn read(file: &[u8]) -> Vec<u8> {
        let mut decoder = png::Decoder::new(std::io::Cursor::new(file));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("it fits")];
        reader.next_frame(&mut pixels).expect("pixels");
        pixels
    }

    #[test]
    fn pictures_are_stored_without_loss() {
        let few: Vec<u8> = (0..300_u32).map(|i| (i % 7) as u8).collect();
        let many: Vec<u8> = (0..60_000_u32).map(|i| (i.wrapping_mul(i) >> 7) as u8).collect();
        assert_eq!(read(&packed(10, 10, &few)), few);
        assert_eq!(read(&packed(200, 100, &many)), many);
    }

    #[test]
    fn equal_pictures_are_stored_once() {
        let mut gallery = Gallery::default();
        let numbers = [0, 9, 0, 9, 1].map(|level| gallery.add(2, 2, vec![level; 12]));
        assert_eq!(numbers, [0, 1, 0, 1, 2]);
        assert_eq!(gallery.style().lines().count(), 3);
    }

    #[test]
    fn differences_are_magnified_up_to_white() {
        assert_eq!(difference(&[10, 0, 200, 7], &[12, 255, 168, 7]), [16, 255, 255, 0]);
    }
}
