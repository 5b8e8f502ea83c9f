//! A lesson in the window: its sentence, its question, the controls of a step; and the sheet of all steps.

use std::sync::Arc;
use std::time::Duration;

use egui::{Button, RichText, Ui};
use hecs::World;

use super::app::App;
use super::ask::shows_exact;
use super::canvas::Canvas;
use super::controls::{has_face_normals, shown_method};
use super::desk::Desk;
use super::document::Document;
use super::facts::Comparison;
use super::facts::Facts;
use super::keys::Action;
use super::labels::Labels;
use super::layout::message;
use super::panel::light_row;
use super::pictures::exact_view;
use super::widgets::{BAD, GOOD, INK, button, number, offer, segment_buttons, short, text};
use crate::components::numbers::range_of;
use crate::components::{Light, Material, Name, ShadingMode, View, ViewMode, ordered, viewer};
use crate::output::paint::area;
use crate::output::progress::with_bar;
use crate::output::words::counted;
use crate::output::{Monitor, Output, memory, say};
use crate::questions::figures::sheet::sheet;
use crate::questions::job::Drawing;
use crate::questions::probe;
use crate::scene::{Control, LESSONS, Question, Scene, Step, title};

/// Letters are this share of the window's height, and at least and at most so many points.
const LETTERS: f32 = 38.0;
const LEAST_LETTERS: f32 = 13.0;
const MOST_LETTERS: f32 = 32.0;
/// The size of an answer's letters, as a share of the sentence's.
const ANSWERS: f32 = 0.75;
/// The columns of a sheet.
const COLUMNS: usize = 2;
/// The bytes of a pixel in the picture of a step, in the sheet and in its encoding.
const PIXEL: usize = 12;

impl App {
    /// Whether the window shows a lesson and nothing else.
    pub(super) fn is_lesson_alone(&self) -> bool {
        !self.document.scene.lesson.is_empty() && !self.desk.shows_rest
    }

    /// Goes to another step of the lesson; from the last one to the next lesson.
    pub(super) fn step_lesson(&mut self, steps: isize) {
        let is_last = self.document.step + 1 == self.document.scene.lesson.len();
        match next_lesson(&self.document.scene.name) {
            Some(name) if is_last && steps > 0 => self.open(name),
            _ => {
                self.desk.answer = None;
                self.desk.say_any(self.document.step_lesson(steps));
            }
        }
    }

    /// Lays out the way from step to step, and the controls of this one.
    pub(super) fn lesson_controls(&mut self, ui: &mut Ui) {
        let is_alone = self.is_lesson_alone();
        let App {
            document,
            study,
            desk,
            ..
        } = self;
        let step = document.step;
        let lesson = Arc::clone(&document.scene.lesson);
        let next = match next_lesson(&document.scene.name) {
            Some(name) if step + 1 == lesson.len() => format!("Next lesson: {}", title(name)),
            _ => "next".to_owned(),
        };
        ui.horizontal_wrapped(|ui| {
            button(ui, desk, "back", Action::Step(-1));
            button(ui, desk, &next, Action::Step(1));
            // The curve is drawn on the picture.
            let controls = lesson[step].show.iter();
            for control in controls.filter(|it| **it != Control::Row) {
                ui.separator();
                show(ui, &mut document.scene.world, &study.facts, desk, *control);
            }
            if is_alone {
                message(ui, desk);
            }
        });
    }
}

/// The built-in lesson after this one.
fn next_lesson(name: &str) -> Option<&'static str> {
    let place = LESSONS.iter().position(|it| it.0 == name)?;
    LESSONS.get(place + 1).map(|it| it.0)
}

/// Lays out the title, the progress, the sentence and the question of the step.
pub fn heading(ui: &mut Ui, document: &Document, desk: &mut Desk) {
    let lesson = &document.scene.lesson;
    let step = &lesson[document.step];
    let letters = (ui.ctx().content_rect().height() / LETTERS).clamp(LEAST_LETTERS, MOST_LETTERS);
    ui.horizontal_wrapped(|ui| {
        ui.strong(title(&document.scene.name));
        ui.weak(format!("{} of {}", document.step + 1, lesson.len()));
        if desk.shows_rest {
            button(ui, desk, "the lesson alone", Action::Panel);
        } else {
            button(ui, desk, "everything", Action::Panel);
            button(ui, desk, "leave", Action::Close);
        }
    });
    let longest = lesson.iter().map(|step| step.say.len()).max();
    text(ui, &step.say, longest.unwrap_or_default(), letters);
    if let Some(question) = &step.question {
        answers(ui, question, desk, ANSWERS * letters);
    }
}

/// Lays out the answers to choose from, and after the choice the right one.
fn answers(ui: &mut Ui, question: &Question, desk: &mut Desk, letters: f32) {
    ui.horizontal_wrapped(|ui| {
        for (place, answer) in question.answers.iter().enumerate() {
            let ink = match desk.answer {
                Some(_) if place == question.right => GOOD,
                Some(chosen) if place == chosen => BAD,
                _ => INK,
            };
            let text = RichText::new(answer).size(letters).color(ink);
            if ui.add(Button::new(text)).clicked() {
                desk.answer = Some(place);
            }
        }
    });
    let then = desk.answer.map_or("", |_| &question.then);
    text(ui, then, question.then.len(), letters);
}

