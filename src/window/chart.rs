//! The tab of time and error: what is held, and the chart of error against time. A click on a dot chooses its method.
//!
//! ```text
//! error |  o-+                dot: a method; bar: the interval of its time
//! of    |    +--(o)           ring: the method on screen
//! 255   |        +---o        line: the methods that no other one beats
//!       +------------- ms     both axes are logarithmic
//! ```

use std::ops::RangeInclusive;

use egui::{Color32, Label, Pos2, Rect, RichText, Sense, Ui, Vec2, WidgetInfo, WidgetType, vec2};
use egui_plot::{Axis, GridInput, GridMark, Line, Plot, PlotPoint, PlotUi, Points, Span, VLine};
use hecs::World;

use super::app::App;
use super::controls::{choose_method, set_budget, set_tolerance, shown_method};
use super::help::about;
use super::keys::Action;
use super::study::Study;
use super::widgets::{GOURAUD, INK, PHONG, mode_ink, number, offer, rounded, short};
use crate::components::numbers::range_of;
use crate::components::{Viewer, viewer};
use crate::output::chart::ticks;
use crate::output::words::capital;
use crate::questions::trade::plot::{FLOOR, place_of, vertices};
use crate::questions::trade::verdict::{UNSEEN, is_sure, method_name, sentence};
use crate::questions::trade::{Measurement, budget, front, is_timed};
use crate::shading::Method;

/// The heights of the sentence and of the chart, in points. They are fixed, so that the rows below do not move.
const SENTENCE: f32 = 66.0;
const CHART: f32 = 190.0;
/// The height of the words about a budget: room for two lines.
const OUTCOME: f32 = 34.0;
/// The room beside the chart, in points, into which half of the last time's label reaches.
pub const BESIDE: f32 = 12.0;
const CAPTION: &str = "A dot is a method, a bar the range of its times. The grey line joins the best trades, \
                       the orange one Gouraud with ever more vertices. A ring marks the method on screen, and a white \
                       line the budget. A click on a dot chooses its method. Below half \
                       a level no displayed value changes by more than one of 255, above one level, on the red ground, some do. A paler dot is beaten by another method; one at the right edge is not timed. Frames are drawn by all cores, or as many as --threads says; `trade` \
                       uses one.";
/// The largest error of the axis, in levels.
const MOST: f64 = 500.0;
/// The radii of a dot and of the ring, in points.
const DOT: f32 = 4.0;
const RING: f32 = 8.5;
/// A time in ms and an error in levels on the axes, which are logarithmic. A clock that does not tell times apart gives 0.
fn logarithms((time, error): (f64, f64)) -> [f64; 2] {
    [time.max(1e-6).log10(), error.log10()]
}

/// The time at which methods that are not timed are shown: right of all others.
fn side(known: &[Measurement]) -> f64 {
    2.0 * known.iter().map(|it| it.timing.median).fold(0.0, f64::max)
}

/// The place of a method's dot.
fn place(one: &Measurement, side: f64) -> [f64; 2] {
    logarithms(place_of(one, side))
}

/// Lays out the chart, and either the tolerance or the budget.
pub fn tab(ui: &mut Ui, app: &mut App) {
    let (world, study) = (&mut app.document.scene.world, &app.study);
    if app.desk.shows_times {
        chart(ui, study, world);
    }
    let Viewer {
        budget, tolerance, ..
    } = *viewer(world);
    ui.horizontal_wrapped(|ui| {
        let error = ui.selectable_label(budget.is_none(), "hold the error");
        let says = "Every picture is drawn within the tolerance, however long it takes.";
        if error.on_hover_text(says).clicked() {
            set_budget(world, None);
        }
        offer(ui, &mut app.desk, Action::HoldTime, budget.is_some());
    });
    let Some(budget) = budget else {
        let changed = held(ui, "tolerance", "levels", tolerance, 0.0..=255.0);
        if changed != tolerance {
            let is_exact = changed < Viewer::LEAST_TOLERANCE;
            set_tolerance(world, if is_exact { 0.0 } else { changed });
        }
        return;
    };
    let changed = held(ui, "budget", "ms", budget, range_of("budget"));
    if changed != budget {
        set_budget(world, Some(changed));
    }
    ui.scope(|ui| {
        ui.set_min_height(OUTCOME);
        let known = study.facts.trade.current();
        let held = known.and_then(|it| budget::held(&it.methods, budget));
        let unmeasured = || match study.facts.held {
            Some(method) => format!("{}, not measured here yet", capital(&method_name(method))),
            None => "The methods are not measured yet.".to_owned(),
        };
        ui.label(held.map_or_else(unmeasured, |it| it.1));
    });
}

