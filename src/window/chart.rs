//! The charts beside the picture: every method by its time and its error, and the legends of views.

use egui::{Color32, Sense, Ui, vec2};
use egui_plot::{GridMark, Line, Plot, PlotPoints, Points};

use super::app::App;
use super::inspector::{progress, short};
use super::pictures::TINTS;
use super::style::STALE;
use crate::components::{Show, Tolerance, ViewMode};
use crate::paint::color;
use crate::prove::{REFUTED, UNDECIDED};
use crate::shading::TileKind;
use crate::trade::Measurement;
use crate::trade::error_map::{EDGE, NOTHING, Scale};

/// The least error that has a place of its own on the logarithmic axis, in levels.
const LEAST_ERROR: f64 = 1e-4;
const ON_FRONT: Color32 = Color32::from_rgb(0x56, 0xb4, 0xe9);

impl App {
    /// The trade of this view, and the button that measures it.
    pub fn chart(&mut self, ui: &mut Ui) {
        if let Some(measured) = &self.facts.trade.value {
            ui.weak("largest error of 255 against time of a frame");
            self.plot(ui, measured);
        }
        progress(ui, &self.facts.trade.state, "measuring");
    }

    /// The time of a frame against the largest error, both logarithmic, a point a method.
    fn plot(&self, ui: &mut Ui, measured: &[Measurement]) {
        let is_current = self.facts.trade.current().is_some();
        let (Tolerance(tolerance), shading) = (self.look(), self.shading());
        let place = |error: f64, time: f64| [time.log10(), error.max(LEAST_ERROR).log10()];
        let methods = measured.iter().filter_map(|one| {
            let at = place(one.error?, one.timing.median);
            let is_shown = shading == Some(one.method.mode) && one.method.tolerance == tolerance;
            Some((one.method.id, at, one.on_front, is_shown))
        });
        let points: Vec<_> = methods.collect();
        let front = points.iter().filter(|(_, _, on_front, _)| *on_front);
        let mut front: Vec<[f64; 2]> = front.map(|(_, at, ..)| *at).collect();
        front.sort_by(|one, other| one[0].total_cmp(&other[0]));
        let tick = |mark: GridMark, _: &_| power(mark.value);
        let plot = Plot::new("trade").height(170.0).x_axis_label("ms");
        let plot = plot.x_axis_formatter(tick).y_axis_formatter(tick);
        let plot = still(plot).label_formatter(|name, at| {
            let [time, error] = [at.x, at.y].map(|it| short(10.0_f64.powf(it)));
            format!("{name}\n{time} ms, off by {error} of 255")
        });
        plot.show(ui, |plot| {
            let line = Line::new("best trades", PlotPoints::from(front));
            plot.line(line.color(Color32::from_gray(120)));
            for (name, at, on_front, is_shown) in points {
                let ink = match (is_current, on_front) {
                    (false, _) => STALE,
                    (true, true) => ON_FRONT,
                    (true, false) => Color32::GRAY,
                };
                let dot = || Points::new(name, vec![at]).color(ink);
                plot.points(dot().radius(4.0).filled(is_current));
                if is_shown {
                    plot.points(dot().radius(9.0).filled(false));
                }
            }
        });
    }

    /// The meaning of the colours of the error map or of tiles.
    pub fn legend(&mut self, ui: &mut Ui, show: &Show) {
        match show.mode {
            ViewMode::Error => self.error_legend(ui),
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
        for mark in [Some(self.look::<Tolerance>().0), largest]
            .into_iter()
            .flatten()
        {
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

/// A tick of a logarithmic axis.
fn power(exponent: f64) -> String {
    let value = 10.0_f64.powf(exponent);
    if value >= 0.001 {
        short(value)
    } else {
        format!("{value:.0e}")
    }
}
