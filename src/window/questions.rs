//! The questions about the picture that the window asks, and the facts that it shows.
//!
//! One question is answered at a time. A question of more worth cancels another.

use std::sync::Arc;
use std::time::Duration;

use super::app::App;
use super::comparison::Comparison;
use super::facts::{Facts, Latest, Question, Work};
use super::inspector::Tab;
use super::pictures::{sides, view_at};
use crate::components::{Mesh, Side, View, ViewMode, Viewer, common_mode};
use crate::drawing::Drawing;
use crate::probe::{self, Probe};
use crate::prove::prove;
use crate::report::Monitor;
use crate::requires::{part_changes, ranked};
use crate::scene::Scene;
use crate::shading::{METHODS, Method};
use crate::trade::batch::time_here;
use crate::trade::{Measurement, Request, is_timed, measure};

/// Progress is shown at most this often: each layout would slow the frames that are being timed.
const PROGRESS: Duration = Duration::from_millis(200);
/// How long the frames of all methods are timed together.
const TIMING: Duration = Duration::from_secs(1);

impl App {
    /// Asks the questions whose answers the window shows and does not have, once the picture rests, or at once where there are
    /// no threads in the background.
    pub fn ask(&mut self) {
        let viewer = Viewer::clone(&self.viewer());
        let tab = self.desk.tab;
        let level = self.pictures.frame.workers().level();
        let is_live = self.pool.is_some();
        let shows_exact = self.desk.blinks.is_some()
            || viewer.show == ViewMode::Error
            || sides(&viewer).contains(&Side::Reference);
        if let Some(pixel) = viewer.pixel_in(self.pictures.frame.size()) {
            self.find(
                Question::Probe,
                |facts| &mut facts.section,
                move |scene, view, _| {
                    // The side of the wipe that the pixel is on.
                    let view = view_at(&viewer, view, pixel[0]);
                    Ok(probe::section(scene, &view, pixel, level)?)
                },
            );
        }
        if is_live || shows_exact {
            self.find(
                Question::Compare,
                |facts| &mut facts.comparison,
                move |scene, view, monitor| Comparison::of(&mut scene.world, view, level, monitor),
            );
        }
        if is_live && self.shows_times {
            self.measure();
        }
        if is_live || tab == Some(Tab::Proof) {
            self.find(
                Question::Prove,
                |facts| &mut facts.proof,
                move |scene, view, monitor| prove(&mut scene.world, view, None, level, monitor),
            );
        }
        if tab == Some(Tab::Required) {
            self.find(
                Question::Require,
                |facts| &mut facts.required,
                |scene, view, monitor| part_changes(scene, view, monitor).map(ranked),
            );
        }
    }

    /// Measures all methods. Those that are known in this view are not compared again.
    fn measure(&mut self) {
        let methods = self.wanted_methods();
        let is_known = |it: &Method| self.measured(*it).is_some();
        let trade = &self.facts.trade;
        let known = trade.current().map_or(&[][..], Vec::as_slice);
        if trade.is_current && (known.is_empty() || methods.iter().all(is_known)) {
            return;
        }
        let known = known.to_vec();
        let workers = self.pictures.frame.workers();
        let (threads, level) = (workers.threads(), workers.level());
        self.find(
            Question::Measure,
            |facts| &mut facts.trade,
            move |scene, view, monitor| {
                let request = Request {
                    drawing: Drawing {
                        scene: scene.snapshot(),
                        size: view.size,
                        threads,
                        level,
                    },
                    methods,
                    time: TIMING,
                    is_report: false,
                };
                let mut measured = measure(&request, &known, time_here, monitor)?;
                // The window shows none of them, and copies the rest in each layout.
                for one in &mut measured {
                    one.timing.raw = Vec::new();
                }
                Ok(measured)
            },
        );
    }

