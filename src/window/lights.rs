//! The lights over the picture: discs that can be dragged, and the vectors at the probed pixel.

use egui::emath::round_to_decimals;
use egui::{Align2, Color32, Pos2, Rect, Sense, Ui, Vec2, vec2};
use glam::DVec3;

use super::app::App;
use super::widgets::tag;
use crate::components::range::Coordinate;
use crate::components::{
    Camera, Lens, Light, LightKind, Name, Transform, active_camera, in_file_order, length,
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

/// The disc of a light. That of a light out of sight is small, and at the border of the picture.
pub struct Disc {
    pub name: String,
    /// Its middle in the window.
    pub at: Pos2,
    /// The place of a light out of sight, whose disc is at the border: its own, or the middle of the picture if it is not in
    /// front of the near plane.
    own: Option<Pos2>,
    color: Color32,
    is_on: bool,
}

impl Disc {
    /// Draws it and its name inside of `area`.
    fn draw(&self, painter: &egui::Painter, area: Rect) {
        let on = (self.color, (1.5, Color32::from_gray(16)));
        let off = (Color32::from_black_alpha(120), (2.0, self.color));
        let (fill, line) = if self.is_on { on } else { off };
        let is_in_sight = self.own.is_none();
        let radius = if is_in_sight { RADIUS } else { RADIUS / 2.0 };
        painter.circle(self.at, radius, fill, line);
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
    /// Lays out the discs of the lights. A drag moves its light across the view, with Shift in depth; both
    /// a drag and a click select it.
    pub fn discs(&mut self, ui: &Ui) {
        let in_depth = ui.input(|input| input.modifiers.shift);
        for light in self.lights() {
            let place = Rect::from_center_size(light.at, Vec2::splat(2.0 * RADIUS));
            let disc = ui.interact(place, ui.id().with(&light.name), Sense::click_and_drag());
            if disc.dragged() {
                // A light out of sight first comes to its disc.
                if let Some(own) = light.own.filter(|_| disc.drag_started()) {
                    self.drag_light(&light.name, (light.at - own) * self.scale(), false);
                }
                self.drag_light(&light.name, disc.drag_delta() * self.scale(), in_depth);
            }
            if disc.clicked() || disc.drag_started() {
                self.select::<Light>("light", &light.name);
            }
            light.draw(ui.painter(), self.place);
        }
    }

    /// The discs of the lights with a position. Those at one place stand below one another.
    pub fn lights(&self) -> Vec<Disc> {
        type Parts<'a> = (&'a Name, &'a Transform, &'a Light);
        let lens = Lens::new(&self.view());
        let lights = in_file_order::<Parts, _>(&self.scene.world, |(name, transform, light)| {
            (light.kind != LightKind::Ambient).then(|| {
                let (at, own) = self.place_of_light(transform.position, &lens);
                Disc {
                    name: name.0.clone(),
                    at,
                    own,
                    color: brightest(light.color),
                    is_on: light.on,
                }
            })
        });
        let mut discs: Vec<Disc> = Vec::new();
        for mut disc in lights.into_iter().flatten().take(MOST) {
            let covers = |at: Pos2| move |other: &Disc| other.at.distance(at) < RADIUS;
            while discs.iter().any(covers(disc.at)) {
                disc.at.y += 2.0 * RADIUS + 4.0;
            }
            discs.push(disc);
        }
        discs
    }

    /// The place of a light's disc in the window, and that of the light if it is out of sight.
    fn place_of_light(&self, position: DVec3, lens: &Lens) -> (Pos2, Option<Pos2>) {
        let border = self.place.shrink(3.0 * RADIUS);
        // A tiny picture has no room between its borders.
        let within = |at: Pos2| at.max(border.min).min(border.max);
        let seen = lens.seen(position);
        if seen.z > lens.near {
            let [x, y] = lens.pixel(lens.homogeneous(seen));
            let own = self.place.min + vec2(x as f32, y as f32) / self.scale();
            let is_out = within(own) != own;
            return (within(own), is_out.then_some(own));
        }
        let way = vec2(seen.x as f32, -seen.y as f32).normalized();
        let beyond = border.center() + way * border.size().max_elem();
        (within(beyond), Some(self.place.center()))
    }

    /// Moves a light by pixels of the picture across the view, or in depth. A position beyond its range is refused.
    ///
    /// A light that is not in front of the near plane first comes to the middle of the view: half as far away as the camera's
    /// target, or twice as far as the near plane if that is more.
    pub fn drag_light(&mut self, name: &str, by: Vec2, in_depth: bool) {
        let view = self.view();
        let lens = Lens::new(&view);
        let half_way = length(view.camera.target - view.camera.position) / 2.0;
        let [right, up, forward] = lens.axes;
        let [across, down] = [by.x, by.y].map(f64::from);
        let aside = right * across - up * down;
        let way = if in_depth { forward * -down } else { aside };
        let lights = (self.scene.world).query_mut::<(&Name, &mut Transform, &Light)>();
        for (_, Transform { position, .. }, _) in lights.into_iter().filter(|it| it.0.0 == name) {
            if !in_depth && lens.seen(*position).z <= lens.near {
                *position = lens.eye + forward * half_way.max(2.0 * lens.near);
            }
            let pixel = lens.pitch * lens.homogeneous(lens.seen(*position)).z.abs();
            // Rounded to a tenth of a pixel or less, so that the numbers are short.
            let digits = (1.0 - pixel.log10().floor()).clamp(0.0, 300.0) as usize;
            let moved = (*position + way * pixel).to_array();
            let moved = moved.map(|it| round_to_decimals(it, digits));
            if moved.iter().all(|it| Coordinate::RANGE.contains(it)) {
                *position = DVec3::from(moved);
            }
        }
    }

    /// Draws n, o, and the l and r of each light, from the probed pixel at `at`, as they are seen in the view.
    pub fn draw_arrows(&self, painter: &egui::Painter, at: Pos2) {
        let probed = self.probed().filter(|_| self.facts.section.is_current);
        let Some(surface) = probed.and_then(|probe| probe.surface.as_ref()) else {
            return;
        };
        let world = &self.scene.world;
        let [right, up, _] = Camera::of(world, active_camera(world)).axes();
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
        for light in surface.lights() {
            let Some(to_light) = light.to_light.filter(|it| !places.contains(it)) else {
                continue;
            };
            places.push(to_light);
            let ink = self.light_color(&light.name);
            arrow("r", ink.gamma_multiply(0.7), light.reflected);
            arrow("l", ink, Some(to_light));
        }
        let sample = surface.sample.as_ref();
        arrow("o", TO_EYE, sample.map(|it| it.to_eye));
        arrow("n", NORMAL, sample.map(|it| it.normal));
    }

    /// The colour of the light of this name.
    fn light_color(&self, name: &str) -> Color32 {
        let mut lights = self.scene.world.query::<(&Name, &Light)>();
        let light = lights.iter().find(|(own, _)| own.0 == name);
        light.map_or(Color32::WHITE, |(_, light)| brightest(light.color))
    }
}

/// A light's colour with its largest channel at full strength.
fn brightest(channels: DVec3) -> Color32 {
    let largest = channels.max_element().max(f64::MIN_POSITIVE);
    color(display_pixel((channels / largest * 255.0).to_array()))
}
