//! A textbook's implementation of the model with 256 bits.
//!
//! All coordinates are in world space. A line of sight is intersected with the plane of a face, the areas of three
//! triangles are the weights of the corners, and the model is evaluated term by term. No code is shared with the
//! reference.

use std::ops::{Add, Mul, Neg, Sub};

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

use crate::support::prelude::*;

/// A float of [`BITS`] bits.
pub type Big = FBig<HalfEven, 2>;

const BITS: usize = 256;

/// A number with all its bits.
pub fn big(x: f64) -> Big {
    let exact = Big::try_from(x).expect("a finite number");
    exact.with_precision(BITS).value()
}

/// A number >= 0 to the power of an exponent >= 0.
pub fn power(base: &Big, exponent: f64) -> Big {
    if exponent == 0.0 {
        big(1.0)
    } else if *base == Big::ZERO {
        base.clone()
    } else {
        (base.ln() * big(exponent)).exp()
    }
}

/// Sine and cosine of an angle in degrees.
pub fn sine_and_cosine(degrees: f64) -> [Big; 2] {
    let angle = big(degrees) * Big::pi(BITS) / big(180.0);
    [angle.sin(), angle.cos()]
}

/// x, y and z, or red, green and blue.
type Vector = [Big; 3];

fn exact(v: DVec3) -> Vector {
    v.to_array().map(big)
}

fn zip(a: &Vector, b: &Vector, of: impl Fn(Big, Big) -> Big) -> Vector {
    std::array::from_fn(|i| of(a[i].clone(), b[i].clone()))
}

fn plus(a: &Vector, b: &Vector) -> Vector {
    zip(a, b, Big::add)
}

fn minus(a: &Vector, b: &Vector) -> Vector {
    zip(a, b, Big::sub)
}

fn times(a: &Vector, factor: &Big) -> Vector {
    a.clone().map(|x| x * factor.clone())
}

fn dot(a: &Vector, b: &Vector) -> Big {
    let [x, y, z] = zip(a, b, Big::mul);
    x + y + z
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|i| {
        let [j, k] = [(i + 1) % 3, (i + 2) % 3];
        a[j].clone() * b[k].clone() - a[k].clone() * b[j].clone()
    })
}

fn unit(v: &Vector) -> Vector {
    let length = dot(v, v).sqrt();
    v.clone().map(|x| x / length.clone())
}

type Cuboid<'a> = (
    &'a Transform,
    &'a Mesh,
    &'a Material,
    &'a NormalMode,
    &'a ShadingMode,
    &'a Segments,
);

/// A scene and a view of it.
pub struct Scene<'a> {
    view: &'a View,
    cuboids: Vec<([Corner; 8], Material, NormalMode, ShadingMode, usize)>,
    lights: Vec<(Vector, Light)>,
    /// The view direction, and the change per pixel right and up of a direction (perspective) or a position
    /// (orthographic).
    forward: Vector,
    right: Vector,
    up: Vector,
}

/// The position of a cuboid's corner in the world.
#[derive(Clone)]
struct Corner {
    place: Vector,
    normal: Vector,
}

impl<'a> Scene<'a> {
    pub fn new(world: &World, view: &'a View) -> Self {
        let mut cuboids = world.query::<Cuboid>();
        let mut lights = world.query::<(&Transform, &Light)>();
        let camera = &view.camera;
        let forward = unit(&minus(&exact(camera.target), &exact(view.camera.position)));
        let right = unit(&cross(&forward, &exact(camera.up)));
        let up = cross(&right, &forward);
        let seen = match view.projection {
            Projection::Perspective => {
                let [sin, cos] = sine_and_cosine(camera.fov / 2.0);
                big(2.0) * sin / cos
            }
            Projection::Orthographic => big(camera.height),
        };
        let pixel = seen / big(view.size[1] as f64);
        Scene {
            view,
            cuboids: cuboids
                .iter()
                .map(|(transform, mesh, material, normals, mode, segments)| {
                    let corners = mesh.corners.map(|corner| Corner::new(transform, corner));
                    let segments = view.segments(*segments).count();
                    (corners, *material, *normals, *mode, segments)
                })
                .collect(),
            lights: lights
                .iter()
                .filter(|(_, light)| light.on)
                .map(|(transform, light)| (exact(transform.position), *light))
                .collect(),
            right: times(&right, &pixel),
            up: times(&up, &pixel),
            forward,
        }
    }

