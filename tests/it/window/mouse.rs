//! Clicks, drags and the wheel over the picture, and their effect on it.

use egui::{Key, Modifiers, Pos2, vec2};
use shadetrade::components::{Light, LightKind, ShadingMode, Transform};
use shadetrade::scene::Scene;
use shadetrade::systems::frame::display_step;
use shadetrade::window::inspector::Tab;
use shadetrade::window::lights::{Lamp, drag_light, lamps};

use super::{PAUSE, SIZE, Window, changed};
use crate::support::records;

/// A window on the default scene with a light at this height above the cuboid; one at 2 is in sight.
fn with_light_at(height: f64) -> Window {
    let light = records::light("near", LightKind::Diffuse, 50.0, [0.0, height, 1.0]);
    Window::of(changed(|record| record.light.push(light)), SIZE)
}

/// The discs of the lights in sight.
fn discs(window: &Window) -> Vec<Lamp> {
    let app = &window.app;
    let mut discs = lamps(&app.document.scene.world, &app.view(), &app.canvas);
    discs.retain(|lamp| lamp.way.is_none());
    discs
}

fn place_of(window: &Window, name: &str) -> Pos2 {
    let discs = discs(window);
    let disc = discs.iter().find(|disc| disc.names == [name]);
    disc.expect("a disc").at
}

#[test]
fn each_notch_of_the_wheel_is_a_step_and_the_same_number_back_undoes_them_bit_for_bit() {
    let mut window = Window::open();
    let at = window.app.canvas.place.center();
    let start = (window.record(), window.seen());
    for notches in [1.0_f32, 7.0, -3.0] {
        let factor = 1.1_f64.powf(-f64::from(notches));
        // One by one there, and at once back; and the other way.
        let single = vec![notches.signum(); notches.abs() as usize];
        let back = single.iter().map(|notch| -notch).collect();
        for (there, back) in [(single, vec![-notches]), (vec![notches], back)] {
            for notch in there {
                window.wheel(at, notch);
            }
            let zoom = window.record().camera[0].orbit.zoom;
            assert!((zoom / factor - 1.0).abs() < 1e-12, "{zoom}");
            for notch in back {
                window.wheel(at, notch);
            }
            assert!((window.record(), window.seen()) == start, "{notches}");
        }
    }
    window.wheel(Pos2::new(40.0, 300.0), 3.0);
    assert_eq!(window.record(), start.0, "over the panel");
}

#[test]
fn a_click_hits_the_pixel_under_the_mouse_at_every_size_of_text_and_scale_of_the_display() {
    for (zooms, scale) in [(0, 1.0), (2, 1.0), (0, 2.0), (2, 1.5)] {
        let mut window = Window::open();
        window.app.scale = scale;
        for _ in 0..zooms {
            window.press_with(Modifiers::COMMAND, Key::Plus);
        }
        window.wait(PAUSE);
        let canvas = &window.app.canvas;
        let corner = canvas.place.min * canvas.scale;
        assert_eq!(canvas.scale > 1.0, zooms > 0 || scale > 1.0);
        window.click(corner + vec2(50.5, 70.5));
        assert_eq!(window.app.pixel(), Some([50, 70]), "{zooms}, {scale}");
    }
}

#[test]
fn a_click_selects_in_the_scenes_tab() {
    let mut window = with_light_at(2.0);
    window.press(Key::E);
    window.step(Vec::new());
    window.click(place_of(&window, "near"));
    let selected = |window: &Window| window.app.desk.selected;
    assert_eq!(selected(&window), Some(("light", 4)));
    window.click(window.app.canvas.place.center());
    assert_eq!(selected(&window), Some(("cuboid", 0)));
    assert!(window.app.desk.is_open(Tab::Scene));
    // A pixel of the same row, which is probed already.
    window.click(place_of(&window, "near"));
    window.click(window.app.canvas.place.center() + vec2(8.0, 0.0));
    window.step(Vec::new());
    assert_eq!(selected(&window), Some(("cuboid", 0)));
    // The pixel is probed again after a change; what is selected stays.
    window.click(place_of(&window, "near"));
    window.press(Key::G);
    window.step(Vec::new());
    assert_eq!(selected(&window), Some(("light", 4)));
}

#[test]
fn a_drag_turns_the_camera_equally_far_in_one_step_or_many() {
    let mut turned = Vec::new();
    for steps in [1, 10] {
        let mut window = Window::open();
        let at = window.app.canvas.place.center();
        window.drag(at, at + vec2(100.0, 50.0), steps);
        let orbit = window.record().camera[0].orbit;
        assert!(orbit.azimuth < 0.0 && orbit.elevation > 0.0);
        assert_eq!(window.message(), "", "no limit was reached");
        window.point_at(at);
        assert_eq!(window.record().camera[0].orbit, orbit, "the button is up");
        turned.push([orbit.azimuth, orbit.elevation]);
    }
    for axis in 0..2 {
        let difference = turned[0][axis] - turned[1][axis];
        assert!(difference.abs() < 1e-3, "{turned:?}");
    }
}

#[test]
fn only_lights_in_sight_have_discs() {
    // Those of the default scene are behind the eye, and the fourth is everywhere.
    let names = |height| {
        let discs = discs(&with_light_at(height)).into_iter();
        discs.flat_map(|disc| disc.names).collect::<Vec<_>>()
    };
    assert_eq!(names(2.0), ["near"]);
    assert_eq!(names(9.0), [""; 0], "it is above the picture");
}

