//! Keys: any number or setting of a scene is read, written, named and explained by its key.

use proptest::prelude::*;
use shadetrade::questions::vary::variable::Variable;
use shadetrade::scene::key::{Key, assignment, differences, set};

use super::{LEAST, random};
use crate::support::cases::config;
use crate::support::prelude::*;
use crate::support::window::default_scene;

fn default_record() -> SceneRecord {
    SceneRecord::of(&default_scene().world)
}

#[test]
fn a_value_is_written_read_and_told_from_all_others() {
    for text in [
        "background.b=7",
        "cuboid.emerald.size.x=7.5",
        "cuboid.emerald.material.ambient.g=0.25",
        "cuboid.emerald.material.shininess=100000000000000000000e-20",
        "cuboid.emerald.shading=phong",
        "light.white.name=\"key light\"",
        "light.white.on=false",
        "light.red.position.z=-1e3",
        "light.red.position.x=100000000000000000000",
        "camera.2.orbit.zoom=2",
        "camera.1.near = 0.25",
        "view.tolerance=1.5",
        "view.projection=orthographic",
        "view.sides.right=reference",
        "view.turned=30",
        "view.budget=2",
        "view.camera=\"2\"",
    ] {
        let (key, value) = assignment(text).expect("an assignment");
        let record = set(&default_record(), &[(key.clone(), value.clone())]).expect(text);
        let found = differences(&default_record(), &record);
        if key.last() == "name" {
            // One entity is new, and one is gone.
            assert_eq!(found, ["light.\"key light\"", "light.white"].map(Key::from));
            continue;
        }
        assert_eq!(found, std::slice::from_ref(&key), "{text}");
        let read = key.read(&record).expect(text).expect("a value");
        let number = |it: &toml::Value| it.as_float().or(it.as_integer().map(|it| it as f64));
        let is_read = read == value || number(&read) == number(&value);
        assert!(is_read, "{text}: {read}");
    }
    let left_out = Key::from("camera.1.near").read(&default_record());
    assert_eq!(left_out.expect("a key"), None);
}

#[test]
fn a_quoted_name_may_hold_what_ends_an_unquoted_one() {
    for name in ["a=b", "a..b", "it's = \"q\"", "=", "a.b=1..2"] {
        let mut record = default_record();
        record.light[0].name = name.to_owned();
        let key = Key::from("light").child(name).child("intensity");
        let literal = (!name.contains('\'')).then(|| format!("light.'{name}'.intensity"));
        for text in literal.into_iter().chain([key.to_string()]) {
            let (found, value) = assignment(&format!("{text}=7")).expect("an assignment");
            let changed = set(&record, &[(found, value)]).expect(&text);
            assert_eq!(changed.light[0].intensity, 7.0, "{text}");
            let variable = Variable::parse(&format!("{text} = 1..7"), &record).expect(&text);
            let found = (variable.key, variable.from, variable.to);
            assert_eq!(found, (key.clone(), 1.0, 7.0));
        }
    }
}

/// A wrong assignment, and words of the message.
const REFUSED: &str = r#"
ligth.white.on=true               ¦ background, cuboid, light, camera, view
light.withe.on=true               ¦ light has white, red, specular, ambient
light.white.intensty=1            ¦ name, kind, color, intensity, gain, position, on
light.white.color.x=1             ¦ light.white.color has r, g, b
light."a=b".on=true               ¦ no key light."a=b".on; light has
light."".on=true                  ¦ no key light."".on; light has
light."white.on=true              ¦ light has white
cuboid.emerald.size.w=1           ¦ cuboid.emerald.size has x, y, z
camera.1.fov.x=1                  ¦ camera.1.fov
camera.1.neer=1                   ¦ near
light.white.intensity=-1          ¦ `light.white.intensity`: invalid value: -1.0, expected a number from 0.0 to 1e30
light.white.intensity=nan         ¦ NaN
light.white.on=1                  ¦ expected a boolean
light.white.kind=diffus           ¦ `diffuse`
light.white.name=red              ¦ `light[1].name`:
light.ambient.position=[1, 2, 3]  ¦ everywhere
camera.1.target=[7.0, 5.0, 8.0]   ¦ `camera[0].target`:
view.turned=1.5                   ¦ a whole number
light.white=3                     ¦ expected a table"#;

