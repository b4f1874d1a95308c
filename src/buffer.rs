//! The size of a lent buffer, checked once, where it is taken.

/// A buffer does not hold the pixels it is said to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum BufferSize {
    /// A side is 0, or the sides' product is over `i32::MAX`.
    Sides {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
    },
    /// Fewer words than pixels.
    Words {
        /// Words that `width x height` pixels take.
        needed: usize,
        /// Words there are.
        got: usize,
    },
}

impl BufferSize {
    /// The sides as coordinates, if `words` words hold that many pixels.
    #[expect(clippy::cast_possible_wrap, reason = "sides whose product is at most i32::MAX")]
    pub(crate) fn check(width: u32, height: u32, words: usize) -> Result<(i32, i32), Self> {
        let pixels = u64::from(width) * u64::from(height);
        let needed = usize::try_from(pixels).unwrap_or(usize::MAX);
        if pixels == 0 || pixels > i32::MAX as u64 {
            Err(Self::Sides { width, height })
        } else if words < needed {
            Err(Self::Words { needed, got: words })
        } else {
            Ok((width as i32, height as i32))
        }
    }
}

impl core::fmt::Display for BufferSize {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Sides { width, height } => {
                write!(f, "a buffer of {width} x {height} pixels: sides are 1 or more")
            }
            Self::Words { needed, got } => {
                write!(f, "a buffer of {needed} pixels in {got} words: a word a pixel is needed")
            }
        }
    }
}

impl core::error::Error for BufferSize {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_and_words_are_checked() {
        assert_eq!(BufferSize::check(3, 2, 6), Ok((3, 2)));
        assert_eq!(BufferSize::check(3, 2, 7), Ok((3, 2)));
        assert_eq!(BufferSize::check(3, 2, 5), Err(BufferSize::Words { needed: 6, got: 5 }));
        for (width, height) in [(0, 1), (1, 0), (u32::MAX, u32::MAX), (1 << 16, 1 << 15)] {
            let error = BufferSize::check(width, height, usize::MAX);
            assert_eq!(error, Err(BufferSize::Sides { width, height }));
        }
    }
}
