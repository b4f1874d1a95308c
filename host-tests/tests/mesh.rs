//! Models: the modules that the command `mesh` prints, meshes against what they were made of, and files of all sorts.
//!
//! `HITHER_BLESS=1 cargo test -p host-tests --test mesh` writes the modules anew, and still fails: look at them, then run it again
//! without.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use hither::{
    Correction, DepthBuffer, Frame, Framebuffer, Gouraud, Hither, I16F16, Lit, Mat4, Mesh, Rgb565,
    Textured, Tier, Vertex, VertexStage,
};
use hither_models::module::Module;
use hither_models::{DIE, DIE_TEXTURE, Image, Keep, Model, Obj, SAILBOAT};
use hither_scenes::teapot;
use host_tests::mesh::{Options, made};
use host_tests::oracle::Rng;

#[expect(dead_code, reason = "bounds are for planners")]
#[path = "mesh/die_lit.rs"]
mod die_lit;
#[expect(dead_code, reason = "bounds that this plan does not ask for")]
#[path = "mesh/die_textured.rs"]
mod die_textured;

/// Models that come with hither.
fn models() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/models")
}

/// What is wrong with a module in this folder, if anything; or writes it where that is asked for.
fn stale(name: &str, texture: Option<&str>) -> Option<String> {
    let path = |name: &str| models().join(name).display().to_string();
    let options = Options { model: path("die.obj"), texture: texture.map(path) };
    let source = made(&options).unwrap().source;
    let committed = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/mesh").join(name);
    if env::var_os("HITHER_BLESS").is_some_and(|value| value == "1") {
        fs::write(&committed, source).unwrap();
        return Some(format!("{name}: written anew"));
    }
    (fs::read_to_string(&committed).ok().as_deref() != Some(source.as_str()))
        .then(|| format!("{name} is not what the command prints"))
}

