//! The window's state, tested without a display: what keys and clicks do to the scene and to what is seen.
//! The real window is opened in `tests/window`.

mod editing;
mod examination;
mod fit;
mod hud;
mod input;
mod jobs;
mod letters;
#[cfg(target_os = "linux")]
mod libraries;
mod magnifier;
mod orbit;
mod pointing;
mod probing;
mod recording;
mod requires;
mod screenshot;
mod storms;
mod views;

use std::time::Duration;

use fearless_simd::Level;
use minifb::Key;
use shadetrade::components::{Projection, ShadingMode, Spin, Transform};
use shadetrade::drawing::Drawing;
use shadetrade::frame::Workers;
use shadetrade::scene::Scene;
use shadetrade::window::bindings::{Action, BINDINGS, Section};
use shadetrade::window::composition::{Composition, FRAMES};
use shadetrade::window::hud::{Hud, lines};
use shadetrade::window::input::{Event, Gesture, Input};
use shadetrade::window::response::respond;
use shadetrade::window::session::{Redraw, Request, Session};

use crate::support::window::{SIZE, default_session, drawing, session_of};

/// Two cuboids of different modes, a light that no key is named after, one camera.
const MIXED: &str = r#"
[[cuboid]]
name = "left"
size = [1.0, 1.0, 1.0]
position = [-2.0, 0.0, 0.0]
rotation = [10.5, 20.0, 30.0]
shading = "gouraud"
material = { ambient = [1.0, 1.0, 1.0], diffuse = [1.0, 1.0, 1.0], specular = [1.0, 1.0, 1.0], shininess = 1.0 }
[[cuboid]]
name = "right"
size = [1.0, 1.0, 1.0]
position = [2.0, 0.0, 0.0]
shading = "phong"
material = { ambient = [1.0, 1.0, 1.0], diffuse = [1.0, 1.0, 1.0], specular = [1.0, 1.0, 1.0], shininess = 1.0 }
[[light]]
name = "lamp"
kind = "ambient"
color = [1.0, 1.0, 1.0]
intensity = 10.0
[[camera]]
name = "only"
position = [0.0, 0.0, 10.0]
target = [0.0, 0.0, 0.0]
fov = 30.0
height = 6.0
near = 0.5
"#;

/// The window as it opens on two cuboids of different modes.
fn mixed_session() -> Session {
    session_of(Scene::parse("mixed.toml", MIXED).expect("the scene above is valid"))
}

/// Presses and releases a key; what that does.
fn press(session: &mut Session, key: Key) -> Option<Action> {
    let mut input = Input::default();
    let gesture = input.handle(Event::KeyDown(key), Duration::ZERO)?;
    does(session, gesture)
}

/// What the user does in a window of [`SIZE`].
fn does(session: &mut Session, gesture: Gesture) -> Option<Action> {
    let hud = Hud::new(session, SIZE);
    respond(session, gesture, &hud)
}

fn lights_on(session: &Session) -> Vec<bool> {
    (0..)
        .map_while(|index| session.light(index))
        .map(|light| light.on)
        .collect()
}

#[test]
fn the_window_opens_on_what_the_scene_says() {
    let mut session = default_session();
    assert_eq!(lights_on(&session), [true; 4]);
    assert_eq!(session.shading(), Some(ShadingMode::Gouraud));
    assert_eq!(session.view(SIZE).shading, None);
    assert_eq!(session.projection, Projection::Perspective);
    assert_eq!(session.view(SIZE).viewpoint, session.scene.camera(0).0);
    assert_eq!(session.view(SIZE).tolerance, 0.5);
    assert!(session.state.panel);
    assert_eq!(session.take_redraw(), Redraw::Picture);
    assert_eq!(session.take_redraw(), Redraw::Nothing);
}

