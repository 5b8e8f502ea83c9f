//! The program behind the window, without a display: events and a size in, pixels and effects out.
//!
//! ```text
//!   events                                          desk  open, folded, selected, said
//!     |                                             |
//!     v                                             v
//!   keys, panels --write--> World (document) --method--> canvas --copied--> pixels <--painted-- egui
//!                                 |                          draws
//!                                 '--change--> study  questions, facts
//! ```
//! [`App`] owns these parts and carries values between them.

use std::borrow::Cow;
use std::sync::Arc;
use std::time::Duration;

use egui::{Event, FullOutput, OutputCommand, RawInput, ViewportId};
use hecs::{Ref, RefMut};

use super::canvas::{Canvas, REST};
use super::controls::{Rotation, shown_method};
use super::desk::{Desk, TURN};
use super::document::Document;
use super::facts::change;
use super::file::INTERVAL;
use super::inspector::Tab;
use super::layout::{LOW, NARROW};
use super::pictures::or_dimmed;
use super::study::{Runner, Study, Subject};
use crate::components::{Mesh, View, Viewer, viewer, viewer_mut};
use crate::output::paint::{Painter, area};
use crate::questions::job::Drawing;
use crate::questions::probe::Probe;
use crate::shading::Method;

/// Everything but the display.
pub struct App {
    pub document: Document,
    pub canvas: Canvas,
    pub study: Study,
    pub desk: Desk,
    pub(super) rotation: Rotation,
    pub(super) painter: Painter,
    /// The pixels of the window as of the last step, row by row from the top.
    pub pixels: Vec<u32>,
    /// Width and height of the window, in pixels.
    pub(super) size: [usize; 2],
    /// Pixels per point of egui before `Ctrl +`: those of the screen, or those per CSS pixel in a browser.
    pub scale: f32,
}

/// The part of a step that the window system carries out.
pub struct StepOutput {
    /// A text for the clipboard.
    pub copied: Option<String>,
    /// The time after which a step is wanted even if nothing happens.
    pub repaint_after: Duration,
}

impl App {
    /// Starts with `drawing`.
    ///
    /// # Errors
    /// If the system gives no threads.
    pub fn new(drawing: Drawing, runner: Runner) -> anyhow::Result<Self> {
        let canvas = Canvas::new(drawing.workers()?);
        let document = Document::of(drawing.scene);
        let painter = Painter::default();
        super::widgets::apply_style(&painter.context);
        let [width, height] = drawing.size.map(|side| side as f32);
        let mut desk = Desk {
            shows_times: true,
            panel_folded: width < NARROW && height < LOW,
            ..Desk::default()
        };
        if document.state.view.pixel.is_some() {
            desk.open(Tab::Pixel);
        }
        Ok(App {
            document,
            canvas,
            study: Study::new(runner)?,
            desk,
            rotation: Rotation::default(),
            painter,
            pixels: Vec::new(),
            size: drawing.size,
            scale: 1.0,
        })
    }

