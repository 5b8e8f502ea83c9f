//! The triangle of the probed pixel over the picture: its vertices with their levels, and the section along the row.

use egui::{Align2, Color32, Pos2, Rect};
use glam::DVec3;

use super::app::App;
use super::style::GOURAUD;
use super::widgets::tag;
use crate::components::{Lens, Mesh, Name, TRIANGLES, WorldTransform};
use crate::frame::display_pixel;
use crate::paint::color;
use crate::probe::{Probe, ProbedSurface};

impl App {
    /// Draws the triangle that is seen at the probed pixel, if the answer is about the present picture.
    pub fn draw_triangle(&self, painter: &egui::Painter) {
        let section = self.facts.section.current();
        let (Some(section), Some(probe)) = (section, self.probed()) else {
            return;
        };
        let (Some(object), Some(surface)) = (&probe.object, &probe.surface) else {
            return;
        };
        let row = |probe: &Probe| self.place_of(probe.pixel.map(|it| it as i32));
        let ends = [&section[0], &section[section.len() - 1]].map(row);
        painter.line_segment(ends, (3.0, Color32::from_black_alpha(120)));
        painter.line_segment(ends, (1.0, GOURAUD));
        let Some(triangle) = surface.reference.triangle else {
            return;
        };
        let corners = self.corners(object, triangle);
        let seen: Vec<Pos2> = corners.iter().flatten().copied().collect();
        let middle = Rect::from_points(&seen).center();
        let channel = self.channel();
        for (index, corner) in corners.into_iter().enumerate() {
            let (Some(from), Some(to)) = (corner, corners[(index + 1) % 3]) else {
                continue;
            };
            painter.line_segment([from, to], (1.0, Color32::from_white_alpha(140)));
            let levels = at_vertex(surface, index);
            painter.circle(from, 5.0, color(display_pixel(levels)), (2.0, GOURAUD));
            let text = format!("{:.0}", levels[channel]);
            let at = from + (from - middle).normalized() * 18.0;
            tag(painter, Align2::CENTER_CENTER, at, &text, GOURAUD);
        }
    }

    /// The vertices of a cuboid's triangle in the window; `None` for those before the near plane.
    fn corners(&self, object: &str, triangle: u32) -> [Option<Pos2>; 3] {
        let lens = Lens::new(&self.view());
        let mut query = (self.scene.world).query::<(&Name, &WorldTransform, &Mesh)>();
        let cuboid = query.iter().find(|(name, ..)| name.0 == object);
        let Some((_, place, mesh)) = cuboid else {
            return [None; 3];
        };
        TRIANGLES[triangle as usize].map(|corner| {
            let corner = mesh.corners[usize::from(corner)];
            let seen = lens.seen(place.position + place.axes * corner);
            let pixel = lens.pixel(lens.homogeneous(seen));
            let is_near = pixel.iter().all(|it| it.abs() < 1e6);
            (seen.z > lens.near && is_near).then(|| self.place_of(pixel.map(|it| it as i32)))
        })
    }
}

/// Gouraud's levels at a vertex, unclamped.
fn at_vertex(surface: &ProbedSurface, vertex: usize) -> [f64; 3] {
    let lights = surface.lights.iter();
    let levels: DVec3 = lights
        .map(|light| light.strength * light.at_corners[vertex])
        .sum();
    levels.to_array()
}