#[test]
fn a_wrong_key_says_which_there_are_and_a_wrong_value_what_is_legal() {
    for row in REFUSED.lines().skip(1) {
        let (text, words) = row.split_once('¦').expect("words");
        let assignment = assignment(text.trim()).expect("an assignment");
        let error = set(&default_record(), &[assignment]).expect_err(row);
        assert!(error.to_string().contains(words.trim()), "{text}: {error}");
    }
    assert!(assignment("light.white.on").is_err());
}

#[test]
fn values_that_belong_together_are_checked_together() {
    let values = ["camera.1.target=[7, 5, 8]", "camera.1.position=[0, 0, 0]"];
    let values = values.map(|text| assignment(text).expect("an assignment"));
    let record = set(&default_record(), &values).expect("a legal scene");
    assert_eq!(record.camera[0].target.to_array(), [7.0, 5.0, 8.0]);
    assert!(set(&default_record(), &values[..1]).is_err());
    let both = ["view.tolerance=1.5", "view.budget=2"];
    let both = both.map(|text| assignment(text).expect("an assignment"));
    assert!(set(&default_record(), &both).is_err());
}

/// All keys of a record that have one value, made from its JSON.
fn keys(record: &SceneRecord) -> Vec<Key> {
    fn walk(key: Key, value: &serde_json::Value, keys: &mut Vec<Key>) {
        match value {
            serde_json::Value::Object(table) => {
                (table.iter()).for_each(|(name, value)| walk(key.child(name), value, keys));
            }
            serde_json::Value::Array(all) if all.iter().all(serde_json::Value::is_object) => {
                for value in all {
                    let name = value["name"].as_str().expect("a name");
                    walk(key.child(name), value, keys);
                }
            }
            _ => keys.push(key),
        }
    }
    let mut keys = Vec::new();
    walk(Key::default(), &serde_json::json!(record), &mut keys);
    keys
}

#[test]
fn every_key_is_explained_in_its_own_table_and_has_its_legal_values() {
    let record = default_record();
    for key in keys(&record) {
        let comment = key.comment().unwrap_or_default();
        assert!(!comment.is_empty(), "{key}");
    }
    let comment = |key: &str| Key::from(key).comment().expect("a comment");
    assert!(comment("cuboid.emerald.position.x").contains("centre"));
    assert!(comment("light.white.position").contains("ambient"));
    assert!(!comment("camera.1.position").contains("centre"));
    assert!(comment("camera.1.near").contains("cut off"));
    for (key, legal) in [
        ("light.white.gain", "a number from 0.0 to 1e30"),
        ("light.white.position", "a number from -1e100 to 1e100"),
        ("camera.1.fov", "a number above 0, at most 179.0"),
        ("light.white.position.x", "a number from -1e100 to 1e100"),
        ("view.turned", "a whole number from 0 to 359"),
    ] {
        let number = Key::from(key).number().expect(key);
        assert_eq!(number.words(), legal, "{key}");
    }
    for key in ["light.white.on", "cuboid.emerald.shading", "view.sides"] {
        assert!(Key::from(key).number().is_none(), "{key}");
    }
}

#[test]
fn an_entity_that_is_new_or_gone_is_one_difference() {
    let mut record = default_record();
    record.light.remove(1);
    record.camera.reverse();
    let found = differences(&default_record(), &record);
    assert_eq!(found, [Key::from("light.red")], "order is no value");
    let scene = Scene::parse("least", LEAST).expect("a scene");
    let least = SceneRecord::of(&scene.world);
    assert_eq!(differences(&least, &least), []);
}

proptest! {
    #![proptest_config(config(64))]

    #[test]
    fn a_key_is_read_as_it_is_written(seed: u64) {
        let name = random::name(&mut Random(seed));
        let key = Key::from("light").child(&name).child("on");
        prop_assert_eq!(Key::from(&*key.to_string()), key, "{:?}", name);
    }

    #[test]
    fn every_value_can_be_written_again(record in random::record()) {
        for key in keys(&record) {
            let mut same = record.clone();
            if let Some(value) = key.read(&record).expect("a key") {
                key.write(&mut same, value).map_err(|error| TestCaseError::fail(error.to_string()))?;
            }
            prop_assert_eq!(&same, &record, "{}", key);
        }
    }
}
