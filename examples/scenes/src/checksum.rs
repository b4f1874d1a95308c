//! One number for a picture, so that a board can say what it drew.

/// FNV-1a of bytes, 32 bits (Fowler, Noll, Vo; RFC 9923).
///
/// Of a framebuffer take the bytes in memory order, as a display gets them
/// ([`Framebuffer::bytes`](hither::Framebuffer::bytes)): they are the same on every machine.
///
/// ```
/// assert_eq!(hither_scenes::checksum::checksum(b"foobar"), 0xbf9c_f968);
/// ```
#[must_use]
pub const fn checksum(bytes: &[u8]) -> u32 {
    let mut sum = EMPTY;
    let mut rest = bytes;
    while let Some((&byte, others)) = rest.split_first() {
        sum = with(sum, byte);
        rest = others;
    }
    sum
}

/// The same of 16-bit words by value, each as its low byte, then its high one, whatever their order
/// in memory.
#[must_use]
pub fn checksum_of_words(words: &[u16]) -> u32 {
    words.iter().flat_map(|word| word.to_le_bytes()).fold(EMPTY, with)
}

/// The checksum of no bytes.
const EMPTY: u32 = 0x811c_9dc5;

/// A checksum with one more byte. The product wraps by definition.
const fn with(sum: u32, byte: u8) -> u32 {
    (sum ^ byte as u32).wrapping_mul(0x0100_0193)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_vectors() {
        assert_eq!(checksum(b""), 0x811c_9dc5);
        assert_eq!(checksum(b"a"), 0xe40c_292c);
        assert_eq!(checksum(b"foobar"), 0xbf9c_f968);
        assert_eq!(checksum_of_words(&[0x6f66, 0x626f, 0x7261]), 0xbf9c_f968);
    }
}
