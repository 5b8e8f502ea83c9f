//! Mistakes in scene files: each gives one message with its place, the text found and what is allowed.

use proptest::prelude::*;
use shadetrade::scene::{BUILT_IN, Scene};

use super::LEAST;

/// A line of [`LEAST`], its replacement (`⏎` breaks the line), the place of the error, and parts of its message.
const REFUSED: &str = r#"
Keys that do not exist or are missing.
 1 ¦ backgrund = [1, 2, 3]             ¦ 1:1   ¦ unknown field `backgrund` ¦ `background`, `cuboid`, `light`, `camera`, `view` ¦ 1 | backgrund = [1, 2, 3] ¦ ^^^^^^^^^
 4 ¦ colour = 3⏎size = [4, 3, 2]       ¦ 4:1   ¦ unknown field `colour` ¦ `name`, `size`, `position`, `rotation`, `shading`, `material`
 9 ¦ shininess = 2⏎  emission = 3      ¦ 10:3  ¦ unknown field `emission` ¦ `ambient`, `diffuse`, `specular`, `shininess`
14 ¦ intesity = 10.0                   ¦ 14:1  ¦ unknown field `intesity` ¦ `name`, `kind`, `color`, `intensity`, `gain`, `position`, `on`
20 ¦ fov = 30.0⏎far = 3                ¦ 21:1  ¦ unknown field `far` ¦ `name`, `position`, `target`, `up`, `fov`, `height`, `near`, `orbit`
22 ¦ orbit = { zom = 2 }               ¦ 22:11 ¦ unknown field `zom` ¦ `azimuth`, `elevation`, `zoom`
22 ¦ [view]⏎time = 2.0                 ¦ 23:1  ¦ unknown field `time` ¦ `camera`, `projection`, `tolerance`, `budget`, `show`, `sides`, `divider`
 3 ¦                                   ¦ 2:1   ¦ missing field `name` ¦ 2 | [[cuboid]] ¦ ^^^^^^^^^^
 9 ¦                                   ¦ 5:1   ¦ missing field `shininess` ¦ [cuboid.material]
13 ¦                                   ¦ 10:1  ¦ missing field `color` ¦ [[light]]
15 ¦                                   ¦ 10:1  ¦ `light.position`: missing ¦ expected three numbers ¦ only an ambient light has none
16 ¦ [[camera]]⏎[[camera]]             ¦ 16:1  ¦ missing field `name`

Values of the wrong type.
 1 ¦ background = 20                   ¦ 1:14  ¦ expected a sequence ¦ 20
 3 ¦ name = 7                          ¦ 3:8   ¦ expected a string ¦ 7
 4 ¦ size = [4.0, 3.0]                 ¦ 4:8   ¦ expected an array of 3 values ¦ [4.0, 3.0]
 4 ¦ size = [1, 2, 3, 4]               ¦ 4:8   ¦ expected an array of 3 values ¦ [1, 2, 3, 4]
 4 ¦ size = [1, "2", 3]                ¦ 4:12  ¦ "2" ¦ expected f64
 4 ¦ size.x = 4                        ¦ 4:1   ¦ map ¦ expected a sequence
 9 ¦ shininess = true                  ¦ 9:13  ¦ expected f64 ¦ true
 9 ¦ shininess = 2000-01-01            ¦ 9:13  ¦ 2000-01-01
12 ¦ kind = "difuse"                   ¦ 12:8  ¦ expected one of `ambient`, `diffuse`, `specular` ¦ difuse
14 ¦ intensity = 1⏎on = 1              ¦ 15:6  ¦ expected a boolean ¦ 1
 4 ¦ shading = "Phong"⏎size = [4,3,2]  ¦ 4:11  ¦ expected `gouraud` or `phong` ¦ Phong
 5 ¦ material = 3⏎[cuboid.x]           ¦ 5:12  ¦ 3 ¦ expected a table
 5 ¦ [[cuboid.material]]               ¦ 5:1   ¦ expected a table ¦ [[cuboid.material]]
22 ¦ orbit = [0, 0, 1]                 ¦ 22:9  ¦ expected a table ¦ [0, 0, 1]
 1 ¦ view = 3                          ¦ 1:8   ¦ expected a table ¦ 3
 2 ¦ [cuboid]                          ¦ 2:1   ¦ expected a sequence ¦ [cuboid]
22 ¦ [view]⏎projection = "flat"        ¦ 23:14 ¦ expected `perspective` or `orthographic` ¦ flat
22 ¦ [view]⏎show = "all"               ¦ 23:8  ¦ expected one of `picture`, `wipe`, `error`, `difference`, `tiles` ¦ all
22 ¦ [view]⏎inspector = "help"         ¦ 23:13 ¦ expected one of `pixel`, `scene`, `required`, `proof` ¦ help
22 ¦ [view]⏎sides = ["phong-0"]        ¦ 23:9  ¦ expected an array of 2 values
22 ¦ [view]⏎sides = ["phong-0", "x-1"] ¦ 23:9  ¦ "x-1" ¦ expected "picture", "reference", "phong-unit-vectors"
22 ¦ [view]⏎pixel = [0, -1]            ¦ 23:13 ¦ -1

