//! Everything in sight: the key for it, what is added, the outline of what is selected, and the terms of the model.

use egui::{Key, Modifiers};
use glam::DVec3;
use shadetrade::components::{LightKind, Orbit, ShadingMode, View, ViewMode};
use shadetrade::scene::unseen::shows_all;
use shadetrade::scene::{LightRecord, SceneRecord};
use shadetrade::systems::frame::Keep;
use shadetrade::window::inspector::Tab;
use shadetrade::window::pictures::QUARTERS;

use super::{SIZE, Window, changed, choose, default_record, widgets_of};
use crate::support::scene::draw;
use crate::support::window::default_scene;

/// The picture of this window would cut the cuboid off on the left and on the right.
const NARROW: [usize; 2] = [300, 1500];

/// Whether the picture on screen shows all cuboids.
fn shows(window: &Window) -> bool {
    let world = &window.app.document.scene.world;
    shows_all(world, &window.app.view())
}

#[test]
fn a_narrow_picture_shows_everything_and_leaves_the_scene_as_it_is() {
    let scene = default_record();
    let mut window = Window::open();
    let camera = window.app.view().camera;
    window.size = NARROW;
    (0..2).for_each(|_| window.step(Vec::new()));
    assert!(shows(&window));
    assert_ne!(window.app.view().camera, camera);
    assert_eq!(window.record(), scene);
    window.size = SIZE;
    (0..2).for_each(|_| window.step(Vec::new()));
    assert_eq!(window.app.view().camera, camera);
    let saved = |window: &mut Window| {
        window.press_with(Modifiers::COMMAND, Key::S);
        let path = window.folder.path().join("cuboid.toml");
        std::fs::read_to_string(path).expect("a file")
    };
    assert_eq!(saved(&mut window), saved(&mut Window::open()));
    // A window that opens narrow, too. The camera moves in it without a jump.
    let mut window = Window::of(default_scene(), NARROW);
    assert!(shows(&window));
    assert_eq!(window.record(), scene);
    let fit = window.app.canvas.fit;
    for _ in 0..20 {
        window.press(Key::Plus);
        assert_eq!(window.app.canvas.fit, fit);
    }
    assert!(!shows(&window));
}

#[test]
fn a_narrow_picture_explains_the_place_that_a_wide_one_does() {
    let places = [SIZE, NARROW].map(|size| {
        let scene = changed(|record| record.view.pixel = Some([0.1, -0.05]));
        let mut window = Window::of(scene, size);
        let probe = window.app.probed().expect("it is explained");
        let surface = probe.surface.as_ref().expect("a cuboid");
        let place = surface.sample.as_ref().expect("it is shaded").position;
        // A click on the pixel explains the same one.
        let pixel = window.app.pixel();
        let at = window.app.canvas.place_of(pixel.expect("it is seen"));
        window.press(Key::Escape);
        window.press(Key::Escape);
        window.click(at);
        assert_eq!(window.app.pixel(), pixel);
        place
    });
    assert!((places[0] - places[1]).length() < 0.04, "{places:?}");
}

#[test]
fn the_facts_of_a_narrow_window_are_those_of_its_picture() {
    let mut window = Window::of(default_scene(), NARROW);
    window.press(Key::F5);
    let exact = window.comparison().exact.clone();
    let mut world = window.record().spawn();
    let view = window.app.view().shaded(ShadingMode::Phong);
    let drawn = draw(&mut world, &view.with_tolerance(0.0), Keep::Display);
    let differ = |(one, other): &(&u32, &u32)| one != other;
    let differ = exact.iter().zip(drawn.pixels()).filter(differ).count();
    // Rounding to bytes may differ.
    assert!(differ < exact.len() / 50, "{differ} of {}", exact.len());
}

#[test]
fn home_steps_back_until_all_is_in_sight_and_no_further() {
    // Too near for a picture of any width.
    let mut window = Window::of(changed(|record| record.camera[0].fov = 15.0), SIZE);
    assert!(!shows(&window));
    window.press(Key::ArrowLeft);
    window.press(Key::Home);
    assert!(shows(&window));
    let orbit = window.record().camera[0].orbit;
    assert!(orbit.azimuth == 0.0 && orbit.zoom > 1.0, "{orbit:?}");
    window.press(Key::Home);
    assert_eq!(window.record().camera[0].orbit, orbit);
    window.press(Key::Plus);
    assert!(!shows(&window), "one step closer it is cut");
    window.press(Key::G);
    window.press(Key::Home);
    assert_eq!(window.record().camera[0].orbit, orbit);
    // A narrow window fits what is shown, and the camera stays.
    let mut window = Window::of(default_scene(), NARROW);
    window.press(Key::ArrowLeft);
    window.press(Key::Home);
    assert!(shows(&window));
    assert_eq!(window.record().camera[0].orbit, Orbit::default());
}

#[test]
fn what_is_added_is_in_sight() {
    // The picture is not narrow, so its camera alone shows it.
    let mut harness = widgets_of([1900, 600]);
    harness.state_mut().desk.tabs = vec![Tab::Scene];
    harness.run_ok();
    choose(&mut harness, "copy");
    let app = harness.state();
    let world = &app.document.scene.world;
    let record = SceneRecord::of(world);
    assert_eq!(record.cuboid.len(), 2);
    assert_eq!(app.desk.selected, Some(("cuboid", 1)));
    assert!(shows_all(world, &View::of(world, app.canvas.size())));
    // Beside each other, not within each other.
    let [one, other] = [&record.cuboid[0], &record.cuboid[1]];
    let apart = (other.position - one.position).x;
    let least = (one.size + other.size).x / 2.0;
    assert!(apart >= least, "{apart}");
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
    let record = window.record();
    assert!(record.light.iter().all(|it| it.on), "all are on again");
    for (quarter, kind) in QUARTERS.into_iter().enumerate() {
        let mut record = record.clone();
        let is_own = |it: &LightRecord| kind.is_none_or(|kind| it.kind == kind);
        record.light.retain(is_own);
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
    assert_eq!(record.view.show, ViewMode::Terms);
}