/// Lays out the number that is held. Returns what the user makes of it.
fn held(ui: &mut Ui, name: &str, unit: &str, value: f64, range: RangeInclusive<f64>) -> f64 {
    let mut changed = value;
    ui.horizontal(|ui| {
        ui.label(name).on_hover_text(about(name));
        number(ui, &mut changed, range);
        ui.label(unit);
        ui.weak("[ ]");
    });
    changed
}

/// Shows the measured methods of this view. A click or Enter on a dot chooses one.
pub fn chart(ui: &mut Ui, study: &Study, world: &mut World) {
    let trade = &study.facts.trade;
    let method = shown_method(world, &study.facts);
    ui.allocate_ui(vec2(ui.available_width(), SENTENCE), |ui| {
        ui.set_min_height(SENTENCE);
        sentence_about(ui, trade.current().map_or(&[], |it| &it.methods), method);
    });
    let caption = match (trade.is_current, study.progress()) {
        (false, Some((step, _))) => step,
        (false, None) => "times follow".to_owned(),
        _ => "up: error, levels; right: ms".to_owned(),
    };
    ui.horizontal(|ui| {
        ui.colored_label(GOURAUD, RichText::new("Gouraud").small());
        ui.colored_label(PHONG, RichText::new("Phong").small());
        let label = Label::new(RichText::new(caption).small()).truncate();
        ui.add(label).on_hover_text(CAPTION);
    });
    let measured = trade.current().map_or(&[][..], |it| &it.methods).iter();
    let known: Vec<_> = measured.filter(|it| it.error.is_some()).cloned().collect();
    let mut axes = plot_of_errors("trade", CHART)
        .width(ui.available_width() - BESIDE)
        .x_grid_spacer(|input| marks(&input))
        .x_axis_formatter(words)
        .include_y(FLOOR.log10())
        .include_y(MOST.log10());
    if known.is_empty() {
        axes = axes.include_x(-1.0).include_x(1.0);
    }
    let budget = viewer(world).budget;
    let shown = ui.scope(|ui| {
        // The keyboard's focus goes to the dots, not to the axes.
        ui.visuals_mut().disabled_alpha = 1.0;
        ui.disable();
        axes.show(ui, |plot| {
            draw(plot, &known);
            if let Some(budget) = budget {
                let [time, _] = logarithms((budget, 1.0));
                plot.vline(VLine::new("budget", time).color(Color32::WHITE));
            }
        })
    });
    let shown = shown.inner;
    for one in &known {
        let place = PlotPoint::from(place(one, side(&known)));
        let at = shown.transform.position_from_point(&place);
        if dot(ui, one, at) {
            choose_method(world, one.method);
        }
        if Some(one.method) == method {
            let line = (2.0, Color32::WHITE);
            ui.painter().circle_stroke(at, RING, line);
        }
    }
}

/// Compares the method on screen with its alternatives.
fn sentence_about(ui: &mut Ui, known: &[Measurement], shown: Option<Method>) {
    let of_method = |method: Method| {
        let name = capital(&method_name(method));
        let Some(text) = sentence(known, method) else {
            return format!("{name} is not measured yet.");
        };
        let own = known
            .iter()
            .find(|it| it.method == method && is_timed(method));
        match own.filter(|_| !is_sure(known, method)) {
            Some(own) => format!("{text} So far {} ms a frame.", short(own.timing.median)),
            None => text,
        }
    };
    let mixed = || "The cuboids are shaded in different modes.".to_owned();
    let text = shown.map_or_else(mixed, of_method);
    ui.colored_label(INK, text);
}

