//! Smooth edges and filled shapes against exact areas.

mod area;
mod depth;
mod meshes;
mod shapes;
mod triangles;

use hither::{Alpha, I16F16};
use host_tests::record::Record;

/// What is recorded: shares of pixels.
type Shares = Record<Alpha<()>>;

/// How far pixels that an edge cuts are off, in pixels.
#[derive(Clone, Copy, Debug, Default)]
struct Errors {
    count: u32,
    sum: f64,
    largest: f64,
}

impl Errors {
    /// Counts a pixel, if an edge cuts it, or it is shown so.
    fn add(&mut self, got: f64, exact: f64) {
        let cut = |share: f64| share > 1e-9 && share < 1.0 - 1e-9;
        if cut(got) || cut(exact) {
            self.count += 1;
            self.sum += (got - exact).abs();
            self.largest = self.largest.max((got - exact).abs());
        } else {
            assert!((got - exact).abs() < 1e-6, "{got} where {exact} is covered");
        }
    }

    /// Prints them, and fails where they are larger than this on average, or anywhere.
    fn check(self, name: &str, mean: f64, largest: f64) {
        let Self { count, sum, largest: most } = self;
        let average = sum / f64::from(count);
        println!("{name}: mean {average:.4}, largest {most:.4} of a pixel, over {count} pixels");
        assert!(count > 500, "{name}: only {count} pixels");
        assert!(average <= mean, "{name}: {average:.4} on average, more than {mean}");
        assert!(most <= largest, "{name}: {most:.4}, more than {largest}");
    }
}

/// The alphas of a target, row by row, and how often each pixel was drawn.
fn alphas(record: &Shares, (width, height): (u32, u32)) -> (Vec<f64>, Vec<u32>) {
    let (mut shares, mut counts) =
        (vec![0.0; (width * height) as usize], vec![0; (width * height) as usize]);
    for &(x, y, Alpha { alpha, .. }) in &record.pixels {
        assert!(alpha > 0, "({x}, {y}) is drawn with nothing");
        let at = (y * width + x) as usize;
        // Over each other.
        shares[at] = 1.0 - (1.0 - shares[at]) * (1.0 - f64::from(alpha) / 255.0);
        counts[at] += 1;
    }
    (shares, counts)
}

/// A number of a 65,536th.
fn fixed(v: f64) -> I16F16 {
    I16F16::from_bits((v * 65536.0).round() as i32)
}
