//! What the mouse does with what lies around and over the picture, and that all of it can be clicked.

use std::time::Duration;

use minifb::Key;
use shadetrade::canvas::Point;
use shadetrade::components::ShadingMode;
use shadetrade::window::bindings::{Action, BINDINGS, Modifiers, Section};
use shadetrade::window::hud::{Hud, Part};
use shadetrade::window::input::{Event, Gesture, Input};
use shadetrade::window::response::respond;
use shadetrade::window::session::{Redraw, Request, Session};
use shadetrade::window::views::ViewMode;

use super::hud::{board, hud, pixels, place_of};
use super::{SIZE, default_session, does};

fn click(session: &mut Session, point: Point) -> Option<Action> {
    does(session, Gesture::Click(point))
}

/// Everything about a session that a command can change.
fn state(session: &mut Session) -> String {
    session.tick(Duration::from_millis(300));
    let lights: Vec<_> = (0..4)
        .map(|index| session.light(index).map(|light| light.on))
        .collect();
    let turned = session.spin().degrees;
    let requests = session.take_requests();
    let (view, state) = (session.view(SIZE), &session.state);
    format!("{:?}", (view, lights, state, turned, requests))
}

#[test]
fn a_click_on_a_key_in_the_help_does_what_the_key_does() {
    let lights = default_session().scene.lights.len();
    for binding in BINDINGS {
        if matches!(binding.action, Action::Light(index) if index >= lights) {
            continue;
        }
        let [mut pressed, mut clicked] = [default_session(), default_session()];
        for session in [&mut pressed, &mut clicked] {
            if binding.section == Section::EDITOR {
                session.apply(Action::Editor);
                session.apply(Action::Row(1));
                session.apply(Action::Type('1'));
            }
            session.apply(Action::Help);
            session.take_redraw();
        }
        let point = place_of(&hud(&clicked, SIZE), Part::Help, binding.action);
        let on_row = click(
            &mut clicked,
            point.unwrap_or_else(|| panic!("no key for {binding:?}")),
        );
        let mut on_key = None;
        let mut input = Input::default();
        input.is_editing = binding.section == Section::EDITOR;
        let Modifiers { shift, control } = binding.modifiers;
        let shift = shift.then_some(Key::LeftShift);
        let control = control.then_some(Key::LeftCtrl);
        for key in shift.iter().chain(&control).chain(&binding.keys[..1]) {
            if let Some(gesture) = input.handle(Event::KeyDown(*key), Duration::ZERO) {
                on_key = does(&mut pressed, gesture);
            }
        }
        assert_eq!(on_row, on_key, "{binding:?}");
        let changed = pressed.take_redraw();
        assert_eq!(clicked.take_redraw(), changed, "{binding:?}");
        let quiet = matches!(
            binding.action,
            Action::Screenshot
                | Action::SavePicture
                | Action::Save
                | Action::FullScreen
                | Action::Quit
        );
        assert_eq!(changed == Redraw::Nothing, quiet, "{binding:?}");
        assert_eq!(state(&mut pressed), state(&mut clicked), "{binding:?}");
    }
}

#[test]
fn a_click_on_a_bracket_steps_the_tolerance_as_the_bracket_says_and_never_round() {
    let mut session = default_session();
    for (action, expected) in [
        (Action::Tolerance(-1), [0.25, 0.0, 0.0]),
        (Action::Tolerance(1), [0.25, 0.5, 1.0]),
        (Action::Tolerance(1), [2.0, 4.0, 8.0]),
        (Action::Tolerance(1), [8.0, 8.0, 8.0]),
    ] {
        let key = place_of(&hud(&session, SIZE), Part::Panel, action).expect("a key");
        for tolerance in expected {
            click(&mut session, key);
            assert_eq!(session.tolerance, tolerance);
        }
    }
}

