//! The state behind the window: a [`Scene`], what the user has done to it ([`Action`]s), and the [`View`] that follows.
//!
//! Rule: nothing here draws, reads keys or asks a clock; [`Session::tick`] tells the time, so that everything can be tested
//! without a display.

mod actions;
mod editing;
mod readings;

pub use actions::TOLERANCES;

use std::time::Duration;

use fearless_simd::Level;

use super::bindings::Action;
use super::composition::FrameTimes;
use super::examination::ReferenceResult;
use super::history::History;
use super::jobs::Progress;
use super::recording::Event;
use super::view_state::{MESSAGE_TIME, READING_TIME, ViewState};
use crate::components::{Projection, Spin, View};
use crate::drawing::Drawing;
use crate::frame::display_pixel;
use crate::memory::OutOfMemory;
use crate::probe::{self, Probe, Profile};
use crate::requires::{Part, PartChange};
use crate::scene::Scene;
use crate::trade::Report;

/// How long nothing changes before the picture is timed and examined.
pub const REST: Duration = Duration::from_millis(100);

/// How often a running measurement is shown: drawing the window takes time from what is measured.
const PROGRESS_INTERVAL: Duration = Duration::from_millis(300);

/// A measurement as it is shown.
#[derive(Debug, Default)]
pub enum Measuring {
    /// None is shown.
    #[default]
    Off,
    /// What is being done, and the share of it that is done.
    Running(&'static str, f64),
    /// What came of it.
    Done(Box<Report>),
}

/// What the scene requires, as far as it is known.
#[derive(Debug, Default)]
pub struct Requires {
    /// How much of it is done, 0..=1.
    pub share: f64,
    /// Every part, the one whose absence errs most first; empty until all are known.
    pub parts: Vec<PartChange>,
    /// The part without which the picture is shown.
    pub left_out: Option<usize>,
    /// That picture, 0x00RRGGBB, once it is there.
    pub picture: Option<Vec<u32>>,
    is_asked: bool,
}

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

/// What is to be found out about the present picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Request {
    /// Times warm frames of what is shown.
    Time,
    /// Asks the reference about the picture.
    Examine,
    /// Starts measuring.
    Measure,
    /// Finds what the scene requires.
    Require,
    /// Draws the picture without a part.
    LeaveOut(Part),
}

/// A picture that something is to be found out about.
pub struct Snapshot {
    /// A copy of the scene, of its own.
    pub scene: Scene,
    pub view: View,
    /// Which state of the session that is.
    pub revision: u64,
}

/// How long a cuboid that spins takes for one degree, as in the assignment's program.
const DEGREE_TIME: Duration = Duration::from_millis(30);

