//! The board of what a scene requires, and the picture without a part.

use std::time::Duration;

use fearless_simd::Level;
use minifb::Key;
use shadetrade::frame::Workers;
use shadetrade::prove::prove;
use shadetrade::requires::{Part, picture_without, ranked};
use shadetrade::window::bindings::Action;
use shadetrade::window::composition::Composition;
use shadetrade::window::examination::examine;
use shadetrade::window::hud::lines::Line;
use shadetrade::window::hud::{self, Part as BoardPart};
use shadetrade::window::jobs::Progress;
use shadetrade::window::session::{Measuring, Request, Session};

use super::{SIZE, default_session, press};

const SMALL: [usize; 2] = [48, 36];

/// What the window asks for once its picture rests and is proven.
fn rest(session: &mut Session) -> Vec<Request> {
    session.tick(Duration::from_secs(1));
    session.take_requests();
    let mut request = session.snapshot(SMALL);
    let result = examine(&mut request, Level::new(), &|| false).expect("a small picture fits");
    let result = result.expect("nobody cancels it");
    session.on_progress(request.revision, Progress::Examined(result));
    session.tick(Duration::from_secs(2));
    assert_eq!(session.take_requests(), [], "the proof comes first");
    let (world, view) = (&mut request.scene.world, &request.view);
    let proof = prove(world, view, Level::new(), &|| false, &|_| ());
    let proof = proof
        .expect("a small picture fits")
        .expect("nobody cancels");
    session.on_progress(request.revision, Progress::Proven(proof));
    session.tick(Duration::from_secs(3));
    session.take_requests()
}

/// What the job answers.
fn answer(session: &mut Session) {
    let request = session.snapshot(SMALL);
    let parts = ranked(&request.scene, &request.view, &|| false, &|_| ());
    let parts = parts.expect("nobody cancels");
    session.on_progress(request.revision, Progress::Required(parts));
}

fn rows(session: &Session) -> Vec<(String, String)> {
    let hud = hud::Hud::new(session, SIZE);
    let board = hud.boards(BoardPart::Requires).next().expect("it is shown");
    let command = |(line, _): &(Line, _)| match line {
        Line::Command(command) => Some((command.label.clone(), command.state.clone())),
        _ => None,
    };
    board.rows.iter().filter_map(command).collect()
}

#[test]
fn the_board_ranks_the_parts_and_a_row_shows_the_picture_without_its_part() {
    let mut session = default_session();
    press(&mut session, Key::N);
    assert_eq!(rest(&mut session), [Request::Require]);
    assert_eq!(rows(&session), []);
    answer(&mut session);
    let shown = rows(&session);
    assert_eq!(shown[0].0, "cuboid emerald");
    assert!(shown[0].1.ends_with("yes"));
    assert!(
        shown
            .iter()
            .any(|(name, state)| name == "depth test" && state.ends_with(" no"))
    );
    let row = shown.iter().position(|(name, _)| name == "light red");
    let row = row.expect("the scene has it");
    let requires = session.requires.as_ref().expect("it is shown");
    let Part::Light(light) = requires.parts[row].part else {
        panic!("it is a light");
    };

    let mut composition = Composition::new(Workers::alone(Level::new()));
    composition
        .draw(&mut session, SMALL)
        .expect("a small picture fits");
    let mut whole = Vec::new();
    composition.compose(&session, &mut whole);
    session.apply(Action::LeaveOut(row));
    assert_eq!(
        session.take_requests(),
        [Request::LeaveOut(Part::Light(light))]
    );
    let request = session.snapshot(SMALL);
    let picture = picture_without(&request.scene, &request.view, Part::Light(light), &|| false);
    let picture = picture.expect("nobody cancels");
    session.on_progress(request.revision, Progress::LeftOut(picture.clone()));
    let mut seen = Vec::new();
    composition.compose(&session, &mut seen);
    assert_eq!(seen, picture);
    session.apply(Action::LeaveOut(row));
    composition.compose(&session, &mut seen);
    assert_eq!(seen, whole);

    // A measurement that runs is cancelled by the picture without a part, and ends.
    session.apply(Action::Measure);
    session.apply(Action::LeaveOut(row));
    assert!(matches!(session.measuring, Measuring::Off));
    let asked = session.take_requests();
    assert_eq!(asked, [Request::LeaveOut(Part::Light(light))]);
    session.apply(Action::LeaveOut(row));

    // The picture without a light is the one with that light off, to a byte.
    session.apply(Action::Light(light));
    composition
        .draw(&mut session, SMALL)
        .expect("a small picture fits");
    composition.compose(&session, &mut seen);
    let far = |(one, other): (&u32, &u32)| {
        let bytes = one.to_be_bytes().into_iter().zip(other.to_be_bytes());
        bytes
            .into_iter()
            .any(|(one, other)| one.abs_diff(other) > 1)
    };
    assert_eq!(seen.iter().zip(&picture).filter(|it| far(*it)).count(), 0);
    // Another picture requires anew.
    assert_eq!(rows(&session), []);
    assert_eq!(rest(&mut session), [Request::Require]);
    press(&mut session, Key::Escape);
    assert!(session.requires.is_none());
}

#[test]
fn a_measurement_interrupts_what_is_not_known_yet_and_it_is_asked_for_again() {
    let mut session = default_session();
    press(&mut session, Key::N);
    assert_eq!(rest(&mut session), [Request::Require]);
    press(&mut session, Key::M);
    assert_eq!(session.take_requests(), [Request::Measure]);
    session.tick(Duration::from_secs(4));
    assert_eq!(session.take_requests(), []);
    press(&mut session, Key::M);
    session.tick(Duration::from_secs(5));
    assert_eq!(session.take_requests(), [Request::Require]);
    answer(&mut session);
    press(&mut session, Key::M);
    press(&mut session, Key::M);
    session.take_requests();
    session.tick(Duration::from_secs(6));
    assert_eq!(session.take_requests(), [], "it is known");
}

#[test]
fn opening_and_closing_the_board_asks_for_the_proof_again_unless_it_is_there() {
    let mut session = default_session();
    session.tick(Duration::from_secs(1));
    assert!(session.take_requests().contains(&Request::Examine));
    for second in [2, 4] {
        press(&mut session, Key::N);
        session.tick(Duration::from_secs(second));
        assert_eq!(session.take_requests(), [Request::Examine]);
    }
    rest(&mut session);
    press(&mut session, Key::N);
    session.tick(Duration::from_secs(9));
    assert_eq!(session.take_requests(), [Request::Require]);
}

#[test]
fn what_is_cancelled_ends() {
    let request = default_session().snapshot(SMALL);
    assert!(ranked(&request.scene, &request.view, &|| true, &|_| ()).is_none());
    let part = Part::F64SetUp;
    assert!(picture_without(&request.scene, &request.view, part, &|| true).is_none());
}
