//! The tab of a number that is varied: the errors over its range. The line at the present value can be dragged, and a click on a
//! curve chooses its method.

use egui::{Color32, Response, Sense, Ui, WidgetInfo, WidgetType, vec2};
use egui_plot::{
    GridInput, GridMark, HLine, Line, LineStyle, Plot, PlotPoint, PlotTransform, VLine,
};

use super::scene::ANY;
use crate::components::{ShadingMode, Side, viewer};
use crate::output::chart::ticks;
use crate::output::words::capital;
use crate::questions::trade::verdict::method_name;
use crate::questions::vary::curve::Curve;
use crate::questions::vary::export::number as in_words;
use crate::questions::vary::refined::{PIXELS, Refined};
use crate::questions::vary::variable::Variable;
use crate::scene::SceneRecord;
use crate::shading::Method;
use crate::window::canvas::Canvas;
use crate::window::controls::choose_method;
use crate::window::desk::Desk;
use crate::window::document::Document;
use crate::window::study::Study;
use crate::window::tags::side_says;
use crate::window::varied::{Varied, common_keys};
use crate::window::widgets::{BAD, INK, mode_ink, number, rounded, still, wait};

const ABOUT: &str = "The largest error of the picture against exact Phong, in levels of 255, over the range of a number. Drag the \
                     line to change the number; a click on a curve chooses its method, or compares the unit vectors in a wipe. The button beside a number of the scene shows that one.";
const LATTICE: &str = "Each value is drawn as large as the picture. An interval encloses the exact level of each compared pixel. \
                       Where the cuboids take more pixels, every second one is compared in each direction, or every third, and so on: an error \
                       between them is not found. `vary` on the command line compares all.";
/// The ends of the axis of errors, in levels. A smaller error is drawn at the first.
const ERRORS: [f64; 2] = [1e-4, 500.0];
const HEIGHT: f32 = 230.0;
/// The room beside the plot, in points, into which half of the last label reaches.
const BESIDE: f32 = 12.0;
/// How far beside a curve a click still chooses its method, in points.
const REACH: f32 = 8.0;

/// A curve with its method; `None` is the textbook's formula.
type MethodCurve = (Option<Method>, Curve);

/// A change that the tab makes.
enum Change {
    Value(f64),
    Ends([f64; 2]),
    Method(Method),
}

/// Lays out the tab. It writes the number, and the method of the cuboids.
pub fn tab(ui: &mut Ui, document: &mut Document, canvas: &Canvas, study: &Study, desk: &mut Desk) {
    ui.horizontal_wrapped(|ui| {
        for (name, key) in common_keys(&document.scene.world) {
            if ui.small_button(name).clicked() {
                desk.vary(key, &document.state);
            }
        }
    });
    ui.separator();
    if desk.varied.is_none()
        && let Some((_, key)) = common_keys(&document.scene.world).into_iter().next()
    {
        desk.vary(key, &document.state);
    }
    let Some(varied) = &mut desk.varied else {
        return;
    };
    varied.look(&document.state, canvas.size());
    let done = match change(ui, varied, study) {
        Some(Change::Value(value)) => {
            // With the changes of this layout.
            let scene = SceneRecord::of(&document.scene.world);
            let record = varied.variable.scene(&scene, value);
            record.map(|record| document.restore(&record))
        }
        Some(Change::Ends(ends)) => {
            let variable = Variable::new(varied.variable.key.clone(), ends, &document.state);
            variable.map(|variable| desk.varied = Some(Varied::of(variable)))
        }
        Some(Change::Method(method)) => {
            let world = &mut document.scene.world;
            // A curve of a tolerance that varies has no tolerance of its own.
            let tolerance = viewer(world).tolerance;
            choose_method(
                world,
                match method.mode {
                    mode @ (ShadingMode::Gouraud | ShadingMode::Phong) => {
                        Method::of(mode, tolerance)
                    }
                    _ => method,
                },
            );
            Ok(())
        }
        None => Ok(()),
    };
    // A drag passes numbers that are not legal.
    if let Err(error) = done
        && ui.ctx().dragged_id().is_none()
    {
        desk.say(format!("{error:#}"));
    }
}

/// Lays out the number, the curves, and the ranges in which methods keep the limit.
fn change(ui: &mut Ui, varied: &Varied, study: &Study) -> Option<Change> {
    let variable = &varied.variable;
    let key = ui.strong(variable.key.to_string());
    key.on_hover_text(variable.key.comment().unwrap_or_default());
    let (value, wanted) = match &varied.wanted {
        Ok((value, wanted)) => (*value, wanted),
        Err(reason) => {
            ui.colored_label(BAD, reason);
            return None;
        }
    };
    let known = study.facts.curves.value.as_ref();
    let known = known.filter(|it| it.is_same(wanted));
    let curves = known.map(Refined::curves).unwrap_or_default();
    let [width, height] = wanted.size;
    let pictures =
        format!("error in pictures of {width}x{height}, at a lattice of up to {PIXELS} pixels");
    ui.small(pictures).on_hover_text(LATTICE);
    if known.is_some_and(Refined::is_still) {
        ui.colored_label(BAD, "This number does not change the picture.");
    }
    let mut change = plot(ui, variable, wanted.limit, &curves, value);
    let mut numbers = [variable.from, value, variable.to];
    ui.columns(3, |columns| {
        let names = ["from", "now", "to"];
        for ((ui, number_of), name) in columns.iter_mut().zip(&mut numbers).zip(names) {
            ui.horizontal(|ui| {
                ui.weak(name);
                number(ui, number_of, ANY);
            });
        }
    });
    let [from, now, to] = numbers;
    if [from, to] != [variable.from, variable.to] {
        change = Some(Change::Ends([from, to]));
    } else if now != value {
        change = Some(Change::Value(now));
    }
    wait(ui, study, known.is_some_and(|it| it.is_all));
    for (method, curve) in &curves {
        ui.horizontal_wrapped(|ui| {
            let name = method.map_or_else(|| "textbook in f32".to_owned(), method_name);
            let name = ui.colored_label(ink(*method), capital(&name));
            name.on_hover_text(says(*method));
            let kept = curve.kept();
            ui.weak(format!("within {} of exact Phong: {kept}", wanted.limit));
        });
    }
    if let Some(places) = curves.iter().find_map(|it| it.1.emptiness()) {
        ui.weak(format!("No compared pixel shows a cuboid {places}."));
    }
    ui.separator();
    ui.weak(ABOUT);
    change
}

