//! A picture that rests in; what the reference says of it out, computed beside the window.
//!
//! Rule: one thread, the newest question wins, and an answer names the revision it is about, so that one that comes too
//! late is recognised. Whoever asks never waits.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread::{self, JoinHandle};

use fearless_simd::Level;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::WindowError;
use crate::components::{ShadingMode, View};
use crate::drawing::all_cores;
use crate::frame::{Frame, Keep, Workers, display_step};
use crate::memory;
use crate::prove::{Proof, REFUTED, UNDECIDED, Verdict, prove};
use crate::reference::{self, Truth};
use crate::scene::Scene;
use crate::systems;
use crate::trade::error_map::ErrorMap;
use crate::trade::metrics::{self, Difference, Picture};

/// Rows that are compared at once: what a picture of any size takes beside the two that are kept.
const BAND: usize = 64;

/// What was to be found out.
pub struct Question {
    /// A copy of the scene, of its own.
    pub scene: Scene,
    /// How it is drawn.
    pub view: View,
    /// Which state of the session that is.
    pub revision: u64,
}

/// Largest and mean error in levels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// The largest.
    pub max: f64,
    /// The mean over all pixels compared.
    pub mean: f64,
}

/// What was found out about one state of the session.
#[derive(Clone, Debug, PartialEq)]
pub struct Findings {
    /// Which state that is.
    pub revision: u64,
    /// The reference in the picture's own mode, 0x00RRGGBB.
    pub reference: Vec<u32>,
    /// Where the picture errs from exact Phong, in the colours of [`crate::trade::error_map`].
    pub error_map: Vec<u32>,
    /// Against exact Phong; `None` where nothing can be compared.
    pub errors: Option<Errors>,
    /// Against the picture's own mode; `None` where nothing can be compared.
    pub own_errors: Option<Errors>,
    /// The proof that the picture keeps its tolerance, which takes longest; `None` until it is there.
    pub proof: Option<Proof>,
}

/// What the thread sends.
pub enum Answer {
    /// Everything but the proof.
    Findings(Findings),
    /// The proof for the findings of the same revision.
    Proof(u64, Proof),
}

/// Finds out everything about `question`; `None` as soon as `cancelled` says yes, or where memory does not suffice.
pub fn examine(
    question: &mut Question,
    workers: Workers,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Option<Findings> {
    let view = question.view.clone();
    let [width, height] = view.size;
    let mut frame = Frame::new(Keep::Levels, workers);
    let phong = View {
        shading: Some(ShadingMode::Phong),
        ..view.clone()
    };
    let is_phong = view.shading == phong.shading;
    let mut reference = memory::room_for_pixels(view.size).ok()?;
    let mut error_map = memory::room_for_pixels(view.size).ok()?;
    let (mut errors, mut own_errors) = (Sum::default(), Sum::default());
    for start in (0..height).step_by(BAND) {
        let rows = start..(start + BAND).min(height);
        systems::draw_rows(&mut question.scene.world, &view, rows.clone(), &mut frame).ok()?;
        let truth = |view| {
            let rows = rows.clone();
            reference::picture(&question.scene.world, view, rows, cancelled, &|_| ())
        };
        let own = truth(&view)?;
        let exact = if is_phong { None } else { Some(truth(&phong)?) };
        let exact = picture_of(exact.as_ref().unwrap_or(&own));
        let drawn = Picture {
            width,
            levels: frame.levels(),
            triangles: frame.triangles(),
        };
        errors.add(&metrics::compare(drawn, exact));
        own_errors.add(&metrics::compare(drawn, picture_of(&own)));
        error_map.extend(ErrorMap::between(drawn, exact).pixels());
        reference.extend(own.levels.iter().map(|levels| {
            let [red, green, blue] = levels.map(display_step);
            u32::from_be_bytes([0, red, green, blue])
        }));
    }
    Some(Findings {
        revision: question.revision,
        reference,
        error_map,
        errors: errors.statistics(),
        own_errors: own_errors.statistics(),
        proof: None,
    })
}

impl Findings {
    /// Takes the proof, and marks in the error map what it lacks.
    pub fn add_proof(&mut self, proof: Proof) {
        for (pixel, mark) in self.error_map.iter_mut().zip(&proof.marks) {
            match mark.verdict {
                Verdict::Proven => {}
                Verdict::Undecided => *pixel = UNDECIDED,
                Verdict::Refuted => *pixel = REFUTED,
            }
        }
        self.proof = Some(proof);
    }
}

fn picture_of(truth: &Truth) -> Picture<'_, f64> {
    Picture {
        width: truth.width,
        levels: &truth.levels,
        triangles: &truth.triangles,
    }
}

