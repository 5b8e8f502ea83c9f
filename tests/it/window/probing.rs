//! A click on the picture, and what is then said of that pixel.

use fearless_simd::Level;
use minifb::Key;
use shadetrade::canvas::Point;
use shadetrade::probe;
use shadetrade::scene::{BUILT_IN, Scene};
use shadetrade::window::bindings::Action;
use shadetrade::window::hud::lines::Line;
use shadetrade::window::hud::pixel::lines;
use shadetrade::window::hud::{Part, picture};
use shadetrade::window::input::Gesture;
use shadetrade::window::session::{Redraw, Session};

use super::fit::drawn;
use super::hud::{board, hud, pixels};
use super::{SIZE, default_session, does, press, session_of};

/// The picture's size in pixels.
fn picture_size(session: &Session) -> [usize; 2] {
    let rect = picture(session, SIZE);
    rect.size()
}

fn update(session: &mut Session) {
    session
        .update_probe(picture_size(session))
        .expect("there is memory");
}

/// Clicks on this pixel of the picture.
fn click(session: &mut Session, [x, y]: Point) {
    let rect = picture(session, SIZE);
    does(session, Gesture::Click([rect.x + x, rect.y + y]));
    update(session);
}

/// A pixel of the picture on the cuboid.
const ON_CUBOID: Point = [300, 300];

fn texts(lines: &[Line]) -> Vec<String> {
    let text = |line: &Line| match line {
        Line::Title(name, detail) => format!("{name} {detail}"),
        Line::Text(text) => text.clone(),
        Line::Rule => String::new(),
        _ => panic!("{line:?}"),
    };
    lines.iter().map(text).collect()
}

#[test]
fn a_click_looks_at_a_pixel_and_another_one_moves_on() {
    let mut session = default_session();
    session.take_redraw();
    click(&mut session, ON_CUBOID);
    assert_eq!(session.take_redraw(), Redraw::Picture);
    assert_eq!(session.probe.as_ref().map(|it| it.pixel), Some([300, 300]));
    click(&mut session, [200, 600]);
    assert_eq!(session.probe.as_ref().map(|it| it.pixel), Some([200, 600]));
    assert_eq!(session.revision, 0, "looking changes nothing");
}

#[test]
fn what_is_said_follows_the_picture() {
    let mut session = default_session();
    click(&mut session, ON_CUBOID);
    let before = session.probe.clone();
    press(&mut session, Key::R);
    update(&mut session);
    let after = session.probe.clone();
    assert_ne!(before, after);
    let view = session.view(picture_size(&session));
    let mut scene = session.scene.snapshot();
    let expected = probe::at(&mut scene, &view, [300, 300], Level::new()).expect("there is memory");
    assert_eq!(after, Some(expected));
}

#[test]
fn a_click_on_what_is_said_or_escape_closes_it() {
    let mut session = default_session();
    for by_key in [true, false] {
        click(&mut session, ON_CUBOID);
        let board = board(&hud(&session, SIZE), Part::Probe).rect;
        if by_key {
            press(&mut session, Key::Escape);
        } else {
            does(&mut session, Gesture::Click([board.x + 20, board.y + 20]));
        }
        assert!(session.probe.is_none());
        assert_eq!(session.take_requests(), []);
    }
}

#[test]
fn a_pixel_that_the_window_no_longer_has_is_no_longer_looked_at() {
    let mut session = default_session();
    click(&mut session, ON_CUBOID);
    session.update_probe([250, 400]).expect("there is memory");
    assert!(session.probe.is_none());
    click(&mut session, [-1, 5]);
    click(&mut session, [5, SIZE[1] as i32]);
    assert!(session.probe.is_none());
}

