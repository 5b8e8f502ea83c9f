//! Levels in, pixels out: the display step, done once and last.
//!
//! Rule: `byte = floor(clamp(level, 0, 255) + 0.5)`, NaN gives 0; no gamma, levels are display-referred.

use super::TileRow;

/// One row of a tile or block, ready to be shown, lane by lane.
pub trait Row {
    /// 0x00RRGGBB.
    fn pixel(&self, lane: usize) -> u32;

    /// The levels of which that is the display step, unclamped.
    fn levels(&self, lane: usize) -> [f32; 3];
}

/// Levels whose every bit counts.
pub struct Exact<'a>(pub &'a TileRow);

impl Row for Exact<'_> {
    #[inline(always)]
    fn pixel(&self, lane: usize) -> u32 {
        pack(self.levels(lane).map(display_bits))
    }

    #[inline(always)]
    fn levels(&self, lane: usize) -> [f32; 3] {
        [0, 1, 2].map(|channel| self.0[channel][lane])
    }
}

/// Levels whose last bit may be rounded away.
pub struct Approximate<'a>(pub &'a TileRow);

impl Row for Approximate<'_> {
    #[inline(always)]
    fn pixel(&self, lane: usize) -> u32 {
        pack(self.levels(lane).map(display_bits_within))
    }

    #[inline(always)]
    fn levels(&self, lane: usize) -> [f32; 3] {
        [0, 1, 2].map(|channel| self.0[channel][lane])
    }
}

/// The contract's display step: `floor(clamp(level, 0, 255) + 0.5)`, NaN gives 0.
pub fn display_step(level: f64) -> u8 {
    let positive = if level > 0.0 { level } else { 0.0 };
    (positive.min(255.0) + 0.5).floor() as u8
}

/// 2^23: adding it to a float of 0..=255 leaves the nearest integer, halves to even, in the low bits.
const INTEGERS: f32 = 8_388_608.0;

#[inline(always)]
fn clamped(level: f32) -> f32 {
    let positive = if level > 0.0 { level } else { 0.0 };
    if positive < 255.0 { positive } else { 255.0 }
}

/// The display step of f32 levels, the byte in the low bits and the rest as in [`INTEGERS`]: for every float
/// `floor(clamp(level) + 0.5)` in real arithmetic, without the saturating casts that keep loops from vectorising.
#[inline(always)]
pub(super) fn display_bits(level: f32) -> u32 {
    let level = clamped(level);
    let nearest = level + INTEGERS;
    // The subtraction is exact; a half that went down to even is put right.
    let half = level - (nearest - INTEGERS) == 0.5;
    nearest.to_bits() + u32::from(half)
}

/// The same where levels are approximations anyway: halves go up, and so does the one float below an odd half.
#[inline(always)]
pub(super) fn display_bits_within(level: f32) -> u32 {
    (f32::from_bits(clamped(level).to_bits() + 1) + INTEGERS).to_bits()
}

/// Three display bits as 0x00RRGGBB; shifting drops what is not the byte.
#[inline(always)]
pub(super) fn pack([red, green, blue]: [u32; 3]) -> u32 {
    red << 16 | green << 8 | blue & 0xff
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_display_step_rounds_halves_up_and_survives_anything() {
        for (level, byte) in [
            (f64::NAN, 0),
            (f64::NEG_INFINITY, 0),
            (f64::INFINITY, 255),
            (-0.0, 0),
            (-3.0, 0),
            (0.499_999_99, 0),
            (0.5, 1),
            (1.5, 2),
            (2.5, 3),
            (254.499, 254),
            (254.5, 255),
            (255.0, 255),
            (1e30, 255),
        ] {
            assert_eq!(display_step(level), byte, "{level}");
            let byte = u32::from(display_step(f64::from(level as f32)));
            let level = level as f32;
            assert_eq!(
                pack([display_bits(level); 3]),
                byte * 0x0001_0101,
                "{level} in f32"
            );
            assert_eq!(
                pack([display_bits_within(level); 3]),
                byte * 0x0001_0101,
                "{level} in f32, within"
            );
        }
    }

    #[test]
    fn the_fast_display_steps_are_the_plain_one_on_every_kind_of_float() {
        // Every 257th of all floats, and all those next to a half.
        let everywhere = (0..=u32::MAX / 257).map(|step| f32::from_bits(step * 257));
        let halves = (0..=255).flat_map(|level| {
            let half = (level as f32 + 0.5).to_bits();
            (half - 3..=half + 3).map(f32::from_bits)
        });
        for level in everywhere.chain(halves) {
            let byte = u32::from(display_step(f64::from(level)));
            assert_eq!(display_bits(level) & 0xff, byte, "{level}");
            let early = u32::from(display_step(f64::from(f32::from_bits(
                level.to_bits().wrapping_add(1),
            ))));
            let within = display_bits_within(level) & 0xff;
            assert!(
                within == byte || within == early,
                "{level}: {within}, not {byte}"
            );
        }
    }
}
