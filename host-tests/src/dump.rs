//! The scenes of the `dump` command: parsed whole, before anything is drawn.
//!
//! ```text
//! viewport W H            first; 1 to 512 each
//! tier NAME               exact (default), quick4, quick8
//! hither D                keep only w >= D, 1 <= D <= 2^20, in the units of w; off by default
//! clip A B C E            keep only A x + B y + C z + E w >= 0, integers within +-2^10; up to 4; `clip off` removes them
//! sides front|both        default front
//! tri x0 y0 w0 x1 y1 w1 x2 y2 w2     clip space, integers, one scale for all, -2^20 to 2^20 inclusive
//! z z0 z1 z2              after a tri: clip-space z (0 without it), same range
//! attr a0 a1 a2           after a tri, -65536 to 65536; only where a hither plane is set
//! depth                   after a tri: print the 16-bit depth too; only where a hither plane is set
//! ```
//!
//! An item a line, `#` begins a comment, and a setting applies to the triangles after it.

mod draw;

pub use draw::{coverage, snapped};

use std::fmt;

/// Largest magnitude of a coordinate, and of a hither distance.
const GRID: i32 = 1 << 20;

/// Largest magnitude of a clip plane's coefficient.
const COEFFICIENT: i32 = 1 << 10;

/// Largest magnitude of an attribute.
const ATTRIBUTE: f64 = 65536.0;

/// Clip planes at once.
const PLANES: usize = 4;

/// A tier by its name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TierName {
    /// `exact`.
    #[default]
    Exact,
    /// `quick4`.
    Quick4,
    /// `quick8`.
    Quick8,
}

impl TierName {
    /// All tiers.
    pub const ALL: [Self; 3] = [Self::Exact, Self::Quick4, Self::Quick8];

    /// The name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Quick4 => "quick4",
            Self::Quick8 => "quick8",
        }
    }
}

/// Which parts of a triangle are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sides {
    /// The one in front of the eye.
    #[default]
    Front,
    /// Also the one behind it.
    Both,
}

/// What applies to a triangle besides its own lines.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Settings {
    /// How vertices are snapped.
    pub tier: TierName,
    /// The least `w`, in raw units.
    pub hither: Option<i32>,
    /// Up to four planes, `[A, B, C, E]`.
    pub planes: Vec<[i32; 4]>,
    /// Which parts.
    pub sides: Sides,
}

/// A triangle with all that is said about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangle {
    /// What applied where it was named.
    pub settings: Settings,
    /// `[x, y, w]` each, in raw units.
    pub corners: [[i32; 3]; 3],
    /// z a corner, in the same units.
    pub z: Option<[i32; 3]>,
    /// An attribute a corner.
    pub attribute: Option<[f64; 3]>,
    /// Whether depth is printed.
    pub depth: bool,
}

/// A scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Width and height in pixels; 0 where nothing is to be drawn.
    pub viewport: (u32, u32),
    /// In the order they are drawn.
    pub triangles: Vec<Triangle>,
}

/// A line that cannot be taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LineError {
    /// From 1.
    pub line: usize,
    /// What is wrong with it.
    pub why: String,
}

impl fmt::Display for LineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.why)
    }
}

impl std::error::Error for LineError {}

impl Scene {
    /// A scene from its text.
    ///
    /// # Errors
    ///
    /// [`LineError`] for the first line that cannot be taken.
    pub fn parse(text: &[u8]) -> Result<Self, LineError> {
        let mut parser = Parser::default();
        for (index, line) in text.split(|&byte| byte == b'\n').enumerate() {
            let taken = std::str::from_utf8(line)
                .map_err(|_| "it is not UTF-8".to_owned())
                .and_then(|line| parser.take(line));
            taken.map_err(|why| LineError { line: index + 1, why })?;
        }
        Ok(parser.scene)
    }
}

/// What has been read so far.
#[derive(Default)]
struct Parser {
    scene: Scene,
    settings: Settings,
}

