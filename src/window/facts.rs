//! The facts about the picture: the questions that the window asks of its jobs, and their answers.

use std::sync::{Arc, mpsc};
use std::time::Duration;

use super::app::App;
use super::comparison::Comparison;
use super::inspector::Kind;
use super::jobs::{Answer, Job, Jobs, Order, State, Task, answer_all};
use crate::components::{Inspector, Probed, ShadingMode, Show, Side, Tab, Tolerance, ViewMode};
use crate::probe::Probe;
use crate::prove::Proof;
use crate::requires::PartChange;
use crate::requires::bits::StageBits;
use crate::shading::{METHODS, Method};
use crate::trade::Measurement;

/// The time between two reports of progress: a layout takes time from the frames that are measured.
const PROGRESS: Duration = Duration::from_millis(200);
/// How long the frames of all methods are timed together, pass by pass, while nothing changes. The first takes the fewest
/// samples that give a median.
const PASSES: [Duration; 3] = [
    Duration::ZERO,
    Duration::from_secs(1),
    Duration::from_secs(3),
];

/// The known answers.
#[derive(Default)]
pub struct Facts {
    /// The pixels of a row on one face, from left to right.
    pub section: Job<Vec<Probe>>,
    /// The picture without the part that is left out, 0x00RRGGBB.
    pub without: Job<Vec<u32>>,
    pub comparison: Job<Comparison>,
    pub proof: Job<Proof>,
    pub required: Job<Vec<PartChange>>,
    pub bits: Job<Vec<StageBits>>,
    /// The trade of the view: every method measured. It is current whatever method is on screen.
    pub trade: Job<Vec<Measurement>>,
    /// The passes of [`PASSES`] that were made.
    passes: usize,
}

impl Facts {
    /// The picture is another one; where the view is the same, only its method is.
    pub fn are_old(&mut self, is_same_view: bool) {
        for task in [
            Task::Probe([0, 0]),
            Task::Compare,
            Task::Prove,
            Task::Require,
            Task::Bits,
        ] {
            *self.state(task) = State::Idle;
        }
        self.without.state = State::Idle;
        if !is_same_view {
            self.trade.state = State::Idle;
            self.passes = 0;
        }
    }

    fn state(&mut self, task: Task) -> &mut State {
        match task {
            Task::Probe(_) => &mut self.section.state,
            Task::LeaveOut(_) => &mut self.without.state,
            Task::Compare => &mut self.comparison.state,
            Task::Prove => &mut self.proof.state,
            Task::Require => &mut self.required.state,
            Task::Bits => &mut self.bits.state,
            Task::Measure => &mut self.trade.state,
        }
    }
}

impl App {
    /// The questions whose answers the window shows and does not have, in the order of their worth.
    fn tasks(&mut self) -> Vec<Task> {
        let (show, Inspector(tab)): (Show, Inspector) = (self.look(), self.look());
        let is_live = self.jobs.is_some();
        let shows_exact = self.desk.blinks.is_some()
            || matches!(show.mode, ViewMode::Error | ViewMode::Difference)
            || show.mode == ViewMode::Wipe && show.sides.contains(&Side::Reference);
        let [width, height] = self.pictures.size();
        let Probed(pixel) = self.look();
        let pixel = pixel.filter(|[x, y]| *x < width && *y < height);
        let measures = is_live && self.shows_times;
        let methods = self.wanted_methods();
        let is_unknown = |it: &Method| self.measured(it.mode, it.tolerance).is_none();
        if self.facts.trade.state == State::Done && methods.iter().any(is_unknown) {
            self.facts.passes = 0;
        }
        let wanted = |task, is_wanted: bool| is_wanted.then_some(task);
        let tasks = [
            pixel.map(Task::Probe),
            self.desk.left_out.map(Task::LeaveOut),
            wanted(Task::Compare, is_live || shows_exact),
            // Its first pass takes less time than a proof, its others more.
            wanted(Task::Measure, measures && self.facts.passes == 0),
            wanted(Task::Prove, is_live || tab == Some(Tab::Proof)),
            wanted(Task::Require, tab == Some(Tab::Required)),
            wanted(Task::Bits, tab == Some(Tab::Required)),
            wanted(Task::Measure, measures && self.facts.passes > 0),
        ];
        let is_open = |task: &Task| match self.facts.state(*task) {
            State::Idle | State::Running(_) => true,
            State::Done => *task == Task::Measure && self.facts.passes < PASSES.len(),
            State::Failed(_) => false,
        };
        tasks.into_iter().flatten().filter(is_open).collect()
    }

    /// The answer about the probed pixel, possibly of an earlier picture.
    pub fn probed(&self) -> Option<&Probe> {
        let Probed(pixel) = self.look();
        let mut section = self.facts.section.value.iter().flatten();
        section.find(|probe| Some(probe.pixel) == pixel)
    }

