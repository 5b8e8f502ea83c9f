//! The look of the panels, one text size, calm colours, no animations; and widgets and numbers that several of them share.

use std::hash::Hash;
use std::ops::RangeInclusive;

use egui::{
    Align2, Area, Button, Color32, Context, DragValue, FontId, Frame, Label, Order, Pos2,
    ProgressBar, Rect, Response, RichText, ScrollArea, Sense, TextStyle, Theme, Ui, vec2,
};
use egui_plot::Plot;
use hecs::World;

use super::desk::Desk;
use super::help::about;
use super::keys::{Action, binding, caption};
use super::study::Study;
use crate::components::{Segments, ShadingMode, common};
use crate::output::words::counted;
pub use crate::output::words::{rounded, short};

/// The colour of numbers.
pub const INK: Color32 = Color32::from_gray(220);
pub const GOOD: Color32 = Color32::from_rgb(0x3c, 0xb8, 0x7c);
pub const BAD: Color32 = Color32::from_rgb(0xff, 0x6b, 0x5a);
/// The curves and dots of flat, Gouraud and Phong shading.
pub const FLAT: Color32 = Color32::from_rgb(0x56, 0xb4, 0xe9);
pub const GOURAUD: Color32 = Color32::from_rgb(0xff, 0xb4, 0x54);
pub const PHONG: Color32 = Color32::from_rgb(0x34, 0xd3, 0x99);
/// The dots of the interpolated unit vectors.
const SHORTCUT: Color32 = Color32::from_rgb(0xcc, 0x79, 0xa7);
/// The dot of Blinn-Phong.
const BLINN: Color32 = Color32::from_rgb(0xf0, 0xe4, 0x42);

/// The colour of a method's dot.
pub fn mode_ink(mode: ShadingMode) -> Color32 {
    match mode {
        ShadingMode::Flat => FLAT,
        ShadingMode::Gouraud => GOURAUD,
        ShadingMode::Phong => PHONG,
        ShadingMode::UnitVectors => SHORTCUT,
        ShadingMode::BlinnPhong => BLINN,
    }
}

/// Sets the look of all widgets.
pub fn apply_style(context: &Context) {
    context.set_theme(Theme::Dark);
    context.all_styles_mut(|style| {
        // An animation would draw frames while nothing changes.
        style.animation_time = 0.0;
        style.visuals.text_cursor.blink = false;
        for (name, font) in &mut style.text_styles {
            font.size = match name {
                TextStyle::Small => 11.0,
                TextStyle::Monospace => 12.0,
                TextStyle::Heading => 15.0,
                _ => 13.0,
            };
        }
        style.spacing.item_spacing = vec2(6.0, 4.0);
        // Bars in sight say that there is more.
        style.spacing.scroll = egui::style::ScrollStyle::thin();
        style.spacing.combo_width = 110.0;
        style.visuals.widgets.noninteractive.fg_stroke.color = Color32::from_gray(200);
    });
}

/// A button with words of its own for an action.
pub fn button(ui: &mut Ui, desk: &mut Desk, words: &str, action: Action) {
    let button = Button::new(words).shortcut_text(caption(action));
    if ui.add(button).clicked() {
        desk.wish(action);
    }
}

/// Lays out the number of segments, between fewer and more.
pub fn segment_buttons(ui: &mut Ui, world: &World, desk: &mut Desk) {
    let count = common::<Segments>(world).unwrap_or_default().count();
    button(ui, desk, "fewer", Action::Segments(-1));
    ui.label(counted(count, "segment"))
        .on_hover_text(about("segment"));
    button(ui, desk, "more", Action::Segments(1));
}

/// A button with the name and the key of an action, and its sentence as a tooltip.
pub fn action_button(ui: &mut Ui, action: Action, is_chosen: bool) -> Response {
    let (name, says) = binding(action).map_or(("", ""), |it| (it.0, it.1));
    let button = Button::selectable(is_chosen, name)
        .shortcut_text(caption(action))
        .sense(Sense::click_and_drag());
    ui.add(button).on_hover_text(says)
}

/// A button whose click runs an action.
pub fn offer(ui: &mut Ui, desk: &mut Desk, action: Action, is_chosen: bool) {
    if action_button(ui, action, is_chosen).clicked() {
        desk.wish(action);
    }
}

