//! Work that takes longer than a frame, done by one background thread: questions about a picture, and their answers.
//!
//! A new order cancels the one before it. A cancelled job ends within a row of the picture or a frame.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;
use std::time::Duration;

use anyhow::Context;
use fearless_simd::Level;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::comparison::Comparison;
use super::facts::Facts;
use super::pictures::view_at;
use crate::components::{Show, View, get, viewer};
use crate::drawing::all_cores;
use crate::probe;
use crate::prove::prove;
use crate::report::Monitor;
use crate::requires::bits::bits;
use crate::requires::{self, Part};
use crate::scene::{Scene, SceneRecord};
use crate::shading::Method;
use crate::trade::{Measurement, Request, live};

/// One question about a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Task {
    /// The values at this pixel, and along its row on the face seen there.
    Probe([usize; 2]),
    /// The picture without a part of the model.
    LeaveOut(Part),
    Compare,
    Prove,
    Require,
    /// The bits that each stage of the model requires.
    Bits,
    Measure,
}

/// An answer to a [`Task`].
pub enum Answer {
    /// Puts the answer among the facts.
    Done(Box<dyn FnOnce(&mut Facts) + Send>),
    /// The share of the task that is done, 0..=1.
    Progress(f64),
    /// The reason why there is no answer.
    Failed(String),
}

/// An answer as the window shows it.
#[derive(Debug)]
pub struct Job<T> {
    pub value: Option<T>,
    pub state: State,
}

/// How an answer relates to the present picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum State {
    /// There is no value, or it is that of an earlier picture.
    #[default]
    Idle,
    /// The share that is done, 0..=1.
    Running(f64),
    Done,
    Failed(String),
}

impl<T> Default for Job<T> {
    fn default() -> Self {
        Job {
            value: None,
            state: State::Idle,
        }
    }
}

impl<T> Job<T> {
    pub fn finish(&mut self, value: T) {
        self.value = Some(value);
        self.state = State::Done;
    }

    /// The value, if it is that of the present picture.
    pub fn current(&self) -> Option<&T> {
        self.value.as_ref().filter(|_| self.state == State::Done)
    }
}

/// A picture and questions about it, in order.
#[derive(Clone)]
pub struct Order {
    pub name: String,
    pub record: Arc<SceneRecord>,
    pub size: [usize; 2],
    pub threads: usize,
    pub tasks: Vec<Task>,
    /// The method that holds the budget, where there is one.
    pub held: Option<Method>,
    /// The methods to measure, and their known measurements in this view.
    pub methods: Vec<Method>,
    pub known: Vec<Measurement>,
    /// How long the frames of all methods are timed together.
    pub time: Duration,
}

/// Set when the answers are no longer wanted.
type Cancelled = Arc<AtomicBool>;

/// The background thread.
pub struct Jobs {
    orders: Sender<(Order, Cancelled)>,
    answers: Receiver<(Task, Answer, Cancelled)>,
    current: Cancelled,
}

impl Jobs {
    /// Starts the thread and its pool; one core is left for the window.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn start(level: Level) -> anyhow::Result<Self> {
        let threads = (all_cores() - 1).max(1);
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.context("cannot start the threads that compare and prove")?;
        let (orders, ordered) = mpsc::channel();
        let (tell, answers) = mpsc::channel();
        thread::Builder::new()
            .name("jobs".to_owned())
            .spawn(move || work(&ordered, &tell, level, &pool))
            .context("cannot start the thread that compares and proves")?;
        Ok(Jobs {
            orders,
            answers,
            current: Cancelled::default(),
        })
    }

    /// Cancels the order before and does this one.
    pub fn submit(&mut self, order: Order) {
        self.cancel();
        self.current = Cancelled::default();
        // The receiver is gone only after a panic, which was reported.
        let _ = self.orders.send((order, Arc::clone(&self.current)));
    }

    /// Cancels the last order.
    pub fn cancel(&self) {
        self.current.store(true, Ordering::Relaxed);
    }

    /// The answers to the last order since this was last asked.
    pub fn answers(&self) -> Vec<(Task, Answer)> {
        let answers = self.answers.try_iter();
        answers
            .filter(|(.., cancelled)| !cancelled.load(Ordering::Relaxed))
            .map(|(task, answer, _)| (task, answer))
            .collect()
    }
}

