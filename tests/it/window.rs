//! The window without a display: events go into `App::step`; components, files, messages and pixels are checked.

mod clicks;
mod controls;
mod facts;
mod files;
mod first;
mod history;
mod keys;
mod lesson;
mod memory;
mod mouse;
mod ranges;
mod rooms;
mod sides;
mod sight;
mod storms;
mod trade;
mod unsaved;
mod vary;
mod widgets;

use std::time::Duration;

use egui::{
    Event, Key, Modifiers, MouseWheelUnit, PointerButton, Pos2, RawInput, TouchPhase, vec2,
};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use shadetrade::window::app::{App, StepOutput};
use shadetrade::window::desk::Desk;
use shadetrade::window::document::Document;
use shadetrade::window::facts::Comparison;
use tempfile::TempDir;

use crate::support::prelude::*;
use crate::support::window::{app, default_scene, widgets};

/// A size with room for the panel, the inspector and a small picture.
const SIZE: [usize; 2] = [1240, 600];
/// The time between two steps.
const FRAME: Duration = Duration::from_millis(20);
/// After this time a change is a new step of the history.
const PAUSE: Duration = Duration::from_secs(2);

/// The default scene as it is written down.
fn default_record() -> SceneRecord {
    SceneRecord::of(&default_scene().world)
}

/// The default scene after a change.
fn changed(change: impl FnOnce(&mut SceneRecord)) -> Scene {
    let mut record = default_record();
    change(&mut record);
    Scene::spawn("changed".to_owned(), &record)
}

/// The widgets of a window on the default scene.
fn widgets_of(size: [usize; 2]) -> Harness<'static, App> {
    widgets(app(default_scene(), size, Level::new()), size)
}

/// Presses a key, and lays out the window again.
fn press(harness: &mut Harness<App>, key: Key) {
    harness.key_press(key);
    harness.run_ok();
}

/// Chooses the widget with this label.
#[track_caller]
fn choose(harness: &mut Harness<App>, label: &str) {
    harness.get_by_label(label).click();
    harness.run_ok();
}

/// Presses the button at the first place and releases it at the last.
fn drag(harness: &mut Harness<App>, path: &[Pos2]) {
    harness.hover_at(path[0]);
    harness.run_ok();
    harness.drag_at(path[0]);
    harness.run_ok();
    for at in &path[1..] {
        harness.hover_at(*at);
        harness.run_ok();
    }
    harness.drop_at(path[path.len() - 1]);
    harness.run_ok();
}

fn click_at(harness: &mut Harness<App>, at: Pos2) {
    drag(harness, &[at]);
}

/// A window, its clock, and the folder of its saved files.
struct Window {
    app: App,
    size: [usize; 2],
    now: Duration,
    modifiers: Modifiers,
    output: StepOutput,
    folder: TempDir,
}

impl Window {
    fn open() -> Self {
        Window::of(default_scene(), SIZE)
    }

    fn of(scene: Scene, size: [usize; 2]) -> Self {
        Window::with(app(scene, size, Level::new()), size)
    }

