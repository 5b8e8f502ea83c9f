//! Work that takes longer than a frame, done beside the window: a [`Request`] about a [`Snapshot`] in, [`Progress`] out.
//!
//! ```text
//! Window --submit, cancel--> Jobs --one job at a time--> thread, with a pool --Progress--> Session
//! ```
//! Rule: a job cancels the one before it, and begins when that has ended, so that nothing runs beside a measurement.
//! What is cancelled ends within a row of the picture, a frame, or the comparison of one, and is not heard of again.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;
use std::time::Duration;

use anyhow::Context;
use fearless_simd::Level;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::examination::{ReferenceResult, examine};
use super::session::{Request, Snapshot};
use crate::drawing::all_cores;
use crate::prove::{Proof, prove};
use crate::requires::{self, PartChange};
use crate::shading::METHODS;
use crate::trade::{self, Report};

/// How long the frames of a measurement are timed, the comparison with the reference apart.
const MEASURING_TIME: Duration = Duration::from_millis(1500);

/// What a job has come to.
#[derive(Debug)]
pub enum Progress {
    Examined(ReferenceResult),
    /// The proof for that result.
    Proven(Proof),
    /// Why the picture was not compared, or not proven.
    NotExamined(String),
    Measuring(&'static str, f64),
    Measured(Box<Report>),
    /// How much is known of what the scene requires, 0..=1.
    Requiring(f64),
    /// What the picture requires, the part that matters most first.
    Required(Vec<PartChange>),
    /// The picture without a part, 0x00RRGGBB.
    LeftOut(Vec<u32>),
    /// Why nothing was measured.
    NotMeasured(String),
}

/// Set when nobody wants the job's result any more.
type Cancelled = Arc<AtomicBool>;

/// The thread that does jobs.
pub struct Jobs {
    submitted: Sender<(Request, Snapshot, Cancelled)>,
    /// The picture's revision, and what is known of it.
    progress: Receiver<(u64, Progress, Cancelled)>,
    current: Cancelled,
}

impl Jobs {
    /// Starts the thread and the pool that it works with; one core is left for the window,
    /// but for the reference of a measurement.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn start(level: Level) -> anyhow::Result<Self> {
        let threads = (all_cores() - 1).max(1);
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.context("cannot start the threads that draw")?;
        let (submitted, jobs) = mpsc::channel();
        let (tell, progress) = mpsc::channel();
        thread::Builder::new()
            .name("jobs".to_owned())
            .spawn(move || work(&jobs, &tell, level, &pool))
            .context("cannot start the thread that compares and measures")?;
        Ok(Jobs {
            submitted,
            progress,
            current: Cancelled::default(),
        })
    }

    /// Has this done as soon as the job before it, which is cancelled, has ended.
    pub fn submit(&mut self, request: Request, snapshot: Snapshot) {
        self.cancel();
        self.current = Cancelled::default();
        let job = (request, snapshot, Arc::clone(&self.current));
        // Only a thread that panicked does not listen; its panic has been told.
        let _ = self.submitted.send(job);
    }

    /// Cancels the job that was submitted last.
    pub fn cancel(&self) {
        self.current.store(true, Ordering::Relaxed);
    }

    /// What the present job has come to since this was last asked, and the revision that it is about.
    pub fn progress(&self) -> Vec<(u64, Progress)> {
        let told = self.progress.try_iter();
        told.filter(|(.., cancelled)| !cancelled.load(Ordering::Relaxed))
            .map(|(revision, progress, _)| (revision, progress))
            .collect()
    }
}

impl Drop for Jobs {
    fn drop(&mut self) {
        self.cancel();
    }
}

fn work(
    jobs: &Receiver<(Request, Snapshot, Cancelled)>,
    progress: &Sender<(u64, Progress, Cancelled)>,
    level: Level,
    pool: &ThreadPool,
) {
    while let Ok((request, mut snapshot, cancelled)) = jobs.recv() {
        let is_cancelled = || cancelled.load(Ordering::Relaxed);
        let revision = snapshot.revision;
        // A window that no longer listens is closed, and has cancelled the job.
        let tell = |told| drop(progress.send((revision, told, Arc::clone(&cancelled))));
        pool.install(|| match request {
            _ if is_cancelled() => {}
            // The window does it, which has the frame.
            Request::Time => {}
            Request::Examine => {
                let examined = examine(&mut snapshot, level, &is_cancelled).and_then(|result| {
                    result.map(Progress::Examined).into_iter().for_each(&tell);
                    let (world, view) = (&mut snapshot.scene.world, &snapshot.view);
                    prove(world, view, level, &is_cancelled, &|_| ())
                });
                match examined {
                    Ok(proof) => proof.map(Progress::Proven).into_iter().for_each(&tell),
                    Err(full) => tell(Progress::NotExamined(full.to_string())),
                }
            }
            Request::Require => {
                let on_row = |share| tell(Progress::Requiring(share));
                let Snapshot { scene, view, .. } = &snapshot;
                let parts = requires::ranked(scene, view, &is_cancelled, &on_row);
                parts.map(Progress::Required).into_iter().for_each(tell);
            }
            Request::LeaveOut(part) => {
                let Snapshot { scene, view, .. } = &snapshot;
                let picture = requires::picture_without(scene, view, part, &is_cancelled);
                picture.map(Progress::LeftOut).into_iter().for_each(tell);
            }
            Request::Measure => {
                let on_progress = |step, share| tell(Progress::Measuring(step, share));
                let request = measurement(snapshot, level);
                tell(match trade::measure(request, &is_cancelled, &on_progress) {
                    Ok(report) => Progress::Measured(Box::new(report)),
                    Err(error) => {
                        Progress::NotMeasured(format!("{:#}", anyhow::Error::from(error)))
                    }
                });
            }
        });
    }
}

/// What is measured of a picture: every method, on one thread.
pub fn measurement(snapshot: Snapshot, level: Level) -> trade::Request {
    let Snapshot { scene, view, .. } = snapshot;
    trade::Request {
        camera: scene.camera_names().swap_remove(scene.active_camera()),
        scene,
        view,
        methods: METHODS.to_vec(),
        threads: 1,
        level,
        time: MEASURING_TIME,
        time_batch: trade::time_batch,
        command: String::new(),
    }
}
