//! The output of `render`, `figures`, and `view` without a display.

use std::fs;

use super::{assert_fails, assert_works, decode, folder, listing, run, said};

const FIGURES: [&str; 8] = [
    "components.png",
    "gouraud-camera-1.png",
    "gouraud-camera-2.png",
    "phong-camera-1.png",
    "phong-camera-2.png",
    "phong-white-camera-1.png",
    "phong-white-camera-2.png",
    "sheet.png",
];

fn render(options: &str) -> (u32, u32, Vec<u8>) {
    let output = run(folder().path(), &format!("render -o - {options}"));
    assert_eq!(
        output.status.code(),
        Some(0),
        "{options}: {}",
        said(&output)
    );
    decode(&output.stdout)
}

#[test]
fn render_writes_a_picture_of_the_size_asked_for() {
    let folder = folder();
    assert_works(folder.path(), "render -o a.png");
    let (width, height, _) = decode(&fs::read(folder.path().join("a.png")).unwrap());
    assert_eq!((width, height), (960, 720));
    for (options, size) in [
        ("--size 1x1", (1, 1)),
        ("--size 16384x1", (16_384, 1)),
        ("--size 3x500", (3, 500)),
    ] {
        let (width, height, _) = render(options);
        assert_eq!((width, height), size);
    }
}

#[test]
fn a_scene_is_drawn_with_its_own_view_and_options_override_it() {
    let folder = folder();
    let scene = |name: &str, view: &str| {
        let path = folder.path().join(name);
        let text = include_str!("../../../assets/scenes/cuboid.toml");
        fs::write(&path, format!("{text}\n[view]\n{view}\n")).expect("written");
        path.display().to_string()
    };
    let small = |words: &str| render(&format!("{words} --size 64x48"));
    let usual = small("");
    let options = "--camera 2 --projection orthographic --tolerance 4";
    let expected = small(options);
    assert_ne!(expected, usual);
    let view = "camera = \"2\"\nprojection = \"orthographic\"\ntolerance = 4";
    let looked_at = scene("a.toml", view);
    assert_eq!(small(&looked_at), expected);
    let back = "--camera 1 --projection perspective --tolerance 0.5";
    assert_eq!(small(&format!("{looked_at} {back}")), usual);
    let turned = scene("b.toml", "turned = 90");
    assert_ne!(small(&turned), usual);
    assert_eq!(
        small(&turned),
        small(&scene("c.toml", "turned = 90\nshow = \"wipe\""))
    );
}

#[test]
fn a_budget_chooses_the_method_that_is_drawn_and_says_it() {
    let folder = folder();
    let path = folder.path().join("held.toml");
    let text = include_str!("../../../assets/scenes/cuboid.toml");
    fs::write(&path, format!("{text}\n[view]\nbudget = 10000\n")).expect("written");
    let draw = |words: &str| {
        let output = run(
            folder.path(),
            &format!("render {words} --size 64x48 -o a.png"),
        );
        assert!(output.status.success(), "{}", said(&output));
        let picture = fs::read(folder.path().join("a.png")).expect("it is there");
        (picture, said(&output))
    };
    let (exact, _) = draw("--shading phong --tolerance 0");
    // Everything fits, and nothing does.
    for words in ["--budget 10000", "held.toml"] {
        let (picture, words) = draw(words);
        assert!(picture == exact && words.contains("xact Phong"), "{words}");
        assert!(!words.contains("over the budget"), "{words}");
    }
    let (_, words) = draw("--budget 0.001");
    assert!(words.contains("over the budget"), "{words}");
    let (usual, _) = draw("");
    let (picture, words) = draw("held.toml --tolerance 0.5");
    assert!(picture == usual && !words.contains("budget"), "{words}");
}

#[test]
fn render_reports_the_file_the_shaded_pixels_and_the_time_of_a_frame() {
    let folder = folder();
    let line = "render -o a.png --size 64x48 --threads 3 --simd fallback --lights none";
    let said = assert_works(folder.path(), line);
    // The picture is black at the cuboid and shows the scene's background elsewhere.
    let (_, _, bytes) = decode(&fs::read(folder.path().join("a.png")).unwrap());
    let pixels = bytes.chunks_exact(3);
    let (black, others): (Vec<_>, Vec<_>) = pixels.partition(|pixel| **pixel == [0, 0, 0]);
    assert!(others.iter().all(|pixel| **pixel == [236, 238, 240]));
    let shaded = format!(" {} pixels shaded", black.len());
    for word in [
        "wrote a.png",
        "PNG",
        "64x48",
        &shaded,
        " ms ",
        "3 threads,",
        "fallback",
    ] {
        assert!(said.contains(word), "{word}: {said}");
    }
}

