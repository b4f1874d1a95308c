//! W5's texture: its words say which texel they are.

use hither::{Rgb565, Texture};

/// Texels along each side.
pub const TEXTURE_SIDE: u32 = 64;

const WORDS: usize = (TEXTURE_SIDE * TEXTURE_SIDE) as usize;

static TEXELS: [u16; WORDS] = texels();

/// `((x ^ y) & 31) << 11 | (x & 63) << 5 | y >> 1 | 1` for the texel in column `x` of row `y`.
pub static TEXTURE: Texture<'static, Rgb565> =
    match Texture::try_new(&TEXELS, TEXTURE_SIDE, TEXTURE_SIDE) {
        Ok(texture) => texture,
        Err(_) => panic!("the texture's size"),
    };

const fn texels() -> [u16; WORDS] {
    let mut texels = [0; WORDS];
    let mut at = 0;
    while at < WORDS {
        let (x, y) = (at % TEXTURE_SIDE as usize, at / TEXTURE_SIDE as usize);
        texels[at] = (((x ^ y) & 31) << 11 | (x & 63) << 5 | y >> 1 | 1) as u16;
        at += 1;
    }
    texels
}

/// Column and row of the texel that a word of the texture is; both from 0 to 63.
#[must_use]
pub const fn texel_of(word: u16) -> (u32, u32) {
    let x = (word >> 5) as u32 & 63;
    let low = (word >> 11) as u32 ^ (x & 31);
    (x, (word as u32 & 16) << 1 | low)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_tells_its_texel() {
        for (at, word) in TEXELS.into_iter().enumerate() {
            assert_eq!(texel_of(word), (at as u32 % TEXTURE_SIDE, at as u32 / TEXTURE_SIDE));
        }
    }
}
