//! Wrong command lines and scenes: exit status 2 and one paragraph with what is allowed.

use std::fs;

use shadetrade::scene::BUILT_IN;

use super::{assert_fails, assert_works, folder, listing};

#[test]
fn a_wrong_command_line_or_scene_ends_with_status_2_and_a_message() {
    let folder = folder();
    let (_, scene) = BUILT_IN[0];
    let key = format!("colour = 1\n{scene}");
    fs::write(folder.path().join("key.toml"), key).expect("written");
    fs::write(folder.path().join("cuboid"), "this is no scene").expect("written");
    fs::write(folder.path().join("bytes.toml"), [0xff, 0xfe, 0x00]).expect("written");
    for (line, words) in [
        ("render", &["--output <FILE>"][..]),
        ("render a.toml b.toml -o a.png", &["'b.toml'"]),
        ("--size 0x0", &["'0x0'", "1x1 to 16384x16384"]),
        ("--size 16385x1", &["'16385x1'"]),
        ("view --size 960", &["'960'", "such as 960x720"]),
        ("render -o a.png --size -5x5", &["'-5x5'"]),
        ("render -o a.png --tolerance -1", &["'-1'", "0.0001 to 255"]),
        ("render -o a.png --tolerance 9.9e-5", &["'9.9e-5'"]),
        ("render -o a.png --tolerance nan", &["'nan'"]),
        ("render -o a.png --budget 0", &["'0'", "0.001 to 10000"]),
        (
            "render -o a.png --budget 1 --tolerance 1",
            &["--budget", "--tolerance"],
        ),
        ("probe --pixel 1,1 --budget 1", &["--budget"]),
        ("render -o a.png --threads 0", &["'0'", "1..=1024"]),
        (
            "render -o a.png --simd sse9",
            &["'sse9'", "fallback, sse4.2"],
        ),
        (
            "render -o a.png --projection isometric",
            &["perspective, orthographic"],
        ),
        ("--shading flat", &["'flat'", "gouraud, phong"]),
        ("--camera 3", &["\"3\"", "\"1\", \"2\""]),
        (
            "view bench-far --lights white,blue",
            &["\"blue\"", "\"white\", \"red\", \"specular\", \"ambient\""],
        ),
        (
            "render -o a.png --lights white,,red",
            &["no light is named \"\"", "\"white\", \"red\""],
        ),
        (
            "extremes nowhere",
            &["\"nowhere\"", "`shadetrade extremes`"],
        ),
        ("figures -o -", &["folder", "standard output"]),
        ("probe --pixel 960,0", &["960,0", "959,719"]),
        ("probe --pixel 0,720", &["0,720", "959,719"]),
        ("probe --pixel -1,0", &["'-1,0'", "480,300"]),
        ("probe --pixel 1,2,3", &["'1,2,3'", "480,300"]),
        ("trade --shading phong", &["--shading", "trade"]),
        ("trade --tolerance 1", &["--tolerance", "trade"]),
        ("trade --quick --seconds 3", &["--quick", "--seconds"]),
        (
            "trade --methods phong-0,phong-3",
            &["--methods", "gouraud-0.5", "phong-unit-vectors"],
        ),
        ("requires -o -", &["'-'", "standard output"]),
        ("requires ./key.toml -o key.toml", &["is the scene itself"]),
        ("render absent.toml -o a.png", &["absent.toml"]),
        ("render . -o a.png", &["."]),
        ("render bytes.toml -o a.png", &["bytes.toml"]),
        ("render ./cuboid -o a.png", &["cuboid"]),
        ("view key.toml", &["key.toml:1:1: ", "colour", "^^^^^^"]),
    ] {
        assert_fails(folder.path(), line, 2, words);
    }
    assert_eq!(
        listing(folder.path()),
        ["bytes.toml", "cuboid", "key.toml"],
        "nothing is written"
    );
    // A built-in scene has precedence over a file of its name.
    assert_works(folder.path(), "render cuboid -o a.png --size 9x9");
}

#[test]
fn a_scene_named_like_a_command_is_reached_by_its_path() {
    let folder = folder();
    fs::write(folder.path().join("render"), BUILT_IN[0].1).unwrap();
    // Without a display the scene is found and read, but not shown.
    assert_fails(folder.path(), "./render", 1, &["display"]);
}

#[test]
fn a_simd_level_is_either_used_or_refused() {
    let folder = folder();
    for level in shadetrade::simd::NAMES {
        let line = format!("render -o {level}.png --size 9x9 --simd {level}");
        if shadetrade::simd::named(level).is_some() {
            assert!(assert_works(folder.path(), &line).contains(level));
        } else {
            let words = [level, "this machine", "fallback"];
            assert_fails(folder.path(), &line, 2, &words);
        }
    }
}

#[test]
fn a_colour_in_levels_is_drawn_with_a_warning_and_its_place() {
    let folder = folder();
    let (_, built_in) = BUILT_IN[0];
    let line = built_in.lines().position(|line| line.starts_with("color"));
    let line = line.expect("a light has a colour") + 1;
    let place = format!("a.toml:{line}:9: `light.color`: 255.0 ");
    for (color, warned) in [("[1.0, 1, 0.0]", false), ("[9, 255, 255.0]", true)] {
        let text = built_in.replacen("color = [1.0, 1.0, 1.0]", &format!("color = {color}"), 1);
        assert_ne!(text, built_in);
        fs::write(folder.path().join("a.toml"), text).expect("it is written");
        let said = assert_works(folder.path(), "render a.toml --size 32x24 -o a.png");
        assert_eq!(said.starts_with("warning: "), warned, "{said}");
        assert_eq!(said.contains(&place), warned, "{said}");
    }
}
