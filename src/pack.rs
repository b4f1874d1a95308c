//! Pixels of less than a byte, as panels take them: packed where a row or a band is sent.
//!
//! A pixel is a byte while it is drawn, so that no two share a word ([`Gray4`](crate::Gray4), [`Binary`](crate::Binary)); what
//! is sent is a half or an eighth of that. Packing takes a shift and an OR a pixel.

/// Two pixels of 4 bits a byte, the left one in the high half: what OLED controllers of 16 greys take (SSD1322,
/// SSD1327, SSD0323), some of them with their nibbles remapped. A last pixel
/// without another has the low half 0.
///
/// `pixels` are [`Gray4`](crate::Gray4) words; of each the low 4 bits count. Returned is what was written, `pixels.len() / 2`
/// bytes, rounded up. A band of rows of an even length is as good as a row.
///
/// # Errors
///
/// [`PackedSize`] where `packed` is shorter; then nothing is written.
///
/// ```
/// let mut packed = [0; 4];
/// assert_eq!(hither::pack_gray4(&[15, 0, 1, 2, 3], &mut packed)?, [0xf0, 0x12, 0x30]);
/// # Ok::<(), hither::PackedSize>(())
/// ```
pub fn pack_gray4<'a>(pixels: &[u8], packed: &'a mut [u8]) -> Result<&'a [u8], PackedSize> {
    let packed = sized(packed, pixels.len().div_ceil(2))?;
    for (byte, pair) in packed.iter_mut().zip(pixels.chunks(2)) {
        let (left, right) = (pair.first(), pair.get(1));
        let low = |pixel: Option<&u8>| pixel.map_or(0, |&pixel| pixel & 15);
        *byte = low(left) << 4 | low(right);
    }
    Ok(packed)
}

/// Eight pixels of a row a byte, the left one in the high bit: what e-paper controllers take (SSD1608,
/// SSD1680, UC8151). The last byte of a row that is not of whole bytes is filled with 0.
///
/// `pixels` are [`Binary`](crate::Binary) words; of each the low bit counts. Returned is what was written, `pixels.len() / 8`
/// bytes, rounded up.
///
/// # Errors
///
/// [`PackedSize`] where `packed` is shorter; then nothing is written.
///
/// ```
/// let mut packed = [0; 2];
/// let row = [1, 0, 0, 0, 0, 0, 1, 1, /* next byte */ 0, 1];
/// assert_eq!(hither::pack_rows(&row, &mut packed)?, [0x83, 0x40]);
/// # Ok::<(), hither::PackedSize>(())
/// ```
pub fn pack_rows<'a>(pixels: &[u8], packed: &'a mut [u8]) -> Result<&'a [u8], PackedSize> {
    let packed = sized(packed, pixels.len().div_ceil(8))?;
    for (byte, eight) in packed.iter_mut().zip(pixels.chunks(8)) {
        *byte = 0;
        let mut bit = 7;
        for pixel in eight {
            *byte |= (pixel & 1) << bit;
            bit -= i32::from(bit > 0);
        }
    }
    Ok(packed)
}

/// Eight rows a page, a byte a column of it, the top row in bit 0: what SSD1306, SH1106 and ST7565 panels take.
///
/// `pixels` are [`Binary`](crate::Binary) words, rows of `width` from the top; of each the low bit counts. Returned is what was
/// written, `width` bytes for each eight rows, one page after the other. Rows that are missing of the last page are dark, and
/// so is the rest of a row that is not whole.
///
/// # Errors
///
/// [`PackedSize`] where `packed` is shorter; then nothing is written.
///
/// ```
/// let mut page = [0; 3];
/// // Two rows: the left column is lit in both, the right one in the second.
/// assert_eq!(hither::pack_pages(&[1, 0, 0, 1, 0, 1], 3, &mut page)?, [3, 0, 2]);
/// # Ok::<(), hither::PackedSize>(())
/// ```
pub fn pack_pages<'a>(
    pixels: &[u8],
    width: usize,
    packed: &'a mut [u8],
) -> Result<&'a [u8], PackedSize> {
    let width = width.max(1);
    let page = width.saturating_mul(8);
    let packed = sized(packed, pixels.len().div_ceil(page).saturating_mul(width))?;
    packed.fill(0);
    for (columns, rows) in packed.chunks_mut(width).zip(pixels.chunks(page)) {
        let mut bit = 0;
        for row in rows.chunks(width) {
            for (column, pixel) in columns.iter_mut().zip(row) {
                *column |= (pixel & 1) << bit;
            }
            bit += i32::from(bit < 7);
        }
    }
    Ok(packed)
}

