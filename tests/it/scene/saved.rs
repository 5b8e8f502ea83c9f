//! A record is saved into the text that it came from: it is read again as it was, and all else stays.

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::Index;
use shadetrade::components::{LightKind, Projection, ShadingMode, Tab, ViewMode};
use shadetrade::scene::{
    BUILT_IN, CameraRecord, CuboidRecord, LightRecord, Scene, SceneRecord, ViewRecord, updated,
};

use super::{LEAST, MOST, random};

fn read(text: &str) -> SceneRecord {
    let scene = Scene::parse("text", text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    SceneRecord::of(&scene.world)
}

/// The text once `change` has been made to what it says; it is read again as that.
fn edited(text: &str, change: impl FnOnce(&mut SceneRecord)) -> String {
    let mut record = read(text);
    change(&mut record);
    let text = updated(text, &record);
    assert_eq!(read(&text), record, "{text}");
    text
}

/// Texts that say something in an unusual way, and all built-in ones.
fn texts() -> Vec<&'static str> {
    let texts = BUILT_IN.iter().map(|(_, text)| *text);
    texts.chain([LEAST, MOST, LOOKED_AT]).collect()
}

/// Comments everywhere, no order, defaults said.
const LOOKED_AT: &str = r#"# The head.

[view]  # How it is looked at.
camera = "front"  # the first
projection = "perspective"
sides = ["picture",
    "phong-4", # a side
]
magnifier = { scale = 2, corner = [3, 4] } # large

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

#[test]
fn what_has_not_changed_is_not_touched() {
    for text in texts() {
        assert_eq!(updated(text, &read(text)), text);
    }
}

/// One change to a record: which, where, and to what.
#[derive(Clone, Debug)]
struct Change {
    what: usize,
    at: Index,
    parts: (CuboidRecord, LightRecord, CameraRecord),
    view: ViewRecord,
}

fn change() -> impl Strategy<Value = Change> {
    let parts = (random::cuboid(), random::light(), random::camera());
    (0..12_usize, any::<Index>(), parts, random::view()).prop_map(|(what, at, parts, view)| {
        Change {
            what,
            at,
            parts,
            view,
        }
    })
}

impl Change {
    fn apply(&self, record: &mut SceneRecord) {
        let (cuboid, light, camera) = self.parts.clone();
        let [cuboids, lights, cameras] =
            [record.cuboid.len(), record.light.len(), record.camera.len()];
        match self.what {
            0 => record.cuboid.push(cuboid),
            1 => record.light.push(light),
            2 => record.camera.push(camera),
            3 if cuboids > 1 => drop(record.cuboid.remove(self.at.index(cuboids))),
            4 if lights > 0 => drop(record.light.remove(self.at.index(lights))),
            5 if cameras > 1 => drop(record.camera.remove(self.at.index(cameras))),
            6 => record.cuboid[self.at.index(cuboids)] = cuboid,
            7 if lights > 0 => record.light[self.at.index(lights)].name = light.name,
            8 => record.camera[self.at.index(cameras)].name = camera.name,
            9 => record.light.insert(self.at.index(lights + 1), light),
            10 => record.view = self.view.clone(),
            _ => record.light.reverse(),
        }
    }
}

proptest! {
    #[test]
    fn whatever_is_changed_is_read_again(text in 0..texts().len(), changes in vec(vec(change(), 1..4), 1..3)) {
        let mut text = texts()[text].to_owned();
        for changes in changes {
            let mut record = read(&text);
            changes.iter().for_each(|change| change.apply(&mut record));
            let mut record = random::with_own_names(record);
            record.view.camera = record.camera.get(1).map(|camera| camera.name.clone());
            prop_assume!(record.check().is_ok());
            text = updated(&text, &record);
            prop_assert_eq!(&read(&text), &record, "{}", text);
        }
    }

    #[test]
    fn any_record_is_saved_into_any_text(text in 0..texts().len(), record in random::record()) {
        for text in [texts()[text], ""] {
            let text = updated(text, &record);
            prop_assert_eq!(&read(&text), &record, "{}", text);
        }
    }
}

/// The lines of `after` that are not in `before`, and the other way round.
fn differing<'a>(before: &'a str, after: &'a str) -> [Vec<&'a str>; 2] {
    let without = |text: &'a str, other: &str| {
        let lines = text.lines();
        lines
            .filter(|line| !other.lines().any(|it| it == *line))
            .collect()
    };
    [without(before, after), without(after, before)]
}

#[test]
fn one_number_is_one_line_and_its_comment_stays() {
    let (_, text) = BUILT_IN[0];
    let after = edited(text, |record| record.light[0].gain = 1e100_f64.min(1e30));
    assert_eq!(
        differing(text, &after),
        [
            vec!["gain = 17.32                    # levels per unit of intensity (optional: 1)"],
            vec!["gain = 1e30                    # levels per unit of intensity (optional: 1)"]
        ]
    );
    let after = edited(LOOKED_AT, |record| record.cuboid[0].size.y = 2.5);
    assert_eq!(
        differing(LOOKED_AT, &after),
        [vec!["    2, # up"], vec!["    2.5, # up"]]
    );
}

