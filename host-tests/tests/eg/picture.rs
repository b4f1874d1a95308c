//! A picture on a display is the one in a framebuffer, to the bit, wherever the display's box is.

use crate::display::Panel;
use crate::triangles::{draw, hither};
use embedded_graphics::pixelcolor::{self, PixelColor};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use hither::{
    Affine, AsPixelColor, Balance, Binary, Correction, DepthBuffer, DepthTest, DisplayColor, Exact,
    Flat, Fragment, Frame, Framebuffer, FromUnit, Gouraud, Gray4, Gray8, Hither, I16F16, OnDisplay,
    Packed, Perspective, PerspectiveEvery, PixelFormat, Preset, Quick, Rect, Rgb565, Rgb565Be,
    Rgb888, Target, Texture, Textured, Tier, Viewport, ViewportSize,
};
use host_tests::oracle::Rng;
use std::fmt::Debug;

/// Boxes of displays: at the origin and not, small, wide, at the ends of the coordinates.
const BOXES: [Rectangle; 7] = [
    Rectangle::new(Point::new(0, 0), Size::new(64, 64)),
    Rectangle::new(Point::new(-20, -7), Size::new(60, 41)),
    Rectangle::new(Point::new(13, 1000), Size::new(131, 90)),
    Rectangle::new(Point::new(-500, 3), Size::new(300, 20)),
    Rectangle::new(Point::new(5, -5), Size::new(1, 70)),
    Rectangle::new(Point::new(i32::MAX - 49, i32::MIN), Size::new(50, 40)),
    Rectangle::new(Point::new(i32::MIN, i32::MAX - 39), Size::new(70, 40)),
];

/// What is drawn, on whatever target.
trait Drawing<C: Copy> {
    fn on<T, D, R, I>(&self, frame: &mut Frame<T, D, Hither, R, I>, seed: u64)
    where
        T: Target<Color = C>,
        D: DepthTest,
        R: Tier,
        I: Correction;
}

/// A number of triangles with a fragment of `N` varyings.
struct Triangles<S, const N: usize>(S);

impl<C: Copy, S: Fragment<C, N>, const N: usize> Drawing<C> for Triangles<S, N> {
    fn on<T, D, R, I>(&self, frame: &mut Frame<T, D, Hither, R, I>, seed: u64)
    where
        T: Target<Color = C>,
        D: DepthTest,
        R: Tier,
        I: Correction,
    {
        assert_eq!(draw(frame, &self.0, seed).total(), 24);
    }
}

/// Clears and draws on a target, with the tier and correction, and `BITS` of depth.
fn render<T: Target, R: Tier, I: Correction, const BITS: u32>(
    (target, viewport): (T, Viewport),
    (tier, correction): (R, I),
    background: T::Color,
    drawing: &impl Drawing<T::Color>,
    seed: u64,
) -> T {
    let (width, height) = target.size();
    let frame = Frame::with_viewport(target, viewport);
    let mut frame = frame.with_tier(tier).with_correction(correction).with_hither(hither());
    let pixels = (width * height) as usize;
    macro_rules! with_depth {
        ($word:ty) => {{
            let mut words: Vec<$word> = vec![0; pixels];
            let depth = DepthBuffer::try_new(&mut words, width, height).expect("a word a pixel");
            let mut frame = frame.with_depth(depth).expect("of one size");
            frame.clear(background);
            drawing.on(&mut frame, seed);
            frame.into_parts().0
        }};
    }
    match BITS {
        16 => with_depth!(u16),
        32 => with_depth!(u32),
        _ => {
            frame.clear(background);
            drawing.on(&mut frame, seed);
            frame.into_parts().0
        }
    }
}

/// Draws on a display that takes `K`, and into a framebuffer of what is drawn for that, and compares; how many pixels are not
/// the background.
fn compare<F, K, R: Tier, I: Correction, const BITS: u32>(
    area: Rectangle,
    viewport: Viewport,
    knobs: (R, I),
    drawing: &impl Drawing<F::Color>,
    seed: u64,
) -> usize
where
    F: PixelFormat<Color: FromUnit>,
    K: DisplayColor<Drawn = F::Color> + Debug,
{
    let background = F::Color::from_unit([0.1, 0.2, 0.3].map(I16F16::from_num));
    let mut panel = Panel::<K>::new(area);
    let target = (OnDisplay::new(&mut panel), viewport);
    let target = render::<_, _, _, BITS>(target, knobs, background, drawing, seed);
    assert_eq!(target.finish(), Ok(()));

    let Size { width, height } = area.size;
    let mut words = vec![F::encode(background); (width * height) as usize];
    let buffer = Framebuffer::<F>::try_new(&mut words, width, height).expect("a word a pixel");
    let target = (buffer, viewport);
    let buffer = render::<_, _, _, BITS>(target, knobs, background, drawing, seed);
    let mut drawn = 0;
    for y in 0..height {
        for x in 0..width {
            let expected = K::from(buffer.pixel(x, y).expect("inside"));
            let place = || format!("{x} {y} of {area:?}, {BITS} bits of depth, seed {seed}");
            assert_eq!(panel.pixel(x, y), Some(expected), "{}", place());
            drawn += usize::from(expected != background.into());
        }
    }
    drawn
}

