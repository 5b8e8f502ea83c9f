//! Drags: whatever the mouse does to a number, the scene stays legal and nothing is refused.

use egui::accesskit::Role;
use egui::{Key, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use fearless_simd::Level;
use serde_json::{Value, json};
use shadetrade::scene::SceneRecord;
use shadetrade::window::app::App;
use shadetrade::window::inspector::Tab;

use super::widgets::number;
use super::{default_record, drag, press, widgets_of};
use crate::support::window::{app, default_scene, widgets};

const SIZE: [usize; 2] = [1400, 1000];

/// The default scene with every optional number.
fn record() -> SceneRecord {
    let mut record = default_record();
    record.camera.iter_mut().for_each(|it| it.near = Some(0.1));
    record.view.pixel = Some([-0.1, 0.05]);
    record
}

/// Reads a record as the editor does.
fn read(scene: &Value) -> anyhow::Result<SceneRecord> {
    Ok(SceneRecord::from_tree(toml::Value::try_from(scene)?)?)
}

/// The positions of the numbers in sight.
fn handles(harness: &Harness<App>) -> Vec<Pos2> {
    let all = harness.query_all_by(|node| node.role() == Role::SpinButton);
    all.map(|node| node.rect().center()).collect()
}

#[test]
fn no_drag_makes_an_illegal_number() {
    let mut scene = default_scene();
    scene.world = record().spawn();
    let mut harness = widgets(app(scene, SIZE, Level::new()), SIZE);
    press(&mut harness, Key::E);
    let mut count = 0;
    for (tab, entity, budget) in [
        (Tab::Scene, "cuboid", None),
        (Tab::Scene, "light", None),
        (Tab::Scene, "camera", None),
        (Tab::Pixel, "cuboid", Some(1.0)),
        (Tab::Vary, "cuboid", None),
    ] {
        let reset = |harness: &mut Harness<App>| {
            let mut record = record();
            record.view.budget = budget;
            let app = harness.state_mut();
            app.desk.tabs = vec![tab];
            app.document.restore(&record);
            app.desk.selected = Some((entity, 0));
            app.desk.message = None;
            harness.run_ok();
        };
        reset(&mut harness);
        for index in 0..handles(&harness).len() {
            for way in [1.0, -1.0] {
                reset(&mut harness);
                let from = handles(&harness)[index];
                harness.hover_at(from);
                harness.drag_at(from);
                harness.run_ok();
                // There in two steps, and a little back.
                for right in [200.0, 9000.0, 8900.0] {
                    harness.hover_at(from + vec2(right, 0.0) * way);
                    harness.run_ok();
                    let app = harness.state();
                    let now = SceneRecord::of(&app.document.scene.world);
                    now.check().expect("names and numbers go together");
                    read(&json!(now)).expect("each number is within its range");
                    assert_eq!(app.desk.message, None, "{entity}, number {index}");
                }
                harness.drop_at(from);
                harness.run_ok();
                count += 1;
            }
        }
    }
    assert!(count > 100, "{count}");
}

#[test]
fn a_drag_beyond_the_end_of_a_range_reaches_the_end() {
    let mut harness = widgets_of(SIZE);
    press(&mut harness, Key::E);
    harness.state_mut().desk.selected = Some(("light", 0));
    harness.run_ok();
    let from = number(&harness, "intensity", 0);
    drag(&mut harness, &[from, from - vec2(9000.0, 0.0)]);
    let now = SceneRecord::of(&harness.state().document.scene.world);
    assert_eq!(now.light[0].intensity, 0.0);
}
