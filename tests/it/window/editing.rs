//! The numbers of the scene, changed while they are looked at: by keys, by typing, by the wheel and by dragging lights.

use std::time::Duration;

use fearless_simd::Level;
use glam::DVec3;
use minifb::Key;
use proptest::prelude::*;
use shadetrade::components::{Camera, Light, Transform};
use shadetrade::frame::{Frame, Keep, Workers};
use shadetrade::scene::Scene;
use shadetrade::scene::edit::{Page, Parameter, Property};
use shadetrade::systems;
use shadetrade::window::bindings::{Action, Modifiers, StepSize};
use shadetrade::window::hud::lines::Line;
use shadetrade::window::hud::{Part, picture};
use shadetrade::window::input::{Event, Gesture, Input};
use shadetrade::window::recording::Event as Happened;
use shadetrade::window::saving::{command, save_scene};
use shadetrade::window::session::Session;

use super::hud::{board, hud, place_of};
use super::{MIXED, SIZE, default_session, does, mixed_session, session_of};

/// What is typed, as the system reports it: a key and its character.
fn types(session: &mut Session, text: &str) {
    for letter in text.chars() {
        let key = match letter {
            '1' => Key::Key1,
            '2' => Key::Key2,
            '5' => Key::Key5,
            '7' => Key::Key7,
            '-' => Key::Minus,
            '.' => Key::Period,
            'e' => Key::E,
            'x' => Key::X,
            _ => panic!("no key for {letter}"),
        };
        let mut input = Input::default();
        input.is_editing = session.state.editor.is_some();
        let events = [Event::KeyDown(key), Event::Character(letter)];
        let gestures = events.map(|event| input.handle(event, Duration::ZERO));
        for gesture in gestures.into_iter().flatten() {
            does(session, gesture);
        }
    }
}

/// Presses a key while others are held.
fn press_with(session: &mut Session, held: &[Key], key: Key) {
    let mut input = Input::default();
    input.is_editing = session.state.editor.is_some();
    for key in held.iter().chain([&key]) {
        if let Some(gesture) = input.handle(Event::KeyDown(*key), Duration::ZERO) {
            does(session, gesture);
        }
    }
}

fn press(session: &mut Session, key: Key) {
    press_with(session, &[], key);
}

/// Lets so much time pass that what follows is a step of its own.
fn pause(session: &mut Session, seconds: &mut u64) {
    *seconds += 1;
    session.tick(Duration::from_secs(*seconds));
}

/// Opens the editor and chooses this number of the page.
fn choose(session: &mut Session, property: Property, axis: usize) -> Parameter {
    if session.state.editor.is_none() {
        press(session, Key::E);
    }
    let page = session.page().expect("the editor is open");
    let is_it = |it: &Parameter| it.property == property && it.axis == axis;
    let index = page.parameters.iter().position(is_it).expect("it is here");
    session.apply(Action::ChooseRow(index + 1));
    page.parameters[index]
}

/// Goes to the page of the entity of this name.
fn turn_to(session: &mut Session, name: &str, kind: &str) {
    let pages = session.scene.pages();
    for _ in 0..pages {
        let page = session.page().expect("the editor is open");
        if session.name(page.entity) == name && page.kind == kind {
            return;
        }
        let next = Action::Step {
            row: Some(0),
            steps: 1,
            size: StepSize::Usual,
        };
        session.apply(next);
    }
    panic!("there is no {kind} {name}");
}

fn drawn(session: &mut Session, size: [usize; 2]) -> Vec<u32> {
    let mut frame = Frame::new(Keep::Display, Workers::alone(Level::new()));
    let view = session.view(size);
    systems::draw(&mut session.scene.world, &view, &mut frame).expect("it fits in memory");
    frame.pixels().to_vec()
}

fn said(session: &Session) -> String {
    let hud = hud(session, SIZE);
    let rows = &board(&hud, Part::Editor).rows;
    let words = rows.iter().map(|(line, _)| match line {
        Line::Command(it) => format!("{} {}", it.label, it.state),
        Line::Text(text) => text.clone(),
        _ => String::new(),
    });
    words.collect::<Vec<_>>().join("\n")
}

