//! The words on a picture: those on one that stands alone (the names in it, the line of a wipe, scales, the curve along a row), and
//! the tags that choose the two sides of a wipe.

use egui::color_picker::show_color;
use egui::{
    Align, Align2, Color32, ComboBox, Frame, Layout, Painter, Pos2, Rect, Sense, TextWrapMode, Ui,
    UiBuilder, vec2,
};

use super::app::App;
use super::canvas::Canvas;
use super::error_map::{EDGE, NOTHING, draw_scale, position};
use super::facts::Facts;
use super::help::about;
use super::inspector::{SECTION, section};
use super::marks::{draw_cross, draw_line};
use super::pictures::{QUARTERS, TINTS, side_method};
use super::widgets::{INK, tag};
use crate::components::{LightKind, ShadingMode, Side, ViewMode, Viewer};
use crate::output::paint::{annotate, area, color};
use crate::output::words::capital;
use crate::questions::trade::verdict::method_name;
use crate::shading::{METHODS, Method, SquareKind};

/// From a label to the edge of the picture, in points.
const GAP: f32 = 10.0;
/// The height of the curve along a row, as a share of the picture's.
const CURVE: f32 = 0.3;

/// A picture, and what is known of it.
pub struct Labels<'a> {
    /// The place of the picture, in points.
    pub place: Rect,
    pub canvas: &'a Canvas,
    pub viewer: &'a Viewer,
    pub facts: &'a Facts,
    /// The method on screen.
    pub method: Option<Method>,
    /// The side on screen while the sides of a wipe take turns.
    pub turn: Option<usize>,
    /// Whether the sides of a wipe have their names.
    pub has_names: bool,
    /// Whether the curve along the row of the explained pixel is drawn.
    pub has_row: bool,
}

impl Labels<'_> {
    /// Lays out the words over the picture, and marks the explained pixel.
    pub fn show(&self, ui: &mut Ui) {
        match self.viewer.show {
            ViewMode::Wipe if self.has_names => self.draw_sides(ui.painter()),
            ViewMode::Picture | ViewMode::Wipe => {}
            ViewMode::Terms => draw_terms(ui.painter(), self.place),
            ViewMode::Error | ViewMode::Tiles => {
                self.ground(ui, self.place.shrink(GAP), |ui| {
                    ui.label(side_name(&Side::Picture, self.method));
                    legend(ui, self.viewer, self.canvas, self.facts);
                });
            }
        }
        if let Some(pixel) = self.canvas.pixel(self.viewer) {
            if self.has_row {
                let height = SECTION.min(CURVE * self.place.height());
                let top = self.place.bottom() - height;
                self.curve(ui, self.place.with_min_y(top), pixel);
            }
            draw_cross(ui.painter(), self.place_of(pixel));
        }
    }

    /// Draws the words into the picture itself, row by row from the top.
    pub fn draw(&self, pixels: &mut [u32]) {
        let size = self.canvas.size();
        let place = area(size);
        annotate(pixels, size, |ui| {
            if self.viewer.show == ViewMode::Wipe {
                let column = self.canvas.divider_column(self.viewer);
                draw_line(ui.painter(), column as f32, place.y_range());
            }
            Labels { place, ..*self }.show(ui);
        });
    }

    /// The place of the middle of a pixel.
    fn place_of(&self, pixel: [usize; 2]) -> Pos2 {
        let size = self.canvas.size();
        let share = |axis: usize| (pixel[axis] as f32 + 0.5) / size[axis] as f32;
        self.place.lerp_inside(vec2(share(0), share(1)))
    }

    /// The name of each side of a wipe.
    fn draw_sides(&self, painter: &Painter) {
        let corners = [Align2::LEFT_TOP, Align2::RIGHT_TOP];
        for (side, corner) in corners.into_iter().enumerate() {
            if self.turn.is_none_or(|turn| turn == side) {
                let name = side_name(&self.viewer.sides[side], self.method);
                let at = corner.pos_in_rect(&self.place.shrink(GAP));
                tag(painter, corner, at, &name, INK);
            }
        }
    }

    /// Lays out widgets on a ground over the picture.
    fn ground(&self, ui: &mut Ui, place: Rect, widgets: impl FnOnce(&mut Ui)) {
        let mut child = ui.new_child(UiBuilder::new().max_rect(place));
        child.set_clip_rect(self.place);
        Frame::side_top_panel(ui.style()).show(&mut child, widgets);
    }

    /// The levels along the row of a pixel.
    fn curve(&self, ui: &mut Ui, place: Rect, [column, row]: [usize; 2]) {
        let Some((_, probes)) = self.facts.section.current() else {
            return;
        };
        let here = probes.iter().find(|it| it.pixel == [column, row]);
        if let Some(surface) = here.and_then(|it| it.surface.as_ref()) {
            self.ground(ui, place, |ui| section(ui, probes, column, surface));
        }
    }
}

/// The names of the terms in the quarters of the picture.
fn draw_terms(painter: &Painter, place: Rect) {
    for (quarter, kind) in QUARTERS.into_iter().enumerate() {
        let name = kind.map_or("sum", LightKind::name);
        let share = vec2((quarter % 2) as f32, (quarter / 2) as f32) / 2.0;
        let corner = place.min + place.size() * share + vec2(12.0, 10.0);
        tag(painter, Align2::LEFT_TOP, corner, name, INK);
    }
}