#[test]
fn panel_and_help_come_before_the_picture() {
    let mut session = default_session();
    let title = [40, 10];
    let modifiers = Modifiers::default();
    let drag = |from| Gesture::Drag {
        from,
        by: [50, 0],
        modifiers,
    };
    let wheel = |at| Gesture::Wheel {
        at,
        notches: 1,
        modifiers,
    };
    does(&mut session, drag(title));
    does(&mut session, wheel(title));
    assert_eq!(session.orbit(), shadetrade::components::Orbit::default());
    does(&mut session, drag([600, 300]));
    assert!(
        session.orbit().azimuth < 0.0,
        "the cuboid follows the mouse to the right"
    );
    does(&mut session, wheel([600, 300]));
    assert_eq!(session.orbit().zoom, 1);
    // The help lies over the panel.
    session.apply(Action::Help);
    let hud = hud(&session, SIZE);
    let over = board(&hud, Part::Help).rect;
    let phong = place_of(&hud, Part::Help, Action::Shading(ShadingMode::Phong));
    click(&mut session, phong.expect("a row"));
    assert_eq!(session.shading(), Some(ShadingMode::Phong));
    click(&mut session, [over.x + 1, over.y + 1]);
    assert!(session.state.help, "a click beside its rows does nothing");
    click(&mut session, [SIZE[0] as i32 - 2, SIZE[1] as i32 - 2]);
    assert!(!session.state.help, "a click beside it closes it");
    assert_eq!(session.take_requests(), Vec::<Request>::new());
}

#[test]
fn what_was_drawn_is_what_is_clicked() {
    let mut session = default_session();
    session.apply(Action::Help);
    let shown = hud(&session, SIZE);
    let phong = Action::Shading(ShadingMode::Phong);
    let point = place_of(&shown, Part::Help, phong).expect("a row");
    // The help closes within the same poll, and is still seen.
    for gesture in [Gesture::Command(Action::Help), Gesture::Click(point)] {
        respond(&mut session, gesture, &shown);
    }
    assert_eq!(session.shading(), Some(ShadingMode::Phong));
    assert_ne!(hud(&session, SIZE).action_at(point), Some(phong));
}

#[test]
fn shift_and_tab_go_back() {
    let mut session = default_session();
    let mut input = Input::default();
    let mut down = |session: &mut Session, key| {
        let gesture = input.handle(Event::KeyDown(key), Duration::ZERO);
        input.handle(Event::KeyUp(key), Duration::ZERO);
        if let Some(gesture) = gesture {
            does(session, gesture);
        }
    };
    down(&mut session, Key::Tab);
    assert_eq!(session.state.mode, ViewMode::ALL[1]);
    let mut input = Input::default();
    input.handle(Event::KeyDown(Key::LeftShift), Duration::ZERO);
    for expected in [0, 4, 3] {
        let gesture = input.handle(Event::KeyDown(Key::Tab), Duration::ZERO);
        input.handle(Event::KeyUp(Key::Tab), Duration::ZERO);
        does(&mut session, gesture.expect("it is bound"));
        assert_eq!(session.state.mode, ViewMode::ALL[expected]);
    }
    // What needs no shift key does not mind it.
    let gesture = input.handle(Event::KeyDown(Key::Equal), Duration::ZERO);
    assert_eq!(gesture, Some(Gesture::Command(Action::Zoom(1))));
}

#[test]
fn the_row_under_the_mouse_lights_up() {
    let mut session = default_session();
    session.take_redraw();
    let before = pixels(&session, 0);
    let row = place_of(&Hud::new(&session, SIZE), Part::Panel, Action::Light(1)).expect("a row");
    does(&mut session, Gesture::Hover(row));
    assert_eq!(session.take_redraw(), Redraw::Overlay);
    assert_ne!(pixels(&session, 0), before);
    does(&mut session, Gesture::Hover([row[0] + 1, row[1]]));
    assert_eq!(
        session.take_redraw(),
        Redraw::Nothing,
        "the same row: nothing to draw"
    );
    does(&mut session, Gesture::Hover([600, 300]));
    assert_eq!(pixels(&session, 0), before);
}