#[test]
fn every_key_of_the_scene_file_is_a_row_of_some_page() {
    let scene = Scene::load(None).expect("built in");
    let pages: Vec<Page> = (0..scene.pages()).map(|it| scene.page(it)).collect();
    let kinds: Vec<_> = pages.iter().map(|page| page.kind).collect();
    assert_eq!(
        kinds,
        [
            "diffuse light",
            "diffuse light",
            "specular light",
            "ambient light",
            "cuboid",
            "material",
            "camera",
            "camera",
        ]
    );
    let names = |page: &Page| {
        page.parameters
            .iter()
            .map(|it| it.name())
            .collect::<Vec<_>>()
    };
    assert_eq!(
        names(&pages[0]),
        [
            "position x",
            "position y",
            "position z",
            "color red",
            "color green",
            "color blue",
            "intensity",
            "gain",
        ]
    );
    assert_eq!(names(&pages[6]), ["fov", "height", "near"]);
    assert_eq!(names(&pages[4]).len() + names(&pages[5]).len(), 19);
}

#[test]
fn a_typed_number_is_taken_and_one_out_of_range_says_what_is_allowed() {
    let mut session = default_session();
    press(&mut session, Key::E);
    turn_to(&mut session, "emerald", "material");
    let shininess = choose(&mut session, Property::Shininess, 0);
    types(&mut session, "5.5");
    assert!(said(&session).contains("5.5_"), "{}", said(&session));
    assert_eq!(session.scene.number(shininess), 76.8, "not before Enter");
    press(&mut session, Key::Enter);
    assert_eq!(session.scene.number(shininess), 5.5);
    let before = drawn(&mut session, [64, 48]);
    for wrong in ["-1", "1e7", "--", "1e", "-.e"] {
        types(&mut session, wrong);
        press(&mut session, Key::Enter);
        assert_eq!(session.scene.number(shininess), 5.5, "{wrong}");
        assert!(said(&session).contains("0 to 1e6"), "{}", said(&session));
    }
    assert_eq!(drawn(&mut session, [64, 48]), before);
    // The next letter begins anew, Backspace takes it back, and Escape forgets a number before it closes the editor.
    types(&mut session, "7");
    assert!(!said(&session).contains("0 to 1e6"));
    press(&mut session, Key::Backspace);
    types(&mut session, "22");
    press(&mut session, Key::Escape);
    assert!(session.state.editor.is_some());
    press(&mut session, Key::Enter);
    assert_eq!(session.scene.number(shininess), 5.5);
    press(&mut session, Key::Escape);
    assert!(session.state.editor.is_none());
    // Without the editor the digits switch lights.
    types(&mut session, "1");
    assert!(!session.light(0).expect("a light").on);
}

#[test]
fn arrows_and_the_wheel_change_finely_usually_and_coarsely() {
    let mut session = default_session();
    press(&mut session, Key::E);
    turn_to(&mut session, "white", "diffuse light");
    let place = choose(&mut session, Property::Position, 1);
    for (held, key, expected) in [
        (vec![], Key::Right, 10.1),
        (vec![], Key::Left, 10.0),
        (vec![Key::LeftShift], Key::Right, 10.01),
        (vec![Key::RightCtrl], Key::Left, 9.01),
    ] {
        press_with(&mut session, &held, key);
        assert_eq!(session.scene.number(place), expected, "{held:?} {key:?}");
    }
    let row = place_of(&hud(&session, SIZE), Part::Editor, Action::ChooseRow(2));
    let wheel = |notches, shift| Gesture::Wheel {
        at: row.expect("a row"),
        notches,
        modifiers: Modifiers {
            shift,
            control: false,
        },
    };
    does(&mut session, wheel(3, false));
    assert_eq!(session.scene.number(place), 9.31);
    does(&mut session, wheel(-1, true));
    assert_eq!(session.scene.number(place), 9.3);
    assert_eq!(session.orbit().zoom, 0, "the picture is not zoomed");
    // Up and Down choose, and what was typed is taken on the way.
    types(&mut session, "2");
    press(&mut session, Key::Down);
    assert_eq!(session.scene.number(place), 2.0);
    press(&mut session, Key::Right);
    let next = Parameter { axis: 2, ..place };
    assert_eq!(session.scene.number(next), 10.1);
    // Steps of a tenth do not gather rounding.
    for _ in 0..1000 {
        press(&mut session, Key::Right);
    }
    assert_eq!(session.scene.number(next), 110.1);
}

