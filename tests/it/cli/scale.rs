//! `trade --methods` and `trade --scale`: what they print and write, and what does not go with them.

use std::fs;

use serde_json::Value;

use super::{assert_fails, assert_works, folder, listing, run, said, shadetrade};

/// Few pixels, so that it takes little time even unoptimised.
const SMALL: &str = "trade --scale --size 48x36";

#[test]
fn it_prints_four_tables_and_writes_their_figures() {
    let folder = folder();
    for time in ["--quick", "--seconds 0.2"] {
        let output = run(
            folder.path(),
            &format!("{SMALL} bench-close --camera 1 --threads 2 {time} -o out"),
        );
        assert_eq!(output.status.code(), Some(0), "{}", said(&output));
        assert!(said(&output).ends_with("wrote scale.json into out\n"));
        let table = String::from_utf8(output.stdout).expect("a table is UTF-8");
        for head in ["pixels ", "lights ", "cuboids ", "threads "] {
            assert!(
                table.lines().any(|line| line.starts_with(head)),
                "no table of {head}in\n{table}"
            );
        }
    }
    let out = folder.path().join("out");
    assert_eq!(listing(&out), ["scale.json"]);
    let text = fs::read_to_string(out.join("scale.json")).expect("it can be read");
    let value: Value = serde_json::from_str(&text).expect("it is JSON");
    assert_eq!(value["scene"], "bench-close");
    let series = value["series"].as_array().expect("there are series");
    let names: Vec<&str> = series
        .iter()
        .filter_map(|one| one["quantity"].as_str())
        .collect();
    assert_eq!(names, ["pixels", "lights", "cuboids", "threads"]);
    for (one, name) in series.iter().zip(names) {
        let fits = one["fits"].as_array().expect("there are fits");
        assert_eq!(fits.is_empty(), name == "threads");
        for fit in fits {
            assert!(fit["exponent"].is_number(), "{name}: {fit}");
        }
        let points = one["points"].as_array().expect("there are points");
        let numbers: Vec<u64> = points
            .iter()
            .filter_map(|point| point["number"].as_u64())
            .collect();
        assert_eq!(numbers.len(), points.len());
        assert!(numbers.is_sorted(), "{name}: {numbers:?}");
        for method in points
            .iter()
            .filter_map(|point| point["methods"].as_array())
            .flatten()
        {
            let ms = &method["ms"];
            assert!(ms["samples"].as_u64() >= Some(8), "{method}");
            assert!(ms["min"].as_f64() <= ms["median"].as_f64(), "{method}");
            assert!(ms["median"].as_f64() > Some(0.0), "{method}");
        }
    }
    let threads = &series[3]["points"];
    assert_eq!(threads.as_array().map(Vec::len), Some(2));
    assert_eq!(threads[1]["threads"], 2);
}

#[test]
fn what_does_not_go_with_it_is_refused_before_anything_is_drawn() {
    let folder = folder();
    for (line, words) in [
        ("trade --scale --shading phong", &["--shading", "trade"][..]),
        ("trade --scale --tolerance 1", &["--tolerance", "trade"]),
        (
            "trade --scale --size 4097x1",
            &["--size", "--scale", "4096x4096"],
        ),
        (
            "trade --scale --size 1x4097",
            &["--size", "--scale", "4096x4096"],
        ),
        (
            "trade --scale --quick --seconds 3",
            &["--quick", "--seconds"],
        ),
        ("render -o a.png --scale", &["--scale"]),
    ] {
        assert_fails(folder.path(), line, 2, words);
    }
    assert_fails(
        folder.path(),
        &format!("{SMALL} --quick -o missing/out"),
        1,
        &["missing"],
    );
    assert_eq!(listing(folder.path()), [""; 0], "nothing is written");
}

#[test]
fn a_picture_one_pixel_wide_has_a_scale_too() {
    let folder = folder();
    assert_works(
        folder.path(),
        "trade --scale --quick --size 1x1 --threads 1",
    );
}

#[test]
fn only_the_methods_named_are_measured_and_the_command_can_be_repeated() {
    let folder = folder();
    let output = shadetrade(folder.path())
        .args(["trade", "--quick", "--size", "24x18", "-o", "my report"])
        .args([
            "--methods",
            "phong-0.5,gouraud-0",
            "--lights",
            "white,ambient",
        ])
        .output()
        .expect("it starts");
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let out = folder.path().join("my report");
    let text = fs::read_to_string(out.join("trade.json")).expect("it can be read");
    let value: Value = serde_json::from_str(&text).expect("it is JSON");
    let methods = value["methods"].as_array().expect("there are methods");
    let ids: Vec<_> = methods.iter().map(|method| &method["id"]).collect();
    assert_eq!(ids, ["gouraud-0", "phong-0.5"]);
    let table = String::from_utf8(output.stdout).expect("a table is UTF-8");
    assert!(!table.contains("phong-0.25"), "{table}");
    assert!(!out.join("error-phong-0.png").exists());

    #[cfg(unix)]
    {
        let command = value["command"].as_str().expect("it is text");
        let script = format!("shadetrade() {{ printf '%s\\n' \"$@\"; }}; {command}");
        let words = String::from_utf8(crate::cli::in_shell(folder.path(), &script).stdout);
        let words = words.expect("it is UTF-8");
        let words: Vec<&str> = words.lines().collect();
        assert_eq!(words[5..7], ["my report", "--methods"], "{command}");
    }
}

#[test]
fn a_method_that_there_is_not_is_answered_with_those_that_there_are() {
    let folder = folder();
    for line in ["trade --methods phong-3", "trade --methods phong-0,"] {
        assert_fails(
            folder.path(),
            line,
            2,
            &["--methods", "gouraud-0.5", "phong-unit-vectors"],
        );
    }
}
