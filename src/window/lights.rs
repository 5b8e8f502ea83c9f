//! The lights over the picture: discs that can be dragged, arrows to those out of sight, and the vectors at the probed pixel.

use egui::{Align2, Color32, Pos2, Rect, Vec2, vec2};
use glam::DVec3;

use super::app::App;
use super::widgets::tag;
use crate::components::range::Coordinate;
use crate::components::{
    Lens, Light, LightKind, Name, Transform, Viewpoint, active_camera, ordered,
};
use crate::frame::display_pixel;
use crate::paint::color;

/// No more discs than this are drawn.
const MOST: usize = 100;
const RADIUS: f32 = 7.0;
/// The length of a unit vector across the view, in points.
const UNIT: f32 = 110.0;
const NORMAL: Color32 = Color32::WHITE;
const TO_EYE: Color32 = Color32::from_rgb(0x60, 0xc8, 0xff);

/// The disc of a light, or an arrow at the border towards one out of sight.
pub struct Marker {
    pub name: String,
    /// The light's place, in world units.
    pub position: DVec3,
    /// The middle of its disc in the window.
    pub at: Pos2,
    /// The direction of a light out of sight.
    way: Option<Vec2>,
    color: Color32,
    is_on: bool,
}

impl Marker {
    /// Whether a press at `at` catches it.
    pub fn is_caught(&self, at: Pos2) -> bool {
        self.at.distance(at) < RADIUS + 2.0
    }

    /// Draws it and its name inside of `area`.
    pub fn draw(&self, painter: &egui::Painter, area: Rect) {
        let dark = (1.5, Color32::from_gray(16));
        let hollow = Color32::from_black_alpha(120);
        match self.way {
            Some(way) => {
                let from = self.at - way * RADIUS;
                painter.arrow(from, way * 2.0 * RADIUS, (3.0, self.color));
            }
            None if self.is_on => drop(painter.circle(self.at, RADIUS, self.color, dark)),
            None => drop(painter.circle(self.at, RADIUS, hollow, (2.0, self.color))),
        }
        let (align, side) = if self.at.x > area.center().x {
            (Align2::RIGHT_CENTER, -1.0)
        } else {
            (Align2::LEFT_CENTER, 1.0)
        };
        let ink = [Color32::GRAY, Color32::WHITE][usize::from(self.is_on)];
        let at = self.at + vec2(side * (RADIUS + 8.0), 0.0);
        tag(painter, align, at, &self.name, ink);
    }
}

impl App {
    /// The markers of all lights with a position. Markers of one position stand below one another.
    pub fn markers(&self) -> Vec<Marker> {
        let lens = Lens::new(&self.view());
        let world = &self.scene.world;
        let mut markers: Vec<Marker> = Vec::new();
        for entity in ordered::<Light>(world) {
            let mut query = world.query_one::<(&Name, &Transform, &Light)>(entity);
            let found = query.get().ok();
            let Some((name, transform, light)) =
                found.filter(|it| it.2.kind != LightKind::Ambient && markers.len() < MOST)
            else {
                continue;
            };
            let (mut at, way) = self.place_of_light(transform.position, &lens);
            while markers.iter().any(|other| other.at.distance(at) < RADIUS) {
                at.y += 2.0 * RADIUS + 4.0;
            }
            markers.push(Marker {
                name: name.0.clone(),
                position: transform.position,
                at,
                way,
                color: brightest(light.color),
                is_on: light.on,
            });
        }
        markers
    }

    /// The place of a light's marker, and the direction towards a light out of sight.
    fn place_of_light(&self, position: DVec3, lens: &Lens) -> (Pos2, Option<Vec2>) {
        let seen = lens.seen(position);
        let border = self.place.shrink(3.0 * RADIUS);
        if seen.z > lens.near {
            let [x, y] = lens.pixel(lens.homogeneous(seen));
            let at = self.place.min + vec2(x as f32, y as f32) / self.scale();
            if border.contains(at) {
                return (at, None);
            }
        }
        let way = vec2(seen.x as f32, -seen.y as f32).normalized();
        let half = border.size() / 2.0;
        let share = (half.x / way.x.abs()).min(half.y / way.y.abs());
        let share = if share.is_finite() { share } else { 0.0 };
        (border.center() + way * share, Some(way))
    }

    /// Moves a light from a place by pixels of the picture, in depth where asked for, and returns where to. It stands at
    /// that place rounded to what a pixel can mean.
    pub fn drag_light(&mut self, name: &str, from: DVec3, by: Vec2, in_depth: bool) -> DVec3 {
        let lens = Lens::new(&self.view());
        let [right, up, forward] = lens.axes;
        let [across, down] = [by.x, by.y].map(f64::from);
        let way = if in_depth {
            forward * -down
        } else {
            right * across - up * down
        };
        let pixel = lens.pitch * lens.homogeneous(lens.seen(from)).z.abs();
        let step = 10.0_f64.powf(pixel.log10().floor());
        let moved = from + way * pixel;
        let rounded = moved
            .to_array()
            .map(|it| (it / step).round() / step.recip());
        if !rounded.iter().all(|it| Coordinate::RANGE.contains(it)) {
            return from;
        }
        let lights = self
            .scene
            .world
            .query_mut::<(&Name, &mut Transform, &Light)>();
        for (_, transform, _) in lights.into_iter().filter(|(own, ..)| own.0 == name) {
            transform.position = rounded.into();
        }
        moved
    }

    /// Draws n, o, and l and r of each place with lights, from the probed pixel at `at`, as they lie across the view.
    pub fn draw_arrows(&self, painter: &egui::Painter, at: Pos2) {
        let probed = self.probed().filter(|_| self.facts.section.is_current);
        let Some(surface) = probed.and_then(|probe| probe.surface.as_ref()) else {
            return;
        };
        let world = &self.scene.world;
        let [right, up, _] = Viewpoint::of(world, active_camera(world)).axes();
        let arrow = |name: &str, ink: Color32, vector: Option<DVec3>| {
            let Some(vector) = vector else {
                return;
            };
            let way = vec2(vector.dot(right) as f32, -vector.dot(up) as f32) * UNIT;
            for (width, ink) in [(4.0, Color32::from_black_alpha(150)), (2.0, ink)] {
                painter.arrow(at, way, (width, ink));
            }
            let end = at + way + way.normalized() * 12.0;
            tag(painter, Align2::CENTER_CENTER, end, name, ink);
        };
        let mut places: Vec<DVec3> = Vec::new();
        for light in &surface.lights {
            let Some(to_light) = light.to_light.filter(|it| !places.contains(it)) else {
                continue;
            };
            places.push(to_light);
            let ink = self.light_color(&light.name);
            arrow("r", ink.gamma_multiply(0.7), light.reflected);
            arrow("l", ink, Some(to_light));
        }
        arrow("o", TO_EYE, surface.to_eye);
        arrow("n", NORMAL, surface.normal);
    }

    /// The colour of the light of this name.
    pub fn light_color(&self, name: &str) -> Color32 {
        let mut lights = self.scene.world.query::<(&Name, &Light)>();
        let light = lights.iter().find(|(own, _)| own.0 == name);
        light.map_or(Color32::WHITE, |(_, light)| brightest(light.color))
    }
}

/// A light's colour with its largest channel at full strength.
pub fn brightest(channels: DVec3) -> Color32 {
    let largest = channels.max_element();
    let levels = if largest > 0.0 {
        channels / largest * 255.0
    } else {
        DVec3::splat(128.0)
    };
    color(display_pixel(levels.to_array()))
}
