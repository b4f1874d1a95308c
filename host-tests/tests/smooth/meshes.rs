//! Silhouettes of meshes.

use super::{Shares, alphas};
use hither::{
    Angle, ClipVertex, Counts, Cull, DepthBuffer, Exact, Frame, Hither, I16F16, Mat4, Mesh,
    MeshError, ModelPosition, Quick, StoredPosition, Tier, Translucent, Vertex, VertexStage,
    Viewport,
};
use hither_scenes::{spinning_teapot, torus};
use host_tests::record::{Mark, Record};

/// The side of the picture, and how many samples a pixel has a side in the reference.
const SIDE: u32 = 128;
const SAMPLES: u32 = 4;

/// Positions only.
struct Bare(Mat4);

impl<A> VertexStage<A, 0> for Bare {
    fn vertex(&self, position: ModelPosition, _: &A) -> (ClipVertex, [I16F16; 0]) {
        (self.0.transform(position), [])
    }
}

/// How far silhouettes of a mesh are off the samples', and those of hard edges.
fn silhouettes<T: Tier, P: StoredPosition, A>(
    mesh: &Mesh<'_, P, A>,
    stage: &Bare,
    hither: Hither,
    cull: Cull,
) -> [f64; 2] {
    let count = mesh.triangles().len();
    let mut neighbours = vec![[0; 3]; count];
    mesh.neighbours(&mut neighbours).unwrap();
    let fine = SIDE * SAMPLES;
    let mut words = vec![u16::MAX; (fine * fine) as usize];
    let depth = DepthBuffer::try_new(&mut words, fine, fine).unwrap();
    let frame = Frame::new(Record::new(fine, fine)).unwrap().with_tier(Exact);
    let mut frame = frame.with_cull(cull).with_hither(hither).with_depth(depth).unwrap();
    let mut cache = vec![Vertex::EMPTY; mesh.vertex_count()];
    let _ = frame.draw(mesh, stage, &Mark, &mut cache);
    let samples = frame.target_mut().take_counts();
    let exact = |x: u32, y: u32| {
        let inside = (0..SAMPLES * SAMPLES)
            .map(|i| (x * SAMPLES + i % SAMPLES, y * SAMPLES + i / SAMPLES))
            .filter(|(x, y)| samples[(y * fine + x) as usize] > 0);
        inside.count() as f64 / f64::from(SAMPLES * SAMPLES)
    };
    let draw = |neighbours: &[[u16; 3]], cached: usize| -> (Vec<f64>, Counts) {
        let mut words = vec![u16::MAX; (SIDE * SIDE) as usize];
        let depth = DepthBuffer::try_new(&mut words, SIDE, SIDE).unwrap();
        let frame = Frame::new(Shares::new(SIDE, SIDE)).unwrap().with_tier(T::default());
        let mut frame = frame.with_cull(cull).with_hither(hither).with_depth(depth).unwrap();
        let mut cache = vec![Vertex::EMPTY; cached];
        let counts =
            frame.draw_smooth_mesh(mesh, neighbours, stage, &Translucent(Mark, 255), &mut cache);
        (alphas(frame.target(), (SIDE, SIDE)).0, counts)
    };
    let (smooth, counts) = draw(&neighbours, mesh.vertex_count());
    assert_eq!(counts.total() as usize, count);
    // Vertices that are in no cache are the same.
    assert_eq!(draw(&neighbours, 10).0, smooth);
    let (hard, _) = draw(&[], mesh.vertex_count());
    let (mut off, mut edges, mut cusps) = ([0.0; 2], 0, 0);
    for y in 1..SIDE - 1 {
        for x in 1..SIDE - 1 {
            let at = (y * SIDE + x) as usize;
            let around = (0..9).map(|i| exact(x + i % 3 - 1, y + i / 3 - 1));
            if around.clone().all(|share| share == 1.0) {
                // Where a silhouette ends inside of the picture its edges may cut both surfaces of a pixel.
                assert!(smooth[at] > 0.5, "a seam at ({x}, {y}): {}", smooth[at]);
                cusps += i32::from(smooth[at] < 1.0);
            } else if around.clone().all(|share| share == 0.0) {
                assert_eq!(smooth[at], 0.0, "({x}, {y}) is outside");
            }
            let exact = exact(x, y);
            if exact > 0.0 && exact < 1.0 {
                edges += 1;
                for (off, got) in off.iter_mut().zip([smooth[at], hard[at]]) {
                    *off += (got - exact).abs();
                }
            }
        }
    }
    assert!(edges > 60 && cusps < 9, "{edges} pixels of silhouettes, {cusps} of cusps");
    off.map(|off| off / f64::from(edges))
}

/// A mesh as it is turned.
fn turned(degrees: i32, distance: i32) -> Mat4 {
    let fixed = I16F16::from_num::<i32>;
    let spin = |angle: i32| Angle::from_degrees(fixed(angle)).sin_cos();
    let turn =
        Mat4::rotation_x(spin(25 + degrees / 3)).times(&Mat4::rotation_y(spin(degrees))).unwrap();
    let away = Mat4::translation([fixed(0), fixed(0), fixed(-distance)]);
    let lens = Mat4::perspective(fixed(2), I16F16::ONE, I16F16::ONE, fixed(30)).unwrap();
    lens.times(&away.times(&turn).unwrap()).unwrap()
}

