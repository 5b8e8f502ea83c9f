//! The marks on the picture: vertices, the edges of the selected cuboid, and what belongs to the explained pixel.

use egui::{Align2, Color32, Painter, Pos2, Rangef, Rect, Vec2, vec2};
use glam::DVec3;
use hecs::World;

use super::canvas::Canvas;
use super::lights::brightest;
use super::pictures::{side_method, sides};
use super::widgets::{INK, tag};
use crate::components::{
    Camera, FACES, FileOrder, Lens, Light, Mesh, Name, Segments, ShadingMode, Transform, View,
    ViewMode, active_camera, viewer,
};
use crate::questions::probe::{Probe, ProbedSurface};
use crate::reference::LightSample;
use crate::scene::unseen::corners_of;
use crate::shading::Method;

/// Finer grids than this are not marked.
const FINEST: usize = 16;
/// The factors of vertices that are nearer together, in points, would lie on each other.
const ROOM: f32 = 40.0;
/// The length of an arm of the cross at a pixel, in points.
pub const CROSS: f32 = 11.5;
/// The length of a unit vector across the view, in points. A vector that the view shortens to a share of it has the root of that
/// share.
const UNIT: f32 = 110.0;
/// Marks would hide a face whose edges are shorter, in points.
const LEAST_FACE: f32 = 50.0;
const NORMAL: Color32 = Color32::from_rgb(0x9a, 0xe6, 0x4b);
const TO_EYE: Color32 = Color32::from_rgb(0x60, 0xc8, 0xff);

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
            let is_behind = one.x * two.y - one.y * two.x >= 0.0;
            if is_behind || one.length().max(two.length()) < LEAST_FACE {
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
    let seen = surface.vertices.map(|[place, _]| lens.seen(place));
    let [a, b, c] = seen.map(|it| canvas.place_at(lens.pixel(lens.homogeneous(it))));
    let has_room = [a - b, b - c, c - a].iter().all(|it| it.length() > ROOM);
    for ((at, seen), factor) in [a, b, c].into_iter().zip(seen).zip(factors) {
        if seen.z > lens.near {
            painter.circle_stroke(at, 6.0, (2.0, INK));
            if has_room {
                let text = format!("{factor:.2}");
                tag(painter, Align2::LEFT_TOP, at + vec2(9.0, 5.0), &text, INK);
            }
        }
    }
}

/// Draws a cross around a pixel, which itself stays visible.
pub fn draw_cross(painter: &Painter, at: Pos2) {
    for way in [Vec2::RIGHT, Vec2::LEFT, Vec2::DOWN, Vec2::UP] {
        let line = [at + way * 3.5, at + way * CROSS];
        painter.line_segment(line, (4.0, Color32::from_black_alpha(170)));
        painter.line_segment(line, (1.5, Color32::WHITE));
    }
}

/// Draws the edges of a cuboid, unless a corner is before the near plane.
pub fn outline(painter: &Painter, world: &World, view: &View, canvas: &Canvas, place: usize) {
    let lens = Lens::new(view);
    let mut cuboids = world.query::<(&FileOrder, &Mesh, &Transform)>();
    let is_it = |it: &(&FileOrder, &Mesh, &Transform)| it.0.0 as usize == place;
    let Some((_, mesh, transform)) = cuboids.iter().find(is_it) else {
        return;
    };
    let corners = corners_of(mesh, transform, view, &lens);
    if corners.iter().any(|corner| corner.z <= lens.near) {
        return;
    }
    let places = corners.map(|corner| canvas.place_at(lens.pixel(lens.homogeneous(corner))));
    // Corners whose numbers differ in one bit are joined by an edge.
    for (one, bit) in (0..8).flat_map(|corner| [1, 2, 4].map(|bit| (corner, bit))) {
        if one & bit == 0 {
            let line = [places[one], places[one | bit]];
            let ink = Color32::from_white_alpha(150);
            painter.line_segment(line, (1.5, ink));
        }
    }
}

/// Draws the line between the sides of a wipe.
pub fn draw_line(painter: &Painter, x: f32, rows: Rangef) {
    painter.vline(x, rows, (4.0, Color32::from_black_alpha(110)));
    painter.vline(x, rows, (2.0, Color32::from_white_alpha(230)));
}

/// Draws n, o, and the l and r of each light, from the probed pixel, as they are seen in the view, and a legend in the
/// lower right corner of the picture.
pub fn draw_arrows(painter: &Painter, probe: &Probe, world: &World, canvas: &Canvas) {
    let Some(surface) = &probe.surface else {
        return;
    };
    let at = canvas.place_of(probe.pixel);
    let [right, up, _] = Camera::of(world, active_camera(world)).axes();
    let mut row = canvas.place.shrink2(vec2(10.0, 14.0)).right_bottom();
    let mut arrow = |name: &str, ink: Color32, vector: Option<DVec3>| {
        let Some(vector) = vector else {
            return;
        };
        tag(painter, Align2::RIGHT_CENTER, row, name, ink);
        row.y -= 20.0;
        let way = vec2(vector.dot(right) as f32, -vector.dot(up) as f32);
        // The root keeps vectors along the view long enough to be told apart.
        let way = way * (UNIT / way.length().sqrt().max(1e-3));
        for (width, ink) in [(4.0, Color32::from_black_alpha(150)), (2.0, ink)] {
            painter.arrow(at, way, (width, ink));
        }
    };
    // Lights in one direction have one arrow.
    let mut lights: Vec<&LightSample> = surface.lights().iter().collect();
    while let Some(first) = lights.first().copied() {
        let (alike, others) = lights
            .into_iter()
            .partition::<Vec<_>, _>(|it| it.to_light == first.to_light);
        let names: Vec<&str> = alike.iter().map(|it| &*it.name).collect();
        let reflected = alike.iter().find_map(|it| it.reflected);
        let ink = light_color(world, names[0]);
        arrow("r, l reflected", ink.gamma_multiply(0.7), reflected);
        arrow(&format!("l to {}", names.join(", ")), ink, first.to_light);
        lights = others;
    }
    let sample = surface.sample.as_ref();
    arrow("o to the eye", TO_EYE, sample.map(|it| it.to_eye));
    arrow("n, the normal", NORMAL, sample.map(|it| it.normal));
}

/// The colour of the light of this name.
fn light_color(world: &World, name: &str) -> Color32 {
    let mut lights = world.query::<(&Name, &Light)>();
    let light = lights.iter().find(|(own, _)| own.0 == name);
    light.map_or(Color32::WHITE, |(_, light)| brightest(light.color))
}