#[test]
fn options_of_the_scene_change_the_picture_and_options_of_speed_do_not() {
    let picture = |options: &str| render(&format!("--size 96x72 {options}"));
    let plain = picture("");
    for (options, is_same) in [
        ("--camera 2", false),
        ("--projection orthographic", false),
        ("--shading phong", false),
        ("--lights white,ambient", false),
        ("bench-far", false),
        ("cuboid --camera 1 --projection perspective", true),
        ("--shading gouraud --lights all", true),
        ("--threads 3", true),
        ("--simd fallback", true),
    ] {
        assert_eq!(picture(options) == plain, is_same, "{options}");
    }
    let orders = ["--lights white,ambient", "--lights ambient,white,white"].map(&picture);
    assert!(orders[0] == orders[1]);
}

#[test]
fn every_built_in_scene_shows_something() {
    for (scene, _) in shadetrade::scene::BUILT_IN {
        let (_, _, bytes) = render(&format!("{scene} --size 64x48"));
        let mut pixels = bytes.chunks_exact(3);
        assert!(pixels.any(|pixel| pixel != &bytes[..3]), "{scene}");
    }
}

#[test]
fn an_extreme_is_proven_and_drawn_by_its_name() {
    let folder = folder();
    let output = run(folder.path(), "extremes picture-1x1 speck --json");
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let outcomes: Vec<serde_json::Value> = serde_json::from_slice(&output.stdout).expect("JSON");
    let names: Vec<_> = outcomes.iter().map(|outcome| &outcome["name"]).collect();
    assert_eq!(names, ["picture-1x1", "speck"]);
    assert!(outcomes.iter().all(|outcome| outcome["pass"] == true));
    render("extremes/eye-on-an-edge --size 64x48");
}

#[test]
fn all_figures_are_written_at_the_right_size_and_equal_the_pictures_of_render() {
    let folder = folder();
    let output = run(folder.path(), "figures");
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(output.stdout.is_empty());
    let made = folder.path().join("shadetrade-figures");
    assert_eq!(listing(&made), FIGURES);
    let read = |name: &str| fs::read(made.join(name)).unwrap();
    for name in FIGURES {
        let (width, height, _) = decode(&read(name));
        if name.contains("camera") {
            assert_eq!((width, height), (960, 720), "{name}");
        } else {
            assert!(width > height && height > 360, "{name} is {width}x{height}");
        }
        assert!(said(&output).contains(name), "{name} is named");
    }
    for (name, options) in [
        ("gouraud-camera-2.png", "--shading gouraud --camera 2"),
        (
            "phong-white-camera-1.png",
            "--shading phong --camera 1 --lights white,ambient",
        ),
    ] {
        let picture = render(&format!("{options} --tolerance 0"));
        assert!(decode(&read(name)) == picture, "{name}");
    }

    // Figures are replaced by the same bytes, and other files are not changed.
    let before = FIGURES.map(read);
    fs::write(made.join("mine.txt"), "mine").unwrap();
    fs::write(made.join("sheet.png"), "old").unwrap();
    assert_works(folder.path(), "figures -o shadetrade-figures");
    assert!(FIGURES.map(read) == before);
    assert_eq!(read("mine.txt"), b"mine");
}

#[test]
fn without_a_display_plain_view_draws_the_figures() {
    for line in ["", "view"] {
        let folder = folder();
        let said = assert_works(folder.path(), line);
        let display = said
            .lines()
            .filter(|line| line.contains("no display"))
            .count();
        assert_eq!(display, 1, "`shadetrade {line}` said: {said}");
        assert_eq!(listing(&folder.path().join("shadetrade-figures")), FIGURES);
        assert_eq!(listing(folder.path()), ["shadetrade-figures"]);
        assert_works(folder.path(), line);
    }
}

#[test]
fn without_a_display_a_named_scene_or_view_is_an_error_that_advises_render() {
    let folder = folder();
    for (line, scene) in [
        ("bench-far", "bench-far"),
        ("cuboid", "cuboid"),
        ("view --camera 2", "cuboid"),
    ] {
        let advice = format!("shadetrade render {scene} -o");
        assert_fails(folder.path(), line, 1, &["no display", &advice]);
    }
    assert_eq!(listing(folder.path()), [""; 0]);
}

#[test]
fn a_folder_for_figures_is_created_but_its_parent_is_not() {
    let folder = folder();
    fs::write(folder.path().join("file"), "mine").unwrap();
    for (path, words) in [
        ("a/b", ["a/b", "no folder a"]),
        ("file", ["file", "not a folder"]),
    ] {
        assert_fails(folder.path(), &format!("figures -o {path}"), 1, &words);
    }
    assert_eq!(fs::read(folder.path().join("file")).unwrap(), b"mine");
    assert_works(folder.path(), "figures -o new/");
    assert_eq!(listing(folder.path()), ["file", "new"]);
}
