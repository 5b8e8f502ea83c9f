//! Recordings that are replayed by the program.

use std::fs;
use std::path::Path;

use shadetrade::components::{Projection, ShadingMode};
use shadetrade::drawing::Drawing;
use shadetrade::scene::Scene;
use shadetrade::window::recording::{Recorder, Start};

use super::{assert_fails, assert_works, decode, folder, listing, run};

/// Writes a log with these lines after its first ones.
fn record(folder: &Path, lines: &str) {
    let drawing = Drawing {
        scene: Scene::load(Some("bench-far")).expect("it is built in"),
        camera: 0,
        projection: Projection::Orthographic,
        shading: Some(ShadingMode::Phong),
        tolerance: 0.25,
        size: [120, 90],
        threads: 1,
        level: fearless_simd::Level::new(),
    };
    let path = folder.join("a.log");
    drop(Recorder::create(&path, &Start::new(&drawing)).expect("it can be written"));
    let text = fs::read_to_string(&path).expect("it was written");
    fs::write(&path, text + lines).expect("it can be written");
}

#[test]
fn a_replayed_window_shows_the_picture_that_is_rendered() {
    let folder = folder();
    record(folder.path(), "0.5 light 0\n1.5 light 0\n");
    let said = assert_works(folder.path(), "replay a.log -o replayed.png");
    assert!(
        said.contains("3 frames") && said.contains("replayed.png"),
        "{said}"
    );
    assert_works(
        folder.path(),
        "render bench-far --projection orthographic --shading phong --tolerance 0.25 --size 120x90 -o rendered.png",
    );
    let [replayed, rendered] = ["replayed.png", "rendered.png"]
        .map(|name| decode(&fs::read(folder.path().join(name)).expect("it was written")));
    assert!(replayed == rendered);
}

#[test]
fn hashes_are_a_line_a_frame_and_the_same_for_every_way_to_draw() {
    let folder = folder();
    let lines = "0.5 shading \"gouraud\"\n0.5 next-projection\n0.75 view 1\n1.000 say \"words\"\n2.5 next-pro";
    record(folder.path(), lines);
    let hashes = |options: &str| {
        let output = run(folder.path(), &format!("replay a.log --hash {options}"));
        assert_eq!(output.status.code(), Some(0));
        assert!(crate::cli::said(&output).contains("cut off in line 7"));
        String::from_utf8(output.stdout).expect("text")
    };
    let expected = hashes("");
    let times = expected.lines().map(|line| line.split(' ').next());
    let times: Vec<_> = times.map(|time| time.expect("a time")).collect();
    assert_eq!(times, ["0.000", "0.500", "0.750", "1.000"]);
    let distinct: std::collections::HashSet<_> = expected
        .lines()
        .map(|line| line.split(' ').nth(1))
        .collect();
    assert_eq!(distinct.len(), 4, "{expected}");
    for options in ["--simd fallback", "--threads 2", "--threads 3 -o b.apng"] {
        assert_eq!(hashes(options), expected, "{options}");
    }
    assert_eq!(listing(folder.path()), ["a.log", "b.apng"]);
}

#[test]
fn what_cannot_be_replayed_says_why_and_the_log_is_kept() {
    let folder = folder();
    record(folder.path(), "1 quit\n");
    let text = fs::read(folder.path().join("a.log")).expect("it was written");
    assert_fails(folder.path(), "replay", 2, &["<LOG>"]);
    assert_fails(folder.path(), "replay b.log", 2, &["b.log"]);
    assert_fails(folder.path(), "replay a.log", 2, &["a.log:3:7", "`quit`"]);
    assert_fails(
        folder.path(),
        "replay a.log -o a.log",
        2,
        &["recording itself"],
    );
    assert_fails(folder.path(), "replay a.log --hash -o -", 2, &["./-"]);
    assert_fails(folder.path(), "replay a.log -o a.jpg", 2, &["PNG"]);
    assert_eq!(fs::read(folder.path().join("a.log")).expect("kept"), text);
    assert_eq!(listing(folder.path()), ["a.log"]);
}
