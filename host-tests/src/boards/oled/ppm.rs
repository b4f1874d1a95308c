//! QEMU's picture of a panel: a binary PPM in which every pixel of the panel is a block.

use crate::boards::screen::Screen;

/// A binary PPM (P6) of 8 bits a channel, without comments, as QEMU writes it.
///
/// # Errors
///
/// What is wrong with it.
pub fn parse(file: &[u8]) -> Result<Screen, String> {
    let mut rest = file;
    let mut word = || {
        let end = rest.iter().position(u8::is_ascii_whitespace)?;
        let (word, after) = rest.split_at(end);
        rest = &after[1..];
        std::str::from_utf8(word).ok()
    };
    let header = (word(), word(), word(), word());
    let (Some("P6"), Some(width), Some(height), Some("255")) = header else {
        return Err(format!("not a binary PPM of 8 bits a channel: it starts {header:?}"));
    };
    let side = |text: &str| text.parse::<u32>().map_err(|error| format!("side {text}: {error}"));
    let (width, height) = (side(width)?, side(height)?);
    // As u128 nothing overflows, however large the sides.
    let needed = 3 * u128::from(width) * u128::from(height);
    if rest.len() as u128 != needed {
        let got = rest.len();
        return Err(format!("{width} x {height} pixels take {needed} bytes, the PPM has {got}"));
    }
    Ok(Screen { width, height, rgb: rest.to_vec() })
}

/// The panel of a picture in which each of its pixels is `times` as wide and high.
///
/// # Errors
///
/// Both sizes where they do not fit, or where a block is not of one colour.
pub fn reduce(picture: &Screen, times: u32, size: (u32, u32)) -> Result<Screen, String> {
    let (width, height) = size;
    if (picture.width, picture.height) != (width * times, height * times) {
        let got = (picture.width, picture.height);
        return Err(format!("a panel of {size:?} pixels, {times} times as large, is not {got:?}"));
    }
    let pixel = |x: u32, y: u32| {
        let at = 3 * (y * picture.width + x) as usize;
        &picture.rgb[at..at + 3]
    };
    let mut rgb = Vec::with_capacity(3 * (width * height) as usize);
    for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
        let first = pixel(x * times, y * times);
        let mut block = (0..times * times).map(|i| (x * times + i % times, y * times + i / times));
        if !block.all(|(x, y)| pixel(x, y) == first) {
            return Err(format!("the block of pixel ({x}, {y}) is not of one colour"));
        }
        rgb.extend_from_slice(first);
    }
    Ok(Screen { width, height, rgb })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_read() {
        let screen = parse(b"P6\n2 1\n255\nabc\n\n\n").unwrap();
        assert_eq!(screen, Screen { width: 2, height: 1, rgb: b"abc\n\n\n".to_vec() });
    }

    #[test]
    fn what_is_not_a_picture_is_said() {
        for file in [&b""[..], b"P6", b"P5\n2 1\n255\nabcdef", b"P6\n2 1\n65535\nabcdef"] {
            assert!(parse(file).unwrap_err().starts_with("not a binary PPM"));
        }
        let error = parse(b"P6\n2 1\n255\nabcde").unwrap_err();
        assert_eq!(error, "2 x 1 pixels take 6 bytes, the PPM has 5");
        assert!(parse(b"P6\nx 1\n255\n").unwrap_err().starts_with("side x"));
        assert!(parse(b"P6\n4294967295 4294967295\n255\n").is_err());
    }

    /// A picture of rows of letters, each a grey.
    fn letters(rows: &[&str]) -> Screen {
        let rgb = rows.concat().bytes().flat_map(|letter| [letter; 3]).collect();
        Screen { width: rows[0].len() as u32, height: rows.len() as u32, rgb }
    }

    #[test]
    fn blocks_become_pixels() {
        let large = letters(&["aabbcc", "aabbcc", "ddeeff", "ddeeff"]);
        assert_eq!(reduce(&large, 2, (3, 2)), Ok(letters(&["abc", "def"])));
        assert_eq!(reduce(&large, 1, (6, 4)), Ok(large));
    }

    #[test]
    fn blocks_of_two_colours_and_other_sizes_are_errors() {
        let torn = letters(&["aabb", "aabx"]);
        let error = reduce(&torn, 2, (2, 1)).unwrap_err();
        assert_eq!(error, "the block of pixel (1, 0) is not of one colour");
        let error = reduce(&torn, 2, (2, 2)).unwrap_err();
        assert_eq!(error, "a panel of (2, 2) pixels, 2 times as large, is not (4, 2)");
    }
}
