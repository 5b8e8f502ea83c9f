//! A triangle of a scene and a pixel in, how far the pixel's centre is from the triangle's outline out.
//!
//! The renderer decides coverage on vertices snapped to 1/256 pixel, the reference on the true ones: where a centre is
//! nearer than that to an edge, the two may see different triangles, and nowhere else.
//!
//! ```text
//!   side(d) = d . (along x (middle - eye))     0 where a line of sight d from the eye meets the edge
//!   distance = |side| / |what a pixel to the right and a pixel up add to it|
//! ```
//!
//! Rule: an edge is a line through its middle here, so its length makes no difference; the picture is neither the
//! renderer's nor the reference's arithmetic.

use glam::DVec3;
use hecs::World;

use crate::components::{Mesh, Projection, TRIANGLES, Transform, View, unit};

/// How far a snapped edge may be from the true one, in pixels: 1/512 to the right and 1/512 down, rounded up.
pub const SNAP: f64 = 1.0 / 256.0;

/// The distance in pixels from the centre of pixel (`x`, `y`) to the nearest line that bounds what is seen of triangle
/// `id`: its three edges, and where the near plane cuts its face.
pub fn distance(world: &World, view: &View, id: u32, [x, y]: [usize; 2]) -> f64 {
    let mut query = world.query::<(&Transform, &Mesh)>();
    let Some((transform, mesh)) = query.iter().nth(id as usize / TRIANGLES.len()) else {
        return f64::INFINITY;
    };
    let to_own = transform.axes().transpose();
    let [right, up, forward] = view.viewpoint.axes().map(|axis| to_own * axis);
    let pitch = view.viewpoint.pixel_pitch(view.projection, view.size[1]);
    let across = (x as f64 + 0.5 - view.size[0] as f64 / 2.0) * pitch;
    let above = (view.size[1] as f64 / 2.0 - y as f64 - 0.5) * pitch;
    let aside = right * across + up * above;
    let eye = to_own * (view.viewpoint.position - transform.position);
    let steps = [right, up].map(|step| step * pitch);
    // (eye, direction) of the line of sight, and what one pixel adds to them.
    let (sight, changes) = match view.projection {
        Projection::Perspective => (
            (eye, forward + aside),
            steps.map(|step| (DVec3::ZERO, step)),
        ),
        Projection::Orthographic => (
            (eye + aside, forward),
            steps.map(|step| (step, DVec3::ZERO)),
        ),
    };
    let gap = |value: f64, change: [f64; 2]| value.abs() / change[0].hypot(change[1]);
    let triangle = id as usize % TRIANGLES.len();
    let corners = TRIANGLES[triangle].map(|corner| mesh.corners[usize::from(corner)]);
    let edges = (0..3).map(|index| {
        let (from, to) = (corners[index], corners[(index + 1) % 3]);
        let (middle, along) = ((from + to) / 2.0, unit(to - from));
        let side = |eye: DVec3, direction: DVec3| direction.dot(along.cross(middle - eye));
        let moment = |(eye, direction): (DVec3, DVec3)| match view.projection {
            Projection::Perspective => direction.dot(along.cross(middle - sight.0)),
            Projection::Orthographic => sight.1.dot(along.cross(-eye)),
        };
        gap(side(sight.0, sight.1), changes.map(moment))
    });
    let axis = triangle / 4;
    let plane = corners[0][axis];
    let near = view.viewpoint.near();
    let cut = |(eye, direction): (DVec3, DVec3)| near * direction[axis] + eye[axis];
    let cut = gap(cut(sight) - plane, changes.map(cut));
    edges.fold(cut, f64::min)
}