/// The meaning of the colours of the error map or of squares.
fn legend(ui: &mut Ui, viewer: &Viewer, canvas: &Canvas, facts: &Facts) {
    if viewer.show == ViewMode::Error {
        return error_legend(ui, viewer.tolerance, facts);
    }
    let counts = canvas.pictures.frame.counts().squares;
    let kinds = SquareKind::ALL.iter().zip(TINTS).zip(counts);
    ui.label("squares, by the colour in them");
    for ((kind, tint), count) in kinds {
        swatch(ui, tint, &format!("{count} {}", kind.name()));
    }
}

/// The scale of the error map, with marks at the tolerance and at the largest error.
fn error_legend(ui: &mut Ui, tolerance: f64, facts: &Facts) {
    ui.label("error against exact Phong, levels");
    let comparison = facts.comparison.current();
    let largest = comparison.and_then(|it| it.worst).map(|it| it.error);
    let size = vec2(ui.available_width().min(260.0), 26.0);
    let (place, response) = ui.allocate_exact_size(size, Sense::hover());
    response.on_hover_text("Levels of 255. White marks: the tolerance and the largest error.");
    let painter = ui.painter_at(place);
    draw_scale(&painter, place, Color32::GRAY);
    let marks = [Some(tolerance), largest];
    for mark in marks.into_iter().flatten() {
        // The scale leaves room for its last label.
        let share = position(mark) as f32;
        let x = place.min.x + share * (place.width() - place.height());
        painter.vline(x, place.min.y..=place.center().y, (1.5, Color32::WHITE));
    }
    swatch(ui, EDGE, "another face is seen");
    swatch(ui, NOTHING, "nothing is drawn");
}

fn swatch(ui: &mut Ui, pixel: u32, text: &str) {
    ui.horizontal(|ui| {
        show_color(ui, color(pixel), vec2(14.0, 14.0));
        ui.label(text);
    });
}

/// The name of a side; `shown` is the method on screen.
pub fn side_name(side: &Side, shown: Option<Method>) -> String {
    let method = side_method(side, shown).map(method_name);
    match side {
        Side::Reference => "Reference: exact Phong in f64".to_owned(),
        Side::Picture => format!("Picture: {}", method.unwrap_or_else(|| "mixed".to_owned())),
        Side::Method { .. } => capital(&method.unwrap_or_default()),
    }
}

/// In a narrower picture, in points, a side has its name alone, and a lamp none.
pub const ROOM: f32 = 450.0;

impl App {
    /// Lays out the tag of each side in the corner of its half; while the sides take turns, that of the side on screen.
    pub(super) fn tags(&mut self, ui: &mut Ui) {
        let (place, shown, turn) = (self.canvas.place, self.method(), self.desk.turn());
        let mut sides = self.viewer().sides;
        let (left, right) = place.shrink(GAP).split_left_right_at_fraction(0.5);
        let halves = [(left, Align::Min), (right, Align::Max)];
        for (index, (half, align)) in halves.into_iter().enumerate() {
            if turn.is_some_and(|turn| turn != index) {
                continue;
            }
            let builder = UiBuilder::new().max_rect(half).id_salt(("tag", index));
            let mut tag = ui.new_child(builder.layout(Layout::top_down(align)));
            tag.set_clip_rect(place);
            let ground = Frame::new()
                .fill(Color32::from_black_alpha(205))
                .corner_radius(4.0)
                .inner_margin(6.0);
            ground.show(&mut tag, |ui| {
                ui.style_mut().wrap_mode = Some(TextWrapMode::Truncate);
                let own = side_name(&sides[index], shown);
                let methods = ComboBox::from_id_salt(index).selected_text(own);
                methods.height(400.0).show_ui(ui, |ui| {
                    let methods = METHODS.iter().copied().map(Side::from);
                    for side in [Side::Picture, Side::Reference].into_iter().chain(methods) {
                        let name = side_name(&side, shown);
                        ui.selectable_value(&mut sides[index], side, name);
                    }
                });
                if place.width() >= ROOM {
                    let method = side_method(&sides[index], shown);
                    side_rows(ui, &self.study.facts, method, self.desk.shows_times);
                }
            });
        }
        self.viewer_mut().sides = sides;
    }
}

/// Lays out where a side computes light, and how much of the highlight it keeps.
fn side_rows(ui: &mut Ui, facts: &Facts, method: Option<Method>, is_measured: bool) {
    ui.colored_label(
        INK,
        match method.map(|it| it.mode) {
            Some(ShadingMode::Gouraud) => "light at vertices",
            Some(ShadingMode::Flat) => "light once a face",
            _ => "light at pixels",
        },
    );
    let measured = method.and_then(|method| facts.measured(method));
    if let Some(kept) = measured.and_then(|it| it.highlight_kept) {
        let text = format!("highlight kept {:.0} %", 100.0 * kept);
        ui.colored_label(INK, text)
            .on_hover_text(about("highlight kept"));
    } else if is_measured && method.is_some() && facts.trade.current().is_none() {
        ui.weak("highlight kept: measuring");
    }
}
