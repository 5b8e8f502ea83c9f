//! What views make of pictures, and how keys and the mouse choose between them.

use fearless_simd::Level;
use minifb::Key;
use shadetrade::components::ShadingMode;
use shadetrade::frame::{NO_TRIANGLE, OUTLINE, Workers};
use shadetrade::scene::Scene;
use shadetrade::window::bindings::{Action, Modifiers};
use shadetrade::window::composition::Composition;
use shadetrade::window::hud::lines::Line;
use shadetrade::window::hud::{Part, picture};
use shadetrade::window::input::Gesture;
use shadetrade::window::session::{Redraw, Session};
use shadetrade::window::views::{TINTS, ViewMode, or_dimmed, tint, wipe};

use super::fit::drawn;
use super::hud::{hud, pixels};
use super::{SIZE, default_session, does, press, session_of};

#[test]
fn a_wipe_shows_one_picture_left_and_the_other_right() {
    let (left, right) = ([1, 2, 3, 4, 5, 6], [11, 12, 13, 14, 15, 16]);
    let mut pixels = vec![99; 40];
    for (divider, expected) in [
        (0, right),
        (1, [1, 12, 13, 4, 15, 16]),
        (2, [1, 2, 13, 4, 5, 16]),
        (3, left),
        (7, left),
    ] {
        wipe(&mut pixels, &left, &right, 3, divider);
        assert_eq!(pixels, expected, "{divider}");
    }
}

#[test]
fn tiles_are_tinted_by_kind_and_the_background_is_not() {
    let mut pixels = [0x0064_6464; 4];
    tint(
        &mut pixels,
        &[0, 5, 3, 5 | OUTLINE],
        &[0, 5, NO_TRIANGLE, 5],
    );
    // (100 * 144 + tint * 112) / 256 by channel: blue 0x0072b2 is 0, 114, 178, white is 255; on an outline 24 and 232.
    assert_eq!(TINTS[0], 0x0000_72b2);
    assert_eq!(pixels, [0x0038_6a86, 0x00a7_a7a7, 0x0064_6464, 0x00f0_f0f0]);
}

#[test]
fn a_picture_that_waits_is_grey_and_darker() {
    let pixels = or_dimmed(None, &[0x00ff_ffff, 0x0000_0000, 0x0000_ff00]).into_owned();
    // 150 * 255 / 768 = 49.8.
    assert_eq!(pixels, [0x0055_5555, 0, 0x0031_3131]);
}

#[test]
fn tab_goes_round_the_views_and_changes_nothing_that_is_judged() {
    let mut session = default_session();
    let revision = session.revision;
    session.take_redraw();
    for expected in [1, 2, 3, 4, 0].map(|place| ViewMode::ALL[place]) {
        press(&mut session, Key::Tab);
        assert_eq!(session.state.mode, expected);
        assert_eq!(session.take_redraw(), Redraw::Picture);
        assert_eq!(session.revision, revision);
    }
}

fn drag(session: &mut Session, from: [i32; 2], by: [i32; 2]) {
    let modifiers = Modifiers::default();
    does(
        session,
        Gesture::Drag {
            from,
            by,
            modifiers,
        },
    );
}

/// The divider's column in the window.
fn divider(session: &Session) -> i32 {
    let rect = picture(session, SIZE);
    rect.x + session.state.divider_column(rect.width as usize) as i32
}

#[test]
fn the_divider_follows_the_mouse_and_nothing_else_moves() {
    let mut session = default_session();
    press(&mut session, Key::Tab);
    let (orbit, start) = (session.orbit(), divider(&session));
    let rect = picture(&session, SIZE);
    let middle = rect.x + rect.width / 2;
    assert!((start - middle).abs() <= 1, "in the middle of the picture");
    drag(&mut session, [start + 5, 300], [96, 5]);
    let moved_by = |session: &Session, pixels: i32| {
        let moved = divider(session) - start;
        assert!(
            (moved - pixels).abs() <= 1,
            "{moved}, {pixels} by the mouse"
        );
    };
    moved_by(&session, 96);
    // Still the same press: it is far from the divider by now and holds it all the same.
    drag(&mut session, [start + 5, 300], [2000, 0]);
    drag(&mut session, [start + 5, 300], [-1900, 0]);
    moved_by(&session, 196);
    does(&mut session, Gesture::Command(Action::EndDrag));
    assert_eq!(session.orbit(), orbit);
    drag(&mut session, [start + 5, 300], [96, 0]);
    // Let go, and missed.
    moved_by(&session, 196);
    assert_ne!(session.orbit(), orbit);
}

#[test]
fn a_divider_dragged_out_of_the_picture_can_still_be_seen_and_caught() {
    for by in [5000, -5000] {
        let mut session = default_session();
        press(&mut session, Key::Tab);
        let start = divider(&session);
        drag(&mut session, [start, 300], [by, 0]);
        does(&mut session, Gesture::Command(Action::EndDrag));
        let end = divider(&session);
        let rect = picture(&session, SIZE);
        assert!((rect.x + 4..rect.right() - 4).contains(&end), "{end}");
        drag(&mut session, [end, 300], [-by.signum() * 96, 0]);
        let moved = divider(&session) - end;
        assert!((moved + by.signum() * 96).abs() <= 1, "{moved}");
    }
}

