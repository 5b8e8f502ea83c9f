//! Mistakes in scene files: each gives one message with its place, the text found and what is allowed.

use proptest::prelude::*;
use shadetrade::scene::{BUILT_IN, Scene, SceneError};

use super::LEAST;

/// A line of [`LEAST`], its replacement (`⏎` breaks the line), the place of the error, and parts of its message.
const REFUSED: &str = r#"
Keys that do not exist.
 1 ¦ backgrund = [1, 2, 3]             ¦ 1:1   ¦ unknown field `backgrund` ¦ `background`, `cuboid`, `light`, `camera`, `view` ¦ ^^^^^^^^^
 4 ¦ colour = 3⏎size = [4, 3, 2]       ¦ 4:1   ¦ unknown field `colour` ¦ `name`, `size`, `position`, `rotation`, `shading`, `material`
 9 ¦ shininess = 2⏎  emission = 3      ¦ 10:3  ¦ unknown field `emission` ¦ `ambient`, `diffuse`, `specular`, `shininess`
14 ¦ intesity = 10.0                   ¦ 14:1  ¦ unknown field `intesity` ¦ `name`, `kind`, `color`, `intensity`, `gain`, `position`, `on`
20 ¦ fov = 30.0⏎far = 3                ¦ 21:1  ¦ unknown field `far` ¦ `name`, `position`, `target`, `up`, `fov`, `height`, `near`, `orbit`
 4 ¦ "size\n" = 3                      ¦ 4:1   ¦ unknown field `size `
17 ¦ nmae = "1"                        ¦ 17:1  ¦ unknown field `nmae`
14 ¦ zzz = 1⏎yyy = 2⏎intensity = 3     ¦ 14:1  ¦ unknown field `zzz`
 5 ¦ [material]                        ¦ 2:1   ¦ `cuboid`: missing field `material`
 5 ¦ material = 3⏎[cuboid.x]           ¦ 5:12  ¦ `cuboid.material`: ¦ 3 ¦ expected a table

Keys that are missing.
 3 ¦                                   ¦ 2:1   ¦ `cuboid`: missing field `name` ¦ 2 | [[cuboid]] ¦ ^^^^^^^^^^
 4 ¦                                   ¦ 2:1   ¦ `cuboid`: missing field `size`
 5 ¦ [[light]]                         ¦ 2:1   ¦ `cuboid`: missing field `material`
 6 ¦                                   ¦ 5:1   ¦ `cuboid.material`: missing field `ambient`
 7 ¦                                   ¦ 5:1   ¦ `cuboid.material`: missing field `diffuse`
 8 ¦                                   ¦ 5:1   ¦ `cuboid.material`: missing field `specular`
 9 ¦                                   ¦ 5:1   ¦ `cuboid.material`: missing field `shininess`
11 ¦                                   ¦ 10:1  ¦ `light`: missing field `name`
12 ¦                                   ¦ 10:1  ¦ `light`: missing field `kind`
13 ¦                                   ¦ 10:1  ¦ `light`: missing field `color`
14 ¦                                   ¦ 10:1  ¦ `light`: missing field `intensity`
15 ¦                                   ¦ 10:1  ¦ `light.position`: missing ¦ expected three numbers ¦ only an ambient light has none
17 ¦                                   ¦ 16:1  ¦ `camera`: missing field `name`
18 ¦                                   ¦ 16:1  ¦ `camera`: missing field `position`
19 ¦                                   ¦ 16:1  ¦ `camera`: missing field `target`
20 ¦                                   ¦ 16:1  ¦ `camera`: missing field `fov`
21 ¦                                   ¦ 16:1  ¦ `camera`: missing field `height`
16 ¦ [[camera]]⏎[[camera]]             ¦ 16:1  ¦ `camera`: missing field `name`

Values of the wrong type.
 1 ¦ background = 20                   ¦ 1:14  ¦ `background`: ¦ expected a sequence ¦ 20
 3 ¦ name = 7                          ¦ 3:8   ¦ `cuboid.name`: ¦ expected a string ¦ 7
 4 ¦ size = [4.0, 3.0]                 ¦ 4:8   ¦ `cuboid.size`: ¦ expected an array of 3 values ¦ [4.0, 3.0]
 4 ¦ size = [1, 2, 3, 4]               ¦ 4:8   ¦ `cuboid.size` ¦ [1, 2, 3, 4]
 4 ¦ size = [1, "2", 3]                ¦ 4:12  ¦ `cuboid.size` ¦ "2"
 4 ¦ size = { x = 1, y = 2, z = 3 }    ¦ 4:8   ¦ `cuboid.size` ¦ { x = 1, y = 2, z = 3 }
 4 ¦ size.x = 4                        ¦ 4:1   ¦ `cuboid.size` ¦ size
 9 ¦ shininess = true                  ¦ 9:13  ¦ `cuboid.material.shininess`: ¦ expected f64 ¦ true
 9 ¦ shininess = 2000-01-01            ¦ 9:13  ¦ `cuboid.material.shininess` ¦ 2000-01-01
 9 ¦ shininess = 0x                    ¦ 9:13  ¦ `cuboid.material.shininess` ¦ 0x
