//! An outside judge: coverage against Mesa's rasterizer, a separate program.
//!
//!     cargo run -p host-tests --release --bin judge [-- TRIANGLES]
//!
//! Compiles `host-tests/judge/osmesa.c` with `cc`, which needs OSMesa (Debian's package is
//! `libosmesa6-dev`), hands it random on-screen triangles on the grid that both represent, 1/256 of
//! a pixel on viewports whose sides are powers of two, and compares every pixel with the exact tier
//! and with `Quick<8>`. `TRIANGLES` is how many on each viewport, 1,000 if not said. Vertices have
//! `w` of 1, 2, 4, 8 or 16. Ties are compared too: vertices and edges through pixel centres, where
//! the fill rule decides. Mesa's is the top-left one as seen here, since it takes the edges of
//! least y and the two programs are given the same y.
//!
//! Exit status: 0 where all agree, 1 where a pixel differs, 2 where the judge cannot be run.

use std::env;
use std::error::Error;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::thread;

use hither::{Exact, Frame, Quick, Tier};
use host_tests::oracle::{Rng, Viewport};
use host_tests::record::{Mark, Record, clip_vertex};
use host_tests::snapped;

/// Subpixels a pixel.
const PIXEL: i64 = 256;

/// Viewports: square and not, the smallest and the largest.
const VIEWPORTS: [(u32, u32); 7] =
    [(256, 256), (512, 512), (512, 64), (32, 256), (128, 16), (8, 8), (1, 1)];

/// What the columns of the table are.
const HEAD: &str =
    "viewport   triangles    pixels   covered     ties  wrong (exact)  wrong (quick8)";

/// A vertex: x and y in subpixels from the top left corner, and the power of two that is its w.
type Vertex = [i64; 3];

/// Whether each pixel is covered, row by row from the top.
type Coverage = Vec<bool>;

/// Runs the judge over all viewports and prints what it found.
fn main() -> ExitCode {
    let count = match env::args().nth(1).map_or(Ok(1000), |count| count.parse()) {
        Ok(count) => count,
        Err(error) => {
            eprintln!("how many triangles: {error}");
            return ExitCode::from(2);
        }
    };
    let program = match compile() {
        Ok(program) => program,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::from(2);
        }
    };
    match judge_all(&program, count) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

/// Compiles the program that asks Mesa, beside this one.
fn compile() -> Result<PathBuf, Box<dyn Error>> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("judge/osmesa.c");
    let program = env::current_exe()?.with_file_name("judge-osmesa");
    let compiler = env::var("CC").unwrap_or_else(|_| "cc".into());
    let mut command = Command::new(&compiler);
    command.arg("-O2").arg(&source).arg("-o").arg(&program).arg("-lOSMesa");
    let output = command.output().map_err(|error| format!("{compiler}: {error}"))?;
    if output.status.success() {
        return Ok(program);
    }
    let said = String::from_utf8_lossy(&output.stderr);
    Err(format!("{said}{command:?} failed. OSMesa is in Debian's package libosmesa6-dev").into())
}

/// Every viewport; prints a table and returns the number of wrong pixels.
fn judge_all(program: &Path, count: usize) -> Result<u64, Box<dyn Error>> {
    let mut all = Tally::default();
    for (seed, (width, height)) in (1..).zip(VIEWPORTS) {
        let viewport = Viewport::new(width, height);
        let mut rng = Rng::new(seed);
        let triangles: Vec<_> = (0..count).map(|i| triangle(viewport, &mut rng, i)).collect();
        let (renderer, judged) = ask(program, viewport, &triangles)?;
        if seed == 1 {
            print!("judge: {renderer}");
            println!("{HEAD}");
        }
        let mut tally = Tally::default();
        for (corners, mesa) in triangles.iter().zip(&judged) {
            tally.add(viewport, corners, mesa);
        }
        println!("{}", tally.row(&format!("{width}x{height}")));
        all.join(&tally);
    }
    println!("{}", all.row("all"));
    Ok(all.wrong.iter().sum())
}

/// A point anywhere on the screen, its edges included.
fn anywhere(viewport: Viewport, rng: &mut Rng) -> [i64; 2] {
    [viewport.width, viewport.height].map(|side| rng.range(0, i64::from(side) * PIXEL))
}

