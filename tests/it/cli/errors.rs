//! Every wrong command line and every wrong scene: status 2 and one paragraph that says what would be right.

use std::fs;

use shadetrade::scene::BUILT_IN;

use super::{assert_fails, assert_works, folder, listing};

#[test]
fn a_wrong_command_line_ends_with_status_2_and_says_what_is_wrong() {
    let folder = folder();
    for (line, words) in [
        ("render", &["--output <FILE>"][..]),
        ("render -o", &["--output <FILE>"]),
        (
            "render a.toml b.toml -o a.png",
            &["unexpected argument 'b.toml'"],
        ),
        ("render -o a.png --size", &["--size <WIDTHxHEIGHT>"]),
        (
            "render -o a.png --size 0x720",
            &["'0x720'", "1x1 to 16384x16384"],
        ),
        (
            "render -o a.png --size 960x0",
            &["'960x0'", "1x1 to 16384x16384"],
        ),
        (
            "render -o a.png --size 16385x1",
            &["'16385x1'", "1x1 to 16384x16384"],
        ),
        (
            "render -o a.png --size 1x16385",
            &["'1x16385'", "1x1 to 16384x16384"],
        ),
        (
            "render -o a.png --size 99999999999999999999x1",
            &["1x1 to 16384x16384"],
        ),
        ("render -o a.png --size 960", &["'960'", "such as 960x720"]),
        ("render -o a.png --size -5x5", &["'-5x5'"]),
        (
            "render -o a.png --tolerance -0.5",
            &["'-0.5'", "from 0.0001 to 255"],
        ),
        (
            "render -o a.png --tolerance 0.00009",
            &["'0.00009'", "0, ", "from 0.0001 to 255"],
        ),
        (
            "render -o a.png --tolerance 256",
            &["'256'", "from 0.0001 to 255"],
        ),
        (
            "render -o a.png --tolerance nan",
            &["'nan'", "from 0.0001 to 255"],
        ),
        (
            "render -o a.png --tolerance inf",
            &["'inf'", "from 0.0001 to 255"],
        ),
        (
            "render -o a.png --tolerance exact",
            &["'exact'", "from 0.0001 to 255"],
        ),
        ("render -o a.png --threads 0", &["'0'", "from 1 to 1024"]),
        ("render -o a.png --threads -1", &["'-1'", "from 1 to 1024"]),
        (
            "render -o a.png --threads 1025",
            &["'1025'", "from 1 to 1024"],
        ),
        (
            "render -o a.png --threads two",
            &["'two'", "from 1 to 1024"],
        ),
        (
            "render -o a.png --simd sse9",
            &["'sse9'", "auto, fallback, sse4.2, avx2, avx512, neon"],
        ),
        (
            "render -o a.png --projection isometric",
            &["'isometric'", "perspective, orthographic"],
        ),
        (
            "render -o a.png --shading flat",
            &["'flat'", "gouraud, phong"],
        ),
        ("render -o a.png --camera 3", &["\"3\"", "\"1\", \"2\""]),
        (
            "render -o a.png --lights white,blue",
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
        ("figures cuboid", &["unexpected argument 'cuboid'"]),
        ("figures --size 5x5", &["unexpected argument '--size'"]),
        ("figures -o -", &["folder", "standard output"]),
        ("completions", &["<SHELL>"]),
        ("completions dos", &["bash, elvish, fish, powershell, zsh"]),
    ] {
        assert_fails(folder.path(), line, 2, words);
    }
    assert_eq!(listing(folder.path()), [""; 0], "nothing is written");
}

#[test]
fn the_shared_options_are_checked_with_and_without_the_word_view() {
    let folder = folder();
    for command in ["", "view "] {
        assert_fails(
            folder.path(),
            &format!("{command}--size 0x0"),
            2,
            &["1x1 to 16384x16384"],
        );
        assert_fails(
            folder.path(),
            &format!("{command}--camera x"),
            2,
            &["\"1\", \"2\""],
        );
        assert_fails(
            folder.path(),
            &format!("{command}bench-far --lights x"),
            2,
            &["\"x\""],
        );
        assert_fails(
            folder.path(),
            &format!("{command}a b"),
            2,
            &["unexpected argument 'b'"],
        );
    }
}

#[test]
fn a_slip_of_the_finger_is_answered_with_what_was_meant() {
    let folder = folder();
    for (line, words) in [
        ("rendr", &["'rendr'", "'render'"][..]),
        ("rendr -o a.png", &["'rendr'", "'render'"]),
        ("figure", &["'figure'", "'figures'"]),
        ("render -o a.png --siz 5x5", &["'--siz'", "'--size'"]),
        ("--tolerence 1", &["'--tolerence'", "'--tolerance'"]),
        ("render -o a.png --shading phon", &["'phong'"]),
        ("--size 5x5 render -o a.png", &["`shadetrade render ...`"]),
        ("--size 5x5 figures", &["`shadetrade figures ...`"]),
    ] {
        assert_fails(folder.path(), line, 2, words);
    }
    assert_eq!(listing(folder.path()), [""; 0], "nothing is written");
}

#[test]
fn a_scene_called_like_a_command_or_nearly_is_reached_by_its_path() {
    let folder = folder();
    let scene = include_str!("../../../assets/scenes/cuboid.toml");
    fs::write(folder.path().join("render"), scene).unwrap();
    fs::write(folder.path().join("rendr"), scene).unwrap();
    // Without a display, a scene that is not built in is found, read, and then not shown.
    assert_fails(folder.path(), "./render", 1, &["display"]);
    assert_fails(folder.path(), "rendr", 1, &["display"]);
    assert_fails(folder.path(), "render", 2, &["--output <FILE>"]);
    assert_works(folder.path(), "render render -o a.png --size 9x9");
}

#[test]
fn a_built_in_scene_wins_over_a_file_of_its_name() {
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
fn a_simd_level_is_either_drawn_with_or_refused() {
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
fn a_colour_in_levels_is_drawn_and_warned_of_with_its_place() {
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
