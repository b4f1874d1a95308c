//! The `dump` command from outside: its streams and its exit status.

use std::io::Write;
use std::process::{Command, Output, Stdio};

fn dump(arguments: &[&str], scene: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_dump"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut stdin = child.stdin.take().expect("piped");
    // A command that does not read has already answered.
    let _ = stdin.write_all(scene.as_bytes());
    drop(stdin);
    child.wait_with_output().expect("the command ends")
}

const SCENE: &str = "viewport 2 2\ntri -8 -8 4 24 -8 4 -8 24 4\n";

#[test]
fn tiers_are_listed() {
    let output = dump(&["--tiers"], "");
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(output.stdout, b"exact\nquick4\nquick8\n");
}

#[test]
fn a_scene_is_printed() {
    let output = dump(&[], SCENE);
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(output.stdout, b"0 0 0\n0 1 0\n0 0 1\n0 1 1\n");
    assert!(output.stderr.is_empty());
    let output = dump(&["--snapped"], SCENE);
    assert_eq!(output.stdout, b"0 -8/1 -8/1 4/1 24/1 -8/1 4/1 -8/1 24/1 4/1\n");
}

#[test]
fn a_line_that_cannot_be_taken_leaves_nothing_on_standard_output() {
    for arguments in [&[][..], &["--snapped"]] {
        let output = dump(arguments, &format!("{SCENE}depth\n"));
        assert_eq!(output.status.code(), Some(2));
        assert!(output.stdout.is_empty());
        let error = String::from_utf8(output.stderr).expect("text");
        assert_eq!(error, "line 3: `depth` for a triangle without a hither plane\n");
    }
}

#[test]
fn an_argument_that_cannot_be_taken_is_an_error_too() {
    for arguments in [&["--tier"][..], &["--snapped", "--tiers"], &["scene.txt"]] {
        let output = dump(arguments, "");
        assert_eq!(output.status.code(), Some(2));
        assert!(output.stdout.is_empty() && !output.stderr.is_empty());
    }
}
