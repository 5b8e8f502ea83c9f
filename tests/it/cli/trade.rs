//! `trade`: its options, and its batches in processes of their own.

use std::fs;

use serde_json::{Value, json};
use shadetrade::scene::SceneRecord;

use super::{SCENE, assert_failed, folder, get, listing, put, said, shadetrade};
use crate::support::window::default_scene;
use crate::trade::contract;

#[cfg(unix)]
#[test]
fn a_scene_from_a_pipe_is_measured_in_every_batch_by_the_named_methods() {
    let folder = folder();
    put(folder.path(), "my.toml", SCENE);
    let line = "trade --quick --size 64x48 --methods phong-1,gouraud-0";
    let script = format!("cat my.toml | $0 {line} -o 'my report' -- /dev/stdin");
    let out = folder.path().join("my report");
    fs::create_dir(&out).expect("it is made");
    put(&out, "error.png", "mine");
    let output = super::in_shell(folder.path(), &script);
    assert!(output.status.success(), "{}", said(&output));
    let text = String::from_utf8(get(&out, "trade.json")).expect("JSON is UTF-8");
    let report = contract::read(&text);
    let methods = report["methods"].as_array().expect("there are methods");
    // Eight batches of four, on one thread.
    let found = methods
        .iter()
        .map(|it| json!([it["id"], it["ms"]["samples"], it["threads"]]));
    assert_eq!(
        found.collect::<Value>(),
        json!([["gouraud-0", 32, 1], ["phong-1", 32, 1]])
    );
    let files = listing(&out).join(" ");
    assert_eq!(files, "error.png trade.json trade.md trade.svg");
    assert_eq!(get(&out, "error.png"), b"mine");
    let table = String::from_utf8(output.stdout).expect("a table is UTF-8");
    assert!(table.contains("phong-1 ") && !table.contains("phong-unit-vectors"));
    // No sentence is about these methods, and the table names no file.
    assert!(table.starts_with("/dev/stdin, camera") && !table.contains("trade.json"));

    // A shell takes the command apart as it was given.
    let command = report["command"].as_str().expect("it is text");
    let script = format!("shadetrade() {{ printf '%s\\n' \"$@\"; }}; {command}");
    let words = super::in_shell(folder.path(), &script).stdout;
    let words = String::from_utf8(words).expect("it is UTF-8");
    let given = ["-o", "my report", "--", "/dev/stdin"];
    let expected = line.split(' ').chain(given);
    assert!(words.lines().eq(expected), "{command}");
}

#[test]
fn a_batch_from_elsewhere_is_checked_before_it_is_drawn() {
    let record = SceneRecord::of(&default_scene().world);
    let batch = json!({
        "scene": record, "size": [4, 3], "threads": 1, "simd": "fallback", "methods": ["phong-0"],
        "time": { "secs": 0, "nanos": 0 }, "number": 0,
    });
    let folder = folder();
    let run = |place: &str, value: Value| {
        let mut batch = batch.clone();
        *batch.pointer_mut(place).expect("it is there") = value;
        put(folder.path(), "batch.json", batch.to_string());
        let batch = fs::File::open(folder.path().join("batch.json")).expect("it is there");
        let mut program = shadetrade(folder.path());
        let output = program.args(["trade", "--batch"]).stdin(batch).output();
        output.expect("the program starts")
    };
    let output = run("/number", json!(1));
    assert!(output.status.success(), "{}", said(&output));
    for (place, value, word) in [
        ("/scene/camera/0/target", json!([7, 5, 8]), "target"),
        ("/simd", json!("sse9"), "SIMD"),
        ("/methods/0", json!("phong-3"), "method"),
    ] {
        assert_failed(&run(place, value), 1, word);
    }
}
