//! The pixel's tab: the drawn and the exact levels, the cause of their difference, the levels along the row, every number.

use egui::color_picker::show_color;
use egui::{CollapsingHeader, Color32, Grid, Label, RichText, StrokeKind, Ui, vec2};
use egui_plot::{Line, LineStyle, Plot, VLine};
use hecs::World;

use crate::components::{ShadingMode, viewer, viewer_mut};
use crate::output::paint::color;
use crate::output::words::CHANNELS;
use crate::questions::metrics::displayed;
use crate::questions::probe::{Probe, ProbedSurface};
use crate::systems::frame::display_pixel;
use crate::window::canvas::Canvas;
use crate::window::study::Study;
use crate::window::widgets::{BAD, GOURAUD, PHONG, still, wait};

/// The height of the levels along the row, in points.
const PLOT: f32 = 150.0;
/// The height of the plot with its heading and a margin.
pub const SECTION: f32 = PLOT + 27.0;
/// The size of the letters of the numbers, in points.
const NUMBERS: f32 = 10.0;

/// The broad line of the picture, under the others.
const DRAWN: Color32 = Color32::from_gray(90);

/// Lays out the tab.
pub fn tab(ui: &mut Ui, world: &mut World, canvas: &Canvas, study: &Study) {
    let pixel = canvas.pixel(&viewer(world));
    let Some([x, y]) = pixel else {
        ui.label(match viewer(world).pixel {
            Some(_) => "The place lies outside of the picture.",
            None => "Click a pixel of the picture to see what is computed there.",
        });
        return;
    };
    let [width, height] = canvas.size();
    ui.horizontal(|ui| {
        ui.strong(format!("pixel {x}, {y} of {width}x{height}"));
        if ui.small_button("close").clicked() {
            viewer_mut(world).pixel = None;
        }
    });
    wait(ui, study, study.facts.section.is_current);
    let Some(probe) = study.facts.probed(pixel) else {
        return;
    };
    let Some(surface) = &probe.surface else {
        ui.label("The background: no cuboid is seen here.");
        return;
    };
    let object = &surface.object;
    ui.label(format!("{object}, triangle {}", surface.triangle));
    verdict(ui, surface);
    let is_phong = surface.mode == ShadingMode::Phong;
    if is_phong {
        ui.label(surface.cost());
        ui.weak("Gouraud shading instead:");
    }
    for sentence in surface.cause().into_iter().flatten() {
        ui.label(sentence);
    }
    if !is_phong {
        ui.label(surface.cost());
    }
    section(
        ui,
        study
            .facts
            .section
            .value
            .as_ref()
            .map_or(&[][..], |it| &it.1[..]),
        x,
        surface,
    );
    let lines = probe.lines();
    let numbers = CollapsingHeader::new("every number");
    numbers.show_unindented(ui, |ui| {
        let text = RichText::new(lines.join("\n")).size(NUMBERS).monospace();
        ui.add(Label::new(text).wrap());
    });
}

/// The columns of the section and the surface at each, where the reference sees the same face.
fn columns(row: &[Probe]) -> impl Iterator<Item = (f64, &ProbedSurface)> {
    row.iter().filter_map(|probe| {
        let surface = probe.surface.as_ref()?;
        surface.sample.as_ref()?;
        Some((probe.pixel[0] as f64, surface))
    })
}

/// Lays out the levels along the row in the channel that errs most at the pixel, with a line at its column.
pub fn section(ui: &mut Ui, row: &[Probe], column: usize, here: &ProbedSurface) {
    let (channel, _) = here.error().unwrap_or_default();
    let [gouraud, phong] = exact(here, channel);
    ui.horizontal_wrapped(|ui| {
        ui.label(format!("{} along the row:", CHANNELS[channel]))
            .on_hover_text("Levels of 255. The broad grey line is the picture.");
        ui.colored_label(GOURAUD, format!("Gouraud {gouraud:.0}"));
        ui.colored_label(PHONG, format!("Phong {phong:.0}"));
    });
    let curve = |name: &'static str, level: &dyn Fn(&ProbedSurface) -> f64| {
        let points = columns(row).map(|(x, surface)| [x, level(surface)]);
        Line::new(name, points.collect::<Vec<_>>()).width(1.5)
    };
    let drawn = curve("picture", &|it| displayed(it.drawn[channel]));
    let lines = [
        drawn.color(DRAWN).width(5.0),
        curve("Gouraud", &|it| exact(it, channel)[0]).color(GOURAUD),
        curve("exact Phong", &|it| exact(it, channel)[1]).color(PHONG),
    ];
    let plot = Plot::new("section")
        .height(PLOT.min(ui.available_height()))
        .include_y(0.0)
        .y_axis_min_width(28.0)
        .show_axes([false, true])
        .show_x(false);
    still(plot).show(ui, |plot| {
        for line in lines {
            plot.line(line);
        }
        let here = VLine::new("pixel", column as f64).color(Color32::GRAY);
        plot.vline(here.style(LineStyle::dashed_dense()));
    });
}

/// The drawn levels, those of exact Phong, and the errors, by channel; and both colours.
fn verdict(ui: &mut Ui, surface: &ProbedSurface) {
    let drawn = surface.drawn;
    let exact = surface.sample.as_ref().map(|it| it.phong.to_array());
    Grid::new("verdict").striped(true).show(ui, |ui| {
        for head in ["", "drawn", "exact", "error"] {
            let says = "Levels of 255. Exact is exact Phong in f64.";
            ui.weak(head).on_hover_text(says);
        }
        ui.end_row();
        for channel in 0..3 {
            let shown = displayed(drawn[channel]);
            ui.label(CHANNELS[channel]);
            ui.monospace(format!("{shown:.2}"));
            if let Some(exact) = exact {
                let exact = displayed(exact[channel]);
                let error = (shown - exact).abs();
                ui.monospace(format!("{exact:.2}"));
                let text = RichText::new(format!("{error:.2}")).monospace();
                ui.label(if error > 1.0 { text.color(BAD) } else { text });
            }
            ui.end_row();
        }
        ui.label("");
        for levels in [Some(drawn), exact].into_iter().flatten() {
            let shown = show_color(ui, color(display_pixel(levels)), vec2(44.0, 20.0));
            let line = (1.0, Color32::DARK_GRAY);
            let painter = ui.painter();
            painter.rect_stroke(shown.rect, 0.0, line, StrokeKind::Outside);
        }
        ui.end_row();
    });
}

/// The displayed levels of exact Gouraud and of exact Phong.
fn exact(surface: &ProbedSurface, channel: usize) -> [f64; 2] {
    surface.sample.as_ref().map_or([0.0; 2], |sample| {
        [sample.gouraud, sample.phong].map(|levels| displayed(levels[channel]))
    })
}
