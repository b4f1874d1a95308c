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
    let mut sum: u32 = 0x811c_9dc5;
    let mut rest = bytes;
    while let Some((&byte, others)) = rest.split_first() {
        // The product wraps by definition.
        sum = (sum ^ byte as u32).wrapping_mul(0x0100_0193);
        rest = others;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_vectors() {
        assert_eq!(checksum(b""), 0x811c_9dc5);
        assert_eq!(checksum(b"a"), 0xe40c_292c);
        assert_eq!(checksum(b"foobar"), 0xbf9c_f968);
    }
}