    /// The levels of a face (cuboid * 6 + face) where the line of sight of a pixel intersects its plane.
    pub fn levels(&self, face: usize, [x, y]: [usize; 2]) -> Vector {
        let (corners, material, normals, mode, segments) = &self.cuboids[face / 6];
        let all = corners;
        let [from, along] = self.sight(x, y);
        let triangles = [0, 1].map(|second| {
            TRIANGLES[2 * (face % 6) + second].map(|corner| &corners[usize::from(corner)])
        });
        let [a, b, c] = &triangles[0];
        let across = cross(&minus(&b.place, &a.place), &minus(&c.place, &a.place));
        let depth = dot(&minus(&a.place, &from), &across) / dot(&along, &across);
        let place = plus(&from, &times(&along, &depth));
        let weights_on = |triangle: &[&Corner; 3]| {
            let twice_area = |a: &Vector, b: &Vector, c: &Vector| {
                dot(&cross(&minus(b, a), &minus(c, a)), &across)
            };
            let [a, b, c] = triangle.map(|corner| &corner.place);
            let whole = twice_area(a, b, c);
            [
                twice_area(&place, b, c),
                twice_area(a, &place, c),
                twice_area(a, b, &place),
            ]
            .map(|part| part / whole.clone())
        };
        let is_inside = weights_on(&triangles[0])
            .iter()
            .all(|weight| *weight >= big(0.0));
        let corners = &triangles[usize::from(!is_inside)];
        let weights = weights_on(corners);
        let blend = |of: &dyn Fn(&Corner) -> Vector| {
            let parts: [_; 3] = std::array::from_fn(|i| times(&of(corners[i]), &weights[i]));
            plus(&plus(&parts[0], &parts[1]), &parts[2])
        };
        // The corners are counter-clockwise seen from outside.
        let normal_of = |corner: &Corner| match normals {
            NormalMode::Corner => corner.normal.clone(),
            NormalMode::Face => unit(&across),
        };
        let to_eye = |place: &Vector| match self.view.projection {
            Projection::Perspective => unit(&minus(&from, place)),
            Projection::Orthographic => self.forward.clone().map(Big::neg),
        };
        let lit =
            |place: &Vector, normal: &Vector| self.lit(material, place, normal, &to_eye(place));
        let mode = self.view.shading.unwrap_or(*mode);
        if mode == ShadingMode::Flat {
            let face = FACES[face % 6].map(|corner| &all[usize::from(corner)]);
            let sum = |of: &dyn Fn(&Corner) -> Vector| {
                let [a, b, c, d] = face.map(of);
                plus(&plus(&a, &b), &plus(&c, &d))
            };
            let middle = times(&sum(&|corner| corner.place.clone()), &big(0.25));
            return lit(&middle, &unit(&sum(&normal_of)));
        }
        if mode == ShadingMode::Gouraud {
            if *segments > 1 {
                let face = FACES[face % 6].map(|corner| all[usize::from(corner)].clone());
                let parts = weighted_vertices(&face, &place, *segments).map(|(vertex, weight)| {
                    times(&lit(&vertex.place, &unit(&normal_of(&vertex))), &weight)
                });
                return plus(&plus(&parts[0], &parts[1]), &parts[2]);
            }
            return blend(&|corner| lit(&corner.place, &normal_of(corner)));
        }
        let normal = blend(&normal_of);
        let place = blend(&|corner| corner.place.clone());
        lit(&place, &unit(&normal))
    }