#[test]
fn modules_are_what_the_command_prints() {
    let wrong = [stale("die_lit.rs", None), stale("die_textured.rs", Some("die.png"))];
    let wrong: Vec<String> = wrong.into_iter().flatten().collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

const SIDE: u32 = 96;

hither::plan! {
    /// From the constants of a module.
    DiePlan = hither::Scene::new(SIDE, SIDE)
        .range(3.0, 8.0)
        .model(die_textured::EXTENT, 5.0)
        .triangle(die_textured::LONGEST_EDGE, f32::INFINITY)
        .texture(die_textured::TEXTURE_SIDE, die_textured::REPEATS)
        .coordinates(die_textured::COORDINATE)
        .within_pixels(1.0);
}

/// Draws into a frame with depth, with a preset, and returns its words.
fn drawn<P: hither::Preset>(preset: P, draw: impl FnOnce(&mut DieFrame<'_, P>)) -> Vec<u16> {
    let mut words = vec![0; (SIDE * SIDE) as usize];
    let mut depths = vec![0; words.len()];
    let near = Hither::new(I16F16::ONE).unwrap();
    let buffer = Framebuffer::<Rgb565>::try_new(&mut words, SIDE, SIDE).unwrap();
    let frame = Frame::new(buffer).unwrap().with_preset(preset).with_hither(near);
    let depth = DepthBuffer::try_new(&mut depths, SIDE, SIDE).unwrap();
    let mut frame = frame.with_depth(depth).unwrap();
    frame.clear(Rgb565::BLACK);
    draw(&mut frame);
    words
}

type DieFrame<'a, P> = Frame<
    Framebuffer<'a, Rgb565>,
    DepthBuffer<'a>,
    Hither,
    <P as hither::Preset>::Tier,
    <P as hither::Preset>::Correction,
>;

/// Turned, and 5 units away.
fn place() -> (Mat4, Mat4) {
    let fixed = I16F16::from_num::<f64>;
    let degrees = |d: f64| hither::Angle::from_degrees(fixed(d)).sin_cos();
    let turned = Mat4::rotation_x(degrees(30.0)).times(&Mat4::rotation_y(degrees(40.0))).unwrap();
    let away = Mat4::translation([fixed(0.0), fixed(0.0), fixed(-5.0)]);
    let lens = Mat4::perspective(fixed(2.2), fixed(1.0), fixed(1.0), fixed(9.0)).unwrap();
    (lens.times(&away.times(&turned).unwrap()).unwrap(), turned)
}

fn lit() -> Lit {
    let (transform, turned) = place();
    let light = [I16F16::ONE, I16F16::ONE, I16F16::ONE];
    Lit::new(transform, &turned, light, I16F16::lit("0.25"), I16F16::lit("0.75")).unwrap()
}

fn draw_lit<A, T: Tier, I: Correction, S: VertexStage<A, 3>>(
    frame: &mut Frame<Framebuffer<'_, Rgb565>, DepthBuffer<'_>, Hither, T, I>,
    mesh: &Mesh<'_, [i16; 3], A>,
    stage: &S,
) {
    let mut cache = vec![Vertex::EMPTY; mesh.vertex_count()];
    let counts = frame.draw(mesh, stage, &Gouraud, &mut cache);
    assert_eq!(counts.total() as usize, mesh.triangles().len());
}

/// Different colours of a picture but black, and how many pixels have them.
fn colors(words: &[u16]) -> (usize, usize) {
    let mut colors: Vec<u16> = words.iter().copied().filter(|&word| word != 0).collect();
    let pixels = colors.len();
    colors.sort_unstable();
    colors.dedup();
    (colors.len(), pixels)
}

#[test]
fn a_lit_module_draws_what_the_file_does() {
    let model = Model::read(DIE, Keep::Lit).unwrap();
    let (positions, attributes) = (model.positions(), model.normal_colors());
    let (bits, triangles) = (model.fraction_bits(), model.triangles());
    let mesh = Mesh::try_new(&positions, bits, &attributes, triangles).unwrap();
    let read = drawn(hither::Balance, |frame| draw_lit(frame, &mesh, &lit()));
    let made = drawn(hither::Balance, |frame| draw_lit(frame, &die_lit::MESH, &lit()));
    assert_eq!(read, made);
    // Three faces, each of one brightness.
    let (colors, pixels) = colors(&made);
    assert!(colors == 3 && pixels > 2000, "{colors} colours on {pixels} pixels");
    assert_eq!(die_lit::MESH.vertex_count(), die_lit::VERTEX_COUNT);
}

#[test]
fn a_textured_module_draws_what_the_file_does() {
    let model = Model::read(DIE, Keep::Textured).unwrap();
    let image = Image::read_png(DIE_TEXTURE).unwrap();
    let (positions, attributes) = (model.positions(), model.coordinates());
    let mesh = Mesh::try_new(&positions, model.fraction_bits(), &attributes, model.triangles());
    let mesh = mesh.unwrap();
    let (transform, _) = place();
    // By knobs that were planned from the module's constants.
    let stage = DiePlan::stage(&transform);
    let read = drawn(DiePlan, |frame| {
        frame.draw(&mesh, &stage, &Textured(image.texture()), &mut []);
    });
    let made = drawn(DiePlan, |frame| {
        let mut cache = [Vertex::EMPTY; die_textured::VERTEX_COUNT];
        frame.draw(&die_textured::MESH, &stage, &Textured(die_textured::TEXTURE), &mut cache);
    });
    assert_eq!(read, made);
    let (colors, pixels) = colors(&made);
    assert!((3..=4).contains(&colors) && pixels > 2000, "{colors} colours on {pixels} pixels");
}

/// The teapot as a file would have it: its own numbers, and normals if they are asked for.
fn teapot_obj(normals: bool) -> String {
    let mut obj = String::from("o teapot\n");
    for position in teapot::POSITIONS {
        let [x, y, z] = position.map(|v| f64::from(v) / 4096.0);
        writeln!(obj, "v {x} {y} {z}").unwrap();
    }
    for [x, y, z] in teapot::NORMALS {
        writeln!(obj, "vn {x} {y} {z}").unwrap();
    }
    for triangle in teapot::TRIANGLES {
        let corners = triangle.map(|vertex| vertex + 1);
        let [a, b, c] = if normals {
            corners.map(|i| format!("{i}//{i}"))
        } else {
            corners.map(|i| i.to_string())
        };
        writeln!(obj, "f {a} {b} {c}").unwrap();
    }
    obj
}

/// Triangles by their corners, from the least on, and how often each is there.
fn by_corners<V: Copy + Ord>(triangles: impl Iterator<Item = [V; 3]>) -> BTreeMap<[V; 3], usize> {
    let mut counts = BTreeMap::new();
    for [a, b, c] in triangles {
        let turns = [[a, b, c], [b, c, a], [c, a, b]];
        *counts.entry(turns.into_iter().min().unwrap()).or_default() += 1;
    }
    counts
}

/// Edges with more triangles to one side than to the other, by positions.
fn open_edges(triangles: impl Iterator<Item = [[i16; 3]; 3]>) -> usize {
    let mut sides: BTreeMap<[[i16; 3]; 2], i32> = BTreeMap::new();
    for [a, b, c] in triangles {
        for [from, to] in [[a, b], [b, c], [c, a]].into_iter().filter(|[from, to]| from != to) {
            *sides.entry([from.min(to), from.max(to)]).or_default() +=
                if from < to { 1 } else { -1 };
        }
    }
    sides.values().filter(|&&side| side != 0).count()
}

fn positions(model: &Model) -> impl Iterator<Item = [[i16; 3]; 3]> {
    model.triangles().iter().map(|t| t.map(|v| model.vertices()[usize::from(v)].position))
}

#[test]
fn the_teapot_comes_back() {
    let model = Model::read(teapot_obj(true).as_bytes(), Keep::Lit).unwrap();
    // Its numbers are on the grid of 12 bits, so on any finer one.
    let finer = model.fraction_bits() - teapot::FRACTION_BITS;
    let original = |vertex: u16| {
        let vertex = usize::from(vertex);
        let position = teapot::POSITIONS[vertex].map(|v| v << finer);
        // Normals come back at a length of 127 exactly.
        let normal = teapot::NORMALS[vertex].map(f64::from);
        let length = normal.iter().map(|v| v * v).sum::<f64>().sqrt();
        (position, normal.map(|v| (v / length * 127.0).round() as i8))
    };
    let expected = by_corners(teapot::TRIANGLES.iter().map(|t| t.map(original)));
    let read = |vertex: u16| {
        let vertex = model.vertices()[usize::from(vertex)];
        (vertex.position, vertex.normal)
    };
    assert_eq!(by_corners(model.triangles().iter().map(|t| t.map(read))), expected);
    let before = teapot::TRIANGLES
        .iter()
        .map(|t| t.map(|v| teapot::POSITIONS[usize::from(v)].map(|v| v << finer)));
    assert_eq!(model.counts().open_edges, open_edges(before));
    assert_eq!((model.counts().dropped, model.counts().thin), (0, 0));
    assert!(model.vertices().len() <= teapot::VERTEX_COUNT);
}

/// Against sums of vector products, which are whole numbers here.
#[test]
fn made_normals_are_means_by_area() {
    let model = Model::read(teapot_obj(false).as_bytes(), Keep::Lit).unwrap();
    let finer = model.fraction_bits() - teapot::FRACTION_BITS;
    let mut sums = [[0_i64; 3]; teapot::VERTEX_COUNT];
    for triangle in teapot::TRIANGLES {
        let [a, b, c] = triangle.map(|v| teapot::POSITIONS[usize::from(v)].map(i64::from));
        let [u, v] = [b, c].map(|p| [0, 1, 2].map(|i| p[i] - a[i]));
        for vertex in triangle {
            let sum = &mut sums[usize::from(vertex)];
            *sum = [0, 1, 2].map(|i| {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                sum[i] + u[j] * v[k] - u[k] * v[j]
            });
        }
    }
    let expected = |vertex: u16| {
        let vertex = usize::from(vertex);
        let sum = sums[vertex].map(|v| v as f64);
        let length = sum.iter().map(|v| v * v).sum::<f64>().sqrt();
        let normal = sum.map(|v| (v / length * 127.0).round() as i8);
        (teapot::POSITIONS[vertex].map(|v| v << finer), normal)
    };
    let read = |vertex: u16| {
        let vertex = model.vertices()[usize::from(vertex)];
        (vertex.position, vertex.normal)
    };
    let expected = by_corners(teapot::TRIANGLES.iter().map(|t| t.map(expected)));
    assert_eq!(by_corners(model.triangles().iter().map(|t| t.map(read))), expected);
}

#[test]
fn made_normals_are_the_same_however_a_face_is_cut() {
    // A pyramid, whose base is cut from one corner or from the next.
    let points =
        "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 2 2 3\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
    let normal = |base: &str, at: [i16; 3]| {
        let model = Model::read(format!("{points}{base}").as_bytes(), Keep::Lit).unwrap();
        let step = 1_i16 << model.fraction_bits();
        let here = |vertex: &&hither_models::ModelVertex| vertex.position == at.map(|v| v * step);
        model.vertices().iter().find(here).unwrap().normal
    };
    assert_eq!(normal("f 4 3 2 1", [2, 2, 3]), [0, 0, 127]);
    assert_eq!(normal("f 4 3 2 1", [0, 0, 0]), normal("f 1 4 3 2", [0, 0, 0]));
    // By area: (-12, 0, 8) / 2 and (0, -12, 8) / 2 of the slopes, (0, 0, -32) / 2 of the base.
    let length = f64::from(12 * 12 * 2 + 16 * 16).sqrt();
    let expected = [-12.0, -12.0, -16.0].map(|v: f64| (v / length * 127.0).round() as i8);
    assert_eq!(normal("f 4 3 2 1", [0, 0, 0]), expected);
}

/// A ring of many small triangles round a hole, each near a step of the grid that a far corner makes coarse.
fn coarse_torus(rng: &mut Rng) -> String {
    let (around, across) = (rng.range(3, 40), rng.range(3, 24));
    let size = rng.between(0.3, 30.0);
    let mut obj = String::from("v 32767 0 0\nf 1 1 1\n");
    for i in 0..around {
        for j in 0..across {
            let (sine, cosine) = (std::f64::consts::TAU * i as f64 / around as f64).sin_cos();
            let (up, out) = (std::f64::consts::TAU * j as f64 / across as f64).sin_cos();
            let radius = size * (1.0 + rng.between(0.3, 0.4) * out);
            let [x, y, z] = [radius * cosine, radius * sine, size * 0.4 * up];
            writeln!(obj, "v {x} {y} {z}").unwrap();
        }
    }
    for i in 0..around {
        for j in 0..across {
            let at = |i: i64, j: i64| i % around * across + j % across + 2;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if rng.once_in(2) {
                writeln!(obj, "f {a} {b} {c} {d}").unwrap();
            } else {
                writeln!(obj, "f {a} {b} {c}\nf {a} {c} {d}").unwrap();
            }
        }
    }
    obj
}

#[test]
fn closed_meshes_stay_closed_however_coarse_the_grid() {
    let (mut dropped, mut thin, mut whole) = (0, 0, 0);
    for seed in 0..200 {
        let obj = coarse_torus(&mut Rng::new(seed));
        // Too small to be anything, sometimes.
        if let Ok(model) = Model::read(obj.as_bytes(), Keep::Lit) {
            assert_eq!((model.fraction_bits(), model.counts().open_edges), (0, 0), "seed {seed}");
            assert_eq!(open_edges(positions(&model)), 0, "seed {seed}");
            dropped += model.counts().dropped;
            thin += model.counts().thin;
            whole += model.triangles().len();
        }
    }
    assert!(dropped > 10_000 && thin > 100 && whole > 10_000, "{dropped} {thin} {whole}");
}

#[test]
fn positions_are_on_the_finest_grid_they_fit() {
    for seed in 0..300 {
        let mut rng = Rng::new(seed);
        let size = 2_f64.powf(rng.between(-20.0, 14.9));
        let points: Vec<[f64; 3]> =
            (0..3).map(|_| [(); 3].map(|()| rng.between(-size, size))).collect();
        let mut obj = String::new();
        for [x, y, z] in &points {
            writeln!(obj, "v {x} {y} {z}").unwrap();
        }
        let model = Model::read(format!("{obj}f 1 2 3").as_bytes(), Keep::Lit).unwrap();
        let step = (-f64::from(model.fraction_bits())).exp2();
        let largest = points.iter().flatten().fold(0.0_f64, |largest, v| largest.max(v.abs()));
        let finest = model.fraction_bits() == 31 || (largest / step * 2.0).round() > 32767.0;
        assert!(finest && (largest / step).round() <= 32767.0, "seed {seed}: {step}");
        for point in &points {
            let near = |stored: [i16; 3]| {
                (0..3).all(|i| (f64::from(stored[i]) * step - point[i]).abs() <= model.rounding())
            };
            assert!(positions(&model).flatten().any(near), "seed {seed}");
        }
    }
}

/// Bounds against the stored vertices, in `f64`.
#[test]
fn bounds_hold_and_are_tight() {
    for (bytes, keep) in [(SAILBOAT, Keep::Lit), (DIE, Keep::LitTextured)] {
        let model = Model::read(bytes, keep).unwrap();
        let bounds = model.bounds();
        let unit = (-f64::from(model.fraction_bits())).exp2();
        let at = |p: [i16; 3]| p.map(|v| f64::from(v) * unit);
        let distance =
            |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let all = || model.positions().into_iter().map(at);
        let extent = largest(&mut all().flatten().map(f64::abs));
        let radius = largest(&mut all().map(|p| distance(p, bounds.center.map(f64::from))));
        let edge =
            largest(&mut positions(&model).flat_map(|[a, b, c]| {
                [[a, b], [b, c], [c, a]].map(|[a, b]| distance(at(a), at(b)))
            }));
        for (bound, exact) in
            [(bounds.extent, extent), (bounds.radius, radius), (bounds.longest_edge, edge)]
        {
            let over = f64::from(bound) - exact;
            assert!((-1e-12..1e-6).contains(&over), "{bound} for {exact}");
        }
    }
    let die = Model::read(DIE, Keep::Textured).unwrap().bounds();
    assert_eq!((die.repeats, die.coordinate, die.extent), (0.5, 1.0, 1.0));
}

#[test]
fn equal_corners_are_one_vertex() {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 0\nvt 0 0\nvt 1 1\nvn 0 0 1\nvn 0 0 5\nvn 1 0 0\n";
    let vertices = |faces: &str, keep| {
        Model::read(format!("{square}{faces}").as_bytes(), keep).unwrap().vertices().len()
    };
    // Positions that are given twice, and normals of another length, are equal.
    assert_eq!(vertices("f 1//1 2//1 3//1\nf 5//2 3//2 4//1", Keep::Lit), 4);
    assert_eq!(vertices("f 1//1 2//1 3//1\nf 5//3 3//1 4//1", Keep::Lit), 5);
    // What is not kept keeps nothing apart.
    let both = "f 1/1/1 2/1/1 3/1/1\nf 1/2/3 3/1/3 4/1/1";
    let counts = [Keep::Lit, Keep::Textured, Keep::LitTextured].map(|keep| vertices(both, keep));
    assert_eq!(counts, [6, 5, 6]);
}

#[test]
fn colours_and_normals_have_defaults_that_are_told() {
    let text = "v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nf 1//1 2//1 3//1\nf 1 3 2\n";
    let model = Model::read(text.as_bytes(), Keep::Lit).unwrap();
    let told: Vec<String> = model.warnings().iter().map(ToString::to_string).collect();
    assert_eq!(
        told,
        [
            "line 5: a corner without a colour, where others have one, is white (4 times)",
            "line 5: a corner with a normal of length 0 has one made from its faces (3 times)",
        ]
    );
    // Front and back cancel: no direction.
    assert!(model.vertices().iter().all(|vertex| vertex.normal == [0; 3]));
    let mut colors: Vec<[u8; 3]> = model.vertices().iter().map(|vertex| vertex.color).collect();
    colors.sort_unstable();
    assert_eq!(colors, [[255, 128, 0], [255; 3], [255; 3]]);
}

fn error(text: &str, keep: Keep) -> String {
    Model::read(text.as_bytes(), keep).map(|_| ()).unwrap_err().to_string()
}

#[test]
fn what_does_not_fit_is_named_with_its_line() {
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (text, keep, message) in [
        (
            format!("{corners}v 0 0 -32767.5\nf 1 2 4"),
            Keep::Lit,
            "line 4: coordinate -32767.5 does not fit 16 bits: at most 32767 either way",
        ),
        (
            format!("{corners}v 1e300 0 0\nf 1 2 4"),
            Keep::Lit,
            &format!(
                "line 4: coordinate 1{} does not fit 16 bits: at most 32767 either way",
                "0".repeat(300)
            ),
        ),
        (
            format!("{corners}vt 0 0\nvt 32768 0\nf 1/1 2/1 3/2"),
            Keep::Textured,
            "line 5: texture coordinate 32768 does not fit Q16.16: at most 32767 either way",
        ),
        (
            format!("{corners}vt 0 0\nf 1/1 2/1 3/1\nf 1 3 2"),
            Keep::Textured,
            "line 6: a face without texture coordinates, but there is a texture",
        ),
        (
            format!("{corners}f 1 1 2\nf 2 3 3\n\n"),
            Keep::Lit,
            "line 6: the file ends, and on the grid none of its 2 triangles has three corners",
        ),
    ] {
        assert_eq!(error(&text, keep), message);
    }
    // A position that no face uses is no matter, nor is a texture coordinate that is not kept.
    let unused = format!("{corners}v 1e300 0 0\nvt 1e300\nf 1/1 2/1 3/1");
    assert!(Model::read(unused.as_bytes(), Keep::Lit).is_ok());
}

#[test]
fn indices_of_sixteen_bits_name_all_vertices_there_may_be() {
    // A strip of 65,536 vertices; then with one more.
    let strip = |count: i64| {
        let mut obj = String::new();
        for i in 0..count {
            writeln!(obj, "v {} {} {}", i / 2 % 256, i % 2 + 2 * (i / 512), i % 3).unwrap();
        }
        for i in 1..count - 1 {
            writeln!(obj, "f {} {} {}", i, i + 1, i + 2).unwrap();
        }
        obj
    };
    let model = Model::read(strip(65_536).as_bytes(), Keep::Lit).unwrap();
    assert_eq!((model.vertices().len(), model.triangles().len()), (65_536, 65_534));
    let indices = model.positions();
    assert!(Mesh::try_new(&indices, 0, &model.normal_colors(), model.triangles()).is_ok());
    let message = "line 131072: this face needs one vertex more than 65536, the most there can be";
    assert_eq!(error(&strip(65_537), Keep::Lit), message);
}

/// The order that is kept against the one of first use, on what comes with hither.
#[test]
fn most_used_first_takes_fewer_transforms_than_first_use() {
    use hither_models::order::{by_first_use, renumber, transforms};
    let teapot = Model::read(teapot_obj(true).as_bytes(), Keep::Lit).unwrap();
    let boat = Model::read(SAILBOAT, Keep::Lit).unwrap();
    for (model, least) in [(&teapot, 0.05), (&boat, 0.2)] {
        let (triangles, count) = (model.triangles(), model.vertices().len());
        let other = renumber(triangles, &by_first_use(triangles, count));
        let mean = |t: &[[u16; 3]]| transforms(t, count, count / 2) as f64 / t.len() as f64;
        let [ours, other] = [triangles, &other].map(mean);
        println!(
            "half of {count} cached: {ours:.2} transforms a triangle, in order of first use {other:.2}"
        );
        assert!(ours < other - least, "{ours} {other}");
    }
}

/// A file that may be anything is an error or a model that draws, and never a panic.
fn take(bytes: &[u8]) -> bool {
    let mut taken = false;
    for keep in [Keep::Lit, Keep::Textured, Keep::LitTextured] {
        let model = match Model::read(bytes, keep) {
            Ok(model) => model,
            Err(error) => {
                assert!(error.line >= 1 && error.to_string().starts_with("line "), "{error}");
                continue;
            }
        };
        let positions = model.positions();
        let bits = model.fraction_bits();
        let mesh =
            Mesh::try_new(&positions, bits, &model.coordinates(), model.triangles()).map(|_| ());
        assert_eq!(mesh, Ok(()));
        let bounds = model.bounds();
        let numbers = [bounds.extent, bounds.radius, bounds.longest_edge, bounds.repeats];
        assert!(numbers.iter().all(|number| number.is_finite() && *number >= 0.0), "{bounds:?}");
        let source = Module { model: &model, name: "a\nb", texture: None }.source();
        assert!(source.starts_with("//! a\\nb, for hither: "));
        taken = true;
    }
    taken
}

#[test]
fn files_of_random_bytes_are_errors() {
    for seed in 0..2000 {
        let mut rng = Rng::new(seed);
        let bytes: Vec<u8> = (0..rng.below(200)).map(|_| rng.bits() as u8).collect();
        assert!(!take(&bytes), "seed {seed}");
        assert!(Image::read_png(&bytes).is_err(), "seed {seed}");
    }
}

#[test]
fn files_of_random_words_never_panic() {
    const WORDS: [&str; 40] = [
        "v", "v", "v", "v", "v", "vt", "vn", "f", "f", "f", "f", "f", "\n", "\n", "\n", "\n", "\n",
        "\n", "0", "1", "-1", "2", "3", "-2", "0.5", "1/1", "1/1/1", "1//1", "-1/-1", "#", "\\",
        "\\\n", "\r", "nan", "1e308", "1e-320", "32767", "-0", "é", "usemtl",
    ];
    const LINES: [&str; 8] = [
        "v 1 2 3",
        "v 5 5 1 1 0 0.5",
        "f 1 2 3",
        "f -1 -2 -3 1",
        "f 1/1 2/1 3/-1",
        "vt 2 2",
        "f 1//1 -1//1 2//1",
        "# #",
    ];
    let mut taken = 0;
    for seed in 0..20_000 {
        let mut rng = Rng::new(seed);
        let mut text = String::from(if rng.once_in(4) {
            ""
        } else {
            "v 0 0 0\nv 1 0 0\nv 0 1 1\nvt 0 0\nvn 0 0 1\n"
        });
        for _ in 0..rng.below(60) {
            if rng.once_in(3) {
                text.push('\n');
                text.push_str(rng.choose(&LINES));
                text.push('\n');
            } else if seed % 2 == 0 {
                text.push_str(rng.choose(&WORDS));
                text.push(' ');
            }
        }
        taken += usize::from(take(text.as_bytes()));
    }
    assert!(taken > 500, "{taken}");
}

#[test]
fn files_with_faults_never_panic() {
    let mut taken = 0;
    let small = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 1 0.5 1 0 1\nv 0 2 0\nvt 0 0\nvt 1 0.25\nvn 0 0 1\n\
                 f 1/1/1 2/2/1 3/1/1 4/1/1 -1/1/1\nf -1 -2 -3 \\\n 1\n";
    for seed in 0..20_000 {
        let mut rng = Rng::new(seed);
        let mut bytes = if seed % 100 == 0 { SAILBOAT.to_vec() } else { small.as_bytes().to_vec() };
        for _ in 0..rng.range(1, 4) {
            let at = rng.below(bytes.len() as u64) as usize;
            match rng.below(4) {
                0 => bytes[at] = rng.choose(b"0123456789-+.eE/ \n\r\t\\#vfn"),
                1 if bytes.len() > 1 => drop(bytes.remove(at)),
                2 => bytes.insert(at, rng.bits() as u8 & 0x7f),
                _ => bytes.truncate(at.max(1)),
            }
        }
        taken += usize::from(take(&bytes));
    }
    assert!(taken > 1000, "{taken}");
}

#[test]
fn textures_with_faults_never_panic() {
    for seed in 0..3000 {
        let mut rng = Rng::new(seed);
        let mut bytes = DIE_TEXTURE.to_vec();
        for _ in 0..rng.range(1, 3) {
            let at = rng.below(bytes.len() as u64) as usize;
            bytes[at] = rng.bits() as u8;
        }
        bytes.truncate(rng.range(1, bytes.len() as i64) as usize);
        let _ = Image::read_png(&bytes);
    }
}

/// The command's status, standard output and standard error.
fn run(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_mesh")).args(arguments).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[test]
fn the_command_prints_a_module_or_an_error() {
    let path = |name: &str| models().join(name).display().to_string();
    let (die, png) = (path("die.obj"), path("die.png"));
    let (status, out, report) = run(&[&die, "--texture", &png]);
    assert_eq!((status, out.as_str()), (Some(0), include_str!("mesh/die_textured.rs")));
    assert!(
        report.contains("triangles          12\n") && report.contains("a triangle: 1.92 with"),
        "{report}"
    );
    assert_eq!(run(&["--texture", &png, &die]).1, out);
    for (arguments, message) in [
        (&[][..], "which model?\nmesh model.obj [--texture texture.png] > model.rs\n"),
        (&[&die, "--texture"], "--texture needs a file\nmesh "),
        (&[&die, "--fast"], "--fast is no option\nmesh "),
        (&[&die, &png], "one model, and one texture at most\nmesh "),
        (&["/no/such.obj"], "/no/such.obj: "),
        (&[&png], "die.png: line 1: byte 0x89 is not UTF-8 text\n"),
        (&[&die, "--texture", &die], "die.obj: not a PNG that can be read: "),
        (&[&path("sailboat.obj"), "--texture", &png], "sailboat.obj: line "),
    ] {
        let (status, out, error) = run(arguments);
        assert_eq!((status, out.as_str()), (Some(2), ""), "{arguments:?}");
        assert!(error.contains(message), "{arguments:?}: {error}");
    }
}

/// What comes with hither has nothing to be told.
#[test]
fn models_that_come_with_hither_are_clean() {
    for (bytes, vertices) in [(SAILBOAT, 823), (DIE, 24)] {
        let obj = Obj::parse(bytes).unwrap();
        let model = Model::new(&obj, Keep::Lit).unwrap();
        assert!(model.warnings().is_empty(), "{:?}", model.warnings());
        assert_eq!(
            (model.vertices().len(), model.counts().dropped, model.counts().thin),
            (vertices, 0, 0)
        );
    }
}
