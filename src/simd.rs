//! The SIMD levels by name, a word of the command line in, a level this machine has out.
//!
//! Rules: a level the machine lacks is never replaced by another one. A function that takes lanes is `#[inline(always)]`, for
//! compiled by itself it would have no level; other functions only where leaving that out was measured to cost.

use fearless_simd::{Level, Simd};

pub(crate) use fearless_simd::dispatch;

/// The levels that can be asked for, besides the best one there is. The fallback is what every machine of a kind has: SSE2
/// on 64-bit x86.
pub const NAMES: [&str; 5] = ["fallback", "sse4.2", "avx2", "avx512", "neon"];

/// The level called `name`, if it is one of [`NAMES`] and this machine has it.
pub fn named(name: &str) -> Option<Level> {
    match name {
        "fallback" => Some(Level::baseline()),
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

/// The lanes that every machine of a kind has.
#[cfg(target_arch = "x86_64")]
pub type Baseline = fearless_simd::x86::Sse2;
/// The lanes that every machine of a kind has.
#[cfg(target_arch = "aarch64")]
pub type Baseline = fearless_simd::aarch64::Neon;
/// The lanes that every machine of a kind has.
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
pub type Baseline = fearless_simd::Fallback;

/// A token for those, for what has no level of its own.
pub fn baseline() -> Option<Baseline> {
    #[cfg(target_arch = "x86_64")]
    return Level::baseline().as_sse2();
    #[cfg(target_arch = "aarch64")]
    return Level::baseline().as_neon();
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    return Some(fearless_simd::Fallback::new());
}

/// The same for unit tests, on machines of a kind that has one.
#[cfg(test)]
pub(crate) fn token() -> Baseline {
    baseline().expect("every machine has them")
}

/// Does `work` at a SIMD level, in a function of its own.
#[inline(never)]
pub(crate) fn outline<S: Simd, R>(simd: S, work: impl FnOnce() -> R) -> R {
    simd.vectorize(work)
}

/// [`outline`] for a closure, all of whose code is part of that function.
macro_rules! outlined {
    ($simd:expr, $work:expr) => {
        $crate::simd::outline(
            $simd,
            #[inline(always)]
            || $work,
        )
    };
}

/// A closure whose code is part of the function that calls it; only one that is handed to a function can be told so.
macro_rules! inlined {
    ($closure:expr) => {
        std::convert::identity(
            #[inline(always)]
            $closure,
        )
    };
}

/// The value of an expression for each index. Unlike [`array::map`](array#method.map), which is a function of its own, it is
/// part of the loop where it stands and so has its SIMD level.
macro_rules! each {
    ([$($number:literal),*], |$index:ident| $value:expr) => {
        [$({ let $index: usize = $number; $value }),*]
    };
}

/// [`each`] for 0 and 1.
macro_rules! two {
    (|$index:ident| $value:expr) => {
        $crate::simd::each!([0, 1], |$index| $value)
    };
}

/// [`each`] for 0, 1 and 2.
macro_rules! three {
    (|$index:ident| $value:expr) => {
        $crate::simd::each!([0, 1, 2], |$index| $value)
    };
}

/// [`each`] for 0, 1, 2 and 3.
macro_rules! four {
    (|$index:ident| $value:expr) => {
        $crate::simd::each!([0, 1, 2, 3], |$index| $value)
    };
}

pub(crate) use {each, four, inlined, outlined, three, two};

/// What `level` is called.
pub fn name(level: Level) -> &'static str {
    match level {
        #[cfg(target_arch = "x86_64")]
        Level::Sse4_2(_) => "sse4.2",
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => "avx2",
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => "avx512",
        #[cfg(target_arch = "aarch64")]
        Level::Neon(_) => "neon",
        _ => "fallback",
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