    /// The start and direction of the line of sight of a pixel.
    fn sight(&self, x: usize, y: usize) -> [Vector; 2] {
        let eye = exact(self.view.camera.position);
        let [width, height] = self.view.size.map(|pixels| pixels as f64);
        let moved = plus(
            &times(&self.right, &big(x as f64 + 0.5 - width / 2.0)),
            &times(&self.up, &big(height / 2.0 - y as f64 - 0.5)),
        );
        match self.view.projection {
            Projection::Perspective => [eye, plus(&self.forward, &moved)],
            Projection::Orthographic => [plus(&eye, &moved), self.forward.clone()],
        }
    }

    /// The model at a point.
    fn lit(&self, material: &Material, place: &Vector, normal: &Vector, to_eye: &Vector) -> Vector {
        let zero = big(0.0);
        let mut levels = [(); 3].map(|()| zero.clone());
        for (position, light) in &self.lights {
            let to_light = unit(&minus(position, place));
            let facing = dot(normal, &to_light);
            let (coefficient, share) = match light.kind {
                LightKind::Ambient => (material.ambient, big(1.0)),
                LightKind::Diffuse if facing > zero => (material.diffuse, facing),
                LightKind::Specular if facing > zero => {
                    let mirrored = times(normal, &(big(2.0) * facing));
                    let along = dot(to_eye, &minus(&mirrored, &to_light));
                    let base = if along > zero { along } else { zero.clone() };
                    (material.specular, power(&base, material.shininess))
                }
                LightKind::Diffuse | LightKind::Specular => continue,
            };
            let sent = times(&exact(light.color), &big(light.intensity));
            let sent = times(&sent, &big(light.gain));
            let reflected = zip(&sent, &exact(coefficient), Big::mul);
            levels = plus(&levels, &times(&reflected, &share));
        }
        levels
    }
}

/// The vertices of the triangle of a cell that a place of a face lies on, not normalised normals, and their weights.
fn weighted_vertices(
    [a, b, _, d]: &[Corner; 4],
    place: &Vector,
    segments: usize,
) -> [(Corner, Big); 3] {
    let count = big(segments as f64);
    // The cell along the edge from `a` to another corner, and the place in it.
    let along = |to: &Corner| {
        let edge = minus(&to.place, &a.place);
        let share = dot(&minus(place, &a.place), &edge) / dot(&edge, &edge);
        let steps = (share * count.clone()).clamp(big(0.0), count.clone());
        let cell = steps.floor().min(count.clone() - big(1.0));
        (cell.clone(), steps - cell)
    };
    let ((i, s), (j, t)) = (along(b), along(d));
    let vertex = |right: f64, up: f64| {
        let [right, up] =
            [(&i, right), (&j, up)].map(|(cell, more)| (cell.clone() + big(more)) / count.clone());
        let of = |value: fn(&Corner) -> &Vector| {
            let from = value(a);
            let steps =
                [(b, &right), (d, &up)].map(|(to, share)| times(&minus(value(to), from), share));
            plus(&plus(from, &steps[0]), &steps[1])
        };
        Corner {
            place: of(|corner| &corner.place),
            normal: of(|corner| &corner.normal),
        }
    };
    // The triangle beside the diagonal on which the place lies, and the larger and the smaller coordinate.
    let (beside, more, less) = if s >= t {
        (vertex(1.0, 0.0), s, t)
    } else {
        (vertex(0.0, 1.0), t, s)
    };
    [
        (vertex(0.0, 0.0), big(1.0) - more.clone()),
        (beside, more - less.clone()),
        (vertex(1.0, 1.0), less),
    ]
}

impl Corner {
    /// A corner of a cuboid relative to its centre, before rotation.
    fn new(transform: &Transform, own: DVec3) -> Self {
        let turned = |v: DVec3| {
            let mut v: Vector = exact(v);
            for (axis, degrees) in transform.rotation.to_array().into_iter().enumerate() {
                let [sin, cos] = sine_and_cosine(degrees);
                let [j, k] = [(axis + 1) % 3, (axis + 2) % 3];
                let [a, b] = [v[j].clone(), v[k].clone()];
                v[j] = cos.clone() * a.clone() - sin.clone() * b.clone();
                v[k] = sin * a + cos * b;
            }
            v
        };
        Corner {
            place: plus(&exact(transform.position), &turned(own)),
            normal: unit(&turned(own.signum())),
        }
    }
}
