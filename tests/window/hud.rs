//! What lies over the picture: that it fits, that it says what it must, and that all of it can be clicked.

use std::iter;
use std::time::Duration;

use fearless_simd::Level;
use minifb::Key;
use shadetrade::canvas::{Point, Rect};
use shadetrade::components::{Projection, ShadingMode};
use shadetrade::frame::{Frame, Keep, NO_TRIANGLE, Workers};
use shadetrade::scene::{BUILT_IN, Scene};
use shadetrade::window::bindings::{Action, BINDINGS};
use shadetrade::window::hud::board::Board;
use shadetrade::window::hud::lines::{Command, Line, Mark};
use shadetrade::window::hud::{Hud, Shown};
use shadetrade::window::input::Gesture;
use shadetrade::window::response::respond;
use shadetrade::window::session::{Redraw, Request, Session};
use shadetrade::window::views::ViewMode;

use super::{SIZE, default_session, mixed_session, press, session_of};

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

fn click(session: &mut Session, point: Point) {
    respond(session, Gesture::Click(point), SIZE);
}

/// Everything about a session that a command can change.
fn state(session: &mut Session) -> String {
    session.tick(Duration::from_millis(300));
    let lights: Vec<_> = (0..4)
        .map(|index| session.light(index).map(|light| light.on))
        .collect();
    let overlay = session.overlay();
    let shown = (
        overlay.shows_panel(),
        overlay.shows_help(),
        overlay.message().map(str::to_owned),
    );
    let turned = session.turning().degrees();
    let requests = session.take_requests();
    format!(
        "{:?}",
        (
            session.view(SIZE),
            lights,
            shown,
            turned,
            session.view_mode(),
            session.blinks(),
            requests
        )
    )
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
            "shaded",
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
fn a_click_in_the_help_does_what_the_key_does() {
    let shown = |action| match action {
        // What steps through several states has a row for each of them; here the one that the step leads to.
        Action::Tolerance(1) => Action::NextTolerance,
        Action::NextProjection => Action::Projection(Projection::Orthographic),
        Action::NextCamera => Action::Camera(1),
        Action::NextView => Action::Show(ViewMode::GouraudPhong),
        Action::LightNamed("white") => Action::Light(0),
        Action::LightNamed("red") => Action::Light(1),
        Action::LightNamed("specular") => Action::Light(2),
        Action::LightNamed("ambient") => Action::Light(3),
        other => other,
    };
    for binding in BINDINGS {
        // A click steps the tolerance one way only.
        if matches!(binding.action, Action::Light(4..) | Action::Tolerance(-1)) {
            continue;
        }
        let [mut pressed, mut clicked] = [default_session(), default_session()];
        for session in [&mut pressed, &mut clicked] {
            session.apply(Action::Help);
            session.take_redraw();
        }
        let point = row_of(
            hud(&clicked, SIZE).help().expect("there is room"),
            shown(binding.action),
        );
        click(
            &mut clicked,
            point.unwrap_or_else(|| panic!("no row for {binding:?}")),
        );
        press(&mut pressed, binding.keys[0]);
        let changed = pressed.take_redraw();
        assert_eq!(clicked.take_redraw(), changed, "{binding:?}");
        let quiet = matches!(binding.action, Action::Screenshot | Action::Quit);
        assert_eq!(changed == Redraw::Nothing, quiet, "{binding:?}");
        assert_eq!(state(&mut pressed), state(&mut clicked), "{binding:?}");
    }
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
fn panel_and_help_come_before_the_picture() {
    let mut session = default_session();
    let title = [40, 30];
    let drag = |from| Gesture::Drag { from, by: [50, 0] };
    respond(&mut session, drag(title), SIZE);
    respond(
        &mut session,
        Gesture::Wheel {
            at: title,
            notches: 1,
        },
        SIZE,
    );
    assert_eq!(session.orbit(), shadetrade::window::orbit::Orbit::default());
    respond(&mut session, drag([600, 300]), SIZE);
    assert!(
        session.orbit().azimuth < 0.0,
        "the cuboid follows the mouse to the right"
    );
    respond(
        &mut session,
        Gesture::Wheel {
            at: [600, 300],
            notches: 1,
        },
        SIZE,
    );
    assert_eq!(session.orbit().zoom, 1);
    // The help lies over the panel.
    session.apply(Action::Help);
    let over = hud(&session, SIZE).help().expect("there is room").rect();
    let panel = hud(&session, SIZE).panel().expect("there is room").rect();
    assert!(!panel.intersection(&over).is_empty());
    let phong = Action::Shading(ShadingMode::Phong);
    let row = row_of(hud(&session, SIZE).help().expect("there is room"), phong).expect("a row");
    let covered = [panel.right() - 12, row[1]];
    assert!(over.contains(covered) && panel.contains(covered));
    click(&mut session, covered);
    assert_eq!(
        session.shading(),
        Some(ShadingMode::Phong),
        "the uppermost row is clicked"
    );
    click(&mut session, [over.x + 1, over.y + 1]);
    assert!(
        session.overlay().shows_help(),
        "a click beside its rows does nothing"
    );
    click(&mut session, [SIZE[0] as i32 - 2, SIZE[1] as i32 - 2]);
    assert!(
        !session.overlay().shows_help(),
        "a click beside it closes it"
    );
    assert_eq!(session.take_requests(), Vec::<Request>::new());
}

#[test]
fn the_mouse_brings_a_hidden_panel_back() {
    let mut session = default_session();
    press(&mut session, Key::I);
    assert!(hud(&session, SIZE).panel().is_none());
    respond(&mut session, Gesture::Hover([500, 500]), SIZE);
    assert_eq!(session.take_redraw(), Redraw::Picture);
    let tab = hud(&session, SIZE);
    let row = row_of(tab.panel().expect("a tab"), Action::Panel).expect("a row");
    assert!(
        Hud::new(&session, SIZE, Shown::Lasting).panel().is_none(),
        "not in a saved picture"
    );
    session.tick(Duration::from_millis(1999));
    assert!(session.overlay().shows_tab());
    session.tick(Duration::from_secs(2));
    assert!(
        !session.overlay().shows_tab(),
        "gone once the mouse has rested"
    );
    respond(&mut session, Gesture::Hover([500, 501]), SIZE);
    click(&mut session, row);
    assert!(session.overlay().shows_panel());
}

#[test]
fn the_row_under_the_mouse_lights_up() {
    let mut session = default_session();
    session.take_redraw();
    let draw = |session: &Session| {
        let mut pixels = vec![UNTOUCHED; SIZE[0] * SIZE[1]];
        hud(session, SIZE).draw(&mut pixels);
        pixels
    };
    let before = draw(&session);
    let row = row_of(
        hud(&session, SIZE).panel().expect("there is room"),
        Action::Light(1),
    )
    .expect("a row");
    respond(&mut session, Gesture::Hover(row), SIZE);
    assert_eq!(session.take_redraw(), Redraw::Overlay);
    assert_ne!(draw(&session), before);
    respond(&mut session, Gesture::Hover([row[0] + 1, row[1]]), SIZE);
    assert_eq!(
        session.take_redraw(),
        Redraw::Nothing,
        "the same row: nothing to draw"
    );
    respond(&mut session, Gesture::Hover([600, 300]), SIZE);
    assert_eq!(draw(&session), before);
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

#[test]
fn a_panel_that_is_too_long_scrolls() {
    let lamps = (0..60).map(|index| {
        format!("[[light]]\nname = \"lamp {index}\"\nkind = \"ambient\"\ncolor = [1.0, 1.0, 1.0]\nintensity = 1.0\n")
    });
    let text: String = iter::once(BUILT_IN[0].1.to_owned()).chain(lamps).collect();
    let mut session = session_of(Scene::parse("many.toml", &text).expect("a valid scene"));
    let last_seen = |session: &Session| {
        let hud = hud(session, SIZE);
        commands(hud.panel().expect("there is room"))
            .last()
            .map(|(command, _)| command.action)
    };
    let scroll = |session: &mut Session, notches| {
        let at = [30, 30];
        respond(session, Gesture::Wheel { at, notches }, SIZE);
    };
    let start = last_seen(&session);
    assert!(matches!(start, Some(Action::Light(_))), "{start:?}");
    scroll(&mut session, -1000);
    assert_eq!(last_seen(&session), Some(Action::Help));
    super::fit::check_fit(&session, SIZE);
    scroll(&mut session, 1);
    assert_eq!(last_seen(&session), Some(Action::Panel));
    scroll(&mut session, 1000);
    assert_eq!(last_seen(&session), start);
    // A light beyond the ninth has no key; its row is there to click.
    let row = row_of(
        hud(&session, SIZE).panel().expect("there is room"),
        Action::Light(20),
    )
    .expect("a row");
    click(&mut session, row);
    assert_eq!(session.light(20).map(|light| light.on), Some(false));
}