Numbers out of range; every range is tried below.
 1 ¦ background = [0, 0, nan]          ¦ 1:14  ¦ NaN, expected a number from 0.0 to 255.0
 4 ¦ size = [⏎  4,⏎  3, -inf⏎]         ¦ 4:8   ¦ -inf, expected a number from 1e-100 to 1e100 ¦ size = [
 4 ¦ rotation = [0, inf, 0]⏎size = [4,3,2] ¦ 4:12  ¦ inf, expected a number
14 ¦ intensity = 0xfffffffffffffffffffffffffffffffff ¦ 14:13 ¦ 0xfffff
22 ¦ [view]⏎tolerance = 1e-5           ¦ 23:13 ¦ `view.tolerance`: ¦ expected 0 or a number from 0.0001 to 255 ¦ 1e-5
22 ¦ [view]⏎tolerance = nan            ¦ 23:13 ¦ `view.tolerance`: ¦ NaN
22 ¦ [view]⏎turned = 360               ¦ 23:10 ¦ `view.turned`: ¦ from 0 to 359 ¦ 360
22 ¦ [view]⏎pixel = [0, 16384]         ¦ 23:9  ¦ `view.pixel`: ¦ from 0 to 16383 ¦ 16384

Names, and values that do not go together.
 3 ¦ name = ''                         ¦ 3:8   ¦ `cuboid.name`: ¦ expected a name that is not empty ¦ ''
11 ¦ name = "a,b"                      ¦ 11:8  ¦ `light.name`: ¦ expected a name that holds no comma and is not "all" or "none" ¦ "a,b"
11 ¦ name = "all"                      ¦ 11:8  ¦ `light.name`: ¦ "all"
11 ¦ name = "none"                     ¦ 11:8  ¦ `light.name`: ¦ "none"
17 ¦ name = ""                         ¦ 17:8  ¦ `camera.name`: ¦ ""
12 ¦ kind = "ambient"                  ¦ 15:12 ¦ `light.position`: ¦ an ambient light has none ¦ [10.0, 11.0, 12.0]
19 ¦ target = [0, 0, 0]⏎up = [0, 0, 0] ¦ 20:6  ¦ `camera.up`: ¦ expected a direction that is neither zero nor parallel ¦ [0, 0, 0]
19 ¦ up = [-7e99, -5e99, -8e99]⏎target = [0, 0, 0] ¦ 19:6 ¦ `camera.up`: ¦ [-7e99, -5e99, -8e99]
19 ¦ up = [7e-300, 5e-300, 8e-300]⏎target = [0, 0, 0] ¦ 19:6 ¦ `camera.up`: ¦ [7e-300, 5e-300, 8e-300]
18 ¦ position = [0, 9, 0]              ¦ 19:10 ¦ `camera.target`: ¦ expected a point that is not above or below `camera.position` ¦ [0.0, 0.0, 0.0]
18 ¦ position = [0, 0, -0.0]           ¦ 19:10 ¦ `camera.target`: ¦ expected a point at least 1e-100 away from `camera.position` ¦ [0.0, 0.0, 0.0]
21 ¦ height = 1⏎orbit.zoom = 1e150     ¦ 22:14 ¦ `camera.orbit.zoom`: ¦ distance and height from 1e-100 to 1e100 ¦ zoom
22 ¦ [view]⏎camera = "2"               ¦ 23:10 ¦ `view.camera`: ¦ "2" ¦ expected the name of a camera: 1
22 ¦ [view]⏎tolerance = 2⏎budget = 2   ¦ 24:10 ¦ `view.budget`: ¦ either a budget or a tolerance ¦ 2

What is no TOML.
 4 ¦ size =                            ¦ 4:7   ¦ values must be quoted
12 ¦ kind = diffuse                    ¦ 12:8  ¦ values must be quoted ¦ diffuse ¦ ^^^^^^^
21 ¦ height = 6,3                      ¦ 21:11 ¦ unexpected key or value, expected newline ¦ ,
14 ¦ intensity = 1⏎intensity = 2       ¦ 15:1  ¦ duplicate key ¦ 15 | intensity = 2
21 ¦ height = [1, 2                    ¦ 21:15 ¦ unclosed array, expected `]`
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
        assert_complaint(text, "1:1", &["missing field `cuboid`"]);
    }
    assert_complaint(rest, "1:1", &["missing field `camera`"]);
    assert_accepted(&format!("{cuboid}{camera}"));
    assert_complaint("cuboid = [1]", "1:11", &["`1`", "expected a table"]);
    let none = format!("cuboid = []\n{camera}");
    assert_complaint(
        &none,
        "1:10",
        &["`cuboid`: ", "expected one or more tables"],
    );
}

