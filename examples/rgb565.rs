//! RGB565 words to and from 8-bit channels, as displays do it.

/// The 8-bit red, green and blue of an RGB565 word (native byte order).
///
/// The top bits fill the bits below, as in the ST7789 and the ILI9341: 0 stays 0, the brightest becomes 255.
///
/// ```
/// use hither_examples::rgb565::expand;
///
/// assert_eq!(expand(0xffff), [255, 255, 255]);
/// assert_eq!(expand(0b10000_000001_00001), [132, 4, 8]);
/// ```
#[must_use]
pub fn expand(word: u16) -> [u8; 3] {
    // The mask leaves 5 and 6 bits: the casts drop nothing.
    let (red, green, blue) = (word >> 11, word >> 5 & 0x3f, word & 0x1f);
    [(red << 3 | red >> 2) as u8, (green << 2 | green >> 4) as u8, (blue << 3 | blue >> 2) as u8]
}

/// The 8-bit channels of many RGB565 words (native byte order), three bytes for each, in order.
#[must_use]
pub fn expand_all(words: &[u16]) -> Vec<u8> {
    words.iter().flat_map(|&word| expand(word)).collect()
}

/// The RGB565 word (native byte order) whose expansion is closest to 8-bit red, green and blue.
///
/// ```
/// use hither_examples::rgb565::pack;
///
/// assert_eq!(pack([255, 0, 0]), 0xf800);
/// ```
#[must_use]
pub fn pack(rgb: [u8; 3]) -> u16 {
    pack_unit(rgb.map(|channel| f64::from(channel) / 255.0))
}

/// The RGB565 word (native byte order) that is closest to channels from 0 to 1; others are clamped, NaN is 0.
///
/// Each channel is rounded to nearest, halves up: `round(31 r)`, `round(63 g)`, `round(31 b)`.
#[must_use]
pub fn pack_unit([red, green, blue]: [f64; 3]) -> u16 {
    // `as` saturates, so that a channel below 0 or NaN is 0.
    let quantize = |channel: f64, most: f64| (channel.min(1.0) * most).round() as u16;
    quantize(red, 31.0) << 11 | quantize(green, 63.0) << 5 | quantize(blue, 31.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_survives_expansion() {
        for word in 0..=u16::MAX {
            assert_eq!(pack(expand(word)), word);
        }
    }

    #[test]
    fn packing_is_the_nearest_of_all() {
        for value in 0..=255_u8 {
            let [red, green, _] = expand(pack([value, value, value])).map(|c| c.abs_diff(value));
            let nearest = |bits: u16, shift: u16| {
                (0..1 << bits)
                    .map(|v| expand(v << shift).into_iter().max().unwrap_or(0))
                    .map(|v| v.abs_diff(value))
                    .min()
            };
            assert_eq!(Some(red), nearest(5, 11), "red {value}");
            assert_eq!(Some(green), nearest(6, 5), "green {value}");
        }
    }

    #[test]
    fn units_round_and_clamp() {
        assert_eq!(pack_unit([1.0, 1.0, 1.0]), 0xffff);
        assert_eq!(pack_unit([2.0, -1.0, f64::NEG_INFINITY]), 0xf800);
        assert_eq!(pack_unit([f64::INFINITY, 0.0, 0.0]), 0xf800);
        assert_eq!(pack_unit([0.49 / 31.0, 0.51 / 63.0, 1.5 / 31.0]), 0x0022);
    }

    #[test]
    fn many_words_keep_their_order() {
        assert_eq!(expand_all(&[0xf800, 0x001f]), [255, 0, 0, 0, 0, 255]);
    }
}