impl Drop for Jobs {
    fn drop(&mut self) {
        self.cancel();
    }
}

fn work(
    orders: &Receiver<(Order, Cancelled)>,
    answers: &Sender<(Task, Answer, Cancelled)>,
    level: Level,
    pool: &ThreadPool,
) {
    while let Ok((order, cancelled)) = orders.recv() {
        // A window that no longer listens is closed, and has cancelled the order.
        let tell = |task, answer| drop(answers.send((task, answer, Arc::clone(&cancelled))));
        let is_cancelled = || cancelled.load(Ordering::Relaxed);
        pool.install(|| answer_all(&order, level, &is_cancelled, &tell));
    }
}

/// Answers all questions of an order, on rayon's current threads.
pub fn answer_all(
    order: &Order,
    level: Level,
    cancelled: &(dyn Fn() -> bool + Sync),
    tell: &(dyn Fn(Task, Answer) + Sync),
) {
    if cancelled() {
        return;
    }
    let mut scene = Scene::spawn(order.name.clone(), &order.record);
    let view = View::of(&scene.world, order.size);
    let view = order.held.map_or(view.clone(), |method| method.view(&view));
    for task in &order.tasks {
        let progress = |_, share| tell(*task, Answer::Progress(share));
        let monitor = Monitor {
            is_cancelled: cancelled,
            progress: &progress,
        };
        match answer(*task, order, &mut scene, &view, level, monitor) {
            _ if cancelled() => return,
            Ok(answer) => tell(*task, answer),
            Err(error) => tell(*task, Answer::Failed(format!("{error:#}"))),
        }
    }
}

/// The answer to one question.
fn answer(
    task: Task,
    order: &Order,
    scene: &mut Scene,
    view: &View,
    level: Level,
    monitor: Monitor,
) -> anyhow::Result<Answer> {
    Ok(match task {
        Task::Probe(pixel) => {
            let show: Show = get(&scene.world, viewer(&scene.world)).unwrap_or_default();
            let view = view_at(&show, view, pixel[0]);
            let section = probe::section(scene, &view, pixel, level)?;
            put(section, |facts| &mut facts.section)
        }
        Task::LeaveOut(part) => {
            let picture = requires::picture_without(scene, view, part, monitor)?;
            put(picture, |facts| &mut facts.without)
        }
        Task::Compare => {
            let comparison = Comparison::of(&mut scene.world, view, level, monitor)?;
            put(comparison, |facts| &mut facts.comparison)
        }
        Task::Prove => {
            let proof = prove(&mut scene.world, view, None, level, monitor)?;
            put(proof, |facts| &mut facts.proof)
        }
        Task::Require => {
            let parts = requires::ranked(scene, view, monitor)?;
            put(parts, |facts| &mut facts.required)
        }
        Task::Bits => put(bits(scene, view, monitor)?, |facts| &mut facts.bits),
        Task::Measure => {
            let request = Request {
                camera: String::new(),
                scene: scene.snapshot(),
                view: view.clone(),
                methods: order.methods.clone(),
                threads: order.threads,
                level,
                time: order.time,
                command: String::new(),
            };
            let measured = live::measure(&request, &order.known, monitor)?;
            put(measured, |facts| &mut facts.trade)
        }
    })
}

/// The answer that puts a value in its place.
fn put<T: Send + 'static>(value: T, place: fn(&mut Facts) -> &mut Job<T>) -> Answer {
    Answer::Done(Box::new(move |facts| place(facts).finish(value)))
}
