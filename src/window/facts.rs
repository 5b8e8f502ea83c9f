//! The facts about the picture, and the changes that outdate them; among them its comparison with exact Phong, the best picture
//! of the scene: the exact picture, the error map, the worst pixel.

use std::sync::Arc;

use fearless_simd::Level;
use hecs::World;

use super::document::is_another_scene;
use super::error_map::color_of;
use super::pictures::side_method;
use crate::components::{ShadingMode, Side, View};
use crate::output::progress::bands;
use crate::output::{Monitor, memory};
use crate::questions::metrics::{self, ErrorStatistics, Picture, compare};
use crate::questions::probe::Probe;
use crate::questions::prove::Proof;
use crate::questions::requires::PartChange;
use crate::questions::trade::{Measured, Measurement};
use crate::questions::vary::refined::Refined;
use crate::reference;
use crate::scene::SceneRecord;
use crate::shading::Method;
use crate::systems;
use crate::systems::frame::{Frame, Keep, Workers, display_pixel};

/// The last value found, perhaps of an earlier picture.
#[derive(Debug)]
pub struct Latest<T> {
    pub value: Option<T>,
    /// Whether it is about the present picture. The value of an earlier one stays until then.
    pub is_current: bool,
}

impl<T> Default for Latest<T> {
    fn default() -> Self {
        Latest {
            value: None,
            is_current: false,
        }
    }
}

impl<T> Latest<T> {
    pub fn finish(&mut self, value: Option<T>) {
        (self.value, self.is_current) = (value, true);
    }

    /// The value, if it is that of the present picture.
    pub fn current(&self) -> Option<&T> {
        self.value.as_ref().filter(|_| self.is_current)
    }
}

/// The known facts.
#[derive(Default)]
pub struct Facts {
    /// The pixels of a row on one face, from left to right, in the picture that is shown there.
    pub section: Latest<(Side, Vec<Probe>)>,
    pub comparison: Latest<Comparison>,
    /// The proof of the picture, or of both sides of a wipe.
    pub proof: Latest<([Side; 2], Proof)>,
    /// The one with the largest error first.
    pub required: Latest<Vec<PartChange>>,
    /// Those of a number that is varied. They are about their own scene, whatever the picture is.
    pub curves: Latest<Refined>,
    /// The trade of the view: every method measured. It is current whatever method is on screen.
    pub trade: Latest<Measured>,
}

impl Facts {
    /// After a change of the picture, which is not [`Change::Nothing`]. The trade is about all methods.
    pub fn outdate(&mut self, change: Change) {
        self.section.is_current = false;
        self.comparison.is_current = false;
        self.proof.is_current = false;
        self.required.is_current = false;
        self.trade.is_current &= change == Change::Method;
    }

    /// The answer about a pixel, possibly of an earlier picture.
    pub fn probed(&self, pixel: Option<[usize; 2]>) -> Option<&Probe> {
        let (_, section) = self.section.value.as_ref()?;
        section.iter().find(|probe| Some(probe.pixel) == pixel)
    }

    /// The measurement of a method in the present view.
    pub fn measured(&self, method: Method) -> Option<&Measurement> {
        let mut measured = self.trade.current()?.methods.iter();
        measured.find(|it| it.method == method)
    }

    /// The median time of a method in the present view, in milliseconds.
    pub fn measured_time(&self, method: Option<Method>) -> Option<f64> {
        Some(self.measured(method?)?.timing.median)
    }

    /// The worst pixel of a side of a wipe or of the picture, as it is now; `shown` is the method on screen. The outer `None`
    /// says that it is not known yet, the inner one that nothing can be compared.
    pub fn worst(&self, side: &Side, shown: Option<Method>) -> Option<Option<Worst>> {
        if *side == Side::Reference {
            return Some(None);
        }
        let method = side_method(side, shown);
        let comparison = self.comparison.current();
        let compared = comparison.and_then(|it| it.worst_by(method, shown));
        let measured = || Some(self.measured(method?)?.error.map(Worst::from));
        compared.or_else(measured)
    }
}

/// The change between two pictures that facts are about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    Nothing,
    /// The same view is drawn by another method.
    Method,
    Scene,
}

