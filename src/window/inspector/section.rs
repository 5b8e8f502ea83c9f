//! The section through a face along the row of the probed pixel: the terms of exact Phong on one another, Gouraud's straight
//! line between the edges, and the factors that both are made of.

use egui::{Color32, Ui, WidgetInfo, WidgetType};
use egui_plot::{FilledArea, Line, LineStyle, Plot, PlotPoints, PlotUi, Points, VLine};

use crate::components::{LightKind, ShadingMode};
use crate::probe::ProbedSurface;
use crate::reference::LightSample;
use crate::trade::metrics::displayed;
use crate::window::app::App;
use crate::window::style::{EXACT, GOURAUD, PHONG, SHORTCUT};
use crate::window::widgets::{CHANNELS, still};

/// The terms as they lie on one another, and the share of their light's colour.
const STACK: [(LightKind, f32); 3] = [
    (LightKind::Ambient, 0.25),
    (LightKind::Diffuse, 0.5),
    (LightKind::Specular, 0.8),
];
/// More lights than this have no name beside the section.
const NAMES: usize = 8;

/// Columns, and the surface seen there.
type Places<'a> = Vec<(f64, &'a ProbedSurface)>;

impl App {
    /// The columns of the section where the reference sees the face, too.
    fn places(&self) -> Places<'_> {
        let section = self.facts.section.value.iter().flatten();
        let known = section.filter_map(|probe| {
            let surface = probe.surface.as_ref()?;
            Some((probe.pixel[0] as f64, surface)).filter(|_| surface.position.is_some())
        });
        known.collect()
    }

    /// The channel in which Gouraud and exact Phong differ most along the section.
    pub fn channel(&self) -> usize {
        let places = self.places();
        let most = [0, 1, 2].map(|channel| {
            let errors = places.iter().map(|(_, surface)| {
                let [gouraud, phong] = levels(surface, channel);
                (gouraud - phong).abs()
            });
            errors.fold(0.0, f64::max)
        });
        let larger = |best, next| if most[next] > most[best] { next } else { best };
        (0..3).fold(0, larger)
    }

    /// Lays out the section around `here`; the column that the mouse drags the point to.
    pub fn section(&self, ui: &mut Ui, here: &ProbedSurface, channel: usize) -> Option<usize> {
        let places = self.places();
        let x = places.iter().find(|(_, it)| std::ptr::eq(*it, here))?.0;
        let ink = |light: &LightSample| self.light_color(&light.name);
        let exact = levels(here, channel)[1];
        ui.label(format!("{} along the row", CHANNELS[channel]))
            .on_hover_text("Levels of 255. Dots are edges of the triangles.");
        let by_levels = plot(ui, "section", 150.0, &places, x, |plot| {
            stack(plot, &places, channel, &ink);
            let line = curve(&places, |it| levels(it, channel)[1]);
            plot.line(Line::new("exact Phong", line).color(PHONG).width(1.5));
            if here.drawn.mode == ShadingMode::UnitVectors {
                let line = curve(&places, |it| displayed(it.drawn.levels[channel]));
                plot.line(Line::new("unit vectors", line).color(SHORTCUT).width(1.5));
            }
            straight(plot, &places, |it| levels(it, channel)[0]);
            dot(plot, x, GOURAUD, levels(here, channel)[0]);
            dot(plot, x, PHONG, exact);
        });
        ui.horizontal_wrapped(|ui| {
            ui.colored_label(GOURAUD, format!("Gouraud {:.0}", levels(here, channel)[0]));
            ui.colored_label(PHONG, format!("Phong {exact:.0}"));
            for light in here.lights.iter().take(NAMES) {
                let text = format!("⏹\u{a0}{}\u{a0}{:.0}", light.name, light.phong[channel]);
                ui.colored_label(self.light_color(&light.name), text);
            }
        });
        ui.label(format!("n.l and (o.r)^{}", here.shininess))
            .on_hover_text(
                "The factors of the lights: curves at the pixels, straight between the edges.",
            );
        let by_factors = plot(ui, "factors", 90.0, &places, x, |plot| {
            for index in distinct(here) {
                let light = |it: &ProbedSurface| it.lights[index].factor;
                straight(plot, &places, |it| interpolated(&it.lights[index]));
                let name = &here.lights[index].name;
                let line = Line::new(name.clone(), curve(&places, light));
                plot.line(line.color(self.light_color(name)).width(1.5));
                dot(plot, x, EXACT, light(here));
            }
        });
        by_levels.or(by_factors)
    }
}