/// The first bytes of some, if there are as many.
fn sized(packed: &mut [u8], needed: usize) -> Result<&mut [u8], PackedSize> {
    let got = packed.len();
    packed.get_mut(..needed).ok_or(PackedSize { needed, got })
}

/// Packed pixels do not fit where they are to go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PackedSize {
    /// Bytes that the pixels take.
    pub needed: usize,
    /// Bytes there are.
    pub got: usize,
}

impl core::fmt::Display for PackedSize {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(
            f,
            "packed pixels of {} bytes in {} bytes: as many are needed",
            self.needed, self.got
        )
    }
}

impl core::error::Error for PackedSize {}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;
    use std::vec;
    use std::vec::Vec;

    /// Bytes whose upper bits are no part of a pixel.
    fn pixels(count: usize) -> Vec<u8> {
        (0..count).map(|i| (i as u8).wrapping_mul(0x9d) ^ (i >> 3) as u8).collect()
    }

    #[test]
    fn every_pixel_is_where_it_belongs() {
        for count in 0..70 {
            let pixels = pixels(count);
            let mut packed = [0xaa; 80];
            let halves = pack_gray4(&pixels, &mut packed).unwrap().to_vec();
            assert_eq!(halves.len(), count.div_ceil(2));
            for i in 0..2 * halves.len() {
                let got = halves[i / 2] >> (4 - 4 * (i % 2)) & 15;
                assert_eq!(got, pixels.get(i).map_or(0, |pixel| pixel % 16), "{i} of {count}");
            }
            assert!(packed[halves.len()..].iter().all(|&byte| byte == 0xaa));
            let bits = pack_rows(&pixels, &mut packed).unwrap().to_vec();
            assert_eq!(bits.len(), count.div_ceil(8));
            for i in 0..8 * bits.len() {
                let got = bits[i / 8] >> (7 - i % 8) & 1;
                assert_eq!(got, pixels.get(i).map_or(0, |pixel| pixel % 2), "{i} of {count}");
            }
            for width in 1..20 {
                let pages = count.div_ceil(8 * width);
                let mut packed = vec![0xaa; pages * width + 3];
                let bytes = pack_pages(&pixels, width, &mut packed).unwrap().to_vec();
                assert_eq!(bytes.len(), pages * width);
                for y in 0..8 * pages {
                    for x in 0..width {
                        let got = bytes[y / 8 * width + x] >> (y % 8) & 1;
                        let pixel = pixels.get(y * width + x).map_or(0, |pixel| pixel % 2);
                        assert_eq!(got, pixel, "{x}, {y} of {count} in rows of {width}");
                    }
                }
                assert_eq!(packed[pages * width..], [0xaa; 3]);
            }
        }
    }

    #[test]
    fn too_few_bytes_are_told() {
        let mut packed = [7; 2];
        let error = pack_gray4(&[0; 5], &mut packed).unwrap_err();
        assert_eq!(error.to_string(), "packed pixels of 3 bytes in 2 bytes: as many are needed");
        let few = PackedSize { needed: 3, got: 2 };
        assert_eq!(pack_rows(&[0; 17], &mut packed), Err(few));
        assert_eq!(pack_pages(&[0; 1], 3, &mut packed), Err(few));
        assert_eq!(packed, [7; 2]);
        assert_eq!(pack_pages(&[1], 0, &mut packed), Ok(&[1][..]));
        assert_eq!(pack_pages(&[], usize::MAX, &mut []), Ok(&[][..]));
    }
}