#[test]
fn a_dragged_light_follows_the_mouse_and_has_short_numbers() {
    for steps in [1, 3, 300] {
        let mut window = with_light_at(2.0);
        window.size = [1300, 200];
        window.press(Key::E);
        window.step(Vec::new());
        let (from, by) = (place_of(&window, "near"), vec2(60.0, 40.0));
        // A drag begins after a few pixels.
        window.point_at(from);
        window.button(from, true);
        for step in 0..=steps {
            let share = step as f32 / steps as f32;
            window.point_at(from + vec2(10.0, 0.0) * (1.0 - share) + by * share);
        }
        window.button(from + by, false);
        let missed = place_of(&window, "near").distance(from + by);
        assert!(missed < 3.0, "{missed} pixels in {steps} steps");
        let position = window.record().light[4].position.expect("a place");
        for number in position.to_array() {
            assert!(format!("{number}").len() <= 6, "{position:?}");
        }
    }
}

#[test]
fn the_divider_is_dragged_within_the_picture_and_each_side_shows_its_method() {
    let mut window = Window::open();
    window.press(Key::F3);
    let [width, height] = window.app.canvas.size();
    // These rows are covered by no text and no mark.
    let lower = width * (height * 4 / 5)..width * (height * 4 / 5 + 25);
    let sides = [ShadingMode::Gouraud, ShadingMode::Phong]
        .map(|mode| window.drawn(|view| view.shaded(mode))[lower.clone()].to_vec());
    assert_ne!(sides[0], sides[1]);
    let mut x = window.app.canvas.place.center().x;
    for share in [0.3, 0.7, -1.0, 2.0] {
        let y = window.app.canvas.place.max.y - 30.0;
        let to = window.app.canvas.place.min.x + width as f32 * share;
        window.point_at(Pos2::new(x, y));
        let orbit = window.record().camera[0].orbit;
        window.drag(Pos2::new(x, y), Pos2::new(to, y), 3);
        assert_eq!(window.record().camera[0].orbit, orbit, "the camera rests");
        let divider = window.app.viewer().divider;
        let wanted = f64::from(share.clamp(0.02, 0.98));
        assert!((divider - wanted).abs() < 0.01, "{divider}");
        let column = (divider * width as f64).round() as usize;
        x = window.app.canvas.place.min.x + column as f32;
        let seen = window.seen()[lower.clone()].to_vec();
        for (index, pixel) in seen.iter().enumerate() {
            let own = index % width;
            // The line of the divider covers a few columns.
            if own.abs_diff(column) > 3 {
                assert_eq!(*pixel, sides[usize::from(own >= column)][index]);
            }
        }
    }
}

#[test]
fn the_rotation_follows_the_clock_and_stops_where_it_is_switched_off() {
    let mut window = Window::open();
    let still = window.seen();
    window.press(Key::Space);
    for _ in 0..10 {
        let (before, spin) = (window.now, window.app.viewer().turned);
        window.wait(PAUSE / 20);
        let degrees = window.app.viewer().turned - spin;
        let expected = window.now.saturating_sub(before).as_millis() / 30;
        assert!(u128::from(degrees).abs_diff(expected) <= 1, "{degrees}");
        assert!(window.output.repaint_after.as_millis() <= 30);
    }
    assert_ne!(window.seen(), still);
    window.press(Key::Space);
    let turned = window.record().view.turned;
    assert!(turned > 0);
    window.wait(PAUSE);
    assert_eq!(window.record().view.turned, turned);
    window.press(Key::Home);
    assert_eq!(window.seen(), still);
}

#[test]
fn a_light_dragged_beyond_the_range_of_positions_stays() {
    let mut window = with_light_at(2.0);
    let far = 9.99e99;
    let world = &mut window.app.document.scene.world;
    let lights = world.query_mut::<&mut Transform>().with::<&Light>();
    lights.into_iter().for_each(|place| place.position.x = far);
    window.step(Vec::new());
    for _ in 0..50 {
        let view = window.app.view();
        let world = &mut window.app.document.scene.world;
        drag_light(world, &view, "near", vec2(1e6, 0.0));
    }
    window.step(Vec::new());
    window.record().check().expect("a legal scene");
    let text = shadetrade::scene::updated("", &window.record());
    Scene::parse("dragged", &text).unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn a_click_probes_the_pixel_under_the_mouse_and_the_method_that_is_shown_there() {
    let mut window = Window::open();
    window.press(Key::F3);
    let mode = |window: &Window| {
        let probe = window.app.probed().expect("an answer");
        probe.surface.as_ref().map(|surface| surface.mode)
    };
    for (share, shown) in [(-0.1, ShadingMode::Gouraud), (0.1, ShadingMode::Phong)] {
        let place = window.app.canvas.place;
        let at = place.center() + vec2(share * place.width(), 10.0);
        window.click(at);
        let [x, y] = [at.x - place.min.x, at.y - place.min.y].map(|it| it as usize);
        assert_eq!(window.app.pixel(), Some([x, y]));
        assert!(window.app.desk.is_open(Tab::Pixel));
        assert_eq!(mode(&window), Some(shown));
        let surface = window.app.probed().and_then(|it| it.surface.clone());
        let [width, _] = window.app.canvas.size();
        let [_, bytes @ ..] = window.app.shown()[y * width + x].to_be_bytes();
        let levels = surface.expect("a cuboid").drawn;
        assert_eq!(levels.map(display_step), bytes);
    }
    // The divider goes past the pixel.
    let place = window.app.canvas.place;
    window.drag(place.center(), place.right_center() - vec2(20.0, 0.0), 3);
    assert_eq!(mode(&window), Some(ShadingMode::Gouraud));
    window.press(Key::F2);
    window.click(window.app.canvas.place.min + vec2(3.0, 3.0));
    assert_eq!(mode(&window), None, "background");
}
