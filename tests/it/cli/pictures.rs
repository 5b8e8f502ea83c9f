//! The output of `render`, `figures`, and `view` without a display.

use super::{SCENE, assert_works, decode, folder, get, listing, put, run, said};
use crate::golden::FIGURES;
use crate::support::scene::text_without_view;

fn render(options: &str) -> (u32, u32, Vec<u8>) {
    let output = run(folder().path(), &format!("render -o - {options}"));
    assert!(output.status.success(), "{options}: {}", said(&output));
    decode(&output.stdout)
}

#[test]
fn a_scene_is_drawn_with_its_own_view_and_options_override_it() {
    let folder = folder();
    let scene = |view: &str| {
        let text = format!("{}\n[view]\n{view}\n", text_without_view());
        put(folder.path(), "a.toml", text);
        folder.path().join("a.toml").display().to_string()
    };
    let small = |words: &str| render(&format!("{words} --size 64x48"));
    let usual = small("");
    let expected = small("--camera 2 --projection orthographic --tolerance 4");
    assert_ne!(expected, usual);
    let own = scene("camera = \"2\"\nprojection = \"orthographic\"\ntolerance = 4");
    assert_eq!(small(&own), expected);
    let back = format!("{own} --camera 1 --projection perspective --tolerance 0.5");
    assert_eq!(small(&back), usual);
    let set = "--set view.camera=\"2\" --set view.projection=orthographic --set view.tolerance=4";
    assert_eq!(small(set), expected);
    let back = format!("{set} --camera 1 --projection perspective --tolerance 0.5");
    assert_eq!(small(&back), usual);
    let turned = small(&scene("turned = 90"));
    assert_ne!(turned, usual);
    assert_eq!(small(&scene("turned = 90\nshow = \"wipe\"")), turned);
}

#[test]
fn a_budget_chooses_the_method_that_is_drawn_and_says_it() {
    let folder = folder();
    let held = format!("{}\n[view]\nbudget = 10000\n", text_without_view());
    put(folder.path(), "held.toml", held);
    let draw_at = |size: &str, words: &str| {
        let line = format!("render {words} --size {size} -o a.png");
        let said = assert_works(folder.path(), &line);
        (get(folder.path(), "a.png"), said)
    };
    let draw = |words: &str| draw_at("160x120", words);
    let (exact, _) = draw("--shading phong --tolerance 0");
    // Everything fits, and nothing does.
    let (picture, words) = draw("held.toml");
    assert!(picture == exact && words.contains("xact Phong"), "{words}");
    assert!(!words.contains("over the budget"), "{words}");
    // Its time is measured once: with three digits it is the same number.
    let times = words.split(" ms").map(|it| it.rsplit(' ').next());
    let times: Vec<f64> = times.flatten().filter_map(|it| it.parse().ok()).collect();
    assert_eq!(times.len(), 3, "{words}");
    assert!((times[1] / times[2] - 1.0).abs() < 0.01, "{words}");
    // The most samples of one pixel take less than the second for timing.
    let (_, words) = draw_at("1x1", "--budget 0.001");
    assert!(words.contains("over the budget"), "{words}");
    let (usual, _) = draw("");
    for option in ["--tolerance 0.5", "--shading gouraud"] {
        let (picture, words) = draw(&format!("held.toml {option}"));
        assert!(picture == usual && !words.contains("budget"), "{words}");
    }
}

#[test]
fn an_empty_picture_says_why() {
    let folder = folder();
    for (name, from, to) in [
        ("near.toml", "# near = 0.01", "near = 100"),
        (
            "behind.toml",
            "target = [0.0, 0.0, 0.0]",
            "target = [14, 10, 16]",
        ),
        (
            "beside.toml",
            "target = [0.0, 0.0, 0.0]",
            "target = [-8, 5, 8]",
        ),
    ] {
        put(folder.path(), name, SCENE.replace(from, to));
    }
    for (line, words) in [
        (
            "render near.toml -o a.png",
            "the cuboid lies before the near plane (100.0)",
        ),
        ("render behind.toml -o a.png --reference", "behind the eye"),
        ("prove beside.toml", "beside the picture"),
        (
            "trade near.toml --quick --methods phong-0",
            "before the near plane",
        ),
        (
            "render extremes/eye-inside -o a.png",
            "its inside is not drawn",
        ),
        ("render -o a.png", ""),
    ] {
        let said = assert_works(folder.path(), &format!("{line} --size 80x60"));
        let mut lines = said.lines();
        let reason = lines.find_map(|it| it.strip_prefix("nothing is seen: "));
        assert_eq!(reason.is_some(), !words.is_empty(), "{line}: {said}");
        assert!(reason.unwrap_or_default().contains(words), "{line}: {said}");
    }
}