12 ¦ kind = "difuse"                   ¦ 12:8  ¦ `light.kind`: ¦ expected one of `ambient`, `diffuse`, `specular` ¦ "difuse"
12 ¦ kind = 1                          ¦ 12:8  ¦ `light.kind` ¦ 1
14 ¦ intensity = 1⏎on = 1              ¦ 15:6  ¦ `light.on`: ¦ expected a boolean ¦ 1
 4 ¦ shading = "flat"⏎size = [4, 3, 2] ¦ 4:11  ¦ `cuboid.shading`: ¦ expected `gouraud` or `phong` ¦ "flat"
 4 ¦ shading = "Phong"⏎size = [4,3,2]  ¦ 4:11  ¦ `cuboid.shading`: ¦ expected `gouraud` or `phong` ¦ "Phong"
 5 ¦ [[cuboid.material]]               ¦ 5:1   ¦ `cuboid.material`: ¦ expected a table ¦ [[cuboid.material]]
 2 ¦ [cuboid]                          ¦ 2:1   ¦ `cuboid`: ¦ expected a sequence ¦ [cuboid]
10 ¦ [light]                           ¦ 10:1  ¦ `light`: ¦ expected a sequence ¦ [light]
16 ¦ [camera]                          ¦ 16:1  ¦ `camera`: ¦ expected a sequence ¦ [camera]

Numbers out of range, and those that are none.
 1 ¦ background = [0, 255.5, 0]        ¦ 1:18  ¦ `background`: ¦ expected a number from 0 to 255 ¦ 255.5
 1 ¦ background = [0, 0, nan]          ¦ 1:21  ¦ `background` ¦ nan
 4 ¦ size = [4, 0, 2]                  ¦ 4:12  ¦ `cuboid.size` ¦ 0
 4 ¦ size = [-4.0, 3, 2]               ¦ 4:9   ¦ `cuboid.size` ¦ -4.0 ¦ ^^^^
 4 ¦ size = [⏎  4,⏎  3, -inf⏎]         ¦ 6:6   ¦ `cuboid.size` ¦ -inf
 4 ¦ size = [1e-400, 3, 2]             ¦ 4:9   ¦ `cuboid.size` ¦ 1e-400
 4 ¦ rotation = [0, inf, 0]⏎size = [4,3,2] ¦ 4:16  ¦ `cuboid.rotation`: ¦ expected a number that is finite (degrees) ¦ inf
 6 ¦ ambient = [0, 0, -1e-300]         ¦ 6:18  ¦ `cuboid.material.ambient` ¦ -1e-300
 7 ¦ diffuse = [1e999, 0, 0]           ¦ 7:12  ¦ `cuboid.material.diffuse` ¦ 1e999
 8 ¦ specular = [0, +inf, 0]           ¦ 8:16  ¦ `cuboid.material.specular` ¦ +inf
 9 ¦ shininess = 1000001               ¦ 9:13  ¦ `cuboid.material.shininess` ¦ 1000001
13 ¦ color = [0, 0, -1]                ¦ 13:16 ¦ `light.color` ¦ -1
14 ¦ intensity = -nan                  ¦ 14:13 ¦ `light.intensity`: ¦ expected a number from 0 to 1e30 ¦ -nan
14 ¦ intensity = 1⏎gain = -1           ¦ 15:8  ¦ `light.gain` ¦ -1
15 ¦ position = [0, 2e100, 0]          ¦ 15:16 ¦ `light.position` ¦ 2e100
20 ¦ fov = 0                           ¦ 20:7  ¦ `camera.fov`: ¦ expected a number above 0 and at most 179 (degrees) ¦ 0
20 ¦ fov = 180                         ¦ 20:7  ¦ `camera.fov` ¦ 180
20 ¦ fov = 30⏎near = 0.0               ¦ 21:8  ¦ `camera.near`: ¦ expected a number from 1e-100 to 1e100 ¦ 0.0
21 ¦ height = -6.3                     ¦ 21:10 ¦ `camera.height` ¦ -6.3
14 ¦ intensity = 0xfffffffffffffffffffffffffffffffff ¦ 14:13 ¦ `light.intensity` ¦ 0xfffff

