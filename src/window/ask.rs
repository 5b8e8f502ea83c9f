//! The questions about the picture that the window asks, each where its answer is shown.

use std::time::Duration;

use super::desk::Desk;
use super::facts::Comparison;
use super::inspector::Tab;
use super::pictures::{exact_view, side_method, side_view, sides};
use super::study::{Study, Subject};
use super::work::Question;
use crate::components::{ShadingMode, Side, View, ViewMode, Viewer, alike};
use crate::questions::job::Drawing;
use crate::questions::probe::{self, Probe};
use crate::questions::prove::{Proof, prove};
use crate::questions::requires::segments::fewest_segments;
use crate::questions::requires::{Part, more_changes, picture_without};
use crate::questions::trade::batch::time_here;
use crate::questions::trade::verdict::is_sure;
use crate::questions::trade::{Request, measure};
use crate::shading::{Method, methods};

/// The parts of the model that are left out, or the values of a number that are drawn, before the window shows the result.
const PER_STEP: usize = 4;
/// How long the frames of all methods are timed together, first and at most.
const TIMING: Duration = Duration::from_secs(1);
const LONGEST: Duration = Duration::from_secs(16);

impl Study {
    /// Asks the questions whose answers the window shows and does not have. Where they are answered at once, only those that
    /// must be.
    pub fn ask(&mut self, subject: &Subject, desk: &Desk) {
        let is_live = self.is_live();
        let shows_times = is_live && desk.shows_times;
        if let Some((pixel, side)) = subject.pixel {
            self.probe(subject, pixel, side);
        }
        let waits = desk.blinks.is_some() || desk.awaits_worst;
        if is_live || waits || shows_exact(&subject.record.view) {
            self.compare(subject);
        }
        if desk.is_open(Tab::Vary) {
            self.vary(subject, desk);
        }
        if let Some(part) = desk.shown_without() {
            self.leave_out(subject, part);
        }
        if shows_times {
            self.measure(subject, Question::Measure);
        }
        if is_live || desk.is_open(Tab::Proof) {
            self.prove(subject);
        }
        if desk.is_open(Tab::Required) {
            self.require(subject);
        }
        if shows_times {
            self.measure(subject, Question::MeasureLonger);
        }
    }

    /// Finds the values at the pixel, and along its row, in the picture that is shown there.
    fn probe(&mut self, subject: &Subject, pixel: [usize; 2], side: Side) {
        let level = subject.workers.level();
        let section = &mut self.facts.section;
        let is_at = |probe: &Probe| probe.pixel == pixel;
        let known = section.value.as_ref();
        section.is_current &= known.is_none_or(|it| it.0 == side && it.1.iter().any(is_at));
        self.start_if_due(
            subject,
            Question::Probe,
            |facts| &mut facts.section,
            async move |mut scene, view, _| {
                let view = exact_view(&side, view);
                let section = probe::section(&mut scene, &view, pixel, level)?;
                Ok((side, section))
            },
        );
    }

    /// Compares the picture, and the sides of a wipe, with exact Phong.
    fn compare(&mut self, subject: &Subject) {
        let level = subject.workers.level();
        let methods: Vec<Method> = side_methods(subject).collect();
        let comparison = &self.facts.comparison;
        let knows_all = comparison.value.as_ref().is_none_or(|known| {
            let knows = |it: &Method| known.worst_by(Some(*it), subject.method).is_some();
            methods.iter().all(knows)
        });
        if comparison.is_current && knows_all {
            return;
        }
        self.start_if_due(
            subject,
            Question::Compare,
            |facts| &mut facts.comparison,
            async move |mut scene, view, monitor| {
                Comparison::of(&mut scene.world, view, methods, level, monitor).await
            },
        );
    }

    /// Refines the curves of the number that is varied.
    fn vary(&mut self, subject: &Subject, desk: &Desk) {
        let wanted = desk.varied.as_ref().map(|varied| &varied.wanted);
        let Some(Ok((_, wanted))) = wanted else {
            return;
        };
        let (curves, level) = (self.facts.curves.value.as_ref(), subject.workers.level());
        let known = curves.filter(|it| it.is_same(wanted)).unwrap_or(wanted);
        if known.is_all {
            return;
        }
        let before = known.clone();
        self.start_if_due(
            subject,
            Question::Vary,
            |facts| &mut facts.curves,
            async move |_, _, monitor| before.refine(PER_STEP, level, monitor).await,
        );
    }

    /// Draws the picture without a part of the model.
    fn leave_out(&mut self, subject: &Subject, part: Part) {
        let left_out = &mut self.facts.left_out;
        left_out.is_current &= left_out.value.as_ref().is_none_or(|it| it.0 == part);
        self.start_if_due(
            subject,
            Question::LeaveOut,
            |facts| &mut facts.left_out,
            async move |scene, view, monitor| {
                let pixels = picture_without(&scene, view, part, monitor).await?;
                Ok((part, pixels))
            },
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
        self.start_if_due(
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

    /// Proves the picture, or both sides of a wipe.
    fn prove(&mut self, subject: &Subject) {
        let (sides, level) = (sides(&subject.record.view), subject.workers.level());
        let known = &mut self.facts.proof;
        known.is_current &= known.value.as_ref().is_none_or(|it| it.0 == sides);
        self.start_if_due(
            subject,
            Question::Prove,
            |facts| &mut facts.proof,
            async move |mut scene, view, monitor| {
                let mut proof = Proof::default();
                for view in proven_views(sides, view) {
                    let own = prove(&mut scene.world, &view, None, level, monitor).await?;
                    proof = proof.and(own);
                }
                Ok((sides, proof))
            },
        );
    }

    /// Finds the parts of the model, and then the segments, that the picture requires.
    fn require(&mut self, subject: &Subject) {
        let found = self.facts.required.current().cloned().unwrap_or_default();
        if !found.is_all {
            self.start_if_due(
                subject,
                Question::Require,
                |facts| &mut facts.required,
                async move |scene, view, monitor| {
                    more_changes(&scene, view, found.rows, PER_STEP, monitor).await
                },
            );
        }
        self.start_if_due(
            subject,
            Question::CountSegments,
            |facts| &mut facts.segments,
            async |scene, view, monitor| fewest_segments(&scene, view, monitor).await,
        );
    }
}

/// Whether a picture cannot be shown before it is compared with exact Phong.
pub fn shows_exact(viewer: &Viewer) -> bool {
    viewer.show == ViewMode::Error || sides(viewer).contains(&Side::Reference)
}

/// The views of the pictures on screen that the renderer draws, each once; that of the picture if it draws none.
fn proven_views(sides: [Side; 2], view: &View) -> Vec<View> {
    let views = sides.iter().filter_map(|side| side_view(side, view));
    let mut drawn: Vec<View> = views
        .filter(|it| it.shading.is_none_or(ShadingMode::is_drawn))
        .collect();
    drawn.dedup();
    if drawn.is_empty() { vec![*view] } else { drawn }
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
