//! A picture compared with exact Phong, the best picture of the scene: the exact picture, the error map, the worst pixel.

use fearless_simd::Level;
use hecs::World;

use super::error_map::color_of;
use crate::components::{ShadingMode, View};
use crate::output::Monitor;
use crate::output::memory;
use crate::output::progress::bands;
use crate::questions::metrics::{self, ErrorStatistics, Picture, compare};
use crate::reference;
use crate::shading::Method;
use crate::systems;
use crate::systems::frame::{Frame, Keep, Workers, display_pixel};

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
