//! The page: presets, plots, a table and pictures, in one file that opens without a network and reads without scripts.
//!
//! It is XML too, which is how its test reads it.

mod gallery;
mod presets;
mod table;

use super::number::{escaped, short};
use super::plot::{Axis, svg};
use super::{Picture, Point};
use gallery::{Gallery, MAGNIFIED, difference};

const STYLE: &str = include_str!("page/page.css");
const SCRIPT: &str = include_str!("page/page.js");

/// The whole page.
#[must_use]
pub fn html(points: &[Point], isas: &[&str], toolchain: &str) -> String {
    let mut gallery = Gallery::default();
    let pictures: String = points
        .iter()
        .enumerate()
        .map(|(index, point)| details(&mut gallery, index, point))
        .collect();
    let tables: String = isas.iter().map(|isa| table::table(points, isa)).collect();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <meta name=\"color-scheme\" content=\"light dark\"/>\n<title>hither: speed against accuracy</title>\n\
         <style>\n{STYLE}{rules}</style>\n</head>\n<body>\n{head}\
         <section>\n<h2>Presets</h2>\n{cards}</section>\n\
         <section>\n<h2>Error against cost</h2>\n{choices}{plots}</section>\n\
         <section>\n<h2>All figures</h2>\n{tables}</section>\n\
         <section>\n<h2>Pictures</h2>\n<p>Drawn, as it should be, and what differs, {MAGNIFIED} times and at most white. \
         A tap enlarges.</p>\n{pictures}</section>\n\
         <footer><p>{toolchain}</p></footer>\n\
         <style>\n{images}</style>\n<script>\n{SCRIPT}</script>\n</body>\n</html>\n",
        rules = choice_rules(isas),
        head = heading(points, isas),
        cards = presets::cards(points, isas),
        choices = choices(isas),
        plots = plots(points, isas),
        toolchain = escaped(toolchain),
        images = gallery.style(),
    )
}

fn heading(points: &[Point], isas: &[&str]) -> String {
    format!(
        "<header>\n<h1>hither: speed against accuracy</h1>\n\
         <p>Each of {} points is one choice of every knob, with its cost in instructions, counted under emulation on {}, and its \
         error against an exact reference in <code>f64</code>. A point that another one beats, by being no dearer and no worse, is grey; \
         the others are the trade.</p>\n</header>\n",
        points.len(),
        escaped(&isas.join(", ")),
    )
}

/// Radio buttons of instruction sets and errors, which the style sheet alone obeys.
fn choices(isas: &[&str]) -> String {
    let button = |group: &str, value: &str, text: &str, checked: bool| {
        let checked = if checked { " checked=\"checked\"" } else { "" };
        let (value, text) = (escaped(value), escaped(text));
        format!(
            "<label><input type=\"radio\" name=\"{group}\" id=\"{group}-{value}\"{checked}/><span>{text}</span></label>"
        )
    };
    let isas: String =
        isas.iter().enumerate().map(|(index, isa)| button("isa", isa, isa, index == 0)).collect();
    let axes: String = Axis::ALL
        .into_iter()
        .enumerate()
        .map(|(index, axis)| button("axis", axis.name(), axis.title(), index == 0))
        .collect();
    let all = button("axis", "all", "All", false);
    format!(
        "<fieldset><legend>Instruction set</legend>{isas}</fieldset>\n\
         <fieldset><legend>Error</legend>{axes}{all}</fieldset>\n"
    )
}

/// What is not chosen is not shown; a browser that does not know `:has` shows all.
fn choice_rules(isas: &[&str]) -> String {
    let rule = |group: &str, value: &str| {
        format!(
            "body:has(#{group}-{value}:checked) .{group}:not(.{group}-{value}) {{ display: none; }}\n"
        )
    };
    let isas = isas.iter().map(|isa| rule("isa", isa));
    isas.chain(Axis::ALL.into_iter().map(|axis| rule("axis", axis.name()))).collect()
}

/// A figure an instruction set and error.
fn plots(points: &[Point], isas: &[&str]) -> String {
    let figure = |isa: &str, axis: Axis| {
        format!(
            "<figure class=\"isa isa-{} axis axis-{}\">\n{}<figcaption></figcaption></figure>\n",
            escaped(isa),
            axis.name(),
            svg(points, axis, isa),
        )
    };
    let plots: String =
        isas.iter().flat_map(|isa| Axis::ALL.map(|axis| figure(isa, axis))).collect();
    format!("<div class=\"plots\">\n{plots}</div>\n")
}

