//! The study: the questions about the picture that the window asks, and the facts that it shows.
//!
//! One question is answered at a time. A question of more worth cancels another. A change of the picture outdates the facts
//! that it touches, and stops the work on them.

use std::sync::Arc;
use std::time::Duration;

use rayon::ThreadPool;
use web_time::Instant;

use super::comparison::Comparison;
use super::desk::Desk;
use super::document::is_another_scene;
use super::facts::{Facts, Latest, Question, Work, pool};
use super::inspector::Tab;
use super::pictures::{exact_view, side_method, sides};
use crate::components::{Camera, Side, View, ViewMode, Viewer, active_camera, alike};
use crate::output::Monitor;
use crate::questions::job::Drawing;
use crate::questions::probe;
use crate::questions::prove::{Proof, prove};
use crate::questions::requires::segments::fewest_segments;
use crate::questions::requires::{more_changes, picture_without};
use crate::questions::trade::batch::time_here;
use crate::questions::trade::verdict::is_sure;
use crate::questions::trade::{Request, measure};
use crate::scene::{Scene, SceneRecord};
use crate::shading::{Method, methods};
use crate::systems::frame::Workers;

/// Progress is shown at most this often: each layout would slow the frames that are being timed.
const PROGRESS: Duration = Duration::from_millis(200);
/// While things move a proof is told of for this time, and one that takes longer is given up.
pub const RECENT: Duration = Duration::from_millis(300);
/// The parts of the model that are left out, or the values of a number that are drawn, between two looks at the result.
const FEW: usize = 4;
/// How long the frames of all methods are timed together, first and at most.
const TIMING: Duration = Duration::from_secs(1);
const LONGEST: Duration = Duration::from_secs(16);

/// The change between two pictures, from the least to the greatest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    Nothing,
    /// Another pixel is explained.
    Pixel,
    /// Another picture is shown beside, or in place of, the same frame.
    Shown,
    /// The same view is drawn by another method.
    Method,
    Scene,
}

/// The change from one state and view to others.
pub fn change(
    (before, view_before): (&Arc<SceneRecord>, &View),
    (after, view): (&Arc<SceneRecord>, &View),
) -> Change {
    if Arc::ptr_eq(before, after) && view == view_before {
        return Change::Nothing;
    }
    let by_any_method = |view: &View| view.unshaded().with_tolerance(0.0);
    if by_any_method(view) != by_any_method(view_before) || is_another_scene(before, after) {
        return Change::Scene;
    }
    if view != view_before || before.cuboid != after.cuboid {
        return Change::Method;
    }
    let shown = |it: &SceneRecord| (it.view.show, it.view.sides, it.view.divider);
    let has_moved = before.view.pixel != after.view.pixel;
    if shown(before) != shown(after) || has_moved && after.view.show == ViewMode::Wipe {
        Change::Shown
    } else if has_moved {
        Change::Pixel
    } else {
        Change::Nothing
    }
}

/// The picture that questions are about.
pub struct Subject<'a> {
    pub name: &'a str,
    pub record: &'a Arc<SceneRecord>,
    pub view: View,
    /// See [`Canvas::fit`](super::canvas::Canvas::fit).
    pub fit: f64,
    /// The explained pixel, and the picture that is shown there.
    pub pixel: Option<([usize; 2], Side)>,
    /// The method on screen; `None` where the cuboids have different modes.
    pub method: Option<Method>,
    pub workers: &'a Workers,
    /// Whether nothing moves.
    pub rests: bool,
}

/// The way in which questions are answered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Background {
    /// By threads.
    Threads,
    /// Piece by piece in [`Study::carry_on`], for a page in a browser.
    Pieces,
    /// In the step that asks them, and no more than it must: for tests, and for pictures of the window.
    AtOnce,
}

