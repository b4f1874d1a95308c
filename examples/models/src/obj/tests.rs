use super::*;

fn error(text: &str) -> String {
    Obj::parse(text.as_bytes()).map(|_| ()).unwrap_err().to_string()
}

const POINTS: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

#[test]
fn what_is_said_is_read() {
    let text = "\u{feff}# a comment\r\no name with spaces\r\n\r\nv\t1 2.5 -3e0 # trailing\rv 0 0 \\\n  1 1\\\n\nv 1 1 1 0.5 0 1\nv 1 1 1 0.5 0 1 \
                0.25\nvt 0.25\nvt 0.5 -1.5\nvt 1 2 3\nvn 0 0 -2\nf 1/1/1 2/2/1 3/3/1\ns off\nf -4 -1 -2\n";
    let obj = Obj::parse(text.as_bytes()).unwrap();
    let positions: Vec<_> = obj.positions.iter().map(|p| (p.line, p.at, p.color)).collect();
    let colored = Some([0.5, 0.0, 1.0]);
    assert_eq!(
        positions,
        [
            (4, [1.0, 2.5, -3.0], None),
            (5, [0.0, 0.0, 1.0], None),
            (8, [1.0; 3], colored),
            (9, [1.0; 3], colored)
        ]
    );
    assert_eq!(
        obj.coordinates.iter().map(|c| c.at).collect::<Vec<_>>(),
        [[0.25, 0.0], [0.5, -1.5], [1.0, 2.0]]
    );
    assert_eq!(obj.normals, [[0.0, 0.0, -2.0]]);
    let whole = |i| Corner { position: i, coordinate: Some(i), normal: Some(0) };
    let bare = |i| Corner { position: i, coordinate: None, normal: None };
    assert_eq!(obj.faces[0], Face { line: 14, corners: [0, 1, 2].map(whole).to_vec() });
    assert_eq!(obj.faces[1], Face { line: 16, corners: [0, 3, 2].map(bare).to_vec() });
    assert_eq!((obj.lines, obj.warnings.len()), (16, 0));
}

#[test]
fn a_statement_ends_with_its_line_however_lines_end() {
    for end in ["\n", "\r\n", "\r"] {
        let text = format!("{POINTS}\nf 1 2 \\\n 3\nf 1//9 2//9 3//9").replace('\n', end);
        assert_eq!(error(&text), "line 7: index 9 of normals, but there are 0", "{end:?}");
    }
    // A comment does not go on, and nothing follows the last line.
    let obj = Obj::parse(format!("{POINTS}# not on \\\nf 1 2 3 \\").as_bytes()).unwrap();
    assert_eq!(obj.faces.len(), 1);
}

#[test]
fn a_positive_index_may_name_what_follows() {
    let obj = Obj::parse(b"f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0").unwrap();
    assert_eq!(obj.faces[0].corners.len(), 3);
    assert_eq!(
        error("f 1 2 -1\nv 0 0 0\nv 1 0 0"),
        "line 1: index -1 of positions, but there are 0 before it"
    );
}

#[test]
fn bad_numbers_name_their_line_and_themselves() {
    for bad in ["nan", "NaN", "inf", "-Infinity", "1e999", "1,5", "0x10", "--1", "\u{a0}1", "1f"] {
        let shown: String = bad.chars().flat_map(char::escape_debug).collect();
        for statement in
            ["v 0 0 ?", "v ? 0 0", "v 0 0 0 ?", "v 0 0 0 0 ? 0", "vt ?", "vt 0 0 ?", "vn 0 ? 0"]
        {
            let text = format!("# first\n{}\n", statement.replace('?', bad));
            assert_eq!(error(&text), format!("line 2: `{shown}` is not a finite number"), "{text}");
        }
    }
    let long = format!("v 0 0 {}", "x".repeat(1000));
    assert_eq!(error(&long), format!("line 1: `{}...` is not a finite number", "x".repeat(32)));
}

