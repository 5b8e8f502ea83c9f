//! A number that is varied, and its tab: the errors over its range. The line at the present value can be dragged.

use std::sync::Arc;

use egui::{Color32, Sense, Ui, WidgetInfo, WidgetType};
use egui_plot::{GridInput, HLine, Line, LineStyle, VLine};
use hecs::World;

use super::Tab;
use super::row::ANY;
use crate::components::{Mesh, names};
use crate::output::words::capital;
use crate::questions::job::camera_name;
use crate::questions::trade::verdict::method_name;
use crate::questions::vary::curve::Curve;
use crate::questions::vary::export::number as in_words;
use crate::questions::vary::refined::{PIXELS, Refined};
use crate::questions::vary::variable::{Variable, present};
use crate::scene::SceneRecord;
use crate::scene::key::Key;
use crate::shading::Method;
use crate::window::canvas::Canvas;
use crate::window::chart::{BESIDE, grid_mark, plot_of_errors};
use crate::window::desk::Desk;
use crate::window::document::Document;
use crate::window::study::Study;
use crate::window::widgets::{BAD, INK, mode_ink, number, rounded, still, wait};

const ABOUT: &str = "The largest error of the picture against exact Phong, in levels of 255, over the range of a number. Drag the \
                     line to change the number. The button beside a number of the scene shows that one.";
/// The ends of the axis of errors, in levels. A smaller error is drawn at the first.
const ERRORS: [f64; 2] = [1e-4, 500.0];
const HEIGHT: f32 = 230.0;

/// A number of the scene, and its range.
pub struct Varied {
    pub variable: Variable,
    /// The state that was looked at, and the size of the picture.
    seen: Option<(Arc<SceneRecord>, [usize; 2])>,
    /// The present value, and the curves without a point; or the reason why the scene has none.
    pub wanted: Result<(f64, Refined), String>,
}

impl Varied {
    pub fn of(variable: Variable) -> Self {
        Varied {
            variable,
            seen: None,
            wanted: Err(String::new()),
        }
    }

    /// Looks at the state of the scene, if it is another one.
    pub fn look(&mut self, state: &Arc<SceneRecord>, size: [usize; 2]) {
        let is_known = |(seen, seen_size): &(Arc<SceneRecord>, [usize; 2])| {
            Arc::ptr_eq(seen, state) && *seen_size == size
        };
        if self.seen.as_ref().is_some_and(is_known) {
            return;
        }
        self.seen = Some((Arc::clone(state), size));
        let value = present(&self.variable.key, state);
        let refined = || Refined::new(self.variable.clone(), state, size);
        let found = value.and_then(|value| Ok((value, refined()?)));
        match (&mut self.wanted, found) {
            // The scene of the curves stays the same record, which is compared by its address in each step.
            (Ok((before, known)), Ok((value, new))) if known.is_same(&new) => *before = value,
            (_, found) => self.wanted = found.map_err(|error| format!("{error:#}")),
        }
    }
}

impl Desk {
    /// Shows a number of a scene against the error.
    pub fn vary(&mut self, key: Key, record: &SceneRecord) {
        match Variable::around(key, record) {
            Ok(variable) => {
                self.varied = Some(Varied::of(variable));
                self.open(Tab::Vary);
            }
            Err(error) => self.say(format!("{error:#}")),
        }
    }
}

/// The numbers that are offered first, by their names.
fn common_keys(world: &World) -> Vec<(&'static str, Key)> {
    let camera = Key::from("camera").child(&camera_name(world));
    let mut keys = vec![("distance", camera.child("orbit").child("zoom"))];
    if let Some(name) = names::<Mesh>(world).first() {
        let cuboid = Key::from("cuboid").child(name);
        keys.push(("segments", cuboid.child("segments")));
        keys.push(("shininess", cuboid.child("material").child("shininess")));
    }
    keys.push(("tolerance", Key::from("view.tolerance")));
    keys
}

/// A curve with its method; `None` is the textbook's formula.
type MethodCurve = (Option<Method>, Curve);

/// A change that the tab makes.
enum Change {
    Value(f64),
    Ends([f64; 2]),
}

