//! The picture is drawn, and the questions about it are asked and answered.

use std::time::Duration;

use super::app::App;
use super::document::Document;
use super::facts::change;
use super::study::Subject;
use crate::components::viewer;

impl App {
    /// Draws the present picture, and asks the questions about it.
    pub(super) fn draw(&mut self) -> anyhow::Result<()> {
        let world = &self.document.scene.world;
        self.canvas.fit(world, &viewer(world));
        self.outdate();
        let budget = self.viewer().budget;
        self.choice.hold(budget, &self.study.facts);
        // It may have changed the method.
        self.outdate();
        let (view, method) = (self.view(), self.method());
        let side = |pixel: [usize; 2]| (pixel, self.canvas.side_at(&self.viewer(), pixel[0]));
        let pixel = self.pixel().map(side);
        let Document { scene, state, .. } = &mut self.document;
        self.canvas
            .draw(self.desk.now, &mut scene.world, state, view)?;
        let subject = Subject {
            name: &scene.name,
            record: state,
            view,
            fit: self.canvas.fit,
            pixel,
            method,
            workers: self.canvas.pictures.frame.workers(),
            rests: self.canvas.rests(),
        };
        self.study.ask(&subject, &self.desk);
        if !self.study.is_live() {
            self.receive(self.desk.now);
        }
        Ok(())
    }

    /// Outdates the facts that are not those of the picture to be drawn.
    pub(super) fn outdate(&mut self) {
        if let Some((state, view)) = &self.canvas.drawn {
            let present = (&self.document.state, &self.view());
            self.study.outdate(change((state, view), present));
        }
    }

    /// Takes the answers that were found. Returns whether the window has to be drawn again, also for progress.
    pub fn receive(&mut self, now: Duration) -> bool {
        let is_new = self.study.receive(now);
        let failure = self.study.take_failure();
        self.desk.say_any(failure);
        if is_new && std::mem::take(&mut self.desk.awaits_worst) {
            self.explain_worst();
        }
        is_new
    }

    /// Works on questions for `piece`, where no thread does. Returns whether the window has to be drawn again.
    pub fn carry_on(&mut self, now: Duration, piece: Duration) -> bool {
        self.study.carry_on(piece);
        self.receive(now)
    }
}
