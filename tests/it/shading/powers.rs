//! The specular power in f32 against f64.

use fearless_simd::f32x16;
use fearless_simd::prelude::*;
use shadetrade::shading::specular::{power, power_exact};
use shadetrade::simd::baseline;

#[test]
fn the_power_errs_by_no_more_than_its_series_and_its_roundings() {
    // The error of the logarithm is 9e-8, which y 2^-y reduces to at most 5e-8; that of the exponential is 1.2e-7;
    // three roundings of a float have 6e-8 each.
    let simd = baseline().expect("every machine has them");
    let most = 5e-8 + 1.2e-7 + 3.0 * 6e-8;
    for shininess in [0.1_f32, 0.5, 1.0, 2.0, 5.0, 10.0, 76.8, 1e3, 1e4, 1e6] {
        for step in 0..=50_000 {
            // Denser near lambda = 0, where a large rho has its highlight.
            let lambda = (2.0 * (f64::from(step) / 50_000.0).powi(4)) as f32;
            let expected = power_exact(f64::from(shininess), f64::from(lambda));
            let found = power(shininess, f32x16::splat(simd, lambda)).as_array()[0];
            let error = (f64::from(found) - expected).abs();
            assert!(error <= most, "rho {shininess}, 1 - s {lambda}: {error}");
        }
    }
}
