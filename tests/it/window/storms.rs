//! Whatever the user does, and in whatever order, the window stays one that can be drawn; and what is undone is as it was.
//!
//! `SHADETRADE_CASES` sets how many storms of a hundred happenings there are (12 if unset); 1000 of them are 10^5.

use std::collections::HashMap;
use std::fs;
use std::time::Duration;

use fearless_simd::Level;
use minifb::Key;
use proptest::prelude::*;
use shadetrade::canvas::Point;
use shadetrade::components::{Projection, ShadingMode};
use shadetrade::frame::{Frame, Keep, Workers};
use shadetrade::scene::Scene;
use shadetrade::simd;
use shadetrade::systems;
use shadetrade::trade;
use shadetrade::window::bindings::{Action, BINDINGS, StepSize};
use shadetrade::window::composition::Composition;
use shadetrade::window::examination::examine;
use shadetrade::window::hud::{self, Hud, lines};
use shadetrade::window::input::{Event, Gesture, Input};
use shadetrade::window::jobs::{Progress, measurement};
use shadetrade::window::recording::{Event as Happened, Log, Recorder, Start};
use shadetrade::window::replay::Player;
use shadetrade::window::response::respond;
use shadetrade::window::session::{Redraw, Request, Session, Snapshot};
use shadetrade::window::views::ViewMode;

use super::{MIXED, default_session, drawing, session_of};
use crate::support::cases::cases;

/// The window's size when it opens, in pixels.
const START_SIZE: [usize; 2] = [120, 90];

/// What may happen to a window.
#[derive(Clone, Debug)]
enum Happening {
    /// A key is pressed and let go.
    Tap(Key),
    /// The mouse clicks.
    Click(Point),
    /// Something is reported.
    Report(Event),
    /// A row is clicked, or the mouse drags: what no key does.
    Do(Action),
    /// The window gets another size.
    Resize([usize; 2]),
    /// Time passes, in milliseconds.
    Wait(u64),
    /// The reference answers what it was last asked, however long ago.
    Answer,
    /// The measurement tells how far it is, and what came of it.
    Measured(bool),
}

fn any_key() -> impl Strategy<Value = Key> {
    let bound: Vec<Key> = BINDINGS
        .iter()
        .flat_map(|binding| binding.keys)
        .copied()
        .collect();
    let unbound = [Key::X, Key::LeftShift, Key::Slash, Key::Enter, Key::Unknown];
    prop_oneof![8 => prop::sample::select(bound), 1 => prop::sample::select(unbound.to_vec())]
}

fn any_event() -> impl Strategy<Value = Event> {
    let point = [-300..3000_i32, -300..3000_i32].prop_map(Point::from);
    let near = [0..400_i32, 0..300_i32].prop_map(Point::from);
    prop_oneof![
        3 => any_key().prop_map(Event::KeyDown),
        3 => any_key().prop_map(Event::KeyUp),
        1 => any::<char>().prop_map(Event::Character),
        1 => prop::sample::select(vec!['w', '?', '+', '9', 'Q']).prop_map(Event::Character),
        1 => Just(Event::FocusLost),
        4 => near.prop_map(Event::MouseAt),
        1 => point.prop_map(Event::MouseAt),
        4 => Just(Event::MouseDown),
        4 => Just(Event::MouseUp),
        2 => (-5..=5_i32).prop_map(Event::Wheel),
    ]
}

fn any_action() -> impl Strategy<Value = Action> {
    let angle = || prop_oneof![-10.0..10.0, -1e9..1e9];
    prop_oneof![
        any::<usize>().prop_map(Action::Light),
        (-1000..1000_i32).prop_map(Action::Tolerance),
        (-1000..1000_i32).prop_map(Action::Zoom),
        [angle(), angle()].prop_map(|[azimuth, elevation]| Action::Orbit { azimuth, elevation }),
        any::<i8>().prop_map(|steps| Action::View(i32::from(steps))),
        Just(Action::Editor),
        (0..30_usize).prop_map(Action::ChooseRow),
        (0..10_usize).prop_map(Action::Letters),
        (prop::option::of(0..12_usize), -300..300_i32).prop_map(|(row, steps)| Action::Step {
            row,
            steps,
            size: StepSize::Coarse,
        }),
        prop::sample::select(vec![Projection::Perspective, Projection::Orthographic])
            .prop_map(Action::Projection),
    ]
}

