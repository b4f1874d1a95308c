//! One number for a picture, so that a board can say what it drew.

/// A running FNV-1a of bytes, 32 bits (Fowler, Noll, Vo; RFC 9923).
///
/// Of a framebuffer take the bytes in memory order, as a display gets them
/// ([`Framebuffer::bytes`](hither::Framebuffer::bytes)): they are the same on every machine.
///
/// ```
/// use hither_scenes::checksum::Checksum;
///
/// assert_eq!(Checksum::new().with_bytes(b"foo").with_bytes(b"bar").value(), 0xbf9c_f968);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Checksum(u32);

impl Checksum {
    /// Of no bytes.
    #[must_use]
    pub const fn new() -> Self {
        Self(0x811c_9dc5)
    }

    /// The number.
    #[must_use]
    pub const fn value(self) -> u32 {
        self.0
    }

    /// With more bytes.
    #[must_use]
    pub fn with_bytes(self, bytes: &[u8]) -> Self {
        bytes.iter().copied().fold(self, Self::with_byte)
    }

    /// With more 16-bit words by value, each as its low byte, then its high one, whatever their order in memory.
    #[must_use]
    pub fn with_words(self, words: &[u16]) -> Self {
        words.iter().flat_map(|word| word.to_le_bytes()).fold(self, Self::with_byte)
    }

    /// With one more byte. The product wraps by definition.
    const fn with_byte(self, byte: u8) -> Self {
        Self((self.0 ^ byte as u32).wrapping_mul(0x0100_0193))
    }
}

impl Default for Checksum {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_vectors() {
        let sum = |bytes: &[u8]| Checksum::new().with_bytes(bytes).value();
        assert_eq!(sum(b""), 0x811c_9dc5);
        assert_eq!(sum(b"a"), 0xe40c_292c);
        assert_eq!(sum(b"foobar"), 0xbf9c_f968);
        assert_eq!(Checksum::new().with_words(&[0x6f66, 0x626f, 0x7261]).value(), 0xbf9c_f968);
    }
}
