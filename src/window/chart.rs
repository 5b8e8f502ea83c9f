//! The chart of error against time. A click or a drag in it chooses the method.
//!
//! ```text
//! error |  o-+                dot: a method; bar: the interval of its time
//! of    |    +--(o)           ring: the method on screen
//! 255   |        +---o        line: the methods that no other one beats
//!       +------------- ms     both axes are logarithmic
//! ```

use egui::{Align2, Color32, FontId, Pos2, Rect, Sense, Ui, Vec2, WidgetInfo, WidgetType, vec2};
use egui_plot::{Axis, GridMark, Line, Plot, PlotPoint, PlotUi, Points, Span};

use super::app::App;
use super::keys::{Command, caption};
use super::style::{STALE, mode_ink};
use super::widgets::{ink, short, still, two_digits};
use crate::components::{ShadingMode, Side};
use crate::report::chart::ticks;
use crate::report::words::capital;
use crate::shading::Method;
use crate::trade::Measurement;
use crate::trade::plot::FLOOR;
use crate::trade::verdict::{UNSEEN, method_name, sentence};

/// The heights of the sentence and of the chart, in points. They are fixed, so that the rows below do not move.
const SENTENCE: f32 = 66.0;
const CHART: f32 = 190.0;
/// The largest error of the axis, in levels.
const MOST: f64 = 500.0;
/// The radii of a dot and of the ring, and how far beside a dot a click still counts, in points.
const DOT: f32 = 4.0;
const RING: f32 = 8.5;
const REACH: f32 = 8.0;
/// Stands for tolerance 0 where tolerances are interpolated by logarithm, in levels.
const ALMOST_EXACT: f64 = 0.02;

/// The place of a time in ms and of an error in levels on the axes, which are logarithmic. A clock that does not tell times
/// apart gives 0.
fn logarithms(time: f64, error: f64) -> [f64; 2] {
    [time.max(1e-6).log10(), error.max(FLOOR).log10()]
}

impl App {
    /// Shows the measured methods of this view. A click or Enter on a dot chooses one, and a drag along the line of best
    /// trades a tolerance between two.
    pub fn chart(&mut self, ui: &mut Ui) {
        if !self.shows_times {
            return;
        }
        ui.allocate_ui(vec2(ui.available_width(), SENTENCE), |ui| {
            ui.set_min_height(SENTENCE);
            self.sentence(ui);
        });
        ui.small(match (self.facts.trade.is_current, self.progress()) {
            (false, Some((step, share))) => format!("{step}, {:.0} %", share * 100.0),
            (false, None) => "measured in another view; new times follow".to_owned(),
            _ => "largest error in levels; ms a frame".to_owned(),
        });
        let measured = self.facts.trade.value.iter().flatten().cloned();
        let known: Vec<_> = measured
            .filter_map(|it| Some((logarithms(it.timing.median, it.error?), it)))
            .collect();
        let is_current = self.facts.trade.current().is_some();
        let front = known.iter().filter(|(_, it)| it.on_front);
        let mut front: Vec<_> = front.map(|(place, it)| (*place, it.method)).collect();
        front.sort_by(|one, other| one.0[0].total_cmp(&other.0[0]));
        let shown = axes().show(ui, |plot| draw(plot, &known, &front, is_current));
        let at = |place: [f64; 2]| {
            let place = PlotPoint::from(place);
            shown.transform.position_from_point(&place)
        };
        let front = front.into_iter().map(|(place, method)| (at(place), method));
        let front: Vec<(Pos2, Method)> = front.collect();
        if shown.response.dragged()
            && ui.input(|input| input.pointer.is_decidedly_dragging())
            && let Some(to) = shown.response.interact_pointer_pos()
            && let Some(method) = nearest(&front, to)
        {
            self.choose_method(method);
        }
        let corner = shown.response.rect.right_top() + vec2(-3.0, 2.0);
        let letters = FontId::proportional(10.0);
        ui.painter()
            .text(corner, Align2::RIGHT_TOP, "visible", letters, Color32::GRAY);
        let dots: Vec<Pos2> = known.iter().map(|(place, _)| at(*place)).collect();
        for (index, (_, one)) in known.iter().enumerate() {
            // The areas of close dots do not overlap.
            let others = dots.iter().enumerate().filter(|(other, _)| *other != index);
            let ways = others.map(|(_, other)| (*other - dots[index]).abs().max_elem() / 2.0);
            let reach = ways.fold(REACH, f32::min).max(1.0);
            let place = Rect::from_center_size(dots[index], Vec2::splat(2.0 * reach));
            self.dot(ui, one, place);
        }
        // The ring has an estimated place until the method on screen is measured.
        let method = self.method();
        let own = known.iter().position(|(_, it)| Some(it.method) == method);
        let place = own.map(|index| dots[index]);
        if let Some(place) = place.or_else(|| estimate(&front, method?)) {
            let is_known = own.is_some() && is_current;
            let line = (if is_known { 2.0 } else { 1.0 }, Color32::WHITE);
            ui.painter().circle_stroke(place, RING, line);
        }
    }

    /// Compares the method on screen with its alternatives, and names the key of the other shading.
    fn sentence(&self, ui: &mut Ui) {
        let (trade, method) = (&self.facts.trade, self.method());
        let known = trade.value.as_deref().unwrap_or_default();
        let text = match method {
            None => "The cuboids are shaded in different modes.".to_owned(),
            Some(method) => {
                let name = capital(&method_name(method));
                let other = match method.mode {
                    ShadingMode::Gouraud => ShadingMode::Phong,
                    _ => ShadingMode::Gouraud,
                };
                let key = caption(Command::Shading(other));
                sentence(known, method).map_or_else(
                    || format!("{name} is measured as soon as nothing moves."),
                    |said| format!("{said} {key} shows {}.", capital(other.name())),
                )
            }
        };
        ui.colored_label(ink(trade), text);
    }

