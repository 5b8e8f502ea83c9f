//! The two sides of a wipe: tags that choose the method of each.

use egui::{Align, Color32, ComboBox, Frame, Layout, TextWrapMode, Ui, UiBuilder};

use super::app::App;
use super::facts::Facts;
use super::help::about;
use super::pictures::side_method;
use super::widgets::INK;
use crate::components::{ShadingMode, Side};
use crate::output::words::capital;
use crate::questions::trade::verdict::method_name;
use crate::shading::{METHODS, Method};

/// The distance of a tag from the edges of the picture, in points.
const GAP: f32 = 9.0;

/// The sides to choose from.
fn choices() -> Vec<Side> {
    let methods = METHODS.iter().copied().map(Side::from);
    let others = [Side::Picture, Side::Reference].into_iter();
    others.chain(methods).collect()
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
                    for side in choices() {
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
            Some(ShadingMode::Gouraud) => "light at the vertices",
            Some(ShadingMode::Flat) => "light once a face",
            _ => "light at every pixel",
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
