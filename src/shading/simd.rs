//! The SIMD levels by name, and helpers that compile a loop for one level.
//!
//! A level that the machine lacks is never replaced by another one. A function over SIMD lanes is `#[inline(always)]`,
//! because compiled on its own it would use the baseline instructions. Other functions are marked only if it was
//! measured to be faster.

use std::mem::discriminant;

use fearless_simd::{Level, Simd};

/// The levels that can be selected by name. The fallback is the baseline of the architecture: SSE2 on 64-bit x86, Neon
/// on 64-bit ARM, simd128 in a browser.
pub const NAMES: [&str; 4] = ["fallback", "avx2", "avx512", "neon"];

/// The level called `name`, if it is one of [`NAMES`] and this machine has it.
pub fn named(name: &str) -> Option<Level> {
    match name {
        "fallback" => Some(Level::baseline()),
        #[cfg(target_arch = "x86_64")]
        "avx2" => Level::new().as_avx2().map(Level::Avx2),
        #[cfg(target_arch = "x86_64")]
        "avx512" => Level::new().as_avx512().map(Level::Avx512),
        #[cfg(target_arch = "aarch64")]
        "neon" => Level::new().as_neon().map(Level::Neon),
        _ => None,
    }
}

/// The SIMD lanes of every machine of the architecture.
#[cfg(target_arch = "x86_64")]
pub type Baseline = fearless_simd::x86::Sse2;
/// The SIMD lanes of every machine of the architecture.
#[cfg(target_arch = "aarch64")]
pub type Baseline = fearless_simd::aarch64::Neon;
/// The SIMD lanes of every machine of the architecture.
#[cfg(target_arch = "wasm32")]
pub type Baseline = fearless_simd::wasm32::WasmSimd128;
/// The SIMD lanes of every machine of the architecture.
#[cfg(not(any(
    target_arch = "x86_64",
    target_arch = "aarch64",
    target_arch = "wasm32"
)))]
pub type Baseline = fearless_simd::Fallback;

/// The token of [`Baseline`], for code that is not compiled for every level.
///
/// # Panics
/// Never: each machine of an architecture has its baseline.
pub fn baseline() -> Baseline {
    let level = Level::baseline();
    #[cfg(target_arch = "x86_64")]
    let token = level.as_sse2();
    #[cfg(target_arch = "aarch64")]
    let token = level.as_neon();
    #[cfg(target_arch = "wasm32")]
    let token = level.as_wasm_simd128();
    #[cfg(not(any(
        target_arch = "x86_64",
        target_arch = "aarch64",
        target_arch = "wasm32"
    )))]
    let token = level.is_fallback().then(fearless_simd::Fallback::new);
    token.expect("every machine has the baseline")
}

/// Runs an expression with the lanes of a level, compiled for AVX-512, for AVX2 and for the baseline. A level between those
/// runs as the baseline: SSE4.2 takes 0.96 to 1.02 of the instructions of SSE2 in eight views, and would add half as much
/// machine code again.
macro_rules! dispatch {
    ($level:expr, $simd:ident => $work:expr) => {
        match $level {
            #[cfg(target_arch = "x86_64")]
            fearless_simd::Level::Avx512($simd) => $crate::shading::simd::vectorized!($simd, $work),
            #[cfg(target_arch = "x86_64")]
            fearless_simd::Level::Avx2($simd) => $crate::shading::simd::vectorized!($simd, $work),
            _ => {
                let $simd = $crate::shading::simd::baseline();
                $crate::shading::simd::vectorized!($simd, $work)
            }
        }
    };
}

/// An expression compiled for the lanes of a token.
macro_rules! vectorized {
    ($simd:expr, $work:expr) => {
        fearless_simd::Simd::vectorize(
            $simd,
            #[inline(always)]
            || $work,
        )
    };
}

/// Runs `work` at a SIMD level, in a function that is not inlined.
#[inline(never)]
pub(crate) fn outline<S: Simd, R>(simd: S, work: impl FnOnce() -> R) -> R {
    simd.vectorize(work)
}

/// [`outline`] for a closure that is inlined into that function.
macro_rules! outlined {
    ($simd:expr, $work:expr) => {
        $crate::shading::simd::outline(
            $simd,
            #[inline(always)]
            || $work,
        )
    };
}

/// A closure that is inlined into its caller. The attribute is legal only on a closure that is an argument.
macro_rules! inlined {
    ($closure:expr) => {
        std::convert::identity(
            #[inline(always)]
            $closure,
        )
    };
}

/// An array with the value of an expression for each index. Unlike [`array::map`](array#method.map) it is not a function
/// call, so the expression has the SIMD level of the surrounding loop.
macro_rules! each {
    ([$($number:literal),*], |$index:ident| $value:expr) => {
        [$({ let $index: usize = $number; $value }),*]
    };
}

/// [`each`] for 0 and 1.
macro_rules! two {
    (|$index:ident| $value:expr) => {
        $crate::shading::simd::each!([0, 1], |$index| $value)
    };
}

/// [`each`] for 0, 1 and 2.
macro_rules! three {
    (|$index:ident| $value:expr) => {
        $crate::shading::simd::each!([0, 1, 2], |$index| $value)
    };
}

/// [`each`] for 0, 1, 2 and 3.
macro_rules! four {
    (|$index:ident| $value:expr) => {
        $crate::shading::simd::each!([0, 1, 2, 3], |$index| $value)
    };
}

pub(crate) use {dispatch, each, four, inlined, outlined, three, two, vectorized};

/// The name of `level`; the last if it has several.
pub fn name(level: Level) -> &'static str {
    let is_own = |own: Level| discriminant(&own) == discriminant(&level);
    let mut names = NAMES.into_iter();
    let name = names.rfind(|name| named(name).is_some_and(is_own));
    name.unwrap_or("fallback")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_of_a_level_finds_that_level() {
        for level in NAMES.into_iter().filter_map(named) {
            let found = named(name(level)).expect("it has a name");
            assert_eq!(discriminant(&found), discriminant(&level));
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
