//! The picture's area: drags, clicks and the wheel over it, and what is laid out on it.

use egui::{
    Align2, Color32, Event, PointerButton, Pos2, Rect, Response, RichText, Sense, Ui, Vec2, vec2,
};
use hecs::World;

use super::app::App;
use super::canvas::Canvas;
use super::controls::{orbit, zoom};
use super::document::Document;
use super::inspector::Tab;
use super::labels::Labels;
use super::lights::{arrows, lamps};
use super::marks::{draw_arrows, draw_line, mark_triangle, mark_vertices, outline};
use super::unsaved::edits_bar;
use super::widgets::{BAD, bar, tag};
use crate::components::{View, ViewMode, Viewer, viewer, viewer_mut};
use crate::scene::{Control, unseen};

/// How far a drag across the picture's shorter side turns, in degrees.
const DRAG_TURN: f64 = 200.0;
/// How far beside the divider a press still moves it, in points.
const REACH: f32 = 10.0;
/// From the upper end of the divider to its handle, in points.
const HANDLE: f32 = 24.0;

impl App {
    /// Lays out the picture's area in the rest of the window.
    pub(super) fn viewport(&mut self, ui: &mut Ui) {
        let is_alone = self.is_lesson_alone();
        let scale = ui.ctx().pixels_per_point();
        let free = ui.available_rect_before_wrap();
        let whole = |at: Pos2| (at * scale).round() / scale;
        self.canvas.place = Rect::from_min_max(whole(free.min), whole(free.max));
        self.canvas.scale = scale;
        ui.set_clip_rect(self.canvas.place);
        // At its sides the panels are resized.
        let grab = vec2(ui.style().interaction.resize_grab_radius_side, 0.0);
        let area = self.canvas.place.shrink2(grab);
        let picture = ui.interact(area, ui.id().with("picture"), Sense::click_and_drag());
        let world = &mut self.document.scene.world;
        move_camera(ui, &picture, world, &self.canvas);
        let show = self.viewer().show;
        let mut click = clicked(&picture);
        if show == ViewMode::Wipe && self.desk.turn().is_none() {
            let before = self.viewer().divider;
            let world = &mut self.document.scene.world;
            click = click.or(divider(ui, world, &self.canvas));
            if self.viewer().divider != before {
                self.desk.divider = None;
            }
        }
        let mut shown = Vec::new();
        if !is_alone && (show == ViewMode::Wipe || self.desk.is_open(Tab::Scene)) {
            shown = lamps(&self.document.scene.world, &self.view(), &self.canvas);
        }
        // In a narrow picture a tag lies over an arrow.
        arrows(ui, &shown, self.canvas.place);
        if show == ViewMode::Wipe && !is_alone {
            self.tags(ui);
        }
        // After the tags, so that a disc over one can be dragged.
        self.discs(ui, &shown);
        // The terms are four pictures of half the size.
        if let Some(at) = click.filter(|_| show != ViewMode::Terms) {
            self.desk.has_clicked = true;
            self.probe(self.canvas.pixel_at(at));
        }
        if !is_alone {
            self.draw_marks(ui);
        }
        let Document { scene, step, .. } = &self.document;
        let has_row = is_alone && scene.lesson[*step].show.contains(&Control::Row);
        self.labels(&self.viewer(), is_alone, has_row).show(ui);
        self.bars(ui);
    }