fn any_happening() -> impl Strategy<Value = Happening> {
    let size = prop_oneof![
        4 => [1..400_usize, 1..300_usize],
        1 => [1..4_usize, 1..4_usize],
        1 => [300..1000_usize, 1..20_usize],
    ];
    prop_oneof![
        12 => any_key().prop_map(Happening::Tap),
        6 => [0..400_i32, 0..300_i32].prop_map(Happening::Click),
        10 => any_event().prop_map(Happening::Report),
        4 => any_action().prop_map(Happening::Do),
        2 => size.prop_map(Happening::Resize),
        4 => prop_oneof![0..200_u64, 0..5000_u64].prop_map(Happening::Wait),
        2 => Just(Happening::Answer),
        1 => any::<bool>().prop_map(Happening::Measured),
    ]
}

/// The second scene of these tests with every length multiplied.
fn scaled(factor: &str) -> String {
    let mut text = MIXED.to_owned();
    for (plain, large) in [
        (
            "size = [1.0, 1.0, 1.0]",
            format!("size = [1{factor}, 1{factor}, 1{factor}]"),
        ),
        (
            "position = [-2.0, 0.0, 0.0]",
            format!("position = [-2{factor}, 0, 0]"),
        ),
        (
            "position = [2.0, 0.0, 0.0]",
            format!("position = [2{factor}, 0, 0]"),
        ),
        (
            "position = [0.0, 0.0, 10.0]",
            format!("position = [0, 0, 10{factor}]"),
        ),
        ("height = 6.0", format!("height = 6{factor}")),
        ("near = 0.5", format!("near = 0.5{factor}")),
    ] {
        assert!(text.contains(plain), "{plain}");
        text = text.replace(plain, &large);
    }
    text
}

fn any_scene() -> impl Strategy<Value = String> {
    let dark_and_inside = MIXED[..MIXED.find("[[light]]").expect("it has one")].to_owned()
        + "[[camera]]\nname = \"inside\"\nposition = [2.1, 0, 0]\ntarget = [2, 0, 0]\nfov = 179\nheight = 1e-100\n";
    let mut texts = vec![
        MIXED.to_owned(),
        scaled("e97"),
        scaled("e-97"),
        dark_and_inside,
    ];
    texts.extend(shadetrade::scene::BUILT_IN.map(|(_, text)| text.to_owned()));
    prop::sample::select(texts)
}

/// The window without its display: the same code in the same order.
struct Window {
    session: Session,
    input: Input,
    composition: Composition,
    hud: Hud,
    size: [usize; 2],
    now: Duration,
    asked: Option<Snapshot>,
    picture: Vec<u32>,
    shown: Vec<u32>,
    recorder: Option<Recorder>,
}

impl Window {
    fn open(text: &str) -> Self {
        let scene = Scene::parse("storm.toml", text).unwrap_or_else(|error| panic!("{error}"));
        let session = session_of(scene);
        let size = START_SIZE;
        Window {
            hud: Hud::new(&session, size),
            session,
            input: Input::default(),
            composition: Composition::new(Workers::alone(Level::new())),
            size,
            now: Duration::ZERO,
            asked: None,
            picture: Vec::new(),
            shown: Vec::new(),
            recorder: None,
        }
    }

    fn happen(&mut self, happening: &Happening) {
        if let Happening::Wait(milliseconds) = happening {
            self.now += Duration::from_millis(*milliseconds);
        }
        self.tick();
        match happening {
            Happening::Tap(key) => {
                self.report(Event::KeyDown(*key));
                self.report(Event::KeyUp(*key));
            }
            Happening::Click(point) => {
                self.report(Event::MouseAt(*point));
                self.report(Event::MouseDown);
                self.report(Event::MouseUp);
            }
            Happening::Report(event) => self.report(*event),
            Happening::Do(action) => {
                let action = self.session.resolved(*action);
                self.session.apply(action);
                self.record(action);
            }
            Happening::Resize(size) => {
                self.size = *size;
            }
            Happening::Wait(_) => {}
            Happening::Answer => {
                if let Some(mut asked) = self.asked.take() {
                    let result = examine(&mut asked, Level::new(), &|| false);
                    let result = result.expect("a small picture fits");
                    let progress = Progress::Examined(result.expect("nobody cancels it"));
                    self.session.on_progress(asked.revision, progress);
                }
            }
            Happening::Measured(done) => {
                let progress = if *done {
                    let request = trade::Request {
                        time: Duration::ZERO,
                        ..measurement(self.session.snapshot([8, 6]), Level::new())
                    };
                    let report = trade::measure(request, &|| false, &|_, _| ());
                    Progress::Measured(Box::new(report.expect("there is memory")))
                } else {
                    Progress::Measuring("timing frames", 0.5)
                };
                self.session.on_progress(self.session.revision, progress);
            }
        }
        while let Some(gesture) = self.input.repeated(self.now) {
            self.respond(gesture);
        }
        self.draw();
    }

