//! Wrong command lines and scenes: exit status 2 and one paragraph with what is allowed.

use std::fs;

use shadetrade::scene::BUILT_IN;

use super::{assert_fails, assert_works, folder, listing};

#[test]
fn a_wrong_command_line_ends_with_status_2_and_a_message() {
    let folder = folder();
    for (line, words) in [
        ("render", &["--output <FILE>"][..]),
        ("render a.toml b.toml -o a.png", &["'b.toml'"]),
        ("--size 0x0", &["'0x0'", "1x1 to 16384x16384"]),
        ("view --size 960", &["'960'", "such as 960x720"]),
        ("render -o a.png --size -5x5", &["'-5x5'"]),
        ("render -o a.png --tolerance -1", &["'-1'", "0.0001 to 255"]),
        ("render -o a.png --budget 0", &["'0'", "0.001 to 10000"]),
        (
            "render -o a.png --budget 1 --tolerance 1",
            &["--budget", "--tolerance"],
        ),
        ("probe --pixel 1,1 --budget 1", &["--budget"]),
        ("render -o a.png --threads -1", &["'-1'", "from 1 to 1024"]),
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
            &["a name is missing", "white,ambient"],
        ),
        (
            "render -o a.png --lights all,white",
            &["`all` stands by itself"],
        ),
        (
            "extremes nowhere",
            &["\"nowhere\"", "`shadetrade extremes`"],
        ),
        ("figures --size 5x5", &["unexpected argument '--size'"]),
        ("figures -o -", &["folder", "standard output"]),
        ("completions dos", &["bash, elvish, fish, powershell, zsh"]),
    ] {
        assert_fails(folder.path(), line, 2, words);
    }
    assert_eq!(listing(folder.path()), [""; 0], "nothing is written");
}

#[test]
fn a_scene_named_like_a_command_is_reached_by_its_path() {
    let folder = folder();
    let scene = include_str!("../../../assets/scenes/cuboid.toml");
    fs::write(folder.path().join("render"), scene).unwrap();
    // Without a display the scene is found and read, but not shown.
    assert_fails(folder.path(), "./render", 1, &["display"]);
    assert_fails(folder.path(), "render", 2, &["--output <FILE>"]);
}

#[test]
fn a_built_in_scene_has_precedence_over_a_file_of_its_name() {
    let folder = folder();
    fs::write(folder.path().join("cuboid"), "this is no scene").unwrap();
    assert_works(folder.path(), "render cuboid -o a.png --size 9x9");
    assert_fails(folder.path(), "render ./cuboid -o a.png", 2, &["cuboid"]);
}

#[test]
fn a_wrong_scene_ends_with_status_2_and_is_located() {
    let folder = folder();
    let scene = include_str!("../../../assets/scenes/cuboid.toml");
    fs::write(
        folder.path().join("key.toml"),
        format!("colour = 1\n{scene}"),
    )
    .unwrap();
    fs::write(folder.path().join("empty.toml"), "").unwrap();
    fs::write(folder.path().join("bytes.toml"), [0xff, 0xfe, 0x00]).unwrap();
    for (line, words) in [
        ("render absent.toml -o a.png", &["absent.toml"][..]),
        ("render . -o a.png", &["."]),
        ("render key.toml -o a.png", &["key.toml", "colour", "1"]),
        ("render empty.toml -o a.png", &["empty.toml"]),
        ("render bytes.toml -o a.png", &["bytes.toml"]),
        ("absent.toml", &["absent.toml"]),
        ("view key.toml", &["key.toml", "colour"]),
    ] {
        assert_fails(folder.path(), line, 2, words);
    }
    assert!(!folder.path().join("a.png").exists());
}

#[test]
fn a_simd_level_is_either_used_or_refused() {
    let folder = folder();
    for level in shadetrade::simd::NAMES {
        let line = format!("render -o {level}.png --size 9x9 --simd {level}");
        if shadetrade::simd::named(level).is_some() {
            assert!(assert_works(folder.path(), &line).contains(level));
        } else {
            assert_fails(
                folder.path(),
                &line,
                2,
                &[level, "this machine", "fallback"],
            );
        }
    }
    assert_works(folder.path(), "render -o auto.png --size 9x9 --simd auto");
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
