//! `shadetrade probe`: what it says is true, adds up, and has the shape scripts rely on.

use std::process::Command;

use serde_json::Value;

fn probe(arguments: &[&str]) -> Value {
    let output = Command::new(env!("CARGO_BIN_EXE_shadetrade"))
        .arg("probe")
        .args(arguments)
        .arg("--json")
        .output()
        .expect("the program runs");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    serde_json::from_slice(&output.stdout).expect("JSON and nothing else on standard output")
}

fn triple(value: &Value) -> [f64; 3] {
    [0, 1, 2].map(|index| value[index].as_f64().expect("a number"))
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[test]
fn the_vectors_are_what_their_definitions_say() {
    let probe = probe(&["--pixel", "480,300"]);
    let (position, normal, to_eye) = (
        triple(&probe["position"]),
        triple(&probe["normal"]),
        triple(&probe["to_eye"]),
    );
    assert_eq!(probe["object"], "emerald");
    assert!(
        (position[2] - 1.0).abs() < 1e-12,
        "the pixel shows the face z = 1: {position:?}"
    );
    // Corner normals are affine over a face: n is (x / 2, y / 1.5, z) normalised.
    let along = [position[0] / 2.0, position[1] / 1.5, position[2]];
    for axis in 0..3 {
        assert!((normal[axis] - along[axis] / length(along)).abs() < 1e-12);
        // The eye of camera 1 is at (7, 5, 8).
        let eye = [7.0, 5.0, 8.0];
        let away: [f64; 3] = std::array::from_fn(|axis| eye[axis] - position[axis]);
        assert!((to_eye[axis] - away[axis] / length(away)).abs() < 1e-12);
    }
    for light in probe["lights"].as_array().expect("lights") {
        if light["kind"] == "ambient" {
            assert!(light["to_light"].is_null() && light["reflected"].is_null());
            continue;
        }
        let (l, r) = (triple(&light["to_light"]), triple(&light["reflected"]));
        for axis in 0..3 {
            assert!((r[axis] - (2.0 * dot(normal, l) * normal[axis] - l[axis])).abs() < 1e-12);
        }
    }
}

#[test]
fn terms_add_up_to_the_reference_and_the_renderer_keeps_its_tolerance() {
    for (tolerance, allowed) in [("0", 0.05), ("0.5", 0.5), ("4", 4.0)] {
        for pixel in ["480,300", "600,250", "700,400", "520,260"] {
            let probe = probe(&["--pixel", pixel, "--tolerance", tolerance]);
            for mode in ["gouraud", "phong"] {
                let reference = triple(&probe["reference"][mode]["levels"]);
                let levels = triple(&probe[mode]["levels"]);
                let terms = probe[mode]["terms"].as_object().expect("terms by light");
                assert_eq!(terms.keys().count(), 4);
                for channel in 0..3 {
                    let sum: f64 = terms.values().map(|term| triple(term)[channel]).sum();
                    assert!((sum - reference[channel]).abs() < 1e-9, "{mode} at {pixel}");
                    let shown = |level: f64| level.clamp(0.0, 255.0);
                    let error = (shown(levels[channel]) - shown(reference[channel])).abs();
                    assert!(
                        error <= allowed,
                        "{mode} at {pixel}: {error} levels at tolerance {tolerance}"
                    );
                    let byte = (shown(levels[channel]) + 0.5).floor();
                    assert_eq!(probe[mode]["bytes"][channel].as_f64(), Some(byte));
                }
            }
        }
    }
}

#[test]
fn the_background_has_a_pixel_and_nothing_else() {
    assert_eq!(
        probe(&["--pixel", "0,0"]),
        serde_json::json!({"pixel": [0, 0], "object": null})
    );
}

#[test]
fn lights_that_are_off_appear_nowhere() {
    let probe = probe(&["--pixel", "480,300", "--lights", "white,ambient"]);
    let names: Vec<_> = probe["lights"]
        .as_array()
        .expect("lights")
        .iter()
        .map(|light| &light["name"])
        .collect();
    assert_eq!(names, ["white", "ambient"]);
    assert!(probe["phong"]["terms"].get("red").is_none());
}

#[test]
fn a_pixel_outside_the_picture_is_a_wrong_command_line() {
    for pixel in ["960,0", "0,720", "-1,0", "5", "1,2,3", "a,b"] {
        let output = Command::new(env!("CARGO_BIN_EXE_shadetrade"))
            .args(["probe", "--pixel", pixel])
            .output()
            .expect("the program runs");
        assert_eq!(output.status.code(), Some(2), "{pixel}");
        assert!(
            output.stdout.is_empty() && !output.stderr.is_empty(),
            "{pixel}"
        );
    }
}
