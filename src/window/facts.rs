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
use crate::questions::requires::segments::FewestSegments;
use crate::questions::requires::{Part, PartChanges};
use crate::questions::trade::budget::{after, best_trades, fitting};
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
    /// The picture without a part.
    pub left_out: Latest<(Part, Vec<u32>)>,
    /// It is current from its first rows on.
    pub required: Latest<PartChanges>,
    pub segments: Latest<Vec<FewestSegments>>,
    /// Those of a number that is varied. They are about their own scene, whatever the picture is.
    pub curves: Latest<Refined>,
    /// The trade of the view: every method measured. It is current whatever method is on screen.
    pub trade: Latest<Measured>,
    /// The method that holds the budget: the machine's choice, and so no part of the scene.
    pub held: Option<Method>,
}

impl Facts {
    /// After a change of the picture. The trade is about all methods.
    pub fn outdate(&mut self, change: Change) {
        if change == Change::Nothing {
            return;
        }
        self.section.is_current = false;
        self.comparison.is_current = false;
        self.proof.is_current = false;
        self.left_out.is_current = false;
        self.required.is_current = false;
        self.segments.is_current = false;
        self.trade.is_current &= change == Change::Method;
    }

    /// With a budget, picks the next frame's method: the most exact measured one that fits. While the view moves, a frame over
    /// the budget makes it a faster one; at rest all are measured again. Before any measurement the tolerance applies.
    /// `last` are the milliseconds of the last frame, where another one is to be drawn now.
    pub fn hold(&mut self, budget: Option<f64>, last: Option<f64>) {
        let measured = self.trade.value.as_ref().map(|it| &it.methods[..]);
        let (methods, costs) = best_trades(measured.unwrap_or_default());
        self.held = budget.filter(|_| !methods.is_empty()).map(|budget| {
            let held = methods.iter().position(|it| Some(*it) == self.held);
            let place = match held.filter(|_| !self.trade.is_current) {
                None => fitting(&costs, budget),
                Some(place) => after(place, last.unwrap_or_default(), &costs, budget),
            };
            methods[place]
        });
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
