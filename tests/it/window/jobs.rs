//! Work beside the window: measuring the present view.

use std::thread;
use std::time::{Duration, Instant};

use fearless_simd::Level;
use minifb::Key;
use shadetrade::shading::METHODS;
use shadetrade::trade::{self, TradeError};
use shadetrade::window::bindings::Action;
use shadetrade::window::composition::FrameTimes;
use shadetrade::window::hud::Part;
use shadetrade::window::hud::lines::Line;
use shadetrade::window::input::Gesture;
use shadetrade::window::jobs::{Jobs, Progress, measurement};
use shadetrade::window::session::{Measuring, Redraw, Request, Session};

use super::hud::{board, hud};
use super::{SIZE, default_session, does, press};

/// What the table says, line by line; empty where there is none.
fn table(session: &Session) -> Vec<String> {
    let hud = hud(session, SIZE);
    let rows = hud
        .boards(Part::Table)
        .next()
        .map_or(&[][..], |board| &board.rows);
    let text = |line: &Line| match line {
        Line::Title(name, detail) => format!("{name} {detail}"),
        Line::Text(text) => text.clone(),
        Line::Rule => String::new(),
        _ => panic!("{line:?}"),
    };
    rows.iter().map(|(line, _)| text(line)).collect()
}

fn measured() -> Session {
    let mut session = default_session();
    press(&mut session, Key::M);
    let request = trade::Request {
        time: Duration::ZERO,
        ..measurement(session.snapshot([32, 24]), Level::new())
    };
    let report = trade::measure(request, &|| false, &|_, _| ()).expect("there is memory");
    session.on_progress(session.revision, Progress::Measured(Box::new(report)));
    session
}

fn is_open(session: &Session) -> bool {
    !matches!(session.measuring, Measuring::Off)
}

/// Waits until `wanted` says yes to what is heard.
pub(super) fn until_heard(jobs: &Jobs, mut wanted: impl FnMut(u64, Progress) -> bool) {
    let start = Instant::now();
    let mut is_wanted = |(revision, progress)| wanted(revision, progress);
    while !jobs.progress().into_iter().any(&mut is_wanted) {
        assert!(start.elapsed() < Duration::from_secs(60), "waited in vain");
        thread::yield_now();
    }
}

#[test]
fn m_measures_and_tells_how_far_it_is_a_few_times_a_second() {
    let mut session = default_session();
    session.take_redraw();
    press(&mut session, Key::M);
    assert_eq!(session.take_requests(), [Request::Measure]);
    assert_eq!(session.take_redraw(), Redraw::Overlay);
    assert!(table(&session)[0].contains(" 0 %"));
    let mut redraws = 0;
    for step in 1..=2000 {
        session.tick(Duration::from_millis(step));
        let share = step as f64 / 2000.0;
        let step = "timing frames";
        session.on_progress(session.revision, Progress::Measuring(step, share));
        redraws += usize::from(session.take_redraw() > Redraw::Nothing);
    }
    assert!(
        (2..=10).contains(&redraws),
        "{redraws} redraws in two seconds"
    );
    assert!(table(&session)[0].contains("100 %"));
}

#[test]
fn a_measurement_runs_alone_and_what_it_cancels_is_asked_again() {
    let mut session = default_session();
    session.tick(Duration::from_millis(200));
    assert_eq!(session.take_requests(), [Request::Examine]);
    press(&mut session, Key::M);
    session.drawn(FrameTimes::default(), &[]);
    session.tick(Duration::from_secs(5));
    assert_eq!(session.take_requests(), [Request::Measure]);
    session.on_progress(
        session.revision,
        Progress::NotMeasured("no memory".to_owned()),
    );
    session.tick(Duration::from_secs(6));
    assert_eq!(session.take_requests(), [Request::Time, Request::Examine]);
}

#[test]
fn the_table_has_the_verdict_and_every_method() {
    let session = measured();
    let lines = table(&session);
    assert_eq!(lines[0], "measured 32\u{d7}24");
    assert!(!lines[1].is_empty(), "the verdict");
    for method in METHODS {
        let rows = lines
            .iter()
            .filter(|line| line.split_whitespace().next() == Some(method.id));
        assert_eq!(rows.count(), 1, "{}", method.id);
    }
}

#[test]
fn escape_m_and_every_change_end_it_but_looking_around_does_not() {
    for key in [Key::Escape, Key::M, Key::R, Key::Left, Key::RightBracket] {
        let mut running = default_session();
        press(&mut running, Key::M);
        for session in [&mut running, &mut measured()] {
            assert!(is_open(session));
            assert_ne!(press(session, key), Some(Action::Quit));
            assert!(!is_open(session), "{key:?}");
            session.on_progress(
                session.revision,
                Progress::NotMeasured("too late".to_owned()),
            );
            assert_eq!(session.state.message(), None);
        }
    }
    let mut session = measured();
    press(&mut session, Key::Tab);
    assert!(is_open(&session));
    let rect = board(&hud(&session, SIZE), Part::Table).rect;
    does(&mut session, Gesture::Click([rect.x + 9, rect.y + 9]));
    assert!(!is_open(&session), "a click on it closes it");
}

#[test]
fn a_failure_is_said_and_what_turns_is_not_measured() {
    let mut session = default_session();
    press(&mut session, Key::M);
    session.take_requests();
    session.on_progress(
        session.revision,
        Progress::NotMeasured("no memory".to_owned()),
    );
    let message = |session: &Session| session.state.message().unwrap_or_default().to_owned();
    assert!(message(&session).contains("no memory"));
    assert!(!is_open(&session));
    press(&mut session, Key::Space);
    press(&mut session, Key::M);
    assert!(!is_open(&session));
    assert!(message(&session).contains("Space"));
    assert!(!session.take_requests().contains(&Request::Measure));
}

#[test]
fn a_measurement_ends_with_a_report_and_stops_when_it_is_cancelled() {
    let session = default_session();
    let mut jobs = Jobs::start(Level::new()).expect("there are threads");
    jobs.submit(Request::Measure, session.snapshot([24, 18]));
    until_heard(&jobs, |_, progress| match progress {
        Progress::Measured(report) => {
            assert_eq!(report.methods.len(), METHODS.len());
            assert_eq!(report.subject.size, [24, 18]);
            true
        }
        Progress::Measuring(..) => false,
        other => panic!("{other:?}"),
    });
    let request = measurement(session.snapshot([24, 18]), Level::new());
    let cancelled = trade::measure(request, &|| true, &|_, _| ());
    assert!(matches!(cancelled, Err(TradeError::Cancelled)));
}
