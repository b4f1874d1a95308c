//! embedded-graphics' own `MockDisplay`, where a pixel drawn twice or outside is a failure.

use embedded_graphics::mock_display::MockDisplay;
use embedded_graphics::pixelcolor;
use embedded_graphics::prelude::*;
use hither::{
    Angle, ClipVertex, Cull, DepthBuffer, Exact, FaceColors, Flat, Frame, Framebuffer, I16F16,
    Mat4, Mesh, OnDisplay, Quick, Rgb565, Target, Tier, Vertex,
};
use host_tests::oracle::Rng;
use std::f64::consts::TAU;

/// Pixels a side of a `MockDisplay`.
const SIDE: u32 = 64;

type Mock = MockDisplay<pixelcolor::Rgb565>;

/// A vertex at sixteenths of a pixel, which every tier has on its grid.
fn at(x: i32, y: i32, z: I16F16) -> (ClipVertex, [I16F16; 0]) {
    let raw = |v: i32| I16F16::from_bits(v * 128 - 65_536);
    (ClipVertex::new(raw(x), -raw(y), z, I16F16::ONE), [])
}

/// Every pixel is there, in the colour that a framebuffer has.
fn assert_whole(mock: &Mock, buffer: &Framebuffer<'_, Rgb565>, what: &str) {
    for y in 0..SIDE {
        for x in 0..SIDE {
            let drawn = mock.get_pixel(Point::new(x as i32, y as i32)).map(Rgb565::from);
            assert_eq!(drawn, buffer.pixel(x, y), "{x} {y} of {what}");
        }
    }
}

/// Corners of a fan that covers the display, round a point on it.
fn fan(rng: &mut Rng) -> ((i32, i32), Vec<(i32, i32)>) {
    let middle = [(); 2].map(|()| rng.range(0, i64::from(SIDE) * 16) as i32);
    let count = rng.range(5, 40) as usize;
    let corners = (0..count).map(|i| {
        let angle = (i as f64 + rng.fraction()) * TAU / count as f64;
        let radius = rng.between(350.0, 480.0) * 16.0;
        let at = |of: f64, v: i32| v + (of * radius).round() as i32;
        (at(angle.cos(), middle[0]), at(angle.sin(), middle[1]))
    });
    ((middle[0], middle[1]), corners.collect())
}

fn fans<T: Tier>(seed: u64) {
    let mut rng = Rng::new(seed);
    for _ in 0..60 {
        let (middle, corners) = fan(&mut rng);
        let mut mock = Mock::new();
        let frame = Frame::new(OnDisplay::new(&mut mock)).expect("1 to 512");
        let mut frame = frame.with_tier(T::default());
        let mut words = [0; (SIDE * SIDE) as usize];
        let buffer =
            Framebuffer::<Rgb565>::try_new(&mut words, SIDE, SIDE).expect("a word a pixel");
        let mut other = Frame::new(buffer).expect("1 to 512").with_tier(T::default());
        for (i, &first) in corners.iter().enumerate() {
            let second = corners[(i + 1) % corners.len()];
            let triangle = [middle, first, second].map(|(x, y)| at(x, y, I16F16::ZERO));
            let fragment = Flat(Rgb565(i as u16 + 1));
            assert_eq!(
                frame.draw_triangle(triangle, &fragment),
                other.draw_triangle(triangle, &fragment)
            );
        }
        assert_eq!(frame.finish(), Ok(()));
        assert!(other.target().words().iter().all(|word| *word > 0));
        assert_whole(&mock, other.target(), &format!("a fan, seed {seed}, {middle:?} {corners:?}"));
    }
}

#[test]
fn fans_cover_each_pixel_once() {
    fans::<Exact>(71);
    fans::<Quick<4>>(72);
    fans::<Quick<8>>(73);
}

/// A sheet of triangles over all of the display, its corners pushed about.
fn sheet(rng: &mut Rng) -> (Vec<[i16; 3]>, Vec<[u16; 3]>) {
    let cells = rng.range(1, 12) as i32;
    let step = 1100 / cells;
    let mut positions = Vec::new();
    for row in 0..=cells {
        for column in 0..=cells {
            let at = |i: i32, rng: &mut Rng| {
                let off = rng.range(-i64::from(step / 4), i64::from(step / 4)) as i32;
                let beyond = if i == 0 {
                    -step / 2
                } else if i == cells {
                    step / 2
                } else {
                    0
                };
                (i * step - 550 + off + beyond) as i16
            };
            positions.push([at(column, rng), at(row, rng), 0]);
        }
    }
    let across = cells as u16 + 1;
    let mut triangles = Vec::new();
    for row in 0..cells as u16 {
        for column in 0..cells as u16 {
            let a = row * across + column;
            let [b, c, d] = [a + 1, a + across, a + across + 1];
            triangles.extend(if rng.once_in(2) {
                [[a, b, c], [b, d, c]]
            } else {
                [[a, b, d], [a, d, c]]
            });
        }
    }
    (positions, triangles)
}

