//! A picture compared with exact Phong, the best picture of the scene: the exact picture, the error map, the largest error.

use fearless_simd::Level;
use hecs::World;

use crate::components::{ShadingMode, View};
use crate::frame::{Frame, Keep, Workers, display_pixel};
use crate::memory;
use crate::report::Monitor;
use crate::systems;
use crate::trade::accuracy::exact;
use crate::trade::error_map::{self, Scale};
use crate::trade::metrics::{self, Picture, displayed};

/// A picture against the reference in f64.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Exact Phong, 0x00RRGGBB.
    pub exact: Vec<u32>,
    /// The error against exact Phong in the colours of `scale`.
    pub error_map: Vec<u32>,
    pub scale: Scale,
    /// The difference to exact Phong, times `amplification`, added to grey; 0x00RRGGBB.
    pub difference: Vec<u32>,
    pub amplification: f64,
    /// The largest error, in levels of 255; `None` where nothing can be compared.
    pub error: Option<f64>,
}

impl Comparison {
    /// Compares the picture of `view`.
    ///
    /// # Errors
    /// If the picture does not fit in memory, or the work is cancelled.
    pub fn of(
        world: &mut World,
        view: &View,
        level: Level,
        monitor: Monitor,
    ) -> anyhow::Result<Comparison> {
        let mut frame = Frame::new(Keep::Levels, Workers::alone(level));
        let mut exact_pixels = memory::reserve_pixels(view.size)?;
        let mut errors = memory::reserve_pixels(view.size)?;
        let mut differences = memory::reserve_pixels(view.size)?;
        let mut largest: Option<f64> = None;
        monitor.in_bands("comparing", view.size[1], |rows| {
            systems::draw_rows(world, view, rows.clone(), &mut frame)?;
            let exact = exact(world, view, ShadingMode::Phong, rows, monitor, |_| ())?;
            let (drawn, compared) = (Picture::from(&frame), Picture::from(&exact));
            let error = metrics::compare(drawn, compared).error;
            if let Some(error) = error {
                largest = Some(largest.map_or(error.max, |largest| largest.max(error.max)));
            }
            errors.extend(error_map::compared(drawn, compared));
            differences.extend((0..drawn.levels.len()).map(|pixel| {
                if !drawn.shows_as(&compared, pixel) {
                    return [0.0; 3];
                }
                let [drawn, exact] = [drawn.levels[pixel].map(f64::from), exact.levels[pixel]];
                [0, 1, 2].map(|it| (displayed(drawn[it]) - displayed(exact[it])) as f32)
            }));
            exact_pixels.extend(exact.levels.iter().copied().map(display_pixel));
            Ok(())
        })?;
        let scale = Scale::holding(largest.unwrap_or(0.0));
        let amplification = amplification(largest.unwrap_or(0.0));
        let amplified = |difference: [f32; 3]| {
            display_pixel(difference.map(|it| 128.0 + amplification * f64::from(it)))
        };
        Ok(Comparison {
            exact: exact_pixels,
            error_map: errors.into_iter().map(|it| scale.color(it)).collect(),
            scale,
            difference: differences.into_iter().map(amplified).collect(),
            amplification,
            error: largest,
        })
    }
}

/// The power of two, 1 to 256, that makes an error as large as the way from grey to white at most.
fn amplification(error: f64) -> f64 {
    (127.0 / error).log2().floor().clamp(0.0, 8.0).exp2()
}