#[test]
fn digits_switch_lights_in_the_order_of_the_file_and_letters_by_name() {
    let digits = [Key::Key1, Key::Key2, Key::Key3, Key::Key4];
    let letters = [Key::W, Key::R, Key::S, Key::A];
    for (index, keys) in digits.into_iter().zip(letters).enumerate() {
        for key in <[Key; 2]>::from(keys) {
            let mut session = default_session();
            press(&mut session, key);
            let expected: Vec<bool> = (0..4).map(|light| light != index).collect();
            assert_eq!(lights_on(&session), expected, "{key:?}");
            assert_eq!(session.take_redraw(), Redraw::Picture);
            press(&mut session, key);
            assert_eq!(lights_on(&session), [true; 4], "{key:?} twice");
        }
    }
}

#[test]
fn a_light_that_does_not_exist_is_said_for_two_seconds() {
    let mut session = mixed_session();
    for (key, words) in [
        (Key::W, "no light is named white"),
        (Key::Key7, "there is no light 7"),
    ] {
        session.tick(Duration::from_secs(10));
        press(&mut session, key);
        assert_eq!(session.state.message(), Some(words));
        session.take_redraw();
        session.tick(Duration::from_millis(11_999));
        assert_eq!(session.state.message(), Some(words));
        assert_eq!(session.take_redraw(), Redraw::Nothing);
        session.tick(Duration::from_secs(12));
        assert_eq!(session.state.message(), None);
        assert_eq!(session.take_redraw(), Redraw::Overlay);
    }
    assert_eq!(lights_on(&session), [true]);
}

#[test]
fn g_and_p_shade_every_cuboid_and_there_is_a_way_back_to_what_the_scene_says() {
    let mut session = mixed_session();
    let scene_says = modes(&session);
    assert_eq!(session.shading(), None, "the cuboids differ");
    for (key, mode) in [(Key::P, ShadingMode::Phong), (Key::G, ShadingMode::Gouraud)] {
        press(&mut session, key);
        assert_eq!(modes(&session), [mode; 2]);
        assert_eq!(session.shading(), Some(mode));
        session.take_redraw();
        session.apply(Action::SceneShading);
        assert_eq!(modes(&session), scene_says);
        assert_eq!(session.take_redraw(), Redraw::Picture);
    }
}

#[test]
fn the_command_line_shades_every_cuboid_when_the_window_opens() {
    let session = Session::new(Drawing {
        shading: Some(ShadingMode::Phong),
        ..drawing(Scene::parse("mixed.toml", MIXED).expect("the scene above is valid"))
    });
    assert_eq!(modes(&session), [ShadingMode::Phong; 2]);
}

/// How the cuboids are shaded, in file order.
fn modes(session: &Session) -> Vec<ShadingMode> {
    values(session, |mode: &ShadingMode| *mode)
}

/// What every cuboid's component says, in file order.
fn values<C: hecs::Component, T>(session: &Session, read: impl Fn(&C) -> T) -> Vec<T> {
    let scene = &session.scene;
    let value = |&cuboid| read(&*scene.world.get::<&C>(cuboid).expect("a cuboid has it"));
    scene.cuboids.iter().map(value).collect()
}

#[test]
fn brackets_and_page_keys_step_the_tolerance() {
    for [finer, coarser] in [
        [Key::LeftBracket, Key::RightBracket],
        [Key::PageDown, Key::PageUp],
    ] {
        let mut session = default_session();
        let mut steps = |key| {
            let mut seen = Vec::new();
            for _ in 0..7 {
                press(&mut session, key);
                seen.push(session.view(SIZE).tolerance);
            }
            (seen, session.state.message().map(str::to_owned))
        };
        let (seen, words) = steps(coarser);
        assert_eq!(seen, [1.0, 2.0, 4.0, 8.0, 8.0, 8.0, 8.0]);
        assert_eq!(words.as_deref(), Some("no coarser than this"));
        let (seen, words) = steps(finer);
        assert_eq!(seen, [4.0, 2.0, 1.0, 0.5, 0.25, 0.0, 0.0]);
        assert_eq!(words.as_deref(), Some("no finer than exact"));
    }
}