    /// The viewer of the scene.
    pub fn viewer(&self) -> Ref<'_, Viewer> {
        viewer(&self.document.scene.world)
    }

    /// The viewer of the scene, to be changed.
    pub fn viewer_mut(&mut self) -> RefMut<'_, Viewer> {
        viewer_mut(&mut self.document.scene.world)
    }

    /// The pixel that is explained, if it lies in the picture.
    pub fn pixel(&self) -> Option<[usize; 2]> {
        self.canvas.pixel(&self.viewer())
    }

    /// The answer about the explained pixel, possibly of an earlier picture.
    pub fn probed(&self) -> Option<&Probe> {
        self.study.facts.probed(self.pixel())
    }

    /// The view that is drawn.
    pub fn view(&self) -> View {
        let world = &self.document.scene.world;
        let mut view = View::of(world, self.canvas.size());
        view.camera = view.camera.widened(self.canvas.fit);
        let held = self.study.facts.held;
        held.map_or(view, |method| method.view(&view))
    }

    /// The method on screen; `None` where the cuboids have different modes.
    pub fn method(&self) -> Option<Method> {
        shown_method(&self.document.scene.world, &self.study.facts)
    }

    /// The picture as it is shown, 0x00RRGGBB.
    pub fn shown(&self) -> Cow<'_, [u32]> {
        let (viewer, facts) = (self.viewer(), &self.study.facts);
        if let Some(part) = self.desk.shown_without() {
            let known = facts.left_out.current().filter(|it| it.0 == part);
            let frame = self.canvas.pictures.frame.pixels();
            return or_dimmed(known.map(|it| &*it.1), frame);
        }
        self.canvas.shown(&viewer, facts, self.desk.turn())
    }

    /// Applies the events of `input`, whose places are in pixels, and draws the window of `size` pixels.
    ///
    /// # Errors
    /// If the picture does not fit in memory.
    pub fn step(
        &mut self,
        now: Duration,
        size: [usize; 2],
        mut input: RawInput,
    ) -> anyhow::Result<StepOutput> {
        let ends_gesture = has_gesture(&input, false);
        self.prepare(now, size, &mut input);
        let context = self.painter.context.clone();
        let mut output = context.run_ui(input, |ui| self.ui(ui));
        self.document.keep(now, ends_gesture);
        if let Err(error) = self.document.tend_edits(now) {
            self.desk.say(format!("{error:#}"));
        }
        self.draw()?;
        self.size = size;
        let mut pixels = std::mem::take(&mut self.pixels);
        // A panel may paint less than it takes: contents that are too wide are cut off.
        let [red, green, blue, _] = context.global_style().visuals.panel_fill.to_array();
        let ground = u32::from_be_bytes([0, red, green, blue]);
        self.canvas.copy(&self.shown(), &mut pixels, size, ground);
        self.pixels = pixels;
        let commands = std::mem::take(&mut output.platform_output.commands);
        let copied = commands
            .into_iter()
            .rev()
            .find_map(|command| match command {
                OutputCommand::CopyText(text) => Some(text),
                _ => None,
            });
        let repaint_after = self.next_step(&output);
        self.painter.paint(output, &mut self.pixels, size);
        Ok(StepOutput {
            copied,
            repaint_after,
        })
    }

    /// Advances all parts to the time of the step. Converts positions of events from pixels to points.
    fn prepare(&mut self, now: Duration, size: [usize; 2], input: &mut RawInput) {
        self.desk.now = now;
        self.canvas.rest(now);
        self.receive(now);
        self.document.keep(now, has_gesture(input, true));
        self.rotation.go_on(&mut self.document.scene.world, now);
        self.look_at_file(now);
        let scale = self.painter.context.zoom_factor() * self.scale;
        input.time = Some(now.as_secs_f64());
        input.screen_rect = Some(area(size) / scale);
        let viewport = input.viewports.entry(ViewportId::ROOT).or_default();
        viewport.native_pixels_per_point = Some(self.scale);
        for event in &mut input.events {
            if let Event::PointerMoved(place) | Event::PointerButton { pos: place, .. } = event {
                *place = (place.to_vec2() / scale).to_pos2();
            }
        }
    }

    /// The time after which a step is wanted even if nothing happens.
    fn next_step(&self, output: &FullOutput) -> Duration {
        let (document, now) = (&self.document, self.desk.now);
        let viewport = output.viewport_output.get(&ViewportId::ROOT);
        let edits = document.edits_due();
        let waits = [
            viewport.map(|it| it.repaint_delay),
            (!self.canvas.rests()).then_some(REST),
            self.desk.blinks.map(|_| TURN / 10),
            self.rotation.wait(&document.scene.world, now),
            document.scene.path.as_ref().map(|_| INTERVAL),
            edits.map(|due| due.saturating_sub(now)),
        ];
        waits.into_iter().flatten().min().unwrap_or(Duration::MAX)
    }

    /// Draws the present picture, and asks the questions about it.
    fn draw(&mut self) -> anyhow::Result<()> {
        let world = &self.document.scene.world;
        self.canvas.fit(world, &viewer(world));
        self.outdate();
        let last = self.canvas.last_frame(&self.document.state);
        let budget = self.viewer().budget;
        self.study.facts.hold(budget, last);
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

    /// Whether the present picture is the one that was drawn last, about which the facts are.
    pub(super) fn is_drawn(&self) -> bool {
        let drawn = self.canvas.drawn.as_ref();
        drawn.is_some_and(|(state, view)| {
            Arc::ptr_eq(state, &self.document.state) && *view == self.view()
        })
    }

    /// Outdates the facts that are not those of the picture to be drawn.
    fn outdate(&mut self) {
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
        let is_known = self.study.facts.section.is_current;
        let clicked = self.probed().filter(|_| is_known && self.desk.has_clicked);
        if let Some(probe) = clicked {
            let object = probe.surface.as_ref().map(|it| it.object.clone());
            self.desk.has_clicked = false;
            let world = &self.document.scene.world;
            self.desk
                .select::<Mesh>(world, "cuboid", &object.unwrap_or_default());
        }
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

    /// Notes the state that keys and widgets made. An explained pixel opens its heading.
    pub(super) fn note_changes(&mut self) {
        let before = self.document.state.view.pixel;
        let refused = self.document.note();
        self.desk.say_any(refused);
        let pixel = self.document.state.view.pixel;
        if pixel.is_some() && pixel != before && self.desk.tabs.is_empty() {
            self.desk.open(Tab::Pixel);
        }
    }
}

/// Whether a key or the button goes down, or up.
fn has_gesture(input: &RawInput, begins: bool) -> bool {
    input.events.iter().any(|event| match event {
        Event::Key {
            pressed,
            repeat: false,
            ..
        }
        | Event::PointerButton { pressed, .. } => *pressed == begins,
        _ => false,
    })
}
