//! What views make of pictures, and how keys and the mouse choose between them.

use std::time::Duration;

use minifb::Key;
use shadetrade::components::ShadingMode;
use shadetrade::frame::{NO_TRIANGLE, OUTLINE};
use shadetrade::window::bindings::Action;
use shadetrade::window::input::Gesture;
use shadetrade::window::response::respond;
use shadetrade::window::session::{Redraw, Session};
use shadetrade::window::views::{TINTS, ViewMode, dim, tint, wipe};

use super::hud::{UNTOUCHED, hud};
use super::{SIZE, default_session, press};

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
    let mut pixels = [0x00ff_ffff, 0x0000_0000, 0x0000_ff00];
    dim(&mut pixels);
    // 150 * 255 / 768 = 49.8.
    assert_eq!(pixels, [0x0055_5555, 0, 0x0031_3131]);
}

#[test]
fn tab_goes_round_the_views_and_changes_nothing_that_is_judged() {
    let mut session = default_session();
    let revision = session.revision();
    session.take_redraw();
    for expected in [1, 2, 3, 4, 0].map(|place| ViewMode::ALL[place]) {
        press(&mut session, Key::Tab);
        assert_eq!(session.view_mode(), expected);
        assert_eq!(session.take_redraw(), Redraw::Picture);
        assert_eq!(session.revision(), revision);
    }
}

fn drag(session: &mut Session, from: [i32; 2], by: [i32; 2]) {
    respond(session, Gesture::Drag { from, by }, SIZE);
}

#[test]
fn the_divider_follows_the_mouse_and_nothing_else_moves() {
    let mut session = default_session();
    press(&mut session, Key::Tab);
    assert_eq!(session.divider_column(SIZE[0]), 480);
    let orbit = session.orbit();
    drag(&mut session, [485, 300], [96, 5]);
    assert_eq!(session.divider_column(SIZE[0]), 576);
    // Still the same press: it is far from the divider by now and holds it all the same.
    drag(&mut session, [485, 300], [2000, 0]);
    assert_eq!(session.divider_column(SIZE[0]), 960);
    drag(&mut session, [485, 300], [-1900, 0]);
    assert_eq!(session.divider_column(SIZE[0]), 676);
    respond(&mut session, Gesture::Drop, SIZE);
    assert_eq!(session.orbit(), orbit);
    drag(&mut session, [485, 300], [96, 0]);
    assert_eq!(session.divider_column(SIZE[0]), 676, "let go, and missed");
    assert_ne!(session.orbit(), orbit);
}

#[test]
fn a_divider_dragged_out_of_the_picture_is_found_at_its_edge() {
    let mut session = default_session();
    press(&mut session, Key::Tab);
    drag(&mut session, [480, 300], [5000, 0]);
    respond(&mut session, Gesture::Drop, SIZE);
    drag(&mut session, [955, 300], [-96, 0]);
    assert_eq!(session.divider_column(SIZE[0]), 864);
}

#[test]
fn both_sides_of_a_wipe_are_named() {
    let mut session = default_session();
    press(&mut session, Key::P);
    let mut names = |mode| {
        session.apply(Action::Show(mode));
        let hud = hud(&session, SIZE);
        let chips = hud.legend().expect("there is room").chips().iter();
        chips.map(|(_, text)| text.clone()).collect::<Vec<_>>()
    };
    assert_eq!(names(ViewMode::GouraudPhong), ["Gouraud", "Phong"]);
    assert_eq!(
        names(ViewMode::MethodReference),
        ["Phong, 0.5", "computing ..."]
    );
    assert_eq!(names(ViewMode::ErrorMap), ["computing ..."]);
    assert_eq!(names(ViewMode::Picture), [""; 0]);
}

#[test]
fn the_names_of_a_wipe_go_where_there_is_room_for_most_of_them() {
    let mut session = default_session();
    session.apply(Action::Show(ViewMode::GouraudPhong));
    let chips = |session: &Session, size| {
        let hud = hud(session, size);
        let legend = hud.legend().expect("there is room");
        let chips = legend.chips().iter();
        chips
            .map(|(rect, text)| (text.clone(), rect.y < 100))
            .collect::<Vec<_>>()
    };
    let both = |above| [("Gouraud".to_owned(), above), ("Phong".to_owned(), above)];
    assert_eq!(chips(&session, SIZE), both(true));
    let narrow = [500, 1100];
    assert_eq!(chips(&session, narrow), both(false), "below the panel");
    session.drag_divider(-0.25);
    assert_eq!(chips(&session, SIZE), both(false), "below the panel");
    session.drag_divider(0.74);
    assert_eq!(
        chips(&session, SIZE),
        both(true)[..1],
        "no room on the right"
    );
}

#[test]
fn the_error_map_and_the_tiles_have_a_key_to_their_colours() {
    let mut session = default_session();
    for (mode, has_key) in ViewMode::ALL
        .into_iter()
        .zip([false, false, false, true, true])
    {
        session.apply(Action::Show(mode));
        for size in [[640, 480], SIZE, [1920, 1080], [3840, 2160]] {
            let hud = hud(&session, size);
            let key = hud.legend().expect("there is room").key();
            assert_eq!(key.is_some(), has_key, "{mode:?} {size:?}");
            let mut pixels = vec![UNTOUCHED; size[0] * size[1]];
            hud.draw(&mut pixels);
            let seen = |color| pixels.contains(&color);
            assert_eq!(
                mode == ViewMode::Tiles,
                TINTS[..6].iter().all(|it| seen(*it))
            );
        }
    }
}

#[test]
fn b_shows_the_reference_as_long_as_it_is_held() {
    let mut session = default_session();
    session.take_redraw();
    press(&mut session, Key::B);
    assert!(session.blinks());
    assert_eq!(session.take_redraw(), Redraw::Overlay);
    respond(
        &mut session,
        Gesture::Released(shadetrade::window::bindings::Action::Blink),
        SIZE,
    );
    assert!(!session.blinks());
    assert_eq!(session.shading(), Some(ShadingMode::Gouraud));
    session.tick(Duration::ZERO);
    assert_eq!(session.take_redraw(), Redraw::Overlay);
}
