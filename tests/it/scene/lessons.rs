//! Lessons: their steps, and a place for each mistake.

use std::path::Path;

use shadetrade::scene::{Control, LESSONS};

use crate::support::prelude::*;

fn read(text: &str) -> anyhow::Result<Scene> {
    Scene::parse_lesson("a.toml", text, Path::new(""))
}

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
        let mut pairs = steps.windows(2);
        assert!(pairs.all(|it| it[0].record != it[1].record), "{name}");
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

/// The lines of a lesson after its first (`⏎` breaks a line), the place of the mistake, and words of the message.
const MISTAKES: &str = r"
STEP⏎set.light.withe.on = true                   ¦ 4:22 ¦ light has white
STEP⏎set = { light.white.on = 3 }                ¦ 4:26 ¦ a boolean
STEP⏎set = { camera.1.target = [7, 5, 8] }       ¦ 4:7  ¦ camera[0].target
STEP⏎STEP⏎set.light.withe.on = true              ¦ 6:22 ¦ light has white
[[step]]⏎set = {}                                ¦ 2:1  ¦ say
STEP⏎words = 1                                   ¦ 4:1  ¦ words
[step]⏎say = 'a'                                 ¦ 2:1  ¦ [[step]]
                                                 ¦ 1:1  ¦ expected one or more tables, each headed `[[step]]`
step = []                                        ¦ 2:8  ¦ expected one or more tables, each headed `[[step]]`
STEP⏎show = ['segments', 'colour']               ¦ 4:21 ¦ `segments`
STEP⏎ask = ['b', 'c']⏎right = 3⏎then = 'd'       ¦ 4:7  ¦ from 1 on
STEP⏎ask = ['b', 'c']⏎right = 0⏎then = 'd'       ¦ 4:7  ¦ from 1 on
STEP⏎ask = ['b', 'c']⏎then = 'd'                 ¦ 4:7  ¦ `right`
STEP⏎ask = ['b', 'c']⏎right = 1                  ¦ 4:7  ¦ `then`
STEP⏎ask = ['b']⏎right = 1⏎then = 'd'            ¦ 4:7  ¦ two or more answers
STEP⏎right = 1                                   ¦ 2:1  ¦ two or more answers
STEP⏎ask = ['b', 'LONG']                         ¦ 4:7  ¦ at most 200
[[step]]⏎say = 'LONG'                            ¦ 3:7  ¦ at most 200";

#[test]
fn a_mistake_has_its_place() {
    let long = "x".repeat(201);
    for row in MISTAKES.lines().skip(1) {
        let cells: Vec<&str> = row.split('¦').map(str::trim).collect();
        let steps = cells[0].replace("STEP", "[[step]]⏎say = 'a'");
        let steps = steps.replace("LONG", &long).replace('⏎', "\n");
        let text = format!("scene = \"cuboid\"\n{steps}");
        let error = read(&text).map(drop).expect_err(row).to_string();
        let is_there = error.starts_with(&format!("a.toml:{}: ", cells[1]));
        assert!(is_there && error.contains(cells[2]), "{row}: {error}");
    }
    let beside = "scene = \"bench-far.toml\"\n[[step]]\nsay = 'a'";
    let beside = Scene::parse_lesson("a.toml", beside, Path::new("assets/scenes"));
    assert!(beside.is_ok(), "{:?}", beside.err());
    let longest = format!("scene = \"cuboid\"\n[[step]]\nsay = '{}'", &long[1..]);
    assert_eq!(read(&longest).expect("200 letters").lesson.len(), 1);
    let error = read("scene = \"none.toml\"\nstep = []").map(drop);
    let error = error.expect_err("there is none").to_string();
    let is_there = error.starts_with("a.toml:1:9: ");
    assert!(is_there && error.contains("none.toml"), "{error}");
}