#[test]
fn intensities_that_are_shares_of_1_are_explained() {
    let folder = folder();
    put(folder.path(), "levels.toml", SCENE);
    let shares = "--set light.white.gain=1 --set light.white.intensity=1 --lights white";
    for (options, is_dark) in [("", false), ("--lights none", false), (shares, true)] {
        let line = format!("render levels.toml {options} -o a.png --size 80x60");
        let said = assert_works(folder.path(), &line);
        assert_eq!(said.contains("gain = 255"), is_dark, "{line}: {said}");
    }
}

#[test]
fn render_reports_the_file_the_shaded_pixels_and_the_time_of_a_frame() {
    let folder = folder();
    for (options, words) in [
        ("--threads 3 --simd fallback", " ms |3 threads,|fallback"),
        ("--reference", "in f64| s"),
    ] {
        let line = format!("render -o a.png --size 64x80 --lights none {options}");
        let said = assert_works(folder.path(), &line);
        // The picture is black at the cuboid and shows the scene's background elsewhere.
        let (_, _, bytes) = decode(&get(folder.path(), "a.png"));
        let pixels = bytes.chunks_exact(3);
        let (black, others): (Vec<_>, Vec<_>) = pixels.partition(|pixel| **pixel == [0, 0, 0]);
        assert!(others.iter().all(|pixel| **pixel == [236, 238, 240]));
        let shaded = format!("wrote a.png: PNG, 64x80, {} pixels shaded", black.len());
        for word in words.split('|').chain([&*shaded]) {
            assert!(said.contains(word), "{word}: {said}");
        }
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
        ("--lights ambient,white,white", false),
        ("bench-far", false),
        ("cuboid --camera 1 --projection perspective", true),
        ("--shading gouraud --lights all", true),
        ("--threads 3", true),
        ("--simd fallback", true),
    ] {
        assert_eq!(picture(options) == plain, is_same, "{options}");
    }
    for (scene, _) in shadetrade::scene::BUILT_IN {
        let (_, _, bytes) = picture(scene);
        let mut pixels = bytes.chunks_exact(3);
        assert!(pixels.any(|pixel| pixel != &bytes[..3]), "{scene} is empty");
    }
}

#[test]
fn without_a_display_plain_view_draws_the_figures() {
    let folder = folder();
    let made = folder.path().join("shadetrade-figures");
    std::fs::create_dir(&made).expect("it is made");
    put(&made, "mine.txt", "mine");
    put(&made, "sheet.png", "old");
    let said = assert_works(folder.path(), "");
    assert_eq!(said.matches("no display").count(), 1, "{said}");
    assert_eq!(listing(folder.path()), ["shadetrade-figures"]);
    let mut there = listing(&made);
    there.retain(|name| name != "mine.txt");
    let mut figures = ["components.png", "sheet.png"].map(str::to_owned).to_vec();
    figures.extend(FIGURES.map(|name| format!("{name}.png")));
    figures.sort_unstable();
    assert_eq!(there, figures);
    for name in figures {
        assert!(said.contains(&name), "{name} is named");
        let (width, height, _) = decode(&get(&made, &name));
        if name.contains("camera") {
            assert_eq!((width, height), (960, 720), "{name}");
        } else {
            assert!(width > height && height > 360, "{name} is {width}x{height}");
        }
    }
    for (name, options) in [
        ("gouraud-camera-2.png", "gouraud --camera 2"),
        ("phong-white-camera-1.png", "phong --lights white,ambient"),
    ] {
        let picture = render(&format!("--shading {options} --tolerance 0"));
        assert!(decode(&get(&made, name)) == picture, "{name}");
    }
    assert_eq!(get(&made, "mine.txt"), b"mine");
}
