//! The pixel's tab: drawn, exact and error first, then the worked example, then the section along the pixel's row.

use egui::{Color32, Grid, RichText, Ui, vec2};
use egui_plot::{Line, LineStyle, Plot, PlotPoints, VLine};

use super::progress;
use crate::components::{LightKind, Probed, ShadingMode};
use crate::frame::display_pixel;
use crate::paint::color;
use crate::probe::{PRODUCT_HEADS, Profile, Surface, parts};
use crate::window::app::App;
use crate::window::style::{BAD, EXACT, GOURAUD, PHONG, STALE};

const CHANNELS: [&str; 3] = ["red", "green", "blue"];

impl App {
    pub fn pixel_tab(&mut self, ui: &mut Ui) {
        let Probed(Some([x, y])) = self.look() else {
            ui.label("Click a pixel of the picture to see what is computed there.");
            return;
        };
        ui.horizontal(|ui| {
            ui.strong(format!("pixel {x}, {y}"));
            if ui
                .small_button("close")
                .on_hover_text("No pixel is looked at (Esc).")
                .clicked()
            {
                self.set_look(Probed(None));
            }
        });
        progress(ui, &self.facts.probe.state, "probing");
        let is_current = self.facts.probe.current().is_some();
        let Some(probed) = &self.facts.probe.value else {
            return;
        };
        if !is_current {
            ui.visuals_mut().override_text_color = Some(STALE);
        }
        let (Some(object), Some(surface)) = (&probed.probe.object, &probed.probe.surface) else {
            ui.label("Background: no cuboid is seen here.");
            return;
        };
        ui.label(format!("{object}, {}", surface.triangle_label()));
        let is_gouraud = self.mode_of(object) == Some(ShadingMode::Gouraud);
        verdict(ui, surface, is_gouraud);
        if ui
            .button("copy")
            .on_hover_text("Copies everything that is known of this pixel.")
            .clicked()
        {
            ui.ctx().copy_text(probed.probe.lines().join("\n"));
        }
        section(ui, &probed.profile, x, y);
        worked_example(ui, surface);
    }

    /// The mode of the cuboid of this name.
    fn mode_of(&self, object: &str) -> Option<ShadingMode> {
        let mut cuboids = self
            .scene
            .world
            .query::<(&crate::components::Name, &ShadingMode)>();
        let mut cuboids = cuboids.iter();
        cuboids
            .find(|(name, _)| name.0 == object)
            .map(|(_, mode)| *mode)
    }
}

/// Drawn, exact Phong, and the error between them, by channel, with both colours.
fn verdict(ui: &mut Ui, surface: &Surface, is_gouraud: bool) {
    let drawn = if is_gouraud {
        surface.gouraud.levels
    } else {
        surface.phong.levels
    };
    let exact = surface.reference.phong.map(|it| it.levels);
    Grid::new("verdict")
        .num_columns(4)
        .striped(true)
        .show(ui, |ui| {
            for head in ["", "drawn", "exact", "error"] {
                ui.weak(head)
                    .on_hover_text("Levels of 255. Exact is exact Phong in f64.");
            }
            ui.end_row();
            for channel in 0..3 {
                let clamped = drawn[channel].clamp(0.0, 255.0);
                ui.label(CHANNELS[channel]);
                ui.monospace(format!("{clamped:.2}"));
                if let Some(exact) = exact {
                    let exact = exact[channel].clamp(0.0, 255.0);
                    let error = (clamped - exact).abs();
                    ui.monospace(format!("{exact:.2}"));
                    let text = RichText::new(format!("{error:.2}")).monospace();
                    ui.label(if error > 1.0 { text.color(BAD) } else { text });
                }
                ui.end_row();
            }
            ui.label("");
            swatch(ui, drawn);
            if let Some(exact) = exact {
                swatch(ui, exact);
            }
            ui.end_row();
        });
}

fn swatch(ui: &mut Ui, levels: [f64; 3]) {
    let (place, _) = ui.allocate_exact_size(vec2(52.0, 20.0), egui::Sense::hover());
    ui.painter()
        .rect_filled(place, 2.0, color(display_pixel(levels)));
}

/// The levels along the pixel's row, of the channel that is brightest at the pixel.
fn section(ui: &mut Ui, profile: &Profile, column: usize, row: usize) {
    let exact = profile.reference.get(column).copied().unwrap_or_default();
    let brightest = (0..3).reduce(|one, next| if exact[next] > exact[one] { next } else { one });
    let channel = brightest.unwrap_or(0);
    let name = CHANNELS[channel];
    ui.label(format!("{name} along row {row}, levels of 255"));
    ui.horizontal(|ui| {
        for (ink, name) in [
            (GOURAUD, "Gouraud"),
            (PHONG, "Phong"),
            (EXACT, "exact (dots)"),
        ] {
            ui.colored_label(ink, name);
        }
    });
    let curve = |levels: &[[f64; 3]]| -> PlotPoints<'static> {
        let points = levels.iter().enumerate();
        points
            .map(|(x, levels)| [x as f64, levels[channel].clamp(0.0, 255.0)])
            .collect()
    };
    let plot = Plot::new("section")
        .height(140.0)
        .include_y(0.0)
        .allow_scroll(false)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_boxed_zoom(false);
    plot.show(ui, |plot| {
        plot.vline(VLine::new("pixel", column as f64).color(Color32::from_gray(110)));
        plot.line(Line::new("Gouraud", curve(&profile.gouraud)).color(GOURAUD));
        plot.line(Line::new("Phong", curve(&profile.phong)).color(PHONG));
        plot.line(
            Line::new("exact", curve(&profile.reference))
                .color(EXACT)
                .style(LineStyle::dotted_loose()),
        );
    });
}

/// Every step from the vectors to the sum.
fn worked_example(ui: &mut Ui, surface: &Surface) {
    ui.collapsing("vectors", |ui| {
        Grid::new("vectors")
            .num_columns(4)
            .striped(true)
            .show(ui, |ui| {
                row(ui, "", &["x", "y", "z"].map(str::to_owned));
                row(ui, "position", &parts(surface.position));
                row(ui, "normal n", &parts(surface.normal));
                row(ui, "to eye o", &parts(surface.to_eye));
                for light in surface
                    .lights
                    .iter()
                    .filter(|it| it.kind != LightKind::Ambient)
                {
                    row(ui, &format!("{} l", light.name), &parts(light.to_light));
                    row(ui, &format!("{} r", light.name), &parts(light.reflected));
                }
            });
    });
    ui.label("exact Phong, light by light");
    for (half, title) in surface.product_titles().iter().enumerate() {
        Grid::new(("products", half))
            .num_columns(4)
            .striped(true)
            .show(ui, |ui| {
                row(ui, title, &PRODUCT_HEADS[half].map(str::to_owned));
                for (name, cells) in surface.products() {
                    row(ui, &name, &cells[half]);
                }
            });
    }
    for (mode, name) in ["Gouraud", "Phong"].into_iter().enumerate() {
        Grid::new(("sum", mode))
            .num_columns(4)
            .striped(true)
            .show(ui, |ui| {
                row(ui, name, &["r", "g", "b"].map(str::to_owned));
                for (name, cells) in surface.table() {
                    row(ui, &name, &cells[mode]);
                }
            });
    }
}

fn row(ui: &mut Ui, name: &str, cells: &[String; 3]) {
    ui.label(name);
    for cell in cells {
        ui.monospace(cell);
    }
    ui.end_row();
}
