//! Saving a record into the text of its file: it is read again unchanged, and the rest of the text stays.

use proptest::prelude::*;
use shadetrade::scene::{BUILT_IN, updated};

use super::{LEAST, MOST, random};
use crate::support::cases::config;
use crate::support::prelude::*;

fn read(text: &str) -> SceneRecord {
    let scene = Scene::parse("text", text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    SceneRecord::of(&scene.world)
}

/// The text after `change` was made to its record. It must be read again as the changed record.
fn edited(text: &str, change: impl FnOnce(&mut SceneRecord)) -> String {
    let mut record = read(text);
    change(&mut record);
    let text = updated(text, &record);
    assert_eq!(read(&text), record, "{text}");
    text
}

/// Texts in unusual notations, and all built-in scenes.
fn texts() -> Vec<&'static str> {
    let texts = BUILT_IN.iter().map(|(_, text)| *text);
    texts.chain([LEAST, MOST, LOOKED_AT, ARRAYS]).collect()
}

/// Comments everywhere, mixed order, explicit defaults.
const LOOKED_AT: &str = r#"# The head.

[view]  # How it is looked at.
camera = "front"  # the first
projection = "perspective"
sides = ["picture",
    "phong-4", # a side
]
divider = 0.25 # left

# A camera.
[[camera]]
name = "front" # its name
position = [0, 0, 8]
target = [0, 0, 0]
fov = 30
height = 6
orbit.zoom = 0.5 # close

# A cuboid.
[[cuboid]]
name = "a" # its name
size = [
    1, # across
    2, # up
    3, # along
]
material = { ambient = [1, 1, 1], diffuse = [0, 0, 0], specular = [0, 0, 0], shininess = 1 }
# Before the second camera.
[[camera]]
name = "side"
position = [8, 0, 0]
target = [0, 0, 0]
fov = 30
height = 6
# The end.
"#;

/// Tables as arrays of their values.
const ARRAYS: &str = r#"
cuboid = [["a", [1, 2, 3], [0, 0, 0], [0, 0, 0], "phong", "face", 4, [[1, 1, 1], [0, 0, 0], [0, 0, 0], 1]]]
[[camera]]
name = "front"
position = [0, 0, 8]
target = [0, 0, 0]
fov = 30
height = 6
orbit = [0, 0, 2]
"#;

#[test]
fn an_unchanged_text_stays_byte_for_byte() {
    for text in texts() {
        assert_eq!(updated(text, &read(text)), text);
    }
}

/// Changes a record: adds, removes or replaces an entity or its name, or the view.
fn change(record: &mut SceneRecord, random: &mut Random) {
    let [cuboids, lights, cameras] = [record.cuboid.len(), record.light.len(), record.camera.len()];
    match random.below(13) {
        0 => record.cuboid.push(random::cuboid(random)),
        1 => record.light.push(random::light(random)),
        2 => record.camera.push(random::camera(random)),
        3 if cuboids > 1 => drop(record.cuboid.remove(random.below(cuboids))),
        4 if lights > 0 => drop(record.light.remove(random.below(lights))),
        5 if cameras > 1 => drop(record.camera.remove(random.below(cameras))),
        6 => record.cuboid[random.below(cuboids)] = random::cuboid(random),
        7 if lights > 0 => record.light[random.below(lights)].name = random::name(random),
        8 => record.camera[random.below(cameras)].name = random::name(random),
        9 => (record.light).insert(random.below(lights + 1), random::light(random)),
        10 => (record.cuboid).insert(random.below(cuboids), random::cuboid(random)),
        11 => record.view = random::view(random),
        _ => record.light.reverse(),
    }
}

