//! Where everything stands in the window: the panel beside the picture, boards off the cuboid and off one another.

use std::time::Duration;

use fearless_simd::Level;
use minifb::Key;
use proptest::prelude::*;
use shadetrade::canvas::Rect;
use shadetrade::frame::{Frame, Keep, NO_TRIANGLE, Workers};
use shadetrade::scene::{BUILT_IN, Scene};
use shadetrade::systems;
use shadetrade::trade;
use shadetrade::window::bindings::Action;
use shadetrade::window::composition::Composition;
use shadetrade::window::hud::board::Board;
use shadetrade::window::hud::lines::Line;
use shadetrade::window::hud::{Hud, Part, picture};
use shadetrade::window::jobs::{Progress, measurement};
use shadetrade::window::session::Session;
use shadetrade::window::views::ViewMode;

use crate::support::window::COMMON;

use super::{default_session, press, session_of};

const PARTS: [Part; 6] = [
    Part::Panel,
    Part::Legend,
    Part::Probe,
    Part::Table,
    Part::Message,
    Part::Help,
];

/// The layout of a window of `size` after its picture was drawn.
pub(super) fn drawn(session: &mut Session, size: [usize; 2]) -> Hud {
    let picture = picture(session, size);
    let mut composition = Composition::new(Workers::alone(Level::new()));
    let picture = picture.size();
    composition.draw(session, picture).expect("there is memory");
    Hud::new(session, size)
}

fn boards(hud: &Hud) -> Vec<(Part, &Board)> {
    let all = PARTS
        .iter()
        .flat_map(|part| hud.boards(*part).map(move |board| (*part, board)));
    all.collect()
}

fn overlap(one: Rect, other: Rect) -> bool {
    !one.intersection(&other).is_empty()
}

/// Checks that every board and every row keeps to its place, and that a click on a row does what the row says.
pub(super) fn check_fit(hud: &Hud, size: [usize; 2]) {
    let window = Rect::new(0, 0, size[0] as i32, size[1] as i32);
    let boards = boards(hud);
    for (index, (part, board)) in boards.iter().enumerate() {
        let rect = board.rect;
        assert_eq!(rect.intersection(&window), rect, "{part:?} at {size:?}");
        for (row, (line, place)) in board.rows.iter().enumerate() {
            assert_eq!(place.intersection(&rect), *place, "{line:?} at {size:?}");
            for (_, other) in &board.rows[row + 1..] {
                assert!(!overlap(*place, *other), "{line:?} at {size:?}");
            }
            let middle = [place.x + place.width / 2, place.y + place.height / 2];
            let hidden = boards[index + 1..]
                .iter()
                .any(|(_, upper)| upper.rect.contains(middle));
            if let (Line::Command(command), false) = (line, hidden) {
                let does = command.keys.last().map(|(_, action)| *action);
                assert_eq!(hud.action_at(middle), does, "{line:?} at {size:?}");
            }
        }
    }
    let mut shown = Vec::new();
    let rect = hud.picture;
    let pixels = vec![0; (rect.width * rect.height) as usize];
    hud.draw(&pixels, false, &mut shown);
    assert_eq!(shown.len(), size[0] * size[1]);
}

/// The cuboid's pixels in the window, from the picture itself.
fn cuboid(session: &mut Session, hud: &Hud) -> Rect {
    let mut frame = Frame::new(Keep::Levels, Workers::alone(Level::new()));
    let rect = hud.picture;
    let size = rect.size();
    let view = session.view(size);
    systems::draw(&mut session.scene.world, &view, &mut frame).expect("there is memory");
    let ids = frame.triangles().iter().enumerate();
    let covered: Vec<usize> = ids
        .filter(|(_, id)| **id != NO_TRIANGLE)
        .map(|(index, _)| index)
        .collect();
    let columns = || covered.iter().map(|index| index % size[0]);
    let rows = || covered.iter().map(|index| index / size[0]);
    let extent = |low: Option<usize>, high: Option<usize>| {
        let [low, high] = [low, high].map(|it| it.expect("something is seen") as i32);
        [low, high - low + 1]
    };
    let [x, width] = extent(columns().min(), columns().max());
    let [y, height] = extent(rows().min(), rows().max());
    Rect::new(rect.x + x, rect.y + y, width, height)
}

#[test]
fn in_a_common_window_the_panel_is_whole_and_the_picture_beside_it() {
    for size in COMMON {
        let mut session = default_session();
        for key in [None, Some(Key::Tab), Some(Key::P), Some(Key::M)] {
            if let Some(key) = key {
                press(&mut session, key);
            }
            let hud = drawn(&mut session, size);
            let panel = hud.boards(Part::Panel).next().expect("there is room");
            assert!(!overlap(panel.rect, hud.picture), "{size:?}");
            assert_eq!(
                panel.rect.width + hud.picture.width,
                size[0] as i32,
                "{size:?}"
            );
            let commands = panel
                .rows
                .iter()
                .filter(|(line, _)| matches!(line, Line::Command(_)));
            assert_eq!(commands.count(), 17, "{size:?}");
            check_fit(&hud, size);
        }
    }
}

