//! The work on one question: by a thread, or piece by piece where there is none.

use std::panic::{self, AssertUnwindSafe};
use std::pin::Pin;
use std::sync::mpsc::{self, Receiver};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::task::{Context as TaskContext, Waker};
use std::time::Duration;

use anyhow::{Context, anyhow};
use rayon::{ThreadPool, ThreadPoolBuilder};
use web_time::Instant;

use super::facts::{Facts, Latest};
use crate::output::{Monitor, finished};
use crate::questions::job::all_cores;

/// The questions about a picture, in the order of their worth.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub enum Question {
    /// The values at the probed pixel, and along its row on the face seen there.
    Probe,
    Compare,
    /// It is asked while its tab is open.
    Vary,
    /// A part was clicked.
    LeaveOut,
    /// The timing of all methods, which takes less time than a proof.
    Measure,
    Prove,
    Require,
    CountSegments,
    /// The timing again, for longer.
    MeasureLonger,
}

impl Question {
    /// Whether what is known grows with each answer. The question is open until all is known.
    pub fn grows(self) -> bool {
        use Question::{Compare, Measure, MeasureLonger, Require, Vary};
        matches!(self, Compare | Measure | MeasureLonger | Require | Vary)
    }
}

/// The threads that answer questions, one a core: the window draws for a small part of the time.
///
/// # Errors
/// If the system gives no threads.
pub fn pool() -> anyhow::Result<ThreadPool> {
    let pool = ThreadPoolBuilder::new().num_threads(all_cores()).build();
    pool.context("cannot start the threads that compare and prove")
}

/// Stores a fact; returns the reason if there is none.
type Answer = Box<dyn FnOnce(&mut Facts) -> Option<String> + Send>;

/// The work on a question. It is cancelled when it is dropped, and ends within a row of the picture or a frame.
pub struct Work {
    pub question: Question,
    pub begun: Instant,
    /// Whether the picture has changed since.
    pub is_late: bool,
    pub answer: Receiver<Answer>,
    /// The present step, and the share of it that is done, 0..=1.
    progress: Arc<Mutex<(&'static str, f64)>>,
    /// The work that no thread does, and the time at which it is to pause.
    rest: Option<Pin<Box<dyn Future<Output = ()>>>>,
    until: Arc<Mutex<Option<Instant>>>,
}

impl Work {
    /// Lets a thread of `pool` answer a question; without a pool, [`Work::carry_on`] does.
    pub fn begin<T: Send + 'static>(
        pool: Option<&ThreadPool>,
        question: Question,
        fact: fn(&mut Facts) -> &mut Latest<T>,
        answer: impl AsyncFnOnce(Monitor<'_>) -> anyhow::Result<T> + Send + 'static,
    ) -> Work {
        let progress = Arc::<Mutex<_>>::default();
        let until = Arc::<Mutex<Option<Instant>>>::default();
        let (sender, receiver) = mpsc::channel::<Answer>();
        // The progress lives as long as the work is wanted.
        let wanted = Arc::downgrade(&progress);
        let watched = async move |is_due: Option<&(dyn Fn() -> bool + Sync)>| {
            answer(Monitor {
                is_cancelled: &|| wanted.strong_count() == 0,
                progress: &|step, share| {
                    if let Some(progress) = wanted.upgrade() {
                        *locked(&progress) = (step, share);
                    }
                },
                is_due,
            })
            .await
        };
        let tell = move |found: anyhow::Result<T>| {
            let store = move |facts: &mut Facts| {
                let reason = found.as_ref().err().map(|error| format!("{error:#}"));
                fact(facts).finish(found.ok());
                reason
            };
            // Nobody listens if it was cancelled meanwhile.
            let _ = sender.send(Box::new(store));
        };
        let mut rest: Option<Pin<Box<dyn Future<Output = ()>>>> = None;
        if let Some(pool) = pool {
            pool.spawn(move || {
                // A panic was reported, and must not leave the question open for ever.
                let found = panic::catch_unwind(AssertUnwindSafe(|| finished(watched(None))));
                tell(found.unwrap_or_else(|_| Err(anyhow!("a fault of the program"))));
            });
        } else {
            let until = Arc::clone(&until);
            let is_due = move || locked(&until).is_some_and(|until| Instant::now() >= until);
            rest = Some(Box::pin(async move { tell(watched(Some(&is_due)).await) }));
        }
        Work {
            question,
            begun: Instant::now(),
            is_late: false,
            answer: receiver,
            progress,
            rest,
            until,
        }
    }

    /// Carries on work that no thread does: for `piece`, to the end of the row or the frame; or to the end of the work.
    pub fn carry_on(&mut self, piece: Option<Duration>) {
        *locked(&self.until) = piece.map(|piece| Instant::now() + piece);
        let mut context = TaskContext::from_waker(Waker::noop());
        self.rest
            .take_if(|rest| rest.as_mut().poll(&mut context).is_ready());
    }

    /// The present step with its done share in words, and that share, 0..=1; `None` before the first step.
    pub fn progress(&self) -> Option<(String, f64)> {
        let (step, share) = *locked(&self.progress);
        (!step.is_empty()).then(|| (format!("{step}, {:.0} %", share * 100.0), share))
    }
}

fn locked<T>(value: &Mutex<T>) -> MutexGuard<'_, T> {
    value.lock().unwrap_or_else(PoisonError::into_inner)
}