/// The facts, and the work on the next one.
pub struct Study {
    pub facts: Facts,
    background: Background,
    /// For [`Background::Threads`].
    pool: Option<ThreadPool>,
    pub work: Option<Work>,
    /// When the last proof ended.
    proven: Option<Instant>,
    /// Whether that, or one given up since, took longer than [`RECENT`].
    is_slow: bool,
    next_progress: Duration,
    /// The reason why a question has no answer, until it is taken.
    failure: Option<String>,
}

impl Study {
    /// # Errors
    /// If the system gives no threads.
    pub fn new(background: Background) -> anyhow::Result<Self> {
        let has_threads = background == Background::Threads;
        Ok(Study {
            facts: Facts::default(),
            background,
            pool: has_threads.then(pool).transpose()?,
            work: None,
            proven: None,
            is_slow: false,
            next_progress: Duration::ZERO,
            failure: None,
        })
    }

    /// Forgets everything, for another scene.
    pub fn clear(&mut self) {
        self.facts = Facts::default();
        self.work = None;
        self.is_slow = false;
    }

    /// Whether questions are answered between steps.
    pub fn is_live(&self) -> bool {
        self.background != Background::AtOnce
    }

    /// Whether pictures are proven while they move.
    pub fn follows(&self) -> bool {
        self.pool.is_some() && !self.is_slow
    }

    /// The last proof, for a short time; it may be one of an earlier picture.
    pub fn last_proof(&self) -> Option<&Proof> {
        let is_recent = self.proven.is_some_and(|it| it.elapsed() < RECENT);
        self.facts.proof.value.as_ref().filter(|_| is_recent)
    }

    /// Outdates the facts that a change touches, and stops the work on them; a proof goes on if it is quick. `pixel` is the
    /// explained one.
    pub fn outdate(&mut self, change: Change, pixel: Option<[usize; 2]>) {
        match change {
            Change::Nothing => {}
            // The values of a row are known together.
            Change::Pixel if self.facts.probed(pixel).is_some() => {}
            Change::Pixel | Change::Shown => {
                self.work.take_if(|work| work.question == Question::Probe);
                self.facts.section.is_current = false;
            }
            Change::Method | Change::Scene => {
                let proof = self.work.take_if(|it| it.question == Question::Prove);
                let is_slow = |it: &Work| it.begun.elapsed() > RECENT;
                self.is_slow |= proof.as_ref().is_some_and(is_slow);
                self.work = proof.filter(|_| self.follows());
                if let Some(work) = &mut self.work {
                    work.is_late = true;
                }
                self.facts.outdate(change == Change::Method);
            }
        }
    }

    /// Asks the questions whose answers the window shows and does not have. Where they are answered at once, only those that
    /// must be.
    pub fn ask(&mut self, subject: &Subject, desk: &Desk) {
        let viewer = &subject.record.view;
        let level = subject.workers.level();
        let is_live = self.is_live();
        let shows_exact = desk.blinks.is_some() || desk.awaits_worst || shows_exact(viewer);
        if let Some((pixel, side)) = subject.pixel {
            self.find(
                subject,
                Question::Probe,
                |facts| &mut facts.section,
                async move |mut scene, view, _| {
                    let view = exact_view(&side, view);
                    Ok(probe::section(&mut scene, &view, pixel, level)?)
                },
            );
        }
        let methods: Vec<Method> = side_methods(subject).collect();
        let comparison = &self.facts.comparison;
        let knows = |it: &Comparison, method| it.worst_by(method, subject.method).is_some();
        let mut known = comparison.value.iter();
        let knows_all = known.all(|it| methods.iter().all(|method| knows(it, Some(*method))));
        if (is_live || shows_exact) && !(comparison.is_current && knows_all) {
            self.find(
                subject,
                Question::Compare,
                |facts| &mut facts.comparison,
                async move |mut scene, view, monitor| {
                    Comparison::of(&mut scene.world, view, methods, level, monitor).await
                },
            );
        }
        if let Some(part) = desk.shown_without() {
            let known = self.facts.left_out.value.as_ref();
            self.facts.left_out.is_current &= known.is_some_and(|it| it.0 == part);
            self.find(
                subject,
                Question::LeaveOut,
                |facts| &mut facts.left_out,
                async move |scene, view, monitor| {
                    let pixels = picture_without(&scene, view, part, monitor).await?;
                    Ok((part, pixels))
                },
            );
        }
        if desk.is_open(Tab::Vary) {
            self.vary(subject, desk);
        }
        if is_live && desk.shows_times {
            self.measure(subject, Question::Measure);
        }
        if is_live || desk.is_open(Tab::Proof) {
            self.find(
                subject,
                Question::Prove,
                |facts| &mut facts.proof,
                async move |mut scene, view, monitor| {
                    prove(&mut scene.world, view, None, level, monitor).await
                },
            );
        }
        if desk.is_open(Tab::Required) {
            let found = self.facts.required.current().cloned().unwrap_or_default();
            if !found.is_all {
                self.find(
                    subject,
                    Question::Require,
                    |facts| &mut facts.required,
                    async move |scene, view, monitor| {
                        more_changes(&scene, view, found.rows, FEW, monitor).await
                    },
                );
            }
            self.find(
                subject,
                Question::CountSegments,
                |facts| &mut facts.segments,
                async |scene, view, monitor| fewest_segments(&scene, view, monitor).await,
            );
        }
        if is_live && desk.shows_times {
            self.measure(subject, Question::MeasureLonger);
        }
    }

