//! The state behind the window: a [`Scene`], what the user has done to it ([`Action`]s), and the [`View`] that follows.
//!
//! Rule: nothing here knows pixels, keys or clocks; the time is told by [`Session::tick`], so that everything can be
//! tested without a display.

mod actions;
mod readings;

pub use actions::TOLERANCES;

use std::time::Duration;

use fearless_simd::Level;

use super::bindings::Action;
use super::examination::Examination;
use super::examiner::{Answer, Question};
use super::looking::Looking;
use super::measuring::{self, Measuring, News};
use super::overlay::{Overlay, Pane};
use super::probing::Probing;
use super::statistics::Statistics;
use crate::components::{Projection, ShadingMode, Spin, View};
use crate::drawing::Drawing;
use crate::frame::Frame;
use crate::memory::OutOfMemory;
use crate::scene::Scene;
use crate::shading::METHODS;
use crate::systems;
use crate::trade;

/// What has to be done anew because something changed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Redraw {
    /// Nothing.
    #[default]
    Nothing,
    /// What lies over the picture.
    Overlay,
    /// The picture, and what lies over it.
    Picture,
}

/// What only the window itself can do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Request {
    /// Saves what is shown.
    Screenshot,
    /// Asks the reference about the picture.
    Examine,
    /// Starts measuring.
    Measure,
    /// Ends the program.
    Quit,
}

/// How long a cuboid that spins takes for one degree, as in the assignment's program.
const DEGREE_TIME: Duration = Duration::from_millis(30);

/// The scene, whose components keys write, and what is the window's own.
pub struct Session {
    scene: Scene,
    projection: Projection,
    tolerance: f64,
    /// When what spins has turned by one degree more.
    next_degree: Duration,
    overlay: Overlay,
    statistics: Statistics,
    looking: Looking,
    probing: Probing,
    examination: Examination,
    measuring: Measuring,
    level: Level,
    now: Duration,
    redraw: Redraw,
    requests: Vec<Request>,
}

impl Session {
    /// Starts with the panel shown and everything as `drawing` says.
    pub fn new(drawing: Drawing) -> Self {
        let mut scene = drawing.scene;
        scene.look_from(drawing.camera);
        scene.shade(drawing.shading);
        Session {
            scene,
            projection: drawing.projection,
            tolerance: drawing.tolerance,
            next_degree: Duration::ZERO,
            overlay: Overlay::default(),
            statistics: Statistics::default(),
            looking: Looking::default(),
            probing: Probing::default(),
            examination: Examination::default(),
            measuring: Measuring::default(),
            level: drawing.level,
            now: Duration::ZERO,
            redraw: Redraw::Picture,
            requests: Vec::new(),
        }
    }

    /// Finds out anew what there is to know of the pixel that is looked at, in a picture of `size` pixels.
    ///
    /// # Errors
    /// When a row of it does not fit in memory.
    pub fn update_probe(&mut self, size: [usize; 2], level: Level) -> Result<(), OutOfMemory> {
        let view = self.view(size);
        self.probing.update(&mut self.scene, &view, level)
    }

    /// Takes what was found out, unless it is about a picture that has changed since.
    pub fn answer(&mut self, answer: Answer) {
        if self.examination.answer(answer) {
            self.wants(Redraw::Overlay);
        }
    }

    /// Takes what the measurement tells, unless it is no longer shown.
    pub fn hear(&mut self, news: News) {
        if !self.measuring.is_running() {
            return;
        }
        self.measuring = match news {
            News::Progress(progress) => Measuring::Running(Some(progress)),
            News::Done(report) => Measuring::Done(report),
            News::Failed(reason) => {
                self.say(format!("not measured: {reason}"));
                Measuring::Off
            }
        };
        self.overlay.scroll_to(Pane::Table, 0);
        self.wants(Redraw::Overlay);
    }

    /// Tells the time since the start: what spins goes on, and what has stood long enough goes.
    pub fn tick(&mut self, now: Duration) {
        self.now = now;
        if self.overlay.tick(now) {
            self.wants(Redraw::Overlay);
        }
        self.spin_on();
        if self.examination.is_due(now) {
            self.requests.push(Request::Examine);
        }
    }