    /// The measurement of a method, if there is one; the state of [`Facts::trade`] says whether it is that of the present
    /// view.
    pub fn measured(&self, mode: ShadingMode, tolerance: f64) -> Option<&Measurement> {
        let method = Method::of(mode, tolerance);
        let mut measured = self.facts.trade.value.iter().flatten();
        measured.find(|it| it.method == method)
    }

    /// The method on screen; `None` where the cuboids have different modes.
    pub fn method(&self) -> Option<Method> {
        let Tolerance(tolerance) = self.look();
        let own = || Some(Method::of(self.shading()?, tolerance));
        self.held.or_else(own)
    }

    /// The milliseconds of a frame on screen: measured, or the last one's until that is done.
    pub fn milliseconds(&self) -> Option<f64> {
        let method = self
            .method()
            .filter(|_| self.facts.trade.current().is_some());
        let measured = method.and_then(|it| self.measured(it.mode, it.tolerance));
        let last = || self.pictures.time.map(|time| time.as_secs_f64() * 1e3);
        measured.map(|it| it.timing.median).or_else(last)
    }

    /// The methods that are measured: those of reports, the one on screen, and those on the sides of a wipe.
    fn wanted_methods(&self) -> Vec<Method> {
        let show: Show = self.look();
        let side = |side: &Side| match *side {
            Side::Method { mode, tolerance } if show.mode == ViewMode::Wipe => {
                Some(Method::of(mode, tolerance))
            }
            _ => None,
        };
        // The assignment's shortcut is no way to save time, and its frames take so long that they would delay a key.
        let mut methods = METHODS.to_vec();
        methods.retain(|it| it.mode != ShadingMode::UnitVectors);
        for method in self
            .method()
            .into_iter()
            .chain(show.sides.iter().filter_map(side))
        {
            if !methods.contains(&method) {
                methods.push(method);
            }
        }
        methods
    }

    /// Asks the open questions once the picture rests, or at once where there are no background jobs. A pixel is probed even
    /// while things move, because that takes little time.
    pub fn order_jobs(&mut self) {
        let rests = self.jobs.is_none() || self.rests();
        let mut tasks = self.tasks();
        tasks.retain(|task| rests || matches!(task, Task::Probe(_)));
        if tasks.iter().all(|task| self.ordered.contains(task)) {
            return;
        }
        let order = Order {
            name: self.scene.name.clone(),
            record: Arc::clone(&self.state),
            size: self.picture_size(),
            threads: self.threads,
            tasks: tasks.clone(),
            held: self.held,
            methods: self.wanted_methods(),
            known: self.facts.trade.current().cloned().unwrap_or_default(),
            time: PASSES[self.facts.passes.min(PASSES.len() - 1)],
        };
        self.ordered = tasks;
        if let Some(jobs) = &mut self.jobs {
            return jobs.submit(order);
        }
        let (tell, answers) = mpsc::channel();
        let tell = |task, answer| drop(tell.send((task, answer)));
        answer_all(&order, self.level, &|| false, &tell);
        for (task, answer) in answers.try_iter() {
            self.take(task, answer);
        }
    }

    /// Takes the answers of the jobs; whether the window shows something new by them.
    pub fn receive(&mut self, now: Duration) -> bool {
        let answers = self.jobs.as_ref().map_or_else(Vec::new, Jobs::answers);
        let mut is_new = false;
        for (task, answer) in answers {
            let is_progress = matches!(answer, Answer::Progress(_));
            is_new |= !is_progress || now >= self.next_progress;
            self.take(task, answer);
        }
        if is_new {
            self.next_progress = now + PROGRESS;
        }
        is_new
    }

    fn take(&mut self, task: Task, answer: Answer) {
        if !matches!(answer, Answer::Progress(_)) {
            self.ordered.retain(|ordered| *ordered != task);
        }
        let facts = &mut self.facts;
        match answer {
            Answer::Done(put) => put(facts),
            // A first measurement stays current while it is refined.
            Answer::Progress(_) if task == Task::Measure && facts.passes > 0 => return,
            Answer::Progress(share) => {
                *facts.state(task) = State::Running(share);
                return;
            }
            Answer::Failed(reason) => {
                *facts.state(task) = State::Failed(reason.clone());
                return self.say(reason);
            }
        }
        match (task, &facts.section.value, &facts.proof.value) {
            (Task::Probe(_), Some(section), _) => {
                if let Some(object) = &section[0].object {
                    self.desk.selected = Some((Kind::Cuboid, object.clone()));
                }
            }
            (Task::Prove, _, Some(proof)) => {
                if let Some(comparison) = &mut facts.comparison.value {
                    comparison.mark(proof);
                }
            }
            (Task::Measure, ..) => facts.passes += 1,
            _ => {}
        }
    }
}
