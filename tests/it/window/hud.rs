//! What panel and help say.

use minifb::Key;
use shadetrade::canvas::Rect;
use shadetrade::scene::{BUILT_IN, Scene};
use shadetrade::window::bindings::{Action, BINDINGS};
use shadetrade::window::hud::lines::{Command, Line, Mark};
use shadetrade::window::hud::{Hud, Part};
use shadetrade::window::session::Session;

pub(super) use crate::support::window::{board, commands, hud, place_of};

use super::{SIZE, default_session, mixed_session, press, session_of};

/// A row's keys, its mark (`#` on, `.` off), its label and its state.
fn in_words(hud: &Hud) -> Vec<String> {
    commands(hud, Part::Panel)
        .into_iter()
        .map(|(command, _)| {
            let mark = match command.mark {
                Mark::None => ' ',
                Mark::Switch(true, _) | Mark::Choice(true) => '#',
                Mark::Switch(false, _) | Mark::Choice(false) => '.',
            };
            let keys: Vec<_> = command.keys.iter().map(|(caption, _)| *caption).collect();
            format!(
                "{} {mark} {} {}",
                keys.join(" "),
                command.label,
                command.state
            )
        })
        .collect()
}

#[test]
fn the_panel_shows_each_light_mode_projection_camera_and_view_with_its_key_and_state() {
    let mut session = default_session();
    for (keys, expected) in [
        (
            vec![],
            [
                "1 W # white on",
                "G # Gouraud ",
                "O   projection perspective",
                "C   camera 1",
                "Tab   view picture",
            ],
        ),
        (
            vec![Key::W, Key::P, Key::O, Key::C, Key::Tab],
            [
                "1 W . white off",
                "G . Gouraud ",
                "O   projection orthographic",
                "C   camera 2",
                "Tab   view Gouraud | Phong",
            ],
        ),
    ] {
        for key in keys {
            press(&mut session, key);
        }
        let rows = in_words(&hud(&session, SIZE));
        for row in expected {
            assert!(rows.iter().any(|it| it == row), "{row}: {rows:?}");
        }
    }
}

#[test]
fn where_cuboids_differ_no_mode_is_marked() {
    let session = mixed_session();
    let hud = hud(&session, SIZE);
    let rows = commands(&hud, Part::Panel).into_iter();
    let shading = |command: &Command| matches!(command.keys[0].1, Action::Shading(_));
    let marks: Vec<_> = rows
        .filter(|(command, _)| shading(command))
        .map(|(command, _)| command.mark)
        .collect();
    assert_eq!(marks, [Mark::Choice(false); 2]);
}

#[test]
fn lights_beyond_the_ninth_are_counted() {
    let lamps = (0..8).map(|index| {
        format!("[[light]]\nname = \"lamp {index}\"\nkind = \"ambient\"\ncolor = [1.0, 1.0, 1.0]\nintensity = 1.0\n")
    });
    let text: String = [BUILT_IN[0].1.to_owned()]
        .into_iter()
        .chain(lamps)
        .collect();
    let session = session_of(Scene::parse("many.toml", &text).expect("a valid scene"));
    let hud = hud(&session, SIZE);
    let rows = board(&hud, Part::Panel).rows.iter();
    let counted = |line: &Line| matches!(line, Line::Text(text) if text.contains("3 more"));
    assert!(rows.clone().any(|(line, _)| counted(line)));
    assert!(place_of(&hud, Part::Panel, Action::Light(8)).is_some());
}

#[test]
fn the_help_tells_every_key_and_what_the_mouse_does() {
    let mut session = default_session();
    session.apply(Action::Help);
    let hud = hud(&session, SIZE);
    let rows = commands(&hud, Part::Help);
    let lights = session.scene.lights.len();
    for binding in BINDINGS
        .iter()
        .filter(|it| !matches!(it.action, Action::Light(index) if index >= lights))
    {
        for caption in binding.captions {
            let has = |command: &Command| command.keys.contains(&(caption, binding.action));
            let rows = rows.iter().filter(|(command, _)| has(command));
            assert_eq!(rows.count(), 1, "{caption}");
        }
    }
    let all = hud.boards(Part::Help).flat_map(|board| &board.rows);
    let facts: Vec<_> = all
        .filter_map(|(line, _)| match line {
            Line::Fact(name, does) => Some(format!("{name}: {does}")),
            _ => None,
        })
        .collect();
    for word in ["probe", "divider"] {
        assert!(
            facts.iter().any(|it| it.contains(word)),
            "{word}: {facts:?}"
        );
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
        let mut rows = commands(&hud, Part::Help).into_iter();
        rows.find(|(command, _)| command.keys.iter().any(|(_, it)| *it == action))
            .map(|(command, _)| command.state.clone())
    };
    let right = Action::Orbit {
        azimuth: 2.0,
        elevation: 0.0,
    };
    assert_eq!(state(right).as_deref(), Some("4\u{b0}"));
    assert_eq!(state(Action::Zoom(1)).as_deref(), Some("1.10\u{d7}"));
    assert_eq!(state(Action::Light(0)).as_deref(), Some("off"));
}

/// The window's pixels around a picture of one colour.
pub(super) fn pixels(session: &Session, picture: u32) -> Vec<u32> {
    let hud = hud(session, SIZE);
    let rect = hud.picture;
    let mut shown = Vec::new();
    let picture = vec![picture; (rect.width * rect.height) as usize];
    hud.draw(&picture, false, &mut shown);
    shown
}

#[test]
fn on_and_off_differ_without_colour() {
    // The light's colour is what a mark is filled with: without colour there is its brightness left.
    let mut session = default_session();
    let hud = hud(&session, SIZE);
    let rows = commands(&hud, Part::Panel);
    let (_, row) = rows
        .iter()
        .find(|(command, _)| command.keys[0].1 == Action::Light(1))
        .expect("a row");
    let half = Rect {
        width: row.width / 2,
        ..*row
    };
    // Red's mark has neither green nor blue: the row's left half, without the words "on" and "off", in grey.
    let grey = |session: &Session| {
        let pixels = pixels(session, 0);
        let rows =
            (half.y..half.bottom()).flat_map(|y| (half.x..half.right()).map(move |x| (x, y)));
        let pixel = |(x, y)| pixels[y as usize * SIZE[0] + x as usize];
        let brightness = |pixel: u32| {
            pixel
                .to_be_bytes()
                .iter()
                .map(|it| u32::from(*it))
                .sum::<u32>()
        };
        rows.map(|at| brightness(pixel(at))).sum::<u32>()
    };
    let on = grey(&session);
    press(&mut session, Key::R);
    let off = grey(&session);
    assert!(
        on > off + 255 * 20,
        "{on} {off}: a filled mark of many pixels"
    );
}
