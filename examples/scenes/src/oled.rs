//! The teapot on two small OLED panels, 128 x 64 in 4-bit grey and 96 x 16 in black and white, as
//! the bytes that their memory takes.
//!
//! Both are drawn through buffers that the caller lends, with the vertex cache lent apart: how much
//! of it there is changes the time, not the picture.

use crate::SceneError;
use crate::luminance::Luminance;
use crate::packing::{PAGE_ROWS, dither_page, pack_gray4};
use crate::spinning_teapot::{CULL, HITHER, Moment, draw_onto, draw_teapot};
use hither::{
    DepthBuffer, Frame, Framebuffer, Gray8, I16F16, PerspectiveEvery, Quick, Vertex, Viewport,
};

/// The tier and the correction of both pictures.
const KNOBS: (Quick<8>, PerspectiveEvery<16>) = (Quick, PerspectiveEvery);

/// What a vertex cache is made of.
pub type CacheEntry = Vertex<Quick<8>, 3>;

/// Frames a turn that the boards draw, from number 0.
pub const FRAMES: u32 = 48;

/// The last frame of a turn: what a board's panel shows in the end.
pub const LAST: Moment = Moment { number: FRAMES - 1, frames: FRAMES };

/// Pixels across the grey panel.
pub const GRAY_WIDTH: u32 = 128;

/// Pixels down the grey panel.
pub const GRAY_HEIGHT: u32 = 64;

/// Pixels of the grey panel.
const GRAY_PIXELS: usize = (GRAY_WIDTH * GRAY_HEIGHT) as usize;

/// The grey panel's memory, row after row from the top: two pixels a byte, the left one in the
/// high bits.
pub type GrayPicture = [u8; GRAY_PIXELS / 2];

/// What the grey panel's picture is drawn through: 28 KiB.
#[derive(Debug)]
pub struct GrayBuffers {
    gray: [u8; GRAY_PIXELS],
    depth: [u16; GRAY_PIXELS],
    packed: GrayPicture,
}

impl GrayBuffers {
    /// All zero.
    pub const EMPTY: Self =
        Self { gray: [0; GRAY_PIXELS], depth: [0; GRAY_PIXELS], packed: [0; GRAY_PIXELS / 2] };
}

/// Draws the whole scene in grey; the bytes for the panel.
///
/// # Errors
///
/// None in practice: the sizes are constants that fit.
pub fn gray_128x64<'a>(
    moment: Moment,
    lent: &'a mut GrayBuffers,
    cache: &mut [CacheEntry],
) -> Result<&'a GrayPicture, SceneError> {
    let GrayBuffers { gray, depth, packed } = lent;
    let viewport = Viewport::new(GRAY_WIDTH, GRAY_HEIGHT)?;
    let target = Framebuffer::<Gray8>::try_new(gray, GRAY_WIDTH, GRAY_HEIGHT)?;
    draw_onto(Luminance(target), viewport, KNOBS, depth, moment, cache)?;
    pack_gray4(gray, packed);
    Ok(packed)
}

/// Pixels across the black and white panel.
pub const MONO_WIDTH: u32 = 96;

/// Pixels down the black and white panel.
pub const MONO_HEIGHT: u32 = 16;

/// Pages of the black and white panel.
const PAGES: usize = MONO_HEIGHT as usize / PAGE_ROWS;

/// The black and white panel's pages, the upper one first: a byte a column, its top row in bit 0.
pub type MonoPicture = [[u8; MONO_WIDTH as usize]; PAGES];

/// Moments of the turn, a quarter apart, that the black and white panel shows side by side.
const VIEWS: u32 = 4;

/// Pixels across a view, a multiple of the dither's four: the pattern goes on between views.
const VIEW_WIDTH: u32 = MONO_WIDTH / VIEWS;

/// Pixels of a view.
const VIEW_PIXELS: usize = (VIEW_WIDTH * MONO_HEIGHT) as usize;

const _: () = assert!(VIEW_WIDTH % 4 == 0 && MONO_WIDTH % VIEWS == 0, "the dither has a seam");

/// Focal length of a view in half picture heights: the teapot from spout to handle is 24 pixels.
const VIEW_FOCAL: I16F16 = I16F16::lit("4.5");

/// What the black and white panel's picture is drawn through, view after view: 1344 bytes.
#[derive(Debug)]
pub struct MonoBuffers {
    gray: [u8; VIEW_PIXELS],
    depth: [u16; VIEW_PIXELS],
    pages: MonoPicture,
}

impl MonoBuffers {
    /// All zero.
    pub const EMPTY: Self = Self {
        gray: [0; VIEW_PIXELS],
        depth: [0; VIEW_PIXELS],
        pages: [[0; MONO_WIDTH as usize]; PAGES],
    };
}