/// Shows the progress of the work in the background until a fact is known.
pub fn wait(ui: &mut Ui, study: &Study, is_known: bool) {
    match study.progress() {
        _ if is_known => {}
        None => drop(ui.weak("waits until nothing moves")),
        Some((step, share)) => drop(ui.add(ProgressBar::new(share as f32).text(step))),
    }
}

/// Six significant digits at most, with an exponent where the number is very large or small.
fn format_number(value: f64, _: RangeInclusive<usize>) -> String {
    let rounded = rounded(value, 5);
    match rounded.abs() {
        0.0 => "0".to_owned(),
        1e-3..1e6 => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

/// A number that is dragged, or clicked and typed. A drag changes it in proportion to its size.
pub fn number(ui: &mut Ui, value: &mut f64, range: RangeInclusive<f64>) -> Response {
    let (before, speed) = (*value, (value.abs() * 0.01).max(0.01));
    let drag = DragValue::new(value)
        .speed(speed)
        .range(range)
        // A number that is being typed is not the number that is meant.
        .update_while_editing(false)
        .custom_formatter(format_number);
    let response = ui.add(drag);
    keep_digits(value, before);
    response
}

/// A widget rounds its number to the digits that it shows even if nobody edits it.
fn keep_digits(value: &mut f64, before: f64) {
    if format_number(*value, 0..=0) == format_number(before, 0..=0) {
        *value = before;
    }
}

/// A button beside a number that shows it against the error. Tab passes it by on its way to the next number. Returns whether
/// it was clicked.
pub fn vary_button(ui: &mut Ui, button: Button<'_>) -> bool {
    let says = "Shows the errors over the range of this number (\"Try a range\").";
    let button = ui.add(button.sense(Sense::CLICK));
    button.on_hover_text(says).clicked()
}

/// Lays out a text in the room that one of `longest` letters takes, so that what is below keeps its place.
pub fn text(ui: &mut Ui, shown: &str, longest: usize, letters: f32) {
    // A letter is half as wide as it is high, and a row ends before its last word.
    let rows = (longest as f32 * 0.56 * letters / ui.available_width()).ceil();
    ui.vertical(|ui| {
        ui.set_min_height(rows * 1.3 * letters);
        let text = RichText::new(shown).size(letters).color(INK);
        ui.add(Label::new(text).wrap());
    });
}

/// Words on a dark ground that can be read over any picture.
pub fn tag(painter: &egui::Painter, align: Align2, at: Pos2, text: &str, ink: Color32) {
    let text = painter.layout_no_wrap(text.to_owned(), FontId::proportional(13.0), ink);
    let place = align.anchor_size(at, text.size());
    let ground = Color32::from_black_alpha(170);
    painter.rect_filled(place.expand2(vec2(4.0, 2.0)), 3.0, ground);
    painter.galley(place.min, text, ink);
}

/// Lays out widgets on a ground of their own, over everything else at a side of `place`.
pub fn bar(ui: &Ui, name: &str, side: Align2, place: Rect, widgets: impl FnOnce(&mut Ui)) {
    let bar = Area::new(ui.id().with(name))
        .pivot(side)
        .fixed_pos(side.pos_in_rect(&place))
        .constrain_to(place)
        .order(Order::Foreground);
    bar.show(ui.ctx(), |ui| {
        ui.set_max_width(place.width());
        Frame::side_top_panel(ui.style()).show(ui, widgets);
    });
}

/// Lays out widgets in the room that is left. It scrolls, also to the widget that has just got the keyboard's focus.
pub fn scrolled(ui: &mut Ui, name: impl Hash, widgets: impl FnOnce(&mut Ui)) {
    let scroll = ScrollArea::both().auto_shrink(false).id_salt(name);
    scroll.show(ui, |ui| {
        widgets(ui);
        let focused = ui.memory(egui::Memory::focused);
        let found = focused.and_then(|id| ui.ctx().read_response(id));
        let columns = ui.min_rect().x_range();
        let is_here = |it: &Response| columns.contains(it.rect.center().x);
        let is_cut = |it: &Response| it.interact_rect != it.rect;
        let found = found.filter(|it| it.gained_focus() && is_here(it) && is_cut(it));
        if let Some(found) = found {
            ui.scroll_to_rect(found.rect, None);
        }
    });
}

/// A plot that the mouse does not move.
pub fn still(plot: Plot<'_>) -> Plot<'_> {
    let plot = plot.allow_drag(false).allow_zoom(false);
    plot.allow_scroll(false).allow_boxed_zoom(false)
}