/// A pixel's centre.
fn centre(viewport: Viewport, rng: &mut Rng) -> [i64; 2] {
    let at = |side: u32, rng: &mut Rng| rng.range(0, i64::from(side) - 1) * PIXEL + PIXEL / 2;
    [at(viewport.width, rng), at(viewport.height, rng)]
}

/// A point at most `reach` subpixels an axis from another, on the screen.
fn near([x, y]: [i64; 2], reach: i64, viewport: Viewport, rng: &mut Rng) -> [i64; 2] {
    let mut move_by =
        |v: i64, side: u32| (v + rng.range(-reach, reach)).clamp(0, i64::from(side) * PIXEL);
    [move_by(x, viewport.width), move_by(y, viewport.height)]
}

/// The triangle with a number: each of the eight kinds in turn.
fn triangle(viewport: Viewport, rng: &mut Rng, number: usize) -> [Vertex; 3] {
    let any = |rng: &mut Rng| anywhere(viewport, rng);
    let on = |rng: &mut Rng| centre(viewport, rng);
    let points = match number % 8 {
        0 => [any(rng), any(rng), any(rng)],
        // All on centres: most edges pass through some.
        1 => [on(rng), on(rng), on(rng)],
        2 => [on(rng), any(rng), any(rng)],
        // A horizontal and a vertical edge through centres.
        3 => {
            let ([x, y], [right, bottom]) = (on(rng), on(rng));
            [[x, y], [right, y], [x, bottom]]
        }
        // Some pixels large.
        4 => {
            let first = any(rng);
            [first, near(first, 3 * PIXEL, viewport, rng), near(first, 3 * PIXEL, viewport, rng)]
        }
        // Within a pixel, about its centre.
        5 => {
            let about = on(rng);
            [0, 1, 2].map(|_| near(about, PIXEL / 2, viewport, rng))
        }
        // A sliver along a line: a vertex some subpixels off its middle, sometimes on it.
        6 => {
            let ([ax, ay], [bx, by]) = (any(rng), any(rng));
            let middle = [(ax + bx) / 2, (ay + by) / 2];
            [[ax, ay], [bx, by], near(middle, 4, viewport, rng)]
        }
        // Along diagonals, whole pixels between centres: every one on the edge is a tie.
        _ => {
            let [x, y] = on(rng);
            let room = i64::from(viewport.width.min(viewport.height)) * PIXEL;
            let length = rng.range(0, room / PIXEL - 1) * PIXEL;
            let end = [(x + length) % room, (y + length) % room];
            [[x, y], end, on(rng)]
        }
    };
    points.map(|[x, y]| [x, y, rng.range(0, 4)])
}

/// The renderer's name, and what it covers of each triangle.
fn ask(
    program: &Path,
    viewport: Viewport,
    triangles: &[[Vertex; 3]],
) -> Result<(String, Vec<Coverage>), Box<dyn Error>> {
    let mut input = format!("{} {}\n", viewport.width, viewport.height);
    for corners in triangles {
        let numbers: Vec<String> = corners.iter().flatten().map(i64::to_string).collect();
        input += &(numbers.join(" ") + "\n");
    }
    let mut child = Command::new(program)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    let mut stdin = child.stdin.take().ok_or("no standard input")?;
    let feed = thread::spawn(move || stdin.write_all(input.as_bytes()));
    let output = child.wait_with_output()?;
    let fed = feed.join().map_err(|_| "the feeding thread")?;
    let said = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        return Err(format!("{said}{} failed: {}", program.display(), output.status).into());
    }
    fed?;
    let (width, height) = (viewport.width as usize, viewport.height as usize);
    let mut covered = vec![vec![false; width * height]; triangles.len()];
    for line in String::from_utf8(output.stdout)?.lines() {
        let numbers: Result<Vec<usize>, _> = line.split(' ').map(str::parse).collect();
        let [index, y, x0, x1] = numbers?[..] else {
            return Err(format!("four numbers a line, not {line:?}").into());
        };
        covered[index][y * width + x0..y * width + x1].fill(true);
    }
    Ok((said.into_owned(), covered))
}

