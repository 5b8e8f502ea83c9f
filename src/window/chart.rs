//! The charts beside the picture: the trade of the view as a control, and the legends of views.
//!
//! ```text
//! error |  o-+                a dot a method, its whisker the interval of its time
//! of    |    +--(o)           the ring is on screen
//! 255   |        +---o        the staircase is what no other method beats
//!       +------------- ms     both logarithmic
//! ```

use egui::{
    Align2, Color32, CursorIcon, FontId, Pos2, Rect, Sense, Ui, Vec2, WidgetInfo, WidgetType, pos2,
    vec2,
};
use egui_plot::Plot;

use super::app::App;
use super::inspector::{short, two_digits};
use super::jobs::State;
use super::keys::{Command, caption};
use super::pictures::TINTS;
use super::style::{BAD, INK, STALE, mode_ink};
use crate::components::{ShadingMode, Show, Side, Tolerance, ViewMode};
use crate::paint::color;
use crate::prove::{REFUTED, UNDECIDED};
use crate::report::chart::ticks;
use crate::report::words::capital;
use crate::shading::{Method, TileKind};
use crate::trade::Measurement;
use crate::trade::budget::ladder;
use crate::trade::error_map::{EDGE, NOTHING, Scale};
use crate::trade::plot::FLOOR;
use crate::trade::verdict::method_name;
use crate::trade::verdict::{UNSEEN, sentence};

/// The heights of the sentence and of the chart, in points. They are fixed, so that the rows below do not move.
const SENTENCE: f32 = 66.0;
const CHART: f32 = 190.0;
const GROUND: Color32 = Color32::from_gray(20);
/// The axis of errors, in levels.
const ERRORS: [f64; 2] = [FLOOR * 0.5, 500.0];
/// The radii of a dot and of the ring, and how far a dot can be missed, in points.
const DOT: f32 = 4.0;
const RING: f32 = 8.5;
const REACH: f32 = 8.0;
/// Tolerance 0 on the way along the staircase, whose steps are ratios, in levels.
const ALMOST_EXACT: f64 = 0.02;

/// The place of times and errors in the window.
struct Axes {
    place: Rect,
    /// The least and the greatest time, in ms.
    times: [f64; 2],
}

impl Axes {
    fn of(measured: &[Measurement], place: Rect) -> Axes {
        let ends = measured.iter().flat_map(|it| it.timing.interval);
        let [least, most] = [
            ends.clone().fold(f64::INFINITY, f64::min),
            ends.fold(0.0, f64::max),
        ];
        // A clock that does not tell times apart gives 0.
        let least = least.clamp(1e-6, 1e6);
        let most = most.clamp(2.0 * least, 1e9);
        Axes {
            place,
            times: [0.8 * least, 1.25 * most],
        }
    }

    fn at(&self, time: f64, error: f64) -> Pos2 {
        let share = |value: f64, [least, most]: [f64; 2]| {
            let value = value.clamp(least, most);
            ((value / least).ln() / (most / least).ln()) as f32
        };
        let [x, y] = [share(time, self.times), share(error.max(FLOOR), ERRORS)];
        self.place.lerp_inside(vec2(x, 1.0 - y))
    }

    fn of_method(&self, one: &Measurement) -> Option<Pos2> {
        Some(self.at(one.timing.median, one.error?))
    }
}

