//! The picture's area: drags, clicks and the wheel over it, and the marks drawn on it.

use egui::{Color32, Event, PointerButton, Pos2, Rect, Sense, Ui, Vec2, pos2, vec2};

use super::app::App;
use super::desk::Grab;
use super::lights::Marker;
use super::pictures::divider_column;
use crate::components::{
    Inspector, Orbit, Probed, Show, Tab, ViewMode, Viewpoint, active_camera, get,
};

/// How far a drag across the picture's shorter side turns, in degrees.
const DRAG_TURN: f64 = 200.0;
/// How far beside the divider a press still moves it, in points.
const REACH: f32 = 10.0;
/// The divider stays this share of the picture's width away from either edge.
pub const DIVIDER_MARGIN: f64 = 0.02;

impl App {
    /// Lays out the picture's area in the rest of the window.
    pub fn viewport(&mut self, ui: &mut Ui) {
        let scale = ui.ctx().pixels_per_point();
        let free = ui.available_rect_before_wrap();
        let whole = |at: Pos2| (at * scale).round() / scale;
        self.place = Rect::from_min_max(whole(free.min), whole(free.max));
        let response = ui.interact(self.place, ui.id().with("picture"), Sense::click_and_drag());
        let markers = match self.look() {
            Inspector(Some(Tab::Scene)) => self.markers(),
            _ => Vec::new(),
        };
        let modifiers = ui.input(|input| input.modifiers);
        if response.drag_started_by(PointerButton::Primary) {
            let from = ui.input(|input| input.pointer.press_origin());
            self.desk.grab = self.grab(from.unwrap_or_default(), &markers);
        }
        if response.dragged_by(PointerButton::Primary) {
            let pointer = response.interact_pointer_pos().unwrap_or_default();
            self.drag(response.drag_delta(), pointer, modifiers.shift);
        } else {
            self.desk.grab = Grab::Nothing;
        }
        let pointer = response.interact_pointer_pos();
        if let Some(at) = pointer.filter(|_| response.clicked()) {
            self.click(at, &markers);
        }
        if response.hovered() {
            let turned = |event: &Event| match event {
                Event::MouseWheel { delta, .. } => delta.y,
                _ => 0.0,
            };
            let turned: f32 = ui.input(|input| input.events.iter().map(turned).sum());
            if turned.round() != 0.0 {
                self.zoom(turned.round() as i32);
            }
        }
        self.draw_over(ui, &markers);
        if self.divider().is_some() {
            self.tags(ui);
        }
    }

    /// The thing that a press at `at` catches.
    fn grab(&self, at: Pos2, markers: &[Marker]) -> Grab {
        let marker = markers.iter().find(|marker| marker.is_caught(at));
        match marker {
            Some(marker) => Grab::Light(marker.name.clone(), marker.position),
            None if self.divider().is_some_and(|x| (x - at.x).abs() < REACH) => Grab::Divider,
            None => Grab::Camera,
        }
    }

    fn drag(&mut self, by: Vec2, pointer: Pos2, in_depth: bool) {
        let size = self.picture_size();
        let pixels = by * self.scale();
        match self.desk.grab.clone() {
            Grab::Nothing => {}
            Grab::Camera => {
                let degrees = DRAG_TURN / size[0].min(size[1]) as f64;
                // The cuboid follows the mouse, so the camera goes the other way.
                let [left, down] = [f64::from(-pixels.x), f64::from(pixels.y)];
                self.orbit(left * degrees, down * degrees);
            }
            Grab::Divider => {
                let show: Show = self.look();
                let share = self.pixel_at(pointer)[0] as f64 / size[0] as f64;
                let divider = share.clamp(DIVIDER_MARGIN, 1.0 - DIVIDER_MARGIN);
                self.set_look(Show { divider, ..show });
            }
            Grab::Light(name, place) => {
                let place = self.drag_light(&name, place, pixels, in_depth);
                self.desk.grab = Grab::Light(name, place);
            }
        }
    }