Names that are none.
 3 ¦ name = ''                         ¦ 3:8   ¦ `cuboid.name`: ¦ expected a name that is not empty ¦ ''
11 ¦ name = ""                         ¦ 11:8  ¦ `light.name`: ¦ expected a name that is not empty ¦ ""
11 ¦ name = "a,b"                      ¦ 11:8  ¦ `light.name`: ¦ expected a name that holds no comma and is not "all" or "none" ¦ "a,b"
11 ¦ name = "all"                      ¦ 11:8  ¦ `light.name` ¦ "all"
11 ¦ name = "none"                     ¦ 11:8  ¦ `light.name` ¦ "none"
17 ¦ name = ""                         ¦ 17:8  ¦ `camera.name` ¦ ""

Values that do not go together.
12 ¦ kind = "ambient"                  ¦ 15:12 ¦ `light.position`: ¦ unknown field of an ambient light ¦ [10.0, 11.0, 12.0]
19 ¦ target = [0, 0, 0]⏎up = [0, 0, 0] ¦ 20:6  ¦ `camera.up`: ¦ expected a direction that is neither zero nor parallel to the view ¦ [0, 0, 0]
19 ¦ target = [0, 0, 0]⏎up = [7, 5, 8] ¦ 20:6  ¦ `camera.up` ¦ [7, 5, 8]
19 ¦ up = [-7e99, -5e99, -8e99]⏎target = [0, 0, 0] ¦ 19:6 ¦ `camera.up` ¦ [-7e99, -5e99, -8e99]
19 ¦ up = [7e-300, 5e-300, 8e-300]⏎target = [0, 0, 0] ¦ 19:6 ¦ `camera.up` ¦ [7e-300, 5e-300, 8e-300]
18 ¦ position = [0, 9, 0]              ¦ 19:10 ¦ `camera.target`: ¦ expected a point that is not above or below `camera.position`, as `camera.up` is +y ¦ [0.0, 0.0, 0.0]
18 ¦ position = [0, 0, -0.0]           ¦ 19:10 ¦ `camera.target`: ¦ expected a point at least 1e-100 away from `camera.position` ¦ [0.0, 0.0, 0.0]
21 ¦ height = 1⏎orbit.zoom = 1e150    ¦ 22:1  ¦ `camera.orbit`: ¦ distance and height from 1e-100 to 1e100 ¦ zoom

