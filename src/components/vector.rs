//! Lengths and directions of vectors of any magnitude.

use glam::DVec3;

/// The length of `v`. Squares of very large and very small vectors neither overflow nor underflow.
pub fn length(v: DVec3) -> f64 {
    let largest = v.abs().max_element();
    if largest > 0.0 && largest.is_finite() {
        (v / largest).length() * largest
    } else {
        0.0
    }
}

/// `v` scaled to length 1; zero if `v` is zero or not finite.
pub fn unit(v: DVec3) -> DVec3 {
    let largest = v.abs().max_element();
    if largest > 0.0 && largest.is_finite() {
        let scaled = v / largest;
        scaled / scaled.length()
    } else {
        DVec3::ZERO
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_length_is_right_however_large_or_small() {
        for scale in [1e-300, 1e-100, 1.0, 1e100, 1e300] {
            let long = length(DVec3::new(-3.0, 0.0, 4.0) * scale);
            assert!((long / scale - 5.0).abs() < 1e-14, "{long} at {scale}");
        }
        assert_eq!(length(DVec3::ZERO), 0.0);
    }

    #[test]
    fn what_has_no_direction_has_no_unit_vector() {
        for vector in [
            DVec3::ZERO,
            DVec3::new(f64::INFINITY, 1.0, 0.0),
            DVec3::NEG_INFINITY,
            DVec3::NAN,
        ] {
            assert_eq!(unit(vector), DVec3::ZERO, "{vector}");
        }
    }
}