    /// The time goes on, and what spins turns.
    fn tick(&mut self) {
        self.now += Duration::from_millis(1);
        let revision = self.session.revision;
        self.session.tick(self.now);
        if let Some(recorder) = self.recorder.as_mut()
            && self.session.revision != revision
        {
            recorder
                .note(self.now, &Happened::Time)
                .expect("it can be written");
        }
    }

    fn respond(&mut self, gesture: Gesture) {
        if let Some(action) = respond(&mut self.session, gesture, &self.hud) {
            self.record(action);
        }
    }

    fn record(&mut self, action: Action) {
        if let Some(recorder) = &mut self.recorder {
            let written = recorder.note(self.now, &Happened::Action(action));
            written.expect("it can be written");
        }
    }

    fn report(&mut self, event: Event) {
        self.input.is_editing = self.session.state.editor.is_some();
        if let Some(gesture) = self.input.handle(event, self.now) {
            self.respond(gesture);
        }
    }

    /// The picture's size in the window.
    fn picture(&self) -> [usize; 2] {
        let rect = hud::picture(&self.session, self.size);
        rect.size()
    }

    fn draw(&mut self) {
        let size = self.picture();
        if size != self.composition.size() || self.shown.len() != self.size[0] * self.size[1] {
            self.session.changed();
            if let Some(recorder) = &mut self.recorder {
                let written = recorder.note(self.now, &Happened::Size(size));
                written.expect("it can be written");
            }
        }
        let redraw = self.session.take_redraw();
        if redraw == Redraw::Picture {
            let drawn = self.composition.draw(&mut self.session, size);
            drawn.expect("a small picture fits");
        }
        if redraw > Redraw::Nothing {
            self.composition.compose(&self.session, &mut self.picture);
            self.hud = Hud::new(&self.session, self.size);
            self.hud.draw(&self.picture, false, &mut self.shown);
            assert!(lines::title(&self.session, true).starts_with("shadetrade: "));
        }
        for request in self.session.take_requests() {
            match request {
                Request::Examine => self.asked = Some(self.session.snapshot(size)),
                Request::Time => {
                    let timed = self.composition.time(&mut self.session);
                    timed.expect("a small picture fits");
                }
                Request::Measure | Request::Require | Request::LeaveOut(_) => {}
            }
        }
    }

    /// Everything a window may be.
    fn check(&self) {
        let Window { session, size, .. } = self;
        assert_eq!(self.shown.len(), size[0] * size[1]);
        assert_eq!(self.composition.size(), self.picture());
        assert!((0.0..=255.0).contains(&session.tolerance));
        assert!(session.camera() < session.scene.cameras.len());
        assert!(session.state.divider_column(size[0]) <= size[0]);
        assert!(session.spin().degrees < 360);
        assert!(session.orbit().azimuth.abs() <= 180.0);
        if let Some(probe) = session.probe.as_ref() {
            let size = self.picture();
            assert!(probe.pixel[0] < size[0] && probe.pixel[1] < size[1]);
        }
        let view = session.view(*size);
        let viewpoint = view.viewpoint;
        assert!(viewpoint.position.is_finite(), "{viewpoint:?}");
        assert!(viewpoint.camera.height > 0.0 && viewpoint.camera.height.is_finite());
        assert!(viewpoint.near() > 0.0 && viewpoint.near().is_finite());
        for axis in viewpoint.axes() {
            assert!((axis.length() - 1.0).abs() < 1e-6, "{viewpoint:?}");
        }
        if let Some(result) = session.reference.as_ref() {
            let [width, height] = self.picture();
            assert_eq!(result.reference.len(), width * height);
        }
    }
}

fn storms() -> ProptestConfig {
    ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(cases(12) as u32)
    }
}

