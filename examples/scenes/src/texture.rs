//! A ground texture in flash: a checker of two stones, computed by the compiler.
//!
//! It repeats without a seam in both directions. Contrast within a tile is low, so that nearest sampling of a distant
//! ground does not glitter.

/// Texels along each side; a power of two, so that a coordinate wraps with a mask.
pub const SIZE: usize = 64;

/// The ground: RGB565 words in native byte order, row after row, 8 KiB.
pub static GROUND: [u16; SIZE * SIZE] = ground();

/// Texels along each side of a tile, its joint included.
const TILE: usize = 16;

/// The two stones, 8-bit RGB: sand and slate.
const STONES: [[i32; 3]; 2] = [[188, 170, 138], [96, 106, 120]];

/// What joints, edges to the light and edges in the shade add to a stone, in 8-bit steps.
const JOINT: i32 = -46;
const LIT_EDGE: i32 = 16;
const SHADED_EDGE: i32 = -18;

const _: () = assert!(SIZE.is_power_of_two(), "a texture coordinate wraps with a mask");
const _: () = assert!(SIZE % (2 * TILE) == 0, "the checker does not repeat without a seam");

const fn ground() -> [u16; SIZE * SIZE] {
    let mut texels = [0; SIZE * SIZE];
    let mut at = 0;
    while at < SIZE * SIZE {
        texels[at] = texel(at % SIZE, at / SIZE);
        at += 1;
    }
    texels
}

/// One texel, RGB565.
const fn texel(x: usize, y: usize) -> u16 {
    let (column, row) = (x / TILE, y / TILE);
    let stone = STONES[(column + row) % 2];
    // Each tile is a little lighter or darker than its neighbours, up to 10 steps.
    let tint = (hash(column, row, 1) % 21) as i32 - 10;
    // Veins: two octaves, the finer one weaker, -24 to 24 steps together. A third would be below a step of RGB565.
    let veins = noise(x, y, 16) / 8 + noise(x, y, 8) / 16;
    let light = tint + veins + edge(x % TILE, y % TILE);
    // Light tilts the hue a little: the veins are warm.
    rgb565([stone[0] + light + veins / 4, stone[1] + light, stone[2] + light - veins / 4])
}

/// The bevel and the joint of a tile, in 8-bit steps, at a place within the tile.
const fn edge(x: usize, y: usize) -> i32 {
    if x == TILE - 1 || y == TILE - 1 {
        JOINT
    } else if x == 0 || y == 0 {
        LIT_EDGE
    } else if x == TILE - 2 || y == TILE - 2 {
        SHADED_EDGE
    } else {
        0
    }
}

/// Value noise that repeats with the texture, -128 to 127: linear between random values `cell` texels apart (8 or 16).
const fn noise(x: usize, y: usize, cell: usize) -> i32 {
    let n = SIZE / cell;
    let (left, top) = (x / cell, y / cell);
    let (right, bottom) = ((left + 1) % n, (top + 1) % n);
    let (part_x, part_y) = (x % cell, y % cell);
    let above = mix(corner(left, top, n), corner(right, top, n), part_x, cell);
    let below = mix(corner(left, bottom, n), corner(right, bottom, n), part_x, cell);
    mix(above, below, part_y, cell)
}

/// The random value of a lattice point, -128 to 127; lattices are `n` by `n` points.
const fn corner(column: usize, row: usize, n: usize) -> i32 {
    // The lattice of 4 x 4 comes first.
    let start = if n == 4 { 0 } else { 16 };
    RANDOM[start + row * n + column]
}

/// Random values from -128 to 127 for lattices of 4 x 4 and 8 x 8 points.
const RANDOM: [i32; 16 + 64] = {
    let mut values = [0; 16 + 64];
    let mut at = 0;
    while at < values.len() {
        values[at] = (hash(at, 0, 2) >> 24) as i32 - 128;
        at += 1;
    }
    values
};

/// Between `a` and `b`, `part` of `whole` of the way.
const fn mix(a: i32, b: i32, part: usize, whole: usize) -> i32 {
    a + (b - a) * part as i32 / whole as i32
}

/// A hash of a place: multiply and fold (constants of Murmur3's finalizer, A. Appleby, 2008).
const fn hash(column: usize, row: usize, seed: u32) -> u32 {
    let mut h = seed.wrapping_mul(0x9E37_79B9) ^ ((column as u32) << 16) ^ row as u32;
    h = (h ^ (h >> 16)).wrapping_mul(0x85EB_CA6B);
    h = (h ^ (h >> 13)).wrapping_mul(0xC2B2_AE35);
    h ^ (h >> 16)
}

/// The RGB565 word of 8-bit channels, each clamped to 0..=255 and floored to its bits.
const fn rgb565([red, green, blue]: [i32; 3]) -> u16 {
    (clamp_to_u8(red) as u16 >> 3) << 11
        | (clamp_to_u8(green) as u16 >> 2) << 5
        | clamp_to_u8(blue) as u16 >> 3
}

const fn clamp_to_u8(value: i32) -> u8 {
    if value < 0 {
        0
    } else if value > 255 {
        255
    } else {
        value as u8
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Green of a texel, in 6-bit steps: the channel that is closest to lightness.
    fn green(x: usize, y: usize) -> i32 {
        i32::from(GROUND[y % SIZE * SIZE + x % SIZE] >> 5 & 0x3f)
    }

    #[test]
    fn texels_are_row_after_row() {
        assert_eq!(GROUND[3 * SIZE + 5], texel(5, 3));
    }

    #[test]
    fn tiles_alternate_and_joints_are_dark() {
        for row in 0..SIZE / TILE {
            for column in 0..SIZE / TILE {
                let (x, y) = (column * TILE + TILE / 2, row * TILE + TILE / 2);
                let is_sand = (column + row) % 2 == 0;
                assert_eq!(green(x, y) > 34, is_sand, "tile {column} {row}");
                let joint = green(column * TILE + TILE - 1, y);
                assert!(joint < green(x, y), "joint right of tile {column} {row}");
            }
        }
    }

    #[test]
    fn noise_has_no_step_and_no_seam() {
        for cell in [8, 16] {
            let largest_step = 255 / cell as i32 + 2;
            for y in 0..SIZE {
                for x in 0..SIZE {
                    let here = noise(x, y, cell);
                    let right = noise((x + 1) % SIZE, y, cell);
                    let down = noise(x, (y + 1) % SIZE, cell);
                    assert!((-128..=127).contains(&here));
                    assert!((here - right).abs() <= largest_step, "{x} {y} {cell}");
                    assert!((here - down).abs() <= largest_step, "{x} {y} {cell}");
                }
            }
        }
    }

    #[test]
    fn colours_clamp() {
        assert_eq!(rgb565([-1, 300, 0]), 0x07e0);
        assert_eq!(rgb565([255, 255, 255]), 0xffff);
        assert_eq!(rgb565([8, 4, 8]), 0x0821);
    }
}
