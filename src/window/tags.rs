//! The two sides of a wipe: tags that choose the method of each and show its price. And the pixel with the largest error.

use egui::{Align, Color32, ComboBox, Frame, Layout, RichText, TextWrapMode, Ui, UiBuilder};

use super::app::App;
use super::inspector::Tab;
use super::pictures::sides;
use super::viewport::DIVIDER_MARGIN;
use super::widgets::{INK, short};
use crate::components::{ShadingMode, Side, ViewMode};
use crate::report::words::capital;
use crate::shading::{METHODS, Method};
use crate::trade::Measurement;
use crate::trade::verdict::method_name;

/// The distance of a tag from the edges of the picture, in points.
const GAP: f32 = 9.0;
const KEPT: &str = "The share of the highlight's light that is where exact Phong has it.";

const SHORTCUT: &str =
    "The assignment's shortcut: n, l and o are interpolated as unit vectors and not normalised.";

/// The sides to choose from.
fn choices() -> Vec<Side> {
    let methods = METHODS.iter().map(|method| Side::Method {
        mode: method.mode,
        tolerance: method.tolerance,
    });
    methods.chain([Side::Picture, Side::Reference]).collect()
}

impl App {
    /// The method of a side; `None` for the reference, and where the cuboids have different modes.
    pub fn side_method(&self, side: &Side) -> Option<Method> {
        match *side {
            Side::Picture => self.method(),
            Side::Method { mode, tolerance } => Some(Method::of(mode, tolerance)),
            Side::Reference => None,
        }
    }

    pub fn side_name(&self, side: &Side) -> String {
        let method = self.side_method(side).map(method_name);
        match side {
            Side::Reference => "Exact Phong in f64".to_owned(),
            Side::Picture => format!("Picture: {}", method.unwrap_or_else(|| "mixed".to_owned())),
            Side::Method { .. } => capital(&method.unwrap_or_default()),
        }
    }

    /// The measurements of the pictures left and right of the divider.
    fn prices(&self) -> [Option<&Measurement>; 2] {
        sides(&self.viewer()).map(|side| self.measured(self.side_method(&side)?))
    }

    /// Lays out the tag of each side in the corner of its half; while the sides take turns, that of the side on screen.
    pub fn tags(&mut self, ui: &mut Ui) {
        let mut sides = self.viewer().sides;
        let area = self.place.shrink(GAP);
        let (left, right) = area.split_left_right_at_fraction(0.5);
        let halves = [(left, Align::Min), (right, Align::Max)];
        let mut clicked = None;
        for (index, (half, align)) in halves.into_iter().enumerate() {
            if self.turn().is_some_and(|turn| turn != index) {
                continue;
            }
            let builder = UiBuilder::new().max_rect(half).id_salt(("tag", index));
            let mut tag = ui.new_child(builder.layout(Layout::top_down(align)));
            tag.set_clip_rect(self.place);
            let ground = Frame::new().fill(Color32::from_black_alpha(205));
            let ground = ground.corner_radius(4.0).inner_margin(6.0);
            ground.show(&mut tag, |ui| {
                ui.style_mut().wrap_mode = Some(TextWrapMode::Truncate);
                let name = self.side_name(&sides[index]);
                let methods = ComboBox::from_id_salt(index).selected_text(name);
                methods.height(400.0).show_ui(ui, |ui| {
                    for side in choices() {
                        let method = self.side_method(&side);
                        let name = self.side_name(&side);
                        let row = ui.selectable_value(&mut sides[index], side, name);
                        if method.is_some_and(|it| it.mode == ShadingMode::UnitVectors) {
                            row.on_hover_text(SHORTCUT);
                        }
                    }
                });
                if self.prices()[index].is_some_and(|price| self.price(ui, price)) {
                    clicked = Some(index);
                }
            });
        }
        self.viewer_mut().sides = sides;
        if let Some(index) = clicked {
            self.explain_worst_of(index);
        }
    }

    /// Lays out the price of a method. Returns whether its worst pixel was clicked.
    fn price(&self, ui: &mut Ui, price: &Measurement) -> bool {
        ui.colored_label(INK, format!("{} ms a frame", short(price.timing.median)));
        if let Some(kept) = price.highlight_kept {
            let text = format!("highlight kept {:.0} %", 100.0 * kept);
            ui.colored_label(INK, text).on_hover_text(KEPT);
        }
        let worst = price.largest_error().map(|error| {
            let text = format!("worst pixel {} of 255", short(error));
            ui.link(RichText::new(text).color(INK))
        });
        if !self.facts.trade.is_current {
            ui.weak("measuring");
        }
        worst.is_some_and(|it| it.on_hover_text("Shows why it errs.").clicked())
    }

    /// Explains the worst pixel of the picture, or of the side of a wipe that errs more.
    pub fn explain_worst(&mut self) {
        let errors = self.prices().map(|price| price?.largest_error());
        self.explain_worst_of(usize::from(errors[1] > errors[0]));
    }

    /// Explains the worst pixel of a side, and moves the divider where the other side of a wipe hides it.
    fn explain_worst_of(&mut self, index: usize) {
        if !self.facts.trade.is_current {
            return self.say("the errors are not measured yet");
        }
        let Some([x, y]) = self.prices()[index].and_then(Measurement::worst_pixel) else {
            return self.say("the picture has no worst pixel");
        };
        let is_wipe = self.viewer().show == ViewMode::Wipe;
        if is_wipe && usize::from(x >= self.divider_column()) != index {
            // A tenth of the width beside it, so that its surroundings are seen.
            let beside = [0.1, -0.1][index] + x as f64 / self.picture_size()[0] as f64;
            let divider = beside.clamp(DIVIDER_MARGIN, 1.0 - DIVIDER_MARGIN);
            self.viewer_mut().divider = divider;
        }
        self.probe([x, y]);
        self.desk.tab = Some(Tab::Pixel);
    }

    /// Explains a pixel, and opens the tab for it.
    pub fn probe(&mut self, pixel: [usize; 2]) {
        let size = self.picture_size();
        self.viewer_mut().set_pixel(pixel, size);
        // The scene's tab stays open: a click selects the cuboid there.
        if self.desk.tab != Some(Tab::Scene) {
            self.desk.tab = Some(Tab::Pixel);
        }
    }
}