#[test]
fn in_a_common_window_nothing_that_is_said_covers_the_cuboid_or_the_panel() {
    let message = "a message of a length that is usual here";
    for size in COMMON {
        // In the smallest window camera 2 leaves less than a legend needs.
        let cameras = if size == COMMON[0] { 1 } else { 2 };
        for view in 0..ViewMode::ALL.len() as i32 {
            for (camera, measures) in (0..cameras).flat_map(|it| [(it, true), (it, false)]) {
                let mut session = default_session();
                session.apply(Action::View(view));
                (0..camera).for_each(|_| session.apply(Action::NextCamera));
                if measures {
                    session.apply(Action::Measure);
                } else {
                    session.say(message);
                }
                let hud = drawn(&mut session, size);
                let cuboid = cuboid(&mut session, &hud);
                let boards = boards(&hud);
                assert!(boards.len() >= 2, "{size:?} {view}");
                for (index, (part, board)) in boards.iter().enumerate() {
                    let rect = board.rect;
                    assert!(
                        !overlap(rect, cuboid),
                        "{part:?} at {size:?} {view} {camera}"
                    );
                    for (other, upper) in &boards[index + 1..] {
                        let both = overlap(rect, upper.rect);
                        assert!(!both, "{part:?} and {other:?} at {size:?} {view}");
                    }
                }
            }
        }
    }
}

#[test]
fn in_a_common_window_probe_and_table_cover_neither_the_pixel_nor_each_other_nor_the_panel() {
    let mut measured = default_session();
    let request = trade::Request {
        time: Duration::ZERO,
        ..measurement(measured.snapshot([32, 24]), Level::new())
    };
    press(&mut measured, Key::M);
    let report = trade::measure(request, &|| false, &|_, _| ()).expect("there is memory");
    measured.on_progress(measured.revision, Progress::Measured(Box::new(report)));
    for size in COMMON {
        let mut session = default_session();
        let rect = picture(&session, size);
        for part in 1..8 {
            let pixel = [rect.width, rect.height].map(|side| (side * part / 8) as usize);
            session.apply(Action::Probe(Some(pixel)));
            let hud = drawn(&mut session, size);
            let board = hud.boards(Part::Probe).next().expect("there is room");
            let point = [rect.x + pixel[0] as i32, rect.y + pixel[1] as i32];
            assert!(!board.rect.contains(point), "{size:?} {pixel:?}");
            check_fit(&hud, size);
        }
        let hud = drawn(&mut measured, size);
        assert_eq!(hud.boards(Part::Table).count(), 1, "{size:?}");
        check_fit(&hud, size);
    }
    let mut session = default_session();
    session.apply(Action::Probe(Some([5, 5])));
    let hud = drawn(&mut session, [1920, 1080]);
    let board = hud.boards(Part::Probe).next().expect("there is room").rect;
    assert!(
        !overlap(board, cuboid(&mut session, &hud)),
        "there is room beside the cuboid"
    );
}

#[test]
fn the_picture_keeps_its_place_whatever_is_shown() {
    for size in COMMON {
        let mut session = default_session();
        let rect = picture(&session, size);
        for key in [
            Key::P,
            Key::Tab,
            Key::O,
            Key::C,
            Key::Tab,
            Key::Key1,
            Key::H,
            Key::Space,
        ] {
            press(&mut session, key);
            assert_eq!(picture(&session, size), rect, "{key:?} at {size:?}");
        }
        press(&mut session, Key::I);
        let window = Rect::new(0, 0, size[0] as i32, size[1] as i32);
        assert_eq!(picture(&session, size), window);
    }
}

#[test]
fn help_fits_a_common_window_and_tiny_windows_show_the_picture() {
    for size in COMMON {
        let mut session = default_session();
        session.apply(Action::Help);
        let hud = drawn(&mut session, size);
        assert_eq!(hud.boards(Part::Help).count(), 2, "{size:?}");
        check_fit(&hud, size);
    }
    for size in [[1, 1], [1, 900], [3000, 1], [40, 30], [200, 150]] {
        let mut session = default_session();
        for action in [Action::Help, Action::Measure, Action::View(3)] {
            session.apply(action);
            session.apply(Action::Probe(Some([0, 0])));
            let hud = drawn(&mut session, size);
            check_fit(&hud, size);
            assert_eq!(hud.boards(Part::Panel).count(), 0, "{size:?}");
            assert_eq!(hud.picture, Rect::new(0, 0, size[0] as i32, size[1] as i32));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn nothing_leaves_its_place_at_any_size(
        size in [1_usize..900, 1_usize..700],
        help: bool,
        message: bool,
        view in 0..5_i32,
        pixel in [0_usize..900, 0_usize..700],
        name in "\\PC{0,40}",
    ) {
        let name = format!("{:?}", format!("red{}", name.replace(',', " ")));
        let text = BUILT_IN[0].1.replace("\"red\"", &name);
        let scene = Scene::parse("a rather long name of a scene file.toml", &text)
            .or_else(|_| Scene::load(None))
            .expect("the built-in scene is valid");
        let mut session = session_of(scene);
        session.apply(Action::View(view));
        session.apply(Action::Probe(Some(pixel)));
        if help {
            session.apply(Action::Help);
        }
        if message {
            session.apply(Action::LightNamed("none such, and a long name at that"));
        }
        check_fit(&drawn(&mut session, size), size);
    }
}
