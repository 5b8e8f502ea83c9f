//! The present view -> what every method costs and errs in it, measured beside the window.
//!
//! Rule: a measurement is about one picture and ends with it; whoever asked sees how far it is, and never waits.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;
use std::time::Duration;

use rayon::ThreadPoolBuilder;

use crate::drawing::all_cores;
use crate::trade::{self, Progress, Report, Request};

/// How long frames are timed, the comparison with the reference apart.
pub const TIME: Duration = Duration::from_millis(1500);

/// What a measurement has told.
#[derive(Debug)]
pub enum News {
    /// How far it is.
    Progress(Progress),
    /// What came of it.
    Done(Box<Report>),
    /// Why nothing came of it.
    Failed(String),
}

/// A measurement as it is shown.
#[derive(Debug, Default)]
pub enum Measuring {
    /// None is shown.
    #[default]
    Off,
    /// How far it is; nothing is known before it has told.
    Running(Option<Progress>),
    /// What came of it.
    Done(Box<Report>),
}

impl Measuring {
    /// Whether something is shown.
    pub fn is_open(&self) -> bool {
        !matches!(self, Measuring::Off)
    }

    /// Whether it goes on.
    pub fn is_running(&self) -> bool {
        matches!(self, Measuring::Running(_))
    }
}

/// A measurement that goes on.
pub struct Measurement {
    news: Receiver<News>,
    cancelled: Arc<AtomicBool>,
}

impl Measurement {
    /// Starts it on threads of its own, a core left for the window.
    pub fn start(request: Request) -> Measurement {
        let (tell, news) = mpsc::channel();
        let cancelled = Arc::new(AtomicBool::new(false));
        let stop = Arc::clone(&cancelled);
        let failed = tell.clone();
        let started = thread::Builder::new()
            .name("measurement".to_owned())
            .spawn(move || measure(request, &tell, &stop));
        if let Err(error) = started {
            // The receiver stands beside us.
            let _ = failed.send(News::Failed(error.to_string()));
        }
        Measurement { news, cancelled }
    }

    /// What it has told since this was last asked.
    pub fn news(&self) -> Vec<News> {
        self.news.try_iter().collect()
    }
}

impl Drop for Measurement {
    fn drop(&mut self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }
}

fn measure(request: Request, tell: &Sender<News>, cancelled: &AtomicBool) {
    // Who no longer listens has dropped the measurement.
    let progress = |progress| drop(tell.send(News::Progress(progress)));
    let cancelled = || cancelled.load(Ordering::Relaxed);
    let threads = (all_cores() - 1).max(1);
    let news = match ThreadPoolBuilder::new().num_threads(threads).build() {
        Ok(pool) => match pool.install(|| trade::measure_unless(request, &cancelled, &progress)) {
            Ok(report) => News::Done(Box::new(report)),
            Err(error) => News::Failed(error.to_string()),
        },
        Err(error) => News::Failed(error.to_string()),
    };
    drop(tell.send(news));
}
