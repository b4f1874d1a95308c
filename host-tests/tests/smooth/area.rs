//! Exact areas, in `f64`.

/// A point on the screen, in pixels.
pub type Place = [f64; 2];

/// What is left of an outline where `a x + b y + c >= 0` (Sutherland & Hodgman 1974): of an outline that is not convex with
/// edges along the line that take no area.
fn cut(outline: &[Place], [a, b, c]: [f64; 3]) -> Vec<Place> {
    let value = |p: Place| a * p[0] + b * p[1] + c;
    let mut left = Vec::new();
    for (i, &p) in outline.iter().enumerate() {
        let q = outline[(i + 1) % outline.len()];
        let (at_p, at_q) = (value(p), value(q));
        if at_p >= 0.0 {
            left.push(p);
        }
        if (at_p >= 0.0) != (at_q >= 0.0) {
            let t = at_p / (at_p - at_q);
            left.push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]);
        }
    }
    left
}

/// The area of an outline, without its sign.
fn area(outline: &[Place]) -> f64 {
    let Some(&first) = outline.first() else { return 0.0 };
    let next = |i: usize| outline[(i + 1) % outline.len()];
    let from = |p: Place| [p[0] - first[0], p[1] - first[1]];
    let doubled: f64 = (0..outline.len())
        .map(|i| (from(outline[i]), from(next(i))))
        .map(|(p, q)| p[0] * q[1] - p[1] * q[0])
        .sum();
    doubled.abs() / 2.0
}

/// How much of pixel `(x, y)` all of these half planes `a x + b y + c >= 0` have.
pub fn of_half_planes(planes: &[[f64; 3]], (x, y): (u32, u32)) -> f64 {
    // From the pixel's centre, so that nothing is large.
    let centre = [f64::from(x) + 0.5, f64::from(y) + 0.5];
    let mut left = vec![[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
    for &[a, b, c] in planes {
        left = cut(&left, [a, b, a * centre[0] + b * centre[1] + c]);
    }
    area(&left)
}

/// How much of pixel `(x, y)` a simple polygon covers.
pub fn of_polygon(outline: &[Place], (x, y): (u32, u32)) -> f64 {
    let (x, y) = (f64::from(x), f64::from(y));
    let mut left: Vec<Place> = outline.iter().map(|p| [p[0] - x, p[1] - y]).collect();
    for side in [[1.0, 0.0, 0.0], [-1.0, 0.0, 1.0], [0.0, 1.0, 0.0], [0.0, -1.0, 1.0]] {
        left = cut(&left, side);
    }
    area(&left)
}