#[test]
fn a_thousand_steps_are_undone_to_the_first_bytes_and_redone_to_the_last() {
    let mut session = default_session();
    let (first, mut seconds) = (drawn(&mut session, [96, 72]), 0);
    press(&mut session, Key::E);
    let mut changes = 0;
    for step in 0.. {
        if changes == 1000 {
            break;
        }
        pause(&mut session, &mut seconds);
        let revision = session.revision;
        let page = session.page().expect("open");
        session.apply(Action::Step {
            row: Some(1 + step % page.parameters.len()),
            steps: 1 + (step % 7) as i32,
            size: StepSize::Usual,
        });
        changes += session.revision - revision;
        if step % 3 == 0 {
            session.apply(Action::Step {
                row: Some(0),
                steps: 1,
                size: StepSize::Usual,
            });
        }
    }
    let last = drawn(&mut session, [96, 72]);
    assert_ne!(first, last);
    let control = [Key::LeftCtrl];
    for _ in 0..1000 {
        press_with(&mut session, &control, Key::Z);
    }
    assert_eq!(drawn(&mut session, [96, 72]), first);
    assert_eq!(session.state.message(), None);
    press_with(&mut session, &control, Key::Z);
    assert!(session.state.message().expect("a word").contains("undo"));
    for _ in 0..1000 {
        press_with(&mut session, &[Key::LeftCtrl, Key::LeftShift], Key::Z);
    }
    assert_eq!(drawn(&mut session, [96, 72]), last);
}

#[test]
fn what_is_held_or_dragged_is_one_step_and_a_switched_light_another() {
    let mut session = mixed_session();
    let mut seconds = 0;
    let size = choose_size(&mut session);
    for _ in 0..5 {
        press(&mut session, Key::Right);
    }
    pause(&mut session, &mut seconds);
    press(&mut session, Key::Right);
    session.apply(Action::Light(0));
    session.apply(Action::Undo);
    assert!(session.light(0).expect("a light").on);
    assert_eq!(session.scene.number(size), 1.6);
    session.apply(Action::Undo);
    assert_eq!(session.scene.number(size), 1.5);
    session.apply(Action::Undo);
    assert_eq!(session.scene.number(size), 1.0);
    session.apply(Action::Redo);
    assert_eq!(session.scene.number(size), 1.5);
    // A new change ends what could be redone.
    pause(&mut session, &mut seconds);
    press(&mut session, Key::Left);
    session.apply(Action::Redo);
    assert_eq!(session.scene.number(size), 1.4);
}

fn choose_size(session: &mut Session) -> Parameter {
    press(session, Key::E);
    turn_to(session, "left", "cuboid");
    choose(session, Property::Size, 0)
}

/// The default scene seen from so far away that its lights are in the picture, the editor open.
fn lights_in_sight(projection: Action) -> Session {
    let mut session = default_session();
    session.apply(projection);
    session.apply(Action::Zoom(-20));
    press(&mut session, Key::E);
    drawn(&mut session, [8, 6]);
    session
}

/// Where the disc of the lights is in the window.
fn disc(session: &Session) -> [i32; 2] {
    let hud = hud(session, SIZE);
    let mut found = Vec::new();
    for y in 0..SIZE[1] as i32 {
        for x in 0..SIZE[0] as i32 {
            if hud.light_at([x, y]).is_some() {
                found.push([x, y]);
            }
        }
    }
    let count = found.len() as i32;
    assert!(count > 0, "there is a disc");
    [0, 1].map(|axis| found.iter().map(|at| at[axis]).sum::<i32>() / count)
}

fn places(session: &Session) -> Vec<DVec3> {
    let scene = &session.scene;
    let place = |&light| {
        scene
            .world
            .get::<&Transform>(light)
            .expect("a light")
            .position
    };
    scene.lights[..3].iter().map(place).collect()
}

#[test]
fn lights_at_one_place_follow_the_mouse_together_and_come_back_in_one_step() {
    use shadetrade::components::Projection::{Orthographic, Perspective};
    for projection in [Perspective, Orthographic] {
        let mut session = lights_in_sight(Action::Projection(projection));
        let before = places(&session);
        let from = disc(&session);
        let drag = |by, shift| Gesture::Drag {
            from,
            by,
            modifiers: Modifiers {
                shift,
                control: false,
            },
        };
        for by in [[-30, 10], [-20, 15], [5, 5]] {
            does(&mut session, drag(by, false));
        }
        let [x, y] = disc(&session);
        let [expected_x, expected_y] = [from[0] - 45, from[1] + 30];
        assert!(
            (x - expected_x).abs() <= 1 && (y - expected_y).abs() <= 1,
            "{x} {y}"
        );
        let view = session.view(SIZE).viewpoint;
        let [_, _, forward] = view.axes();
        let moved = places(&session)[0] - before[0];
        assert!(
            forward.dot(moved).abs() < 1e-9,
            "in the plane that faces the viewer"
        );
        assert!(
            places(&session)
                .iter()
                .all(|place| *place == places(&session)[0])
        );
        // Up is away from the viewer.
        does(&mut session, drag([40, -25], true));
        let away = places(&session)[0] - before[0] - moved;
        assert!(forward.dot(away) > 0.9 * away.length() && away.length() > 0.0);
        does(&mut session, Gesture::Command(Action::EndDrag));
        session.apply(Action::Undo);
        assert_eq!(places(&session), before);
        assert_eq!(session.orbit().azimuth, 0.0, "the camera has not moved");
    }
}