#[test]
fn o_changes_the_projection_and_back() {
    let mut session = default_session();
    press(&mut session, Key::O);
    assert_eq!(session.view(SIZE).projection, Projection::Orthographic);
    press(&mut session, Key::O);
    assert_eq!(session.view(SIZE).projection, Projection::Perspective);
}

#[test]
fn c_goes_round_the_cameras_as_the_scene_has_them() {
    let mut session = default_session();
    press(&mut session, Key::Left);
    press(&mut session, Key::C);
    assert_eq!(session.view(SIZE).viewpoint, session.scene.camera(1).0);
    press(&mut session, Key::C);
    assert_eq!(session.view(SIZE).viewpoint, session.scene.camera(0).0);
    let mut lonely = mixed_session();
    press(&mut lonely, Key::C);
    assert_eq!(lonely.state.message(), Some("there is one camera"));
}

#[test]
fn home_undoes_orbit_zoom_and_turning_bit_for_bit() {
    let mut session = default_session();
    for key in [Key::Left, Key::Up, Key::Equal, Key::Space] {
        press(&mut session, key);
    }
    session.tick(Duration::from_millis(95));
    assert_ne!(session.view(SIZE).viewpoint, session.scene.camera(0).0);
    assert_eq!(angles(&session), [3]);
    press(&mut session, Key::Home);
    assert_eq!(session.view(SIZE).viewpoint, session.scene.camera(0).0);
    assert_eq!(angles(&session), [0]);
}

/// How far the cuboids have turned, in degrees.
fn angles(session: &Session) -> Vec<u32> {
    values(session, |spin: &Spin| spin.degrees)
}

#[test]
fn space_turns_one_degree_in_thirty_milliseconds_about_the_own_x_axis() {
    let mut session = mixed_session();
    let place = |transform: &Transform| *transform;
    let places = values(&session, place);
    session.tick(Duration::from_secs(1));
    press(&mut session, Key::Space);
    session.take_redraw();
    session.tick(Duration::from_millis(1029));
    assert_eq!(
        (angles(&session), session.take_redraw()),
        (vec![0, 0], Redraw::Nothing)
    );
    session.tick(Duration::from_millis(1030));
    assert_eq!(
        (angles(&session), session.take_redraw()),
        (vec![1, 1], Redraw::Picture)
    );
    // However seldom the time is told, nothing is lost: 100 degrees in 3 s.
    session.tick(Duration::from_secs(4));
    assert_eq!(angles(&session), [100, 100]);
    // A full turn ends where it began.
    session.tick(Duration::from_millis(1000 + 360 * 30));
    assert_eq!(angles(&session), [0, 0]);
    press(&mut session, Key::Space);
    session.tick(Duration::from_secs(100));
    assert_eq!(angles(&session), [0, 0]);
    assert_eq!(values(&session, place), places, "the scene keeps its own");
}

#[test]
fn escape_closes_the_help_and_never_quits() {
    let mut session = default_session();
    press(&mut session, Key::F1);
    assert!(session.state.help);
    assert_eq!(press(&mut session, Key::Escape), Some(Action::Help));
    assert!(!session.state.help);
    assert_eq!(press(&mut session, Key::Escape), Some(Action::Close));
    let words = session.state.message().expect("a word");
    assert!(words.contains("Q quits"));
    assert_eq!(press(&mut session, Key::Q), Some(Action::Quit));
    assert_eq!(press(&mut session, Key::F12), Some(Action::Screenshot));
}

#[test]
fn every_key_and_every_character_calls_up_one_command() {
    for (index, binding) in BINDINGS.iter().enumerate() {
        for other in &BINDINGS[index + 1..] {
            assert!(
                binding.modifiers != other.modifiers
                    || (binding.section == Section::EDITOR) != (other.section == Section::EDITOR)
                    || binding.keys.iter().all(|key| !other.keys.contains(key)),
                "{binding:?}"
            );
            assert!(
                binding
                    .characters
                    .iter()
                    .all(|it| !other.characters.contains(it)),
                "{binding:?}"
            );
            assert_ne!(binding.action, other.action);
        }
        let named =
            binding.section == Section::LIGHTS || matches!(binding.action, Action::Shading(_));
        assert_eq!(binding.says.is_empty(), named, "{binding:?}");
    }
}