/// The dot of a method, as a button. Returns whether it was clicked.
fn dot(ui: &Ui, one: &Measurement, at: Pos2) -> bool {
    let name = method_name(one.method);
    let place = Rect::from_center_size(at, Vec2::splat(2.0 * DOT));
    let response = ui.interact(place, ui.id().with(&name), Sense::click());
    response
        .widget_info(|| WidgetInfo::labeled(WidgetType::Button, true, format!("choose {name}")));
    if response.hovered() || response.has_focus() {
        let line = (1.0, Color32::WHITE);
        ui.painter().circle_stroke(at, DOT + 2.0, line);
    }
    let error = short(one.largest_error());
    let time = if is_timed(one.method) {
        format!("{} ms", short(one.timing.median))
    } else {
        "not timed".to_owned()
    };
    let text = format!("{}: {time}, off by {error} of 255", capital(&name));
    response.on_hover_text(text).clicked()
}

/// A plot with a logarithmic axis of errors upwards.
pub fn plot_of_errors(name: &str, height: f32) -> Plot<'_> {
    Plot::new(name)
        .height(height)
        .sense(Sense::hover())
        .y_grid_spacer(|input| marks(&input))
        .y_axis_formatter(words)
        .grid_color(Color32::from_gray(58))
        .show_crosshair(false)
        .y_axis_min_width(34.0)
}

/// A line at each of a few round numbers of a logarithmic axis.
fn marks(input: &GridInput) -> Vec<GridMark> {
    let (least, most) = input.bounds;
    let ticks = ticks(&(10_f64.powf(least)..10_f64.powf(most)));
    ticks.into_iter().map(f64::log10).map(grid_mark).collect()
}

/// The number at a mark of a logarithmic axis.
fn words(mark: GridMark, _: &RangeInclusive<f64>) -> String {
    rounded(10_f64.powf(mark.value), 1).to_string()
}

/// A line of the grid, as strong as all others.
pub fn grid_mark(value: f64) -> GridMark {
    GridMark {
        value,
        step_size: 10.0,
    }
}

/// Draws the band of errors above one level, the staircase of best trades, and the dots and whiskers of the methods.
fn draw(plot: &mut PlotUi, known: &[Measurement]) {
    let [_, least] = logarithms((1.0, 2.0 * UNSEEN));
    let band = Span::new("", least..=MOST.log10());
    let ground = Color32::from_rgb(52, 34, 34);
    plot.span(band.axis(Axis::Y).fill(ground).border_width(0.0));
    let line = |points: Vec<[f64; 2]>, ink: Color32| {
        let line = Line::new("", points).color(ink);
        line.width(1.5).allow_hover(false)
    };
    let place = |one| place(one, side(known));
    let front: Vec<[f64; 2]> = front(known).into_iter().map(place).collect();
    let step = |pair: &[[f64; 2]]| [pair[0], [pair[0][0], pair[1][1]], pair[1]];
    let staircase = front.windows(2).flat_map(step).collect();
    plot.line(line(staircase, Color32::from_gray(120)));
    let curve = vertices(known).into_iter().map(place).collect();
    plot.line(line(curve, GOURAUD.gamma_multiply(0.5)));
    for one in known {
        let strength = if one.on_front { 1.0 } else { 0.6 };
        let ink = mode_ink(one.method.mode).gamma_multiply(strength);
        let [_, y] = place(one);
        if is_timed(one.method) {
            let ends = one.timing.interval.map(|time| logarithms((time, 1.0))[0]);
            plot.line(line(ends.map(|end| [end, y]).to_vec(), ink));
        }
        let dot = Points::new("", vec![place(one)]).radius(DOT).color(ink);
        plot.points(dot.allow_hover(false));
    }
}