    /// Refines the curves of the number that is varied.
    fn vary(&mut self, subject: &Subject, desk: &Desk) {
        let wanted = desk.varied.as_ref().map(|varied| &varied.wanted);
        let Some(Ok((_, wanted))) = wanted else {
            return;
        };
        let known = self.facts.curves.value.as_ref();
        let known = known.filter(|it| it.is_same(wanted)).unwrap_or(wanted);
        if known.is_all {
            return;
        }
        let (known, level) = (known.clone(), subject.workers.level());
        self.find(
            subject,
            Question::Vary,
            |facts| &mut facts.curves,
            async move |_, _, monitor| known.refine(FEW, level, monitor).await,
        );
    }

    /// Measures all methods. Those that are known in this view are not compared again, and timed again for longer as long as
    /// the time of the one on screen is not sure.
    fn measure(&mut self, subject: &Subject, question: Question) {
        let methods = wanted_methods(subject);
        let trade = &self.facts.trade;
        let known = trade.current();
        // Without an answer none of them can be measured.
        let is_all = trade.is_current
            && known.is_none_or(|it| methods.iter().all(|method| it.knows(*method)));
        let longer = known.filter(|it| {
            let is_unsure = |method| !is_sure(&it.methods, method);
            it.time < LONGEST && subject.method.is_some_and(is_unsure)
        });
        let time = match (question, longer) {
            (Question::Measure, _) if !is_all => TIMING,
            (Question::MeasureLonger, Some(known)) if is_all => 2 * known.time,
            _ => return,
        };
        let known = known.cloned().unwrap_or_default();
        let (threads, level) = (subject.workers.threads(), subject.workers.level());
        self.find(
            subject,
            question,
            |facts| &mut facts.trade,
            async move |scene, view, monitor| {
                let request = Request {
                    drawing: Drawing {
                        scene,
                        size: view.size,
                        threads,
                        level,
                    },
                    methods,
                    time,
                    is_report: false,
                    must_fit: false,
                };
                let mut measured = measure(&request, &known, time_here, monitor).await?;
                // The window shows none of them, and copies the rest in each layout.
                for one in &mut measured.methods {
                    one.timing.raw = Vec::new();
                }
                Ok(measured)
            },
        );
    }

