//! The colour spaces of FLIP: opponent colours (`YCxCz`) for the filters, Hunt-adjusted L*a*b* for comparisons.
//!
//! White is D65. `linear_from_opponent` is the inverse of `opponent_from_srgb` except for the sRGB curve.

/// From linear sRGB to X, Y and Z in shares of D65 white's: the numerators of the authors' code.
const RELATIVE_FROM_LINEAR: [[f32; 3]; 3] = [
    shares([10_135_552.0, 8_788_810.0, 4_435_075.0]),
    shares([2_613_072.0, 8_788_810.0, 887_015.0]),
    shares([1_425_312.0, 8_788_810.0, 70_074_185.0]),
];

const fn shares([a, b, c]: [f64; 3]) -> [f32; 3] {
    let sum = a + b + c;
    [(a / sum) as f32, (b / sum) as f32, (c / sum) as f32]
}

/// Its inverse.
const LINEAR_FROM_RELATIVE: [[f32; 3]; 3] = [
    [3.080_342, -1.537_398_9, -0.542_942_97],
    [-0.921_178_5, 1.875_930_1, 0.045_248_41],
    [0.052_881_29, -0.204_011_2, 1.151_13],
];

fn transform(matrix: [[f32; 3]; 3], [x, y, z]: [f32; 3]) -> [f32; 3] {
    matrix.map(|[a, b, c]| a * x + b * y + c * z)
}

/// Luminance, red-green and blue-yellow (`YCxCz`; white is 100, 0, 0) of sRGB in 0..=1.
pub fn opponent_from_srgb(srgb: [f32; 3]) -> [f32; 3] {
    // The sRGB curve, IEC 61966-2-1.
    let curve = |value: f32| {
        if value > 0.04045 {
            ((value + 0.055) / 1.055).powf(2.4)
        } else {
            value / 12.92
        }
    };
    let [x, y, z] = transform(RELATIVE_FROM_LINEAR, srgb.map(curve));
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Linear sRGB of opponent colours. After a filter it may be outside 0..=1.
pub fn linear_from_opponent([luminance, red_green, blue_yellow]: [f32; 3]) -> [f32; 3] {
    let y = (luminance + 16.0) / 116.0;
    transform(
        LINEAR_FROM_RELATIVE,
        [y + red_green / 500.0, y, y - blue_yellow / 200.0],
    )
}

/// L*a*b* of linear sRGB in 0..=1, a* and b* in proportion to L* (Hunt's effect).
pub fn hunt_lab(linear: [f32; 3]) -> [f32; 3] {
    const DELTA: f32 = 6.0 / 29.0;
    let [x, y, z] = transform(RELATIVE_FROM_LINEAR, linear).map(|value| {
        if value > DELTA * DELTA * DELTA {
            value.cbrt()
        } else {
            value / (3.0 * DELTA * DELTA) + 4.0 / 29.0
        }
    });
    let lightness = 116.0 * y - 16.0;
    [
        lightness,
        0.01 * lightness * 500.0 * (x - y),
        0.01 * lightness * 200.0 * (y - z),
    ]
}

/// The `HyAB` distance, which is made for large differences (Abasi, Amani Tehran and Fairchild 2020).
pub fn distance(left: [f32; 3], right: [f32; 3]) -> f32 {
    (left[0] - right[0]).abs() + (left[1] - right[1]).hypot(left[2] - right[2])
}