/// The change from one state and view to others.
pub fn change(
    (before, view_before): (&Arc<SceneRecord>, &View),
    (after, view): (&Arc<SceneRecord>, &View),
) -> Change {
    let by_any_method = |view: &View| view.unshaded().with_tolerance(0.0);
    if Arc::ptr_eq(before, after) && view == view_before {
        Change::Nothing
    } else if by_any_method(view) != by_any_method(view_before) || is_another_scene(before, after) {
        Change::Scene
    } else if view != view_before || before.cuboid != after.cuboid {
        Change::Method
    } else {
        Change::Nothing
    }
}

/// A picture against the reference in f64.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison {
    /// Exact Phong, 0x00RRGGBB.
    pub exact: Vec<u32>,
    /// The error against exact Phong in the colours of [`super::error_map`], 0x00RRGGBB.
    pub error_map: Vec<u32>,
    /// The worst pixel of the picture; `None` where nothing can be compared.
    pub worst: Option<Worst>,
    /// The worst pixel by other methods: of the sides of a wipe.
    pub sides: Vec<(Method, Option<Worst>)>,
}

/// The pixel that errs most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// In levels of 255.
    pub error: f64,
    /// Column and row of the first pixel that has it.
    pub pixel: [usize; 2],
}

impl From<ErrorStatistics> for Worst {
    fn from(error: ErrorStatistics) -> Self {
        Worst {
            error: error.max,
            pixel: error.max_pixel,
        }
    }
}

/// The worst pixel of some rows, and that of the rows from `top` on.
fn worse(before: Option<Worst>, found: Option<ErrorStatistics>, top: usize) -> Option<Worst> {
    let mut found = found.map(Worst::from);
    if let Some(found) = &mut found {
        found.pixel[1] += top;
    }
    match (before, found) {
        (Some(before), Some(found)) if found.error <= before.error => Some(before),
        _ => found.or(before),
    }
}

impl Comparison {
    /// The worst pixel by a method; `shown` is that of the picture. The outer `None` says that it was not compared.
    pub fn worst_by(&self, method: Option<Method>, shown: Option<Method>) -> Option<Option<Worst>> {
        if method == shown {
            return Some(self.worst);
        }
        let side = self.sides.iter().find(|side| Some(side.0) == method)?;
        Some(side.1)
    }

    /// Compares the picture of `view`, and that by each of `methods`.
    ///
    /// # Errors
    /// If the picture does not fit in memory, or the work is cancelled.
    pub async fn of(
        world: &mut World,
        view: &View,
        methods: Vec<Method>,
        level: Level,
        monitor: Monitor<'_>,
    ) -> anyhow::Result<Comparison> {
        let mut frame = Frame::new(Keep::Levels, Workers::alone(level));
        let mut exact_pixels = memory::reserve_pixels(view.size)?;
        let mut error_map = memory::reserve_pixels(view.size)?;
        let mut worst = None;
        let mut sides: Vec<_> = methods.into_iter().map(|method| (method, None)).collect();
        for rows in bands(view.size[1]) {
            let phong = view.shaded(ShadingMode::Phong);
            let exact = reference::picture(world, &phong, rows.clone(), monitor).await?;
            for (method, worst) in &mut sides {
                let (view, compared) = (&method.view(view), Picture::from(&exact));
                let error = if method.mode.is_drawn() {
                    systems::draw_rows(world, view, rows.clone(), &mut frame)?;
                    compare(Picture::from(&frame), compared).error
                } else {
                    let shown = reference::picture(world, view, rows.clone(), monitor).await?;
                    compare(Picture::from(&shown), compared).error
                };
                *worst = worse(*worst, error, rows.start);
            }
            systems::draw_rows(world, view, rows.clone(), &mut frame)?;
            let (drawn, compared) = (Picture::from(&frame), Picture::from(&exact));
            worst = worse(worst, compare(drawn, compared).error, rows.start);
            error_map.extend(metrics::compared(drawn, compared).map(color_of));
            exact_pixels.extend(exact.levels.into_iter().map(display_pixel));
        }
        Ok(Comparison {
            exact: exact_pixels,
            error_map,
            worst,
            sides,
        })
    }
}
