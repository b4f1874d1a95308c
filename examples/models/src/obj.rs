//! Wavefront OBJ: text to positions, texture coordinates, normals and faces.
//!
//! What is read: `v x y z`, with a weight (`v x y z w`, which polygons have no use for), a colour (`v x y z r g b`, each 0 to 1)
//! or both a colour and an opacity; `vt u`, `vt u v` and `vt u v w`; `vn x y z`; and `f` with three corners or more, each
//! `v`, `v/vt`, `v//vn` or `v/vt/vn`. An index may be negative: -1 is the last one before the face. A positive one may also name
//! what comes after it. Lines end with LF, CRLF or CR; a `\` at the end of one goes on with the next; `#` begins a comment.
//!
//! What names or groups things (`g`, `o`, `s`, `mg`, `lod`, ...) is skipped: it changes no triangle. Materials, points, lines and
//! curves are skipped with a [`Warning`], as is what OBJ does not have: the model will look different from what its author saw.

use crate::error::{ObjError, Problem};

/// What an OBJ holds, in its own order and numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Obj {
    /// Positions: `v`.
    pub positions: Vec<Position>,
    /// Texture coordinates: `vt`, v upwards.
    pub coordinates: Vec<Coordinate>,
    /// Normals of any length: `vn`.
    pub normals: Vec<[f64; 3]>,
    /// Faces: `f`, every index in range.
    pub faces: Vec<Face>,
    /// Lines there are.
    pub lines: usize,
    /// What was skipped though it shows.
    pub warnings: Vec<Warning>,
}

/// A position, finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Position {
    /// Where it is given.
    pub line: usize,
    /// x, y, z.
    pub at: [f64; 3],
    /// Red, green and blue in `[0, 1]`.
    pub color: Option<[f64; 3]>,
}

/// A texture coordinate, finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinate {
    /// Where it is given.
    pub line: usize,
    /// u and v, v upwards.
    pub at: [f64; 2],
}

/// A polygon of three corners or more. All of them have texture coordinates or none; normals likewise.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// Where it is given.
    pub line: usize,
    /// Its corners, counter-clockwise seen from its front.
    pub corners: Vec<Corner>,
}

/// A corner of a face: places in the lists of an [`Obj`], from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corner {
    /// Of the positions.
    pub position: usize,
    /// Of the texture coordinates.
    pub coordinate: Option<usize>,
    /// Of the normals.
    pub normal: Option<usize>,
}

/// Something that was skipped though it shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Where it is first.
    pub line: usize,
    /// How often it is there.
    pub times: usize,
    /// What it is.
    pub what: String,
}

impl std::fmt::Display for Warning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { line, times, what } = self;
        match times {
            1 => write!(f, "line {line}: {what}"),
            _ => write!(f, "line {line}: {what} ({times} times)"),
        }
    }
}

impl Obj {
    /// Reads a file's bytes.
    ///
    /// # Errors
    ///
    /// [`ObjError`] with the line of what cannot be read. An OBJ without a face is one too.
    pub fn parse(bytes: &[u8]) -> Result<Self, ObjError> {
        let text = utf8(bytes)?;
        let mut obj = Self::default();
        let mut statement = Statement::default();
        let mut rest = text.strip_prefix('\u{feff}').unwrap_or(text);
        while let Some(after) = statement.next(rest, &mut obj.lines) {
            rest = after;
            if let Some((keyword, words)) = statement.words.split_first() {
                let problem = obj.take(keyword, words, statement.line);
                problem.map_err(|problem| ObjError { line: statement.line, problem })?;
            }
        }
        if obj.faces.is_empty() {
            return Err(ObjError { line: obj.lines.max(1), problem: Problem::Faceless });
        }
        obj.check_indices()?;
        Ok(obj)
    }

