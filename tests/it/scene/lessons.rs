//! Lessons: their steps, and a place for each mistake.

use std::path::Path;

use shadetrade::components::{ShadingMode, ViewMode};
use shadetrade::scene::{Control, LESSONS, Scene, SceneRecord};

fn read(text: &str) -> anyhow::Result<Scene> {
    Scene::parse_lesson("a.toml", text, Path::new(""))
}

/// The message about a lesson without steps.
const NO_STEP: &str = "expected one or more tables, each headed `[[step]]`";

#[test]
fn every_built_in_lesson_opens_at_its_first_step_and_each_step_changes_something() {
    for (name, _) in LESSONS {
        let scene = Scene::load(Some(name)).expect("a lesson");
        assert_eq!(scene.name, *name);
        let own = name.strip_prefix("lessons/").expect("a name");
        let same = Scene::load_lesson(Path::new(own)).expect("a lesson");
        assert_eq!(same.lesson.len(), scene.lesson.len());
        let steps = &scene.lesson;
        assert_eq!(SceneRecord::of(&scene.world), *steps[0].record);
        // Nothing has been edited yet.
        let saved = Scene::parse(name, &scene.text).expect("a scene");
        assert_eq!(SceneRecord::of(&saved.world), *steps[0].record);
        assert!(
            steps.windows(2).all(|it| it[0].record != it[1].record),
            "{name}"
        );
        assert!(steps.iter().all(|step| !step.say.is_empty()));
    }
}

#[test]
fn steps_are_applied_one_after_another() {
    let scene = read(
        r#"scene = "bench-far"
[[step]]
say = "one"
set = { view.show = "tiles", light.white.on = false }
[[step]]
say = "two"
[step.set]
cuboid.emerald.shading = "phong"
view."show" = "error"
"#,
    );
    let steps = scene.expect("a lesson").lesson;
    let [one, two] = &*steps else {
        panic!("two steps");
    };
    assert_eq!((&*one.say, &*two.say), ("one", "two"));
    assert_eq!(one.record.view.show, ViewMode::Tiles);
    assert_eq!(two.record.view.show, ViewMode::Error);
    assert!(!one.record.light[0].on && !two.record.light[0].on);
    assert_ne!(one.record.cuboid[0].shading, ShadingMode::Phong);
    assert_eq!(two.record.cuboid[0].shading, ShadingMode::Phong);
}

#[test]
fn a_step_may_ask_a_question_and_show_controls() {
    let scene = read(
        "scene = 'cuboid'
[[step]]
say = 'Where?'
show = ['segments', 'row']
ask = ['here', 'there', 'nowhere']
right = 3
then = 'Nowhere.'
[[step]]
say = 'So.'
",
    );
    let steps = scene.expect("a lesson").lesson;
    assert_eq!(steps[0].show, [Control::Segments, Control::Row]);
    let question = steps[0].question.as_ref().expect("a question");
    assert_eq!(question.answers[question.right], "nowhere");
    assert_eq!(question.then, "Nowhere.");
    assert!(steps[1].question.is_none() && steps[1].show.is_empty());
}

#[test]
fn a_mistake_has_its_place() {
    let long = "x".repeat(201);
    for (steps, place, words) in [
        (
            "[[step]]\nsay = 'a'\nset.light.withe.on = true",
            "4:22",
            "light has white",
        ),
        (
            "[[step]]\nsay = 'a'\nset = { light.white.on = 3 }",
            "4:26",
            "a boolean",
        ),
        (
            "[[step]]\nsay = 'a'\nset = { camera.1.target = [7, 5, 8] }",
            "4:7",
            "camera.target",
        ),
        (
            "[[step]]\nsay = 'a'\n[[step]]\nsay = 'b'\nset.light.withe.on = true",
            "6:22",
            "light has white",
        ),
        ("[[step]]\nset = {}", "2:1", "say"),
        ("[[step]]\nsay = 'a'\nwords = 1", "4:1", "words"),
        ("[step]\nsay = 'a'", "2:1", "[[step]]"),
        ("", "1:1", NO_STEP),
        ("step = []", "2:8", NO_STEP),
        (
            "[[step]]\nsay = 'a'\nshow = ['segments', 'colour']",
            "4:21",
            "`segments`",
        ),
        (
            "[[step]]\nsay = 'a'\nask = ['b', 'c']\nright = 3\nthen = 'd'",
            "5:9",
            "from 1 to 2",
        ),
        (
            "[[step]]\nsay = 'a'\nask = ['b', 'c']\nright = 0",
            "5:9",
            "from 1 to 2",
        ),
        (
            "[[step]]\nsay = 'a'\nask = ['b', 'c']\nthen = 'd'",
            "2:1",
            "`right`, expected the number",
        ),
        (
            "[[step]]\nsay = 'a'\nask = ['b', 'c']\nright = 1",
            "2:1",
            "`then`, expected the sentence",
        ),
        (
            "[[step]]\nsay = 'a'\nask = ['b']\nright = 1\nthen = 'd'",
            "4:7",
            "two or more answers",
        ),
        (
            "[[step]]\nsay = 'a'\nright = 1",
            "2:1",
            "two or more answers",
        ),
        (
            &format!("[[step]]\nsay = 'a'\nask = ['b', '{long}']"),
            "4:7",
            "at most 200",
        ),
        (&format!("[[step]]\nsay = '{long}'"), "3:7", "at most 200"),
    ] {
        let text = format!("scene = \"cuboid\"\n{steps}");
        let error = read(&text).map(drop).expect_err(steps).to_string();
        let is_right = error.starts_with(&format!("a.toml:{place}: ")) && error.contains(words);
        assert!(is_right, "{steps}: {error}");
    }
    let beside = "scene = \"bench-far.toml\"\n[[step]]\nsay = 'a'";
    let beside = Scene::parse_lesson("a.toml", beside, Path::new("assets/scenes"));
    assert!(beside.is_ok(), "{:?}", beside.err());
    let longest = format!("scene = \"cuboid\"\n[[step]]\nsay = '{}'", &long[1..]);
    assert_eq!(read(&longest).expect("200 letters").lesson.len(), 1);
    let error = read("scene = \"none.toml\"\nstep = []").map(drop);
    let error = error.expect_err("there is none").to_string();
    assert!(
        error.starts_with("a.toml:1:9: ") && error.contains("none.toml"),
        "{error}"
    );
}