/// Lays out a control of a step.
fn show(ui: &mut Ui, world: &mut World, facts: &Facts, desk: &mut Desk, control: Control) {
    match control {
        Control::Shading => {
            let shading = shown_method(world, facts).map(|it| it.mode);
            for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
                offer(ui, desk, Action::Shading(mode), shading == Some(mode));
            }
        }
        Control::Normals => offer(ui, desk, Action::FaceNormals, has_face_normals(world)),
        Control::Segments => segment_buttons(ui, world, desk),
        Control::Tolerance => {
            button(ui, desk, "finer", Action::Tolerance(-1));
            ui.label(format!("within {}", short(viewer(world).tolerance)));
            button(ui, desk, "coarser", Action::Tolerance(1));
        }
        Control::Shininess => {
            for (name, material) in world.query_mut::<(&Name, &mut Material)>() {
                ui.label(format!("shininess of {}", name.0));
                number(ui, &mut material.shininess, range_of("shininess"));
            }
        }
        Control::On => {
            for (place, entity) in ordered::<Light>(world).into_iter().enumerate() {
                light_row(ui, world, entity, place);
            }
        }
        Control::Intensity => {
            for entity in ordered::<Light>(world) {
                if let Ok((name, light)) = world.query_one_mut::<(&Name, &mut Light)>(entity) {
                    ui.label(&name.0);
                    number(ui, &mut light.intensity, range_of("intensity"));
                }
            }
        }
        Control::Show => {
            let shown = viewer(world).show;
            for mode in [ViewMode::Picture, ViewMode::Wipe, ViewMode::Error] {
                offer(ui, desk, Action::View(mode), shown == mode);
            }
        }
        Control::Row => {}
    }
}

/// Draws all steps of a lesson on a sheet: each with its picture, its sentence and the names in it.
///
/// # Errors
/// If the sheet does not fit in memory, or the file cannot be written.
pub fn draw(drawing: &Drawing, output: &Output) -> anyhow::Result<()> {
    let (size, lesson) = (drawing.size, &drawing.scene.lesson);
    let pixels = size[0] * size[1] * lesson.len().next_multiple_of(COLUMNS);
    memory::check(size, PIXEL * pixels)?;
    let mut canvas = Canvas::new(drawing.workers()?);
    canvas.place = area(size);
    let pictures = with_bar(async |monitor| {
        let mut pictures = Vec::new();
        for (place, step) in lesson.iter().enumerate() {
            (monitor.progress)("drawing", place as f64 / lesson.len() as f64);
            pictures.push(picture(&mut canvas, step, monitor).await?);
        }
        Ok(pictures)
    })?;
    let numbered = (1..).zip(&**lesson);
    let captions = numbered.map(|(number, step)| caption_of(number, step));
    let cells: Vec<_> = pictures.into_iter().zip(captions).collect();
    let columns = COLUMNS.min(lesson.len());
    let (pixels, sheet_size) = sheet(&title(&drawing.scene.name), columns, &cells, size);
    output.write_png(&pixels, sheet_size)?;
    let steps = counted(lesson.len(), "step");
    say(&format!("drew {steps}; wrote {}", output.name()));
    Ok(())
}

/// The number and the sentence of a step, and its answers.
fn caption_of(number: usize, step: &Step) -> String {
    let answers = step.question.iter().flat_map(|it| &it.answers);
    let lines = ('a'..).zip(answers);
    let lettered = lines.map(|(letter, answer)| format!("\n{letter}) {answer}"));
    format!("{number}. {}{}", step.say, lettered.collect::<String>())
}

/// The picture of a step with the words in it.
async fn picture(
    canvas: &mut Canvas,
    step: &Step,
    monitor: Monitor<'_>,
) -> anyhow::Result<Vec<u32>> {
    let level = canvas.pictures.frame.workers().level();
    let mut scene = Scene::spawn(String::new(), &step.record);
    let viewer = &step.record.view;
    let view = View::of(&scene.world, canvas.size());
    canvas.draw(Duration::ZERO, &mut scene.world, &step.record, view)?;
    let mut facts = Facts::default();
    if shows_exact(viewer) {
        let comparison =
            Comparison::of(&mut scene.world, &view, Vec::new(), level, monitor).await?;
        facts.comparison.finish(Some(comparison));
    }
    if let Some(pixel) = canvas.pixel(viewer) {
        let side = canvas.side_at(viewer, pixel[0]);
        let section = probe::section(&mut scene, &exact_view(&side, &view), pixel, level)?;
        facts.section.finish(Some((side, section)));
    }
    let mut pixels = canvas.shown(viewer, &facts, None).into_owned();
    let labels = Labels {
        place: canvas.place,
        canvas,
        viewer,
        facts: &facts,
        method: shown_method(&scene.world, &facts),
        turn: None,
        has_names: true,
        has_row: step.show.contains(&Control::Row),
    };
    labels.draw(&mut pixels);
    Ok(pixels)
}