    fn take(&mut self, keyword: &str, words: &[&str], line: usize) -> Result<(), Problem> {
        match keyword {
            "v" => self.take_position(words, line)?,
            "vt" => {
                let [u, v, ..] = numbers("vt", "1 to 3", words, |n| (1..=3).contains(&n))?;
                self.coordinates.push(Coordinate { line, at: [u, v] });
            }
            "vn" => {
                let [x, y, z, ..] = numbers("vn", "3", words, |n| n == 3)?;
                self.normals.push([x, y, z]);
            }
            "f" | "fo" => self.take_face(words, line)?,
            "g" | "o" | "s" | "mg" | "vp" | "lod" | "bevel" | "c_interp" | "d_interp"
            | "shadow_obj" | "trace_obj" | "call" | "csh" | "maplib" => {}
            "mtllib" | "usemtl" | "usemap" => {
                self.warn(line, format!("`{keyword}` is skipped: materials are not read"));
            }
            "p" | "l" | "cstype" | "deg" | "bmat" | "step" | "curv" | "curv2" | "surf" | "parm"
            | "trim" | "hole" | "scrv" | "sp" | "end" | "con" | "ctech" | "stech" | "bzp"
            | "bsp" | "cdc" | "cdp" | "res" => {
                self.warn(line, format!("`{keyword}` is skipped: only faces are drawn"));
            }
            _ => {
                self.warn(line, format!("`{}` is skipped: it is no keyword of OBJ", shown(keyword)))
            }
        }
        Ok(())
    }

    fn take_position(&mut self, words: &[&str], line: usize) -> Result<(), Problem> {
        let fits = |n| matches!(n, 3 | 4 | 6 | 7);
        let [x, y, z, colors @ ..] = numbers("v", "3, 4, 6 or 7", words, fits)?;
        let color = (words.len() >= 6).then_some([colors[0], colors[1], colors[2]]);
        for value in color.into_iter().flatten() {
            if !(0.0..=1.0).contains(&value) {
                return Err(Problem::Color { value });
            }
        }
        if words.len() == 4 && colors[0] != 1.0 {
            self.warn(
                line,
                "the weight of `v` is skipped: only curves have a use for it".to_owned(),
            );
        }
        self.positions.push(Position { line, at: [x, y, z], color });
        Ok(())
    }

    fn take_face(&mut self, words: &[&str], line: usize) -> Result<(), Problem> {
        if words.len() < 3 {
            return Err(Problem::Corners { got: words.len() });
        }
        let counts = [self.positions.len(), self.coordinates.len(), self.normals.len()];
        let corners =
            words.iter().map(|word| corner(word, counts)).collect::<Result<Vec<_>, _>>()?;
        let some_only =
            |has: fn(&Corner) -> bool| corners.iter().any(has) && !corners.iter().all(has);
        if some_only(|corner| corner.coordinate.is_some()) {
            return Err(Problem::Mixed { part: COORDINATES });
        }
        if some_only(|corner| corner.normal.is_some()) {
            return Err(Problem::Mixed { part: NORMALS });
        }
        self.faces.push(Face { line, corners });
        Ok(())
    }

    fn warn(&mut self, line: usize, what: String) {
        if let Some(warning) = self.warnings.iter_mut().find(|warning| warning.what == what) {
            warning.times += 1;
        } else if self.warnings.len() < MAX_WARNINGS {
            self.warnings.push(Warning { line, times: 1, what });
        }
    }

    /// Positive indices, now that all is read.
    fn check_indices(&self) -> Result<(), ObjError> {
        let counts = [self.positions.len(), self.coordinates.len(), self.normals.len()];
        for face in &self.faces {
            for corner in &face.corners {
                let places = [Some(corner.position), corner.coordinate, corner.normal];
                for ((place, count), of) in places.into_iter().zip(counts).zip(PARTS) {
                    if let Some(place) = place.filter(|place| *place >= count) {
                        let index =
                            i64::try_from(place).map_or(i64::MAX, |place| place.saturating_add(1));
                        let problem = Problem::Index { of, index, count };
                        return Err(ObjError { line: face.line, problem });
                    }
                }
            }
        }
        Ok(())
    }
}

/// Different warnings that are kept: a file that is no OBJ may have as many as lines.
const MAX_WARNINGS: usize = 32;

