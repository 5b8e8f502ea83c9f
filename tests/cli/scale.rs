//! `trade --scale`: what it prints and writes, and what does not go with it.

use std::fs;

use serde_json::Value;

use crate::{assert_fails, assert_works, folder, listing, run, said};

/// Few pixels, so that it takes little time even unoptimised.
const SMALL: &str = "trade --scale --size 48x36";

#[test]
fn it_prints_four_tables_and_writes_four_files() {
    let folder = folder();
    for time in ["--quick", "--seconds 0.2"] {
        let output = run(
            folder.path(),
            &format!("{SMALL} bench-close --camera 1 --threads 2 {time} -o out"),
        );
        assert_eq!(output.status.code(), Some(0), "{}", said(&output));
        assert!(
            said(&output)
                .ends_with("wrote scale.json, scale.csv, scale.md and scale.svg into out\n")
        );
        let table = String::from_utf8(output.stdout).expect("a table is UTF-8");
        for head in ["pixels ", "lights ", "cuboids ", "threads "] {
            assert!(
                table.lines().any(|line| line.starts_with(head)),
                "no table of {head}in\n{table}"
            );
        }
    }
    let out = folder.path().join("out");
    assert_eq!(
        listing(&out),
        ["scale.csv", "scale.json", "scale.md", "scale.svg"]
    );
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
        assert!(
            one["verdict"]
                .as_str()
                .is_some_and(|text| text.ends_with('.'))
        );
        let points = one["points"].as_array().expect("there are points");
        let numbers: Vec<u64> = points
            .iter()
            .filter_map(|point| point[name].as_u64())
            .collect();
        assert_eq!(numbers.len(), points.len());
        assert!(numbers.is_sorted(), "{name}: {numbers:?}");
        for method in points
            .iter()
            .filter_map(|point| point["methods"].as_array())
            .flatten()
        {
            let ms = &method["ms"];
            assert!(ms["samples"].as_u64() >= Some(9), "{method}");
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
