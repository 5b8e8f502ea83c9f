//! Measuring the present view from the window.

use std::time::{Duration, Instant};

use minifb::Key;
use shadetrade::shading::METHODS;
use shadetrade::trade::{self, Progress, TradeError};
use shadetrade::window::hud::lines::Line;
use shadetrade::window::input::Gesture;
use shadetrade::window::measuring::{Measurement, News};
use shadetrade::window::response::respond;
use shadetrade::window::session::{Redraw, Request, Session};

use super::hud::hud;
use super::{SIZE, default_session, press};

/// What the table says, line by line; empty where there is none.
fn table(session: &Session) -> Vec<String> {
    let hud = hud(session, SIZE);
    let rows = hud.table().map_or(&[][..], |board| board.rows());
    let text = |line: &Line| match line {
        Line::Title(name, detail) => format!("{name} {detail}"),
        Line::Text(text) => text.clone(),
        Line::Heading(text) => (*text).to_owned(),
        _ => panic!("{line:?}"),
    };
    rows.iter().map(|(line, _)| text(line)).collect()
}

fn measured() -> Session {
    let mut session = default_session();
    press(&mut session, Key::M);
    let request = trade::Request {
        time: Duration::ZERO,
        ..session.measurement([32, 24])
    };
    let report = trade::measure(request, &|_| ()).expect("there is memory");
    session.hear(News::Done(Box::new(report)));
    session
}

#[test]
fn m_measures_and_tells_how_far_it_is() {
    let mut session = default_session();
    session.take_redraw();
    press(&mut session, Key::M);
    assert_eq!(session.take_requests(), [Request::Measure]);
    assert_eq!(session.take_redraw(), Redraw::Overlay);
    assert_eq!(table(&session)[1], "starting               0 %");
    session.hear(News::Progress(Progress {
        step: "timing frames",
        share: 0.42,
    }));
    assert_eq!(session.take_redraw(), Redraw::Overlay);
    assert_eq!(table(&session)[1], "timing frames         42 %");
}

#[test]
fn the_table_has_the_verdict_and_every_method() {
    let session = measured();
    let lines = table(&session);
    assert_eq!(lines[0], "measured 32\u{d7}24");
    assert!(
        lines[1].starts_with("Phong within half a level"),
        "{lines:?}"
    );
    for method in METHODS {
        let rows = lines
            .iter()
            .filter(|line| line.split_whitespace().next() == Some(method.id));
        assert_eq!(rows.count(), 1, "{}", method.id);
    }
    for size in [
        [1, 1],
        [320, 240],
        [640, 480],
        SIZE,
        [1920, 1080],
        [5000, 20],
    ] {
        super::fit::check_fit(&session, size);
    }
}

#[test]
fn escape_m_and_every_change_end_it_but_looking_around_does_not() {
    for key in [Key::Escape, Key::M, Key::R, Key::Left, Key::RightBracket] {
        let mut running = default_session();
        press(&mut running, Key::M);
        for session in [&mut running, &mut measured()] {
            assert!(session.measuring().is_open());
            press(session, key);
            assert!(!session.measuring().is_open(), "{key:?}");
            assert!(!session.take_requests().contains(&Request::Quit));
            session.hear(News::Failed("too late".to_owned()));
            assert_eq!(session.overlay().message(), None);
        }
    }
    let mut session = measured();
    press(&mut session, Key::Tab);
    assert!(session.measuring().is_open());
    let board = hud(&session, SIZE).table().expect("there is room").rect();
    let point = [board.x + 9, board.y + 9];
    respond(&mut session, Gesture::Click(point), SIZE);
    assert!(!session.measuring().is_open(), "a click on it closes it");
}

#[test]
fn a_failure_is_said_and_what_turns_is_not_measured() {
    let mut session = default_session();
    press(&mut session, Key::M);
    session.hear(News::Failed("no memory".to_owned()));
    assert_eq!(session.overlay().message(), Some("not measured: no memory"));
    assert!(!session.measuring().is_open());
    press(&mut session, Key::Space);
    press(&mut session, Key::M);
    assert!(!session.measuring().is_open());
    assert_eq!(
        session.overlay().message(),
        Some("what turns cannot be measured")
    );
}

#[test]
fn a_measurement_ends_with_a_report_and_stops_when_it_is_cancelled() {
    let session = default_session();
    let request = || trade::Request {
        time: Duration::ZERO,
        ..session.measurement([24, 18])
    };
    let measurement = Measurement::start(request());
    let start = Instant::now();
    let report = loop {
        assert!(start.elapsed() < Duration::from_secs(60));
        let done = measurement.news().into_iter().find_map(|news| match news {
            News::Done(report) => Some(report),
            News::Progress(_) => None,
            News::Failed(reason) => panic!("{reason}"),
        });
        if let Some(report) = done {
            break report;
        }
    };
    assert_eq!(report.methods.len(), METHODS.len());
    assert_eq!(report.subject.size, [24, 18]);
    let cancelled = trade::measure_unless(request(), &|| true, &|_| ());
    assert!(matches!(cancelled, Err(TradeError::Cancelled)));
}
