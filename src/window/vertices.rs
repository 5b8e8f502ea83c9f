//! The vertices over the picture: those at which Gouraud computes light, and those around the explained pixel.

use egui::{Align2, Color32, Painter, Rect, vec2};
use hecs::World;

use super::canvas::Canvas;
use super::pictures::{side_method, sides};
use super::widgets::{INK, tag};
use crate::components::{
    FACES, Lens, Mesh, Segments, ShadingMode, Transform, View, ViewMode, viewer,
};
use crate::questions::probe::ProbedSurface;
use crate::scene::unseen::corners_of;
use crate::shading::Method;

/// Finer grids than this are not marked.
const FINEST: usize = 16;

/// Marks the vertices of a wipe's sides that are drawn by Gouraud; `shown` is the method on screen.
pub fn mark_vertices(
    painter: &Painter,
    world: &World,
    view: &View,
    canvas: &Canvas,
    shown: Option<Method>,
) {
    let viewer = viewer(world);
    if viewer.show != ViewMode::Wipe {
        return;
    }
    let x = canvas.place.min.x + canvas.divider_column(&viewer) as f32 / canvas.scale;
    let halves = [canvas.place.with_max_x(x), canvas.place.with_min_x(x)];
    for (side, half) in sides(&viewer).into_iter().zip(halves) {
        let method = side_method(&side, shown);
        if let Some(method) = method.filter(|it| it.mode == ShadingMode::Gouraud) {
            mark_half(painter, world, &method.view(view), canvas, half);
        }
    }
}

/// Marks the vertices on the faces towards the eye, within a part of the picture.
fn mark_half(painter: &Painter, world: &World, view: &View, canvas: &Canvas, half: Rect) {
    let painter = painter.with_clip_rect(half);
    let lens = Lens::new(view);
    let place = |point| canvas.place_at(lens.pixel(lens.homogeneous(point)));
    for (mesh, transform, own) in world.query::<(&Mesh, &Transform, &Segments)>().iter() {
        let count = view.segments(*own).count();
        let corners = corners_of(mesh, transform, view, &lens);
        if count > FINEST || corners.iter().any(|it| it.z <= lens.near) {
            continue;
        }
        for face in FACES {
            let [a, b, c, d] = face.map(|corner| corners[usize::from(corner)]);
            let [one, two] = [place(b) - place(a), place(c) - place(b)];
            // Counter-clockwise on the screen, whose y axis points down: the face is towards the eye.
            if one.x * two.y - one.y * two.x >= 0.0 {
                continue;
            }
            for (i, j) in (0..=count).flat_map(|i| (0..=count).map(move |j| (i, j))) {
                let [u, v] = [i, j].map(|it| it as f64 / count as f64);
                let at = place(a.lerp(b, u).lerp(d.lerp(c, u), v));
                // Many small ones leave the picture in sight.
                let radius = if count > 4 { 1.5 } else { 3.5 };
                painter.circle(at, radius, Color32::WHITE, (1.5, Color32::from_gray(16)));
            }
        }
    }
}

/// Marks the three vertices around the explained pixel with the factors of which its cause speaks.
pub fn mark_triangle(painter: &Painter, surface: &ProbedSurface, view: &View, canvas: &Canvas) {
    let lens = Lens::new(view);
    let factors = surface.vertex_factors().into_iter().flatten();
    for ([place, _], factor) in surface.vertices.into_iter().zip(factors) {
        let seen = lens.seen(place);
        if seen.z > lens.near {
            let at = canvas.place_at(lens.pixel(lens.homogeneous(seen)));
            painter.circle_stroke(at, 6.0, (2.0, INK));
            let text = format!("{factor:.2}");
            tag(painter, Align2::LEFT_TOP, at + vec2(9.0, 5.0), &text, INK);
        }
    }
}
