//! The charts beside the picture: every method by its time and its error, and the legends of views.

use egui::{Color32, Rect, RichText, Ui, pos2, vec2};
use egui_plot::{GridMark, Line, Plot, PlotPoints, Points};

use super::app::App;
use super::inspector::short;
use super::jobs::State;
use super::keys::{Command, caption};
use super::pictures::TINTS;
use super::style::{BAD, STALE};
use crate::components::{Show, Tolerance, ViewMode};
use crate::paint::color;
use crate::prove::{REFUTED, UNDECIDED};
use crate::shading::TileKind;
use crate::trade::error_map::{EDGE, NOTHING, Pixel, Scale};
use crate::trade::verdict::verdict;

/// The least error that has a place of its own on the logarithmic axis, in levels.
const LEAST_ERROR: f64 = 1e-4;

impl App {
    /// The trade of this view: the time of a frame against the largest error, both logarithmic, a point a method.
    pub fn chart(&mut self, ui: &mut Ui) {
        let is_current = self.facts.report.current().is_some();
        if let Some(report) = &self.facts.report.value {
            let ink = if is_current {
                Color32::from_gray(220)
            } else {
                STALE
            };
            ui.label(RichText::new(verdict(report)).color(ink));
            let point = |error: f64, time: f64| [time.log10(), error.max(LEAST_ERROR).log10()];
            let (tolerance, shading) = (self.look::<Tolerance>().0, self.shading());
            let methods = report
                .methods
                .iter()
                .filter_map(|one| Some((one, one.max_error()?)));
            let mut front: Vec<[f64; 2]> = Vec::new();
            let mut points = Vec::new();
            for (one, error) in methods {
                let at = point(error, one.timing.median);
                if one.on_front {
                    front.push(at);
                }
                let is_shown =
                    shading == Some(one.method.mode) && one.method.tolerance == tolerance;
                points.push((one.method.id, at, one.on_front, is_shown));
            }
            front.sort_by(|one, other| one[0].total_cmp(&other[0]));
            ui.weak("largest error of 255 against time of a frame");
            let plot = Plot::new("trade")
                .height(170.0)
                .allow_drag(false)
                .allow_zoom(false)
                .allow_scroll(false)
                .allow_boxed_zoom(false)
                .x_axis_label("ms")
                .x_axis_formatter(|mark: GridMark, _: &_| power(mark.value))
                .y_axis_formatter(|mark: GridMark, _: &_| power(mark.value))
                .label_formatter(|name, at| {
                    format!(
                        "{name}\n{} ms, off by {} of 255",
                        short(10.0_f64.powf(at.x)),
                        short(10.0_f64.powf(at.y))
                    )
                });
            plot.show(ui, |plot| {
                plot.line(
                    Line::new("best trades", PlotPoints::from(front))
                        .color(Color32::from_gray(120)),
                );
                for (name, at, on_front, is_shown) in points {
                    let ink = if !is_current {
                        STALE
                    } else if on_front {
                        Color32::from_rgb(0x56, 0xb4, 0xe9)
                    } else {
                        Color32::GRAY
                    };
                    let dot = |radius: f32, is_filled| {
                        Points::new(name, vec![at])
                            .radius(radius)
                            .color(ink)
                            .filled(is_filled)
                    };
                    plot.points(dot(4.0, is_current));
                    if is_shown {
                        plot.points(dot(9.0, false));
                    }
                }
            });
        }
        let state = self.facts.report.state.clone();
        ui.horizontal(|ui| match &state {
            State::Running(share) => {
                ui.add(
                    egui::ProgressBar::new(*share as f32)
                        .desired_width(120.0)
                        .text(format!("measuring {:.0} %", share * 100.0)),
                );
            }
            State::Failed(reason) => drop(ui.colored_label(BAD, reason)),
            _ => {
                let button = egui::Button::new("measure all methods")
                    .shortcut_text(caption(Command::Measure));
                let says =
                    "The time of a frame and the largest error of every method, in this view.";
                if ui.add(button).on_hover_text(says).clicked() {
                    self.run(Command::Measure);
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
                    swatch(ui, color(tint), &format!("{count}  {}", kind.name()));
                }
            }
            _ => {}
        }
    }

    /// The scale of the error map, with marks at the tolerance and at the largest error.
    fn error_legend(&self, ui: &mut Ui) {
        let comparison = self.facts.comparison.current();
        let scale = comparison.map_or(Scale::WIDEST, |it| it.scale);
        let size = vec2(ui.available_width().min(260.0), 34.0);
        let (place, response) = ui.allocate_exact_size(size, egui::Sense::hover());
        response.on_hover_text("Error against exact Phong, in levels of 255. The white marks are the tolerance and the largest error.");
        let painter = ui.painter_at(place);
        let bar = Rect::from_min_size(place.min + vec2(2.0, 0.0), vec2(size.x - 4.0, 14.0));
        let ticks = scale.ticks();
        let top = ticks.last().copied().unwrap_or(255.0);
        let x = |error: f64| bar.min.x + bar.width() * scale.position(error) as f32;
        for column in 0..bar.width() as usize {
            let share = column as f64 / f64::from(bar.width());
            // The inverse of the scale's position, found by bisection: the scale is even near zero and logarithmic above.
            let (mut low, mut high) = (0.0, top);
            for _ in 0..30 {
                let middle = (low + high) / 2.0;
                if scale.position(middle) < share {
                    low = middle
                } else {
                    high = middle
                }
            }
            let ink = color(scale.color(Pixel::Error(low as f32)));
            let left = bar.min.x + column as f32;
            painter.rect_filled(
                Rect::from_min_size(pos2(left, bar.min.y), vec2(1.0, bar.height())),
                0.0,
                ink,
            );
        }
        for (index, tick) in ticks.iter().enumerate().filter(|(index, _)| index % 2 == 0) {
            let align = if index == 0 {
                egui::Align2::LEFT_TOP
            } else {
                egui::Align2::CENTER_TOP
            };
            painter.text(
                pos2(x(*tick), bar.max.y + 3.0),
                align,
                format!("{tick}"),
                egui::FontId::proportional(10.0),
                Color32::GRAY,
            );
        }
        let largest = comparison.and_then(|it| it.errors).map(|errors| errors.max);
        for mark in [Some(self.look::<Tolerance>().0), largest]
            .into_iter()
            .flatten()
        {
            painter.vline(x(mark), bar.min.y..=bar.max.y + 4.0, (1.5, Color32::WHITE));
        }
        swatch(ui, color(EDGE), "another face is seen");
        swatch(ui, color(NOTHING), "nothing is drawn");
        let proof = self.facts.proof.current();
        if proof.is_some_and(|proof| proof.undecided > 0) {
            swatch(ui, color(UNDECIDED), "undecided");
        }
        if proof.is_some_and(|proof| proof.refuted > 0) {
            swatch(ui, color(REFUTED), "refuted");
        }
    }
}

fn swatch(ui: &mut Ui, ink: Color32, text: &str) {
    ui.horizontal(|ui| {
        let (place, _) = ui.allocate_exact_size(vec2(14.0, 14.0), egui::Sense::hover());
        ui.painter().rect_filled(place.shrink(1.0), 2.0, ink);
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