proptest! {
    #![proptest_config(storms())]

    #[test]
    fn no_storm_leaves_the_states_a_window_can_be_in(
        text in any_scene(),
        happenings in prop::collection::vec(any_happening(), 100),
    ) {
        let mut window = Window::open(&text);
        window.happen(&Happening::Wait(0));
        for happening in &happenings {
            window.happen(happening);
            window.check();
        }
    }

    #[test]
    fn a_recorded_storm_shows_the_same_pictures_when_it_is_replayed(
        text in any_scene(),
        happenings in prop::collection::vec(any_happening(), 100),
        level in prop::sample::select(levels()),
        threads in 1..=3_usize,
    ) {
        let folder = tempfile::tempdir().expect("a folder can be made");
        let path = folder.path().join("storm.log");
        let mut window = Window::open(&text);
        let scene = Scene::parse("storm.toml", &text).expect("it was parsed before");
        let mut start = Start::new(&drawing(scene));
        start.size = window.picture();
        window.recorder = Some(Recorder::create(&path, &start).expect("it can be written"));
        let mut seen = HashMap::new();
        window.draw();
        for happening in &happenings {
            // Views of the reference wait for it, which a recording does not.
            let state = &window.session.state;
            let waits = state.shows_reference || state.mode.compares();
            if !waits || window.session.reference.is_some() {
                seen.insert(window.now, window.picture.clone());
            }
            window.happen(happening);
        }
        let text = fs::read_to_string(&path).expect("it was written");
        let log = Log::parse("storm.log", &text, threads, level).unwrap_or_else(|error| panic!("{error}"));
        prop_assert!(log.frames.len() > 10);
        let mut player = Player::new(log.start).expect("there are threads");
        for frame in log.frames {
            let time = frame.time;
            player.play(frame).expect("a small picture fits");
            if let Some(picture) = seen.get(&time) {
                prop_assert!(player.picture == *picture, "at {time:?}");
            }
        }
    }

    #[test]
    fn what_is_done_and_undone_leaves_the_same_bits(
        deeds in prop::collection::vec(prop::sample::select(undoable()), 1..12),
    ) {
        let mut session = default_session();
        session.apply(Action::Shading(ShadingMode::Gouraud));
        session.apply(Action::Projection(Projection::Perspective));
        let before = picture(&mut session);
        prop_assert!(before.iter().any(|level| *level != before[0]), "something is seen");
        for (action, _) in &deeds {
            session.apply(*action);
        }
        for (_, undo) in deeds.iter().rev() {
            for action in undo {
                session.apply(*action);
            }
        }
        prop_assert!(picture(&mut session) == before);
    }
}

/// Every SIMD level that this machine has.
fn levels() -> Vec<Level> {
    simd::NAMES
        .iter()
        .filter_map(|name| simd::named(name))
        .collect()
}

/// What can be done, and what undoes it bit for bit wherever it is done.
fn undoable() -> Vec<(Action, Vec<Action>)> {
    let orbit = |azimuth, elevation| Action::Orbit { azimuth, elevation };
    let twice = |action| (action, vec![action]);
    let mut all: Vec<_> = (0..4).map(|light| twice(Action::Light(light))).collect();
    all.extend(["white", "red", "specular", "ambient"].map(|name| twice(Action::LightNamed(name))));
    all.extend(
        [
            Action::Panel,
            Action::Help,
            Action::Blink,
            Action::NextProjection,
        ]
        .map(twice),
    );
    all.extend([
        (Action::Zoom(1), vec![Action::Zoom(-1)]),
        (Action::Zoom(-3), vec![Action::Zoom(3)]),
        (orbit(2.0, 0.0), vec![orbit(-2.0, 0.0)]),
        (orbit(0.0, 2.0), vec![orbit(0.0, -2.0)]),
        (orbit(0.0, -4.0), vec![orbit(0.0, 4.0)]),
        (
            Action::View(1),
            vec![Action::View(1); ViewMode::ALL.len() - 1],
        ),
        (Action::View(2), vec![Action::View(-2)]),
    ]);
    all
}

/// The levels of a small picture as bits, and the triangles seen.
fn picture(session: &mut Session) -> Vec<u32> {
    let mut frame = Frame::new(Keep::Levels, Workers::alone(Level::new()));
    let view = session.view([96, 72]);
    systems::draw(&mut session.scene.world, &view, &mut frame).expect("a small picture fits");
    let levels = frame
        .levels()
        .as_flattened()
        .iter()
        .map(|level| level.to_bits());
    levels.chain(frame.triangles().iter().copied()).collect()
}
