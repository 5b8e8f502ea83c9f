//! Mistakes in scene files: each gives one message with its place, the text found and what is allowed.

use proptest::prelude::*;
use shadetrade::scene::{BUILT_IN, Scene};

use super::LEAST;
use crate::support::cases::config;

/// A line of [`LEAST`], its replacement (`⏎` breaks the line), the place of the error, and the key and what was found.
const REFUSED: &str = r#"
Keys that do not exist or are missing.
 1 ¦ backgrund = [1, 2, 3]             ¦ 1:1   ¦ `backgrund`
 4 ¦ colour = 3⏎size = [4, 3, 2]       ¦ 4:1   ¦ `colour`
 9 ¦ shininess = 2⏎  emission = 3      ¦ 10:3  ¦ `emission`
14 ¦ intensity = −10.0                ¦ 14:13 ¦ U+2212
14 ¦ intesity = 10.0                   ¦ 14:1  ¦ `intesity` ¦ `intensity`
20 ¦ fov = 30.0⏎far = 3                ¦ 21:1  ¦ `far`
22 ¦ orbit = { zom = 2 }               ¦ 22:11 ¦ `zom` ¦ `zoom`
22 ¦ [view]⏎time = 2.0                 ¦ 23:1  ¦ `time`
 3 ¦                                   ¦ 2:1   ¦ `name` ¦ [[cuboid]]
 9 ¦                                   ¦ 5:1   ¦ `shininess` ¦ [cuboid.material]
13 ¦                                   ¦ 10:1  ¦ `color` ¦ [[light]]
15 ¦                                   ¦ 10:1  ¦ `light[0].position`
16 ¦ [[camera]]⏎[[camera]]             ¦ 16:1  ¦ `name`

Values of the wrong type.
 1 ¦ background = 20                   ¦ 1:14  ¦ `background` ¦ 20
 3 ¦ name = 7                          ¦ 3:8   ¦ 7
 4 ¦ size = [4.0, 3.0]                 ¦ 4:8   ¦ [4.0, 3.0]
 4 ¦ size = [1, 2, 3, 4]               ¦ 4:8   ¦ [1, 2, 3, 4]
 4 ¦ size = [1, "2", 3]                ¦ 4:12  ¦ `cuboid[0].size[1]` ¦ "2" ¦ a number
 4 ¦ size.x = 4                        ¦ 4:1   ¦ size.x
 9 ¦ shininess = true                  ¦ 9:13  ¦ `cuboid[0].material.shininess` ¦ true
12 ¦ kind = "difuse"                   ¦ 12:8  ¦ difuse ¦ `diffuse`
14 ¦ intensity = 1⏎on = 1              ¦ 15:6  ¦ 1
 4 ¦ shading = "Phong"⏎size = [4,3,2]  ¦ 4:11  ¦ Phong ¦ `phong`
 5 ¦ material = 3⏎[cuboid.x]           ¦ 5:12  ¦ 3
22 ¦ orbit = 3                         ¦ 22:9  ¦ `camera[0].orbit` ¦ a table
 1 ¦ view = 3                          ¦ 1:8   ¦ `view` ¦ a table
 2 ¦ [cuboid]                          ¦ 2:1   ¦ [[cuboid]]
20 ¦ fov = 1979-05-27                  ¦ 20:7  ¦ table ¦ a number
20 ¦ fov = { a = 1 }                   ¦ 20:7  ¦ table ¦ a number
22 ¦ [view]⏎projection = "flat"        ¦ 23:14 ¦ flat
22 ¦ [view]⏎show = "all"               ¦ 23:8  ¦ all
22 ¦ [view]⏎sides = ["phong-0"]        ¦ 23:9  ¦ ["phong-0"]
22 ¦ [view]⏎sides = ["phong-0", "x-1"] ¦ 23:9  ¦ "x-1" ¦ "reference"
22 ¦ [view]⏎sides = ["phong-", "phong-0"] ¦ 23:9 ¦ "phong-"
22 ¦ [view]⏎sides = ["phong-0", "phong--1"] ¦ 23:9 ¦ "phong--1"
22 ¦ [view]⏎sides = ["phong-0", "phong-256"] ¦ 23:9 ¦ "phong-256"
22 ¦ [view]⏎sides = ["flat-1", "phong-0"] ¦ 23:9  ¦ "flat-1"
22 ¦ [view]⏎pixel = [0]                ¦ 23:9  ¦ `view.pixel` ¦ 2 values