impl App {
    /// The trade of this view, which the mouse and the focus choose from.
    pub fn chart(&mut self, ui: &mut Ui) {
        self.desk.preview = None;
        if !self.shows_times {
            return;
        }
        ui.allocate_ui(vec2(ui.available_width(), SENTENCE), |ui| {
            ui.set_min_height(SENTENCE);
            self.sentence(ui);
        });
        let size = vec2(ui.available_width(), CHART);
        let (area, response) = ui.allocate_exact_size(size, Sense::drag());
        let measured = self.facts.trade.value.clone().unwrap_or_default();
        let place = Rect::from_min_max(area.min + vec2(38.0, 16.0), area.max - vec2(8.0, 18.0));
        let axes = Axes::of(&measured, place);
        self.paint_axes(ui, &axes, !measured.is_empty());
        let place_of = |method: &Method| {
            let known = measured.iter().find(|it| it.method == *method);
            known.and_then(|it| axes.of_method(it))
        };
        let (front, _) = ladder(&measured);
        let front: Vec<_> = front
            .iter()
            .filter_map(|it| Some((place_of(it)?, *it)))
            .collect();
        for step in front.windows(2) {
            let [(from, _), (to, _)] = [step[0], step[1]];
            let line = vec![from, pos2(to.x, from.y), to];
            ui.painter().line(line, (1.5, Color32::from_gray(120)));
        }
        if response.contains_pointer() || response.dragged() {
            ui.ctx().set_cursor_icon(CursorIcon::PointingHand);
        }
        if response.dragged()
            && ui.input(|input| input.pointer.is_decidedly_dragging())
            && let Some(at) = response.interact_pointer_pos()
            && let Some(method) = along(&front, at)
        {
            self.choose_method(method);
        }
        let dots: Vec<_> = measured
            .iter()
            .filter_map(|it| Some((it, axes.of_method(it)?)))
            .collect();
        for (index, (one, at)) in dots.iter().enumerate() {
            // The areas of close dots do not overlap.
            let others = dots.iter().enumerate().filter(|(other, _)| *other != index);
            let ways = others.map(|(_, (_, other))| (*other - *at).abs().max_elem() / 2.0);
            let reach = ways.fold(REACH, f32::min).max(1.0);
            let place = Rect::from_center_size(*at, Vec2::splat(2.0 * reach));
            self.dot(ui, one, place, &axes);
        }
        // The ring has an estimated place until the method on screen is measured.
        let known = self.method().and_then(|it| place_of(&it));
        let estimate = || estimate(&front, self.method()?);
        if let Some(at) = known.or_else(estimate) {
            let is_known = known.is_some() && self.facts.trade.current().is_some();
            let line = (if is_known { 2.0 } else { 1.0 }, Color32::WHITE);
            ui.painter().circle_stroke(at, RING, line);
        }
    }

    /// Compares the method on screen with its alternatives, and names the key that shows one.
    fn sentence(&self, ui: &mut Ui) {
        let (trade, method) = (&self.facts.trade, self.method());
        let known = trade.value.as_deref().unwrap_or_default();
        let text = match (&trade.state, method) {
            (State::Failed(reason), _) => {
                ui.colored_label(BAD, reason);
                return;
            }
            (_, None) => "The cuboids are shaded in different modes.".to_owned(),
            (_, Some(method)) => {
                let name = capital(&method_name(method));
                let other = match method.mode {
                    ShadingMode::Gouraud => ShadingMode::Phong,
                    _ => ShadingMode::Gouraud,
                };
                let key = caption(Command::Shading(other));
                sentence(known, method).map_or_else(
                    || format!("{name}: measured once nothing moves."),
                    |said| format!("{said} {key} shows {}.", capital(other.name())),
                )
            }
        };
        let ink = if trade.current().is_some() {
            INK
        } else {
            STALE
        };
        ui.colored_label(ink, text);
    }