    fn with(mut app: App, size: [usize; 2]) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        app.document.folder = folder.path().to_path_buf();
        let step = |app: &mut App| app.step(Duration::ZERO, size, RawInput::default());
        // Widgets have their final sizes after the first pass.
        step(&mut app).expect("a small picture fits");
        let output = step(&mut app).expect("a small picture fits");
        Window {
            app,
            size,
            now: Duration::ZERO,
            modifiers: Modifiers::NONE,
            output,
            folder,
        }
    }

    /// Lays out the widgets in a window of `size`, and uses them.
    fn with_widgets<T>(&mut self, size: [usize; 2], act: impl FnOnce(&mut Harness<App>) -> T) -> T {
        let spare = app(default_scene(), [64, 48], Level::new());
        let mut harness = widgets(std::mem::replace(&mut self.app, spare), size);
        let found = act(&mut harness);
        std::mem::swap(&mut self.app, harness.state_mut());
        found
    }

    /// Shows a scene as a new window would, which takes far longer because it draws every letter first.
    fn reopen(&mut self, scene: Scene) {
        self.folder = tempfile::tempdir().expect("a temporary folder");
        self.app.document = Document::of(scene);
        self.app.document.folder = self.folder.path().to_path_buf();
        self.app.desk = Desk::default();
        self.modifiers = Modifiers::NONE;
        self.wait(PAUSE);
    }

    /// Opens a scene as the list of scenes does.
    fn choose(&mut self, scene: Scene) {
        self.app.open_scene(scene);
        self.step(Vec::new());
    }

    fn step(&mut self, events: Vec<Event>) {
        self.step_at(self.now + FRAME, events);
    }

    fn step_at(&mut self, now: Duration, events: Vec<Event>) {
        self.now = now;
        let input = RawInput {
            modifiers: self.modifiers,
            events,
            ..RawInput::default()
        };
        let output = self.app.step(now, self.size, input);
        self.output = output.expect("the picture fits");
    }

    /// A step after a pause without events.
    fn wait(&mut self, time: Duration) {
        self.now += time;
        self.step(Vec::new());
    }

    fn key_event(&self, key: Key, pressed: bool) -> Event {
        self.any_key_event(key, pressed, false)
    }

    /// The event of a key that is held.
    fn repeated(&self, key: Key) -> Event {
        self.any_key_event(key, true, true)
    }

    fn any_key_event(&self, key: Key, pressed: bool, repeat: bool) -> Event {
        Event::Key {
            key,
            physical_key: None,
            pressed,
            repeat,
            modifiers: self.modifiers,
        }
    }

    fn key(&mut self, key: Key, pressed: bool) {
        self.step(vec![self.key_event(key, pressed)]);
    }

    fn press(&mut self, key: Key) {
        self.key(key, true);
        self.key(key, false);
    }

    fn press_with(&mut self, modifiers: Modifiers, key: Key) {
        self.modifiers = modifiers;
        self.press(key);
        self.modifiers = Modifiers::NONE;
    }

    fn undo(&mut self) {
        self.press_with(Modifiers::COMMAND, Key::Z);
    }

    fn redo(&mut self) {
        self.press_with(Modifiers::COMMAND, Key::Y);
    }

    fn button(&mut self, pos: Pos2, pressed: bool) {
        let modifiers = self.modifiers;
        self.step(vec![Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers,
        }]);
    }

    fn point_at(&mut self, at: Pos2) {
        self.step(vec![Event::PointerMoved(at)]);
    }

    fn click(&mut self, at: Pos2) {
        self.point_at(at);
        self.button(at, true);
        self.button(at, false);
    }

    /// Drags in this number of steps.
    fn drag(&mut self, from: Pos2, to: Pos2, steps: usize) {
        self.point_at(from);
        self.button(from, true);
        for step in 1..=steps {
            self.point_at(from + (to - from) * (step as f32 / steps as f32));
        }
        // The mouse rests before the button is released.
        self.point_at(to);
        self.button(to, false);
    }

    fn wheel(&mut self, at: Pos2, notches: f32) {
        let modifiers = self.modifiers;
        self.point_at(at);
        self.step(vec![Event::MouseWheel {
            unit: MouseWheelUnit::Line,
            delta: vec2(0.0, notches),
            phase: TouchPhase::Move,
            modifiers,
        }]);
    }

    /// Types a text: each character, with its key if it has one.
    fn enter(&mut self, text: &str) {
        for character in text.chars() {
            let key = Key::from_name(&character.to_uppercase().to_string());
            let [press, release] =
                [true, false].map(|pressed| key.map(|key| self.key_event(key, pressed)));
            let text = Some(Event::Text(character.to_string()));
            self.step([press, text, release].into_iter().flatten().collect());
        }
    }

    /// The picture of the present state, drawn again with another view.
    fn drawn(&self, change: impl FnOnce(View) -> View) -> Vec<u32> {
        let mut world = self.app.document.state.spawn();
        let view = change(View::of(&world, self.app.canvas.size()));
        draw(&mut world, &view, Keep::Display).pixels().to_vec()
    }

    /// The comparison of the present picture.
    #[track_caller]
    fn comparison(&self) -> &Comparison {
        let comparison = self.app.study.facts.comparison.current();
        comparison.expect("an answer")
    }

    fn record(&self) -> SceneRecord {
        SceneRecord::of(&self.app.document.scene.world)
    }

    /// The message in the status line.
    fn message(&self) -> &str {
        let message = self.app.desk.message.as_ref();
        message.map_or("", |(text, _)| text)
    }

    /// The names of the saved files, in order.
    fn files(&self) -> Vec<String> {
        crate::cli::listing(self.folder.path())
    }

    /// The pixels of the picture's area in the window.
    fn seen(&self) -> Vec<u32> {
        let corner = self.app.canvas.place.min;
        let [left, top] = [corner.x, corner.y].map(|it| it as usize);
        let [width, height] = self.app.canvas.size();
        let rows = self.app.pixels.chunks_exact(self.size[0]);
        let rows = rows.skip(top).take(height);
        let pixels = rows.flat_map(|row| &row[left..left + width]);
        pixels.map(|pixel| pixel & 0x00ff_ffff).collect()
    }
}
