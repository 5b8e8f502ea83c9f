//! The picture's area: drags, clicks and the wheel over it, and the marks and the legend drawn on it.

use egui::color_picker::show_color;
use egui::{
    Align, Align2, Area, Color32, Event, Frame, Layout, PointerButton, Pos2, Rect, Response,
    RichText, Sense, Ui, Vec2, vec2,
};

use super::app::App;
use super::inspector::Tab;
use super::pictures::{TINTS, divider_column};
use super::widgets::BAD;
use crate::components::{Camera, Orbit, ViewMode, active_camera, get};
use crate::paint::color;
use crate::shading::SquareKind;
use crate::trade::error_map::{EDGE, NOTHING, Scale};

/// How far a drag across the picture's shorter side turns, in degrees.
const DRAG_TURN: f64 = 200.0;
/// How far beside the divider a press still moves it, in points.
const REACH: f32 = 10.0;
/// The divider stays this share of the picture's width away from either edge.
pub const DIVIDER_MARGIN: f64 = 0.02;

impl App {
    /// Lays out the picture's area in the rest of the window.
    pub fn viewport(&mut self, ui: &mut Ui) {
        let scale = ui.ctx().pixels_per_point();
        let free = ui.available_rect_before_wrap();
        let whole = |at: Pos2| (at * scale).round() / scale;
        self.place = Rect::from_min_max(whole(free.min), whole(free.max));
        ui.set_clip_rect(self.place);
        // At its sides the panels are resized.
        let grab = vec2(ui.style().interaction.resize_grab_radius_side, 0.0);
        let area = self.place.shrink2(grab);
        let picture = ui.interact(area, ui.id().with("picture"), Sense::click_and_drag());
        let is_moved = picture.drag_delta() != Vec2::ZERO;
        if picture.dragged_by(PointerButton::Primary) && is_moved {
            let [width, height] = self.picture_size();
            let degrees = DRAG_TURN / width.min(height) as f64;
            // The cuboid follows the mouse, so the camera goes the other way.
            let by = picture.drag_delta() * scale;
            self.orbit(f64::from(-by.x) * degrees, f64::from(by.y) * degrees);
        }
        self.take_click(&picture);
        if picture.hovered() {
            let turned = |event: &Event| match event {
                Event::MouseWheel { delta, .. } => delta.y,
                _ => 0.0,
            };
            let turned: f32 = ui.input(|input| input.events.iter().map(turned).sum());
            if turned.round() != 0.0 {
                self.zoom(turned.round() as i32);
            }
        }
        if self.viewer().show == ViewMode::Wipe {
            if self.turn().is_none() {
                self.divider(ui);
            }
            self.tags(ui);
        }
        // A disc over a tag can be dragged.
        if self.desk.tab == Some(Tab::Scene) {
            self.discs(ui);
        }
        if let Some(pixel) = self.pixel() {
            let at = self.place_of(pixel);
            self.draw_arrows(ui.painter(), at);
            draw_cross(ui.painter(), at);
        }
        let ground = Frame::side_top_panel(ui.style());
        if matches!(self.viewer().show, ViewMode::Error | ViewMode::Tiles) {
            let corner = Area::new(ui.id().with("legend")).pivot(Align2::LEFT_BOTTOM);
            let corner = corner.fixed_pos(self.place.left_bottom());
            corner.constrain_to(self.place).show(ui.ctx(), |ui| {
                ui.set_max_width(self.place.width());
                ground.show(ui, |ui| self.legend(ui));
            });
        }
        self.edits_bar(ui);
        // Over the picture, whose size would otherwise change twice.
        if let Some(error) = &self.desk.file_error {
            let text = RichText::new(error).monospace().color(BAD);
            ui.with_layout(Layout::bottom_up(Align::Min), |ui| {
                ground.show(ui, |ui| ui.label(text))
            });
        }
    }

    /// Probes the pixel that was clicked.
    fn take_click(&mut self, response: &Response) {
        let pointer = response.interact_pointer_pos();
        if let Some(at) = pointer.filter(|_| response.clicked()) {
            let pixel = self.pixel_at(at);
            self.desk.clicked = Some(pixel);
            self.probe(pixel);
        }
    }

    /// Moves the camera about its target, by degrees to the right and up.
    pub fn orbit(&mut self, azimuth: f64, elevation: f64) {
        let world = &self.scene.world;
        let own = Camera::own(world, active_camera(world));
        let limit = "the camera stops short of the pole";
        self.change_orbit(limit, |orbit| orbit.moved(&own, azimuth, elevation));
    }

    /// Moves the camera by steps towards its target; away from it if negative.
    pub fn zoom(&mut self, steps: i32) {
        let limits = Orbit::limits(&self.scene.world);
        let way = if steps > 0 { "closer" } else { "further" };
        let limit = format!("the camera goes no {way}");
        self.change_orbit(&limit, |orbit| orbit.zoomed(steps, &limits));
    }

