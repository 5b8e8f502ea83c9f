//! The levels along the row of the probed pixel, as far as its face is seen: Gouraud, exact Phong, and the picture.

use egui::{Color32, Ui};
use egui_plot::{Line, LineStyle, Plot, VLine};

use crate::probe::ProbedSurface;
use crate::report::words::CHANNELS;
use crate::trade::metrics::displayed;
use crate::window::app::App;
use crate::window::style::{GOURAUD, PHONG};
use crate::window::widgets::still;

/// The broad line of the picture, under the others.
const DRAWN: Color32 = Color32::from_gray(90);

impl App {
    /// The columns of the section and the surface at each, where the reference sees the same face.
    fn columns(&self) -> impl Iterator<Item = (f64, &ProbedSurface)> {
        let section = self.facts.section.value.iter().flatten();
        section.filter_map(|probe| {
            let surface = probe.surface.as_ref()?;
            surface.sample.as_ref()?;
            Some((probe.pixel[0] as f64, surface))
        })
    }

    /// Lays out the levels along the row in the channel that errs most at the pixel, with a line at its column.
    pub fn section(&self, ui: &mut Ui, column: usize, here: &ProbedSurface) {
        let (channel, _) = here.error().unwrap_or_default();
        let [gouraud, phong] = exact(here, channel);
        ui.horizontal_wrapped(|ui| {
            ui.label(format!("{} along the row:", CHANNELS[channel]))
                .on_hover_text("Levels of 255. The broad grey line is the picture.");
            ui.colored_label(GOURAUD, format!("Gouraud {gouraud:.0}"));
            ui.colored_label(PHONG, format!("Phong {phong:.0}"));
        });
        let curve = |name: &'static str, level: &dyn Fn(&ProbedSurface) -> f64| {
            let points = self.columns().map(|(x, surface)| [x, level(surface)]);
            Line::new(name, points.collect::<Vec<_>>()).width(1.5)
        };
        let drawn = curve("picture", &|it| displayed(it.drawn.levels[channel]));
        let lines = [
            drawn.color(DRAWN).width(5.0),
            curve("Gouraud", &|it| exact(it, channel)[0]).color(GOURAUD),
            curve("exact Phong", &|it| exact(it, channel)[1]).color(PHONG),
        ];
        let plot = still(Plot::new("section").height(150.0).include_y(0.0));
        let plot = plot.y_axis_min_width(28.0).show_axes([false, true]);
        plot.show_x(false).show(ui, |plot| {
            for line in lines {
                plot.line(line);
            }
            let here = VLine::new("pixel", column as f64).color(Color32::GRAY);
            plot.vline(here.style(LineStyle::dashed_dense()));
        });
    }
}

/// The displayed levels of exact Gouraud and of exact Phong.
fn exact(surface: &ProbedSurface, channel: usize) -> [f64; 2] {
    surface.sample.as_ref().map_or([0.0; 2], |sample| {
        [sample.gouraud, sample.phong].map(|levels| displayed(levels[channel]))
    })
}