#[test]
fn a_disc_is_filled_where_its_light_is_on_and_nothing_hides_it() {
    use shadetrade::window::hud::markers::markers;
    let text = MIXED.replace(
        "kind = \"ambient\"",
        "kind = \"diffuse\"\nposition = [0, 0, 1]",
    );
    // In front of the left cuboid, behind it, and beside both.
    for (place, is_lit) in [
        ("[-2, 0, 3]", true),
        ("[-2, 0, -3]", false),
        ("[0, 1.5, -3]", true),
    ] {
        let text = text.replace("position = [0, 0, 1]", &format!("position = {place}"));
        let mut session = session_of(Scene::parse("scene", &text).expect("a scene"));
        drawn(&mut session, [96, 72]);
        let found = markers(&session, [96, 72]);
        assert_eq!(found.len(), 1, "{place}");
        assert_eq!(found[0].is_lit, is_lit, "{place}");
        session.apply(Action::Light(0));
        assert!(!markers(&session, [96, 72])[0].is_lit);
    }
    // At a distance of 7 of a picture that sees 15 degrees up: one unit is 72 / 2 / (7 tan 15) pixels.
    let text = text.replace("position = [0, 0, 1]", "position = [1, 1, 3]");
    let mut session = session_of(Scene::parse("scene", &text).expect("a scene"));
    drawn(&mut session, [96, 72]);
    let unit = 36.0 / (7.0 * 15.0_f64.to_radians().tan());
    let expected = [48.0 + unit, 36.0 - unit].map(|at| at.floor() as i32);
    assert_eq!(markers(&session, [96, 72])[0].at, expected);
    // Behind the eye and beside the picture there is none.
    for place in ["[0, 0, 11]", "[90, 0, 0]"] {
        let text = text.replace("position = [1, 1, 3]", &format!("position = {place}"));
        let session = session_of(Scene::parse("scene", &text).expect("a scene"));
        assert_eq!(markers(&session, [96, 72]), [], "{place}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]

    #[test]
    fn a_number_is_taken_exactly_where_the_scene_file_allows_it(
        page in 0..8_usize,
        row in any::<prop::sample::Index>(),
        number in prop_oneof![
            -1e3..1e3, any::<f64>(),
            prop::sample::select(vec![0.0, 5e-324, 179.0, 179.1, 1e6, 1.1e6, 1e30, 1.1e30, 1e100, 1.1e100, 1e-100, 9e-101, f64::NAN])
        ],
    ) {
        let mut scene = Scene::load(None).expect("built in");
        let page = scene.page(page);
        let parameter = *row.get(&page.parameters);
        let before = scene.to_toml();
        let taken = scene.set_number(parameter, number).is_ok();
        let after = scene.to_toml();
        prop_assert_eq!(taken || before == after, true);
        if taken {
            prop_assert_eq!(scene.number(parameter), number);
            prop_assert_eq!(Scene::parse("again", &after).expect("allowed").to_toml(), after);
        } else {
            // The same number written into the file is refused there too.
            let mut other = scene.snapshot();
            let parameter = other.page((0..8).find(|it| scene.page(*it) == page).expect("a page")).parameters
                .into_iter().find(|it| (it.property, it.axis) == (parameter.property, parameter.axis)).expect("the same");
            write_anyhow(&mut other, parameter, number);
            prop_assert!(Scene::parse("again", &other.to_toml()).is_err(), "{} {number:e}", parameter.name());
        }
    }
}

/// Writes a number into a component, allowed or not.
fn write_anyhow(scene: &mut Scene, parameter: Parameter, number: f64) {
    use shadetrade::components::{Material, Mesh};
    let Parameter {
        entity,
        property,
        axis,
    } = parameter;
    let world = &scene.world;
    let light = || world.get::<&mut Light>(entity).expect("a light");
    let camera = || world.get::<&mut Camera>(entity).expect("a camera");
    let material = || world.get::<&mut Material>(entity).expect("a cuboid");
    let place = || {
        world
            .get::<&mut Transform>(entity)
            .expect("it stands somewhere")
    };
    match property {
        Property::Position => place().position[axis] = number,
        Property::Rotation => place().rotation[axis] = number,
        Property::Size => {
            let mut mesh = world.get::<&mut Mesh>(entity).expect("a cuboid");
            let mut size = mesh.size();
            size[axis] = number;
            *mesh = Mesh::cuboid(size);
        }
        Property::Ambient => material().ambient[axis] = number,
        Property::Diffuse => material().diffuse[axis] = number,
        Property::Specular => material().specular[axis] = number,
        Property::Shininess => material().shininess = number,
        Property::Color => light().color[axis] = number,
        Property::Intensity => light().intensity = number,
        Property::Gain => light().gain = number,
        Property::FieldOfView => camera().fov = number,
        Property::Height => camera().height = number,
        Property::Near => camera().near = Some(number),
    }
}

#[test]
fn a_saved_scene_is_drawn_as_it_was_shown_and_replaces_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("cuboid-1.toml"), "mine").expect("written");
    let mut session = default_session();
    press(&mut session, Key::E);
    turn_to(&mut session, "emerald", "material");
    choose(&mut session, Property::Shininess, 0);
    types(&mut session, "12.5");
    press(&mut session, Key::Enter);
    for action in [
        Action::Light(2),
        Action::Orbit {
            azimuth: 33.0,
            elevation: -12.0,
        },
        Action::Zoom(-2),
        Action::Turning,
    ] {
        session.apply(action);
    }
    session.tick(Duration::from_secs(2));
    session.apply(Action::Turning);
    for projection in 0..2 {
        let path = save_scene(folder.path(), &session).expect("saved");
        let name = format!("cuboid-{}.toml", 2 + projection);
        assert_eq!(path.file_name().expect("a name"), name.as_str());
        let saved = Scene::load_path(&path).expect("a scene");
        assert_eq!(saved.camera_names(), ["view", "1", "2"]);
        assert_eq!(
            saved.camera(1).0,
            session.scene.camera(0).0,
            "the others stand where they stood"
        );
        let mut again = session_of(saved);
        if projection == 1 {
            again.apply(Action::NextProjection);
        }
        assert_eq!(
            drawn(&mut again, [160, 120]),
            drawn(&mut session, [160, 120])
        );
        // Saved again, the view is called by another name.
        let twice = save_scene(folder.path(), &again).expect("saved");
        assert_eq!(
            Scene::load_path(&twice).expect("a scene").camera_names()[0],
            "view-2"
        );
        std::fs::remove_file(twice).expect("removed");
        let line = command(&session, &name, [160, 120]);
        for word in [
            session.projection.name(),
            "--size 160x120",
            "--tolerance 0.5",
            &name,
        ] {
            assert!(line.contains(word), "{line}");
        }
        session.apply(Action::NextProjection);
    }
    let kept = std::fs::read(folder.path().join("cuboid-1.toml")).expect("read");
    assert_eq!(kept, b"mine");
}

