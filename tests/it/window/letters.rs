//! The size of letters, chosen by keys: what is set in it, and what is left out where there is no room.

use minifb::Key;
use shadetrade::canvas::FACES;
use shadetrade::window::bindings::{Action, Modifiers, bound_to_key};
use shadetrade::window::hud::lines::Line;
use shadetrade::window::hud::{Hud, Part};
use shadetrade::window::input::Gesture;
use shadetrade::window::response::respond;
use shadetrade::window::session::Session;

use super::default_session;
use super::fit::{check_fit, drawn};

const LARGE: [usize; 2] = [1920, 1080];

/// How high the rows of a board's words are.
fn row_height(hud: &Hud, part: Part) -> i32 {
    let board = hud.boards(part).next().expect("it is shown");
    let rows = board.rows.iter();
    let words = rows.filter(|(line, _)| !matches!(line, Line::Rule));
    let heights = words.map(|(_, place)| place.height);
    heights.min().expect("it has rows")
}

/// Presses Ctrl with `key` in a window of `size`.
fn press_with_control(session: &mut Session, key: Key, size: [usize; 2]) -> Hud {
    let control = Modifiers {
        control: true,
        ..Modifiers::default()
    };
    let binding = bound_to_key(key, control, false).expect("it is bound");
    let hud = drawn(session, size);
    respond(session, Gesture::Command(binding.action), &hud);
    drawn(session, size)
}

#[test]
fn keys_step_from_the_letters_that_are_seen_and_end_at_the_last_size() {
    let mut session = default_session();
    let seen = drawn(&mut session, LARGE).letters();
    for step in 1..=FACES.len() {
        let hud = press_with_control(&mut session, Key::Equal, LARGE);
        assert_eq!(hud.letters(), (seen + step).min(FACES.len() - 1));
    }
    for step in 1..=FACES.len() {
        let hud = press_with_control(&mut session, Key::Minus, LARGE);
        assert_eq!(hud.letters(), (FACES.len() - 1).saturating_sub(step));
    }
}

#[test]
fn words_are_set_in_the_letters_that_were_chosen() {
    for (size, face) in FACES.iter().enumerate() {
        let mut session = default_session();
        session.apply(Action::Probe(Some([700, 500])));
        session.apply(Action::Letters(size));
        let hud = drawn(&mut session, LARGE);
        check_fit(&hud, LARGE);
        // The two largest have no room for what is known of a pixel.
        if size < 5 {
            assert!(row_height(&hud, Part::Probe) >= face.height(), "{face:?}");
        }
        assert!(hud.boards(Part::Probe).next().is_some(), "{face:?}");
        // A panel that has no room leaves the whole window to the picture.
        match hud.boards(Part::Panel).next() {
            Some(_) => assert!(row_height(&hud, Part::Panel) >= face.height()),
            None => assert_eq!(hud.picture.size(), LARGE),
        }
    }
}

#[test]
fn a_size_that_is_chosen_covers_rather_than_shrinks() {
    let mut session = default_session();
    session.apply(Action::Probe(Some([300, 300])));
    let small = [640, 480];
    let hud = drawn(&mut session, small);
    assert_eq!(hud.letters(), 0);
    session.apply(Action::Letters(2));
    let hud = drawn(&mut session, small);
    assert!(hud.boards(Part::Panel).next().is_none());
    assert!(row_height(&hud, Part::Message) >= FACES[2].height());
}
