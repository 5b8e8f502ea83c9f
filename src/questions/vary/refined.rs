//! Curves that are refined while they are looked at: the ends of the range first, then the middle of the longest gap. A gap in
//! which a method ceases to keep the limit counts more.
//!
//! ```text
//! error | o           o     1st, 2nd     o   o       o    then ever finer
//! limit |- - - - - - - -                - -o- - - - - -   most where a curve meets the limit
//! ```

use std::sync::Arc;

use fearless_simd::Level;

use super::curve::{Curve, Point, RESOLUTION, steps_between};
use super::picture::{Compared, Contender, Error, TEXTBOOK, errors};
use super::variable::Variable;
use crate::components::{ShadingMode, Viewer};
use crate::output::Monitor;
use crate::questions::trade::verdict::UNSEEN;
use crate::scene::SceneRecord;
use crate::shading::{Method, limit};

/// The longest gap between two values, as a share of the range.
const GAP: f64 = 1.0 / 32.0;
/// The most pixels of a picture that are compared.
pub const PIXELS: usize = 4000;

/// The errors of four contenders over the range of a variable.
#[derive(Clone, Debug)]
pub struct Refined {
    pub variable: Variable,
    /// The error that is to be kept, in levels.
    pub limit: f64,
    /// Width and height of the pictures.
    pub size: [usize; 2],
    /// The scene with the first value, without what no error depends on.
    scene: Arc<SceneRecord>,
    /// By value.
    found: Vec<(f64, Vec<Error>)>,
    pub is_all: bool,
    /// Whether the variable is the zoom of the camera.
    is_zoom: bool,
}

/// Both modes within the tolerance, and two shortcuts.
fn contenders(tolerance: f64) -> [Contender; 4] {
    let both = [ShadingMode::Gouraud, ShadingMode::Phong];
    let [gouraud, phong] = both.map(|mode| Contender::from(Method::of(mode, tolerance)));
    let shortcut = Method::of(ShadingMode::UnitVectors, 0.0);
    [gouraud, phong, shortcut.into(), TEXTBOOK]
}

impl Refined {
    /// No values of a scene yet. `size` is that of the pictures.
    ///
    /// # Errors
    /// If the scene does not have the variable.
    pub fn new(variable: Variable, record: &SceneRecord, size: [usize; 2]) -> anyhow::Result<Self> {
        let mut scene = variable.scene(record, variable.from)?;
        scene.view = Viewer {
            camera: scene.view.camera,
            projection: scene.view.projection,
            tolerance: scene.view.tolerance,
            turned: scene.view.turned,
            ..Viewer::default()
        };
        for cuboid in &mut scene.cuboid {
            cuboid.shading = ShadingMode::default();
        }
        let is_tolerance = variable.key.is_of("view.tolerance");
        let kept = if is_tolerance {
            UNSEEN
        } else {
            scene.view.tolerance
        };
        Ok(Refined {
            is_zoom: variable.is_zoom(&scene.spawn()),
            variable,
            limit: limit(kept),
            size,
            scene: Arc::new(scene),
            found: Vec::new(),
            is_all: false,
        })
    }

    /// Whether both are about the same pictures.
    pub fn is_same(&self, other: &Refined) -> bool {
        self.variable == other.variable && self.size == other.size && self.scene == other.scene
    }

    /// Draws the pictures of a few more values.
    ///
    /// # Errors
    /// If a value makes no scene, a picture does not fit in memory, or the work is cancelled.
    pub async fn refine(
        mut self,
        count: usize,
        level: Level,
        monitor: Monitor<'_>,
    ) -> anyhow::Result<Self> {
        for _ in 0..count {
            let Some(value) = self.next() else {
                self.is_all = true;
                break;
            };
            (monitor.progress)("varying", (self.found.len() as f64 * GAP).min(1.0));
            let scene = self.variable.scene(&self.scene, value)?;
            let contenders = contenders(scene.view.tolerance);
            let compared = Compared::Lattice(PIXELS);
            let errors = errors(&scene, self.size, &contenders, level, compared, monitor).await?;
            let place = self.found.partition_point(|it| it.0 < value);
            self.found.insert(place, (value, errors));
        }
        Ok(self)
    }

    /// The value that tells most; `None` if all gaps are short.
    fn next(&self) -> Option<f64> {
        let variable = &self.variable;
        if let Some(end) = [variable.from, variable.to].get(self.found.len()) {
            return Some(*end);
        }
        let is_kept = |errors: &[Error]| -> Vec<bool> {
            errors.iter().map(|it| it.keeps(self.limit)).collect()
        };
        let gaps = self.found.windows(2).filter_map(|pair| {
            let [from, to] = [&pair[0], &pair[1]].map(|it| variable.share(it.0));
            let middle = variable.at(f64::midpoint(from, to));
            let is_end = is_kept(&pair[0].1) != is_kept(&pair[1].1);
            let longest = if is_end { RESOLUTION } else { GAP };
            let mut excess = (to - from) / longest;
            if self.is_zoom {
                excess = excess.max(steps_between([pair[0].1[0].height, pair[1].1[0].height]));
            }
            (excess > 1.0 && pair[0].0 < middle && middle < pair[1].0).then_some((middle, excess))
        });
        let longest = gaps.max_by(|one, other| one.1.total_cmp(&other.1));
        longest.map(|(middle, _)| middle)
    }

    /// The curves as far as they are known, each with its method; `None` is the textbook's formula in f32.
    pub fn curves(&self) -> Vec<(Option<Method>, Curve)> {
        let contenders = contenders(self.scene.view.tolerance);
        let curve = |(index, contender): (usize, &Contender)| {
            let point = |(value, errors): &(f64, Vec<Error>)| Point {
                value: *value,
                found: errors[index],
                milliseconds: None,
            };
            let points = self.found.iter().map(point).collect();
            // Between two values nothing is known.
            let unknown = &mut |_| Ok(None);
            let (variable, limit) = (&self.variable, self.limit);
            let curve = Curve::new(contender, variable, points, limit, self.is_zoom, unknown);
            Some((contender.method, curve.ok()?))
        };
        contenders.iter().enumerate().filter_map(curve).collect()
    }
}