    /// The dot of a method. A click chooses the method.
    fn dot(&mut self, ui: &Ui, one: &Measurement, place: Rect) {
        let (method, name) = (one.method, method_name(one.method));
        let response = ui.interact(place, ui.id().with(&name), Sense::click());
        response.widget_info(|| {
            WidgetInfo::labeled(WidgetType::Button, true, format!("choose {name}"))
        });
        if response.hovered() || response.has_focus() {
            let line = (1.0, Color32::WHITE);
            ui.painter().circle_stroke(place.center(), DOT + 2.0, line);
        }
        let [time, error] = [one.timing.median, one.error.unwrap_or_default()].map(short);
        let text = format!("{}: {time} ms, off by {error} of 255", capital(&name));
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
}

/// The axes, with a line at each of a few round numbers.
fn axes() -> Plot<'static> {
    let mark = |value: f64| GridMark {
        value: value.log10(),
        // Equal step sizes give all grid lines the same strength.
        step_size: 10.0,
    };
    let words = |mark: GridMark| two_digits(10_f64.powf(mark.value)).to_string();
    let plot = Plot::new("trade").height(CHART).sense(Sense::drag());
    let plot = plot
        .show_crosshair(false)
        .grid_color(Color32::from_gray(58))
        .include_y(FLOOR.log10())
        .include_y(MOST.log10());
    let plot = plot.x_grid_spacer(move |input| {
        let (least, most) = input.bounds;
        let ticks = ticks(&(10_f64.powf(least)..10_f64.powf(most)));
        ticks.into_iter().map(mark).collect()
    });
    let plot = plot.y_grid_spacer(move |_| [FLOOR, 0.01, 0.1, 1.0, 10.0, 100.0].map(mark).to_vec());
    let plot = plot.x_axis_formatter(move |mark, _| words(mark));
    still(
        plot.y_axis_formatter(move |mark, _| words(mark))
            .y_axis_min_width(34.0),
    )
}

/// Draws the band of visible errors, the staircase of best trades, and the dots and whiskers of the methods.
fn draw(
    plot: &mut PlotUi,
    known: &[([f64; 2], Measurement)],
    front: &[([f64; 2], Method)],
    is_current: bool,
) {
    let [_, seen] = logarithms(1.0, 2.0 * UNSEEN);
    let visible = Span::new("", seen..=MOST.log10()).axis(Axis::Y);
    plot.span(
        visible
            .fill(Color32::from_rgb(52, 34, 34))
            .border_width(0.0),
    );
    let line = |points: Vec<[f64; 2]>, ink: Color32| {
        let line = Line::new("", points).color(ink);
        line.width(1.5).allow_hover(false)
    };
    let step = |pair: &[([f64; 2], Method)]| {
        let [from, to] = [pair[0].0, pair[1].0];
        [from, [from[0], to[1]], to]
    };
    let staircase = front.windows(2).flat_map(step).collect();
    plot.line(line(staircase, Color32::from_gray(120)));
    for (place, one) in known {
        let ink = if is_current {
            mode_ink(one.method.mode)
        } else {
            STALE
        };
        let ink = ink.gamma_multiply(if one.on_front { 1.0 } else { 0.6 });
        let [from, to] = one.timing.interval.map(|time| logarithms(time, 1.0)[0]);
        plot.line(line(vec![[from, place[1]], [to, place[1]]], ink));
        let dot = Points::new("", vec![*place]).radius(DOT).color(ink);
        plot.points(dot.filled(is_current).allow_hover(false));
    }
}

/// The method nearest to a place. Between two methods of one mode the tolerance is interpolated.
fn nearest(front: &[(Pos2, Method)], at: Pos2) -> Option<Method> {
    let steps = front.windows(2).map(|pair| {
        let [(from, one), (to, other)] = [pair[0], pair[1]];
        let way = to - from;
        let share = ((at - from).dot(way) / way.length_sq().max(1.0)).clamp(0.0, 1.0);
        let missed = (from + share * way).distance(at);
        (missed, between(one, other, share.into()))
    });
    let nearest = steps.min_by(|one, other| one.0.total_cmp(&other.0));
    nearest.map(|(_, method)| method)
}

/// Interpolates between two methods; `share` 0 is the first.
fn between(one: Method, other: Method, share: f64) -> Method {
    if one.mode != other.mode {
        return if share < 0.5 { one } else { other };
    }
    let [from, to] = [one, other].map(logarithm);
    let tolerance = two_digits((from + share * (to - from)).exp());
    let is_exact = tolerance <= ALMOST_EXACT;
    Method::of(one.mode, if is_exact { 0.0 } else { tolerance })
}

fn logarithm(method: Method) -> f64 {
    method.tolerance.max(ALMOST_EXACT).ln()
}

/// Estimates the place of a method between two measured ones of its mode.
fn estimate(front: &[(Pos2, Method)], method: Method) -> Option<Pos2> {
    front.windows(2).find_map(|pair| {
        let [(from, one), (to, other)] = [pair[0], pair[1]];
        let share = (logarithm(method) - logarithm(one)) / (logarithm(other) - logarithm(one));
        let is_same_mode = [one, other].iter().all(|it| it.mode == method.mode);
        let is_between = is_same_mode && (0.0..=1.0).contains(&share);
        is_between.then(|| from.lerp(to, share as f32))
    })
}