/// A vertex in raw clip space, exactly: sides are powers of two up to 512.
fn in_clip([x, y, power]: Vertex, viewport: Viewport) -> [i64; 4] {
    let one = 1 << 16;
    let across = x * 512 / i64::from(viewport.width) - one;
    let up = one - y * 512 / i64::from(viewport.height);
    [across << power, up << power, 0, one << power]
}

/// What a tier covers of a triangle.
///
/// # Panics
///
/// Where it snaps a vertex elsewhere, or writes a pixel twice.
fn cover<T: Tier>(viewport: Viewport, corners: &[Vertex; 3]) -> Coverage {
    let target = Record::new(viewport.width, viewport.height);
    let frame = Frame::new(target).expect("sides of 1 to 512");
    let mut frame = frame.with_tier(T::default());
    let vertices = corners.map(|corner| (clip_vertex(in_clip(corner, viewport)), []));
    for ((vertex, none), [x, y, _]) in vertices.iter().zip(corners) {
        let snapped = frame.snap(vertex, *none).snapped();
        let [across, down, w] = snapped::in_pixels(snapped, viewport);
        let same = across * PIXEL == x * w && down * PIXEL == y * w;
        assert!(same, "{x} {y} is snapped to {snapped:?}");
    }
    frame.draw_triangle(vertices, &Mark);
    let counts = frame.target_mut().take_counts();
    assert!(counts.iter().all(|&count| count <= 1), "a pixel is written twice: {corners:?}");
    counts.into_iter().map(|count| count == 1).collect()
}

/// How many pixel centres are on an edge of a triangle, its ends included.
fn ties(viewport: Viewport, corners: &[Vertex; 3]) -> u64 {
    let [a, b, c] = corners;
    let edge = |p: &Vertex, q: &Vertex, x: i64, y: i64| {
        (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])
    };
    let area = edge(a, b, c[0], c[1]).signum();
    let tie = |(x, y): (u32, u32)| {
        let [x, y] = [x, y].map(|v| i64::from(v) * PIXEL + PIXEL / 2);
        let edges = [(a, b), (b, c), (c, a)].map(|(p, q)| area * edge(p, q, x, y));
        area != 0 && edges.contains(&0) && edges.iter().all(|&edge| edge >= 0)
    };
    viewport.pixels().filter(|&pixel| tie(pixel)).count() as u64
}

/// What was compared, and how it went.
#[derive(Default)]
struct Tally {
    triangles: u64,
    pixels: u64,
    /// Pixels Mesa covers.
    covered: u64,
    /// Pixels whose centre is on an edge.
    ties: u64,
    /// In the exact tier and in `Quick<8>`.
    wrong: [u64; 2],
}

impl Tally {
    /// Compares one triangle; says where the first wrong pixel of it is.
    fn add(&mut self, viewport: Viewport, corners: &[Vertex; 3], mesa: &[bool]) {
        self.triangles += 1;
        self.pixels += mesa.len() as u64;
        self.covered += mesa.iter().filter(|&&covered| covered).count() as u64;
        self.ties += ties(viewport, corners);
        let tiers = [cover::<Exact>(viewport, corners), cover::<Quick<8>>(viewport, corners)];
        for ((wrong, ours), tier) in self.wrong.iter_mut().zip(tiers).zip(["exact", "quick8"]) {
            let differs: Vec<usize> = (0..mesa.len()).filter(|&i| ours[i] != mesa[i]).collect();
            *wrong += differs.len() as u64;
            if let Some(&first) = differs.first() {
                let (x, y) = (first % viewport.width as usize, first / viewport.width as usize);
                let said = if mesa[first] { "covered by Mesa only" } else { "not covered by Mesa" };
                println!("{tier}: pixel {x} {y} is {said}: {corners:?} on {viewport:?}");
            }
        }
    }

    /// The sum of two.
    fn join(&mut self, other: &Self) {
        self.triangles += other.triangles;
        self.pixels += other.pixels;
        self.covered += other.covered;
        self.ties += other.ties;
        for (wrong, other) in self.wrong.iter_mut().zip(other.wrong) {
            *wrong += other;
        }
    }

    /// A row of the table.
    fn row(&self, name: &str) -> String {
        let Self { triangles, pixels, covered, ties, wrong: [exact, quick] } = self;
        format!("{name:9} {triangles:10} {pixels:9} {covered:9} {ties:8} {exact:14} {quick:15}")
    }
}