    /// Begins to find a fact about the present picture that is not known, unless a question of as much worth is being
    /// answered. A pixel is probed even while things move, because that takes little time.
    fn find<T: Send + 'static>(
        &mut self,
        question: Question,
        place: fn(&mut Facts) -> &mut Latest<T>,
        find: impl FnOnce(&mut Scene, &View, Monitor) -> anyhow::Result<T> + Send + 'static,
    ) {
        let is_probe = question == Question::Probe;
        let is_open = question == Question::Measure || !place(&mut self.facts).is_current;
        let work = self.work.as_ref();
        let is_next = work.is_none_or(|work| question < work.question);
        let rests = is_probe || self.pool.is_none() || self.moved.is_none();
        if !is_open || !is_next || !rests {
            return;
        }
        let (name, record) = (self.scene.name.clone(), Arc::clone(&self.state));
        let view = self.view();
        let find = move |monitor: Monitor| find(&mut Scene::spawn(name, &record), &view, monitor);
        // The work before is cancelled first.
        self.work = None;
        let work = Work::begin(self.pool.as_ref(), question, place, find);
        self.work = Some(work);
        if self.pool.is_none() {
            self.receive(self.now);
        }
    }

    /// Takes the answers that were found. Returns whether the window has to be drawn again, also for progress.
    pub fn receive(&mut self, now: Duration) -> bool {
        let mut is_new = self.work.is_some() && now >= self.next_progress;
        let work = self.work.as_ref();
        if let Some(Ok(answer)) = work.map(|work| work.answer.try_recv()) {
            is_new = true;
            self.work = None;
            if let Some(reason) = answer(&mut self.facts) {
                self.say(reason);
            }
        }
        // A pixel in the row of the one before needs no new answer.
        if self.facts.section.is_current && self.desk.clicked.take().is_some() {
            let surface = self.probed().and_then(|probe| probe.surface.as_ref());
            if let Some(object) = surface.map(|surface| surface.object.clone()) {
                self.select::<Mesh>("cuboid", &object);
            }
        }
        if is_new {
            self.next_progress = now + PROGRESS;
        }
        is_new
    }

    /// The progress of the work in the background, in words and as a share, 0..=1.
    pub fn progress(&self) -> Option<(String, f64)> {
        self.work.as_ref().and_then(Work::progress)
    }

    /// The answer about the probed pixel, possibly of an earlier picture.
    pub fn probed(&self) -> Option<&Probe> {
        let pixel = self.pixel();
        let mut section = self.facts.section.value.iter().flatten();
        section.find(|probe| Some(probe.pixel) == pixel)
    }

    /// The measurement of a method, if there is one; [`Facts::trade`] says whether it is that of the present view.
    pub fn measured(&self, method: Method) -> Option<&Measurement> {
        let mut measured = self.facts.trade.value.iter().flatten();
        measured.find(|it| it.method == method)
    }

    /// The method on screen; `None` where the cuboids have different modes.
    pub fn method(&self) -> Option<Method> {
        let tolerance = self.viewer().tolerance;
        let own = || Some(Method::of(common_mode(&self.scene.world)?, tolerance));
        self.held.or_else(own)
    }

    /// The milliseconds of a frame on screen: measured, or the last one's until that is done.
    pub fn milliseconds(&self) -> Option<f64> {
        self.measured_time().or(self.pictures.time)
    }

    /// The measured median of the method on screen, in milliseconds.
    pub fn measured_time(&self) -> Option<f64> {
        let method = self.method().filter(|_| self.facts.trade.is_current)?;
        Some(self.measured(method)?.timing.median)
    }

    /// The methods that are measured: those of reports, the one on screen, and those on the sides of a wipe.
    fn wanted_methods(&self) -> Vec<Method> {
        let sides = sides(&self.viewer()).into_iter();
        let sides = sides.filter_map(|side| self.side_method(&side));
        // The frames of the other one take so long that they would delay a key.
        let timed = METHODS.iter().copied().filter(|it| is_timed(*it));
        let mut methods: Vec<Method> = timed.collect();
        for method in self.method().into_iter().chain(sides) {
            if !methods.contains(&method) {
                methods.push(method);
            }
        }
        methods
    }
}