proptest! {
    #![proptest_config(config(64))]

    #[test]
    fn a_changed_record_is_read_again(text in 0..texts().len(), seed: u64) {
        let mut text = texts()[text].to_owned();
        let mut random = Random(seed);
        for _ in 0..2 {
            let mut record = read(&text);
            for _ in 0..=random.below(3) {
                change(&mut record, &mut random);
            }
            let mut record = random::with_own_names(record);
            record.view.camera = record.camera.get(1).map(|camera| camera.name.clone());
            text = updated(&text, &record);
            prop_assert_eq!(&read(&text), &record, "{}", text);
        }
    }

    #[test]
    fn any_record_can_be_saved_into_any_text(text in 0..texts().len(), record in random::record()) {
        for text in [texts()[text], "", "[[cuboid]", "cuboid = 3"] {
            let text = updated(text, &record);
            prop_assert_eq!(&read(&text), &record, "{}", text);
        }
    }
}

/// The lines of `after` that are not in `before`, and the lines of `before` that are not in `after`.
fn differing<'a>(before: &'a str, after: &'a str) -> [Vec<&'a str>; 2] {
    let without = |text: &'a str, other: &str| {
        let is_new = |line: &&str| !other.lines().any(|it| it == *line);
        text.lines().filter(is_new).collect()
    };
    [without(before, after), without(after, before)]
}

#[test]
fn a_table_inserted_before_all_others_of_its_kind_is_read_before_them() {
    // In this text cameras stand before and after the cuboid.
    let first = records::cuboid("first", [1.0; 3], [0.0; 3]);
    edited(LOOKED_AT, |record| record.cuboid.insert(0, first));
}

#[test]
fn one_number_changes_one_line_and_its_comment_stays() {
    let (_, text) = BUILT_IN[0];
    let after = edited(text, |record| record.light[0].gain = 1e30);
    let old = "gain = 17.32                    # levels per unit of intensity (optional: 1)";
    let new = old.replace("17.32", "1e30");
    assert_eq!(differing(text, &after), [[old], [&*new]]);
    let after = edited(LOOKED_AT, |record| record.cuboid[0].size.y = 2.5);
    assert_eq!(
        differing(LOOKED_AT, &after),
        [["    2, # up"], ["    2.5, # up"]]
    );
}

#[test]
fn whole_numbers_of_more_than_64_bits_are_written_as_floats_and_comments_stay() {
    let written = [
        "9223372036854775808 # 64 bits",
        "0x8000000000000001",
        "-1_000_000_000_000_000_000_000",
        "100000000000000000000",
    ];
    let [one, two, three, changed] = written;
    let text = LOOKED_AT.replace("divider = 0.25 # left", "# no divider");
    let text = text.replace("[8, 0, 0]", &format!("[\n{one}\n, {two}, {three}]"));
    let text = format!(
        "{text}[[light]]\nname = \"18446744073709551616\" # its name\nkind = \"ambient\"\ncolor = [1, 1, 1]\nintensity = {changed} # bright\n"
    );
    let mut floats = text
        .replace("9223372036854775808 #", "9.223372036854776e18 #")
        .replace(two, "9.223372036854776e18")
        .replace(three, "-1e21");
    let after = edited(&text, |record| record.light[0].intensity = 7.0);
    assert_eq!(after, floats.replace(changed, "7.0"));
    let after = edited(&text, |record| record.light[0].on = false);
    floats = floats.replace(changed, "1e20");
    assert_eq!(after, format!("{floats}on = false\n"));
}

#[test]
fn a_budget_takes_the_place_of_a_tolerance_and_the_other_way_round() {
    let text = LOOKED_AT.replace("divider = 0.25", "tolerance = 0.5");
    let held = edited(&text, |record| record.view.budget = Some(2.0));
    let is_held = held.contains("budget = 2.0") && !held.contains("tolerance");
    assert!(is_held, "{held}");
    let back = edited(&held, |record| {
        (record.view.budget, record.view.tolerance) = (None, 2.0);
    });
    let is_back = back.contains("tolerance = 2.0") && !back.contains("budget");
    assert!(is_back, "{back}");
}