#[test]
fn counts_are_named_with_what_fits() {
    for (text, message) in [
        ("v", "`v` has 0 numbers: it takes 3, 4, 6 or 7"),
        ("v 1 2", "`v` has 2 numbers: it takes 3, 4, 6 or 7"),
        ("v 1 2 3 4 5", "`v` has 5 numbers: it takes 3, 4, 6 or 7"),
        ("v 1 2 3 4 5 6 7 8", "`v` has 8 numbers: it takes 3, 4, 6 or 7"),
        ("vt", "`vt` has 0 numbers: it takes 1 to 3"),
        ("vt 1 2 3 4", "`vt` has 4 numbers: it takes 1 to 3"),
        ("vn 1 2", "`vn` has 2 numbers: it takes 3"),
        ("v 0 0 0 255 0 0", "a vertex colour has a channel of 255: they are 0 to 1"),
        ("v 0 0 0 0 -0.5 0", "a vertex colour has a channel of -0.5: they are 0 to 1"),
    ] {
        assert_eq!(error(text), format!("line 1: {message}"));
    }
}

#[test]
fn bad_faces_are_named() {
    for (face, message) in [
        ("f", "a face with 0 corners: it takes 3 or more"),
        ("f 1 2", "a face with 2 corners: it takes 3 or more"),
        ("f 1 2 0", "index 0 of positions: they count from 1, or from -1 backwards"),
        ("f 1 2 4", "index 4 of positions, but there are 3"),
        ("f 1 2 -4", "index -4 of positions, but there are 3 before it"),
        ("f 1/1 2/1 3/2", "index 2 of texture coordinates, but there are 1"),
        ("f 1//1 2//1 3//-2", "index -2 of normals, but there are 1 before it"),
        (
            "f 1/0 2/1 3/1",
            "index 0 of texture coordinates: they count from 1, or from -1 backwards",
        ),
        ("f 1//1 2//1 3", "a face with normals at some corners only"),
        ("f 1 2 3/1", "a face with texture coordinates at some corners only"),
        ("f 1 2 9223372036854775807", "index 9223372036854775807 of positions, but there are 3"),
        (
            "f 1 2 -9223372036854775808",
            "index -9223372036854775808 of positions, but there are 3 before it",
        ),
        (
            "f 1 2 9223372036854775808",
            "`9223372036854775808` is not a corner: v, v/vt, v//vn or v/vt/vn",
        ),
        ("f 1 2 3.5", "`3.5` is not a corner: v, v/vt, v//vn or v/vt/vn"),
        ("f 1 2 /1/1", "`/1/1` is not a corner: v, v/vt, v//vn or v/vt/vn"),
        ("f 1 2 3/1/1/1", "`3/1/1/1` is not a corner: v, v/vt, v//vn or v/vt/vn"),
        ("f 1 2 x\u{1b}[2J", "`x\\u{1b}[2J` is not a corner: v, v/vt, v//vn or v/vt/vn"),
    ] {
        let text = format!("{POINTS}vt 0 0\nvn 0 0 1\n{face}\n");
        assert_eq!(error(&text), format!("line 6: {message}"));
    }
}

#[test]
fn files_without_a_face_are_errors() {
    assert_eq!(error(""), "line 1: the file ends without a face (`f`)");
    assert_eq!(error("\n\n"), "line 2: the file ends without a face (`f`)");
    assert_eq!(error(POINTS), "line 3: the file ends without a face (`f`)");
}

#[test]
fn what_is_no_text_is_an_error_where_it_begins() {
    for (bytes, message) in [
        (&b"\x89PNG\r\n"[..], "line 1: byte 0x89 is not UTF-8 text"),
        (b"v 0 0 0\r\nv 0 0 0\r# caf\xe9\n", "line 3: byte 0xe9 is not UTF-8 text"),
        (b"v 0 0 0\n\xc3", "line 2: byte 0xc3 is not UTF-8 text"),
    ] {
        assert_eq!(Obj::parse(bytes).map(|_| ()).unwrap_err().to_string(), message);
    }
}

#[test]
fn what_does_not_show_is_skipped_and_what_shows_is_told() {
    let text = format!(
        "{POINTS}g a b\no c\ns 1\nvp 1\nmtllib x.mtl\nusemtl a\nusemtl b\nl 1 2\nbanana 1\nv 0 0 0 2\nf 1 2 3"
    );
    let warnings: Vec<String> =
        Obj::parse(text.as_bytes()).unwrap().warnings.iter().map(Warning::to_string).collect();
    assert_eq!(
        warnings,
        [
            "line 8: `mtllib` is skipped: materials are not read",
            "line 9: `usemtl` is skipped: materials are not read (2 times)",
            "line 11: `l` is skipped: only faces are drawn",
            "line 12: `banana` is skipped: it is no keyword of OBJ",
            "line 13: the weight of `v` is skipped: only curves have a use for it",
        ]
    );
}