Numbers out of range; every range is tried below.
 1 ¦ background = [0, 0, nan]          ¦ 1:14  ¦ NaN
 4 ¦ size = [⏎  4,⏎  3, -inf⏎]         ¦ 4:8   ¦ -inf ¦ size = [
 4 ¦ rotation = [0, inf, 0]⏎size = [4,3,2] ¦ 4:12  ¦ inf
22 ¦ [view]⏎tolerance = 1e-5           ¦ 23:13 ¦ `view.tolerance` ¦ 1e-5
22 ¦ [view]⏎tolerance = nan            ¦ 23:13 ¦ `view.tolerance` ¦ NaN
14 ¦ intensity = 10000000000000000000000000000000 ¦ 14:13 ¦ `light[0].intensity` ¦ 1e31 ¦ ^^^^^^^^
14 ¦ intensity = -9223372036854775809  ¦ 14:13 ¦ `light[0].intensity` ¦ -9.2
22 ¦ [view]⏎turned = 99999999999999999999 ¦ 23:10 ¦ `view.turned` ¦ 1e20 ¦ a whole number
22 ¦ [view]⏎turned = 360               ¦ 23:10 ¦ `view.turned` ¦ 360
22 ¦ [view]⏎pixel = [0, 8193]          ¦ 23:9  ¦ `view.pixel[1]` ¦ 8193

Names, and values that do not go together.
 3 ¦ name = ''                         ¦ 3:8   ¦ `cuboid[0].name`
11 ¦ name = "a,b"                      ¦ 11:8  ¦ `light[0].name` ¦ "a,b"
11 ¦ name = "all"                      ¦ 11:8  ¦ `light[0].name` ¦ "all"
11 ¦ name = "none"                     ¦ 11:8  ¦ `light[0].name` ¦ "none"
12 ¦ kind = "ambient"                  ¦ 15:12 ¦ `light[0].position`
19 ¦ target = [0, 0, 0]⏎up = [0, 0, 0] ¦ 20:6  ¦ `camera[0].up` ¦ [0, 0, 0]
19 ¦ up = [-7e99, -5e99, -8e99]⏎target = [0, 0, 0] ¦ 19:6 ¦ `camera[0].up` ¦ [-7e99, -5e99, -8e99]
19 ¦ up = [7e-300, 5e-300, 8e-300]⏎target = [0, 0, 0] ¦ 19:6 ¦ `camera[0].up` ¦ [7e-300, 5e-300, 8e-300]
18 ¦ position = [0, 9, 0]              ¦ 19:10 ¦ `camera[0].target` ¦ [0.0, 0.0, 0.0]
18 ¦ position = [0, 0, -0.0]           ¦ 19:10 ¦ `camera[0].target` ¦ [0.0, 0.0, 0.0]
21 ¦ height = 1⏎orbit.zoom = 1e150     ¦ 22:14 ¦ `camera[0].orbit.zoom` ¦ zoom
21 ¦ height = 1e100⏎orbit.zoom = 10   ¦ 22:14 ¦ `camera[0].orbit.zoom` ¦ zoom
22 ¦ [view]⏎camera = "2"               ¦ 23:10 ¦ `view.camera` ¦ "2"
22 ¦ [view]⏎tolerance = 2⏎budget = 2   ¦ 24:10 ¦ `view.budget` ¦ tolerance
 1 ¦ view.budget = 2⏎view.tolerance = 0.5 ¦ 1:15 ¦ `view.budget` ¦ tolerance

What is no TOML.
12 ¦ kind = diffuse                    ¦ 12:8  ¦ diffuse ¦ ^^^^^^^
14 ¦ intensity = 1⏎intensity = 2       ¦ 15:1  ¦ 15 | intensity = 2
21 ¦ height = [1, 2                    ¦ 21:15 ¦ height = [1, 2
"#;

/// [`LEAST`] with the line of this number, counted from 1, replaced.
fn with_line(number: usize, line: &str) -> String {
    let mut lines: Vec<&str> = LEAST.split('\n').collect();
    lines[number - 1] = line;
    lines.join("\n")
}

fn complaint(text: &str) -> String {
    match Scene::parse("bad.toml", text) {
        Ok(_) => panic!("accepted:\n{text}"),
        Err(error) => error.to_string(),
    }
}

fn assert_complaint(text: &str, place: &str, fragments: &[&str]) {
    let complaint = complaint(text);
    let at_place = complaint.starts_with(&format!("bad.toml:{place}: "));
    assert!(at_place, "expected at {place}:\n{complaint}");
    for fragment in fragments {
        let there = complaint.contains(fragment);
        assert!(there, "expected {fragment:?} in\n{complaint}");
    }
    let one_paragraph = !complaint.ends_with('\n') && !complaint.contains("\n\n");
    assert!(one_paragraph, "{complaint:?}");
}

fn assert_accepted(text: &str) {
    if let Err(error) = Scene::parse("good.toml", text) {
        panic!("{error}");
    }
}

#[test]
fn every_mistake_has_its_place_what_was_found_and_what_is_allowed() {
    for row in REFUSED.lines().filter(|row| row.contains('¦')) {
        let cells: Vec<&str> = row.split('¦').map(str::trim).collect();
        let written = cells[1].replace('⏎', "\n");
        let text = with_line(cells[0].parse().unwrap(), &written);
        assert_complaint(&text, cells[2], &cells[3..]);
    }
}

#[test]
fn a_scene_needs_a_cuboid_and_a_camera() {
    let (rest, camera) = LEAST.split_at(LEAST.find("[[camera]]").unwrap());
    let (cuboid, light) = rest.split_at(rest.find("[[light]]").unwrap());
    for text in ["", "# nothing", light, camera] {
        assert_complaint(text, "1:1", &["1:1: missing field `cuboid`"]);
    }
    assert_complaint(rest, "1:1", &["`camera`"]);
    assert_accepted(&format!("{cuboid}{camera}"));
    let none = format!("cuboid = []\n{camera}");
    assert_complaint(&none, "1:10", &["`cuboid`"]);
}

#[test]
fn a_name_is_unique_within_its_kind() {
    let (rest, camera) = LEAST.split_at(LEAST.find("[[camera]]").unwrap());
    let (cuboid, light) = rest.split_at(rest.find("[[light]]").unwrap());
    let text = format!("{cuboid}{}{camera}", cuboid.trim_start());
    assert_complaint(&text, "11:8", &["`cuboid[1].name`", "\"box\""]);
    for (added, key) in [(light, "`light[1].name`"), (camera, "`camera[1].name`")] {
        assert_complaint(&format!("{LEAST}{added}"), "23:8", &[key]);
    }
    let other = light.replace("white", "other");
    assert_complaint(
        &format!("{LEAST}{other}{light}"),
        "29:8",
        &["`light[2].name`"],
    );
    for (line, name) in [
        (17, "white"),
        (17, "a, b"),
        (17, "all"),
        (11, "All"),
        (11, " "),
    ] {
        assert_accepted(&with_line(line, &format!("name = {name:?}")));
    }
}

/// A line of [`LEAST`], its replacement with `@` for the number, and the ends of its range.
const RANGES: &str = "
 1 ¦ background = [0, @, 0]                  ¦ 0       ¦ 255
 4 ¦ size = [1, 1, @]                        ¦ 1e-100  ¦ 1e100
 4 ¦ size = [1, 1, 1]⏎position = [@, 0, 0]   ¦ -1e100  ¦ 1e100
 4 ¦ size = [1, 1, 1]⏎rotation = [@, 0, 0]   ¦ -1.7976931348623157e308 ¦ 1.7976931348623157e308
 6 ¦ ambient = [@, 0, 0]                     ¦ 0       ¦ 1e30
 7 ¦ diffuse = [0, @, 0]                     ¦ 0       ¦ 1e30
 8 ¦ specular = [0, 0, @]                    ¦ 0       ¦ 1e30
 9 ¦ shininess = @                           ¦ 0       ¦ 1e6
13 ¦ color = [0, 0, @]                       ¦ 0       ¦ 1e30
14 ¦ intensity = @                           ¦ 0       ¦ 1e30
14 ¦ intensity = 1⏎gain = @                  ¦ 0       ¦ 1e30
15 ¦ position = [@, 2, 3]                    ¦ -1e100  ¦ 1e100
18 ¦ position = [1, 2, @]                    ¦ -1e100  ¦ 1e100
19 ¦ target = [@, 2, 3]                      ¦ -1e100  ¦ 1e100
20 ¦ fov = @                                 ¦ 5e-324  ¦ 179
20 ¦ fov = 30⏎near = @                       ¦ 1e-100  ¦ 1e100
20 ¦ fov = 30⏎up = [@, 1, 0]                 ¦ -1e100  ¦ 1e100
21 ¦ height = @                              ¦ 1e-100  ¦ 1e100
22 ¦ orbit.azimuth = @                       ¦ -180    ¦ 180
22 ¦ orbit.elevation = @                     ¦ -180    ¦ 180
22 ¦ [view]⏎divider = @                      ¦ 0       ¦ 1
22 ¦ [view]⏎budget = @                       ¦ 0.001   ¦ 10000
";

#[test]
fn every_range_contains_its_ends_and_nothing_beyond() {
    for row in RANGES.lines().skip(1) {
        let cells: Vec<&str> = row.split('¦').map(str::trim).collect();
        let text = |number: f64| {
            let key = cells[1].replace('⏎', "\n");
            let key = key.replace('@', &format!("{number:e}"));
            with_line(cells[0].parse().unwrap(), &key)
        };
        let [least, most] = [2, 3].map(|cell| cells[cell].parse::<f64>().unwrap());
        assert_accepted(&text(least));
        assert_accepted(&text(most));
        // 1e100 has a hundred zeros, and the largest float 308 digits.
        if most.fract() == 0.0 {
            assert_accepted(&text(most).replace(&format!("{most:e}"), &format!("{most:.0}")));
        }
        for beyond in [least.next_down(), most.next_up()] {
            let complaint = complaint(&text(beyond));
            let found = format!("{beyond:e}");
            assert!(complaint.contains(&found), "{complaint}");
        }
    }
    complaint(&with_line(22, "orbit.zoom = 0"));
    let beyond_f64 = format!("intensity = 1{}", "0".repeat(400));
    assert_complaint(&with_line(14, &beyond_f64), "14:13", &["inf", "1e30"]);
}

#[test]
fn up_and_target_may_come_as_near_as_f64_can_tell() {
    // Along z the sine is the distance of `up` from the axis.
    let along_z = |up: &str| with_line(18, &format!("position = [0, 0, 8]\nup = {up}"));
    assert_complaint(&along_z("[0.999e-9, 0, 1]"), "19:6", &["`camera[0].up`"]);
    assert_accepted(&along_z("[1.001e-9, 0, 1]"));
    // Overflow or underflow does not make vectors parallel.
    assert_accepted(&along_z("[5e-324, 0, 0]"));
    let far = "position = [1e100, 0, 1e100]\nup = [0, 1e100, 0]";
    assert_accepted(&with_line(18, far));

    let at = |x: &str| with_line(18, &format!("position = [{x}, 0, 0]"));
    assert_accepted(&at("1e-100"));
    assert_complaint(&at("0.999e-100"), "19:10", &["`camera[0].target`"]);
}

#[test]
fn the_line_is_shown_with_carets_below_the_mistake() {
    let shown = |text: &str| complaint(text).split_once('\n').unwrap().1.to_owned();
    // A tab, a letter of two bytes and a line end of two bytes count as one column or none.
    let letters = with_line(12, "\tkind\t=\t'é'\r");
    let two_lines = with_line(4, "size = [1,\n1]");
    for (text, expected) in [
        (&*letters, "   |\n12 |  kind = 'é'\n   |         ^^^"),
        (&*two_lines, "  |\n4 | size = [1,\n  |        ^^^"),
        ("", "  |\n1 | \n  | ^"),
        ("\u{feff}a = 1", "  |\n1 | a = 1\n  | ^"),
    ] {
        assert_eq!(shown(text), expected);
    }

    let space = " ".repeat(1000);
    let long = complaint(&with_line(9, &format!("shininess {space}= -1{space}")));
    assert!(long.starts_with("bad.toml:9:1013: "), "{long}");
    let lines: Vec<&str> = long.lines().collect();
    assert_eq!(lines[2].len(), "9 | ".len() + 100);
    let marked = &lines[2][lines[3].find('^').unwrap()..];
    let is_marked = marked.starts_with("-1 ") && lines[3].ends_with(" ^^");
    assert!(is_marked, "{long}");
    for value in [format!("[{}]", "1, ".repeat(100_000)), format!("'{space}'")] {
        let message = complaint(&with_line(9, &format!("shininess = {value}")));
        assert!(message.len() < 800, "{message}");
        let lines: Vec<&str> = message.lines().collect();
        assert!(lines[3].len() <= lines[2].len(), "{message}");
    }
    for (column, is_cut) in [(100, false), (101, true)] {
        let line = format!("{:<1$}-1", "shininess =", column - 1);
        let message = complaint(&with_line(9, &line));
        assert_eq!(!message.contains("9 | shininess"), is_cut, "{message}");
    }
}

#[test]
fn unlimited_nesting_is_refused() {
    let nested = format!("background = {}", "[".repeat(100_000));
    assert_complaint(&nested, "1:94", &["background"]);
    let dotted = format!("{}x = 1\n", "a.".repeat(100_000));
    assert_complaint(&dotted, "1:1", &["1 | a.a."]);
}

/// Pieces for damaging a scene at random, separated by `|`.
const PIECES: &str = "|\n|[|]|[[cuboid]]\n|[light]\n|=|\"|nan|-|1e999|.|é|\0|\r|0x";

proptest! {
    #![proptest_config(config(64))]

    #[test]
    fn any_damaged_scene_is_a_scene_or_one_message(
        scene in 0..BUILT_IN.len(),
        damages in prop::collection::vec((any::<prop::sample::Index>(), 0..40_usize, 0..16_usize), 1..4),
    ) {
        let mut characters: Vec<char> = BUILT_IN[scene].1.chars().collect();
        for (at, length, piece) in damages {
            let start = at.index(characters.len() + 1);
            let end = (start + length).min(characters.len());
            let piece = PIECES.split('|').nth(piece).unwrap_or_default();
            characters.splice(start..end, piece.chars());
        }
        assert_scene_or_message(&characters.into_iter().collect::<String>());
    }
}

fn assert_scene_or_message(text: &str) {
    let Err(error) = Scene::parse("file", text) else {
        return;
    };
    let message = error.to_string();
    let mut place = message.split(':').skip(1);
    let mut number = |said: &str| -> usize { place.next().expect(said).parse().expect(said) };
    let (line, column) = (number("a line"), number("a column"));
    let content = text.split('\n').nth(line - 1).expect("the line exists");
    assert!(column <= content.chars().count() + 1, "{message}");
    assert!(message.lines().count() >= 4, "{message}");
}
