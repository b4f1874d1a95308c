//! The list under a plot that says which point a number beside a mark is.

use super::Group;
use crate::trade::Point;
use crate::trade::number::{escaped, short};

/// Of the plot and its key.
pub(super) const WIDTH: f64 = 360.0;

/// Letters of a name in one line of the key.
const LETTERS: usize = 46;

/// From line to line.
const LINE: f64 = 12.0;

/// Right ends of the columns of costs and errors.
const COLUMNS: [f64; 2] = [306.0, 352.0];

/// The names of points at one place as one: `quick8 every8/every16 packed (2 points)`, the blanks in brackets not to be broken at.
fn joined(names: &[&str]) -> String {
    if let [only] = names {
        return (*only).to_owned();
    }
    let words: Vec<Vec<&str>> = names.iter().map(|name| name.split(' ').collect()).collect();
    let count = words.first().map_or(0, Vec::len);
    if words.iter().any(|words| words.len() != count) {
        return names.join("; ");
    }
    let column = |at: usize| {
        let mut seen: Vec<&str> = Vec::new();
        for words in &words {
            if !seen.contains(&words[at]) {
                seen.push(words[at]);
            }
        }
        seen.join("/")
    };
    format!(
        "{} ({}\u{a0}points)",
        (0..count).map(column).collect::<Vec<_>>().join(" "),
        names.len()
    )
}

/// The presets among the points of a group, each once.
pub(super) fn presets(points: &[Point], group: &Group) -> Vec<&'static str> {
    group.members.iter().filter_map(|&index| points[index].preset).collect()
}

/// Lines of the key's width, broken between words or behind `/`.
fn lines(text: &str) -> Vec<String> {
    let letters = |text: &str| text.chars().count();
    let mut lines = vec![String::new()];
    let pieces = text.split_inclusive(' ').flat_map(|word| word.split_inclusive('/'));
    for piece in pieces {
        let last = lines.len() - 1;
        if !lines[last].is_empty()
            && letters(&lines[last]) + letters(piece.trim_end_matches(' ')) > LETTERS
        {
            lines.push(String::new());
        }
        let last = lines.len() - 1;
        lines[last].push_str(piece);
    }
    lines
}

/// The key as SVG, and where it ends. `numbered` are the groups that are named, with the front's numbers.
pub(super) fn key(
    points: &[Point],
    numbered: &[(Option<usize>, &Group)],
    unit: &str,
    top: f64,
) -> (String, f64) {
    let [cost, error] = COLUMNS;
    let mut svg = format!(
        "<text class=\"soft\" x=\"{cost}\" y=\"{top}\" text-anchor=\"end\">cost</text>\
         <text class=\"soft\" x=\"{error}\" y=\"{top}\" text-anchor=\"end\">{unit}</text>\n"
    );
    let mut y = top;
    for &(number, group) in numbered {
        let (row, end) = entry(points, number, group, y + LINE + 1.0);
        svg.push_str(&row);
        y = end;
    }
    (svg, y)
}

/// What a row says of its points: presets by name, with how many others are at their place, or else all names as one.
fn described(points: &[Point], group: &Group) -> String {
    let is_preset = |index: &&usize| points[**index].preset.is_some();
    let (presets, others): (Vec<&usize>, Vec<&usize>) = group.members.iter().partition(is_preset);
    let name = |index: &&usize| points[**index].name.as_str();
    if presets.is_empty() {
        return joined(&others.iter().map(name).collect::<Vec<_>>());
    }
    let presets: Vec<&str> = presets.iter().map(name).collect();
    let presets = presets.join("; ");
    match others.len() {
        0 => presets,
        others => format!("{presets} (and\u{a0}{others}\u{a0}more)"),
    }
}

/// A row of the key, and where its last line is.
fn entry(points: &[Point], number: Option<usize>, group: &Group, top: f64) -> (String, f64) {
    let presets = presets(points, group).join(", ");
    let names = described(points, group);
    let text = if presets.is_empty() { names } else { format!("{presets}: {names}") };
    let number = number.map_or_else(|| "·".to_owned(), |number| number.to_string());
    let [cost, error] = COLUMNS;
    let mut svg = format!(
        "<text class=\"number\" x=\"20\" y=\"{top}\" text-anchor=\"end\">{number}</text>\
         <text x=\"{cost}\" y=\"{top}\" text-anchor=\"end\">{}</text>\
         <text x=\"{error}\" y=\"{top}\" text-anchor=\"end\">{}</text>",
        short(group.cost),
        short(group.error),
    );
    let lines = lines(&text);
    for (index, line) in lines.iter().enumerate() {
        let y = top + LINE * index as f64;
        svg += &written(line, if index == 0 { presets.len() } else { 0 }, y);
    }
    svg.push('\n');
    (svg, top + LINE * (lines.len() - 1) as f64)
}

/// A line of a name, its start bold.
fn written(line: &str, bold: usize, y: f64) -> String {
    let (bold, rest) = line.split_at(bold.min(line.len()));
    let (bold, rest) = (escaped(bold), escaped(rest.trim_end()));
    if bold.is_empty() {
        return format!("<text x=\"26\" y=\"{y}\">{rest}</text>");
    }
    format!("<text x=\"26\" y=\"{y}\"><tspan class=\"named\">{bold}</tspan>{rest}</text>")
}

#[cfg(test)]
mod tests {
    use super::{LETTERS, joined, lines};

    #[test]
    fn names_at_one_place_are_one() {
        assert_eq!(joined(&["a b c"]), "a b c");
        assert_eq!(joined(&["a b c", "a d c", "a d e"]), "a b/d c/e (3\u{a0}points)");
        assert_eq!(joined(&["a b", "a"]), "a b; a");
    }

    #[test]
    fn long_names_are_broken() {
        let name = "quick8 every8/every16/every32 packed newton1/newton2 depth16/depth32 mat32";
        let lines = lines(name);
        assert_eq!(lines.concat(), name);
        assert!(lines.len() == 2 && lines.iter().all(|line| line.trim_end().len() <= LETTERS));
    }
}