#[test]
fn a_name_is_unique_within_its_kind() {
    let (rest, camera) = LEAST.split_at(LEAST.find("[[camera]]").unwrap());
    let (cuboid, light) = rest.split_at(rest.find("[[light]]").unwrap());
    let text = format!("{cuboid}{}{camera}", cuboid.trim_start());
    let first = "no other cuboid has";
    assert_complaint(&text, "11:8", &["`cuboid.name`: ", "\"box\"", first]);
    for (added, first) in [(light, "no other light"), (camera, "no other camera")] {
        assert_complaint(&format!("{LEAST}{added}"), "23:8", &[first]);
    }
    let names = [
        (17, "white"),
        (17, "a, b"),
        (17, "all"),
        (11, "All"),
        (11, " "),
    ];
    for (line, name) in names {
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
        for beyond in [least.next_down(), most.next_up()] {
            let complaint = complaint(&text(beyond));
            assert!(complaint.contains(", expected a number "), "{complaint}");
        }
    }
    let zoom = |zoom| complaint(&with_line(22, &format!("orbit.zoom = {zoom}")));
    assert!(zoom("0").contains("from 1e-200 to 1e200"));
}

#[test]
fn up_and_target_may_come_as_near_as_f64_can_tell() {
    // Along z the sine is the distance of `up` from the axis.
    let along_z = |up: &str| with_line(18, &format!("position = [0, 0, 8]\nup = {up}"));
    assert_complaint(&along_z("[0.999e-9, 0, 1]"), "19:6", &["nor parallel"]);
    assert_accepted(&along_z("[1.001e-9, 0, 1]"));
    // Overflow or underflow does not make vectors parallel.
    assert_accepted(&along_z("[5e-324, 0, 0]"));
    let far = "position = [1e100, 0, 1e100]\nup = [0, 1e100, 0]";
    assert_accepted(&with_line(18, far));

    let at = |x: &str| with_line(18, &format!("position = [{x}, 0, 0]"));
    assert_accepted(&at("1e-100"));
    assert_complaint(&at("0.999e-100"), "19:10", &["at least 1e-100 away"]);
}

#[test]
fn the_line_is_shown_with_carets_below_the_mistake() {
    let shown = |text: &str| complaint(text).split_once('\n').unwrap().1.to_owned();
    // A tab, a letter of two bytes and a line end of two bytes count as one column or none.
    assert_eq!(
        shown(&with_line(12, "\tkind\t=\t'é'\r")),
        "   |\n12 |  kind = 'é'\n   |         ^^^"
    );
    assert_eq!(
        shown(&with_line(4, "size = [1,\n1]")),
        "  |\n4 | size = [1,\n  |        ^^^"
    );
    assert_eq!(shown(""), "  |\n1 | \n  | ^");
    assert_eq!(shown("\u{feff}a = 1"), "  |\n1 | a = 1\n  | ^");

    let space = " ".repeat(1000);
    let long = complaint(&with_line(9, &format!("shininess {space}= -1{space}")));
    assert!(
        long.starts_with("bad.toml:9:1013: invalid value: -1.0,"),
        "{long}"
    );
    let lines: Vec<&str> = long.lines().collect();
    assert_eq!(lines[2].len(), "9 | ".len() + 100);
    let marked = &lines[2][lines[3].find('^').unwrap()..];
    assert!(
        marked.starts_with("-1 ") && lines[3].ends_with(" ^^"),
        "{long}"
    );
    for value in [format!("[{}]", "1, ".repeat(100_000)), format!("'{space}'")] {
        let message = complaint(&with_line(9, &format!("shininess = {value}")));
        assert!(message.len() < 800, "{message}");
    }
}

#[test]
fn unlimited_nesting_is_refused() {
    let nested = format!("background = {}", "[".repeat(100_000));
    assert_complaint(&nested, "1:94", &["max recursion depth"]);
    let dotted = format!("# one\n{}x = 1\n", "a.".repeat(100_000));
    assert_complaint(&dotted, "1:1", &["recursion limit"]);
}

/// Pieces for damaging a scene at random, separated by `|`.
const PIECES: &str = "|\n|[|]|[[cuboid]]\n|[light]\n|=|\"|nan|-|1e999|.|é|\0|\r|0x";

proptest! {
    #[test]
    fn any_text_is_a_scene_or_one_message(text in any::<String>()) {
        assert_scene_or_message(&text);
    }

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
