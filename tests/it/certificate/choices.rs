//! More random choices.

use glam::DVec3;

use crate::support::random::Random;

impl Random {
    /// A number between two powers of ten, evenly distributed in the logarithm.
    pub fn decade(&mut self, from: f64, to: f64) -> f64 {
        10.0_f64.powf(self.within(from, to))
    }

    pub fn vector(&mut self, from: f64, to: f64) -> DVec3 {
        DVec3::from_array([0; 3].map(|_| self.within(from, to)))
    }

    pub fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.within(0.0, choices.len() as f64) as usize]
    }
}
