//! Work that takes longer than a frame, done beside the window: a [`Job`] in, [`Progress`] out.
//!
//! ```text
//! Window --submit, cancel--> Jobs --one job at a time--> thread, with a pool --Progress--> Session
//! ```
//! Rule: a job cancels the one before it, and begins when that has ended, so that nothing runs beside a measurement.
//! What is cancelled ends within a row of the picture or a frame, and is not heard of again; dropping [`Jobs`] waits for
//! that.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread::{self, JoinHandle};

use anyhow::Context;
use fearless_simd::Level;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::examination::{ReferenceRequest, ReferenceResult, examine};
use crate::drawing::all_cores;
use crate::frame::Workers;
use crate::prove::{Proof, prove};
use crate::requires::{self, Part, PartChange};
use crate::trade::{self, Report};

/// What is to be done.
pub enum Job {
    /// Compares a picture with the reference, then proves it.
    Examine(ReferenceRequest),
    /// Measures every method.
    Measure(trade::Request),
    /// Finds what the scene requires.
    Require(ReferenceRequest),
    /// Draws the picture without a part of the model.
    LeaveOut(ReferenceRequest, Part),
}

/// What a job has come to.
#[derive(Debug)]
pub enum Progress {
    Examined(ReferenceResult),
    /// The proof for the result of the same revision.
    Proven(u64, Proof),
    Measuring(&'static str, f64),
    Measured(Box<Report>),
    /// How much is known of what the scene requires, 0..=1.
    Requiring(f64),
    /// What the picture of this revision requires, the part that matters most first.
    Required(u64, Vec<PartChange>),
    /// The picture of this revision without a part, 0x00RRGGBB.
    LeftOut(u64, Vec<u32>),
    /// Why nothing was measured.
    NotMeasured(String),
}

/// Set when nobody wants the job's result any more.
type Cancelled = Arc<AtomicBool>;

/// The thread that does jobs.
pub struct Jobs {
    submitted: Option<Sender<(Job, Cancelled)>>,
    progress: Receiver<(Progress, Cancelled)>,
    current: Cancelled,
    thread: Option<JoinHandle<()>>,
}

impl Jobs {
    /// Starts the thread and the pool that it works with; one core is left for the window.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn start(level: Level) -> anyhow::Result<Self> {
        let threads = (all_cores() - 1).max(1);
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.context("cannot start the threads that draw")?;
        let (submitted, jobs) = mpsc::channel();
        let (tell, progress) = mpsc::channel();
        let thread = thread::Builder::new()
            .name("jobs".to_owned())
            .spawn(move || work(&jobs, &tell, level, &pool))
            .context("cannot start the thread that compares and measures")?;
        Ok(Jobs {
            submitted: Some(submitted),
            progress,
            current: Cancelled::default(),
            thread: Some(thread),
        })
    }

    /// Has this done as soon as the job before it, which is cancelled, has ended.
    pub fn submit(&mut self, job: Job) {
        self.cancel();
        self.current = Cancelled::default();
        if let Some(submitted) = &self.submitted {
            // Only a thread that panicked does not listen; its panic has been told.
            let _ = submitted.send((job, Arc::clone(&self.current)));
        }
    }

    /// Cancels the job that was submitted last.
    pub fn cancel(&self) {
        self.current.store(true, Ordering::Relaxed);
    }

    /// What the present job has come to since this was last asked.
    pub fn progress(&self) -> Vec<Progress> {
        let told = self.progress.try_iter();
        told.filter(|(_, cancelled)| !cancelled.load(Ordering::Relaxed))
            .map(|(progress, _)| progress)
            .collect()
    }
}

impl Drop for Jobs {
    fn drop(&mut self) {
        self.cancel();
        self.submitted = None;
        if let Some(thread) = self.thread.take() {
            // A panic of the thread has been told.
            let _ = thread.join();
        }
    }
}

fn work(
    jobs: &Receiver<(Job, Cancelled)>,
    progress: &Sender<(Progress, Cancelled)>,
    level: Level,
    pool: &ThreadPool,
) {
    while let Ok((job, cancelled)) = jobs.recv() {
        let is_cancelled = || cancelled.load(Ordering::Relaxed);
        // A window that no longer listens is closed, and has cancelled the job.
        let tell = |told| drop(progress.send((told, Arc::clone(&cancelled))));
        match job {
            _ if is_cancelled() => {}
            Job::Examine(request) => {
                pool.install(|| examine_and_prove(request, level, &is_cancelled, &tell));
            }
            Job::Require(request) => pool.install(|| {
                let on_row = |share| tell(Progress::Requiring(share));
                let parts = requires::ranked(&request.scene, &request.view, &is_cancelled, &on_row);
                let known = parts.map(|parts| Progress::Required(request.revision, parts));
                known.into_iter().for_each(tell);
            }),
            Job::LeaveOut(request, part) => pool.install(|| {
                let picture =
                    requires::picture_without(&request.scene, &request.view, part, &is_cancelled);
                let drawn = picture.map(|picture| Progress::LeftOut(request.revision, picture));
                drawn.into_iter().for_each(tell);
            }),
            Job::Measure(request) => pool.install(|| {
                let on_progress = |step, share| tell(Progress::Measuring(step, share));
                tell(match trade::measure(request, &is_cancelled, &on_progress) {
                    Ok(report) => Progress::Measured(Box::new(report)),
                    Err(error) => Progress::NotMeasured(error.to_string()),
                });
            }),
        }
    }
}

fn examine_and_prove(
    mut request: ReferenceRequest,
    level: Level,
    cancelled: &(dyn Fn() -> bool + Sync),
    tell: &dyn Fn(Progress),
) {
    let Some(result) = examine(&mut request, Workers::alone(level), cancelled) else {
        return;
    };
    let revision = result.revision;
    tell(Progress::Examined(result));
    let (world, view) = (&mut request.scene.world, &request.view);
    if let Ok(Some(proof)) = prove(world, view, level, cancelled, &|_| ()) {
        tell(Progress::Proven(revision, proof));
    }
}