    /// Puts words into the window for two seconds.
    pub fn say(&mut self, text: impl Into<String>) {
        self.overlay.say(text.into(), self.now);
        self.wants(Redraw::Overlay);
    }

    /// The mouse moved, and is now over the row of this action or over none.
    pub fn hover(&mut self, action: Option<Action>) {
        if self.overlay.hover(action, self.now) {
            self.wants(Redraw::Overlay);
        }
    }

    /// Shows a pane from this row on.
    pub fn scroll_to(&mut self, pane: Pane, row: usize) {
        self.overlay.scroll_to(pane, row);
        self.wants(Redraw::Overlay);
    }

    /// The window has another size.
    pub fn resized(&mut self) {
        self.changed();
    }

    /// How a picture of `size` pixels is to be drawn now.
    pub fn view(&self, size: [usize; 2]) -> View {
        View {
            size,
            viewpoint: self.scene.viewpoint(self.camera()),
            projection: self.projection,
            background: self.scene.background,
            shading: None,
            tolerance: self.tolerance,
        }
    }

    /// Draws the picture of `size` pixels into `frame`.
    ///
    /// # Errors
    /// When it does not fit in memory.
    pub fn draw(&mut self, size: [usize; 2], frame: &mut Frame) -> Result<(), OutOfMemory> {
        self.draw_as(None, size, frame)
    }

    /// The same with all cuboids shaded so, or each in its own mode.
    ///
    /// # Errors
    /// When it does not fit in memory.
    pub fn draw_as(
        &mut self,
        shading: Option<ShadingMode>,
        size: [usize; 2],
        frame: &mut Frame,
    ) -> Result<(), OutOfMemory> {
        let view = View {
            shading,
            ..self.view(size)
        };
        systems::draw(&mut self.scene.world, &view, frame)
    }

    /// What is to be measured of a picture of `size` pixels: every method, on one thread.
    pub fn measurement(&self, size: [usize; 2]) -> trade::Request {
        let mut cameras = self.scene.camera_names();
        trade::Request {
            scene: self.scene.snapshot(),
            camera: cameras.swap_remove(self.camera()),
            view: self.view(size),
            methods: METHODS.to_vec(),
            threads: 1,
            level: self.level,
            time: measuring::TIME,
            command: String::new(),
        }
    }

    /// What the reference is to be asked about a picture of `size` pixels.
    pub fn question(&self, size: [usize; 2]) -> Question {
        Question {
            scene: self.scene.snapshot(),
            view: self.view(size),
            revision: self.revision(),
        }
    }

    /// Notes what drawing `frame` took.
    pub fn record(&mut self, time: Duration, frame: &Frame) {
        self.statistics.record(time, frame.counts(), frame.size());
    }

    /// What has to be done anew since this was last asked.
    pub fn take_redraw(&mut self) -> Redraw {
        std::mem::take(&mut self.redraw)
    }

    /// What the window itself is to do since this was last asked, in order.
    pub fn take_requests(&mut self) -> Vec<Request> {
        std::mem::take(&mut self.requests)
    }

    fn wants(&mut self, redraw: Redraw) {
        self.redraw = self.redraw.max(redraw);
    }

    /// The picture is another one.
    fn changed(&mut self) {
        self.examination.restart(self.now);
        self.requests
            .retain(|request| !matches!(request, Request::Examine | Request::Measure));
        self.measuring = Measuring::Off;
        self.wants(Redraw::Picture);
    }

    /// Turns what spins by the degrees that are due.
    fn spin_on(&mut self) {
        let Some(late) = self.now.checked_sub(self.next_degree) else {
            return;
        };
        if !self.spin().on {
            return;
        }
        let degrees = 1 + (late.as_millis() / DEGREE_TIME.as_millis()) as u32;
        self.next_degree += DEGREE_TIME * degrees;
        for spin in self.scene.world.query_mut::<&mut Spin>() {
            spin.degrees = (spin.degrees + degrees) % 360;
        }
        self.changed();
    }
}