impl Parser {
    fn take(&mut self, line: &str) -> Result<(), String> {
        let line = line.split('#').next().unwrap_or_default();
        let mut words = line.split_whitespace();
        let Some(item) = words.next() else {
            return Ok(());
        };
        let words: Vec<&str> = words.collect();
        if item == "viewport" {
            return self.viewport(&words);
        }
        if self.scene.viewport == (0, 0) {
            return Err(format!("`{item}` before the viewport, which must come first"));
        }
        match item {
            "tier" => self.tier(&words),
            "hither" => {
                let [distance] = integers(&words, 1, GRID)?;
                self.settings.hither = Some(distance);
                Ok(())
            }
            "clip" => self.clip(&words),
            "sides" => {
                self.settings.sides = match words[..] {
                    ["front"] => Sides::Front,
                    ["both"] => Sides::Both,
                    _ => return Err("sides are `front` or `both`".to_owned()),
                };
                Ok(())
            }
            "tri" => self.triangle(&words),
            "z" => {
                let z = integers(&words, -GRID, GRID)?;
                once(&mut self.last(item)?.z, z, item)
            }
            "attr" => {
                let attribute = attributes(&words)?;
                once(&mut self.last_in_front(item)?.attribute, attribute, item)
            }
            "depth" => {
                let [] = integers(&words, 0, 0)?;
                let triangle = self.last_in_front(item)?;
                if triangle.depth {
                    return Err("a second `depth` for one triangle".to_owned());
                }
                triangle.depth = true;
                Ok(())
            }
            _ => Err(format!("`{item}` is no item of a scene")),
        }
    }

    fn viewport(&mut self, words: &[&str]) -> Result<(), String> {
        if self.scene.viewport != (0, 0) {
            return Err("a second viewport".to_owned());
        }
        let sides: [i32; 2] = integers(words, 1, i32::from(hither::Viewport::MAX_SIDE))?;
        let [width, height] = sides.map(i32::unsigned_abs);
        self.scene.viewport = (width, height);
        Ok(())
    }

    fn tier(&mut self, words: &[&str]) -> Result<(), String> {
        let [name] = words else {
            return Err(format!("{} words for a tier's name", words.len()));
        };
        let tier = TierName::ALL.into_iter().find(|tier| tier.name() == *name);
        self.settings.tier = tier.ok_or_else(|| format!("`{name}` is no tier"))?;
        Ok(())
    }

    fn clip(&mut self, words: &[&str]) -> Result<(), String> {
        if words == ["off"] {
            self.settings.planes.clear();
            return Ok(());
        }
        let plane = integers(words, -COEFFICIENT, COEFFICIENT)?;
        if self.settings.planes.len() == PLANES {
            return Err(format!("more than {PLANES} clip planes at once"));
        }
        self.settings.planes.push(plane);
        Ok(())
    }

    fn triangle(&mut self, words: &[&str]) -> Result<(), String> {
        let all: [i32; 9] = integers(words, -GRID, GRID)?;
        let [x0, y0, w0, x1, y1, w1, x2, y2, w2] = all;
        self.scene.triangles.push(Triangle {
            settings: self.settings.clone(),
            corners: [[x0, y0, w0], [x1, y1, w1], [x2, y2, w2]],
            z: None,
            attribute: None,
            depth: false,
        });
        Ok(())
    }

    /// The triangle that a line is about.
    fn last(&mut self, item: &str) -> Result<&mut Triangle, String> {
        let last = self.scene.triangles.last_mut();
        last.ok_or_else(|| format!("`{item}` before any triangle"))
    }

    /// The triangle that a line is about, if it has a hither plane.
    fn last_in_front(&mut self, item: &str) -> Result<&mut Triangle, String> {
        let last = self.last(item)?;
        if last.settings.hither.is_none() {
            return Err(format!("`{item}` for a triangle without a hither plane"));
        }
        Ok(last)
    }
}

/// Sets what may be said once of a triangle.
fn once<T>(place: &mut Option<T>, value: T, item: &str) -> Result<(), String> {
    if place.replace(value).is_some() {
        return Err(format!("a second `{item}` for one triangle"));
    }
    Ok(())
}

/// `N` integers from `low` to `high`.
fn integers<const N: usize>(words: &[&str], low: i32, high: i32) -> Result<[i32; N], String> {
    numbers(words, |word| {
        let value = word.parse().ok().filter(|value| (low..=high).contains(value));
        value.ok_or_else(|| format!("`{word}` is not an integer from {low} to {high}"))
    })
}

/// Three attributes.
fn attributes(words: &[&str]) -> Result<[f64; 3], String> {
    numbers(words, |word| {
        let value = word.parse().ok().filter(|value: &f64| value.abs() <= ATTRIBUTE);
        value.ok_or_else(|| format!("`{word}` is not a number from -{ATTRIBUTE} to {ATTRIBUTE}"))
    })
}

/// `N` words, each read by `read`.
fn numbers<T: Copy + Default, const N: usize>(
    words: &[&str],
    read: impl Fn(&str) -> Result<T, String>,
) -> Result<[T; N], String> {
    if words.len() != N {
        return Err(format!("{} numbers where {N} are needed", words.len()));
    }
    let mut values = [T::default(); N];
    for (value, word) in values.iter_mut().zip(words) {
        *value = read(word)?;
    }
    Ok(values)
}

#[cfg(test)]
mod tests;
