//! A click on the picture, and what is then said of that pixel.

use fearless_simd::Level;
use minifb::Key;
use shadetrade::canvas::Point;
use shadetrade::frame::Workers;
use shadetrade::probe;
use shadetrade::window::hud::lines::Line;
use shadetrade::window::hud::pixel::lines;
use shadetrade::window::input::Gesture;
use shadetrade::window::response::respond;
use shadetrade::window::session::{Redraw, Request, Session};

use super::hud::{UNTOUCHED, hud};
use super::{SIZE, default_session, press};

/// On the cuboid, right of the panel.
const ON_CUBOID: Point = [600, 300];

fn click(session: &mut Session, point: Point) {
    respond(session, Gesture::Click(point), SIZE);
    session
        .update_probe(SIZE, Level::new())
        .expect("there is memory");
}

fn texts(lines: &[Line]) -> Vec<String> {
    let text = |line: &Line| match line {
        Line::Title(name, detail) => format!("{name} {detail}"),
        Line::Text(text) => text.clone(),
        Line::Heading(text) => (*text).to_owned(),
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
    assert_eq!(session.probed().map(|it| it.pixel), Some([600, 300]));
    click(&mut session, [300, 600]);
    assert_eq!(session.probed().map(|it| it.pixel), Some([300, 600]));
    assert_eq!(session.revision(), 0, "looking changes nothing");
}

#[test]
fn what_is_said_follows_the_picture() {
    let mut session = default_session();
    click(&mut session, ON_CUBOID);
    let before = session.probed().cloned();
    press(&mut session, Key::R);
    session
        .update_probe(SIZE, Level::new())
        .expect("there is memory");
    let after = session.probed().cloned();
    assert_ne!(before, after);
    let view = session.view(SIZE);
    let mut scene = session.scene().snapshot();
    let workers = Workers::alone(Level::new());
    let expected = probe::at(&mut scene, &view, [600, 300], workers).expect("there is memory");
    assert_eq!(after, Some(expected));
}

#[test]
fn a_click_on_what_is_said_or_escape_closes_it() {
    let mut session = default_session();
    for by_key in [true, false] {
        click(&mut session, ON_CUBOID);
        let board = hud(&session, SIZE).probe().expect("there is room").rect();
        if by_key {
            press(&mut session, Key::Escape);
        } else {
            click(&mut session, [board.x + 20, board.y + 20]);
        }
        assert!(session.probed().is_none());
        assert_eq!(session.take_requests(), []);
    }
    press(&mut session, Key::Escape);
    assert_eq!(session.take_requests(), [Request::Quit]);
}

#[test]
fn a_pixel_that_the_window_no_longer_has_is_no_longer_looked_at() {
    let mut session = default_session();
    click(&mut session, ON_CUBOID);
    session
        .update_probe([600, 400], Level::new())
        .expect("there is memory");
    assert!(session.probed().is_none());
    click(&mut session, [-1, 5]);
    click(&mut session, [5, SIZE[1] as i32]);
    assert!(session.probed().is_none());
}

#[test]
fn the_pixel_itself_is_never_covered() {
    let mut session = default_session();
    for (size, beside_panel) in [
        (SIZE, true),
        ([1920, 1080], true),
        ([640, 480], true),
        ([500, 1100], false),
        ([320, 240], false),
    ] {
        let panel = hud(&session, size).panel().expect("there is room").rect();
        for x in (panel.right() as usize + 20..size[0]).step_by(61) {
            let point = [x as i32, 200];
            respond(&mut session, Gesture::Click([1, 1]), [1, 1]);
            session.probe(Some([x, 200]));
            session
                .update_probe(size, Level::new())
                .expect("there is memory");
            let hud = hud(&session, size);
            let board = hud.probe().unwrap_or_else(|| panic!("no room at {size:?}"));
            assert!(!board.rect().contains(point), "{size:?} {point:?}");
            let off_panel = board.rect().intersection(&panel).is_empty();
            assert!(off_panel || !beside_panel, "{size:?} {x}");
            let mut pixels = vec![UNTOUCHED; size[0] * size[1]];
            hud.draw(&mut pixels);
            assert_eq!(
                pixels[200 * size[0] + x],
                UNTOUCHED,
                "seen within the cross"
            );
            assert_ne!(pixels[200 * size[0] + x - 5], UNTOUCHED, "the cross");
        }
    }
}

#[test]
fn it_fits_any_window() {
    let mut session = default_session();
    for size in [
        [1, 1],
        [100, 60],
        [320, 240],
        [640, 480],
        [5000, 20],
        [17, 900],
    ] {
        session.probe(Some([0, 0]));
        session
            .update_probe(size, Level::new())
            .expect("there is memory");
        super::fit::check_fit(&session, size);
        session.probe(Some([size[0] / 2, size[1] / 2]));
        session
            .update_probe(size, Level::new())
            .expect("there is memory");
        super::fit::check_fit(&session, size);
    }
}

#[test]
fn all_that_the_probe_knows_is_said() {
    let mut session = default_session();
    click(&mut session, ON_CUBOID);
    let probe = session.probed().expect("looked at").clone();
    let surface = probe.surface.clone().expect("the cuboid");
    let wide = texts(&lines(&probe, true));
    assert_eq!(wide[0], "pixel 600,300");
    assert_eq!(wide[1], format!("emerald, triangle {}", surface.triangle));
    let [x, y, z] = surface.normal.expect("known").to_array();
    assert_eq!(wide[4], format!("normal   n{x:>9.3}{y:>9.3}{z:>9.3}"));
    let names: Vec<&str> = wide
        .iter()
        .map(|line| line.split("  ").next().unwrap_or_default().trim())
        .collect();
    let expected = [
        "pixel 600,300",
        &wide[1],
        "vectors",
        "position",
        "normal",
        "to eye",
        "white",
        "",
        "red",
        "",
        "specular l",
        "",
        "levels and bytes",
        "",
        "white",
        "red",
        "specular",
        "ambient",
        "drawn",
        "reference",
        "bytes",
        "reference",
    ];
    assert_eq!(names, expected);
    let [r, g, b] = surface.phong.bytes;
    assert!(wide[20].ends_with(&format!("{r:>9}{g:>9}{b:>9}")));
    let narrow = texts(&lines(&probe, false));
    assert!(narrow.iter().all(|line| line.chars().count() <= 40));
    assert_eq!(narrow.len(), wide.len() + 9);
    click(&mut session, [950, 10]);
    let background = session.probed().expect("looked at");
    assert_eq!(
        texts(&lines(background, true)),
        ["pixel ", "950,10: background"]
    );
}
