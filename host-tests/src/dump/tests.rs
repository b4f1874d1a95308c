//! The grammar, line by line, and what is printed for small scenes.

use super::*;

fn parse(text: &str) -> Result<Scene, LineError> {
    Scene::parse(text.as_bytes())
}

/// The error of a scene whose last line cannot be taken.
fn error(text: &str) -> String {
    let error = parse(text).expect_err(text);
    assert_eq!(error.line, text.lines().count(), "{error}");
    error.to_string()
}

fn printed(text: &str) -> String {
    let mut out = Vec::new();
    coverage(&parse(text).expect(text), &mut out).expect("memory");
    String::from_utf8(out).expect("ASCII")
}

fn printed_snapped(text: &str) -> String {
    let mut out = Vec::new();
    snapped(&parse(text).expect(text), &mut out).expect("memory");
    String::from_utf8(out).expect("ASCII")
}

#[test]
fn nothing_is_a_scene_too() {
    for text in ["", "\n\n", "# a comment\n  # another", "viewport 512 1\n"] {
        assert_eq!(printed(text), "");
    }
}

#[test]
fn settings_apply_to_the_triangles_after_them() {
    let scene = parse(
        "viewport 3 4 # pixels\r\ntri 1 2 3 4 5 6 7 8 9\nz 1 -2 1048576\ntier quick8\nhither 7\n\
         clip 1 2 3 -1024\nclip 0 0 0 1\nsides both\ntri 0 0 0 0 0 0 0 0 0\nattr 1 -0.5 65536\ndepth\n\
         clip off\nsides front\ntri -1048576 0 0 0 0 0 0 0 0",
    )
    .expect("a scene");
    assert_eq!(scene.viewport, (3, 4));
    let [plain, cut, last] = &scene.triangles[..] else {
        panic!("three triangles");
    };
    assert_eq!(plain.settings, Settings::default());
    assert_eq!(plain.corners, [[1, 2, 3], [4, 5, 6], [7, 8, 9]]);
    assert_eq!((plain.z, plain.depth), (Some([1, -2, 1 << 20]), false));
    assert_eq!(cut.settings.planes, [[1, 2, 3, -1024], [0, 0, 0, 1]]);
    assert_eq!((cut.settings.sides, cut.settings.hither), (Sides::Both, Some(7)));
    assert_eq!((cut.attribute, cut.depth), (Some([1.0, -0.5, 65536.0]), true));
    assert_eq!(last.settings.tier, TierName::Quick8);
    assert!(last.settings.planes.is_empty());
}

#[test]
fn lines_that_cannot_be_taken_name_themselves() {
    assert_eq!(
        error("# first\ntri 0 0 0 0 0 0 0 0 0"),
        "line 2: `tri` before the viewport, which must come first"
    );
    let after = |line: &str| {
        error(&format!("viewport 8 8\nhither 4\ntri 0 0 9 1 0 9 0 1 9\nattr 1 2 3\n{line}"))
    };
    for (line, why) in [
        ("viewport 8 8", "a second viewport"),
        ("paint", "`paint` is no item of a scene"),
        ("tier", "0 words for a tier's name"),
        ("tier Exact", "`Exact` is no tier"),
        ("hither 0", "`0` is not an integer from 1 to 1048576"),
        ("hither 1048577", "`1048577` is not an integer from 1 to 1048576"),
        ("hither off", "`off` is not an integer from 1 to 1048576"),
        ("clip 1 2 3", "3 numbers where 4 are needed"),
        ("clip 1 2 3 1025", "`1025` is not an integer from -1024 to 1024"),
        ("clip off off", "2 numbers where 4 are needed"),
        ("sides back", "sides are `front` or `both`"),
        ("tri 1 2 3", "3 numbers where 9 are needed"),
        ("tri 1 2 3 4 5 6 7 8 1.5", "`1.5` is not an integer from -1048576 to 1048576"),
        ("tri 1 2 3 4 5 6 7 8 -1048577", "`-1048577` is not an integer from -1048576 to 1048576"),
        ("z 1 2 3 4", "4 numbers where 3 are needed"),
        ("attr 1 2 3", "a second `attr` for one triangle"),
        ("attr 1 2 65536.5", "`65536.5` is not a number from -65536 to 65536"),
        ("attr 1 2 NaN", "`NaN` is not a number from -65536 to 65536"),
        ("attr 1 2 inf", "`inf` is not a number from -65536 to 65536"),
        ("depth 1", "1 numbers where 0 are needed"),
    ] {
        assert_eq!(after(line), format!("line 5: {why}"));
    }
    assert_eq!(after("depth\ndepth"), "line 6: a second `depth` for one triangle");
    assert_eq!(after("z 1 2 3\nz 1 2 3"), "line 6: a second `z` for one triangle");
    let planes = "clip 1 0 0 0\n".repeat(5);
    assert_eq!(after(planes.trim_end()), "line 9: more than 4 clip planes at once");
    assert_eq!(error("viewport 8 8\nz 1 2 3"), "line 2: `z` before any triangle");
    // The plane comes after the triangle, so it is not the triangle's.
    let late = "viewport 8 8\ntri 0 0 9 1 0 9 0 1 9\nhither 4\ndepth";
    assert_eq!(error(late), "line 4: `depth` for a triangle without a hither plane");
    for sides in ["0 1", "1 513", "1", "1 2 3"] {
        assert!(error(&format!("viewport {sides}")).starts_with("line 1: "));
    }
    let bytes = Scene::parse(b"viewport 1 1\n\xff\n").expect_err("not text");
    assert_eq!(bytes.to_string(), "line 2: it is not UTF-8");
}

