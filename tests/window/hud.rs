//! What lies over the picture: that it says what it must.

use fearless_simd::Level;
use minifb::Key;
use shadetrade::canvas::{Point, Rect};
use shadetrade::frame::{Frame, Keep, NO_TRIANGLE, Workers};
use shadetrade::window::bindings::{Action, BINDINGS};
use shadetrade::window::hud::board::Board;
use shadetrade::window::hud::lines::{Command, Line, Mark};
use shadetrade::window::hud::{Hud, Shown};
use shadetrade::window::input::Gesture;
use shadetrade::window::response::respond;
use shadetrade::window::session::Session;

use super::{SIZE, default_session, mixed_session, press};

/// What a picture holds before anything is drawn over it: a colour that no ink mixes to.
pub(super) const UNTOUCHED: u32 = 0x0001_0203;

pub(super) fn hud(session: &Session, size: [usize; 2]) -> Hud {
    Hud::new(session, size, Shown::All)
}

pub(super) fn commands(board: &Board) -> Vec<(&Command, Rect)> {
    board
        .rows()
        .iter()
        .filter_map(|(line, rect)| match line {
            Line::Command(command) => Some((command, *rect)),
            _ => None,
        })
        .collect()
}

fn middle(rect: Rect) -> Point {
    [rect.x + rect.width / 2, rect.y + rect.height / 2]
}

/// The middle of the row that does `action`.
pub(super) fn row_of(board: &Board, action: Action) -> Option<Point> {
    commands(board)
        .into_iter()
        .find(|(command, _)| command.action == action)
        .map(|(_, rect)| middle(rect))
}

/// A row's keys, its mark (`#` on, `.` off), its label and its state.
fn in_words(board: &Board) -> Vec<String> {
    commands(board)
        .into_iter()
        .map(|(command, _)| {
            let mark = match command.mark {
                Mark::None => ' ',
                Mark::Switch(true, _) | Mark::Choice(true) => '#',
                Mark::Switch(false, _) | Mark::Choice(false) => '.',
            };
            let keys = command.captions.join(" ");
            format!("{keys} {mark} {} {}", command.label, command.state)
        })
        .collect()
}

#[test]
fn the_panel_shows_each_light_mode_projection_and_camera_with_its_key_and_state() {
    let mut session = default_session();
    press(&mut session, Key::R);
    let hud = hud(&session, SIZE);
    let panel = hud.panel().expect("there is room");
    let rows = in_words(panel);
    let expected = [
        "1 W # white on",
        "2 R . red off",
        "3 S # specular on",
        "4 A # ambient on",
        "G # Gouraud ",
        "P . Phong ",
        "[ ]   tolerance 0.5",
        "O # perspective ",
        "O . orthographic ",
        "C # 1 ",
        "C . 2 ",
        "Tab # picture ",
        "Tab . Gouraud | Phong ",
        "Tab . method | reference ",
        "Tab . error map ",
        "Tab . tiles ",
        "B . hold: reference off",
        "M . measure methods off",
        "Home   reset view ",
        "Space . turn cuboids off",
        "I # panel on",
        "H . help off",
    ];
    assert_eq!(rows, expected);
    let facts: Vec<_> = panel
        .rows()
        .iter()
        .filter_map(|(line, _)| match line {
            Line::Fact(name, _) => Some(*name),
            _ => None,
        })
        .collect();
    assert_eq!(
        facts,
        [
            "frame",
            "proven",
            "window",
            "error",
            "vs Phong",
            "vs own mode"
        ]
    );
}

#[test]
fn in_a_small_window_one_row_stands_for_every_key_and_tells_the_present_state() {
    let small = [640, 480];
    let mut session = default_session();
    for key in [Key::R, Key::P, Key::O, Key::C, Key::Tab] {
        press(&mut session, key);
    }
    let rows = in_words(hud(&session, small).panel().expect("there is room"));
    let expected = [
        "1 W # white on",
        "2 R . red off",
        "3 S # specular on",
        "4 A # ambient on",
        "G . Gouraud ",
        "P # Phong ",
        "[ ]   within 0.5 ",
        "O   orthographic ",
        "C   camera 2 ",
        "Tab   Gouraud | Phong ",
        "I # panel on",
        "H . help off",
    ];
    assert_eq!(rows, expected);
    // A click goes on to the next state.
    for (action, next) in [
        (Action::NextTolerance, "within 1"),
        (Action::NextProjection, "perspective"),
        (Action::NextCamera, "camera 1"),
        (Action::NextView, "method | reference"),
    ] {
        let row = row_of(hud(&session, small).panel().expect("there is room"), action);
        let gesture = Gesture::Click(row.expect("a row"));
        respond(&mut session, gesture, small);
        let rows = in_words(hud(&session, small).panel().expect("there is room"));
        assert!(
            rows.iter().any(|row| row.contains(next)),
            "{next}: {rows:?}"
        );
    }
}