/// The scene's file as it is read again.
fn read(text: &str) -> Happened {
    Scene::parse("mixed.toml", text).into()
}

#[test]
fn a_scene_read_again_keeps_the_view_and_a_wrong_one_keeps_the_picture() {
    let mut session = session_of(Scene::parse("mixed.toml", MIXED).expect("a scene"));
    let zoomed = |session: &Session| (session.orbit().zoom, session.shading());
    session.apply(Action::Zoom(-3));
    press(&mut session, Key::P);
    let (before, view) = (drawn(&mut session, [64, 48]), zoomed(&session));
    session.happens(read("size = 3\n"));
    assert_eq!(drawn(&mut session, [64, 48]), before);
    let words = session.state.scene_error.clone().expect("it is said");
    assert!(words.contains("mixed.toml:1:1"), "{words}");
    assert!(
        hud(&session, SIZE)
            .boards(Part::SceneError)
            .next()
            .is_some()
    );
    let edited = MIXED.replace("size = [1.0, 1.0, 1.0]", "size = [2.0, 1.0, 1.0]");
    session.happens(read(&edited));
    assert_eq!(session.state.scene_error, None);
    assert_eq!(zoomed(&session), view);
    assert_ne!(drawn(&mut session, [64, 48]), before);
    session.apply(Action::Undo);
    assert_eq!(drawn(&mut session, [64, 48]), before);
    assert_eq!(picture(&session, SIZE).height, SIZE[1] as i32);
}
