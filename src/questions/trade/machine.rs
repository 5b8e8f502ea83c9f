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
        let read = |path, key, otherwise: &str| {
            let text = fs::read_to_string(path).unwrap_or_default();
            value_of(key, &text).unwrap_or(otherwise).to_owned()
        };
        let system = read("/etc/os-release", "PRETTY_NAME", OS);
        Machine {
            cpu: read("/proc/cpuinfo", "model name", ARCH),
            cores: all_cores(),
            lanes: simd::name(level),
            os: format!("{system} {ARCH}"),
            rustc: env!("SHADETRADE_RUSTC"),
            profile: if cfg!(debug_assertions) {
                "debug"
            } else {
                "release"
            },
        }
    }
}

/// The value after `key` and `=` or `:` in the first such line, without quotes.
fn value_of<'a>(key: &str, text: &'a str) -> Option<&'a str> {
    let after_key = |line: &'a str| {
        line.strip_prefix(key)?
            .trim_start()
            .strip_prefix(['=', ':'])
    };
    let value = text.lines().find_map(after_key)?;
    Some(value.trim().trim_matches('"')).filter(|value| !value.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facts_are_read_from_both_kinds_of_file() {
        let cpuinfo = "processor\t: 0\nmodel\t\t: 17\nmodel name\t: Some CPU @ 2 GHz\n";
        assert_eq!(value_of("model name", cpuinfo), Some("Some CPU @ 2 GHz"));
        let release = "NAME=\"Debian\"\nPRETTY_NAME=\"Debian GNU/Linux 12\"\n";
        assert_eq!(
            value_of("PRETTY_NAME", release),
            Some("Debian GNU/Linux 12")
        );
        assert_eq!(value_of("model name", release), None);
        assert_eq!(value_of("NAME", "NAME=\n"), None);
    }
}
