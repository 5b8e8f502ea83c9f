//! A textbook's implementation of the model, in f64 or with 256 bits, right or deliberately wrong.
//!
//! All coordinates are in world space. A line of sight is intersected with the plane of a face, the areas of three
//! triangles are the weights of the corners, and the model is evaluated term by term. No code is shared with the
//! reference.

use std::ops::{Add, Div, Mul, Neg, Sub};

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use glam::DVec3;
use hecs::World;
use shadetrade::components::{
    Light, LightKind, Material, Mesh, Projection, ShadingMode, TRIANGLES, Transform, View,
};

/// A float of [`BITS`] bits.
pub type Big = FBig<HalfEven, 2>;

const BITS: usize = 256;

/// A number of the model.
pub trait Number:
    Clone
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    fn of(x: f64) -> Self;
    fn root(self) -> Self;
    /// A number >= 0 to the power of an exponent >= 0.
    fn power(self, exponent: f64) -> Self;
    /// Sine and cosine of an angle in degrees.
    fn sine_and_cosine(degrees: f64) -> [Self; 2];
}

impl Number for f64 {
    fn of(x: f64) -> Self {
        x
    }

    fn root(self) -> Self {
        self.sqrt()
    }

    fn power(self, exponent: f64) -> Self {
        self.powf(exponent)
    }

    fn sine_and_cosine(degrees: f64) -> [Self; 2] {
        degrees.to_radians().sin_cos().into()
    }
}

impl Number for Big {
    fn of(x: f64) -> Self {
        let exact = Big::try_from(x).expect("a finite number");
        exact.with_precision(BITS).value()
    }

    fn root(self) -> Self {
        self.sqrt()
    }

    fn power(self, exponent: f64) -> Self {
        if exponent == 0.0 {
            Big::of(1.0)
        } else if self == Big::ZERO {
            self
        } else {
            (self.ln() * Big::of(exponent)).exp()
        }
    }

    fn sine_and_cosine(degrees: f64) -> [Self; 2] {
        let angle = Big::of(degrees) * Big::pi(BITS) / Big::of(180.0);
        [angle.sin(), angle.cos()]
    }
}

/// x, y and z, or red, green and blue.
type Vector<N> = [N; 3];

fn exact<N: Number>(v: DVec3) -> Vector<N> {
    v.to_array().map(N::of)
}

fn zip<N: Number>(a: &Vector<N>, b: &Vector<N>, of: impl Fn(N, N) -> N) -> Vector<N> {
    std::array::from_fn(|i| of(a[i].clone(), b[i].clone()))
}

fn plus<N: Number>(a: &Vector<N>, b: &Vector<N>) -> Vector<N> {
    zip(a, b, N::add)
}

fn minus<N: Number>(a: &Vector<N>, b: &Vector<N>) -> Vector<N> {
    zip(a, b, N::sub)
}

fn times<N: Number>(a: &Vector<N>, factor: &N) -> Vector<N> {
    a.clone().map(|x| x * factor.clone())
}

fn dot<N: Number>(a: &Vector<N>, b: &Vector<N>) -> N {
    let [x, y, z] = zip(a, b, N::mul);
    x + y + z
}

fn cross<N: Number>(a: &Vector<N>, b: &Vector<N>) -> Vector<N> {
    std::array::from_fn(|i| {
        let [j, k] = [(i + 1) % 3, (i + 2) % 3];
        a[j].clone() * b[k].clone() - a[k].clone() * b[j].clone()
    })
}

fn unit<N: Number>(v: &Vector<N>) -> Vector<N> {
    let length = dot(v, v).root();
    v.clone().map(|x| x / length.clone())
}

/// The model, and faults that can be switched on.
#[derive(Clone, Copy, Debug)]
pub struct Model {
    /// A kind of light that is left out.
    pub without: Option<LightKind>,
    /// Attributes are interpolated linearly on the screen.
    pub is_affine: bool,
    /// The interpolated normal is not normalised.
    pub is_short: bool,
    /// A factor of the exponent.
    pub exponent: f64,
}

/// The right model.
pub const RIGHT: Model = Model {
    without: None,
    is_affine: false,
    is_short: false,
    exponent: 1.0,
};

/// A scene and a view of it.
pub struct Scene<'a, N> {
    view: &'a View,
    cuboids: Vec<([Corner<N>; 8], Material, ShadingMode)>,
    lights: Vec<(Vector<N>, Light)>,
    /// The view direction, and the change per pixel right and up of a direction (perspective) or a position
    /// (orthographic).
    forward: Vector<N>,
    right: Vector<N>,
    up: Vector<N>,
}

/// The position of a cuboid's corner in the world.
#[derive(Clone)]
struct Corner<N> {
    place: Vector<N>,
    normal: Vector<N>,
}

