//! What the mouse does with what lies over the picture, and that all of it can be clicked.

use std::iter;
use std::time::Duration;

use minifb::Key;
use shadetrade::canvas::Point;
use shadetrade::components::{Projection, ShadingMode};
use shadetrade::scene::{BUILT_IN, Scene};
use shadetrade::window::bindings::{Action, BINDINGS};
use shadetrade::window::hud::{Hud, Shown};
use shadetrade::window::input::Gesture;
use shadetrade::window::response::respond;
use shadetrade::window::session::{Redraw, Request, Session};
use shadetrade::window::views::ViewMode;

use super::hud::{UNTOUCHED, commands, hud, row_of};
use super::{SIZE, default_session, press, session_of};

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
    let turned = session.spin().degrees;
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
    assert_eq!(session.orbit(), shadetrade::components::Orbit::default());
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
