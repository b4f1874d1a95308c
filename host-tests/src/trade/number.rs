//! Numbers and names as plots and the page show them.

/// Three digits or so: `12.3`, `0.0421`, `1.23 M`, `4.1·10⁻⁵`.
pub(super) fn short(value: f64) -> String {
    match value.abs() {
        size if size.is_infinite() => "equal".to_owned(),
        0.0 => "0".to_owned(),
        size if size >= 1e6 => format!("{:.2} M", value / 1e6),
        size if size >= 1e4 => format!("{:.1} k", value / 1e3),
        size if size >= 100.0 => format!("{value:.0}"),
        size if size >= 10.0 => format!("{value:.1}"),
        size if size >= 1.0 => format!("{value:.2}"),
        size if size >= 0.1 => format!("{value:.3}"),
        size if size >= 1e-3 => format!("{value:.4}"),
        _ => scientific(value),
    }
}

/// A round number, without zeros at its end.
pub(super) fn tick(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if size >= 1e6 => format!("{} M", rounded(value / 1e6)),
        size if size >= 1e4 => format!("{} k", rounded(value / 1e3)),
        size if size >= 0.999e-3 => rounded(value).to_string(),
        _ => scientific(value),
    }
}

/// Without what binary fractions add.
fn rounded(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

/// `4.1·10⁻⁵`, or `10⁻⁵` where the first factor is 1.
fn scientific(value: f64) -> String {
    let text = format!("{value:.1e}");
    let Some((factor, exponent)) = text.split_once('e') else { return text };
    let exponent: String = exponent.chars().map(superscript).collect();
    match factor.trim_end_matches(".0") {
        "1" => format!("10{exponent}"),
        factor => format!("{factor}·10{exponent}"),
    }
}

/// A digit or sign as an exponent is written.
const fn superscript(digit: char) -> char {
    match digit {
        '-' => '⁻',
        '0' => '⁰',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        _ => '⁹',
    }
}

/// A text within markup or within an attribute's double quotes.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
        .replace('\'', "&#39;")
}

#[cfg(test)]
mod tests {
    use super::{escaped, short, tick};

    #[test]
    fn numbers_are_short() {
        let shown = [0.0, 4.1e-5, 0.0421, 0.5, 7.129, 81.25, 612.4, 12_345.0, 1.234e6].map(short);
        let expected =
            ["0", "4.1·10⁻⁵", "0.0421", "0.500", "7.13", "81.2", "612", "12.3 k", "1.23 M"];
        assert_eq!(shown, expected);
        assert_eq!(short(f64::INFINITY), "equal");
    }

    #[test]
    fn ticks_end_without_zeros() {
        let shown = [1e-5, 0.001, 0.1 + 0.2, 20.0, 5e4, 2.5e6].map(tick);
        assert_eq!(shown, ["10⁻⁵", "0.001", "0.3", "20", "50 k", "2.5 M"]);
    }

    #[test]
    fn markup_in_names_is_text() {
        assert_eq!(escaped("<a href=\"x\">&'"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
    }
}
