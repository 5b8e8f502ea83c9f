//! The assignment's shortcut: unit n, l and o of the vertices, interpolated linearly on the screen, not renormalised.
//!
//! Rule: lambda_i = e_i w_i / sum(e_j w_j) are the coordinates that are linear on the screen; their sum is constant, so
//! no pixel divides. A triangle with a vertex nearer than the near plane has no three screen positions: its vectors are
//! interpolated perspective-correctly instead, as everything else is. Between unit vectors o.r is at most one; where a
//! pixel lies just outside its triangle it is held to that. In f32 where its rounding is bounded, pixel by
//! pixel in f64 elsewhere, for slivers, and where snapping puts pixels beyond the face's diagonal, on the other triangle.

use glam::DVec3;

use super::affine::Affine;
use super::display::Exact;
use super::patch::{Patch, Squares};
use super::specular::{power, power_exact};
use super::triangle::Triangle;
use super::{
    BLOCK, Coverage, EXACT, Evaluations, Scratch, Shader, Sink, Surface, TILE, TileKind, U, doubles,
};
use crate::components::PointLight;

/// Draws the shortcut; it has no tolerance to keep.
pub struct UnitVectors<'a> {
    /// What is shaded.
    pub surface: Surface<'a>,
}

impl Shader for UnitVectors<'_> {
    #[inline(always)]
    fn certify_blocks(&self, _triangle: &Triangle, _blocks: &mut Squares<BLOCK>) {}

    #[inline(always)]
    fn certify_tiles(
        &self,
        _triangle: &Triangle,
        _tiles: &mut Squares<TILE>,
        _scratch: &mut Scratch,
    ) {
    }

    #[inline(always)]
    fn shade(
        &self,
        triangle: &Triangle,
        tiles: &Squares<TILE>,
        index: usize,
        scratch: &mut Scratch,
        sink: &mut impl Sink,
    ) -> Evaluations {
        let (patch, coverage) = (&tiles.patches[index], &tiles.covered[index]);
        if patch.steady
            && patch.beyond_diagonal(triangle, coverage) <= 0.0
            && let Some(factors) = triangle.own.screen
        {
            let vectors = Vectors::new(triangle, factors, patch);
            if self.rounding(&vectors, patch) <= EXACT {
                return self.shade_lanes(&vectors, patch, coverage, scratch, sink);
            }
        }
        self.shade_doubles(triangle, patch, coverage, sink)
    }
}

/// What is interpolated: the weights that are linear on the screen, and the vectors all lights share.
struct Vectors<'a> {
    triangle: &'a Triangle,
    weights: Affine,
    normal: Affine,
    to_eye: Affine,
}

impl<'a> Vectors<'a> {
    #[inline(always)]
    fn new(triangle: &'a Triangle, factors: [f64; 3], patch: &Patch) -> Self {
        let weights = screen_weights(factors, &patch.weights(triangle));
        Vectors {
            triangle,
            weights,
            normal: blend(&weights, &triangle.own.normals),
            to_eye: blend(&weights, &triangle.to_eye(&triangle.own)),
        }
    }

    #[inline(always)]
    fn to_light(&self, light: &PointLight, surface: &Surface) -> Affine {
        let place = light.position - surface.centre;
        blend(&self.weights, &self.triangle.own.to_light(place))
    }
}

#[inline(always)]
fn blend(weights: &Affine, values: &[DVec3; 3]) -> Affine {
    weights.map(|weights| Triangle::blend(weights, values))
}