/// Twice the screen's size, at w = 4: all pixels of a small viewport.
const ALL: &str = "tri -8 -8 4 24 -8 4 -8 24 4\n";

#[test]
fn every_pixel_has_a_line() {
    assert_eq!(printed(&format!("viewport 2 1\n{ALL}{ALL}")), "0 0 0\n0 1 0\n1 0 0\n1 1 0\n");
    assert_eq!(printed(&format!("viewport 1 1\nhither 5\n{ALL}")), "");
    assert_eq!(printed(&format!("viewport 2 1\nclip 1 0 0 0\n{ALL}")), "0 1 0\n");
}

#[test]
fn the_part_behind_is_drawn_on_request() {
    let behind = "tri 8 8 -4 -24 8 -4 8 -24 -4\n";
    assert_eq!(printed(&format!("viewport 1 1\n{behind}")), "");
    assert_eq!(printed(&format!("viewport 1 1\nsides both\n{behind}")), "0 0 0\n");
    assert_eq!(printed(&format!("viewport 1 1\nsides both\nhither 1\n{behind}")), "");
}

#[test]
fn attributes_and_depth_follow_the_pixel() {
    let probed = |lines: &str| printed(&format!("viewport 1 1\nhither 2\n{ALL}{lines}"));
    assert_eq!(probed("attr 0.1 0.1 0.1"), "0 0 0 a=0.100000000\n");
    // The pixel's centre is a quarter of the way to either of the last two corners.
    let line = probed("attr 0 4 8");
    let value: f64 = line.trim_start_matches("0 0 0 a=").trim_end().parse().expect("a number");
    assert!((value - 3.0).abs() < 1e-6, "{line}");
    assert_eq!(probed("depth"), "0 0 0 d=0\n");
    assert_eq!(probed("z 4 4 4\ndepth"), "0 0 0 d=65535\n");
    assert_eq!(probed("z 2 2 2\ndepth\nattr 0 0 0"), "0 0 0 a=0.000000000 d=32768\n");
}

#[test]
fn snapped_vertices_are_rationals_in_clip_space() {
    let tri = "tri 1 -2 3 0 0 0 7 5 -9\n";
    for tier in TierName::ALL {
        let text = format!("viewport 240 320\ntier {}\n{tri}", tier.name());
        let line = printed_snapped(&text);
        let (_, rest) = line.split_once(' ').expect("an index");
        let words: Vec<_> = rest.split_whitespace().collect();
        assert_eq!(words[2..], ["3/1", "0/1", "0/1", "0/1", "7/1", "5/1", "-9/1"], "{line}");
        // (1/3, -2/3) is 160 pixels from the left and 266 2/3 from the top.
        let expected = match tier {
            TierName::Exact => ["1/1", "-2/1"],
            TierName::Quick4 => ["1/1", "-5121/2560"],
            TierName::Quick8 => ["1/1", "-81921/40960"],
        };
        assert_eq!(words[..2], expected, "{line}");
    }
}