    fn click(&mut self, at: Pos2, markers: &[Marker]) {
        if let Some(marker) = markers.iter().find(|marker| marker.is_caught(at)) {
            self.desk.selected = Some(("light", marker.name.clone()));
            return;
        }
        let (pixel, size) = (self.pixel_at(at), self.picture_size());
        let pixel = [0, 1].map(|axis| pixel[axis].min(size[axis] - 1));
        self.probe(self.worst_at(at).unwrap_or(pixel));
    }

    /// Moves the camera about its target, by degrees to the right and up.
    pub fn orbit(&mut self, azimuth: f64, elevation: f64) {
        let world = &self.scene.world;
        let own = Viewpoint::own(world, active_camera(world));
        let limit = "the camera stops short of the pole";
        self.change_orbit(limit, |orbit| orbit.moved(&own, azimuth, elevation));
    }

    /// Steps towards the target, or away where negative.
    pub fn zoom(&mut self, steps: i32) {
        let limits = Orbit::limits(&self.scene.world);
        let way = if steps > 0 { "closer" } else { "further" };
        let limit = format!("the camera goes no {way}");
        self.change_orbit(&limit, |orbit| orbit.zoomed(steps, &limits));
    }

    /// Changes the orbit of the active camera, or tells its limit where nothing changes.
    pub fn change_orbit(&mut self, limit: &str, change: impl FnOnce(Orbit) -> Orbit) {
        let camera = active_camera(&self.scene.world);
        let orbit: Orbit = get(&self.scene.world, camera).unwrap_or_default();
        let changed = change(orbit);
        if changed == orbit {
            return self.say(limit);
        }
        // It was just found.
        let _ = self.scene.world.insert_one(camera, changed);
    }

    /// The pixel of the picture at a place in the window.
    fn pixel_at(&self, at: Pos2) -> [usize; 2] {
        let place = (at - self.place.min) * self.scale();
        [place.x, place.y].map(|it| it.max(0.0) as usize)
    }

    /// The place in the window of the middle of a pixel.
    pub fn place_of(&self, [x, y]: [usize; 2]) -> Pos2 {
        self.place.min + vec2(x as f32 + 0.5, y as f32 + 0.5) / self.scale()
    }

    /// The first column right of the divider.
    pub fn divider_column(&self) -> usize {
        let Show { divider, .. } = self.look();
        divider_column(divider, self.picture_size()[0])
    }

    /// The divider's x in the window, where the view has one.
    fn divider(&self) -> Option<f32> {
        let show: Show = self.look();
        let x = self.place.min.x + self.divider_column() as f32 / self.scale();
        (show.mode == ViewMode::Wipe).then_some(x)
    }

    /// Draws the divider, the probed pixel with its vectors, and the lights.
    fn draw_over(&self, ui: &Ui, markers: &[Marker]) {
        let painter = ui.painter_at(self.place);
        if let Some(x) = self.divider().filter(|_| self.turn().is_none()) {
            self.draw_divider(&painter, x);
            self.draw_worst(&painter);
        }
        if let Some(pixel) = self.look::<Probed>().0 {
            let at = self.place_of(pixel);
            self.draw_arrows(&painter, at);
            draw_cross(&painter, at);
        }
        for marker in markers.iter().rev() {
            marker.draw(&painter, self.place);
        }
    }

    fn draw_divider(&self, painter: &egui::Painter, x: f32) {
        let line = self.place.y_range();
        painter.vline(x, line, (4.0, Color32::from_black_alpha(110)));
        painter.vline(x, line, (2.0, Color32::from_white_alpha(230)));
        let edge = (1.0, Color32::from_black_alpha(150));
        let middle = pos2(x, self.place.center().y);
        painter.circle(middle, 8.0, Color32::WHITE, edge);
    }
}

/// Marks a pixel, and leaves it to be seen.
fn draw_cross(painter: &egui::Painter, at: Pos2) {
    for way in [Vec2::RIGHT, Vec2::LEFT, Vec2::DOWN, Vec2::UP] {
        let line = [at + way * 3.5, at + way * 11.5];
        painter.line_segment(line, (4.0, Color32::from_black_alpha(170)));
        painter.line_segment(line, (1.5, Color32::WHITE));
    }
}