impl<'a, N: Number> Scene<'a, N> {
    pub fn new(world: &World, view: &'a View) -> Self {
        let mut cuboids = world.query::<(&Transform, &Mesh, &Material, &ShadingMode)>();
        let mut lights = world.query::<(&Transform, &Light)>();
        let camera = &view.viewpoint.camera;
        let forward = unit(&minus(
            &exact(camera.target),
            &exact(view.viewpoint.position),
        ));
        let right = unit(&cross(&forward, &exact(camera.up)));
        let up = cross(&right, &forward);
        let seen = match view.projection {
            Projection::Perspective => {
                let [sin, cos] = N::sine_and_cosine(camera.fov / 2.0);
                N::of(2.0) * sin / cos
            }
            Projection::Orthographic => N::of(camera.height),
        };
        let pixel = seen / N::of(view.size[1] as f64);
        Scene {
            view,
            cuboids: cuboids
                .iter()
                .map(|(transform, mesh, material, mode)| {
                    let corners = mesh.corners.map(|corner| Corner::new(transform, corner));
                    (corners, *material, *mode)
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
    pub fn levels(&self, face: usize, [x, y]: [usize; 2], model: Model) -> Vector<N> {
        let (corners, material, mode) = &self.cuboids[face / 6];
        let [from, along] = self.sight(x, y);
        let triangles = [0, 1].map(|second| {
            TRIANGLES[2 * (face % 6) + second].map(|corner| &corners[usize::from(corner)])
        });
        let [a, b, c] = &triangles[0];
        let across = cross(&minus(&b.place, &a.place), &minus(&c.place, &a.place));
        let depth = dot(&minus(&a.place, &from), &across) / dot(&along, &across);
        let place = plus(&from, &times(&along, &depth));
        let weights_on = |triangle: &[&Corner<N>; 3]| {
            let twice_area = |a: &Vector<N>, b: &Vector<N>, c: &Vector<N>| {
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
            .all(|weight| *weight >= N::of(0.0));
        let corners = &triangles[usize::from(!is_inside)];
        let mut weights = weights_on(corners);
        if model.is_affine {
            let depths = corners
                .each_ref()
                .map(|corner| dot(&minus(&corner.place, &from), &self.forward));
            weights = zip(&weights, &depths, N::mul);
            let [a, b, c] = weights.clone();
            weights = weights.map(|weight| weight / (a.clone() + b.clone() + c.clone()));
        }
        let blend = |of: &dyn Fn(&Corner<N>) -> Vector<N>| {
            let parts: [_; 3] = std::array::from_fn(|i| times(&of(corners[i]), &weights[i]));
            plus(&plus(&parts[0], &parts[1]), &parts[2])
        };
        let to_eye = |place: &Vector<N>| match self.view.projection {
            Projection::Perspective => unit(&minus(&from, place)),
            Projection::Orthographic => self.forward.clone().map(N::neg),
        };
        let lit = |place: &Vector<N>, normal: &Vector<N>| {
            self.lit(material, place, normal, &to_eye(place), model)
        };
        if self.view.shading.unwrap_or(*mode) == ShadingMode::Gouraud {
            return blend(&|corner| lit(&corner.place, &corner.normal));
        }
        let normal = blend(&|corner| corner.normal.clone());
        let place = blend(&|corner| corner.place.clone());
        lit(
            &place,
            &if model.is_short {
                normal
            } else {
                unit(&normal)
            },
        )
    }

    /// The start and direction of the line of sight of a pixel.
    fn sight(&self, x: usize, y: usize) -> [Vector<N>; 2] {
        let eye = exact(self.view.viewpoint.position);
        let [width, height] = self.view.size.map(|pixels| pixels as f64);
        let moved = plus(
            &times(&self.right, &N::of(x as f64 + 0.5 - width / 2.0)),
            &times(&self.up, &N::of(height / 2.0 - y as f64 - 0.5)),
        );
        match self.view.projection {
            Projection::Perspective => [eye, plus(&self.forward, &moved)],
            Projection::Orthographic => [plus(&eye, &moved), self.forward.clone()],
        }
    }

    /// The model at a point.
    fn lit(
        &self,
        material: &Material,
        place: &Vector<N>,
        normal: &Vector<N>,
        to_eye: &Vector<N>,
        model: Model,
    ) -> Vector<N> {
        let zero = N::of(0.0);
        let mut levels = [(); 3].map(|()| zero.clone());
        let kept = |light: &Light| model.without != Some(light.kind);
        for (position, light) in self.lights.iter().filter(|(_, light)| kept(light)) {
            let to_light = unit(&minus(position, place));
            let facing = dot(normal, &to_light);
            let (coefficient, share) = match light.kind {
                LightKind::Ambient => (material.ambient, N::of(1.0)),
                LightKind::Diffuse if facing > zero => (material.diffuse, facing),
                LightKind::Specular if facing > zero => {
                    let mirrored = times(normal, &(N::of(2.0) * facing));
                    let along = dot(to_eye, &minus(&mirrored, &to_light));
                    let base = if along > zero { along } else { zero.clone() };
                    let exponent = material.shininess * model.exponent;
                    (material.specular, base.power(exponent))
                }
                LightKind::Diffuse | LightKind::Specular => continue,
            };
            let sent = times(&exact(light.color), &N::of(light.intensity));
            let sent = times(&sent, &N::of(light.gain));
            levels = plus(
                &levels,
                &times(&zip(&sent, &exact(coefficient), N::mul), &share),
            );
        }
        levels
    }
}

impl<N: Number> Corner<N> {
    /// A corner of a cuboid relative to its centre, before rotation.
    fn new(transform: &Transform, own: DVec3) -> Self {
        let turned = |v: DVec3| {
            let mut v: Vector<N> = exact(v);
            for (axis, degrees) in transform.rotation.to_array().into_iter().enumerate() {
                let [sin, cos] = N::sine_and_cosine(degrees);
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
