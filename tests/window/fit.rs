//! That what lies over the picture fits, whatever the window's size.

use std::time::Duration;

use fearless_simd::Level;
use proptest::prelude::*;
use shadetrade::canvas::Rect;
use shadetrade::frame::{Frame, Keep, Workers};
use shadetrade::scene::{BUILT_IN, Scene};
use shadetrade::window::bindings::Action;
use shadetrade::window::hud::board::Board;
use shadetrade::window::hud::lines::Line;
use shadetrade::window::session::Session;

use super::hud::{UNTOUCHED, commands, hud};
use super::{default_session, session_of};

#[test]
fn common_sizes_have_a_whole_panel() {
    for size in [
        [320, 240],
        [640, 480],
        [960, 720],
        [1280, 720],
        [1920, 1080],
        [3840, 2160],
        [200, 900],
    ] {
        let session = default_session();
        let hud = hud(&session, size);
        let panel = hud
            .panel()
            .unwrap_or_else(|| panic!("no panel at {size:?}"));
        let rows = commands(panel);
        let lights = rows
            .iter()
            .filter(|(command, _)| matches!(command.action, Action::Light(_)));
        assert_eq!(lights.count(), 4, "{size:?}");
        let shown =
            |wanted: fn(Action) -> bool| rows.iter().any(|(command, _)| wanted(command.action));
        assert!(
            shown(|it| matches!(it, Action::Shading(_))),
            "{size:?}: shading"
        );
        // In the smallest window the last rows are reached with the wheel.
        let last = size == [320, 240] || shown(|it| it == Action::Help);
        assert!(last, "{size:?}: help");
        let facts = panel
            .rows()
            .iter()
            .filter(|(line, _)| matches!(line, Line::Fact(..)))
            .count();
        assert!(facts == 6 || facts == 2, "{size:?}");
        assert_eq!(panel.scroll().is_some(), size == [320, 240], "{size:?}");
    }
}

/// Draws everything over a picture of `size`, and checks that every part keeps to its place.
pub(super) fn check_fit(session: &Session, size: [usize; 2]) {
    let window = Rect::new(0, 0, size[0] as i32, size[1] as i32);
    let hud = hud(session, size);
    let boards: Vec<&Board> = [hud.panel(), hud.help(), hud.probe(), hud.table()]
        .into_iter()
        .flatten()
        .collect();
    for board in &boards {
        assert_eq!(board.rect().intersection(&window), board.rect(), "{size:?}");
        for (line, row) in board.rows() {
            assert_eq!(row.intersection(&board.rect()), *row, "{size:?} {line:?}");
        }
        for (index, (_, row)) in board.rows().iter().enumerate() {
            for (_, other) in &board.rows()[index + 1..] {
                assert!(row.intersection(other).is_empty(), "{size:?}");
            }
        }
    }
    let mut pixels = vec![UNTOUCHED; size[0] * size[1]];
    hud.draw(&mut pixels);
    let plain = !session.overlay().shows_help()
        && session.probed().is_none()
        && !session.measuring().is_open();
    if plain && session.overlay().message().is_none() {
        for (index, pixel) in pixels.iter().enumerate() {
            let point = [(index % size[0]) as i32, (index / size[0]) as i32];
            let inside = boards.iter().any(|board| board.rect().contains(point));
            assert!(inside || *pixel == UNTOUCHED, "{size:?} {point:?}");
        }
    }
}

#[test]
fn nothing_leaves_its_place_at_the_smallest_and_largest_sizes() {
    let mut session = default_session();
    for size in [
        [1, 1],
        [1, 2160],
        [3840, 1],
        [2, 2],
        [3840, 2160],
        [16, 16],
        [5000, 20],
    ] {
        for _ in 0..2 {
            check_fit(&session, size);
            session.apply(Action::Help);
        }
        session.apply(Action::LightNamed(
            "none such, and a long name at that, to be broken into many lines",
        ));
        check_fit(&session, size);
        session.tick(session_end());
    }
}

/// Late enough for every message to have passed.
fn session_end() -> Duration {
    Duration::from_secs(3600)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn nothing_leaves_its_place_at_any_size(
        width in 1_usize..700,
        height in 1_usize..500,
        help: bool,
        message: bool,
        name in "\\PC{0,40}",
    ) {
        let text = BUILT_IN[0].1.replace("name = \"red\"", &format!("name = {:?}", format!("red{}", name.replace(',', " "))));
        let scene = Scene::parse("a rather long name of a scene file.toml", &text).or_else(|_| Scene::load(None)).expect("the built-in scene is valid");
        let mut session = session_of(scene);
        if help {
            session.apply(Action::Help);
        }
        if message {
            session.apply(Action::LightNamed("nothing"));
        }
        // Long numbers among the facts.
        let workers = Workers::new(1, Level::new()).expect("no thread is needed");
        let mut frame = Frame::new(Keep::Display, workers);
        session.draw([700, 500], &mut frame).expect("there is memory");
        session.record(Duration::from_secs(1), &frame);
        check_fit(&session, [width, height]);
    }
}
