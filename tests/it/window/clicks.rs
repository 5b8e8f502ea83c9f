//! Clicks whose press and release come in one step, as those of a touchpad or in a slow frame.

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::Node;
use egui_kittest::kittest::Queryable;
use shadetrade::scene::{Scene, SceneRecord};

use super::{PAUSE, SIZE, Window};
use crate::support::window::{default_scene, widgets};

/// The roles of widgets that are clicked.
const CLICKED: [Role; 8] = [
    Role::Button,
    Role::CheckBox,
    Role::ColorWell,
    Role::ComboBox,
    Role::RadioButton,
    Role::Slider,
    Role::SpinButton,
    Role::TextInput,
];

/// The events of a press and a release at a place.
fn events(window: &Window, at: Pos2) -> Vec<Event> {
    let button = |pressed| Event::PointerButton {
        pos: at,
        button: PointerButton::Primary,
        pressed,
        modifiers: window.modifiers,
    };
    vec![Event::PointerMoved(at), button(true), button(false)]
}

/// Presses and releases the button in one step. The mouse arrives in it, too.
fn tap(window: &mut Window, at: Pos2) {
    window.step(events(window, at));
}

/// The default scene, so small that it is drawn and proven at once.
fn far_scene() -> Scene {
    let mut record = SceneRecord::of(&default_scene().world);
    record.camera.iter_mut().for_each(|it| it.orbit.zoom = 20.0);
    Scene::spawn("cuboid".to_owned(), &record)
}

/// Shows the scene anew and clicks. Returns the scene, its pixels, and the files that were written.
fn after(
    window: &mut Window,
    keys: &[Key],
    at: Pos2,
    click: fn(&mut Window, Pos2),
) -> (SceneRecord, Vec<u32>, Vec<String>) {
    // Leaves fields and lists.
    window.press(Key::Escape);
    window.press(Key::Escape);
    window.reopen(far_scene());
    for key in keys {
        window.press(*key);
    }
    click(window, at);
    // Away from it, so that no tooltip is left.
    window.point_at(Pos2::new(1.0, 1.0));
    window.wait(PAUSE);
    let (mut pixels, files) = (window.app.pixels.clone(), window.files());
    if !files.is_empty() {
        // They name the folder, which is random.
        pixels.clear();
    }
    (window.record(), pixels, files)
}

#[test]
fn a_click_within_one_step_does_what_a_slow_one_does() {
    // What egui remembers, such as folded rows, changes in both.
    let [mut slow, mut quick] = [(); 2].map(|()| Window::of(far_scene(), SIZE));
    for keys in [&[Key::E][..], &[Key::F3]] {
        let mut shown = Window::of(far_scene(), SIZE);
        for key in keys {
            shown.press(*key);
        }
        shown.wait(PAUSE);
        let harness = widgets(shown.app, SIZE);
        let clicked = harness.query_all_by(|node| CLICKED.contains(&node.role()));
        // The handle of a slider is in its middle.
        let inside = |node: Node| node.rect().lerp_inside([0.2, 0.5]);
        let mut places: Vec<Pos2> = clicked.map(inside).collect();
        let picture = harness.state().canvas.place;
        // The cuboid, and the divider of a wipe.
        places.extend([picture.center(), picture.center() + vec2(0.0, 60.0)]);
        places.retain(|at| at.y < SIZE[1] as f32);
        for at in places {
            let slow = after(&mut slow, keys, at, Window::click);
            let quick = after(&mut quick, keys, at, tap);
            assert_eq!((slow.0, slow.2), (quick.0, quick.2), "{keys:?} {at}");
            // Some pixels of a letter can depend on the letters that were drawn before.
            let pixels = slow.1.iter().zip(&quick.1).enumerate();
            // The words around it may name the folder of a new file, which is random.
            let pixels = pixels.filter(|(index, _)| {
                let [x, y] = [index % SIZE[0], index / SIZE[0]];
                picture.contains(Pos2::new(x as f32, y as f32))
            });
            let differ = pixels.filter(|(_, (slow, quick))| slow != quick).count();
            assert!(differ < 50, "{keys:?} {at}: {differ} pixels");
        }
    }
}

/// A window that shows the numbers of the scene and its file.
fn editor() -> Window {
    let mut window = Window::open();
    window.press(Key::E);
    window.step(Vec::new());
    window
}

#[test]
fn a_text_is_selected_and_copied_in_steps_with_clicks() {
    let harness = widgets(editor().app, SIZE);
    let mut window = editor();
    let fields = harness.get_all_by_role(Role::TextInput);
    let field = fields.last().expect("the name of the cuboid").rect();
    let [first, last] = [0.02, 0.98].map(|share| field.lerp_inside([share, 0.5]));
    window.click(first);
    window.wait(PAUSE);
    window.modifiers = Modifiers::SHIFT;
    tap(&mut window, last);
    window.modifiers = Modifiers::NONE;
    let click = events(&window, Pos2::new(1.0, 1.0));
    window.step([vec![Event::Copy], click].concat());
    assert_eq!(window.output.copied.as_deref(), Some("emerald"));
}

#[test]
fn a_choice_of_a_list_is_clicked_within_a_step() {
    let mut harness = widgets(editor().app, SIZE);
    let list = harness.get_by_label("other scenes").rect().center();
    harness.hover_at(list);
    harness.drag_at(list);
    harness.drop_at(list);
    harness.run_ok();
    let choice = harness.get_by_label("bench-far").rect().center();
    for click in [Window::click, tap] {
        let mut window = editor();
        for at in [list, choice] {
            click(&mut window, at);
            window.wait(PAUSE);
        }
        assert_eq!(window.app.document.scene.name, "bench-far");
    }
}