    /// Changes the orbit of the active camera. If nothing changes, shows the limit that was reached.
    pub fn change_orbit(&mut self, limit: &str, change: impl FnOnce(Orbit) -> Orbit) {
        let camera = active_camera(&self.scene.world);
        let orbit: Orbit = get(&self.scene.world, camera).unwrap_or_default();
        let changed = change(orbit);
        if changed == orbit {
            return self.say(limit);
        }
        // The camera is in the World.
        let _ = self.scene.world.insert_one(camera, changed);
    }

    /// The pixel of the picture at a place in the window, or the nearest one.
    fn pixel_at(&self, at: Pos2) -> [usize; 2] {
        let place = (at - self.place.min) * self.scale();
        let [width, height] = self.picture_size();
        let pixel = |at: f32, side: usize| (at.max(0.0) as usize).min(side - 1);
        [pixel(place.x, width), pixel(place.y, height)]
    }

    /// The place in the window of the middle of a pixel.
    pub fn place_of(&self, [x, y]: [usize; 2]) -> Pos2 {
        self.place.min + vec2(x as f32 + 0.5, y as f32 + 0.5) / self.scale()
    }

    /// The first column right of the divider.
    pub fn divider_column(&self) -> usize {
        divider_column(self.viewer().divider, self.picture_size()[0])
    }

    /// Lays out the divider, which can be dragged.
    fn divider(&mut self, ui: &Ui) {
        let x = self.place.min.x + self.divider_column() as f32 / self.scale();
        let line = self.place.y_range();
        let place = Rect::from_x_y_ranges(x - REACH..=x + REACH, line);
        let handle = ui.interact(place, ui.id().with("divider"), Sense::click_and_drag());
        self.take_click(&handle);
        if let Some(pointer) = handle.interact_pointer_pos().filter(|_| handle.dragged()) {
            let share = f64::from((pointer.x - self.place.min.x) / self.place.width());
            let divider = share.clamp(DIVIDER_MARGIN, 1.0 - DIVIDER_MARGIN);
            self.viewer_mut().divider = divider;
        }
        let painter = ui.painter();
        painter.vline(x, line, (4.0, Color32::from_black_alpha(110)));
        painter.vline(x, line, (2.0, Color32::from_white_alpha(230)));
        let edge = (1.0, Color32::from_black_alpha(150));
        painter.circle(place.center(), 8.0, Color32::WHITE, edge);
    }

    /// The meaning of the colours of the error map or of squares.
    fn legend(&self, ui: &mut Ui) {
        if self.viewer().show == ViewMode::Error {
            return self.error_legend(ui);
        }
        let counts = self.pictures.frame.counts().squares;
        let kinds = SquareKind::ALL.iter().zip(TINTS).zip(counts);
        ui.label("squares, by the colour in them");
        for ((kind, tint), count) in kinds {
            let row = swatch(ui, tint, &format!("{count} {}", kind.name()));
            row.on_hover_text(match kind {
                SquareKind::Linear => "Squares with a colour linear in x and y.",
                SquareKind::Quadratic => "Squares with a colour quadratic in x and in y.",
                SquareKind::Terminator => "As quadratic, where n.l of one light changes sign.",
                SquareKind::Highlight => {
                    "As quadratic, with the power of one highlight at each pixel."
                }
                _ => "Squares in which the model is evaluated at each pixel.",
            });
        }
    }

    /// The scale of the error map, with marks at the tolerance and at the largest error.
    fn error_legend(&self, ui: &mut Ui) {
        ui.label("error against exact Phong, levels");
        let comparison = self.facts.comparison.current();
        let largest = comparison.and_then(|it| it.error);
        let known = comparison.map(|_| Scale::holding(largest.unwrap_or(0.0)));
        let scale = known.unwrap_or(Scale::WIDEST);
        let size = vec2(ui.available_width().min(260.0), 26.0);
        let (place, response) = ui.allocate_exact_size(size, Sense::hover());
        response.on_hover_text("Levels of 255. White marks: the tolerance and the largest error.");
        let painter = ui.painter_at(place);
        scale.draw(&painter, place, Color32::GRAY);
        let marks = [Some(self.viewer().tolerance), largest];
        for mark in marks.into_iter().flatten() {
            // The scale leaves room for its last label.
            let share = scale.position(mark) as f32;
            let x = place.min.x + share * (place.width() - place.height());
            painter.vline(x, place.min.y..=place.center().y, (1.5, Color32::WHITE));
        }
        self.wait(ui, &self.facts.comparison);
        swatch(ui, EDGE, "another face is seen");
        swatch(ui, NOTHING, "nothing is drawn");
    }
}

/// Draws a cross around a pixel, which itself stays visible.
fn draw_cross(painter: &egui::Painter, at: Pos2) {
    for way in [Vec2::RIGHT, Vec2::LEFT, Vec2::DOWN, Vec2::UP] {
        let line = [at + way * 3.5, at + way * 11.5];
        painter.line_segment(line, (4.0, Color32::from_black_alpha(170)));
        painter.line_segment(line, (1.5, Color32::WHITE));
    }
}

fn swatch(ui: &mut Ui, pixel: u32, text: &str) -> Response {
    let row = ui.horizontal(|ui| {
        show_color(ui, color(pixel), vec2(14.0, 14.0));
        ui.label(text)
    });
    row.inner
}
