//! Promises that the picture of every valid scene keeps.

use fearless_simd::Level;
use hecs::World;
use shadetrade::components::{ShadingMode, View};
use shadetrade::output::Monitor;
use shadetrade::output::finished;
use shadetrade::questions::prove::prove;
use shadetrade::reference;

/// Proves the picture of `view` in every mode, at its tolerance and exactly.
///
/// # Panics
/// If a pixel is refuted, or a level of the assignment's shortcut is undefined.
pub fn check(world: &mut World, view: &View) {
    for mode in ShadingMode::ALL {
        for tolerance in [view.tolerance, 0.0] {
            let view = view.shaded(mode).with_tolerance(tolerance);
            let proof = finished(prove(world, &view, None, Level::new(), Monitor::NONE));
            let proof = proof.expect("a small picture fits");
            assert_eq!(proof.refuted, 0, "{view:?}\n{:?}", proof.examples);
        }
    }
    let shortcut = view.shaded(ShadingMode::UnitVectors);
    let rows = 0..view.size[1];
    let picture = finished(reference::picture(world, &shortcut, rows, Monitor::NONE));
    let picture = picture.expect("a small picture fits");
    let mut levels = picture.levels.as_flattened().iter();
    assert!(!levels.any(|level| level.is_nan()), "{shortcut:?}");
}