/// Gouraud's and Phong's levels in f64, as displayed.
fn levels(surface: &ProbedSurface, channel: usize) -> [f64; 2] {
    let reference = &surface.reference;
    [reference.gouraud, reference.phong]
        .map(|it| it.map_or(0.0, |it| displayed(it.levels[channel])))
}

/// The factor of a light that interpolation between the vertices gives.
fn interpolated(light: &LightSample) -> f64 {
    let channel = light.strength.max_position();
    match light.strength[channel] {
        0.0 => 0.0,
        strength => light.gouraud[channel] / strength,
    }
}

/// The lights with a direction whose factors differ: those of one kind at one place are one.
fn distinct(here: &ProbedSurface) -> Vec<usize> {
    let lights = &here.lights;
    let is_known = |index: &usize| {
        let light = &lights[*index];
        let is_same =
            |other: &LightSample| other.kind == light.kind && other.to_light == light.to_light;
        light.kind != LightKind::Ambient && !lights[..*index].iter().any(is_same)
    };
    (0..lights.len()).filter(is_known).take(NAMES).collect()
}

fn curve(places: &Places, of: impl Fn(&ProbedSurface) -> f64) -> PlotPoints<'static> {
    let points = places.iter().map(|(x, surface)| [*x, of(surface)]);
    points.collect()
}

/// Stacks the terms of exact Phong, clamped to the display's range.
fn stack(
    plot: &mut PlotUi,
    places: &Places,
    channel: usize,
    ink: &dyn Fn(&LightSample) -> Color32,
) {
    let columns: Vec<f64> = places.iter().map(|(x, _)| *x).collect();
    let mut below = vec![0.0; places.len()];
    for (kind, share) in STACK {
        for (index, light) in places[0].1.lights.iter().enumerate() {
            if light.kind != kind {
                continue;
            }
            let terms = places.iter().map(|(_, it)| it.lights[index].phong[channel]);
            let above = below.iter().zip(terms).map(|(sum, term)| sum + term);
            let above: Vec<f64> = above.collect();
            let [least, most] = [&below, &above].map(|sums| {
                let shown = sums.iter().copied().map(displayed);
                shown.collect::<Vec<f64>>()
            });
            let area = FilledArea::new(light.name.clone(), &columns, &least, &most);
            plot.add(
                area.fill_color(ink(light).gamma_multiply(share))
                    .allow_hover(false),
            );
            below = above;
        }
    }
}

/// Interpolation: a line, with dots where the row meets the edges of the triangles.
fn straight(plot: &mut PlotUi, places: &Places, of: impl Fn(&ProbedSurface) -> f64) {
    let line = Line::new("interpolated", curve(places, &of));
    plot.line(line.color(GOURAUD).width(1.5));
    let triangles = places.chunk_by(|one, other| one.1.triangle == other.1.triangle);
    let ends = triangles.flat_map(|same| [same[0], same[same.len() - 1]]);
    let dots: PlotPoints = ends.map(|(x, surface)| [x, of(surface)]).collect();
    plot.points(Points::new("edges", dots).color(GOURAUD).radius(4.0));
}

/// A dot at the pixel.
fn dot(plot: &mut PlotUi, x: f64, ink: Color32, y: f64) {
    plot.points(Points::new("pixel", vec![[x, y]]).color(ink).radius(4.5));
}

/// A plot over the columns of the section, with a line at the pixel; the column that the mouse drags it to.
fn plot<'a>(
    ui: &mut Ui,
    name: &'static str,
    height: f32,
    places: &Places,
    x: f64,
    draw: impl FnOnce(&mut PlotUi<'a>) + 'a,
) -> Option<usize> {
    let plot = still(Plot::new(name).height(height).include_y(0.0));
    let plot = plot
        .y_axis_min_width(28.0)
        .show_axes([false, true])
        .show_x(false);
    let shown = plot.show(ui, move |plot| {
        draw(plot);
        let line = VLine::new("pixel", x).color(Color32::GRAY);
        plot.vline(line.style(LineStyle::dashed_dense()));
    });
    let response = shown.response;
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Slider, true, name));
    let is_held = response.dragged() || response.clicked();
    let pointer = response.interact_pointer_pos().filter(|_| is_held)?;
    let wanted = shown.transform.value_from_position(pointer).x;
    let distance = |(x, _): &&(f64, &ProbedSurface)| (x - wanted).abs();
    let nearest = places
        .iter()
        .min_by(|one, other| distance(one).total_cmp(&distance(other)));
    nearest.map(|(x, _)| *x as usize)
}