/// Lays out the tab. It writes the number.
pub fn tab(ui: &mut Ui, document: &mut Document, canvas: &Canvas, study: &Study, desk: &mut Desk) {
    let common = common_keys(&document.scene.world);
    ui.horizontal_wrapped(|ui| {
        for (name, key) in &common {
            // The first one is shown until another one is chosen.
            if ui.small_button(*name).clicked() || desk.varied.is_none() {
                desk.vary(key.clone(), &document.state);
            }
        }
    });
    ui.separator();
    let Some(varied) = &mut desk.varied else {
        return;
    };
    varied.look(&document.state, canvas.size());
    let key = &varied.variable.key;
    let name = common.iter().find(|it| it.1 == *key);
    let title = name.map_or_else(|| key.to_string(), |(name, _)| format!("{name}: {key}"));
    ui.strong(title);
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
    ui.weak(variable.key.comment().unwrap_or_default());
    let (value, wanted) = match &varied.wanted {
        Ok((value, wanted)) => (*value, wanted),
        Err(reason) => {
            ui.colored_label(BAD, reason);
            return None;
        }
    };
    let latest = study.facts.curves.value.as_ref();
    let known = latest.filter(|it| it.is_same(wanted));
    let curves = known.map(Refined::curves).unwrap_or_default();
    let [width, height] = wanted.size;
    let pictures =
        format!("error in pictures of {width}x{height}, at up to {PIXELS} pixels, evenly spread");
    ui.small(pictures);
    let mut change = plot(ui, variable, wanted.limit, &curves, value).map(Change::Value);
    let mut numbers = [variable.from, value, variable.to];
    ui.horizontal(|ui| {
        for (name, number_of) in ["from", "now", "to"].into_iter().zip(&mut numbers) {
            ui.weak(name);
            number(ui, number_of, ANY);
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
            ui.colored_label(ink(*method), capital(&name));
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

fn ink(method: Option<Method>) -> Color32 {
    method.map_or(INK, |method| mode_ink(method.mode))
}

/// The points of a curve in the plot: the share of the range, and the logarithm of the error.
fn points(variable: &Variable, curve: &Curve) -> Vec<[f64; 2]> {
    let [least, most] = ERRORS;
    let found = curve.points.iter().filter_map(|it| {
        let error = it.error()?.clamp(least, most);
        Some([variable.share(it.value), error.log10()])
    });
    found.collect()
}

/// Lays out the curves, with lines at the limit and at the present value. Returns the value that a drag or a click chooses.
fn plot(
    ui: &mut Ui,
    variable: &Variable,
    limit: f64,
    curves: &[MethodCurve],
    value: f64,
) -> Option<f64> {
    let [least, most] = ERRORS.map(f64::log10);
    let marks = variable.marks();
    let of_values = move |_: GridInput| {
        let marks = marks.iter().map(|mark| variable.share(*mark));
        marks.map(grid_mark).collect()
    };
    let plot = plot_of_errors("varied", HEIGHT)
        .width(ui.available_width() - BESIDE)
        .x_grid_spacer(of_values)
        .x_axis_formatter(|mark, _| in_words(variable.at(mark.value)))
        .default_x_bounds(0.0, 1.0)
        .default_y_bounds(least, most)
        .show_x(false)
        .show_y(false);
    let shown = ui.scope(|ui| {
        // The keyboard's focus goes to the numbers below, not to the axes.
        ui.visuals_mut().disabled_alpha = 1.0;
        ui.disable();
        still(plot).show(ui, |plot| {
            let kept = HLine::new("", limit.log10()).color(Color32::GRAY);
            plot.hline(kept.style(LineStyle::dashed_dense()));
            for (method, curve) in curves {
                let line = Line::new("", points(variable, curve)).color(ink(*method));
                plot.line(line.width(1.5).allow_hover(false));
            }
            let now = VLine::new("", variable.share(value)).color(Color32::WHITE);
            plot.vline(now.width(2.0));
        })
    });
    let (area, transform) = (shown.inner.response.rect, shown.inner.transform);
    let mouse = ui.interact(area, ui.id().with("varied"), Sense::CLICK | Sense::DRAG);
    let name = format!("errors over {}", variable.key);
    mouse.widget_info(|| WidgetInfo::labeled(WidgetType::Other, true, &name));
    let at = mouse.interact_pointer_pos()?;
    let share = transform.value_from_position(at).x.clamp(0.0, 1.0);
    let chosen = rounded(variable.at(share), 2).clamp(variable.from, variable.to);
    (mouse.dragged() || mouse.clicked()).then_some(chosen)
}
