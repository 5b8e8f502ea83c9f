//! The SIMD levels by name, a word of the command line in, a level this machine has out; and work done at one of them.
//!
//! Rule: a level the machine lacks is never replaced by another one.

use fearless_simd::{Level, Simd};

/// The levels that can be asked for, besides the best one there is.
pub const NAMES: [&str; 5] = ["fallback", "sse4.2", "avx2", "avx512", "neon"];

/// The level called `name`, if it is one of [`NAMES`] and this machine has it.
pub fn named(name: &str) -> Option<Level> {
    match name {
        "fallback" => Some(Level::fallback()),
        #[cfg(target_arch = "x86_64")]
        "sse4.2" => Level::new().as_sse4_2().map(Level::Sse4_2),
        #[cfg(target_arch = "x86_64")]
        "avx2" => Level::new().as_avx2().map(Level::Avx2),
        #[cfg(target_arch = "x86_64")]
        "avx512" => Level::new().as_avx512().map(Level::Avx512),
        #[cfg(target_arch = "aarch64")]
        "neon" => Level::new().as_neon().map(Level::Neon),
        _ => None,
    }
}

/// Does `work` at a SIMD level, in a function of its own: where that is one of several things that may have to be done in
/// a loop, the compiler would else prepare for all of them each time round.
#[inline(never)]
pub(crate) fn apart<S: Simd, R>(simd: S, work: impl FnOnce() -> R) -> R {
    simd.vectorize(work)
}

/// What `level` is called.
///
/// Besides [`NAMES`] there is `sse2`: what the best level comes to on the oldest 64-bit x86 machines.
pub fn name(level: Level) -> &'static str {
    match level {
        Level::Fallback(_) => "fallback",
        #[cfg(target_arch = "x86_64")]
        Level::Sse2(_) => "sse2",
        #[cfg(target_arch = "x86_64")]
        Level::Sse4_2(_) => "sse4.2",
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => "avx2",
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => "avx512",
        #[cfg(target_arch = "aarch64")]
        Level::Neon(_) => "neon",
        _ => "unknown",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_that_is_found_bears_the_name_it_was_asked_by() {
        for asked in NAMES {
            if let Some(level) = named(asked) {
                assert_eq!(name(level), asked);
            }
        }
    }

    #[test]
    fn every_machine_has_the_fallback_and_none_has_every_level() {
        assert!(named("fallback").is_some());
        assert!(
            NAMES.iter().any(|level| named(level).is_none()),
            "no machine is both x86 and ARM"
        );
        assert!(named("auto").is_none());
    }
}
