//! The facts about the picture, and the work in the background that finds them.

use std::panic::{self, AssertUnwindSafe};
use std::pin::Pin;
use std::sync::mpsc::{self, Receiver};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::task::{Context as TaskContext, Waker};
use std::time::Duration;

use anyhow::{Context, anyhow};
use rayon::{ThreadPool, ThreadPoolBuilder};
use web_time::Instant;

use super::comparison::{Comparison, Worst};
use super::pictures::side_method;
use crate::components::Side;
use crate::output::Monitor;
use crate::output::finished;
use crate::questions::job::all_cores;
use crate::questions::probe::Probe;
use crate::questions::prove::Proof;
use crate::questions::requires::segments::FewestSegments;
use crate::questions::requires::{Part, PartChanges};
use crate::questions::trade::{Measured, Measurement};
use crate::questions::vary::refined::Refined;
use crate::shading::Method;

/// The last value found, perhaps of an earlier picture.
#[derive(Debug)]
pub struct Latest<T> {
    pub value: Option<T>,
    /// Whether it is about the present picture. The value of an earlier one stays until then.
    pub is_current: bool,
}

impl<T> Default for Latest<T> {
    fn default() -> Self {
        Latest {
            value: None,
            is_current: false,
        }
    }
}

impl<T> Latest<T> {
    pub fn finish(&mut self, value: Option<T>) {
        (self.value, self.is_current) = (value, true);
    }

    /// The value, if it is that of the present picture.
    pub fn current(&self) -> Option<&T> {
        self.value.as_ref().filter(|_| self.is_current)
    }
}

/// The known facts.
#[derive(Default)]
pub struct Facts {
    /// The pixels of a row on one face, from left to right.
    pub section: Latest<Vec<Probe>>,
    pub comparison: Latest<Comparison>,
    pub proof: Latest<Proof>,
    /// The picture without a part.
    pub left_out: Latest<(Part, Vec<u32>)>,
    /// It is current from its first rows on.
    pub required: Latest<PartChanges>,
    pub segments: Latest<Vec<FewestSegments>>,
    /// Those of a number that is varied. They are about their own scene, whatever the picture is.
    pub curves: Latest<Refined>,
    /// The trade of the view: every method measured. It is current whatever method is on screen.
    pub trade: Latest<Measured>,
}

impl Facts {
    /// After a change of the picture. If only its method changed, the trade stays current.
    pub fn outdate(&mut self, is_same_view: bool) {
        self.section.is_current = false;
        self.comparison.is_current = false;
        self.proof.is_current = false;
        self.left_out.is_current = false;
        self.required.is_current = false;
        self.segments.is_current = false;
        self.trade.is_current &= is_same_view;
    }

    /// The answer about a pixel, possibly of an earlier picture.
    pub fn probed(&self, pixel: Option<[usize; 2]>) -> Option<&Probe> {
        let mut section = self.section.value.iter().flatten();
        section.find(|probe| Some(probe.pixel) == pixel)
    }

    /// The measurement of a method in the present view.
    pub fn measured(&self, method: Method) -> Option<&Measurement> {
        let mut measured = self.trade.current()?.methods.iter();
        measured.find(|it| it.method == method)
    }

    /// The median time of a method in the present view, in milliseconds.
    pub fn measured_time(&self, method: Option<Method>) -> Option<f64> {
        Some(self.measured(method?)?.timing.median)
    }

    /// The worst pixel of a side of a wipe or of the picture, as it is now; `shown` is the method on screen. The outer `None`
    /// says that it is not known yet, the inner one that nothing can be compared.
    pub fn worst(&self, side: &Side, shown: Option<Method>) -> Option<Option<Worst>> {
        if *side == Side::Reference {
            return Some(None);
        }
        let method = side_method(side, shown);
        let comparison = self.comparison.current();
        let compared = comparison.and_then(|it| it.worst_by(method, shown));
        let measured = || Some(self.measured(method?)?.error.map(Worst::from));
        compared.or_else(measured)
    }
}

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
        place: fn(&mut Facts) -> &mut Latest<T>,
        find: impl AsyncFnOnce(Monitor<'_>) -> anyhow::Result<T> + Send + 'static,
    ) -> Work {
        let progress = Arc::<Mutex<_>>::default();
        let until = Arc::<Mutex<Option<Instant>>>::default();
        let (tell, answer) = mpsc::channel::<Answer>();
        // The progress lives as long as the work is wanted.
        let wanted = Arc::downgrade(&progress);
        let find = async move |is_due: Option<&(dyn Fn() -> bool + Sync)>| {
            find(Monitor {
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
            let answer = move |facts: &mut Facts| {
                let reason = found.as_ref().err().map(|error| format!("{error:#}"));
                place(facts).finish(found.ok());
                reason
            };
            // Nobody listens if it was cancelled meanwhile.
            let _ = tell.send(Box::new(answer));
        };
        let mut rest: Option<Pin<Box<dyn Future<Output = ()>>>> = None;
        if let Some(pool) = pool {
            pool.spawn(move || {
                // A panic was reported, and must not leave the question open for ever.
                let found = panic::catch_unwind(AssertUnwindSafe(|| finished(find(None))));
                tell(found.unwrap_or_else(|_| Err(anyhow!("a fault of the program"))));
            });
        } else {
            let until = Arc::clone(&until);
            let is_due = move || locked(&until).is_some_and(|until| Instant::now() >= until);
            rest = Some(Box::pin(async move { tell(find(Some(&is_due)).await) }));
        }
        Work {
            question,
            begun: Instant::now(),
            is_late: false,
            answer,
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
