//! Positions: a model's vertex through a matrix, against real numbers.

use hither::{
    Frame, Hither, I16F16, Mat4, ModelPosition, Preset, Scene, Snapped, Tier, Vertex, VertexStage,
};
use host_tests::oracle::Rng;
use host_tests::record::Record;

use crate::climb::{climb, seed_of_run};

/// A vertex and the ideal matrix: rows x, y and w.
#[derive(Clone, Debug)]
pub struct Placed {
    rows: [[f64; 4]; 3],
    raw: [i32; 3],
    fraction_bits: u32,
}

/// The largest error found.
pub fn search(scene: &Scene, off: impl Fn(&Placed, &Scene) -> Option<f64>) -> f64 {
    let mut largest = 0.0f64;
    let mut rng = Rng::new(11 + seed_of_run());
    climb(
        &mut rng,
        60_000,
        |rng, i| Placed::seed(scene, rng, i),
        |rng, placed| placed.change(scene, rng),
        |placed| {
            let off = off(placed, scene)?;
            largest = largest.max(off);
            Some(off)
        },
    );
    largest
}

impl Placed {
    fn seed(scene: &Scene, rng: &mut Rng, i: u32) -> Self {
        let extent = f64::from(scene.extent);
        let fraction_bits = (32767.0 / extent).log2().floor().clamp(0.0, 15.0) as u32;
        let corner = (extent * f64::from(fraction_bits).exp2()).floor() as i64;
        let raw = [0; 3].map(|_: i32| {
            let size = if i % 2 == 0 { corner } else { rng.range(0, corner) };
            (if rng.once_in(2) { size } else { -size }) as i32
        });
        let mut placed = Self { rows: [[0.0; 4]; 3], raw, fraction_bits };
        let position = placed.position();
        let (near, far) = (f64::from(scene.near), f64::from(scene.far));
        let w = if i % 3 == 0 { rng.between(near, far) } else { near };
        let aims = [0, 1].map(|_| if rng.once_in(2) { w } else { -w });
        // Entries that are rounded by nearly half a step, in the way that moves the vertex out, or in.
        let out = if rng.once_in(2) { 1.0 } else { -1.0 };
        let ways = [out * aims[0].signum(), out * aims[1].signum(), -out];
        for ((row, aim), way) in placed.rows.iter_mut().zip([aims[0], aims[1], w]).zip(ways) {
            let mut sum = 0.0;
            for (entry, at) in row.iter_mut().zip(position) {
                let most = f64::from(scene.stretch) / 3.0;
                // As many bits as there may be, or half of them, so that 16 are cut in one way.
                let whole = (rng.between(-most, most) * 65_536.0).floor();
                let cut = f64::from(1u32 << rng.below(7));
                let whole =
                    (whole / cut).floor() * cut + rng.choose(&[0.0, cut / 2.0, cut / 2.0 - 1.0]);
                *entry = (whole - way * at.signum() * 0.49) / 65_536.0;
                sum += *entry * at;
            }
            let whole = ((aim - sum) * 65_536.0).round();
            row[3] = (whole - way * 0.49) / 65_536.0;
        }
        placed
    }

    fn change(&mut self, scene: &Scene, rng: &mut Rng) {
        let row = rng.below(3) as usize;
        match rng.below(5) {
            0 => {
                let axis = rng.below(3) as usize;
                let limit = f64::from(scene.extent) * f64::from(self.fraction_bits).exp2();
                let most = 1 << rng.below(14);
                let by = rng.signed(most);
                let at = (i64::from(self.raw[axis]) + by).clamp(-limit as i64, limit as i64);
                self.raw[axis] = at as i32;
            }
            1 => self.rows[row][3] += rng.between(-8.0, 8.0) / 65_536.0,
            2 => {
                // Along the row, so that the vertex stays about where it is.
                let axis = rng.below(3) as usize;
                let by = rng.signed(1 << 12) as f64 / 65_536.0;
                self.rows[row][axis] += by;
                let at = self.position()[axis];
                self.rows[row][3] -= by * at;
            }
            3 => {
                let axis = rng.below(4) as usize;
                self.rows[row][axis] += rng.between(-1.0, 1.0) / 65_536.0;
            }
            _ => {
                let axis = rng.below(3) as usize;
                let by = rng.range(-64, 64) as f64 / 65_536.0;
                self.rows[row][axis] += by;
            }
        }
    }

    fn position(&self) -> [f64; 3] {
        self.raw.map(|v| f64::from(v) / f64::from(self.fraction_bits).exp2())
    }

    /// The ideal x, y and w, where all is within the scene's bounds and on the screen.
    fn ideal(&self, scene: &Scene) -> Option<[f64; 3]> {
        let position = self.position();
        let within = |v: f64| v.abs() <= f64::from(scene.extent);
        let stretch = |row: &[f64; 4]| row[..3].iter().map(|v| v.abs()).sum::<f64>();
        let fits = self.rows.iter().all(|row| stretch(row) <= f64::from(scene.stretch));
        let clip = self.rows.map(|row| {
            row[3] + row.iter().zip(position).map(|(entry, at)| entry * at).sum::<f64>()
        });
        let [x, y, w] = clip;
        let seen = x.abs() <= w && y.abs() <= w;
        let ranged = w >= f64::from(scene.near) && w <= f64::from(scene.far);
        (position.iter().all(|&v| within(v)) && fits && seen && ranged).then_some(clip)
    }

    /// How far the library's vertex is from the ideal one, in pixels.
    pub fn off<P: Preset, S: VertexStage<(), 0>>(
        &self,
        stage: impl Fn(&Mat4) -> S,
        scene: &Scene,
    ) -> Option<f64> {
        let [x, y, w] = self.ideal(scene)?;
        let fixed = |v: f64| I16F16::from_bits((v * 65_536.0).round() as i32);
        let [rx, ry, rw] = self.rows.map(|row| row.map(fixed));
        let matrix = Mat4::from_rows([rx, ry, [I16F16::ZERO; 4], rw]).ok()?;
        let position = ModelPosition { raw: self.raw, fraction_bits: self.fraction_bits };
        let (clip, []) = stage(&matrix).vertex(position, &());
        let (width, height) = (scene.width, scene.height);
        let hither = Hither::new(I16F16::from_num(scene.near)).expect("above 0");
        let frame = Frame::new(Record::<()>::new(width, height)).expect("a viewport");
        let frame = frame.with_preset(P::default()).with_hither(hither);
        let vertex: Vertex<_> = frame.snap(&clip, []);
        let (width, height) = (f64::from(width), f64::from(height));
        let to_pixels = |x: f64, y: f64| [width / 2.0 * (1.0 + x), height / 2.0 * (1.0 - y)];
        let got = match vertex.snapped() {
            Snapped::Projected { point, subpixel_bits } => {
                point.map(|v| f64::from(v) / f64::from(subpixel_bits).exp2())
            }
            // Behind the hither plane by what was rounded: its grid is another.
            Snapped::Homogeneous { .. } if <P::Tier as Tier>::PROJECTS => return None,
            Snapped::Homogeneous { point, .. } => {
                let [x, y, w] = point.map(f64::from);
                to_pixels(x / w, y / w)
            }
        };
        let want = to_pixels(x / w, y / w);
        Some((got[0] - want[0]).abs().max((got[1] - want[1]).abs()))
    }
}
