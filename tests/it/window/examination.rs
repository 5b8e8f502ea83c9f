//! What is found out about a picture that rests, and when.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use fearless_simd::Level;
use minifb::Key;
use shadetrade::frame::Workers;
use shadetrade::prove::{Proof, REFUTED, UNDECIDED, Verdict, prove};
use shadetrade::systems;
use shadetrade::trade::error_map;
use shadetrade::window::bindings::Action;
use shadetrade::window::examination::{Errors, ReferenceResult, examine};
use shadetrade::window::hud::lines::Line;
use shadetrade::window::hud::{Hud, Part};
use shadetrade::window::jobs::{Jobs, Progress};
use shadetrade::window::session::{Redraw, Request, Session, Snapshot};

use super::jobs::until_heard;
use super::{default_session, press};

/// A small picture, higher than one band of rows.
const SMALL: [usize; 2] = [96, 80];

fn found(mut request: Snapshot) -> ReferenceResult {
    examine(&mut request, Level::new(), &|| false)
        .expect("it fits")
        .expect("nobody cancels it")
}

fn proof(mut request: Snapshot) -> Proof {
    let proof = prove(
        &mut request.scene.world,
        &request.view,
        Level::new(),
        &|| false,
        &|_| (),
    );
    proof.expect("there is memory").expect("nobody cancels it")
}

fn facts(session: &Session) -> Vec<String> {
    let hud = Hud::new(session, super::SIZE);
    let rows = hud
        .boards(Part::Panel)
        .next()
        .expect("there is room")
        .rows
        .iter();
    rows.filter_map(|(line, _)| match line {
        Line::Fact(_, value) => Some(value.clone()),
        _ => None,
    })
    .collect()
}

#[test]
fn a_picture_is_examined_once_when_it_has_rested_for_a_tenth_of_a_second() {
    let mut session = default_session();
    let mut requests = |milliseconds| {
        session.tick(Duration::from_millis(milliseconds));
        session.take_requests()
    };
    assert_eq!(requests(99), []);
    assert_eq!(requests(100), [Request::Examine]);
    assert_eq!(requests(5000), []);
    press(&mut session, Key::R);
    let mut requests = |milliseconds| {
        session.tick(Duration::from_millis(milliseconds));
        session.take_requests()
    };
    assert_eq!(requests(5099), []);
    assert_eq!(requests(5100), [Request::Examine]);
    press(&mut session, Key::Tab);
    session.tick(Duration::from_secs(9));
    assert_eq!(
        session.take_requests(),
        [],
        "another view is no other picture"
    );
    press(&mut session, Key::Space);
    for time in (9000..12_000).step_by(8) {
        session.tick(Duration::from_millis(time));
    }
    assert_eq!(session.take_requests(), [], "what turns does not rest");
}

#[test]
fn an_answer_about_another_picture_is_dropped() {
    let mut session = default_session();
    let findings = found(session.snapshot(SMALL));
    let revision = session.revision;
    press(&mut session, Key::R);
    session.take_redraw();
    session.on_progress(revision, Progress::Examined(findings));
    assert!(session.reference.is_none());
    assert_eq!(session.take_redraw(), Redraw::Nothing);
    session.on_progress(
        session.revision,
        Progress::Examined(found(session.snapshot(SMALL))),
    );
    assert!(session.reference.is_some());
    assert_eq!(session.take_redraw(), Redraw::Overlay);
    press(&mut session, Key::P);
    assert!(session.reference.is_none());
}

#[test]
fn the_panel_tells_the_error_or_why_there_is_none() {
    let mut session = default_session();
    assert_eq!(facts(&session)[3..], ["...", "..."]);
    let mut findings = found(session.snapshot(SMALL));
    findings.errors = Some(Errors {
        max: 163.4,
        mean: 9.934,
    });
    findings.own_errors = None;
    session.on_progress(session.revision, Progress::Examined(findings));
    assert_eq!(facts(&session)[3..], ["163 (mean 9.93)", "-"]);
}

#[test]
fn the_panel_tells_how_much_is_proven_or_what_is_missing() {
    let mut session = default_session();
    let early = Progress::Proven(proof(session.snapshot(SMALL)));
    session.on_progress(session.revision, early);
    assert!(
        facts(&session)[2].starts_with("... of"),
        "a proof follows the findings"
    );
    session.on_progress(
        session.revision,
        Progress::Examined(found(session.snapshot(SMALL))),
    );
    let proven = proof(session.snapshot(SMALL));
    session.on_progress(session.revision + 1, Progress::Proven(proven.clone()));
    assert!(
        facts(&session)[2].starts_with("... of"),
        "a proof of another picture"
    );
    session.on_progress(session.revision, Progress::Proven(proven.clone()));
    let covered = proven.covered.to_string();
    let told = facts(&session)[2].replace(' ', "");
    assert!(
        told.starts_with(&format!("{covered}of")) && proven.covered > 1000,
        "{told}"
    );

    let mut lacking = proven.clone();
    lacking.undecided = 2;
    lacking.marks[3].verdict = Verdict::Undecided;
    session.on_progress(session.revision, Progress::Proven(lacking.clone()));
    assert!(alarm(&session).contains('2'), "{}", alarm(&session));
    lacking.refuted = 7;
    lacking.marks[4].verdict = Verdict::Refuted;
    session.on_progress(session.revision, Progress::Proven(lacking));
    assert!(
        alarm(&session).contains("7 px refuted"),
        "{}",
        alarm(&session)
    );
    let map = &session
        .reference
        .as_ref()
        .expect("they were given")
        .error_map;
    assert_eq!(map[3..5], [UNDECIDED, REFUTED]);
    assert_ne!(map[5], REFUTED);
}

