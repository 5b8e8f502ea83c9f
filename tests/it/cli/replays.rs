//! Replays of recordings by the program.

use std::collections::HashSet;

use serde_json::json;
use shadetrade::scene::{Scene, SceneRecord};

use super::{assert_works, decode, folder, get, listing, put, run, said};

const LINES: &str = r#"0.500 patch [{"op":"replace","path":"/cuboid/0/shading","value":"phong"}]
0.500 say "words"
0.750 patch [{"op":"replace","path":"/light/0/on","value":false}]
1.000 size [500,300]
2.500 patch [{"op":"repl"#;

#[cfg(unix)]
#[test]
fn an_endless_recording_is_refused() {
    let output = run(folder().path(), "replay /dev/zero --hash");
    assert_eq!(output.status.code(), Some(2));
    assert!(said(&output).contains("larger than 256 MiB"));
}

#[test]
fn hashes_are_one_line_per_frame_and_the_same_for_every_level_and_thread_count() {
    let folder = folder();
    let scene = Scene::load(Some("bench-far")).expect("it is built in");
    let scene = json!({ "name": "bench-far", "scene": SceneRecord::of(&scene.world) });
    let log = format!("0.000 scene {scene}\n0.000 size [640,400]\n{LINES}");
    put(folder.path(), "a.log", log);
    let hashes = |options: &str| {
        let output = run(folder.path(), &format!("replay a.log --hash {options}"));
        assert_eq!(output.status.code(), Some(0));
        assert!(said(&output).contains("a.log:7: the last line is cut off"));
        String::from_utf8(output.stdout).expect("text")
    };
    let expected = hashes("");
    let lines = expected.lines().map(|line| line.split_once(' '));
    let (times, hashed): (Vec<&str>, HashSet<&str>) = lines.flatten().unzip();
    assert_eq!(times, ["0.000", "0.500", "0.750", "1.000"]);
    assert_eq!(hashed.len(), 4, "{expected}");
    for options in ["--simd fallback", "--threads 2 --idle 0.1", "-o b.APNG"] {
        assert_eq!(hashes(options), expected, "{options}");
    }
    // The last frame is a picture of the window at its size; all frames begin with the first.
    let said = assert_works(folder.path(), "replay a.log -o last.png");
    assert!(said.contains("4 frames") && said.contains("last.png"));
    for (name, size) in [("last.png", (500, 300)), ("b.APNG", (640, 400))] {
        let (width, height, _) = decode(&get(folder.path(), name));
        assert_eq!((width, height), size);
    }
    // Without a display a recording is not played.
    let output = run(folder.path(), "replay a.log");
    assert_eq!(output.status.code(), Some(1));
    assert!(said.contains("last.png") && crate::cli::said(&output).contains("replay a.log -o"));
    assert_eq!(listing(folder.path()), ["a.log", "b.APNG", "last.png"]);
}