impl UnitVectors<'_> {
    /// A bound, in levels, on what f32 costs on this tile; infinite where it cannot be given.
    ///
    /// A vector, no longer than one, errs by two roundings and three of what it moves; a dot product by its vectors'
    /// errors and three more; so o.r errs by four, three and three times the errors of n, l and o and 21 roundings, and
    /// s^rho by rho times that and sixteen.
    #[inline(always)]
    fn rounding(&self, vectors: &Vectors, patch: &Patch) -> f64 {
        let error = |v: &Affine| U * (2.0 + 3.0 * v.reach(patch.half));
        let steepest = match self.surface.material.shininess {
            shininess if shininess > 0.0 && shininess < 1.0 => f64::INFINITY,
            shininess => shininess,
        };
        let [n, o] = [&vectors.normal, &vectors.to_eye].map(error);
        let mut largest = self.surface.ambient().max_element();
        let mut bound = 0.0;
        for light in &self.surface.illumination.points {
            let l = error(&vectors.to_light(light, &self.surface));
            let [diffuse, specular] = self.surface.coefficients(light).map(DVec3::max_element);
            largest += diffuse + specular;
            bound += diffuse * (n + l + 3.0 * U);
            if specular > 0.0 {
                bound += specular * (steepest * (4.0 * n + 3.0 * (l + o) + 21.0 * U) + 16.0 * U);
            }
        }
        bound + self.surface.rounding() * largest
    }

    #[inline(always)]
    fn shade_lanes(
        &self,
        vectors: &Vectors,
        patch: &Patch,
        coverage: &Coverage,
        scratch: &mut Scratch,
        sink: &mut impl Sink,
    ) -> Evaluations {
        let surface = &self.surface;
        let shininess = surface.material.shininess as f32;
        let ambient = surface.ambient().as_vec3().to_array();
        let lanes = patch.lanes();
        let levels = &mut scratch.levels[0];
        levels.fill(ambient.map(|level| [level; TILE]));
        for light in &surface.illumination.points {
            let [diffuse, specular] = surface
                .coefficients(light)
                .map(|levels| levels.as_vec3().to_array());
            let to_light = vectors.to_light(light, surface);
            for (row, &(from, to)) in coverage.spans.iter().enumerate() {
                if from < to {
                    let y = row as f64 - patch.row;
                    let (n, l, o) = (
                        vectors.normal.row(y),
                        to_light.row(y),
                        vectors.to_eye.row(y),
                    );
                    let mut cosine = [0.0; TILE];
                    let mut strength = [0.0; TILE];
                    for lane in 0..TILE {
                        let (n, l, o) = (n.at(lanes[lane]), l.at(lanes[lane]), o.at(lanes[lane]));
                        let nl = n[0] * l[0] + n[1] * l[1] + n[2] * l[2];
                        let no = n[0] * o[0] + n[1] * o[1] + n[2] * o[2];
                        let lo = l[0] * o[0] + l[1] * o[1] + l[2] * o[2];
                        let lambda = 1.0 - (2.0 * nl * no - lo);
                        let raised = if shininess > 0.0 {
                            power(shininess, if lambda > 0.0 { lambda } else { 0.0 })
                        } else {
                            1.0
                        };
                        cosine[lane] = if nl > 0.0 { nl } else { 0.0 };
                        strength[lane] = if nl > 0.0 { raised } else { 0.0 };
                    }
                    for channel in 0..3 {
                        for lane in 0..TILE {
                            levels[row][channel][lane] += diffuse[channel] * cosine[lane]
                                + specular[channel] * strength[lane];
                        }
                    }
                }
            }
        }
        for (row, &(from, to)) in coverage.spans.iter().enumerate() {
            if from < to {
                sink.take(row, &Exact(&levels[row]));
            }
        }
        Evaluations::of(TileKind::Exact).of_every_pixel(coverage, surface)
    }

    /// The same in f64 at every covered pixel.
    fn shade_doubles(
        &self,
        triangle: &Triangle,
        patch: &Patch,
        coverage: &Coverage,
        sink: &mut impl Sink,
    ) -> Evaluations {
        let surface = &self.surface;
        doubles::shade(triangle, patch, coverage, sink, |point| {
            let vertices = point.vertices;
            let weights = point.weights * DVec3::from(vertices.screen.unwrap_or([1.0; 3]));
            let weights = weights / (weights.x + weights.y + weights.z);
            let n = Triangle::blend(weights, &vertices.normals);
            let o = Triangle::blend(weights, &triangle.to_eye(vertices));
            let mut levels = surface.ambient();
            for light in &surface.illumination.points {
                let [diffuse, specular] = surface.coefficients(light);
                let l =
                    Triangle::blend(weights, &vertices.to_light(light.position - surface.centre));
                let cosine = n.dot(l);
                if cosine > 0.0 {
                    let lambda = (1.0 - o.dot(2.0 * cosine * n - l)).max(0.0);
                    levels += diffuse * cosine
                        + specular * power_exact(surface.material.shininess, lambda);
                }
            }
            levels
        });
        Evaluations::of(TileKind::Double).of_every_pixel(coverage, surface)
    }
}

/// The three coordinates that are linear on the screen: the weights times the vertices' w.
fn screen_weights(factors: [f64; 3], weights: &Affine) -> Affine {
    let linear = weights.map(|weights| weights * DVec3::from_array(factors));
    let total = linear.centre.x + linear.centre.y + linear.centre.z;
    linear.map(|weights| weights / total)
}
