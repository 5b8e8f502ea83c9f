//! Events in, gestures out.

use std::time::Duration;

use minifb::Key;
use shadetrade::window::bindings::{Action, Modifiers};
use shadetrade::window::input::{Event, Gesture, Input};

const WHITE: Option<Gesture> = Some(Gesture::Command(Action::LightNamed("white")));
const HELP: Option<Gesture> = Some(Gesture::Command(Action::Help));

fn at(milliseconds: u64) -> Duration {
    Duration::from_millis(milliseconds)
}

#[test]
fn a_key_that_is_held_is_one_press_however_often_it_is_reported() {
    let mut input = Input::default();
    assert_eq!(input.handle(Event::KeyDown(Key::W), at(0)), WHITE);
    for time in [500, 530, 560] {
        assert_eq!(input.handle(Event::KeyDown(Key::W), at(time)), None);
        assert_eq!(input.handle(Event::Character('w'), at(time)), None);
    }
    assert_eq!(input.handle(Event::KeyUp(Key::W), at(600)), None);
    assert_eq!(input.handle(Event::KeyDown(Key::W), at(610)), WHITE);
}

#[test]
fn the_character_of_a_bound_key_counts_for_nothing() {
    let mut input = Input::default();
    assert_eq!(input.handle(Event::KeyDown(Key::W), at(0)), WHITE);
    assert_eq!(input.handle(Event::Character('w'), at(0)), None);
    // Not even where a layout writes another bound character with it.
    assert!(input.handle(Event::KeyDown(Key::Key1), at(1)).is_some());
    assert_eq!(input.handle(Event::Character('+'), at(1)), None);
}

#[test]
fn the_character_of_an_unbound_key_counts() {
    let mut input = Input::default();
    for press in [0, 10] {
        assert_eq!(
            input.handle(Event::KeyDown(Key::LeftShift), at(press)),
            None
        );
        assert_eq!(input.handle(Event::KeyDown(Key::Slash), at(press)), None);
        assert_eq!(input.handle(Event::Character('?'), at(press)), HELP);
        // Held: key and character are reported again.
        assert_eq!(
            input.handle(Event::KeyDown(Key::Slash), at(press + 5)),
            None
        );
        assert_eq!(input.handle(Event::Character('?'), at(press + 5)), None);
        input.handle(Event::KeyUp(Key::Slash), at(press + 6));
        input.handle(Event::KeyUp(Key::LeftShift), at(press + 6));
    }
}

#[test]
fn a_character_without_a_key_counts_once_until_its_repetition_ends() {
    let mut input = Input::default();
    let light = Some(Gesture::Command(Action::Light(0)));
    assert_eq!(input.handle(Event::Character('1'), at(0)), light);
    for time in [30, 60, 90, 120, 150] {
        assert_eq!(input.handle(Event::Character('1'), at(time)), None);
    }
    assert_eq!(input.handle(Event::Character('1'), at(300)), light);
    assert_eq!(input.handle(Event::Character('W'), at(301)), WHITE);
    assert_eq!(input.handle(Event::Character('\u{444}'), at(302)), None);
}

#[test]
fn keys_held_when_the_window_loses_the_focus_are_up_when_it_comes_back() {
    let mut input = Input::default();
    input.handle(Event::KeyDown(Key::Left), at(0));
    input.handle(Event::KeyDown(Key::W), at(0));
    input.handle(Event::FocusLost, at(100));
    assert_eq!(input.repeated(at(5000)), None);
    assert_eq!(input.handle(Event::KeyDown(Key::W), at(6000)), WHITE);
}

#[test]
fn a_held_arrow_goes_on_and_a_held_letter_does_not() {
    let mut input = Input::default();
    let left = input.handle(Event::KeyDown(Key::Left), at(0));
    input.handle(Event::KeyDown(Key::W), at(0));
    assert!(left.is_some());
    assert_eq!(input.repeated(at(299)), None);
    assert_eq!(input.repeated(at(300)), left);
    assert_eq!(input.repeated(at(300)), None);
    assert_eq!(input.repeated(at(316)), left);
    // After a pause it goes on from there, not in a burst.
    assert_eq!(input.repeated(at(2000)), left);
    assert_eq!(input.repeated(at(2015)), None);
    assert_eq!(input.repeated(at(2016)), left);
    input.handle(Event::KeyUp(Key::Left), at(2017));
    assert_eq!(input.repeated(at(3000)), None);
}

#[test]
fn a_press_that_moves_less_than_four_pixels_is_a_click() {
    let mut input = Input::default();
    input.handle(Event::MouseAt([100, 100]), at(0));
    assert_eq!(input.handle(Event::MouseDown, at(1)), None);
    assert_eq!(input.handle(Event::MouseAt([102, 103]), at(2)), None);
    assert_eq!(
        input.handle(Event::MouseUp, at(3)),
        Some(Gesture::Click([100, 100]))
    );
}

#[test]
fn a_press_that_moves_four_pixels_is_a_drag_that_loses_no_movement() {
    let mut input = Input::default();
    input.handle(Event::MouseAt([100, 100]), at(0));
    input.handle(Event::MouseDown, at(1));
    assert_eq!(input.handle(Event::MouseAt([103, 100]), at(2)), None);
    let drag = |by| {
        Some(Gesture::Drag {
            from: [100, 100],
            by,
            modifiers: Modifiers::default(),
        })
    };
    assert_eq!(
        input.handle(Event::MouseAt([104, 100]), at(3)),
        drag([4, 0])
    );
    // Once a drag, always a drag, back to the start too.
    assert_eq!(
        input.handle(Event::MouseAt([100, 99]), at(4)),
        drag([-4, -1])
    );
    assert_eq!(
        input.handle(Event::MouseUp, at(5)),
        Some(Gesture::Command(Action::EndDrag))
    );
    assert_eq!(
        input.handle(Event::MouseAt([90, 90]), at(6)),
        Some(Gesture::Hover([90, 90]))
    );
}

#[test]
fn what_lasts_as_long_as_its_key_ends_with_it_or_with_the_focus() {
    let mut input = Input::default();
    let begins = Some(Gesture::Command(Action::Blink));
    let ends = Some(Gesture::Command(Action::EndBlink));
    for end in [Event::KeyUp(Key::B), Event::FocusLost] {
        assert_eq!(input.handle(Event::KeyDown(Key::B), at(0)), begins);
        assert_eq!(input.handle(Event::KeyDown(Key::W), at(1)), WHITE);
        assert_eq!(input.handle(Event::KeyDown(Key::B), at(2)), None);
        assert_eq!(input.handle(Event::KeyUp(Key::W), at(3)), None);
        assert_eq!(input.handle(end, at(4)), ends);
        assert_eq!(input.handle(end, at(5)), None);
    }
}

#[test]
fn the_wheel_turns_where_the_mouse_is() {
    let mut input = Input::default();
    input.handle(Event::MouseAt([7, 8]), at(0));
    let expected = Some(Gesture::Wheel {
        at: [7, 8],
        notches: -1,
        modifiers: Modifiers::default(),
    });
    assert_eq!(input.handle(Event::Wheel(-1), at(1)), expected);
}