    fn paint_axes(&self, ui: &Ui, axes: &Axes, has_times: bool) {
        let (painter, place, faint) = (ui.painter(), axes.place, Color32::from_gray(58));
        let word = |at, align, text: &str| {
            let letters = FontId::proportional(10.0);
            painter.text(at, align, text, letters, Color32::from_gray(150));
        };
        let [least, most] = axes.times;
        painter.rect_filled(place, 0.0, GROUND);
        let seen = axes.at(least, 2.0 * UNSEEN).y;
        let band = Rect::from_min_max(place.min, pos2(place.max.x, seen));
        painter.rect_filled(band, 0.0, Color32::from_rgb(52, 34, 34));
        for error in [FLOOR, 0.01, 0.1, 1.0, 10.0, 100.0] {
            let y = axes.at(least, error).y;
            painter.hline(place.x_range(), y, (1.0, faint));
            let below = if error == FLOOR { "\u{2264}" } else { "" };
            let at = pos2(place.min.x - 3.0, y);
            word(at, Align2::RIGHT_CENTER, &format!("{below}{error}"));
        }
        for time in ticks(&(least..most)).into_iter().filter(|_| has_times) {
            let x = axes.at(time, FLOOR).x;
            painter.vline(x, place.y_range(), (1.0, faint));
            let at = pos2(x, place.max.y + 2.0);
            word(at, Align2::CENTER_TOP, &time.to_string());
        }
        let head = match &self.facts.trade.state {
            State::Running(share) => &format!("measuring, {:.0} %", share * 100.0),
            State::Idle => "measured in another view or size; soon in this one",
            State::Done | State::Failed(_) => "largest error of 255; ms a frame",
        };
        let above = place.left_top() - vec2(0.0, 2.0);
        word(above, Align2::LEFT_BOTTOM, head);
        let inside = place.right_top() + vec2(-3.0, 2.0);
        word(inside, Align2::RIGHT_TOP, "visible");
    }

    /// The dot of a method. Hovering it shows the method's picture, a click chooses the method.
    fn dot(&mut self, ui: &Ui, one: &Measurement, place: Rect, axes: &Axes) {
        let (method, error) = (one.method, one.error.unwrap_or_default());
        let name = method_name(method);
        let (at, id) = (place.center(), ui.id().with(&name));
        let response = ui.interact(place, id, Sense::click());
        response.widget_info(|| {
            WidgetInfo::labeled(WidgetType::Button, true, format!("choose {name}"))
        });
        let is_current = self.facts.trade.current().is_some();
        let mut ink = if is_current {
            mode_ink(method.mode)
        } else {
            STALE
        };
        if !one.on_front {
            ink = ink.gamma_multiply(0.6);
        }
        let painter = ui.painter();
        let [from, to] = one.timing.interval.map(|time| axes.at(time, error).x);
        painter.hline(from..=to, at.y, (1.5, ink));
        if is_current {
            painter.circle_filled(at, DOT, ink);
        } else {
            painter.circle(at, DOT, GROUND, (1.5, ink));
        }
        if response.hovered() || response.has_focus() {
            painter.circle_stroke(at, DOT + 2.0, (1.0, Color32::WHITE));
            let is_dragged = ui.input(|input| input.pointer.any_down());
            self.desk.preview = Some(method).filter(|_| !is_dragged);
        }
        let text = format!(
            "{}: {} ms, off by {} of 255",
            capital(&name),
            short(one.timing.median),
            short(error)
        );
        if response.on_hover_text(text).clicked() {
            self.choose_method(method);
        }
    }

    /// Shades every cuboid by a method. The assignment's shortcut, which no scene asks for, is shown beside the picture.
    pub fn choose_method(&mut self, method: Method) {
        let (mode, tolerance) = (method.mode, method.tolerance);
        if mode == ShadingMode::UnitVectors {
            return self.wipe([Side::Method { mode, tolerance }, Side::Picture]);
        }
        self.shade(mode);
        self.set_tolerance(tolerance);
    }

    /// The meaning of the colours of the error map or of tiles.
    pub fn legend(&mut self, ui: &mut Ui, show: &Show) {
        match show.mode {
            ViewMode::Error | ViewMode::Difference => {
                let comparison = self.facts.comparison.current();
                let words = comparison.map_or_else(
                    || "difference".to_owned(),
                    |it| format!("difference x{}", it.amplification),
                );
                let mut is_difference = show.mode == ViewMode::Difference;
                let switch = ui.checkbox(&mut is_difference, words);
                let says = "Grey is no difference to exact Phong (F5 once more).";
                if switch.on_hover_text(says).clicked() {
                    self.run(Command::View(ViewMode::Error));
                }
                if !is_difference {
                    self.error_legend(ui);
                }
            }
            ViewMode::Tiles => {
                let counts = self.pictures.counts().tiles;
                for ((kind, tint), count) in TileKind::ALL.iter().zip(TINTS).zip(counts) {
                    swatch(ui, tint, &format!("{count}  {}", kind.name()));
                }
            }
            ViewMode::Picture | ViewMode::Wipe => {}
        }
    }

