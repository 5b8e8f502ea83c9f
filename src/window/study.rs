//! The study: the facts about the picture, and the work on the next one. `ask` has the questions.
//!
//! One question is answered at a time. A question of more worth cancels another. A change of the picture outdates the facts
//! that it touches, and stops the work on them.

use std::sync::Arc;
use std::time::Duration;

use rayon::ThreadPool;
use web_time::Instant;

use super::facts::{Change, Facts, Latest};
use super::work::{Question, Work, pool};
use crate::components::{Camera, Side, View, active_camera};
use crate::output::Monitor;
use crate::questions::prove::Proof;
use crate::scene::{Scene, SceneRecord};
use crate::shading::Method;
use crate::systems::frame::Workers;

/// Progress is shown at most this often: each layout would slow the frames that are being timed.
const PROGRESS: Duration = Duration::from_millis(200);
/// A proof that takes longer does not follow a picture that moves. So long, too, the last one is told of then.
pub const SLOW_PROOF: Duration = Duration::from_millis(300);
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
pub enum Runner {
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
    runner: Runner,
    /// For [`Runner::Threads`].
    pool: Option<ThreadPool>,
    pub work: Option<Work>,
    /// When the last proof ended.
    proven: Option<Instant>,
    /// Whether that, or one given up since, took longer than [`SLOW_PROOF`].
    is_slow: bool,
    next_progress: Duration,
    /// The reason why a question has no answer, until it is taken.
    failure: Option<String>,
}

impl Study {
    /// # Errors
    /// If the system gives no threads.
    pub fn new(runner: Runner) -> anyhow::Result<Self> {
        let has_threads = runner == Runner::Threads;
        Ok(Study {
            facts: Facts::default(),
            runner,
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
        self.runner != Runner::AtOnce
    }

    /// Whether pictures are proven while they move.
    pub fn follows(&self) -> bool {
        self.pool.is_some() && !self.is_slow
    }

    /// The last proof, for a short time; it may be one of an earlier picture.
    pub fn last_proof(&self) -> Option<&Proof> {
        let is_recent = self.proven.is_some_and(|it| it.elapsed() < SLOW_PROOF);
        let (_, proof) = self.facts.proof.value.as_ref()?;
        is_recent.then_some(proof)
    }

    /// Outdates the facts that a change touches, and stops the work on them; a proof goes on if it is quick.
    pub fn outdate(&mut self, change: Change) {
        if change == Change::Nothing {
            return;
        }
        let proof = self.work.take_if(|it| it.question == Question::Prove);
        let is_slow = |it: &Work| it.begun.elapsed() > SLOW_PROOF;
        self.is_slow |= proof.as_ref().is_some_and(is_slow);
        self.work = proof.filter(|_| self.follows());
        if let Some(work) = &mut self.work {
            work.is_late = true;
        }
        self.facts.outdate(change);
    }

    /// Starts a question whose answer is not of the present picture, if none of the same or a higher priority is being
    /// answered and the picture rests. While it moves, too, a pixel is probed, and the picture proven if proofs follow.
    pub(super) fn start_if_due<T: Send + 'static>(
        &mut self,
        subject: &Subject,
        question: Question,
        fact: fn(&mut Facts) -> &mut Latest<T>,
        answer: impl AsyncFnOnce(Scene, &View, Monitor<'_>) -> anyhow::Result<T> + Send + 'static,
    ) {
        let is_unknown = question.grows() || !fact(&mut self.facts).is_current;
        let outranks = (self.work.as_ref()).is_none_or(|work| question < work.question);
        let may_run_now = match question {
            Question::Probe => true,
            Question::Prove if self.follows() => true,
            _ => !self.is_live() || subject.rests,
        };
        if !is_unknown || !outranks || !may_run_now {
            return;
        }
        let (name, record) = (subject.name.to_owned(), Arc::clone(subject.record));
        let (view, fit) = (subject.view, subject.fit);
        let fitted_answer = async move |monitor: Monitor<'_>| {
            let mut scene = Scene::spawn(name, &record);
            let camera = active_camera(&scene.world);
            let fitted = Camera::own(&scene.world, camera).widened(fit);
            scene.world.insert_one(camera, fitted)?;
            answer(scene, &view, monitor).await
        };
        // The work before is cancelled first.
        self.work = None;
        let begun = Work::begin(self.pool.as_ref(), question, fact, fitted_answer);
        let work = self.work.insert(begun);
        if self.runner == Runner::AtOnce {
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
            self.is_slow = work.begun.elapsed() > SLOW_PROOF;
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