fn alarm(session: &Session) -> String {
    let hud = Hud::new(session, super::SIZE);
    let mut rows = hud
        .boards(Part::Panel)
        .next()
        .expect("there is room")
        .rows
        .iter();
    let alarm = rows.find_map(|(line, _)| match line {
        Line::Alarm(_, value) => Some(value.clone()),
        _ => None,
    });
    alarm.unwrap_or_default()
}

#[test]
fn phong_errs_by_its_tolerance_at_most_and_gouraud_by_more() {
    let mut session = default_session();
    let gouraud = found(session.snapshot(SMALL));
    let [errors, own] = [gouraud.errors, gouraud.own_errors].map(|it| it.expect("covered"));
    assert!(errors.max > 10.0 && errors.mean > 1.0, "{errors:?}");
    assert!(own.max <= 0.5 && own.mean <= own.max, "{own:?}");
    press(&mut session, Key::P);
    let phong = found(session.snapshot(SMALL));
    assert_eq!(phong.errors, phong.own_errors);
    assert!(
        phong.reference == gouraud.reference,
        "exact Phong whatever is drawn"
    );
    // Where nothing is drawn, in the picture's corner.
    assert_eq!(phong.error_map[0], error_map::NOTHING);
    assert_eq!(phong.error_map.len(), SMALL[0] * SMALL[1]);
}

#[test]
fn a_picture_all_in_phong_is_compared_with_one_reference_and_not_with_two() {
    let mut session = default_session();
    let rows = |session: &Session| {
        let asked = AtomicUsize::new(0);
        let not_cancelled = || asked.fetch_add(1, Ordering::Relaxed) == usize::MAX;
        examine(&mut session.snapshot(SMALL), Level::new(), &not_cancelled).expect("it fits");
        asked.into_inner()
    };
    let gouraud = rows(&session);
    press(&mut session, Key::P);
    assert_eq!(2 * rows(&session), gouraud);
}

#[test]
fn the_reference_looks_like_the_picture() {
    let mut session = default_session();
    press(&mut session, Key::P);
    let workers = Workers::new(1, Level::new()).expect("no thread is needed");
    let mut frame = shadetrade::frame::Frame::new(shadetrade::frame::Keep::Display, workers);
    let view = session.view(SMALL);
    systems::draw(&mut session.scene.world, &view, &mut frame).expect("there is memory");
    let reference = found(session.snapshot(SMALL)).reference;
    let far = |(drawn, exact): (&u32, &u32)| {
        let [drawn, exact] = [drawn, exact].map(|it| it.to_be_bytes());
        drawn.iter().zip(exact).any(|(a, b)| a.abs_diff(b) > 1)
    };
    let far = frame.pixels().iter().zip(&reference).filter(|it| far(*it));
    assert!(far.count() < 20, "only edges differ");
}

#[test]
fn where_nothing_is_drawn_there_is_no_error() {
    let mut session = default_session();
    let mut request = session.snapshot([1, 1]);
    request.view.viewpoint.camera.target = request.view.viewpoint.position * 2.0;
    let findings = found(request);
    assert_eq!((findings.errors, findings.own_errors), (None, None));
    session.on_progress(session.revision, Progress::Examined(findings));
    assert_eq!(facts(&session)[3..], ["-", "-"]);
}

#[test]
fn what_could_not_be_compared_is_said_and_nothing_waits_for_it() {
    let mut session = default_session();
    session.apply(Action::Requires);
    assert!(session.requires.is_some());
    let told = Progress::NotExamined("too large".to_owned());
    session.on_progress(session.revision, told);
    assert!(session.requires.is_none());
    let (message, _) = session.state.message.as_ref().expect("it is said");
    assert!(message.contains("too large"), "{message}");
}

#[test]
fn an_examination_stops_as_soon_as_it_is_cancelled() {
    let session = default_session();
    let asked = AtomicUsize::new(0);
    let cancelled = || asked.fetch_add(1, Ordering::Relaxed) >= 3;
    assert_eq!(
        examine(&mut session.snapshot(SMALL), Level::new(), &cancelled).expect("it fits"),
        None
    );
}

#[test]
fn the_newest_request_is_answered_and_what_is_cancelled_is_not() {
    let mut session = default_session();
    let mut jobs = Jobs::start(Level::new()).expect("there are threads");
    for _ in 0..20 {
        press(&mut session, Key::R);
        jobs.submit(Request::Examine, session.snapshot([400, 300]));
    }
    until_heard(&jobs, |revision, progress| {
        let last = matches!(progress, Progress::Proven(..));
        session.on_progress(revision, progress);
        last
    });
    assert!(
        session
            .reference
            .as_ref()
            .is_some_and(|it| it.proof.is_some())
    );
    // Cancelled at once: the next job is done all the same, and nothing else is heard of.
    jobs.submit(Request::Examine, session.snapshot([4000, 3000]));
    jobs.cancel();
    press(&mut session, Key::R);
    jobs.submit(Request::Examine, session.snapshot(SMALL));
    until_heard(&jobs, |_, progress| match progress {
        Progress::Examined(result) => {
            assert_eq!(result.reference.len(), SMALL[0] * SMALL[1]);
            true
        }
        other => panic!("{other:?}"),
    });
}
