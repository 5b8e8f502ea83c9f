//! The window in a browser: events of the page in, pixels and files out. `page.js` calls it.

use std::path::Path;
use std::time::Duration;

use egui::{Key, RawInput};
use fearless_simd::Level;
use serde_json::json;
use shadetrade::output::files;
use shadetrade::questions::job::Drawing;
use shadetrade::questions::trade::verdict::method_name;
use shadetrade::scene::{LESSONS, Scene};
use shadetrade::window::app::App;
use shadetrade::window::study::Runner;
use wasm_bindgen::prelude::*;

/// egui's name of a key, from its character or from the name that browsers give it.
#[wasm_bindgen]
pub fn key_name(name: &str) -> Option<String> {
    Key::from_name(name).map(|key| format!("{key:?}"))
}

/// The names of the lessons.
#[wasm_bindgen]
pub fn lessons() -> Vec<String> {
    LESSONS.iter().map(|(name, _)| (*name).to_owned()).collect()
}

/// Puts a file where the program finds it.
#[wasm_bindgen]
pub fn insert(path: &str, content: Vec<u8>) {
    files::insert(path.into(), content);
}

/// The program, and the pixels of its last step as a canvas takes them.
#[wasm_bindgen]
pub struct Page {
    app: App,
    /// The bytes red, green, blue and alpha of each pixel.
    rgba: Vec<u32>,
}

#[wasm_bindgen]
impl Page {
    /// Starts with the default scene in a canvas of this size, in pixels.
    #[wasm_bindgen(constructor)]
    pub fn new(width: usize, height: usize) -> Result<Page, JsError> {
        std::panic::set_hook(Box::new(|panic| {
            wasm_bindgen::throw_str(&panic.to_string())
        }));
        let drawing = Drawing {
            scene: Scene::load(None).map_err(told)?,
            size: [width, height],
            threads: 1,
            level: Level::new(),
        };
        let mut app = App::new(drawing, Runner::Pieces).map_err(told)?;
        app.document.keep_edits(Path::new(files::UNSAVED));
        Ok(Page { app, rgba: vec![] })
    }

    /// Applies egui's events and draws the canvas. `input` is JSON: the time in seconds, the size in pixels, pixels per CSS
    /// pixel, modifiers, events, and whether the page is left. Returns the part of the step that the page carries out, in
    /// JSON.
    pub fn step(&mut self, input: &str) -> Result<String, JsError> {
        let (seconds, size, scale, modifiers, events, leaves) = serde_json::from_str(input)?;
        let mut input = RawInput::default();
        (self.app.scale, input.modifiers, input.events) = (scale, modifiers, events);
        let now = Duration::from_secs_f64(seconds);
        let output = self.app.step(now, size, input).map_err(told)?;
        let rgba = |pixel: &u32| (pixel << 8 | 0xff).swap_bytes();
        self.rgba.clear();
        self.rgba.extend(self.app.pixels.iter().map(rgba));
        if leaves {
            self.app.may_close(false).map_err(told)?;
        }
        let quits = std::mem::take(&mut self.app.desk.quits);
        let (document, canvas) = (&self.app.document, &self.app.canvas);
        let (desk, facts) = (&self.app.desk, &self.app.study.facts);
        let outcome = json!({
            "wait": output.repaint_after.as_secs_f64(),
            "copied": output.copied,
            "quits": quits,
            "files": files::take_changes(),
            "name": document.scene.name,
            "title": document.title(),
            "sentence": document.scene.lesson.get(document.step).map(|step| &step.say),
            "message": desk.message.as_ref().map(|it| &it.0).or(desk.file_error.as_ref()),
            "method": self.app.method().map(method_name),
            "error": facts.comparison.current().and_then(|it| it.worst).map(|it| it.error),
            "proof": facts.proof.current().map(|it| &it.1),
            "trade": facts.trade.current().map(|it| &it.methods),
            "varied": facts.curves.value.as_ref().filter(|it| it.is_all).map(|it| it.variable.clone()),
            "picture": (canvas.place.min * canvas.scale, canvas.size()),
            "pixel": self.app.pixel(),
        });
        Ok(outcome.to_string())
    }

    /// The address of the pixels in memory.
    pub fn pixels(&self) -> *const u32 {
        self.rgba.as_ptr()
    }

    /// Works in the background for so long. Returns whether a step is wanted.
    pub fn carry_on(&mut self, seconds: f64, piece: f64) -> bool {
        let [now, piece] = [seconds, piece].map(Duration::from_secs_f64);
        self.app.carry_on(now, piece)
    }

    /// Opens a file or a built-in scene. If it has an error, the program shows that, and the scene before stays.
    pub fn open(&mut self, name: &str) {
        self.app.open(name);
    }

    /// The text of the scene, if it is that of a file.
    pub fn text(&self) -> Option<String> {
        let scene = &self.app.document.scene;
        scene.path.as_ref().map(|_| scene.text.clone())
    }

    /// Shows a message.
    pub fn say(&mut self, text: &str) {
        self.app.desk.say(text);
    }
}

/// An error with its causes.
fn told(error: anyhow::Error) -> JsError {
    JsError::new(&format!("{error:#}"))
}
