//! Luminances as the memory of small OLED panels wants them: two pixels a byte, or eight dithered
//! ones.

/// 8-bit luminances as 4-bit ones, two a byte, the left one in the high bits: a row of an SSD0323
/// with its nibbles remapped (command A0h, bit 1).
///
/// Rounded to nearest, so that 0 is 0 and 255 is 15. What does not pair, and what has no byte of
/// `packed` to go to, is left out.
pub fn pack_gray4(gray: &[u8], packed: &mut [u8]) {
    for (byte, pair) in packed.iter_mut().zip(gray.chunks_exact(2)) {
        *byte = to_gray4(pair[0]) << 4 | to_gray4(pair[1]);
    }
}

/// The nearest of 16 levels, which are 17 apart.
const fn to_gray4(gray: u8) -> u8 {
    ((gray as u16 + 8) / 17) as u8
}

/// Rows of a page of an SSD0303: a byte is a column of them, the top one in bit 0.
pub const PAGE_ROWS: usize = 8;

/// The order in which the pixels of a 4 x 4 tile light up (Bayer, 1973).
const BAYER: [[u8; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];

/// The least luminance that lights a pixel: 8 for the first of a tile, 248 for the last.
///
/// They are the middles of 16 equal steps, so that a tile of one luminance is within 8 of it on
/// average, black stays black and white white.
const fn threshold(x: usize, y: usize) -> u8 {
    BAYER[y % 4][x % 4] * 16 + 8
}

/// Dithers eight rows of luminances into a page, a byte a column.
///
/// `gray` is the page's rows from the top, each as long as `page`; it starts on a multiple of four
/// columns of the panel, so that the pattern goes on without a seam. Rows that are missing are
/// dark.
pub fn dither_page(gray: &[u8], page: &mut [u8]) {
    let width = page.len().max(1);
    page.fill(0);
    for (y, row) in gray.chunks_exact(width).take(PAGE_ROWS).enumerate() {
        for (x, (column, gray)) in page.iter_mut().zip(row).enumerate() {
            *column |= u8::from(*gray >= threshold(x, y)) << y;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_bits_are_the_nearest() {
        for gray in 0..=255_u8 {
            let shown = i32::from(to_gray4(gray)) * 17;
            assert!((shown - i32::from(gray)).abs() <= 8, "{gray} shows as {shown}");
        }
    }

    #[test]
    fn the_left_pixel_is_in_the_high_bits() {
        let mut packed = [0xee; 3];
        pack_gray4(&[255, 0, 8, 9], &mut packed);
        assert_eq!(packed, [0xf0, 0x01, 0xee]);
        pack_gray4(&[255, 255, 255], &mut packed);
        assert_eq!(packed, [0xff, 0x01, 0xee]);
        pack_gray4(&[17, 34, 51, 68], &mut packed[..1]);
        assert_eq!(packed, [0x12, 0x01, 0xee]);
    }

    #[test]
    fn the_order_is_a_permutation_with_neighbours_far_apart() {
        let mut seen = 0_u32;
        for order in BAYER.iter().flatten() {
            seen |= 1 << order;
        }
        assert_eq!(seen, 0xffff);
        for at in 0..16 {
            let [here, right] = [at, at + 1].map(|x| i32::from(BAYER[at / 4][x % 4]));
            assert!((here - right).abs() >= 4, "{here} beside {right}");
        }
    }

    #[test]
    fn the_mean_of_a_dithered_luminance_is_within_8_of_it() {
        for gray in 0..=255_u8 {
            let mut page = [0; 8];
            dither_page(&[gray; 64], &mut page);
            let lit: u32 = page.iter().map(|column| column.count_ones()).sum();
            let mean = f64::from(lit) * 255.0 / 64.0;
            assert!((mean - f64::from(gray)).abs() < 8.0, "{gray} has a mean of {mean}");
        }
    }

    #[test]
    fn black_stays_black_and_white_white() {
        let mut page = [0x55; 12];
        dither_page(&[0; 96], &mut page);
        assert_eq!(page, [0; 12]);
        dither_page(&[255; 96], &mut page);
        assert_eq!(page, [0xff; 12]);
    }

    #[test]
    fn a_bit_is_a_row_and_a_byte_a_column() {
        let mut gray = [0; 8 * 5];
        (gray[5 * 2 + 1], gray[5 * 7 + 4]) = (255, 255);
        let mut page = [0; 5];
        dither_page(&gray, &mut page);
        assert_eq!(page, [0, 1 << 2, 0, 0, 1 << 7]);
        // Six rows, and none for no columns.
        dither_page(&[255; 30], &mut page);
        assert_eq!(page, [0x3f; 5]);
        dither_page(&gray, &mut []);
    }
}