#[test]
fn the_frame_around_the_window_tells_the_state_and_how_to_get_panel_and_help() {
    let mut session = default_session();
    for words in ["cuboid", "Gouraud", "perspective", "camera 1", "H for help"] {
        assert!(lines::title(&session, true).contains(words), "{words}");
    }
    for key in [Key::P, Key::O, Key::C] {
        press(&mut session, key);
    }
    for words in ["Phong", "orthographic", "camera 2"] {
        assert!(lines::title(&session, true).contains(words), "{words}");
    }
    assert!(lines::title(&session, false).contains("no room for the panel"));
    press(&mut session, Key::I);
    assert!(lines::title(&session, false).contains("I for the panel"));
}

#[test]
fn the_spread_of_times_is_their_quartiles() {
    assert_eq!(lines::quartiles(&[]), None);
    let spread = |times: &[u64]| {
        let times: Vec<_> = times.iter().map(|it| Duration::from_millis(*it)).collect();
        let spread = lines::quartiles(&times).expect("there are times");
        spread.map(|it| it.as_millis())
    };
    assert_eq!(spread(&[7]), [7, 7, 7]);
    assert_eq!(spread(&[9, 1, 8, 2, 7, 3, 6, 4, 5]), [3, 5, 7]);
    assert_eq!(spread(&[4, 3, 2, 1]), [1, 2, 3]);
}

/// How many frames of each side are timed when it is drawn, whether more are asked for when it has rested for long
/// enough, and how many are timed then.
fn timed(
    session: &mut Session,
    composition: &mut Composition,
    now: u64,
) -> ([usize; 2], bool, [usize; 2]) {
    if session.take_redraw() == Redraw::Picture {
        composition
            .draw(session, [96, 72])
            .expect("there is memory");
    }
    let frames = |session: &Session| session.times.sides.each_ref().map(Vec::len);
    let first = frames(session);
    session.tick(Duration::from_millis(now));
    let asked = session.take_requests().contains(&Request::Time);
    if asked {
        composition.time(session).expect("there is memory");
    }
    (first, asked, frames(session))
}

#[test]
fn whatever_is_shown_is_timed_when_it_rests_and_what_moves_is_not() {
    let mut session = default_session();
    let mut composition = Composition::new(Workers::alone(Level::new()));
    let once = ([1, 0], true, [FRAMES, 0]);
    let known = ([FRAMES, 0], false, [FRAMES, 0]);
    assert_eq!(timed(&mut session, &mut composition, 101), once);
    assert_eq!(timed(&mut session, &mut composition, 202), known);
    for (key, now) in [(Key::P, 303), (Key::LeftBracket, 404), (Key::W, 505)] {
        press(&mut session, key);
        assert_eq!(timed(&mut session, &mut composition, now), once, "{key:?}");
    }
    press(&mut session, Key::Tab);
    let both = ([1, 1], true, [FRAMES, FRAMES]);
    assert_eq!(timed(&mut session, &mut composition, 606), both);
    press(&mut session, Key::Space);
    for now in (640..2000).step_by(30) {
        let (_, asked, _) = timed(&mut session, &mut composition, now);
        assert!(!asked, "it turns");
    }
}

#[test]
fn zooming_past_the_end_says_so() {
    let mut session = default_session();
    session.apply(Action::Zoom(1000));
    assert_eq!(session.state.message(), None);
    session.apply(Action::Zoom(1));
    assert_eq!(session.state.message(), Some("no closer than this"));
    session.apply(Action::Zoom(-10_000));
    session.apply(Action::Zoom(-1));
    assert_eq!(session.state.message(), Some("no further than this"));
}
