//! The lights of the scene and the view -> discs in the picture, to be seen and dragged.
//!
//! Rules: lights at one place have one disc. A disc is filled where a light there is on and nothing hides it.

use super::lines::brightest;
use crate::canvas::{Canvas, Face, Ink, Point, Rect};
use crate::components::{
    Lens, Light, LightKind, Mesh, Name, Projection, Transform, WorldTransform,
};
use crate::window::session::Session;
use glam::DVec3;

/// No more discs than this are drawn.
const MOST: usize = 100;
const EDGE: Ink = Ink::solid(0x0010_1216);
const RING: Ink = Ink::solid(0x00ff_ffff);
const NAME: Ink = Ink::solid(0x00e8_eaed);
const NAME_DIM: Ink = Ink::solid(0x00a8_afb7);
const PANE: Ink = Ink::glass(0x0010_1216, 170);

/// The disc of the lights at one place.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// Its middle: the pixel of the picture, and in a layout the place in the window.
    pub at: Point,
    /// The first light there, by its place in the file.
    pub light: usize,
    pub name: String,
    /// 0x00RRGGBB.
    pub color: u32,
    /// Whether a light there is on and not hidden by a cuboid.
    pub is_lit: bool,
}

/// The discs in a picture of `size` pixels, in the order of the file.
pub fn markers(session: &Session, size: [usize; 2]) -> Vec<Marker> {
    let lens = Lens::new(&session.view(size));
    let mut markers: Vec<Marker> = Vec::new();
    let world = &session.scene.world;
    for (index, &entity) in session.scene.lights.iter().enumerate() {
        let mut query = world.query_one::<(&Name, &Transform, &Light)>(entity);
        let Ok((name, transform, light)) = query.get() else {
            continue;
        };
        let Some(at) = seen_at(transform.position, &lens) else {
            continue;
        };
        if light.kind == LightKind::Ambient || markers.len() == MOST {
            continue;
        }
        let is_lit = light.on && !is_hidden(session, transform.position, &lens);
        match markers.iter_mut().find(|it| it.at == at) {
            Some(marker) => {
                marker.name += ", ";
                marker.name += &name.0;
                marker.is_lit |= is_lit;
            }
            None => markers.push(Marker {
                at,
                light: index,
                name: name.0.clone(),
                color: brightest(light.color),
                is_lit,
            }),
        }
    }
    markers
}

/// The pixel in which a point is seen; `None` for one behind the near plane or beside the picture.
fn seen_at(point: DVec3, lens: &Lens) -> Option<Point> {
    let seen = lens.seen(point);
    let [x, y] = lens.pixel(lens.homogeneous(seen));
    let [width, height] = lens.half.map(|half| 2.0 * half);
    let inside = (0.0..width).contains(&x) && (0.0..height).contains(&y);
    (seen.z > lens.near && inside).then_some([x as i32, y as i32])
}

/// Whether a cuboid stands between the viewer and a point.
fn is_hidden(session: &Session, point: DVec3, lens: &Lens) -> bool {
    let eye = match lens.projection {
        Projection::Perspective => lens.eye,
        Projection::Orthographic => point - lens.axes[2] * lens.seen(point).z,
    };
    let mut cuboids = session.scene.world.query::<(&WorldTransform, &Mesh)>();
    cuboids.iter().any(|(place, mesh)| {
        let to_cuboid = place.axes.transpose();
        let from = to_cuboid * (eye - place.position);
        let way = to_cuboid * (point - eye);
        // The part of the way, from 0 to 1, that lies between each pair of opposite faces (Kay and Kajiya 1986).
        let one = (-mesh.corners[7] - from) / way;
        let other = (mesh.corners[7] - from) / way;
        let enters = one.min(other).max_element().max(0.0);
        let leaves = one.max(other).min_element().min(1.0);
        enters < leaves
    })
}

/// How far from a disc's middle a press catches it, in pixels.
pub fn radius(face: Face) -> i32 {
    face.height() / 2
}

impl Marker {
    /// The disc in the window, and its name in front of it where it would stand out of `picture` behind it.
    fn place(&self, picture: Rect, face: Face) -> [Rect; 2] {
        let [x, y] = self.at;
        let (radius, gap) = (radius(face), face.advance() / 2);
        let disc = Rect::new(x - radius, y - radius, 2 * radius, 2 * radius);
        let width = face.width(self.name.chars().count());
        let behind = disc.right() + gap;
        let left = if behind + width > picture.right() {
            disc.x - gap - width
        } else {
            behind
        };
        let name = Rect::new(left, y - face.height() / 2, width, face.height());
        [disc, name]
    }

    /// What it takes of the window.
    pub fn rect(&self, picture: Rect, face: Face) -> Rect {
        let [disc, name] = self.place(picture, face);
        let x = disc.x.min(name.x);
        Rect::new(x, disc.y, disc.right().max(name.right()) - x, disc.height)
    }

    /// Draws the disc and its name.
    pub fn draw(&self, canvas: &mut Canvas, picture: Rect, face: Face) {
        let [disc, name] = self.place(picture, face);
        canvas.rounded(disc, disc.width / 2, EDGE);
        let inner = disc.inset(2);
        let color = Ink::solid(self.color);
        if self.is_lit {
            canvas.rounded(inner, inner.width / 2, color);
            canvas.outline(inner, inner.width / 2, 1.0, RING);
        } else {
            canvas.outline(inner, inner.width / 2, 2.0, color);
        }
        canvas.fill(name, PANE);
        let ink = if self.is_lit { NAME } else { NAME_DIM };
        canvas.text(face, [name.x, name.y], ink, &self.name);
    }
}
