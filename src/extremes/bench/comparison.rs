//! Pictures in, how far they are from what they ought to be out.
//!
//! Rule: a picture in which nothing is seen proves nothing, so whoever compares pictures says how much must be seen.

use std::ops::AddAssign;

use super::{Bench, MODES, Trouble};
use crate::components::{Projection, ShadingMode, View};
use crate::extremes::outline::{self, SNAP};
use crate::extremes::setting::{Setting, Way};
use crate::frame::{NO_TRIANGLE, face};
use crate::reference::{self, Truth, at_pixel};
use crate::scene::Scene;
use crate::trade::metrics::pixel_error;

/// What the contract calls exact, in levels.
pub const EXACT: f64 = 0.05;

/// Where |n.l| is smaller, the gate of the highlight may fall either way.
const TIE: f64 = 1e-6;

/// The least number of pixels of a scene that must be seen for a comparison to mean something.
const LEAST_SEEN: u64 = 100;

/// How far pictures are from what they ought to be.
#[derive(Clone, Copy, Debug, Default)]
pub struct Distance {
    /// The largest error at tolerance 0, in levels.
    pub exact: f64,
    /// The largest error at the others, as a share of the tolerance.
    pub share: f64,
    /// Pixels where both show the same face.
    pub compared: u64,
    /// Pixels that show another face, their centres nearer to an edge than what snapping moves it.
    pub edges: u64,
}

impl AddAssign for Distance {
    fn add_assign(&mut self, other: Self) {
        self.exact = self.exact.max(other.exact);
        self.share = self.share.max(other.share);
        self.compared += other.compared;
        self.edges += other.edges;
    }
}

impl Bench {
    /// The tolerances at which a case is compared with the reference, in levels.
    fn tolerances(&self) -> &'static [f64] {
        if self.full {
            &[0.0, 0.25, 0.5, 1.0, 2.0, 4.0]
        } else {
            &[0.0, 0.5, 4.0]
        }
    }

    /// Compares a setting with the reference in every projection and mode and at every tolerance.
    ///
    /// # Errors
    /// When a pixel errs by more than its tolerance, or shows another face for no reason.
    pub fn against_reference(&mut self, setting: &Setting) -> Result<Distance, Trouble> {
        let mut scene = setting.scene()?;
        let mut distance = Distance::default();
        for projection in Projection::ALL {
            for mode in MODES {
                let way = |tolerance| Way {
                    projection,
                    mode,
                    tolerance,
                };
                let view = setting.view(&scene, way(0.0));
                let rows = 0..view.size[1];
                let Some(truth) = reference::picture(&scene.world, &view, rows, &|| false, &|_| ())
                else {
                    continue;
                };
                for &tolerance in self.tolerances() {
                    let view = setting.view(&scene, way(tolerance));
                    let error = self.compare(&mut scene, &view, &truth, &mut distance)?;
                    if tolerance == 0.0 {
                        distance.exact = distance.exact.max(error);
                    } else {
                        distance.share = distance.share.max(error / tolerance);
                    }
                }
            }
        }
        enough(distance.compared)?;
        Ok(distance)
    }

    /// Asserts that nothing is drawn.
    ///
    /// # Errors
    /// When something is.
    pub fn expect_nothing(&mut self, setting: &Setting, way: Way) -> Result<(), Trouble> {
        let mut scene = setting.scene()?;
        let view = setting.view(&scene, way);
        let frame = self.draw(&mut scene, &view)?;
        let shown = frame.triangles().iter().position(|id| *id != NO_TRIANGLE);
        shown.map_or(Ok(()), |pixel| {
            let place = [pixel % view.size[0], pixel / view.size[0]];
            let shown = name(frame.triangles()[pixel]);
            Err(wrong(&view, place, &format!("shows {shown}")))
        })
    }

    /// The largest difference between two pictures, the plain one first, where they show the same face.
    ///
    /// # Errors
    /// When it is above `most` levels, or they show different faces off the plain one's outlines.
    pub fn difference(
        &mut self,
        [plain, extreme]: [(&Setting, Way); 2],
        most: f64,
    ) -> Result<f64, Trouble> {
        let expected = self.picture(plain.0, plain.1)?;
        enough(expected.seen())?;
        let drawn = self.picture(extreme.0, extreme.1)?;
        let scene = plain.0.scene()?;
        let view = plain.0.view(&scene, plain.1);
        let mut worst = 0.0_f64;
        for (pixel, ids) in drawn.triangles.iter().zip(&expected.triangles).enumerate() {
            let place = [pixel % view.size[0], pixel / view.size[0]];
            let ids = [*ids.0, *ids.1];
            if face(ids[0]) != face(ids[1]) {
                if !is_explained(&scene, &view, place, ids) {
                    let what = format!("shows {}, not {}", name(ids[0]), name(ids[1]));
                    return Err(wrong(&view, place, &what));
                }
            } else if ids[0] != NO_TRIANGLE {
                worst = worst.max(pixel_error(drawn.levels[pixel], expected.levels[pixel]));
            }
        }
        if worst > most {
            return Err(Trouble::Wrong(format!("{worst} levels, {:?}", extreme.1)));
        }
        Ok(worst)
    }

    /// The largest error of the picture just drawn.
    fn compare(
        &mut self,
        scene: &mut Scene,
        view: &View,
        truth: &Truth,
        distance: &mut Distance,
    ) -> Result<f64, Trouble> {
        let promise = view.tolerance.max(EXACT);
        self.draw(scene, view)?;
        self.display(scene, view)?;
        let mut worst = 0.0_f64;
        for pixel in 0..truth.triangles.len() {
            let place = [pixel % truth.width, pixel / truth.width];
            let (id, expected) = (self.frame.triangles()[pixel], truth.triangles[pixel]);
            let (levels, exact) = (self.frame.levels()[pixel], truth.levels[pixel]);
            let [_, bytes @ ..] = self.display.pixels()[pixel].to_be_bytes();
            let error = pixel_error(levels, exact);
            // Half a level more is the rounding to bytes.
            let shown = pixel_error(bytes.map(f64::from), exact) - 0.5;
            let kept = error.max(shown) <= promise;
            // Beside a diagonal what is drawn may continue the other triangle of the face.
            if face(id) != face(expected) || id != expected && !kept {
                if !is_explained(scene, view, place, [id, expected]) {
                    let what = format!("shows {}, not {}", name(id), name(expected));
                    return Err(wrong(view, place, &what));
                }
                distance.edges += 1;
                continue;
            }
            distance.compared += u64::from(id != NO_TRIANGLE);
            if kept {
                worst = worst.max(error);
            } else if !is_tie(scene, view, place) {
                let what =
                    format!("errs by {error}: {levels:?}, shown as {bytes:?}, not {exact:?}");
                return Err(wrong(view, place, &what));
            }
        }
        Ok(worst)
    }
}