/// Over the pictures of a point.
const HEADS: &str = "<p class=\"heads\"><span>drawn</span><span>as it should be</span><span>difference</span></p>\n";

/// A point's knobs and pictures, shown when it is opened or led to.
fn details(gallery: &mut Gallery, index: usize, point: &Point) -> String {
    let preset = point.preset.map(|preset| format!("<b>{}</b> ", escaped(preset)));
    let psnr = decibels(point.errors.psnr);
    let knobs: Vec<String> = point
        .knobs
        .iter()
        .map(|(knob, setting)| format!("{}: {}", escaped(knob), escaped(setting)))
        .collect();
    let scenes: String = point.pictures.iter().map(|picture| scene(gallery, picture)).collect();
    format!(
        "<details data-point=\"{index}\"><summary>{}{} <small>{psnr}</small></summary>\n\
         <div class=\"scenes\" id=\"p{index}\"><p class=\"knobs\">{}</p>\n{HEADS}{scenes}</div></details>\n",
        preset.unwrap_or_default(),
        escaped(&point.name),
        knobs.join(" · "),
    )
}

/// Three pictures of a scene, side by side.
fn scene(gallery: &mut Gallery, picture: &Picture) -> String {
    let Picture { scene, width, height, drawn, ideal, psnr } = picture;
    let scene = escaped(scene);
    let three = [
        ("drawn", drawn.clone()),
        ("as it should be", ideal.clone()),
        ("difference", difference(drawn, ideal)),
    ];
    let mut images = String::new();
    for (what, pixels) in three {
        let number = gallery.add(*width, *height, pixels);
        images += &format!(
            "<i class=\"i{number}\" role=\"img\" aria-label=\"{scene}, {what}\" title=\"{what}\" tabindex=\"0\" \
             style=\"aspect-ratio:{width}/{height}\"></i>"
        );
    }
    format!(
        "<figure><figcaption>{scene} <small>{}</small></figcaption>{images}</figure>\n",
        decibels(*psnr)
    )
}

fn decibels(psnr: f64) -> String {
    if psnr.is_infinite() { "equal".to_owned() } else { format!("{} dB", short(psnr)) }
}

#[cfg(test)]
mod tests {
    use super::super::made;
    use super::html;
    use std::collections::HashSet;

    const ISAS: [&str; 2] = ["m4f", "m0"];

    #[test]
    fn the_page_is_well_formed_and_names_every_point() {
        let points = made::points(20);
        let text = html(&points, &ISAS, "rustc <1.85> & QEMU");
        let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
        let page = roxmltree::Document::parse_with_options(&text, options).expect("well-formed");
        let of = |tag: &'static str| {
            page.descendants().filter(move |node| node.tag_name().name() == tag)
        };
        assert_eq!(of("details").count(), points.len());
        assert_eq!(of("svg").count(), 2 * 7);
        assert_eq!(of("article").count(), 3);
        let links: Vec<(&str, &str)> =
            of("a").filter_map(|node| Some((node.attribute("href")?, node.text()?))).collect();
        for (index, point) in points.iter().enumerate() {
            assert!(
                links.contains(&(format!("#p{index}").as_str(), &point.name)),
                "{}",
                point.name
            );
        }
        let ids: Vec<&str> = page.descendants().filter_map(|node| node.attribute("id")).collect();
        assert_eq!(ids.len(), ids.iter().collect::<HashSet<_>>().len(), "an id is there twice");
        assert!(links.iter().all(|(link, _)| ids.contains(&&link[1..])), "a link leads nowhere");
    }

    #[test]
    fn equal_pictures_are_stored_once() {
        let points = made::points(20);
        let all = points.iter().flat_map(|point| &point.pictures);
        let mut different: HashSet<Vec<u8>> = HashSet::new();
        for picture in all {
            different.insert(picture.drawn.clone());
            different.insert(picture.ideal.clone());
            different.insert(super::difference(&picture.drawn, &picture.ideal));
        }
        let text = html(&points, &ISAS, "");
        assert_eq!(text.matches("data:image/png").count(), different.len());
        assert!(different.len() < 3 * 2 * points.len());
    }

    #[test]
    fn nothing_is_fetched() {
        let text = html(&made::points(20), &ISAS, "");
        let outside = text.replace("http://www.w3.org/2000/svg", "");
        assert!(!outside.contains("http:") && !outside.contains("https:"));
        assert!(!text.contains("<link") && !text.contains(" src="));
    }
}
