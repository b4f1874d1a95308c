use super::*;

fn encoded(color: png::ColorType, depth: png::BitDepth, size: [u32; 2], bytes: &[u8]) -> Vec<u8> {
    let mut png = Vec::new();
    let mut encoder = png::Encoder::new(&mut png, size[0], size[1]);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if color == png::ColorType::Indexed {
        encoder.set_palette(vec![0, 0, 0, 255, 255, 255, 255, 0, 0, 0, 0, 255]);
    }
    encoder.write_header().unwrap().write_image_data(bytes).unwrap();
    png
}

#[test]
fn every_colour_type_is_read() {
    use png::BitDepth::{Eight, Sixteen, Two};
    use png::ColorType::{Grayscale, GrayscaleAlpha, Indexed, Rgb, Rgba};
    for (color, depth, bytes, words, transparent) in [
        (Rgb, Eight, &[255, 0, 0, 0, 255, 0][..], [0xf800, 0x07e0], false),
        (Rgba, Eight, &[0, 0, 255, 255, 0, 0, 255, 7], [0x001f, 0x001f], true),
        (Grayscale, Eight, &[0, 255], [0, 0xffff], false),
        (GrayscaleAlpha, Eight, &[0, 255, 255, 255], [0, 0xffff], false),
        (Rgb, Sixteen, &[255, 255, 0, 0, 0, 0, 0, 0, 255, 255, 0, 0], [0xf800, 0x07e0], false),
        (Indexed, Two, &[0b1011_0000], [0xf800, 0x001f], false),
    ] {
        let image = Image::read_png(&encoded(color, depth, [2, 1], bytes)).unwrap();
        assert_eq!(
            (image.width, image.height, image.transparent),
            (2, 1, transparent),
            "{color:?}"
        );
        assert_eq!(image.words, words, "{color:?}");
        assert_eq!(image.texture().size(), (2, 1));
    }
}

#[test]
fn channels_are_rounded_to_nearest() {
    for value in 0..=255_u8 {
        let nearest = |most: f64| (f64::from(value) / 255.0 * most).round() as u16;
        let word = pack([value; 3]);
        assert_eq!(
            [word >> 11, word >> 5 & 63, word & 31],
            [nearest(31.0), nearest(63.0), nearest(31.0)],
            "{value}"
        );
    }
}

#[test]
fn what_is_no_texture_is_an_error() {
    let png = encoded(png::ColorType::Grayscale, png::BitDepth::Eight, [4097, 1], &[0; 4097]);
    let message = Image::read_png(&png).unwrap_err().to_string();
    assert_eq!(message, "a picture of 4097 x 1 pixels: sides of a texture are up to 4096");
    let png = encoded(png::ColorType::Grayscale, png::BitDepth::Eight, [64, 64], &[0; 4096]);
    for bytes in [&b""[..], b"v 0 0 0", &png[..20], &png[..60]] {
        let message = Image::read_png(bytes).unwrap_err().to_string();
        assert!(message.starts_with("not a PNG that can be read: "), "{message}");
    }
}
