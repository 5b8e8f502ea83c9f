//! Everything in sight: the key for it, what is added, the outline of what is selected, and the terms of the model.

use egui::Key;
use egui_kittest::kittest::Queryable;
use fearless_simd::Level;
use glam::DVec3;
use shadetrade::components::{LightKind, View, ViewMode};
use shadetrade::scene::unseen::shows_all;
use shadetrade::scene::{Scene, SceneRecord};
use shadetrade::systems::frame::Keep;
use shadetrade::window::inspector::Tab;
use shadetrade::window::pictures::QUARTERS;

use super::Window;
use crate::support::scene::draw;
use crate::support::window::{app, default_scene, widgets};

const NARROW: [usize; 2] = [420, 600];

/// A window that is so narrow that the cuboid is cut on the left and on the right after the camera was moved back.
fn narrow() -> Window {
    let mut window = Window::of(default_scene(), NARROW);
    let first = SceneRecord::of(&default_scene().world);
    window.app.document.restore(&first);
    window.step(Vec::new());
    assert!(!shows(&window));
    window
}

fn shows(window: &Window) -> bool {
    let world = &window.app.document.scene.world;
    shows_all(world, &View::of(world, window.app.canvas.size()))
}

#[test]
fn home_steps_back_until_all_is_in_sight_and_no_further() {
    let mut window = narrow();
    window.press(Key::ArrowLeft);
    window.press(Key::Home);
    assert!(shows(&window));
    let orbit = window.record().camera[0].orbit;
    assert!(orbit.azimuth == 0.0 && orbit.zoom > 1.0, "{orbit:?}");
    window.press(Key::Home);
    assert_eq!(window.record().camera[0].orbit, orbit);
    assert!(window.message().contains("reset"));
    window.press(Key::Plus);
    assert!(!shows(&window), "one step closer it is cut");
    window.press(Key::G);
    window.press(Key::Home);
    assert_eq!(window.record().camera[0].orbit, orbit);
}

#[test]
fn a_narrow_picture_opens_with_all_in_sight_unless_the_camera_was_placed() {
    let window = Window::of(default_scene(), NARROW);
    assert!(shows(&window));
    assert!(window.record().camera[0].orbit.zoom > 1.0);
    assert!(!window.app.document.is_edited());
    let wide = Window::of(default_scene(), [1240, 600]);
    assert_eq!(wide.record(), SceneRecord::of(&default_scene().world));
    let mut resized = wide;
    resized.size = NARROW;
    resized.step(Vec::new());
    resized.step(Vec::new());
    assert!(shows(&resized));
    // A saved place is explained where it was.
    let mut record = SceneRecord::of(&default_scene().world);
    record.view.pixel = Some([0.1, 0.1]);
    let placed = Window::of(Scene::spawn("placed".to_owned(), &record), NARROW);
    assert_eq!(placed.record().camera[0].orbit.zoom, 1.0);
}

#[test]
fn what_is_added_is_in_sight() {
    for button in ["copy", "new cuboid"] {
        let mut harness = widgets(app(default_scene(), [1240, 600], Level::new()), [1240, 600]);
        harness.state_mut().desk.tab = Some(Tab::Scene);
        harness.run_ok();
        harness.get_by_label(button).click();
        harness.run_ok();
        let app = harness.state();
        let world = &app.document.scene.world;
        let record = SceneRecord::of(world);
        assert_eq!(record.cuboid.len(), 2, "{button}");
        assert_eq!(app.desk.selected, Some(("cuboid", 1)));
        assert!(shows_all(world, &View::of(world, app.canvas.size())));
        // Beside each other, not within each other.
        let [one, other] = [&record.cuboid[0], &record.cuboid[1]];
        let apart = (other.position - one.position).x;
        assert!(
            apart >= (one.size + other.size).x / 2.0,
            "{button}: {apart}"
        );
    }
}

#[test]
fn a_picture_of_nothing_says_why() {
    let mut window = Window::open();
    let mut record = window.record();
    record.cuboid[0].position = DVec3::new(0.0, 1e6, 0.0);
    window.app.document.restore(&record);
    window.step(Vec::new());
    window.step(Vec::new());
    let seen = window.seen();
    let words = seen.iter().filter(|pixel| **pixel >> 16 & 0xff > 200);
    assert!(words.count() > 100, "red letters over the background");
    assert_eq!(window.app.canvas.pictures.frame.counts().covered_pixels, 0);
}

#[test]
fn quarters_are_the_pictures_by_one_kind_of_lights() {
    let mut window = Window::open();
    window.press(Key::F7);
    let shown = window.app.shown().into_owned();
    let [width, height] = window.app.canvas.size();
    let size = [width.div_ceil(2), height.div_ceil(2)];
    let lights = |window: &Window| {
        window
            .record()
            .light
            .iter()
            .map(|it| it.on)
            .collect::<Vec<_>>()
    };
    assert_eq!(lights(&window), [true; 4], "all are on again");
    for (quarter, kind) in QUARTERS.into_iter().enumerate() {
        let mut record = window.record();
        record
            .light
            .retain(|it| kind.is_none_or(|kind| it.kind == kind));
        let mut world = record.spawn();
        let view = View::of(&world, size);
        let drawn = draw(&mut world, &view, Keep::Display);
        for (index, pixel) in drawn.pixels().iter().enumerate() {
            let x = quarter % 2 * size[0] + index % size[0];
            let y = quarter / 2 * size[1] + index / size[0];
            if x < width && y < height {
                assert_eq!(shown[y * width + x], *pixel, "{kind:?} at {x}, {y}");
            }
        }
    }
    assert_eq!(QUARTERS[3], None);
    assert!(QUARTERS.contains(&Some(LightKind::Specular)));
    assert_eq!(window.record().view.show, ViewMode::Terms);
}