/// Draws the teapot without its ground at four moments, a quarter of a turn apart, dithered; the
/// pages for the panel.
///
/// With the ground, or smaller, the dither drowns it; one large view leaves most of the panel dark.
///
/// # Errors
///
/// None in practice: the sizes are constants that fit.
pub fn mono_96x16<'a>(
    moment: Moment,
    lent: &'a mut MonoBuffers,
    cache: &mut [CacheEntry],
) -> Result<&'a MonoPicture, SceneError> {
    let MonoBuffers { gray, depth, pages } = lent;
    for view in 0..VIEWS {
        let number = moment.number.wrapping_add(view * (moment.frames / VIEWS));
        draw_view(Moment { number, ..moment }, gray, depth, cache)?;
        let left = (view * VIEW_WIDTH) as usize;
        let rows = gray.chunks_exact(VIEW_WIDTH as usize * PAGE_ROWS);
        for (page, rows) in pages.iter_mut().zip(rows) {
            dither_page(rows, &mut page[left..left + VIEW_WIDTH as usize]);
        }
    }
    Ok(pages)
}

/// Draws the teapot alone, bright enough for a dither.
fn draw_view(
    moment: Moment,
    gray: &mut [u8; VIEW_PIXELS],
    depth: &mut [u16; VIEW_PIXELS],
    cache: &mut [CacheEntry],
) -> Result<(), SceneError> {
    let viewport = Viewport::new(VIEW_WIDTH, MONO_HEIGHT)?;
    let target = Framebuffer::<Gray8>::try_new(gray, VIEW_WIDTH, MONO_HEIGHT)?;
    let depth = DepthBuffer::try_new(depth, VIEW_WIDTH, MONO_HEIGHT)?;
    let mut frame = Frame::with_viewport(Luminance(target), viewport)
        .with_tier(KNOBS.0)
        .with_correction(KNOBS.1)
        .with_hither(HITHER)
        .with_depth(depth)?
        .with_cull(CULL);
    draw_teapot(&mut frame, moment, VIEW_FOCAL, cache)?;
    for luminance in gray {
        *luminance = brightened(*luminance);
    }
    Ok(())
}

/// A quarter of the range and a quarter of itself brighter, up to white; black stays black.
///
/// So the teapot's own shade lights at least one pixel in four: enough that the spout and the
/// handle, a pixel wide, are seen.
const fn brightened(luminance: u8) -> u8 {
    if luminance == 0 { 0 } else { luminance.saturating_add(64 + luminance / 4) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spinning_teapot::VERTEX_COUNT;

    const MOMENT: Moment = Moment { number: 5, frames: 48 };

    #[test]
    fn the_grey_picture_is_a_lit_scene_under_a_dark_sky() {
        let mut lent = GrayBuffers::EMPTY;
        let picture = *gray_128x64(MOMENT, &mut lent, &mut []).unwrap();
        let pixel = |x: usize, y: usize| picture[(y * 128 + x) / 2] >> (4 * (1 - x % 2)) & 15;
        let mut seen = 0_u32;
        for at in 0..GRAY_PIXELS {
            seen |= 1 << pixel(at % 128, at / 128);
        }
        assert!(seen.count_ones() >= 10, "{seen:b}");
        assert!(pixel(0, 0) <= 1 && pixel(127, 0) <= 1);
        assert!(pixel(60, 30) >= 6, "the teapot's lit side is {}", pixel(60, 30));
        let mut cache = [CacheEntry::EMPTY; VERTEX_COUNT];
        assert_eq!(*gray_128x64(MOMENT, &mut lent, &mut cache).unwrap(), picture);
    }

    #[test]
    fn the_views_are_a_quarter_of_a_turn_apart() {
        let mut lent = MonoBuffers::EMPTY;
        let now = *mono_96x16(MOMENT, &mut lent, &mut []).unwrap();
        let quarter = Moment { number: MOMENT.number + 12, ..MOMENT };
        let later =
            *mono_96x16(quarter, &mut lent, &mut [CacheEntry::EMPTY; VERTEX_COUNT]).unwrap();
        for page in 0..PAGES {
            assert_eq!(now[page][24..], later[page][..72]);
            assert_eq!(now[page][..24], later[page][72..]);
        }
        assert_ne!(now, later);
    }

    #[test]
    fn each_view_is_a_teapot_on_black() {
        let mut lent = MonoBuffers::EMPTY;
        for number in 0..48 {
            let pages = mono_96x16(Moment { number, frames: 48 }, &mut lent, &mut []).unwrap();
            for view in 0..4 {
                let columns = pages.iter().flat_map(|page| &page[24 * view..][..24]);
                let lit: u32 = columns.map(|column| column.count_ones()).sum();
                assert!((80..200).contains(&lit), "view {view} of {number} has {lit} lit pixels");
                assert!((24 * view..24 * view + 24).all(|x| pages[0][x] & 1 == 0), "the top row");
            }
        }
    }

    #[test]
    fn brightening_is_monotonous_and_keeps_black() {
        assert_eq!([0, 1, 64, 153, 154, 255].map(brightened), [0, 65, 144, 255, 255, 255]);
    }
}