How the scene is looked at, and from where.
22 ¦ orbit = [0, 0, 1]                 ¦ 22:9  ¦ `camera.orbit`: ¦ expected a table ¦ [0, 0, 1]
22 ¦ orbit = { zoom = 0 }              ¦ 22:18 ¦ `camera.orbit.zoom`: ¦ expected a number from 1e-200 to 1e200 ¦ 0
22 ¦ orbit = { azimuth = 181 }         ¦ 22:21 ¦ `camera.orbit.azimuth`: ¦ expected a number from -180 to 180 ¦ 181
22 ¦ orbit = { zom = 2 }               ¦ 22:11 ¦ `camera.orbit`: unknown field `zom` ¦ `azimuth`, `elevation`, `zoom`
22 ¦ [view]⏎camera = "2"               ¦ 23:10 ¦ `view.camera`: ¦ "2" ¦ expected the name of a camera: 1
22 ¦ [view]⏎time = 2.0                 ¦ 23:1  ¦ unknown field `time` ¦ `camera`, `projection`, `tolerance`, `budget`, `show`, `sides`, `divider`
22 ¦ [view]⏎budget = 0                 ¦ 23:10 ¦ `view.budget`: ¦ expected a number from 0.001 to 10000 ¦ 0
22 ¦ [view]⏎tolerance = 2⏎budget = 2   ¦ 24:10 ¦ `view.budget`: ¦ either a budget or a tolerance ¦ 2
22 ¦ [view]⏎projection = "flat"        ¦ 23:14 ¦ `view.projection`: ¦ expected `perspective` or `orthographic` ¦ "flat"
22 ¦ [view]⏎tolerance = 1e-5           ¦ 23:13 ¦ `view.tolerance`: ¦ expected 0 or a number from 0.0001 to 255 ¦ 1e-5
22 ¦ [view]⏎tolerance = nan            ¦ 23:13 ¦ `view.tolerance` ¦ nan
22 ¦ [view]⏎show = "all"               ¦ 23:8  ¦ `view.show`: ¦ expected one of `picture`, `wipe`, `error`, `difference`, `tiles` ¦ "all"
22 ¦ [view]⏎sides = ["phong-0"]        ¦ 23:9  ¦ `view.sides`: ¦ expected an array of 2 values
22 ¦ [view]⏎sides = ["phong-0", "x-1"] ¦ 23:9  ¦ `view.sides`: ¦ "x-1" ¦ expected "picture", "reference", "phong-unit-vectors"
22 ¦ [view]⏎divider = 1.1              ¦ 23:11 ¦ `view.divider`: ¦ expected a number from 0 to 1 ¦ 1.1
22 ¦ [view]⏎turned = 360               ¦ 23:10 ¦ `view.turned`: ¦ from 0 to 359 ¦ 360
22 ¦ [view]⏎pixel = [0, 16384]         ¦ 23:9  ¦ `view.pixel`: ¦ from 0 to 16383 ¦ 16384
22 ¦ [view]⏎pixel = [0, -1]            ¦ 23:13 ¦ `view.pixel` ¦ -1
22 ¦ [view]⏎magnifier.scale = 3        ¦ 23:19 ¦ `view.magnifier.scale`: ¦ a power of two from 1 to 64 ¦ 3
22 ¦ [view]⏎magnifier.corner = [1]     ¦ 23:20 ¦ `view.magnifier.corner`: ¦ expected an array of 2 values
22 ¦ [view]⏎inspector = "help"         ¦ 23:13 ¦ `view.inspector`: ¦ expected one of `pixel`, `scene`, `required`, `proof` ¦ "help"
 1 ¦ view = 3                          ¦ 1:8   ¦ `view`: ¦ expected a table ¦ 3

What is no TOML.
 4 ¦ size =                            ¦ 4:7   ¦ values must be quoted
12 ¦ kind = diffuse                    ¦ 12:8  ¦ values must be quoted ¦ diffuse ¦ ^^^^^^^
 4 ¦ size [4, 3, 2]                    ¦ 4:6   ¦ key with no value, expected `=` ¦ size [4
 4 ¦ size == [4, 3, 2]                 ¦ 4:7   ¦ extra `=`
21 ¦ height = 6,3                      ¦ 21:11 ¦ unexpected key or value, expected newline ¦ ,
14 ¦ intensity = 1⏎intensity = 2       ¦ 15:1  ¦ duplicate key ¦ 15 | intensity = 2
 7 ¦ [cuboid.material]                 ¦ 7:9   ¦ duplicate key ¦ 7 | [cuboid.material]
16 ¦ [light]⏎[[camera]]                ¦ 16:2  ¦ duplicate key ¦ 16 | [light]
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
    assert_accepted(LEAST);
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
        let missing = "missing field `cuboid`";
        assert_complaint(text, "1:1", &[missing]);
    }
    let missing = "missing field `camera`";
    assert_complaint(rest, "1:1", &[missing]);
    assert_accepted(&format!("{cuboid}{camera}"));

    let needed = "expected one or more tables";
    let none = format!("cuboid = []\n{camera}");
    assert_complaint(&none, "1:10", &["`cuboid`: ", needed]);
    let number = ["`cuboid`: ", "`1`", "expected a table"];
    assert_complaint("cuboid = [1]", "1:11", &number);

    let (bare, _) = cuboid.split_at(cuboid.find("[cuboid.material]").unwrap());
    let missing = "`cuboid`: missing field `material`";
    assert_complaint(&format!("{bare}{camera}"), "2:1", &[missing]);
}

#[test]
fn a_name_is_unique_within_its_kind() {
    let (rest, camera) = LEAST.split_at(LEAST.find("[[camera]]").unwrap());
    let (cuboid, light) = rest.split_at(rest.find("[[light]]").unwrap());
    let first = "expected a name that no other cuboid has";
    let text = format!("{cuboid}{}{camera}", cuboid.trim_start());
    assert_complaint(&text, "11:8", &["`cuboid.name`: ", "\"box\"", first]);
    let first = "expected a name that no other light has";
    assert_complaint(&format!("{LEAST}{light}"), "23:8", &[first]);
    let first = "expected a name that no other camera has";
    assert_complaint(&format!("{LEAST}{camera}"), "23:8", &[first]);

    for name in ["white", "box", "all", "a, b", " ", "é"] {
        assert_accepted(&with_line(17, &format!("name = {name:?}")));
    }
    for name in ["All", "al l", " ", "ambient", "1"] {
        assert_accepted(&with_line(11, &format!("name = {name:?}")));
    }
}

