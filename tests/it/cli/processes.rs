//! The batches of `trade` run in separate processes, which read the scene from standard input.

use std::fs;
use std::process::{Command, Stdio};

use serde_json::Value;
use shadetrade::scene::BUILT_IN;

use super::{folder, in_shell, said};

#[test]
fn a_scene_from_a_pipe_is_measured_in_every_batch() {
    let folder = folder();
    let (_, scene) = BUILT_IN[0];
    fs::write(folder.path().join("my.toml"), scene).expect("it is written");
    let script = "cat my.toml | $0 trade --quick --size 64x48 --methods phong-0,phong-1 -o out -- /dev/stdin";
    let output = in_shell(folder.path(), script);
    assert!(output.status.success(), "{}", said(&output));
    let json = fs::read(folder.path().join("out/trade.json")).expect("it was written");
    let report: Value = serde_json::from_slice(&json).expect("it is JSON");
    for method in report["methods"].as_array().expect("there are methods") {
        assert_eq!(method["ms"]["samples"], 32, "eight batches of four");
    }
}

#[test]
fn a_batch_measures_only_the_scene_on_standard_input() {
    let folder = folder();
    let (_, scene) = BUILT_IN[0];
    fs::write(folder.path().join("my.toml"), scene).expect("it is written");
    let line = "$0 trade --batch 1 --quick --size 64x48 --methods phong-0,phong-1 ./none.toml";
    let output = in_shell(folder.path(), &format!("{line} < my.toml"));
    assert!(output.status.success(), "{}", said(&output));
    let times: Vec<Vec<f64>> = serde_json::from_slice(&output.stdout).expect("they are times");
    assert_eq!(times.iter().map(Vec::len).collect::<Vec<_>>(), [4, 4]);
    assert!(times.concat().iter().all(|time| *time > 0.0));

    let output = in_shell(folder.path(), &format!("{line} < /dev/null"));
    assert!(!output.status.success(), "there was no scene");
}

#[test]
fn a_measurement_goes_on_if_the_program_is_removed() {
    let folder = folder();
    let program = folder.path().join("program");
    fs::copy(env!("CARGO_BIN_EXE_shadetrade"), &program).expect("there is room for it");
    let child = Command::new(&program)
        .args("trade --quick --size 64x48 --methods phong-0".split(' '))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    fs::remove_file(&program).expect("it is there");
    let output = child.wait_with_output().expect("it ends");
    assert!(output.status.success(), "{}", said(&output));
}
