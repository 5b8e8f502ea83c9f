//! Replays of recordings by the program.

use std::collections::HashSet;
use std::fs;
use std::path::Path;

use serde_json::json;
use shadetrade::scene::{Scene, SceneRecord};

use super::{assert_fails, assert_works, decode, folder, listing, run, said};

/// Writes a log: its header and scene, followed by these lines.
fn record(folder: &Path, lines: &str) {
    let scene = Scene::load(Some("bench-far")).expect("it is built in");
    let scene = json!({ "name": "bench-far", "scene": SceneRecord::of(&scene.world) });
    let text = format!("0.000 scene {scene}\n0.000 size [640,400]\n{lines}");
    fs::write(folder.join("a.log"), text).expect("it can be written");
}

const LINES: &str = r#"0.500 patch [{"op":"replace","path":"/cuboid/0/shading","value":"phong"}]
0.500 say "words"
0.750 patch [{"op":"replace","path":"/light/0/on","value":false}]
1.000 size [500,300]
2.500 patch [{"op":"repl"#;

#[test]
fn hashes_are_one_line_per_frame_and_the_same_for_every_level_and_thread_count() {
    let folder = folder();
    record(folder.path(), LINES);
    let hashes = |options: &str| {
        let output = run(folder.path(), &format!("replay a.log --hash {options}"));
        assert_eq!(output.status.code(), Some(0));
        assert!(said(&output).contains("a.log:7: the last line is cut off"));
        String::from_utf8(output.stdout).expect("text")
    };
    let expected = hashes("");
    let lines: Vec<(&str, &str)> = expected
        .lines()
        .map(|line| line.split_once(' ').expect("a time and a hash"))
        .collect();
    let times: Vec<_> = lines.iter().map(|(time, _)| *time).collect();
    assert_eq!(times, ["0.000", "0.500", "0.750", "1.000"]);
    let distinct: HashSet<_> = lines.iter().map(|(_, hash)| *hash).collect();
    assert_eq!(distinct.len(), 4, "{expected}");
    for options in ["--simd fallback", "--threads 2 --idle 0.1", "-o b.apng"] {
        assert_eq!(hashes(options), expected, "{options}");
    }
    assert_eq!(listing(folder.path()), ["a.log", "b.apng"]);
}

#[test]
fn the_last_frame_is_a_picture_of_the_window_at_its_size() {
    let folder = folder();
    record(folder.path(), LINES);
    let said = assert_works(folder.path(), "replay a.log -o last.png");
    assert!(said.contains("4 frames") && said.contains("last.png"));
    let last = fs::read(folder.path().join("last.png")).expect("it was written");
    let (width, height, _) = decode(&last);
    assert_eq!([width, height], [500, 300]);
}

#[test]
fn a_recording_that_cannot_be_replayed_is_kept_and_the_reason_printed() {
    let folder = folder();
    record(folder.path(), "1 quit\n");
    let text = fs::read(folder.path().join("a.log")).expect("it was written");
    assert_fails(folder.path(), "replay", 2, &["<LOG>"]);
    assert_fails(folder.path(), "replay b.log", 2, &["b.log"]);
    assert_fails(folder.path(), "replay a.log", 2, &["a.log:3:", "`quit`"]);
    assert_fails(
        folder.path(),
        "replay a.log -o a.log",
        2,
        &["recording itself"],
    );
    assert_fails(folder.path(), "replay a.log --hash -o -", 2, &["./-"]);
    assert_fails(folder.path(), "replay a.log -o a.jpg", 2, &["PNG"]);
    assert_fails(folder.path(), "replay a.log --idle -1", 2, &["86400"]);
    assert_eq!(fs::read(folder.path().join("a.log")).expect("kept"), text);
    assert_eq!(listing(folder.path()), ["a.log"]);
}

#[test]
fn without_a_display_a_replay_in_a_window_is_an_error_that_advises_a_file() {
    let folder = folder();
    record(folder.path(), "");
    assert_fails(folder.path(), "replay a.log", 1, &["replay a.log -o"]);
    assert_fails(folder.path(), "view --record b.log", 1, &["no display"]);
    assert_eq!(listing(folder.path()), ["a.log"]);
}
