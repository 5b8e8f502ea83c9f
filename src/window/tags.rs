//! The two sides of a wipe: a tag for each, with a menu of methods and the price of the one that is shown,
//! and a mark on its worst pixel.

use egui::{
    Color32, Frame, Margin, Pos2, ProgressBar, Rect, RichText, TextWrapMode, Ui, UiBuilder, vec2,
};

use super::app::App;
use super::style::{BAD, STALE, mode_ink};
use super::viewport::DIVIDER_MARGIN;
use super::widgets::{ink, short};
use crate::components::{Inspector, Probed, Show, Side, Tab, ViewMode};
use crate::report::words::capital;
use crate::shading::{METHODS, Method};
use crate::trade::Measurement;
use crate::trade::verdict::method_name;

/// The usual width of a tag, and its distance from the edges of the picture, in points.
const WIDTH: f32 = 188.0;
const GAP: f32 = 9.0;
/// The length of the bar of a time, in points.
const BAR: f32 = 90.0;
/// A smaller picture has tags without a price, in points.
const ROOM: f32 = 300.0;
/// How far beside the mark of a worst pixel a click still counts, in points.
const REACH: f32 = 10.0;
const PRICE: &str = "The median time of a frame; both bars have one scale.";
const KEPT: &str = "The share of the highlight's light that is where exact Phong has it.";
const WORST: &str = "Shows why it errs.";
const OLD_PRICE: &str = "Grey: this was measured in another view or size. It is measured again as soon as nothing moves.";

