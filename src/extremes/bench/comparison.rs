//! Pictures in, how far they are from what they ought to be out.
//!
//! Rule: a picture in which nothing is seen proves nothing, so whoever compares pictures says how much must be seen.

use std::ops::AddAssign;

use rayon::prelude::*;

use super::{Bench, MODES, Trouble};
use crate::components::{Projection, View};
use crate::extremes::setting::{Setting, Way};
use crate::frame::NO_TRIANGLE;
use crate::prove::{self, Shown, Verdict, shown_face};
use crate::reference::{Interval, Reference, Seen};
use crate::scene::Scene;
use crate::shading::limit;
use crate::trade::metrics::pixel_error;

/// The least number of pixels of a scene that must be seen for a comparison to mean something.
const LEAST_SEEN: u64 = 100;

/// How far proven pictures are from what they ought to be, at most.
#[derive(Clone, Copy, Debug, Default)]
pub struct Distance {
    /// The largest error at tolerance 0, in levels.
    pub exact: f64,
    /// The largest error at the others, as a share of the tolerance.
    pub share: f64,
    /// Pixels that show a cuboid, or may.
    pub covered: u64,
    /// Pixels so near an edge that they may show either side.
    pub outline: u64,
}

impl AddAssign for Distance {
    fn add_assign(&mut self, other: Self) {
        self.exact = self.exact.max(other.exact);
        self.share = self.share.max(other.share);
        self.covered += other.covered;
        self.outline += other.outline;
    }
}

impl Bench {
    /// The tolerances at which a case is proven, in levels.
    fn tolerances(&self) -> &'static [f64] {
        if self.full {
            &[0.0, 0.25, 0.5, 1.0, 2.0, 4.0]
        } else {
            &[0.0, 0.5, 4.0]
        }
    }

    /// Proves every pixel of a setting in every projection and mode and at every tolerance. Unless everything is to be
    /// drawn, each projection has one of the modes, the other at an odd `turn`.
    ///
    /// # Errors
    /// When a pixel is not proven.
    pub fn proven(&mut self, setting: &Setting, turn: usize) -> Result<Distance, Trouble> {
        let mut scene = setting.scene()?;
        let mut distance = Distance::default();
        for (first, projection) in Projection::ALL.into_iter().enumerate() {
            for (second, mode) in MODES.into_iter().enumerate() {
                if !self.full && (first + second + turn) % 2 == 1 {
                    continue;
                }
                let way = |tolerance| Way {
                    projection,
                    mode,
                    tolerance,
                };
                let enclosures = enclosures(&scene, &setting.view(&scene, way(0.0)));
                for &tolerance in self.tolerances() {
                    let view = setting.view(&scene, way(tolerance));
                    distance += self.judge(&mut scene, &view, &enclosures)?;
                }
            }
        }
        enough(distance.covered)?;
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
    /// When it is above `most` levels, or they show different faces where the plain one may not.
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
        let reference = Reference::<Interval>::new(&scene.world, &view);
        let mut worst = 0.0_f64;
        for (pixel, ids) in drawn.triangles.iter().zip(&expected.triangles).enumerate() {
            let place = [pixel % view.size[0], pixel / view.size[0]];
            let faces = [*ids.0, *ids.1].map(shown_face);
            if faces[0] == faces[1] {
                worst = worst.max(pixel_error(drawn.levels[pixel], expected.levels[pixel]));
            } else if !reference.at(place).iter().any(|seen| seen.face == faces[0]) {
                let what = format!("shows {}, not {}", name(*ids.0), name(*ids.1));
                return Err(wrong(&view, place, &what));
            }
        }
        if worst > most {
            return Err(Trouble::Wrong(format!("{worst} levels, {:?}", extreme.1)));
        }
        Ok(worst)
    }

    /// Draws a picture and judges it by what every pixel may show.
    fn judge(
        &mut self,
        scene: &mut Scene,
        view: &View,
        enclosures: &[Vec<Seen<Interval>>],
    ) -> Result<Distance, Trouble> {
        self.draw(scene, view)?;
        self.display(scene, view)?;
        let mut distance = Distance::default();
        for (pixel, seen) in enclosures.iter().enumerate() {
            let [_, bytes @ ..] = self.display.pixels()[pixel].to_be_bytes();
            let shown = Shown {
                face: shown_face(self.frame.triangles()[pixel]),
                levels: self.frame.levels()[pixel].map(f64::from),
                bytes: Some(bytes),
            };
            let (mark, error) = prove::judge(shown, seen, limit(view.tolerance));
            if mark.verdict != Verdict::Proven {
                let place = [pixel % view.size[0], pixel / view.size[0]];
                let what = format!("is {:?}: {shown:?}, not {seen:?}", mark.verdict);
                return Err(wrong(view, place, &what));
            }
            let share = error / view.tolerance;
            distance += Distance {
                exact: if view.tolerance == 0.0 { error } else { 0.0 },
                share: if view.tolerance == 0.0 { 0.0 } else { share },
                covered: u64::from(mark.is_covered),
                outline: u64::from(mark.is_outline),
            };
        }
        Ok(distance)
    }
}

/// What every pixel of a picture may show, row by row from the top.
pub fn enclosures(scene: &Scene, view: &View) -> Vec<Vec<Seen<Interval>>> {
    let reference = Reference::<Interval>::new(&scene.world, view);
    let rows = (0..view.size[1]).into_par_iter().map(|y| {
        let mut row = Vec::new();
        reference.row(y, |_, seen| row.push(seen.to_vec()));
        row
    });
    rows.collect::<Vec<_>>().concat()
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