    /// Begins to find a fact about the present picture that is not known, unless a question of as much worth is being
    /// answered. Even while things move a pixel is probed, which takes little time, and the picture is proven, if that follows.
    fn find<T: Send + 'static>(
        &mut self,
        subject: &Subject,
        question: Question,
        place: fn(&mut Facts) -> &mut Latest<T>,
        find: impl AsyncFnOnce(Scene, &View, Monitor<'_>) -> anyhow::Result<T> + Send + 'static,
    ) {
        // What is known of these grows.
        let grows = [
            Question::Compare,
            Question::Measure,
            Question::MeasureLonger,
            Question::Require,
            Question::Vary,
        ]
        .contains(&question);
        let is_open = grows || !place(&mut self.facts).is_current;
        let work = self.work.as_ref();
        let is_next = work.is_none_or(|work| question < work.question);
        let follows = match question {
            Question::Probe => true,
            Question::Prove => self.follows(),
            _ => false,
        };
        let is_due = follows || !self.is_live() || subject.rests;
        if !is_open || !is_next || !is_due {
            return;
        }
        let (name, record) = (subject.name.to_owned(), Arc::clone(subject.record));
        let (view, fit) = (subject.view, subject.fit);
        let find = async move |monitor: Monitor<'_>| {
            let mut scene = Scene::spawn(name, &record);
            let camera = active_camera(&scene.world);
            let fitted = Camera::own(&scene.world, camera).widened(fit);
            scene.world.insert_one(camera, fitted)?;
            find(scene, &view, monitor).await
        };
        // The work before is cancelled first.
        self.work = None;
        let work = Work::begin(self.pool.as_ref(), question, place, find);
        let work = self.work.insert(work);
        if self.background == Background::AtOnce {
            work.carry_on(None);
            self.take_answer();
        }
    }

    /// Works on a question for `piece`, if no thread does.
    pub fn carry_on(&mut self, piece: Duration) {
        if let Some(work) = &mut self.work {
            work.carry_on(Some(piece));
        }
    }

    /// Takes the answer that was found. Returns whether there was one.
    fn take_answer(&mut self) -> bool {
        let answer = |work: &Work| work.answer.try_recv().ok();
        let Some(answer) = self.work.as_ref().and_then(answer) else {
            return false;
        };
        self.failure = answer(&mut self.facts).or(self.failure.take());
        if let Some(work) = self.work.take_if(|it| it.question == Question::Prove) {
            self.facts.proof.is_current &= !work.is_late;
            self.is_slow = work.begun.elapsed() > RECENT;
            self.proven = Some(Instant::now());
        }
        self.work = None;
        true
    }

    /// Takes the answers that were found. Returns whether the window has to be drawn again, also for progress.
    pub fn receive(&mut self, now: Duration) -> bool {
        let shows_progress = self.work.is_some() && now >= self.next_progress;
        let is_new = self.take_answer() || shows_progress;
        if is_new {
            self.next_progress = now + PROGRESS;
        }
        is_new
    }

    /// The reason why the last question has no answer; once.
    pub fn take_failure(&mut self) -> Option<String> {
        self.failure.take()
    }

    /// The progress of the work in the background, in words and as a share, 0..=1.
    pub fn progress(&self) -> Option<(String, f64)> {
        self.work.as_ref().and_then(Work::progress)
    }
}

/// Whether a picture cannot be shown before it is compared with exact Phong.
pub fn shows_exact(viewer: &Viewer) -> bool {
    viewer.show == ViewMode::Error || sides(viewer).contains(&Side::Reference)
}

/// The methods that are measured: those of reports, the one on screen, and those on the sides of a wipe.
fn wanted_methods(subject: &Subject) -> Vec<Method> {
    let own = subject.record.cuboid.iter().map(|it| it.segments);
    let mut methods: Vec<Method> = methods(alike(own)).collect();
    for method in subject.method.into_iter().chain(side_methods(subject)) {
        if !methods.contains(&method) {
            methods.push(method);
        }
    }
    methods
}

/// The methods on the sides of a wipe, beside that of the picture.
fn side_methods(subject: &Subject) -> impl Iterator<Item = Method> {
    let sides = sides(&subject.record.view).into_iter();
    let methods = sides.filter_map(|side| side_method(&side, subject.method));
    methods.filter(|method| Some(*method) != subject.method)
}