#[test]
fn every_range_contains_its_ends_and_nothing_beyond() {
    /// The next number away from 0.
    fn beyond(number: f64) -> f64 {
        f64::from_bits(number.to_bits() + 1)
    }
    let below_length = f64::from_bits(1e-100_f64.to_bits() - 1);
    // A line, the key with `@` for the number, a number below the range, and both ends of the range.
    let keys = [
        (1, "background = [0, @, 0]", -5e-324, 0.0, 255.0),
        (4, "size = [1, 1, @]", below_length, 1e-100, 1e100),
        (6, "ambient = [@, 0, 0]", -5e-324, 0.0, 1e30),
        (7, "diffuse = [0, @, 0]", -5e-324, 0.0, 1e30),
        (8, "specular = [0, 0, @]", -5e-324, 0.0, 1e30),
        (9, "shininess = @", -5e-324, 0.0, 1e6),
        (13, "color = [0, 0, @]", -5e-324, 0.0, 1e30),
        (14, "intensity = @", -5e-324, 0.0, 1e30),
        (14, "intensity = 1\ngain = @", -5e-324, 0.0, 1e30),
        (15, "position = [@, 2, 3]", beyond(-1e100), -1e100, 1e100),
        (18, "position = [1, 2, @]", beyond(-1e100), -1e100, 1e100),
        (19, "target = [@, 2, 3]", beyond(-1e100), -1e100, 1e100),
        (20, "fov = @", 0.0, 5e-324, 179.0),
        (20, "fov = 30\nnear = @", below_length, 1e-100, 1e100),
        (
            20,
            "fov = 30\nup = [@, 1, 0]",
            beyond(-1e100),
            -1e100,
            1e100,
        ),
        (21, "height = @", below_length, 1e-100, 1e100),
    ];
    for (line, key, below, low, high) in keys {
        let text = |number: f64| with_line(line, &key.replace('@', &format!("{number:e}")));
        assert_accepted(&text(low));
        assert_accepted(&text(high));
        assert!(complaint(&text(below)).contains(", expected a number "));
        assert!(complaint(&text(beyond(high))).contains(", expected a number "));
    }
    let angles = "rotation = [1.7976931348623157e308, -1e300, 5e-324]";
    assert_accepted(&with_line(4, &format!("{angles}\nsize = [1, 1, 1]")));
    let place = "position = [@, 1, 0]\nsize = [1, 1, 1]";
    assert_accepted(&with_line(4, &place.replace('@', "-1e100")));
    assert_complaint(
        &with_line(4, &place.replace('@', "1.1e100")),
        "4:13",
        &["`cuboid.position`"],
    );
}

#[test]
fn up_is_parallel_to_the_view_if_the_sine_between_them_is_below_1e_9() {
    // Along z the sine is the distance of `up` from the axis.
    let along_z = |across: &str| {
        let up = format!("position = [0, 0, 8]\nup = [{across}, 0, 1]");
        with_line(18, &up)
    };
    assert_complaint(&along_z("0.999e-9"), "19:6", &["nor parallel"]);
    assert_accepted(&along_z("1.001e-9"));
    // Overflow or underflow does not make vectors parallel.
    assert_accepted(&with_line(18, "position = [0, 0, 8]\nup = [5e-324, 0, 0]"));
    assert_accepted(&with_line(
        18,
        "position = [1e100, 0, 1e100]\nup = [0, 1e100, 0]",
    ));
}

#[test]
fn a_target_nearer_than_the_shortest_length_is_refused() {
    let at = |x: &str| with_line(18, &format!("position = [{x}, 0, 0]"));
    assert_accepted(&at("1e-100"));
    assert_complaint(&at("0.999e-100"), "19:10", &["at least 1e-100 away"]);
}