#[test]
fn the_pixel_itself_is_never_covered() {
    let mut session = default_session();
    for pixel in [[300, 300], [20, 20], [500, 600], [310, 360]] {
        session.apply(Action::Probe(Some(pixel)));
        let hud = drawn(&mut session, SIZE);
        let point = [hud.picture.x as usize + pixel[0], pixel[1]];
        let shown = pixels(&session, 0x0001_0203);
        let at = |x: usize| shown[point[1] * SIZE[0] + x];
        assert_eq!(at(point[0]), 0x0001_0203, "seen within the cross");
        assert_ne!(at(point[0] - 5), 0x0001_0203, "the cross");
    }
}

#[test]
fn all_that_the_probe_knows_is_said() {
    let mut session = default_session();
    click(&mut session, ON_CUBOID);
    let probe = session.probe.as_ref().expect("looked at").clone();
    let surface = probe.surface.clone().expect("the cuboid");
    for [wide, worked] in [[true, false], [false, false], [true, true], [false, true]] {
        let said = texts(&lines(&probe, wide, worked));
        assert!(
            said.iter()
                .all(|line| line.chars().count() <= if wide { 70 } else { 40 })
        );
        let row = |name: &str| {
            said.iter()
                .filter(|it| it.starts_with(name))
                .cloned()
                .collect::<Vec<_>>()
        };
        assert!(row("emerald")[0].contains(&surface.triangle_label()));
        for (name, vector) in [("normal n", surface.normal), ("to eye o", surface.to_eye)] {
            let words: Vec<String> = row(name)[0]
                .split_whitespace()
                .skip(name.split(' ').count())
                .map(str::to_owned)
                .collect();
            let numbers: Vec<f64> = words
                .iter()
                .map(|it| it.parse().expect("a number"))
                .collect();
            let vector = vector.expect("known").to_array();
            assert!(
                numbers
                    .iter()
                    .zip(vector)
                    .all(|(a, b)| (a - b).abs() <= 0.0005),
                "{words:?}"
            );
        }
        // Three lights at one place: one l and one r.
        assert_eq!(said.iter().filter(|it| it.contains(" l  ")).count(), 1);
        assert_eq!(row("reflected r").len(), 1);
        // Every light's term, the sums and the bytes, once for each mode.
        let bytes =
            [surface.gouraud.bytes, surface.phong.bytes].map(|it| it.map(|byte| byte.to_string()));
        let told: Vec<String> = row("bytes")
            .iter()
            .flat_map(|it| it.split_whitespace().skip(1))
            .map(str::to_owned)
            .collect();
        assert_eq!(told, bytes.concat());
        let each = if wide { 1 } else { 2 };
        for name in ["drawn", "reference", "levels"] {
            assert_eq!(row(name).len(), each, "{name}: {said:?}");
        }
        // And exact Phong as products.
        for name in ["white", "red", "specular", "ambient"] {
            let tables = 1 + usize::from(worked);
            assert_eq!(row(name).len(), each * tables, "{name}: {said:?}");
        }
        assert_eq!(row("exact Phong").len(), if worked { each } else { 0 });
        // The headings end where the numbers end.
        let ends = |line: &str| {
            let letters: Vec<char> = line.chars().skip(11).chain([' ']).collect();
            let last = |at: &usize| letters[*at] != ' ' && letters[at + 1] == ' ';
            (0..letters.len() - 1).filter(last).collect::<Vec<_>>()
        };
        assert_eq!(ends(&row("levels")[0]), ends(&row("drawn")[0]));
        assert_eq!(ends(&said[2]), ends(&row("position")[0]), "x y z");
    }
    // Without the boards of the pixel before, which may lie over this one.
    session.apply(Action::Probe(None));
    click(&mut session, [600, 10]);
    let background = session.probe.as_ref().expect("looked at");
    assert!(texts(&lines(background, true, false))[1].contains("background"));
}