/// What is said about the view.
fn said(session: &Session) -> Vec<String> {
    let hud = hud(session, SIZE);
    let rows = hud.boards(Part::Legend).flat_map(|board| &board.rows);
    let text = |line: &Line| match line {
        Line::Text(text) | Line::Title(_, text) => text.clone(),
        _ => String::new(),
    };
    rows.map(|(line, _)| text(line)).collect()
}

#[test]
fn both_sides_of_a_wipe_are_named_and_what_is_not_known_yet_is_called_so() {
    let mut session = default_session();
    press(&mut session, Key::P);
    for (expected, waits) in [
        (vec![], false),
        (vec!["Gouraud", "Phong"], false),
        (vec!["Phong, 0.5"], true),
        (vec![], true),
    ] {
        let said = said(&session);
        for word in expected {
            assert!(said.iter().any(|it| it.contains(word)), "{word}: {said:?}");
        }
        assert_eq!(
            said.iter().any(|it| it.contains("computing")),
            waits,
            "{said:?}"
        );
        press(&mut session, Key::Tab);
    }
}

#[test]
fn the_error_map_and_the_tiles_have_a_key_to_their_colours() {
    for size in [[640, 480], SIZE, [1920, 1080], [3840, 2160]] {
        let mut session = default_session();
        session.apply(Action::View(3));
        let map = drawn(&mut session, size);
        let has_scale = |(line, _): &&(Line, _)| matches!(line, Line::Scale(_));
        let rows = map.boards(Part::Legend).flat_map(|board| &board.rows);
        assert_eq!(rows.filter(has_scale).count(), 1, "{size:?}");
        session.apply(Action::View(1));
        let tiles = drawn(&mut session, size);
        let rows = tiles.boards(Part::Legend).flat_map(|board| &board.rows);
        let colors: Vec<u32> = rows
            .filter_map(|(line, _)| match line {
                Line::Swatches(all) => Some(all.iter().map(|(color, _)| *color)),
                _ => None,
            })
            .flatten()
            .collect();
        assert_eq!(colors, TINTS, "{size:?}");
    }
    let mut session = default_session();
    session.apply(Action::View(4));
    let seen = pixels(&session, 0);
    assert!(TINTS.iter().all(|it| seen.contains(it)));
}

#[test]
fn b_shows_the_reference_as_long_as_it_is_held() {
    let mut session = default_session();
    session.take_redraw();
    press(&mut session, Key::B);
    assert!(session.state.shows_reference);
    assert_eq!(session.take_redraw(), Redraw::Overlay);
    does(&mut session, Gesture::Command(Action::EndBlink));
    assert!(!session.state.shows_reference);
    assert_eq!(session.take_redraw(), Redraw::Overlay);
    assert_eq!(session.shading(), Some(ShadingMode::Gouraud));
}

#[test]
fn until_there_is_a_reference_b_shows_the_picture_dimmed() {
    let mut session = default_session();
    let mut composition = Composition::new(Workers::alone(Level::new()));
    composition
        .draw(&mut session, [96, 72])
        .expect("there is memory");
    let shown = |session: &Session| {
        let mut pixels = Vec::new();
        composition.compose(session, &mut pixels);
        pixels
    };
    let picture = shown(&session);
    press(&mut session, Key::B);
    let dimmed = or_dimmed(None, &picture).into_owned();
    assert_ne!(dimmed, picture);
    assert_eq!(shown(&session), dimmed);
}

#[test]
fn the_sides_of_gouraud_and_phong_are_what_these_modes_draw() {
    let mut session = default_session();
    let mut composition = Composition::new(Workers::alone(Level::new()));
    let mut shown = |session: &mut Session| {
        let mut pixels = Vec::new();
        composition
            .draw(session, [96, 72])
            .expect("there is memory");
        composition.compose(session, &mut pixels);
        pixels
    };
    let gouraud = shown(&mut session);
    press(&mut session, Key::P);
    let phong = shown(&mut session);
    session.apply(Action::View(1));
    let both = shown(&mut session);
    let mut expected = Vec::new();
    wipe(&mut expected, &gouraud, &phong, 96, 48);
    assert!(gouraud != phong && both == expected);
}

#[test]
fn a_picture_of_one_colour_says_why() {
    let flat = |name: &str| {
        let scene = Scene::load(Some(name)).expect("it is built in");
        let mut session = session_of(scene);
        drawn(&mut session, SIZE);
        let words = said(&session).concat();
        assert_eq!(session.is_flat, words.contains("ambient"), "{words}");
        session.is_flat
    };
    assert!(flat("assignment"));
    assert!(!flat("cuboid"));
}