    /// The scale of the error map, with marks at the tolerance and at the largest error.
    fn error_legend(&self, ui: &mut Ui) {
        let comparison = self.facts.comparison.current();
        let scale = comparison.map_or(Scale::WIDEST, |it| it.scale);
        let size = vec2(ui.available_width().min(260.0), 26.0);
        let (place, response) = ui.allocate_exact_size(size, Sense::hover());
        response.on_hover_text(
            "Error against exact Phong, in levels of 255. White marks: the tolerance and the \
             largest error.",
        );
        let painter = ui.painter_at(place);
        scale.draw(&painter, place, Color32::GRAY);
        let largest = comparison.and_then(|it| it.error);
        let marks = [Some(self.look::<Tolerance>().0), largest];
        for mark in marks.into_iter().flatten() {
            // The scale leaves room for its last label.
            let share = scale.position(mark) as f32;
            let x = place.min.x + share * (place.width() - place.height());
            painter.vline(x, place.min.y..=place.center().y, (1.5, Color32::WHITE));
        }
        swatch(ui, EDGE, "another face is seen");
        swatch(ui, NOTHING, "nothing is drawn");
        let proof = self.facts.proof.current();
        if proof.is_some_and(|proof| proof.undecided > 0) {
            swatch(ui, UNDECIDED, "undecided");
        }
        if proof.is_some_and(|proof| proof.refuted > 0) {
            swatch(ui, REFUTED, "refuted");
        }
    }
}

/// The method next to a place, between two of Phong too.
fn along(front: &[(Pos2, Method)], at: Pos2) -> Option<Method> {
    let ends = front.windows(2).map(|pair| (pair[0], pair[1]));
    let alone = front.first().map(|it| (*it, *it));
    let steps = ends.chain(alone).map(|((from, one), (to, other))| {
        let way = to - from;
        let share = ((at - from).dot(way) / way.length_sq().max(1.0)).clamp(0.0, 1.0);
        let missed = (from + share * way).distance(at);
        (missed, between(one, other, share.into()))
    });
    let nearest = steps.min_by(|one, other| one.0.total_cmp(&other.0));
    nearest.map(|(_, method)| method)
}

/// The method this share of the way from one to another.
fn between(one: Method, other: Method, share: f64) -> Method {
    if one.mode != other.mode {
        return if share < 0.5 { one } else { other };
    }
    let [from, to] = [one, other].map(|it| it.tolerance.max(ALMOST_EXACT).ln());
    let tolerance = (from + share * (to - from)).exp();
    let tolerance = two_digits(tolerance);
    let is_exact = tolerance <= ALMOST_EXACT;
    Method::of(one.mode, if is_exact { 0.0 } else { tolerance })
}

/// The place of a tolerance of Phong on the staircase.
fn estimate(front: &[(Pos2, Method)], method: Method) -> Option<Pos2> {
    let log = |method: Method| method.tolerance.max(ALMOST_EXACT).ln();
    front.windows(2).find_map(|pair| {
        let [(from, one), (to, other)] = [pair[0], pair[1]];
        let share = (log(method) - log(one)) / (log(other) - log(one));
        let is_phong = [one, other].iter().all(|it| it.mode == method.mode);
        let is_between = is_phong && (0.0..=1.0).contains(&share);
        is_between.then(|| from.lerp(to, share as f32))
    })
}

/// A plot that the mouse does not move.
pub fn still(plot: Plot<'_>) -> Plot<'_> {
    let plot = plot.allow_drag(false).allow_zoom(false);
    plot.allow_scroll(false).allow_boxed_zoom(false)
}

fn swatch(ui: &mut Ui, pixel: u32, text: &str) {
    ui.horizontal(|ui| {
        let (place, _) = ui.allocate_exact_size(vec2(14.0, 14.0), Sense::hover());
        ui.painter()
            .rect_filled(place.shrink(1.0), 2.0, color(pixel));
        ui.label(text);
    });
}