/// The errors of bands, as those of the whole.
#[derive(Default)]
struct Sum {
    max: f64,
    total: f64,
    pixels: u64,
}

impl Sum {
    fn add(&mut self, difference: &Difference) {
        if let Some(error) = difference.error {
            self.max = self.max.max(error.max);
            self.total += error.mean * difference.compared_pixels as f64;
            self.pixels += difference.compared_pixels;
        }
    }

    fn statistics(&self) -> Option<Errors> {
        (self.pixels > 0).then(|| Errors {
            max: self.max,
            mean: self.total / self.pixels as f64,
        })
    }
}

/// The thread that finds out.
pub struct Examiner {
    questions: Option<Sender<Question>>,
    answers: Receiver<Answer>,
    /// The revision whose findings are wanted; work on any other stops.
    wanted: Arc<AtomicU64>,
    thread: Option<JoinHandle<()>>,
}

/// No session gets as far.
const NONE: u64 = u64::MAX;

impl Examiner {
    /// Starts the thread, and others that help it; one core is left for the window.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn start(level: Level) -> Result<Self, WindowError> {
        let threads = (all_cores() - 1).max(1);
        let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
        let (questions, asked) = mpsc::channel();
        let (answer, answers) = mpsc::channel();
        let wanted = Arc::new(AtomicU64::new(NONE));
        let still_wanted = Arc::clone(&wanted);
        let thread = thread::Builder::new()
            .name("examiner".to_owned())
            .spawn(move || work(&asked, &answer, &still_wanted, level, &pool))
            .map_err(WindowError::Examiner)?;
        Ok(Examiner {
            questions: Some(questions),
            answers,
            wanted,
            thread: Some(thread),
        })
    }

    /// Asks; what was asked before is dropped.
    pub fn ask(&self, question: Question) {
        self.wanted.store(question.revision, Ordering::Relaxed);
        if let Some(questions) = &self.questions {
            // Only a thread that panicked does not listen; its panic has been told.
            let _ = questions.send(question);
        }
    }

    /// Drops what was asked unless it is about this revision.
    pub fn keep_to(&self, revision: u64) {
        if self.wanted.load(Ordering::Relaxed) != revision {
            self.wanted.store(NONE, Ordering::Relaxed);
        }
    }

    /// What has been found out since this was last asked.
    pub fn answers(&self) -> impl Iterator<Item = Answer> {
        self.answers.try_iter()
    }
}

impl Drop for Examiner {
    fn drop(&mut self) {
        self.wanted.store(NONE, Ordering::Relaxed);
        self.questions = None;
        if let Some(thread) = self.thread.take() {
            // It ends within the time that a row takes.
            let _ = thread.join();
        }
    }
}

fn work(
    asked: &Receiver<Question>,
    answer: &Sender<Answer>,
    wanted: &AtomicU64,
    level: Level,
    pool: &ThreadPool,
) {
    while let Ok(mut question) = asked.recv() {
        let revision = question.revision;
        let cancelled = || wanted.load(Ordering::Relaxed) != revision;
        if cancelled() {
            continue;
        }
        pool.install(|| {
            // A window that no longer listens is closed, and asks nothing more.
            let Some(findings) = examine(&mut question, Workers::alone(level), &cancelled) else {
                return;
            };
            let _ = answer.send(Answer::Findings(findings));
            let (world, view) = (&mut question.scene.world, &question.view);
            let workers = [Workers::alone(level), Workers::alone(level)];
            if let Ok(Some(proof)) = prove(world, view, workers, &cancelled, &|_| ()) {
                let _ = answer.send(Answer::Proof(revision, proof));
            }
        });
    }
}