fn sheets<T: Tier>(seed: u64) {
    let mut rng = Rng::new(seed);
    for _ in 0..60 {
        let (positions, triangles) = sheet(&mut rng);
        let attributes = vec![(); positions.len()];
        // Positions are sixteenths of a pixel from the middle, 512 of them half a side.
        let mesh =
            Mesh::try_new(&positions, 9, &attributes, &triangles).expect("indices are in range");
        let colors: Vec<_> = (1..=triangles.len() as u16).map(Rgb565).collect();
        let colors = FaceColors::new(&colors).expect("a colour a face");
        let mut cache = vec![Vertex::EMPTY; rng.range(0, positions.len() as i64) as usize];
        let mut mock = Mock::new();
        let frame = Frame::new(OnDisplay::new(&mut mock)).expect("1 to 512");
        let mut frame = frame.with_tier(T::default()).with_cull(Cull::Back);
        let counts = frame.draw(&mesh, &Mat4::IDENTITY, &colors, &mut cache);
        assert_eq!(frame.finish(), Ok(()));

        let mut words = [0; (SIDE * SIDE) as usize];
        let buffer =
            Framebuffer::<Rgb565>::try_new(&mut words, SIDE, SIDE).expect("a word a pixel");
        let mut frame = Frame::new(buffer).expect("1 to 512").with_tier(T::default());
        assert_eq!(frame.draw(&mesh, &Mat4::IDENTITY, &colors, &mut cache), counts);
        assert!(frame.target().words().iter().all(|word| *word > 0));
        assert_whole(&mock, frame.target(), &format!("a sheet, seed {seed}, {positions:?}"));
    }
}

#[test]
fn sheets_cover_each_pixel_once() {
    sheets::<Exact>(74);
    sheets::<Quick<4>>(75);
    sheets::<Quick<8>>(76);
}

/// From front to back with depth, what is hidden is not drawn.
#[test]
fn depth_leaves_out_what_is_drawn() {
    let mut rng = Rng::new(77);
    for case in 0..40 {
        let mut mock = Mock::new();
        let mut depth = [0u16; (SIDE * SIDE) as usize];
        let depth = DepthBuffer::try_new(&mut depth, SIDE, SIDE).expect("a word a pixel");
        let frame = Frame::new(OnDisplay::new(&mut mock)).expect("1 to 512");
        let frame = frame.with_hither(crate::triangles::hither());
        let mut frame = frame.with_depth(depth).expect("of one size");
        frame.clear_depth();
        for layer in 0..30 {
            let z = I16F16::from_num(layer) / 32;
            let mut side = || rng.range(-200, 1200) as i32;
            let triangle = [(); 3].map(|()| at(side(), side(), z));
            let _ = frame.draw_triangle(triangle, &Flat(Rgb565(layer)));
        }
        let (middle, corners) = fan(&mut rng);
        for (i, &first) in corners.iter().enumerate() {
            let second = corners[(i + 1) % corners.len()];
            let triangle =
                [middle, first, second].map(|(x, y)| at(x, y, I16F16::from_num(31) / 32));
            let _ = frame.draw_triangle(triangle, &Flat(Rgb565::WHITE));
        }
        assert_eq!(frame.finish(), Ok(()));
        for point in mock.bounding_box().points() {
            assert!(mock.get_pixel(point).is_some(), "{point} of case {case}");
        }
    }
}

/// A cube in perspective, from outside.
#[test]
fn a_convex_mesh_covers_no_pixel_twice() {
    let positions: Vec<[i16; 3]> =
        (0..8).map(|i| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { -1 } else { 1 })).collect();
    let triangles: Vec<[u16; 3]> =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
            .into_iter()
            .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect();
    let cube = Mesh::try_new(&positions, 0, &[(); 8], &triangles).expect("indices are in range");
    let colors: Vec<_> = (1..=12).map(Rgb565).collect();
    let colors = FaceColors::new(&colors).expect("a colour a face");
    let number = I16F16::from_num::<f64>;
    let lens =
        Mat4::perspective(number(2.0), I16F16::ONE, I16F16::ONE, number(16.0)).expect("in range");
    let away = Mat4::translation([I16F16::ZERO, I16F16::ZERO, number(-5.0)]);
    let mut rng = Rng::new(78);
    let mut drawn = 0;
    for _ in 0..100 {
        let mut turn = || Angle(rng.bits() as u16).sin_cos();
        let turned = Mat4::rotation_x(turn()).times(&Mat4::rotation_y(turn())).expect("in range");
        let transform = lens.times(&away.times(&turned).expect("in range")).expect("in range");
        let mut mock = Mock::new();
        let mut frame =
            Frame::new(OnDisplay::new(&mut mock)).expect("1 to 512").with_cull(Cull::Back);
        let mut cache = [Vertex::EMPTY; 8];
        let counts = frame.draw(&cube, &transform, &colors, &mut cache);
        assert_eq!(frame.finish(), Ok(()));
        let mut words = [0; (SIDE * SIDE) as usize];
        let buffer =
            Framebuffer::<Rgb565>::try_new(&mut words, SIDE, SIDE).expect("a word a pixel");
        let mut frame = Frame::new(buffer).expect("1 to 512").with_cull(Cull::Back);
        assert_eq!(frame.draw(&cube, &transform, &colors, &mut cache), counts);
        for point in mock.bounding_box().points() {
            let there = frame.target().pixel(point.x as u32, point.y as u32);
            let here = mock.get_pixel(point).map_or(Rgb565::BLACK, Rgb565::from);
            assert_eq!(Some(here), there, "{point}");
            drawn += usize::from(here != Rgb565::BLACK);
        }
    }
    assert!(drawn > 50_000, "{drawn} pixels");
}

/// A display of embedded-graphics is a target like another.
#[test]
fn its_size_is_the_displays() {
    assert_eq!(OnDisplay::new(&mut Mock::new()).size(), (SIDE, SIDE));
}