/// A format whose colours are embedded-graphics'.
trait Format: PixelFormat<Color: FromUnit + Default + AsPixelColor<PixelColor = Self::Shown>> {
    type Shown: DisplayColor<Drawn = Self::Color> + Debug;
}

impl<F, K> Format for F
where
    F: PixelFormat<Color: FromUnit + Default + AsPixelColor<PixelColor = K>>,
    K: DisplayColor<Drawn = F::Color> + Debug,
{
    type Shown = K;
}

/// All boxes and fragments with a tier, a correction and a depth.
fn all<F: Format, R: Tier, I: Correction, const BITS: u32>(seed: u64) {
    let mut rng = Rng::new(seed);
    let mut drawn = 0;
    for area in BOXES {
        let Size { width, height } = area.size;
        let whole = Viewport::new(width, height).expect("1 to 512");
        // And a picture of which the display shows a part.
        let large = Viewport::new(200, 160).expect("1 to 512").with_origin(-70, -60);
        let large = large.with_scissor(Rect { x0: 80, y0: 50, x1: 190, y1: 150 });
        for viewport in [whole, large] {
            drawn += fragments::<F, R, I, BITS>(area, viewport, &mut rng);
        }
    }
    assert!(drawn > 50_000, "{drawn} pixels");
}

fn fragments<F: Format, R: Tier, I: Correction, const BITS: u32>(
    area: Rectangle,
    viewport: Viewport,
    rng: &mut Rng,
) -> usize {
    let mut color = || F::Color::from_unit([(); 3].map(|()| I16F16::from_num(rng.fraction())));
    let flat = Triangles(Flat(color()));
    let words: Vec<_> = (0..16 * 8).map(|_| F::encode(color())).collect();
    let texture = Texture::<F>::try_new(&words, 16, 8).expect("a word a texel");
    let textured = Triangles(Textured(texture));
    let seed = rng.bits();
    let knobs = (R::default(), I::default());
    compare::<F, F::Shown, _, _, BITS>(area, viewport, knobs, &flat, seed)
        + compare::<F, F::Shown, _, _, BITS>(area, viewport, knobs, &Triangles(Gouraud), seed)
        + compare::<F, F::Shown, _, _, BITS>(area, viewport, knobs, &textured, seed)
}

type BalanceTier = <Balance as Preset>::Tier;
type BalanceCorrection = <Balance as Preset>::Correction;

#[test]
fn rgb565() {
    all::<Rgb565, BalanceTier, BalanceCorrection, 0>(1);
    all::<Rgb565, BalanceTier, BalanceCorrection, 16>(2);
    all::<Rgb565, Exact, Perspective, 0>(3);
    all::<Rgb565, Exact, Perspective, 16>(4);
    all::<Rgb565, Exact, PerspectiveEvery<16>, 32>(5);
    all::<Rgb565, Quick<4>, Packed<PerspectiveEvery<32>>, 0>(6);
    all::<Rgb565, Quick<8>, Affine, 16>(7);
    all::<Rgb565, Quick<8>, Perspective, 32>(8);
}

#[test]
fn rgb565_big_endian() {
    all::<Rgb565Be, BalanceTier, BalanceCorrection, 0>(11);
    all::<Rgb565Be, BalanceTier, BalanceCorrection, 16>(12);
}

#[test]
fn rgb888() {
    all::<Rgb888, BalanceTier, BalanceCorrection, 0>(21);
    all::<Rgb888, BalanceTier, BalanceCorrection, 16>(22);
    all::<Rgb888, Exact, Perspective, 16>(23);
}

#[test]
fn gray8() {
    all::<Gray8, BalanceTier, BalanceCorrection, 0>(31);
    all::<Gray8, BalanceTier, BalanceCorrection, 16>(32);
    all::<Gray8, Exact, Perspective, 16>(33);
}

