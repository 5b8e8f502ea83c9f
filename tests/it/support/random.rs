//! Random numbers that are equal on every machine (splitmix64; Steele, Lea and Flood 2014).

use glam::DVec3;

/// A stream of random numbers, given by its seed.
pub struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number in `from..to`, evenly distributed.
    pub fn within(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * ((self.next() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// A number from `least` to `most`, evenly distributed in the logarithm.
    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        self.within(least.ln(), most.ln()).exp().clamp(least, most)
    }

    /// A whole number in `0..count`.
    pub fn below(&mut self, count: usize) -> usize {
        self.within(0.0, count as f64) as usize
    }

    pub fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    /// A vector with coordinates in `-reach..reach`.
    pub fn around(&mut self, reach: f64) -> DVec3 {
        DVec3::ZERO.map(|_| self.within(-reach, reach))
    }

    /// A unit vector.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let vector = self.around(1.0);
            if vector.length() > 0.1 {
                return vector.normalize();
            }
        }
    }
}