#[test]
fn explicit_defaults_stay_and_implicit_ones_are_not_added() {
    let (_, text) = BUILT_IN[0];
    let there = edited(text, |record| {
        record.cuboid[0].shading = ShadingMode::Phong;
        record.light[1].on = false;
        record.camera[1].orbit.zoom = 0.5;
    });
    assert_eq!(differing(text, &there)[1].len(), 3);
    let back = edited(&there, |record| *record = read(text));
    assert!(back.contains("shading = \"gouraud\"  "), "{back}");
    // The keys of the light and of the camera are explicit now.
    assert_eq!(differing(text, &back)[1].len(), 2, "{back}");
    assert!(!updated("", &read(text)).contains("orbit"));
}

#[test]
fn a_view_is_added_only_if_it_differs_from_the_default() {
    type Change = fn(&mut SceneRecord);
    let text = &text_without_view();
    let orthographic: Change = |record| record.view.projection = Projection::Orthographic;
    let second: Change = |record| record.view.camera = Some("2".to_owned());
    let several: Change = |record| {
        record.view.show = ViewMode::Wipe;
        record.view.pixel = Some([0.25, -0.5]);
    };
    for (change, expected) in [
        (orthographic, "projection = \"orthographic\""),
        (second, "camera = \"2\""),
        (several, "show = \"wipe\"\npixel = [0.25, -0.5]"),
    ] {
        let after = edited(text, change);
        let expected = format!("{}\n\n[view]\n{expected}\n", text.trim_end());
        assert_eq!(after, expected);
    }
    let there = edited(LOOKED_AT, |record| record.view.pixel = Some([1.5, 2.5]));
    let gone = edited(&there, |record| record.view.pixel = None);
    assert_eq!(gone, LOOKED_AT);
}

#[test]
fn the_camera_named_in_the_view_follows_renaming_and_removal() {
    type Change = fn(&mut SceneRecord);
    let renamed: Change = |record| record.camera[0].name = "a".to_owned();
    let other: Change = |record| record.view.camera = Some("side".to_owned());
    let gone: Change = |record| drop(record.camera.remove(0));
    for (change, name) in [(renamed, "a"), (other, "side"), (gone, "side")] {
        let after = edited(LOOKED_AT, change);
        let line = format!("camera = \"{name}\"  # the first");
        assert!(after.contains(&line), "{after}");
        // A renamed table keeps its comments.
        let is_kept = name != "side" || after.contains("front");
        assert_eq!(after.contains("# close"), is_kept);
    }
}

#[test]
fn added_tables_come_last_of_their_kind_and_removed_ones_take_their_comments_along() {
    let (_, text) = BUILT_IN[0];
    let added = edited(text, |record| {
        let light = records::light("new", LightKind::Ambient, 5.0, [0.0; 3]);
        record.light.push(light);
    });
    let words = ["name = \"ambient\"", "name = \"new\"", "\n[[camera]]"];
    assert!(words.map(|word| added.find(word)).is_sorted(), "{added}");
    assert_eq!(edited(&added, |record| drop(record.light.pop())), text);

    let less = edited(LOOKED_AT, |record| drop(record.camera.remove(0)));
    let [lost, _] = differing(LOOKED_AT, &less).map(|lines| lines.join("\n"));
    assert!(
        ["# A camera.", "# close"]
            .iter()
            .all(|it| lost.contains(it))
    );
    for comment in [
        "# The head.",
        "# A cuboid.",
        "# across",
        "# Before",
        "# The end.",
    ] {
        assert!(!lost.contains(comment), "{comment} {less}");
    }
}

#[test]
fn line_ends_stay_as_they_were() {
    let after = edited(&LOOKED_AT.replace('\n', "\r\n"), |record| {
        record.camera[0].fov = 31.0;
    });
    let expected = LOOKED_AT.replacen("fov = 30\n", "fov = 31.0\n", 1);
    assert_eq!(after, expected.replace('\n', "\r\n"));
}
