//! The machine of a measurement, which a reader must know before comparing times.

use std::env::consts::{ARCH, OS};
use std::fs;

use fearless_simd::Level;
use serde::Serialize;

use crate::questions::job::all_cores;
use crate::shading::simd;

/// The machine and the build, on which times depend.
#[derive(Clone, Debug, Serialize)]
pub struct Machine {
    /// The name of the processor if the system tells it, otherwise its architecture.
    pub cpu: String,
    /// The threads that it runs in parallel.
    pub cores: usize,
    /// The SIMD level that drew.
    pub lanes: &'static str,
    /// The system and its architecture.
    pub os: String,
    /// The compiler.
    pub rustc: &'static str,
    /// `release`, or `debug` with assertions.
    pub profile: &'static str,
}

impl Machine {
    /// This machine with a SIMD level.
    pub fn this(level: Level) -> Self {
        let table = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        Machine {
            cpu: model_name(&table).unwrap_or(ARCH).to_owned(),
            cores: all_cores(),
            lanes: simd::name(level),
            os: format!("{OS} {ARCH}"),
            rustc: env!("SHADETRADE_RUSTC"),
            profile: if cfg!(debug_assertions) {
                "debug"
            } else {
                "release"
            },
        }
    }
}

/// The name of the processor in Linux's table of processors.
fn model_name(table: &str) -> Option<&str> {
    let mut lines = table.lines();
    let after_key = lines.find_map(|line| line.strip_prefix("model name"))?;
    Some(after_key.trim_start().strip_prefix(':')?.trim())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_processor_has_its_name() {
        let table = "processor\t: 0\nmodel\t\t: 17\nmodel name\t: Some CPU @ 2 GHz\n";
        assert_eq!(model_name(table), Some("Some CPU @ 2 GHz"));
        assert_eq!(model_name("model\t\t: 17\n"), None);
    }
}