#[test]
fn the_line_is_shown_with_carets_below_the_mistake() {
    let shown = |text: &str| complaint(text).split_once('\n').unwrap().1.to_owned();
    assert_eq!(
        complaint(&with_line(4, "size = [-4.0, 3.0, 2.0]")),
        "bad.toml:4:9: `cuboid.size`: invalid value: -4.0, expected a number from 1e-100 to 1e100\n\
         \x20 |\n\
         4 | size = [-4.0, 3.0, 2.0]\n\
         \x20 |         ^^^^"
    );
    // A tab, a letter of two bytes and a line end of two bytes count as one column or none.
    assert_eq!(
        shown(&with_line(12, "\tkind\t=\t'é'\r")),
        "   |\n12 |  kind = 'é'\n   |         ^^^"
    );
    assert_eq!(
        shown(&with_line(4, "size = [1,\n1]")),
        "  |\n4 | size = [1,\n  |        ^^^"
    );
    let message = complaint(&with_line(4, "size = \r"));
    assert!(message.contains("values must be quoted"), "{message}");
    assert_eq!(shown(""), "  |\n1 | \n  | ^");
    assert_eq!(shown("\u{feff}a = 1"), "  |\n1 | a = 1\n  | ^");
}

#[test]
fn a_long_line_is_shown_around_the_mistake_and_a_long_value_is_cut() {
    let space = " ".repeat(1000);
    let text = with_line(9, &format!("shininess {space}= -1{space}"));
    assert_complaint(&text, "9:1013", &["value: -1.0,"]);
    let complaint_text = complaint(&text);
    let lines: Vec<&str> = complaint_text.lines().collect();
    assert_eq!(
        lines[2].chars().count(),
        "9 | ".len() + 100 + "……".chars().count()
    );
    let carets = lines[3].find('^').unwrap();
    let above: String = lines[2].chars().skip(carets).collect();
    assert!(above.starts_with("-1 "), "{complaint_text}");
    assert!(lines[3].ends_with(" ^^"), "{complaint_text}");

    let value = with_line(9, &format!("shininess = [{}]", "1, ".repeat(100_000)));
    assert!(complaint(&value).len() < 500, "{}", complaint(&value));
}

#[test]
fn no_text_of_the_file_moves_the_cursor() {
    let text = with_line(11, "name = \"\u{1b}[31mred\u{7}\"");
    assert_complaint(&text, "11:9", &["\u{fffd}[31mred\u{fffd}"]);
    let kept = |character: char| character == '\n' || !character.is_control();
    assert!(complaint(&text).chars().all(kept));
}

#[test]
fn unlimited_nesting_is_refused() {
    let nested = format!("background = {}", "[".repeat(100_000));
    assert_complaint(&nested, "1:94", &["max recursion depth"]);
    // Dots in a comment and in a string are not parts of a key.
    let dots = "a.".repeat(100);
    let dotted = format!("# {dots}\nx = \"{dots}\"\n{dots}x = 1\ny = 2\n");
    assert_complaint(&dotted, "1:1", &["recursion limit"]);
    let dotted = format!("# one\n{}x = 1\n", "a.".repeat(100_000));
    assert_complaint(&dotted, "1:1", &["recursion limit"]);
}

/// Pieces for damaging a scene at random.
const PIECES: [&str; 16] = [
    "",
    "\n",
    "[",
    "]",
    "[[cuboid]]\n",
    "[light]\n",
    "=",
    "\"",
    "nan",
    "-",
    "1e999",
    ".",
    "é",
    "\u{0}",
    "\r",
    "0x",
];

proptest! {
    #[test]
    fn any_text_is_a_scene_or_one_message(text in any::<String>()) {
        assert_scene_or_message(&text);
    }

    #[test]
    fn any_damaged_scene_is_a_scene_or_one_message(
        scene in 0..BUILT_IN.len(),
        damages in prop::collection::vec((any::<prop::sample::Index>(), 0..40_usize, 0..PIECES.len()), 1..4),
    ) {
        let mut characters: Vec<char> = BUILT_IN[scene].1.chars().collect();
        for (at, length, piece) in damages {
            let start = at.index(characters.len() + 1);
            let end = (start + length).min(characters.len());
            characters.splice(start..end, PIECES[piece].chars());
        }
        assert_scene_or_message(&characters.into_iter().collect::<String>());
    }
}

fn assert_scene_or_message(text: &str) {
    let Err(error) = Scene::parse("file", text) else {
        return;
    };
    let message = error.to_string();
    let SceneError::Invalid {
        line,
        column,
        excerpt,
        ..
    } = error
    else {
        panic!("{message}");
    };
    assert!(
        message.starts_with(&format!("file:{line}:{column}: ")),
        "{message}"
    );
    let content = text.split('\n').nth(line - 1).expect("the line exists");
    assert!(column <= content.chars().count() + 1, "{message}");
    assert_eq!(excerpt.lines().count(), 3, "{message}");
}