/// The sentence about a curve.
fn says(method: Option<Method>) -> &'static str {
    let textbook = "The formula of Phong as one writes it down, in f32 throughout.";
    method.map_or(textbook, |method| side_says(&Side::from(method)))
}

fn ink(method: Option<Method>) -> Color32 {
    method.map_or(INK, |method| mode_ink(method.mode))
}

/// A point of a curve in the plot: the place in the range, and the logarithm of the error.
fn places(variable: &Variable, curve: &Curve) -> Vec<[f64; 2]> {
    let [least, most] = ERRORS;
    let place = |value: f64, error: f64| [variable.share(value), error.clamp(least, most).log10()];
    let points = curve.points.iter();
    points
        .filter_map(|it| Some(place(it.value, it.error()?)))
        .collect()
}

/// Lays out the curves, with lines at the limit and at the present value. Returns what a drag or a click chooses.
fn plot(
    ui: &mut Ui,
    variable: &Variable,
    limit: f64,
    curves: &[MethodCurve],
    value: f64,
) -> Option<Change> {
    let [least, most] = ERRORS.map(f64::log10);
    let marks = variable.marks();
    let of_values = move |_: GridInput| {
        let marks = marks.iter().map(|mark| variable.share(*mark));
        marks.map(grid_mark).collect()
    };
    let of_errors = |_: GridInput| {
        ticks(&(ERRORS[0]..ERRORS[1]))
            .into_iter()
            .map(f64::log10)
            .map(grid_mark)
            .collect()
    };
    let plot = still(Plot::new("varied"))
        .width(ui.available_width() - BESIDE)
        .height(HEIGHT)
        .sense(Sense::hover());
    let plot = plot.x_grid_spacer(of_values).y_grid_spacer(of_errors);
    let plot = plot.x_axis_formatter(|mark, _| in_words(variable.at(mark.value)));
    let plot = plot.y_axis_formatter(|mark, _| rounded(10_f64.powf(mark.value), 1).to_string());
    let plot = plot
        .default_x_bounds(0.0, 1.0)
        .default_y_bounds(least, most);
    let plot = plot
        .grid_color(Color32::from_gray(58))
        .show_x(false)
        .show_y(false);
    let shown = ui.scope(|ui| {
        // The keyboard's focus goes to the numbers below, not to the axes.
        ui.visuals_mut().disabled_alpha = 1.0;
        ui.disable();
        plot.y_axis_min_width(34.0).show(ui, |plot| {
            let kept = HLine::new("", limit.log10()).color(Color32::GRAY);
            plot.hline(kept.style(LineStyle::dashed_dense()));
            for (method, curve) in curves {
                let line = Line::new("", places(variable, curve)).color(ink(*method));
                plot.line(line.width(1.5).allow_hover(false));
            }
            let now = VLine::new("", variable.share(value)).color(Color32::WHITE);
            plot.vline(now.width(2.0));
        })
    });
    let (area, transform) = (shown.inner.response.rect, shown.inner.transform);
    let mouse = ui.interact(area, ui.id().with("varied"), Sense::CLICK | Sense::DRAG);
    mouse.widget_info(|| {
        WidgetInfo::labeled(
            WidgetType::Other,
            true,
            format!("errors over {}", variable.key),
        )
    });
    pick(&mouse, &transform, variable, curves)
}

fn grid_mark(value: f64) -> GridMark {
    // Equal step sizes give all grid lines the same strength.
    GridMark {
        value,
        step_size: 10.0,
    }
}

/// The curve that is clicked, else the value at the mouse.
fn pick(
    mouse: &Response,
    transform: &PlotTransform,
    variable: &Variable,
    curves: &[MethodCurve],
) -> Option<Change> {
    let at = mouse
        .interact_pointer_pos()
        .filter(|_| mouse.dragged() || mouse.clicked())?;
    let distance = |points: &[[f64; 2]]| {
        let [from, to] = [points.first()?, points.last()?]
            .map(|it| transform.position_from_point(&PlotPoint::from(*it)));
        let along = vec2(to.x - from.x, to.y - from.y);
        let share = ((at - from).dot(along) / along.length_sq()).clamp(0.0, 1.0);
        Some((from + along * share).distance(at))
    };
    let nearest = curves.iter().filter_map(|(method, curve)| {
        let points = places(variable, curve);
        let distances = points.windows(2).filter_map(distance);
        Some(((*method)?, distances.reduce(f32::min)?))
    });
    let nearest = nearest.min_by(|one, other| one.1.total_cmp(&other.1));
    if let Some((method, _)) = nearest.filter(|it| mouse.clicked() && it.1 <= REACH) {
        return Some(Change::Method(method));
    }
    let share = transform.value_from_position(at).x.clamp(0.0, 1.0);
    let value = rounded(variable.at(share), 2);
    Some(Change::Value(value.clamp(variable.from, variable.to)))
}