#[test]
fn the_panel_leaves_the_cuboid_of_the_first_sight_free() {
    for (size, allowance) in [
        (SIZE, 0),
        ([1280, 720], 0),
        ([1920, 1080], 0),
        ([640, 480], 8),
    ] {
        let mut session = default_session();
        let workers = Workers::new(1, Level::new()).expect("no thread is needed");
        let mut frame = Frame::new(Keep::Levels, workers);
        session.draw(size, &mut frame).expect("there is memory");
        let drawn = (0..)
            .zip(frame.triangles())
            .filter(|(_, triangle)| **triangle != NO_TRIANGLE);
        let leftmost = drawn.map(|(index, _)| index % size[0]).min();
        let panel = hud(&session, size).panel().expect("there is room").rect();
        assert!(
            panel.right() <= leftmost.expect("a cuboid") as i32 + allowance,
            "{size:?}"
        );
    }
}

#[test]
fn where_cuboids_differ_no_mode_is_marked() {
    let session = mixed_session();
    let hud = hud(&session, SIZE);
    let marks: Vec<_> = commands(hud.panel().expect("there is room"))
        .into_iter()
        .filter(|(command, _)| matches!(command.action, Action::Shading(_)))
        .map(|(command, _)| command.mark)
        .collect();
    assert_eq!(marks, [Mark::Choice(false); 2]);
}

#[test]
fn the_help_tells_every_key() {
    let mut session = default_session();
    session.apply(Action::Help);
    let hud = hud(&session, SIZE);
    let captions: Vec<&str> = commands(hud.help().expect("there is room"))
        .into_iter()
        .flat_map(|(command, _)| command.captions.clone())
        .collect();
    for binding in BINDINGS
        .iter()
        .filter(|binding| !matches!(binding.action, Action::Light(4..)))
    {
        for caption in binding.captions {
            assert!(captions.contains(caption), "{caption}");
        }
    }
}

#[test]
fn the_help_tells_the_state_as_it_is_now() {
    let mut session = default_session();
    session.apply(Action::Help);
    for key in [Key::Right, Key::Right, Key::Equal, Key::W] {
        press(&mut session, key);
    }
    let hud = hud(&session, SIZE);
    let state = |action| {
        let rows = commands(hud.help().expect("there is room"));
        rows.into_iter()
            .find(|(command, _)| command.action == action)
            .map(|(command, _)| command.state.clone())
    };
    assert_eq!(
        state(Action::Orbit {
            azimuth: 2.0,
            elevation: 0.0
        })
        .as_deref(),
        Some("4\u{b0}")
    );
    assert_eq!(state(Action::Zoom(1)).as_deref(), Some("1.10\u{d7}"));
    assert_eq!(state(Action::Light(0)).as_deref(), Some("off"));
}

#[test]
fn on_and_off_differ_without_colour() {
    let mut session = default_session();
    let mark = |session: &Session| {
        let mut pixels = vec![UNTOUCHED; SIZE[0] * SIZE[1]];
        let hud = hud(session, SIZE);
        hud.draw(&mut pixels);
        let row = row_of(hud.panel().expect("there is room"), Action::Light(1)).expect("a row");
        // The brightest green in the row's left part, where keys and mark stand but no words: red has none.
        let left = (0..40)
            .map(|x| 40 + x)
            .map(|x| pixels[row[1] as usize * SIZE[0] + x] >> 8 & 0xff);
        left.collect::<Vec<_>>()
    };
    let on = mark(&session);
    press(&mut session, Key::R);
    assert_ne!(mark(&session), on);
}