#[test]
fn a_default_that_is_said_stays_said_and_one_that_is_not_stays_unsaid() {
    let (_, text) = BUILT_IN[0];
    let there = edited(text, |record| {
        record.cuboid[0].shading = ShadingMode::Phong;
        record.light[1].on = false;
        record.camera[1].orbit.zoom = 0.5;
    });
    assert_eq!(differing(text, &there)[1].len(), 3);
    let back = edited(&there, |record| *record = read(text));
    let line = "shading = \"gouraud\"             # or \"phong\" (optional: \"gouraud\")";
    assert!(back.contains(line), "{back}");
    // The light's and the camera's keys are said now.
    assert_eq!(differing(text, &back)[1].len(), 2, "{back}");
    assert!(!updated("", &read(text)).contains("orbit"));
}

#[test]
fn a_view_is_added_only_where_it_is_not_the_usual_one() {
    let (_, text) = BUILT_IN[0];
    let view = |change: fn(&mut SceneRecord)| {
        let after = edited(text, change);
        let view = after.split_once("[view]").expect("it has one").1;
        assert!(after.starts_with(text.trim_end()), "{after}");
        view.trim().to_owned()
    };
    assert_eq!(
        view(|record| record.view.projection = Projection::Orthographic),
        "projection = \"orthographic\""
    );
    assert_eq!(
        view(|record| record.view.camera = Some("2".to_owned())),
        "camera = \"2\""
    );
    let all = view(|record| {
        record.view.show = ViewMode::Wipe;
        record.view.turned = 90;
        record.view.pixel = Some([3, 4]);
        record.view.inspector = Some(Tab::Proof);
        record.view.magnifier.scale = 8;
    });
    assert_eq!(
        all,
        "show = \"wipe\"\nturned = 90\npixel = [3, 4]\nmagnifier = { scale = 8, corner = [0, 0] }\ninspector = \"proof\""
    );
    let gone = edited(LOOKED_AT, |record| record.view.pixel = Some([1, 2]));
    let gone = edited(&gone, |record| record.view.pixel = None);
    assert_eq!(gone, LOOKED_AT);
}

#[test]
fn a_camera_that_is_named_in_the_view_is_followed() {
    let renamed = edited(LOOKED_AT, |record| record.camera[0].name = "a".to_owned());
    assert!(renamed.contains("camera = \"a\"  # the first"), "{renamed}");
    let other = edited(LOOKED_AT, |record| {
        record.view.camera = Some("side".to_owned());
    });
    assert!(other.contains("camera = \"side\"  # the first"), "{other}");
    let gone = edited(LOOKED_AT, |record| drop(record.camera.remove(0)));
    assert!(gone.contains("camera = \"side\"  # the first"), "{gone}");
}

#[test]
fn what_is_added_comes_last_of_its_kind_and_what_is_removed_takes_its_comments_along() {
    let (_, text) = BUILT_IN[0];
    let added = edited(text, |record| {
        let light = LightRecord::new("new", LightKind::Ambient, 5.0, [0.0; 3]);
        record.light.push(light);
    });
    let place = |word: &str| {
        added
            .find(word)
            .unwrap_or_else(|| panic!("{word}: {added}"))
    };
    assert!(place("name = \"ambient\"") < place("name = \"new\""));
    assert!(place("name = \"new\"") < place("\n[[camera]]"));
    assert_eq!(edited(&added, |record| drop(record.light.pop())), text);

    let less = edited(LOOKED_AT, |record| drop(record.camera.remove(0)));
    let comments = ["# A camera.", "# its name", "# close"];
    let lost = differing(LOOKED_AT, &less)[0].join("\n");
    assert!(
        comments.iter().all(|comment| lost.contains(comment)),
        "{less}"
    );
    for comment in [
        "# The head.",
        "# A cuboid.",
        "# across",
        "# Before",
        "# The end.",
    ] {
        assert!(less.contains(comment), "{comment} {less}");
    }
}

#[test]
fn lines_end_as_they_did() {
    let text = LOOKED_AT.replace('\n', "\r\n");
    let after = edited(&text, |record| record.camera[0].fov = 31.0);
    assert_eq!(
        after,
        text.replace(
            "fov = 30\r\nheight = 6\r\norbit",
            "fov = 31.0\r\nheight = 6\r\norbit"
        )
    );
}

#[test]
fn a_text_that_is_no_scene_is_replaced() {
    let record = read(LEAST);
    for text in ["", "# nothing", "[[cuboid]", "cuboid = 3"] {
        assert_eq!(read(&updated(text, &record)), record);
    }
}