const COORDINATES: &str = "texture coordinates";
const NORMALS: &str = "normals";
const PARTS: [&str; 3] = ["positions", COORDINATES, NORMALS];

/// A statement's words, over as many lines as it goes on.
#[derive(Default)]
struct Statement<'a> {
    line: usize,
    words: Vec<&'a str>,
}

impl<'a> Statement<'a> {
    /// Takes the next statement of a text, and counts its lines; what is left of the text, or `None` at its end.
    fn next(&mut self, text: &'a str, lines: &mut usize) -> Option<&'a str> {
        self.words.clear();
        self.line = *lines + 1;
        if text.is_empty() {
            return None;
        }
        let mut rest = text;
        loop {
            let (line, after) = match rest.find(['\n', '\r']) {
                Some(end) => {
                    let (line, end) = rest.split_at(end);
                    (line, end.strip_prefix("\r\n").unwrap_or(&end[1..]))
                }
                None => (rest, ""),
            };
            *lines += 1;
            rest = after;
            let (said, comment) =
                line.split_once('#').map_or((line, false), |(said, _)| (said, true));
            let goes_on = if comment { None } else { said.trim_end().strip_suffix('\\') };
            self.words.extend(goes_on.unwrap_or(said).split_ascii_whitespace());
            if goes_on.is_none() || rest.is_empty() {
                return Some(rest);
            }
        }
    }
}

fn utf8(bytes: &[u8]) -> Result<&str, ObjError> {
    std::str::from_utf8(bytes).map_err(|error| {
        let before = bytes.get(..error.valid_up_to()).unwrap_or_default();
        let ends = (0..before.len()).filter(|&i| match before[i] {
            b'\n' => true,
            b'\r' => before.get(i + 1) != Some(&b'\n'),
            _ => false,
        });
        let byte = bytes.get(before.len()).copied().unwrap_or_default();
        ObjError { line: 1 + ends.count(), problem: Problem::Encoding { byte } }
    })
}

/// Up to seven numbers; 0 for those that are not there.
fn numbers(
    keyword: &'static str,
    takes: &'static str,
    words: &[&str],
    fits: impl Fn(usize) -> bool,
) -> Result<[f64; 7], Problem> {
    let got = words.len();
    if !fits(got) {
        return Err(Problem::Count { keyword, takes, got });
    }
    let mut numbers = [0.0; 7];
    for (number, word) in numbers.iter_mut().zip(words) {
        let parsed = word.parse::<f64>().ok().filter(|number| number.is_finite());
        *number = parsed.ok_or_else(|| Problem::Number { text: shown(word) })?;
    }
    Ok(numbers)
}

/// A corner of a face, where there are as many of each part before it.
fn corner(word: &str, counts: [usize; 3]) -> Result<Corner, Problem> {
    let mut parts = word.split('/');
    let mut places = [None; 3];
    for ((place, count), of) in places.iter_mut().zip(counts).zip(PARTS) {
        let part = parts.next().unwrap_or_default();
        if !part.is_empty() {
            let index = part.parse::<i64>().map_err(|_| Problem::Corner { text: shown(word) })?;
            *place = Some(place_of(index, count).ok_or(Problem::Index { of, index, count })?);
        }
    }
    match (places, parts.next()) {
        ([Some(position), coordinate, normal], None) => Ok(Corner { position, coordinate, normal }),
        _ => Err(Problem::Corner { text: shown(word) }),
    }
}

/// The place from 0 that an index names. A positive one is checked when all is read.
fn place_of(index: i64, count: usize) -> Option<usize> {
    let size = usize::try_from(index.unsigned_abs()).ok()?;
    if index < 0 { count.checked_sub(size) } else { size.checked_sub(1) }
}

/// A word of a file for a message: control characters escaped, at most 32 characters.
fn shown(word: &str) -> String {
    let mut shown: String = word.chars().take(32).flat_map(char::escape_debug).collect();
    if word.chars().nth(32).is_some() {
        shown.push_str("...");
    }
    shown
}

#[cfg(test)]
mod tests;