/// The sides to choose from, in the order of menus and keys.
pub fn choices() -> Vec<Side> {
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

    /// The measurements of both sides.
    fn prices(&self) -> [Option<&Measurement>; 2] {
        let Show { sides, .. } = self.look();
        sides.map(|side| self.measured(self.side_method(&side)?))
    }

    /// Lays out the tag of each side; while the sides take turns, that of the side on screen.
    pub fn tags(&mut self, ui: &mut Ui) {
        let Show { mut sides, .. } = self.look();
        let before = sides;
        let prices = self.prices();
        let times = prices.iter().flatten().map(|price| price.timing.median);
        let slowest = times.fold(0.0, f64::max);
        let width = ((self.place.width() - 3.0 * GAP) / 2.0).clamp(0.0, WIDTH);
        let has_room = self.place.height() > ROOM && width > 0.8 * WIDTH;
        let mut clicked = None;
        for (index, side) in sides.iter_mut().enumerate() {
            if self.turn().is_some_and(|turn| turn != index) {
                continue;
            }
            // The left tag stands in the left corner, the right tag in the right one.
            let right = self.place.width() - width - GAP;
            let corner = self.place.min + vec2([GAP, right][index], GAP);
            let place = Rect::from_min_size(corner, vec2(width, 0.0));
            let mut tag = ui.new_child(UiBuilder::new().max_rect(place).id_salt(("tag", index)));
            tag.set_clip_rect(self.place);
            let ground = Frame::new().fill(Color32::from_black_alpha(205));
            let ground = ground.corner_radius(4.0).inner_margin(Margin::same(6));
            ground.show(&mut tag, |ui| {
                ui.set_width((width - 12.0).max(0.0));
                ui.style_mut().wrap_mode = Some(TextWrapMode::Truncate);
                let name = format!("{} ⏷", self.side_name(side));
                ui.menu_button(RichText::new(name).strong(), |ui| {
                    for choice in choices() {
                        ui.selectable_value(side, choice, self.side_name(&choice));
                    }
                });
                if let Some(price) = prices[index].filter(|_| has_room)
                    && self.price(ui, price, slowest)
                {
                    clicked = Some(index);
                }
            });
        }
        if sides != before {
            self.wipe(sides);
        }
        if let Some(index) = clicked {
            self.explain(index);
        }
    }

    /// Lays out the price of a method; whether its worst pixel was clicked.
    fn price(&self, ui: &mut Ui, price: &Measurement, slowest: f64) -> bool {
        let is_current = self.facts.trade.current().is_some();
        let told = |says| if is_current { says } else { OLD_PRICE };
        let mut fill = mode_ink(price.method.mode);
        if !is_current {
            fill = STALE;
            ui.visuals_mut().hyperlink_color = STALE;
        }
        ui.visuals_mut().override_text_color = Some(ink(&self.facts.trade));
        let time = price.timing.median;
        let row = ui.horizontal(|ui| {
            let bar = ProgressBar::new((time / slowest) as f32).fill(fill);
            let width = BAR.min(ui.available_width() / 2.0);
            ui.add(bar.desired_width(width).desired_height(8.0));
            ui.label(format!("{} ms", short(time)));
        });
        row.response.on_hover_text(told(PRICE));
        if let Some(kept) = price.highlight_kept {
            let kept = ui.label(format!("highlight kept {:.0} %", 100.0 * kept));
            kept.on_hover_text(told(KEPT));
        }
        let worst = |error| ui.link(format!("worst pixel {} of 255", short(error)));
        let worst = price.error.map(worst);
        worst.is_some_and(|it| it.on_hover_text(told(WORST)).clicked() && is_current)
    }

    /// Probes the worst pixel of a side, and moves the divider where the other side hides it.
    fn explain(&mut self, index: usize) {
        let Some([x, y]) = self.prices()[index].and_then(|it| it.worst) else {
            return;
        };
        let show: Show = self.look();
        if usize::from(x >= self.divider_column()) != index {
            // A tenth of the width beside it, so that its surroundings are seen as well.
            let beside = [0.1, -0.1][index] + x as f64 / self.picture_size()[0] as f64;
            let divider = beside.clamp(DIVIDER_MARGIN, 1.0 - DIVIDER_MARGIN);
            self.set_look(Show { divider, ..show });
        }
        self.probe([x, y]);
    }

    /// Explains the worst pixel of the picture, or of the side of a wipe that errs more.
    pub fn explain_worst(&mut self) {
        let wipes = self.look::<Show>().mode == ViewMode::Wipe;
        let errors = self.prices().map(|price| price?.error);
        let picture = self
            .method()
            .and_then(|method| self.measured(method)?.worst);
        match picture {
            _ if self.facts.trade.current().is_none() => self.say("the errors are not known yet"),
            _ if wipes => self.explain(usize::from(errors[1] > errors[0])),
            Some(pixel) => self.probe(pixel),
            None => self.say("the picture has no worst pixel"),
        }
    }

    /// Looks at a pixel, in the tab for it where there is room.
    pub fn probe(&mut self, pixel: [usize; 2]) {
        self.set_look(Probed(Some(pixel)));
        // The scene's tab stays open: a click selects the cuboid there.
        if self.desk.has_both && self.look::<Inspector>().0 != Some(Tab::Scene) {
            self.set_look(Inspector(Some(Tab::Pixel)));
        }
    }

    /// The worst pixels that their side of the wipe shows, which are marked.
    fn worst_pixels(&self) -> impl Iterator<Item = [usize; 2]> {
        let (show, divider): (Show, _) = (self.look(), self.divider_column());
        let is_marked = self.facts.trade.current().is_some() && show.mode == ViewMode::Wipe;
        let prices = self.prices().into_iter().enumerate();
        prices.filter_map(move |(index, price)| {
            let is_shown = |it: &[usize; 2]| is_marked && usize::from(it[0] >= divider) == index;
            price?.worst.filter(is_shown)
        })
    }

    /// The worst pixel whose mark is at a place in the window.
    pub fn worst_at(&self, at: Pos2) -> Option<[usize; 2]> {
        let is_near = |pixel: &[usize; 2]| self.place_of(*pixel).distance(at) < REACH;
        self.worst_pixels().find(is_near)
    }

    /// Marks the worst pixels.
    pub fn draw_worst(&self, painter: &egui::Painter) {
        for pixel in self.worst_pixels() {
            let at = self.place_of(pixel);
            painter.circle_stroke(at, 8.0, (4.0, Color32::from_black_alpha(150)));
            painter.circle_stroke(at, 8.0, (2.0, BAD));
        }
    }
}
