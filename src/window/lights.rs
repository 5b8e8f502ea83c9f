//! The lights over the picture: discs of those in sight, which can be dragged, and arrows towards the others.

use egui::emath::round_to_decimals;
use egui::{Align2, Color32, Pos2, Rect, Sense, Ui, Vec2, vec2};
use glam::DVec3;
use hecs::World;

use super::app::App;
use super::canvas::Canvas;
use super::labels::ROOM;
use super::widgets::tag;
use crate::components::numbers::range_of;
use crate::components::{Lens, Light, LightKind, Name, Transform, View, in_file_order};
use crate::output::paint::color;
use crate::systems::frame::display_pixel;

/// No more discs than this are drawn.
const MOST: usize = 100;
const RADIUS: f32 = 7.0;
const AWAY: &str =
    "It is outside of the picture. Zoom out (-) to drag it, or change its numbers (E).";

/// How far the middle of an arrow's head is from the edge of the picture, in points, and its length.
const EDGE: f32 = 12.0;
const ARROW: f32 = 30.0;

/// The disc of lights at one place, or the arrow towards them.
pub struct Lamp {
    pub names: Vec<String>,
    /// The names of those that are on.
    lit: Vec<String>,
    position: DVec3,
    /// Its middle in the window; of an arrow the head.
    pub at: Pos2,
    /// The way of the arrow, of length 1; `None` for a disc.
    pub way: Option<Vec2>,
    color: Color32,
}

impl Lamp {
    /// Draws it and its names inside of `area`.
    fn draw(&self, painter: &egui::Painter, area: Rect) {
        let on = (self.color, (1.5, Color32::from_gray(16)));
        let off = (Color32::from_black_alpha(120), (2.0, self.color));
        let (fill, line) = if self.lit.is_empty() { off } else { on };
        let mut at = self.at;
        if let Some(way) = self.way {
            at -= ARROW * way;
            for (width, ink) in [(6.0, Color32::from_gray(40)), (3.0, self.color)] {
                painter.arrow(at, ARROW * way, (width, ink));
            }
        } else {
            painter.circle(at, RADIUS, fill, line);
        }
        if area.width() < ROOM {
            return;
        }
        let (align, side) = if self.at.x > area.center().x {
            (Align2::RIGHT_CENTER, -1.0)
        } else {
            (Align2::LEFT_CENTER, 1.0)
        };
        let (ink, names) = if self.lit.is_empty() {
            (Color32::GRAY, &self.names)
        } else {
            (Color32::WHITE, &self.lit)
        };
        let at = at + vec2(side * (RADIUS + 8.0), 0.0);
        let plural = if names.len() > 1 { "s" } else { "" };
        let text = format!("lamp{plural}: {}", names.join(", "));
        tag(painter, align, at, &text, ink);
    }
}

/// Lays out the arrows towards those of the lamps that are outside of the picture, which is at `place`.
pub fn arrows(ui: &Ui, lamps: &[Lamp], place: Rect) {
    for lamp in lamps {
        if let Some(way) = lamp.way {
            let id = ui.id().with(&lamp.names[0]);
            let own = Rect::from_two_pos(lamp.at, lamp.at - ARROW * way).expand(RADIUS);
            ui.interact(own, id, Sense::hover()).on_hover_text(AWAY);
            lamp.draw(ui.painter(), place);
        }
    }
}

impl App {
    /// Lays out the discs of those of the lamps that are in sight. A drag moves their lights across the view; both a drag and
    /// a click select the first.
    pub(super) fn discs(&mut self, ui: &Ui, lamps: &[Lamp]) {
        let view = self.view();
        let world = &mut self.document.scene.world;
        for lamp in lamps.iter().filter(|it| it.way.is_none()) {
            let own = Rect::from_center_size(lamp.at, Vec2::splat(2.0 * RADIUS));
            let disc = ui.interact(own, ui.id().with(&lamp.names[0]), Sense::click_and_drag());
            if disc.dragged() {
                let by = disc.drag_delta() * self.canvas.scale;
                for name in &lamp.names {
                    drag_light(world, &view, name, by);
                }
            }
            if disc.clicked() || disc.drag_started() {
                self.desk.select::<Light>(world, "light", &lamp.names[0]);
            }
            lamp.draw(ui.painter(), self.canvas.place);
        }
    }
}

/// The lamps of a scene: lights at one place are one.
pub fn lamps(world: &World, view: &View, canvas: &Canvas) -> Vec<Lamp> {
    type Parts<'a> = (&'a Name, &'a Transform, &'a Light);
    let lens = Lens::new(view);
    let mut lamps: Vec<Lamp> = Vec::new();
    let lights = in_file_order::<Parts, _>(world, |(name, transform, light)| {
        let is_somewhere = light.kind != LightKind::Ambient;
        is_somewhere.then(|| (name.0.clone(), transform.position, *light))
    });
    for (name, position, light) in lights.into_iter().flatten().take(MOST) {
        if let Some(lamp) = lamps.iter_mut().find(|it| it.position == position) {
            lamp.lit.extend(light.on.then(|| name.clone()));
            lamp.names.push(name);
            continue;
        }
        let (at, way) = place_of(position, &lens, canvas);
        lamps.push(Lamp {
            lit: Vec::from_iter(light.on.then(|| name.clone())),
            names: vec![name],
            position,
            at,
            way,
            color: brightest(light.color),
        });
    }
    lamps
}

/// The place in the window of a point of the scene; of one outside of the picture that of an arrow at its edge, and its way.
fn place_of(position: DVec3, lens: &Lens, canvas: &Canvas) -> (Pos2, Option<Vec2>) {
    let seen = lens.seen(position);
    let is_before = seen.z > lens.near;
    let at = canvas.place_at(lens.pixel(lens.homogeneous(seen)));
    if is_before && canvas.place.contains(at) {
        return (at, None);
    }
    let middle = canvas.place.center();
    let towards = if is_before {
        at - middle
    } else {
        vec2(seen.x as f32, -seen.y as f32)
    };
    let way = towards.normalized();
    let room = canvas.place.shrink(EDGE).size() / 2.0;
    let length = (room.x / way.x.abs()).min(room.y / way.y.abs());
    (middle + way * length, Some(way))
}

/// Moves a light in sight by pixels of the picture across the view. A position beyond its range is refused.
pub fn drag_light(world: &mut World, view: &View, name: &str, by: Vec2) {
    let lens = Lens::new(view);
    let [right, up, _] = lens.axes;
    let way = right * f64::from(by.x) - up * f64::from(by.y);
    let lights = world.query_mut::<(&Name, &mut Transform, &Light)>();
    for (_, Transform { position, .. }, _) in lights.into_iter().filter(|it| it.0.0 == name) {
        let pixel = lens.pitch * lens.homogeneous(lens.seen(*position)).z.abs();
        // Rounded to a tenth of a pixel or less, so that the numbers are short.
        let digits = (1.0 - pixel.log10().floor()).clamp(0.0, 300.0) as usize;
        let exact = (*position + way * pixel).to_array();
        let moved = exact.map(|it| round_to_decimals(it, digits));
        if moved.iter().all(|it| range_of("position").contains(it)) {
            *position = DVec3::from(moved);
        }
    }
}

/// A light's colour with its largest channel at full strength.
pub fn brightest(channels: DVec3) -> Color32 {
    let largest = channels.max_element().max(f64::MIN_POSITIVE);
    color(display_pixel((channels / largest * 255.0).to_array()))
}
