//! A lesson in the window: the sentence of a step, the way to the next, and all steps drawn into a file.

use std::sync::Arc;
use std::time::Duration;

use egui::{Align, FontId, Label, Layout, RawInput, RichText, Ui, vec2};

use super::app::App;
use super::desk::{Desk, reading_time};
use super::document::Document;
use super::keys::Action;
use super::study::Background;
use super::widgets::{INK, offer};
use crate::output::memory;
use crate::output::progress::with_bar;
use crate::output::words::counted;
use crate::output::{Animation, Output, say};
use crate::questions::job::Drawing;

/// Letters are this share of the window's height, and at least and at most so many points.
const LETTERS: f32 = 38.0;
const LEAST_LETTERS: f32 = 13.0;
const MOST_LETTERS: f32 = 32.0;
/// The most layouts until the window shows the answers to the questions of the one before.
const LAYOUTS: usize = 4;
/// The bytes of a pixel in the window's buffer and in its picture.
const PIXEL: usize = 8;

/// Lays out the sentence of the step above the picture, large enough for the last row of a room, and the buttons to the steps
/// beside it.
pub fn caption(ui: &mut Ui, document: &Document, desk: &mut Desk) {
    let lesson = &document.scene.lesson;
    let letters = (ui.ctx().content_rect().height() / LETTERS).clamp(LEAST_LETTERS, MOST_LETTERS);
    ui.horizontal(|ui| {
        offer(ui, desk, Action::Step(-1), false);
        offer(ui, desk, Action::Step(1), false);
        ui.weak(format!("{} of {}", document.step + 1, lesson.len()));
    });
    let text = RichText::new(&lesson[document.step].say)
        .size(letters)
        .color(INK);
    // Room for the longest sentence, so that the picture keeps its size.
    let says = lesson.iter().map(|step| step.say.clone());
    let font = FontId::proportional(letters);
    let width = ui.available_width();
    let heights = says.map(|says| {
        let text = ui.painter().layout(says, font.clone(), INK, width);
        text.size().y
    });
    let height = heights.fold(0.0, f32::max);
    let size = vec2(width, height);
    let layout = Layout::top_down(Align::Min);
    ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_size(size);
        ui.add(Label::new(text).wrap());
    });
}

/// Draws the window at the last step of a lesson, or at every step into a file that ends in .apng, for as long as it takes to
/// read.
///
/// # Errors
/// If a picture does not fit in memory, or the file cannot be written.
pub fn draw(drawing: Drawing, output: &Output) -> anyhow::Result<()> {
    let (size, lesson) = (drawing.size, Arc::clone(&drawing.scene.lesson));
    memory::check(size, PIXEL * size[0] * size[1])?;
    let mut app = App::new(drawing, Background::AtOnce)?;
    app.desk.shows_times = false;
    let is_animated = output.name().to_lowercase().ends_with(".apng");
    let mut file = Vec::new();
    let animation = is_animated.then(|| Animation::new(&mut file, size, lesson.len()));
    let mut animation = animation.transpose()?;
    with_bar(async |monitor| {
        for (place, step) in lesson.iter().enumerate() {
            (monitor.progress)("drawing", place as f64 / lesson.len() as f64);
            if place > 0 {
                app.run(Action::Step(1));
            }
            for _ in 0..LAYOUTS {
                app.step(Duration::ZERO, size, RawInput::default())?;
            }
            if let Some(animation) = &mut animation {
                animation.add(&app.pixels, reading_time(&step.say))?;
            }
        }
        Ok(())
    })?;
    animation.map(Animation::finish).transpose()?;
    if is_animated {
        output.write(file)?;
    } else {
        output.write_png(&app.pixels, size)?;
    }
    let steps = counted(lesson.len(), "step");
    say(&format!("drew {steps}; wrote {}", output.name()));
    Ok(())
}