    /// The words of the picture on screen; `has_names`: also those of the sides of a wipe.
    pub(super) fn labels<'a>(
        &'a self,
        viewer: &'a Viewer,
        has_names: bool,
        has_row: bool,
    ) -> Labels<'a> {
        Labels {
            place: self.canvas.place,
            canvas: &self.canvas,
            viewer,
            facts: &self.study.facts,
            method: self.method(),
            turn: self.desk.turn(),
            has_names,
            has_row,
        }
    }

    /// Draws the vertices, the outline of the selected cuboid, and what belongs to the explained pixel.
    fn draw_marks(&self, ui: &Ui) {
        let (world, canvas, desk) = (&self.document.scene.world, &self.canvas, &self.desk);
        let (painter, view, show) = (ui.painter(), self.view(), self.viewer().show);
        mark_vertices(painter, world, &view, canvas, self.method());
        if desk.is_open(Tab::Scene)
            && show != ViewMode::Terms
            && let ("cuboid", place) = desk.selected.unwrap_or(("cuboid", 0))
        {
            outline(painter, world, &view, canvas, place);
        }
        let is_known = self.study.facts.section.is_current;
        if let Some(probe) = self.probed().filter(|_| is_known)
            && let Some(surface) = &probe.surface
        {
            mark_triangle(painter, surface, &view, canvas);
            draw_arrows(painter, probe, world, canvas);
        }
    }

    /// Lays out the reason why nothing is seen, the offer of edits, and the error in the scene's file.
    fn bars(&mut self, ui: &mut Ui) {
        let App {
            document,
            canvas,
            desk,
            ..
        } = self;
        let world = &document.scene.world;
        let is_terms = viewer(world).show == ViewMode::Terms;
        let covered = canvas.pictures.frame.counts().covered_pixels;
        if canvas.drawn.is_some()
            && !is_terms
            && let Some(reason) = unseen::reason(world, &View::of(world, canvas.size()), covered)
        {
            let at = canvas.place.center();
            tag(ui.painter(), Align2::CENTER_CENTER, at, &reason, BAD);
        }
        edits_bar(ui, document, canvas.place, desk);
        if let Some(error) = &desk.file_error {
            let text = RichText::new(error).monospace().color(BAD);
            bar(ui, "error", Align2::LEFT_BOTTOM, canvas.place, |ui| {
                ui.label(text);
            });
        }
    }
}

/// The place of a click.
fn clicked(response: &Response) -> Option<Pos2> {
    let pointer = response.interact_pointer_pos();
    pointer.filter(|_| response.clicked())
}

/// Moves the camera by a drag or the wheel over the picture.
fn move_camera(ui: &Ui, picture: &Response, world: &mut World, canvas: &Canvas) {
    if picture.dragged_by(PointerButton::Primary) && picture.drag_delta() != Vec2::ZERO {
        let [width, height] = canvas.size();
        let degrees = DRAG_TURN / width.min(height) as f64;
        // The cuboid follows the mouse, so the camera goes the other way.
        let by = picture.drag_delta() * canvas.scale;
        orbit(world, f64::from(-by.x) * degrees, f64::from(by.y) * degrees);
    }
    if picture.hovered() {
        let notches = |event: &Event| match event {
            Event::MouseWheel { delta, .. } => delta.y,
            _ => 0.0,
        };
        let turned: f32 = ui.input(|input| input.events.iter().map(notches).sum());
        if turned.round() != 0.0 {
            zoom(world, turned.round() as i32);
        }
    }
}

/// Lays out the divider, which can be dragged. Returns the place of a click.
fn divider(ui: &Ui, world: &mut World, canvas: &Canvas) -> Option<Pos2> {
    let column = canvas.divider_column(&viewer(world));
    let x = canvas.place.min.x + column as f32 / canvas.scale;
    let line = canvas.place.y_range();
    let place = Rect::from_x_y_ranges(x - REACH..=x + REACH, line);
    let handle = ui.interact(place, ui.id().with("divider"), Sense::click_and_drag());
    if let Some(pointer) = handle.interact_pointer_pos().filter(|_| handle.dragged()) {
        let column = (pointer.x - canvas.place.min.x) * canvas.scale;
        viewer_mut(world).divider = canvas.divider_at(f64::from(column));
    }
    draw_line(ui.painter(), x, line);
    let edge = (1.0, Color32::from_black_alpha(150));
    // At the top, beside what is compared.
    let at = place.center_top() + vec2(0.0, HANDLE);
    ui.painter().circle(at, 8.0, Color32::WHITE, edge);
    clicked(&handle)
}
