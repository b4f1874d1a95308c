//! What a firmware can write: types it can name, keep in a static, send, and take apart again.

use hither::{
    Affine, Balance, Correction, Cull, DepthBuffer, DepthFrame, DisplayFrame, DividedBy, Exact,
    Fidelity, Frame, Framebuffer, Hither, I16F16, Newton, NoDepth, NoHither, Packed, Perspective,
    PerspectiveEvery, Quick, Rgb565, Rgb565Be, Table, Target, Vertex, Wide, Width,
};
use static_cell::StaticCell;
use std::any::TypeId;

const SIDE: u32 = 16;
const PIXELS: usize = (SIDE * SIDE) as usize;

/// A firmware's state: the frame is a field.
struct App {
    frame: DepthFrame<'static>,
    cache: [Vertex<Quick<8>, 3>; 8],
    turns: u16,
}

static COLOR: StaticCell<[u16; PIXELS]> = StaticCell::new();
static DEPTH: StaticCell<[u16; PIXELS]> = StaticCell::new();
static APP: StaticCell<App> = StaticCell::new();

fn is_send<T: Send>(_: &T) {}

#[test]
fn a_frame_lives_in_a_static_and_can_be_sent() {
    let color = Framebuffer::try_new(COLOR.init([0; PIXELS]), SIDE, SIDE).unwrap();
    let depth = DepthBuffer::try_new(DEPTH.init([0; PIXELS]), SIDE, SIDE).unwrap();
    let hither = Hither::new(I16F16::ONE).unwrap();
    let frame = Frame::new(color).unwrap().with_hither(hither).with_depth(depth).unwrap();
    let app: &'static mut App = APP.init(App { frame, cache: [Vertex::EMPTY; 8], turns: 0 });
    is_send(app);
    app.frame.clear(Rgb565::RED);
    app.turns += 1;
    assert_eq!((app.cache.len(), app.turns), (8, 1));
    let drawn = std::thread::spawn(move || app.frame.target().pixel(3, 3)).join().unwrap();
    assert_eq!(drawn, Some(Rgb565::RED));
}

#[test]
fn new_is_the_preset_for_most_scenes_and_another_is_one_call() {
    let mut words = [0; PIXELS];
    let frame = Frame::new(Framebuffer::try_new(&mut words, SIDE, SIDE).unwrap()).unwrap();
    let frame: DisplayFrame<'_> = frame;
    let frame: Frame<_, NoDepth, NoHither, Quick<8>, Packed<PerspectiveEvery<8>>> = frame;
    let frame: Frame<_, NoDepth, NoHither, Exact, Perspective> = frame.with_preset(Fidelity);
    let frame: DisplayFrame<'_> = frame.with_preset(Balance);
    let quick = frame.with_tier(Quick::<4>).with_correction(PerspectiveEvery::<16>);
    let quick: Frame<Framebuffer<'_, Rgb565Be>, NoDepth, _, Quick<4>, PerspectiveEvery<16>> = quick;
    let hither = Hither::new(I16F16::ONE).unwrap();
    let affine: Frame<_, NoDepth, Hither, Quick<8>, Affine> =
        quick.with_hither(hither).with_tier(Quick::<8>).with_correction(Affine);
    let _ = affine.with_cull(Cull::Back);
}

/// What a correction says of itself.
fn knobs<C: Correction<Reciprocal: 'static>>() -> (i32, bool, Width, TypeId) {
    (C::EVERY, C::AFFINE, C::WIDTH, TypeId::of::<C::Reciprocal>())
}

#[test]
fn knobs_wrap_each_other_in_any_order() {
    let outer = knobs::<Packed<DividedBy<PerspectiveEvery<16>, Table>>>();
    assert_eq!(outer, knobs::<DividedBy<Packed<PerspectiveEvery<16>>, Table>>());
    assert_eq!(outer, (16, false, Width::Packed, TypeId::of::<Table>()));
    assert_eq!(knobs::<Wide<Packed<Affine>>>().2, Width::Long);
    assert_eq!(knobs::<Packed<Affine>>(), (1, true, Width::Packed, TypeId::of::<Newton<2>>()));
}

#[test]
fn buffers_come_back() {
    let (mut words, mut depth) = ([0; PIXELS], [0u32; PIXELS]);
    let color = Framebuffer::<Rgb565Be>::try_new(&mut words, SIDE, SIDE).unwrap();
    let mut frame = Frame::new(color)
        .unwrap()
        .with_hither(Hither::new(I16F16::ONE).unwrap())
        .with_depth(DepthBuffer::try_new(&mut depth, SIDE, SIDE).unwrap())
        .unwrap();
    frame.clear(Rgb565::BLACK);
    // Text over it, while the frame lives on.
    frame.target_mut().fill(2, 3, 4, Rgb565::WHITE);
    assert_eq!(frame.target().bytes().len(), 2 * PIXELS);
    let (color, depth) = frame.into_parts();
    assert_eq!(color.into_words().iter().filter(|w| **w == 0xffff).count(), 4);
    assert!(depth.into_words().iter().all(|d| *d == u32::MAX));
}

#[test]
fn a_size_that_does_not_fit_is_an_error() {
    let mut words = [0; 600];
    let long = Framebuffer::<Rgb565>::try_new(&mut words, 600, 1).unwrap();
    let error = Frame::new(long).unwrap_err();
    assert_eq!(error.to_string(), "a viewport of 600 x 1 pixels: sides are 1 to 512");
    let (mut words, mut depth) = ([0; 12], [0u16; 12]);
    let frame = Frame::new(Framebuffer::<Rgb565>::try_new(&mut words, 3, 4).unwrap())
        .unwrap()
        .with_hither(Hither::new(I16F16::ONE).unwrap());
    let error = frame.with_depth(DepthBuffer::try_new(&mut depth, 4, 3).unwrap()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "a depth buffer of 4 x 3 pixels for a target of 3 x 4: the same are needed"
    );
}

#[test]
fn a_vertex_takes_what_the_documentation_says() {
    // 28 bytes and 4 a varying; 8 a clip plane.
    assert_eq!(size_of::<Vertex<Exact>>(), 28);
    assert_eq!(size_of::<Vertex<Exact, 3>>(), 40);
    assert_eq!(size_of::<Vertex<Quick<4>, 2>>(), 36);
    assert_eq!(size_of::<Vertex<Quick<8>, 1, 2>>(), 48);
}