/// The scene, whose components keys write, and what is the window's own. Others read it: what changes goes through
/// [`Session::happens`] and the other functions here, which note what has to be done anew.
pub struct Session {
    pub scene: Scene,
    pub projection: Projection,
    /// How far the picture may err from its own mode, in levels.
    pub tolerance: f64,
    /// When what spins has turned by one degree more.
    next_degree: Duration,
    /// How the scene is looked at.
    pub state: ViewState,
    /// What was changed in the scene.
    history: History,
    /// What is known of the pixel that is probed.
    pub probe: Option<Probe>,
    /// The levels along its row.
    pub profile: Option<Profile>,
    /// What frames of what is shown take.
    pub times: FrameTimes,
    /// When what is shown was drawn, until its frames are timed.
    to_be_timed: Option<Duration>,
    /// Whether the drawn picture has one colour beside the background.
    pub is_flat: bool,
    /// The number of the present picture: every change makes it larger.
    pub revision: u64,
    /// When it changed, until the reference is asked about it.
    to_be_examined: Option<Duration>,
    /// What the reference says of the present picture.
    pub reference: Option<ReferenceResult>,
    pub measuring: Measuring,
    /// Where it is shown.
    pub requires: Option<Requires>,
    /// When the progress of a measurement is shown next.
    next_progress: Duration,
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
            state: ViewState {
                divider: 0.5,
                panel: true,
                ..ViewState::default()
            },
            history: History::default(),
            probe: None,
            profile: None,
            times: FrameTimes::default(),
            to_be_timed: None,
            is_flat: false,
            revision: 0,
            to_be_examined: Some(Duration::ZERO),
            reference: None,
            measuring: Measuring::Off,
            requires: None,
            next_progress: Duration::ZERO,
            level: drawing.level,
            now: Duration::ZERO,
            redraw: Redraw::Picture,
            requests: Vec::new(),
        }
    }

    /// Probes the pixel that is looked at anew, in a picture of `size` pixels; one outside is no longer looked at.
    ///
    /// # Errors
    /// When a row of it does not fit in memory.
    pub fn update_probe(&mut self, size: [usize; 2]) -> Result<(), OutOfMemory> {
        let outside = |pixel: &mut [usize; 2]| pixel[0] >= size[0] || pixel[1] >= size[1];
        self.state.pixel.take_if(outside);
        (self.probe, self.profile) = (None, None);
        if let Some(pixel) = self.state.pixel {
            let view = self.view(size);
            let probe = probe::at(&mut self.scene, &view, pixel, self.level)?;
            let profile = probe::profile(&mut self.scene, &view, pixel[1], self.level)?;
            (self.probe, self.profile) = (Some(probe), Some(profile));
        }
        Ok(())
    }

    /// Takes what a job about the picture of this `revision` has come to, unless that has changed since, or it is no
    /// longer wanted.
    pub fn on_progress(&mut self, revision: u64, progress: Progress) {
        let measures = matches!(self.measuring, Measuring::Running(..));
        match progress {
            _ if revision != self.revision => return,
            Progress::Examined(result) => self.reference = Some(result),
            Progress::Proven(proof) => {
                if let Some(result) = &mut self.reference {
                    result.add_proof(proof);
                }
            }
            Progress::Measuring(step, share) if measures => {
                self.measuring = Measuring::Running(step, share);
                if self.now < self.next_progress {
                    return;
                }
                self.next_progress = self.now + PROGRESS_INTERVAL;
            }
            Progress::Measured(report) if measures => self.measuring = Measuring::Done(report),
            Progress::NotMeasured(reason) if measures => {
                self.measuring = Measuring::Off;
                self.say(format!("not measured: {reason}"));
            }
            Progress::NotExamined(reason) => {
                self.requires = None;
                self.say(format!("not compared with the reference: {reason}"));
            }
            Progress::Requiring(share) => {
                if let Some(requires) = &mut self.requires {
                    requires.share = share;
                }
            }
            Progress::Required(parts) => {
                if let Some(requires) = &mut self.requires {
                    requires.parts = parts;
                }
            }
            Progress::LeftOut(picture) => {
                if let Some(requires) = &mut self.requires {
                    requires.picture = Some(picture);
                }
            }
            _ => return,
        }
        self.wants(Redraw::Overlay);
    }

    /// Tells the time since the start: what spins goes on, messages go, and what rests is timed and examined, in this order.
    pub fn tick(&mut self, now: Duration) {
        self.now = now;
        let is_over = |(_, until): &mut (String, Duration)| *until <= now;
        if self.state.message.take_if(is_over).is_some() {
            self.wants(Redraw::Overlay);
        }
        self.spin_on();
        if matches!(self.measuring, Measuring::Running(..)) {
            return;
        }
        let rested = |since: &mut Duration| now >= *since + REST;
        if self.to_be_timed.take_if(rested).is_some() {
            self.requests.push(Request::Time);
        }
        if self.to_be_examined.take_if(rested).is_some() {
            self.requests.push(Request::Examine);
        }
        // It takes longest, and would cancel the proof.
        let is_proven = self.reference.as_ref().is_some_and(|it| it.proof.is_some());
        if let Some(requires) = &mut self.requires
            && is_proven
            && !requires.is_asked
        {
            requires.is_asked = true;
            self.requests.push(Request::Require);
        }
    }

    /// Lets happen what happened. A scene's file that is wrong says so, and the scene stays.
    pub fn happens(&mut self, event: Event) {
        match event {
            Event::Action(action) => self.apply(action),
            Event::Scene(scene) => self.reload(*scene),
            Event::SceneError(error) => {
                self.state.scene_error = Some(error);
                self.wants(Redraw::Overlay);
            }
            Event::Size(_) => self.changed(),
            Event::Say(words) => self.say(words),
            Event::Time => {}
        }
    }

    /// Shows a message as long as it takes to read, two seconds at least.
    pub fn say(&mut self, text: impl Into<String>) {
        let text = text.into();
        let time = MESSAGE_TIME.max(READING_TIME * text.chars().count() as u32);
        self.state.message = Some((text, self.now + time));
        self.wants(Redraw::Overlay);
    }

    /// The mouse is now over the row of this action, or over none.
    pub fn hover(&mut self, action: Option<Action>) {
        if self.state.hovered != action {
            self.state.hovered = action;
            self.wants(Redraw::Overlay);
        }
    }

    /// Notes what the picture of these pixels took when it was drawn first.
    pub fn drawn(&mut self, times: FrameTimes, pixels: &[u32]) {
        let background = display_pixel(self.scene.background.to_array());
        let mut covered = pixels.iter().filter(|pixel| **pixel != background);
        let first = covered.next();
        self.is_flat = first.is_some_and(|first| covered.all(|pixel| pixel == first));
        self.times = times;
        self.to_be_timed = Some(self.now);
    }

    /// Notes what warm frames of what is shown take.
    pub fn timed(&mut self, times: FrameTimes) {
        self.times = times;
        self.wants(Redraw::Overlay);
    }

    /// What has to be done anew since this was last asked.
    pub fn take_redraw(&mut self) -> Redraw {
        std::mem::take(&mut self.redraw)
    }

    /// What is to be found out since this was last asked, in order.
    pub fn take_requests(&mut self) -> Vec<Request> {
        std::mem::take(&mut self.requests)
    }

    fn wants(&mut self, redraw: Redraw) {
        self.redraw = self.redraw.max(redraw);
    }

    /// The picture is another one.
    pub fn changed(&mut self) {
        self.revision += 1;
        self.to_be_examined = Some(self.now);
        self.reference = None;
        self.measuring = Measuring::Off;
        self.requests.clear();
        self.requires = self.requires.take().map(|_| Requires::default());
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