#[test]
fn lights_at_two_places_have_two_directions_and_nothing_is_said_to_be_almost_nothing() {
    let text = BUILT_IN[0].1.replacen(
        "position = [10.0, 10.0, 10.0]   #",
        "position = [9.0, 9.0, 10.0] #",
        1,
    );
    let mut session = session_of(Scene::parse("two.toml", &text).expect("a valid scene"));
    click(&mut session, ON_CUBOID);
    let said = texts(&lines(
        session.probe.as_ref().expect("looked at"),
        true,
        false,
    ));
    assert_eq!(
        said.iter()
            .filter(|it| it.starts_with("reflected r"))
            .count(),
        2
    );
    // Far from the highlight a specular term of shininess 76.8 is far below any level that can be seen.
    let tiny = |line: &&String| line.contains("e-1") || line.contains("e-2");
    assert_eq!(said.iter().find(tiny), None);
}

#[test]
fn the_profile_has_what_the_probe_says_of_the_pixel_and_shows_the_highlight_gouraud_misses() {
    let mut session = default_session();
    click(&mut session, ON_CUBOID);
    let (probe, profile) = (session.probe.as_ref(), session.profile.as_ref());
    let (probe, profile) = (probe.expect("probed"), profile.expect("probed"));
    let surface = probe.surface.as_ref().expect("a cuboid is there");
    let x = probe.pixel[0];
    assert_eq!(profile.gouraud[x], surface.gouraud.levels);
    assert_eq!(profile.phong[x], surface.phong.levels);
    let exact = surface.reference.phong.expect("it is seen").levels;
    assert_eq!(profile.reference[x], exact);
    for curve in [&profile.gouraud, &profile.phong, &profile.reference] {
        assert_eq!(curve.len(), picture_size(&session)[0]);
        assert_eq!(curve[0], session.scene.background.to_array());
    }
    // Along the row through the highlight Phong is far above Gouraud, and as the reference.
    session.apply(Action::Probe(None));
    click(&mut session, [383, 327]);
    let profile = session.profile.as_ref().expect("probed");
    let highest = |curve: &[[f64; 3]]| {
        let blue = curve.iter().map(|levels| levels[2]);
        let lit = blue.filter(|blue| *blue != session.scene.background.z);
        lit.fold(0.0, f64::max)
    };
    let [gouraud, phong, exact] =
        [&profile.gouraud, &profile.phong, &profile.reference].map(|curve| highest(curve));
    assert!(phong > gouraud + 100.0, "{gouraud} {phong}");
    assert!((phong - exact).abs() < 1.0, "{phong} {exact}");
    let hud = hud(&session, SIZE);
    assert!(hud.boards(Part::Profile).next().is_some());
    // It closes with the probe.
    session.apply(Action::Probe(None));
    assert_eq!(session.profile.as_ref(), None);
}

#[test]
fn arrows_lean_as_the_vectors_do() {
    use shadetrade::window::bindings::Action;
    use shadetrade::window::hud::arrows::arrows;
    let mut session = default_session();
    click(&mut session, ON_CUBOID);
    let viewpoint = session.scene.viewpoint(0);
    let [right, up, _] = viewpoint.axes();
    let surface = session.probe.as_ref().expect("probed").surface.clone();
    let surface = surface.expect("a cuboid is there");
    let light = surface.lights.iter().find(|it| it.to_light.is_some());
    let light = light.expect("a point light");
    let expected = [
        ("n", surface.normal),
        ("o", surface.to_eye),
        ("l", light.to_light),
        ("r", light.reflected),
    ];
    let found = arrows(&session, &viewpoint);
    assert_eq!(found.len(), 4, "the lights at one place share l and r");
    for (name, vector) in expected {
        let vector = vector.expect("it exists");
        let arrow = found.iter().find(|it| it.name == name).expect("an arrow");
        assert_eq!(arrow.way, [vector.dot(right), -vector.dot(up)], "{name}");
    }
    // In orthographic projection the eye is straight ahead: its arrow is a dot.
    session.apply(Action::NextProjection);
    update(&mut session);
    let found = arrows(&session, &viewpoint);
    let eye = found.iter().find(|it| it.name == "o").expect("an arrow");
    assert!(eye.way[0].hypot(eye.way[1]) < 1e-12);
}