/// Too little to see proves nothing.
///
/// # Errors
/// When it is too little.
pub fn enough(seen: u64) -> Result<(), Trouble> {
    if seen < LEAST_SEEN {
        let what = format!("no more than {seen} pixels are seen");
        return Err(Trouble::Wrong(what));
    }
    Ok(())
}

/// Whether a pixel may show either face: its centre is on the outline of one of them.
fn is_explained(scene: &Scene, view: &View, place: [usize; 2], ids: [u32; 2]) -> bool {
    ids.into_iter()
        .filter(|id| *id != NO_TRIANGLE)
        .any(|id| outline::distance(&scene.world, view, id, place) <= SNAP)
}

/// Whether the gate of a highlight may fall either way at a pixel.
fn is_tie(scene: &Scene, view: &View, [x, y]: [usize; 2]) -> bool {
    at_pixel(&scene.world, view, x, y).is_some_and(|seen| {
        let mut towards = seen.lights.iter().filter_map(|light| light.to_light);
        view.shading == Some(ShadingMode::Phong)
            && towards.any(|to_light| seen.normal.dot(to_light).abs() < TIE)
    })
}

fn name(id: u32) -> String {
    if id == NO_TRIANGLE {
        "the background".to_owned()
    } else {
        format!("triangle {} of cuboid {}", id % 12, id / 12)
    }
}

/// What is wrong at a pixel.
pub fn wrong(view: &View, [x, y]: [usize; 2], what: &str) -> Trouble {
    let mode = view
        .shading
        .map_or(String::new(), |mode| format!("{mode:?}, "));
    Trouble::Wrong(format!(
        "pixel {x},{y} {what} ({mode}{:?}, tolerance {})",
        view.projection, view.tolerance
    ))
}