/// Displays of colours that are not ours show the nearest to what is drawn for them.
#[test]
fn colours_of_other_displays() {
    fn check<F, K>(seed: u64)
    where
        F: PixelFormat<Color: FromUnit>,
        K: DisplayColor<Drawn = F::Color> + PixelColor + Debug,
    {
        let viewport = Viewport::new(60, 41).expect("1 to 512");
        let knobs = (Quick::<8>, Perspective);
        let drawing = Triangles(Gouraud);
        let drawn = compare::<F, K, _, _, 16>(BOXES[1], viewport, knobs, &drawing, seed);
        assert!(drawn > 200, "{drawn} pixels");
    }
    check::<Rgb565, pixelcolor::Bgr565>(11);
    check::<Rgb565, pixelcolor::Rgb555>(12);
    check::<Rgb565, pixelcolor::Bgr555>(13);
    check::<Rgb888, pixelcolor::Bgr888>(14);
    check::<Rgb888, pixelcolor::Rgb666>(15);
    check::<Rgb888, pixelcolor::Bgr666>(16);
    check::<Gray4, pixelcolor::Gray4>(17);
    check::<Gray8, pixelcolor::Gray2>(18);
    check::<Binary, pixelcolor::BinaryColor>(19);
}

#[test]
fn an_empty_box_shows_nothing() {
    for size in [Size::new(0, 0), Size::new(0, 9), Size::new(9, 0)] {
        let mut panel = Panel::<pixelcolor::Rgb565>::new(Rectangle::new(Point::new(4, -4), size));
        let error = Frame::new(OnDisplay::new(&mut panel)).err();
        assert_eq!(error, Some(ViewportSize { width: size.width, height: size.height }));
        let viewport = Viewport::new(40, 30).expect("1 to 512");
        let frame = Frame::with_viewport(OnDisplay::new(&mut panel), viewport);
        let mut frame = frame.with_hither(hither());
        let _ = draw(&mut frame, &Gouraud, 21);
        assert_eq!(frame.finish(), Ok(()));
        assert_eq!(panel.calls, []);
    }
}

/// A display of more than 512 pixels a side: no frame over all of it, but one over a part.
#[test]
fn a_large_display_shows_a_viewport() {
    let area = Rectangle::new(Point::new(-300, 2), Size::new(600, 520));
    let mut panel = Panel::<pixelcolor::Rgb565>::new(area);
    let error = Frame::new(OnDisplay::new(&mut panel)).err();
    assert_eq!(error, Some(ViewportSize { width: 600, height: 520 }));
    let viewport = Viewport::new(512, 400).expect("1 to 512").with_origin(88, 120);
    let knobs = (Quick::<8>, Perspective);
    let drawing = Triangles(Gouraud);
    let drawn =
        compare::<Rgb565, pixelcolor::Rgb565, _, _, 16>(area, viewport, knobs, &drawing, 22);
    assert!(drawn > 10_000, "{drawn} pixels");
}

/// embedded-graphics' own adapters over a framebuffer are displays too, and the other way round.
#[test]
fn both_directions_at_once() {
    let (width, height) = (90, 70);
    let area = Rectangle::new(Point::new(13, 8), Size::new(60, 50));
    let (mut words, mut expected) = ([0x1234; 90 * 70], [0x1234; 90 * 70]);
    let mut wide = [0; 60 * 50];

    let mut buffer = Framebuffer::<Rgb565>::try_new(&mut words, width, height).expect("enough");
    let mut clipped = buffer.clipped(&area);
    let mut frame =
        Frame::new(OnDisplay::new(&mut clipped)).expect("1 to 512").with_hither(hither());
    let _ = draw(&mut frame, &Gouraud, 201);
    let Ok(()) = frame.finish();

    let buffer = Framebuffer::<Rgb565>::try_new(&mut expected, width, height).expect("enough");
    let viewport = Viewport::new(60, 50).expect("1 to 512").with_origin(13, 8);
    let mut frame = Frame::with_viewport(buffer, viewport).with_hither(hither());
    let _ = draw(&mut frame, &Gouraud, 201);
    assert!(words == expected);

    let mut buffer = Framebuffer::<Rgb888>::try_new(&mut wide, 60, 50).expect("a word a pixel");
    let mut converted = buffer.color_converted::<pixelcolor::Rgb565>();
    let mut frame =
        Frame::new(OnDisplay::new(&mut converted)).expect("1 to 512").with_hither(hither());
    frame.clear(Rgb565(0x1234));
    let _ = draw(&mut frame, &Gouraud, 201);
    let Ok(()) = frame.finish();
    for point in buffer.bounding_box().points() {
        let at = point + area.top_left;
        let narrow = pixelcolor::Rgb565::from(Rgb565(expected[(at.y * 90 + at.x) as usize]));
        let shown = buffer.pixel(point.x as u32, point.y as u32).map(pixelcolor::Rgb888::from);
        assert_eq!(shown, Some(narrow.into()), "{point}");
    }
}
