//! A picture compared with exact Phong, the best picture of the scene: the exact picture, the error map, the largest error.

use fearless_simd::Level;
use hecs::World;

use super::error_map::color_of;
use crate::components::{ShadingMode, View};
use crate::output::Monitor;
use crate::output::memory;
use crate::output::progress::bands;
use crate::questions::metrics::{self, Picture};
use crate::reference;
use crate::systems;
use crate::systems::frame::{Frame, Keep, Workers, display_pixel};

/// A picture against the reference in f64.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison {
    /// Exact Phong, 0x00RRGGBB.
    pub exact: Vec<u32>,
    /// The error against exact Phong in the colours of [`super::error_map`], 0x00RRGGBB.
    pub error_map: Vec<u32>,
    /// The largest error, in levels of 255; `None` where nothing can be compared.
    pub error: Option<f64>,
}

impl Comparison {
    /// Compares the picture of `view`.
    ///
    /// # Errors
    /// If the picture does not fit in memory, or the work is cancelled.
    pub async fn of(
        world: &mut World,
        view: &View,
        level: Level,
        monitor: Monitor<'_>,
    ) -> anyhow::Result<Comparison> {
        let mut frame = Frame::new(Keep::Levels, Workers::alone(level));
        let mut exact_pixels = memory::reserve_pixels(view.size)?;
        let mut error_map = memory::reserve_pixels(view.size)?;
        let mut largest: Option<f64> = None;
        for rows in bands(view.size[1]) {
            systems::draw_rows(world, view, rows.clone(), &mut frame)?;
            let phong = view.shaded(ShadingMode::Phong);
            let exact = reference::picture(world, &phong, rows, monitor).await?;
            let (drawn, compared) = (Picture::from(&frame), Picture::from(&exact));
            let error = metrics::compare(drawn, compared).error.map(|it| it.max);
            largest = largest.into_iter().chain(error).reduce(f64::max);
            error_map.extend(metrics::compared(drawn, compared).map(color_of));
            exact_pixels.extend(exact.levels.into_iter().map(display_pixel));
        }
        Ok(Comparison {
            exact: exact_pixels,
            error_map,
            error: largest,
        })
    }
}