fn both<T: Tier>(tier: &str) {
    let mut sum = [0.0; 4];
    for turn in 0..6 {
        let stage = Bare(turned(turn * 60 + 7, 5));
        let hither = Hither::new(I16F16::ONE).unwrap();
        let [a, b] = silhouettes::<T, _, _>(&torus::BARE_TORUS, &stage, hither, torus::CULL);
        let [c, d] =
            silhouettes::<T, _, _>(&spinning_teapot::TEAPOT, &stage, hither, Cull::Neither);
        for (sum, off) in sum.iter_mut().zip([a, b, c, d]) {
            *sum += off / 6.0;
        }
    }
    let [torus, hard_torus, teapot, hard_teapot] = sum;
    println!(
        "{tier}: torus {torus:.4} (hard {hard_torus:.4}), teapot {teapot:.4} (hard {hard_teapot:.4}) of a pixel on average"
    );
    // Faces of the teapot are of a few pixels here, and both sides are drawn.
    assert!(torus <= 0.044 && torus < 0.4 * hard_torus, "{tier}: {torus}");
    assert!(teapot <= 0.054 && teapot < 0.4 * hard_teapot, "{tier}: {teapot}");
}

#[test]
fn silhouettes_are_close_to_samples() {
    both::<Exact>("exact");
    both::<Quick<4>>("quick4");
    both::<Quick<8>>("quick8");
}

/// In bands it is the same, and so it is from within the mesh, where faces are on both sides of the eye.
fn bands<T: Tier>() {
    let mesh = &spinning_teapot::TEAPOT;
    let mut neighbours = vec![[0; 3]; mesh.triangles().len()];
    mesh.neighbours(&mut neighbours).unwrap();
    let viewport = Viewport::new(SIDE, SIDE).unwrap();
    for distance in [5, 1] {
        for cull in [Cull::Neither, Cull::Back, Cull::Front] {
            let stage = Bare(turned(40, distance));
            let draw = |top: u32, height: u32| {
                let mut words = vec![u16::MAX; (SIDE * height) as usize];
                let depth = DepthBuffer::try_new(&mut words, SIDE, height).unwrap();
                let viewport = viewport.with_origin(0, -(top as i16));
                let frame = Frame::with_viewport(Shares::new(SIDE, height), viewport);
                let frame = frame.with_tier(T::default()).with_cull(cull);
                let hither = Hither::new(I16F16::from_num(0.5)).unwrap();
                let mut frame = frame.with_hither(hither).with_depth(depth).unwrap();
                let mut cache = vec![Vertex::EMPTY; mesh.vertex_count()];
                let opaque = Translucent(Mark, 255);
                let _ = frame.draw_smooth_mesh(mesh, &neighbours, &stage, &opaque, &mut cache);
                alphas(frame.target(), (SIDE, height)).0
            };
            let whole = draw(0, SIDE);
            // From within no front face is seen.
            let drawn = whole.iter().filter(|share| **share > 0.0).count();
            assert!(drawn > 500 || (distance == 1 && cull == Cull::Back), "{drawn} of {cull:?}");
            let bands: Vec<f64> =
                (0..SIDE).step_by(19).flat_map(|top| draw(top, 19.min(SIDE - top))).collect();
            assert!(bands == whole, "from {distance}, {cull:?}");
        }
    }
}

#[test]
fn bands_of_a_mesh_are_the_same_to_the_bit() {
    bands::<Exact>();
    bands::<Quick<4>>();
    bands::<Quick<8>>();
}

/// All edges of closed meshes have a face across, and it has them across.
#[test]
fn neighbours_are_mutual() {
    let torus = &torus::BARE_TORUS;
    let mut found = vec![[0; 3]; torus.triangles().len()];
    torus.neighbours(&mut found).unwrap();
    for (face, across) in found.iter().enumerate() {
        for (i, other) in across.iter().enumerate() {
            assert_ne!(*other, u16::MAX, "face {face} of a torus has no neighbour {i}");
            let back =
                found[usize::from(*other)].iter().position(|f| usize::from(*f) == face).unwrap();
            let corner = |face: usize, i: usize| torus.triangles()[face][i % 3];
            assert_eq!(corner(face, i), corner(usize::from(*other), back + 1));
            assert_eq!(corner(face, i + 1), corner(usize::from(*other), back));
        }
    }
    let teapot = &spinning_teapot::TEAPOT;
    let mut found = vec![[0; 3]; teapot.triangles().len()];
    teapot.neighbours(&mut found).unwrap();
    let open = found.iter().flatten().filter(|other| **other == u16::MAX).count();
    println!("{open} open edges of the teapot's {}", 3 * found.len());
    let error = teapot.neighbours(&mut found[1..]).unwrap_err();
    assert_eq!(error, MeshError::Neighbours { triangles: found.len(), entries: found.len() - 1 });
    assert!(error.to_string().contains("one each is needed"), "{error}");
}
