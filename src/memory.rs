//! How many bytes a picture takes -> whether this machine has them.
//!
//! Rule: what is large is asked for here before it is allocated. An allocation itself says nothing: Linux grants more
//! than there is and kills the program once that is written to (overcommit). Elsewhere the allocation alone decides.

use std::collections::TryReserveError;
use std::fmt;

/// Bytes up to which nobody asks how many there are.
const LARGE: usize = 256 << 20;

/// The picture does not fit in memory.
#[derive(Debug, thiserror::Error)]
#[error(
    "a picture of {}x{} pixels does not fit in memory: it takes {}, {}",
    .size[0],
    .size[1],
    Bytes(*.needed),
    Left(*.left)
)]
pub struct OutOfMemory {
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// Bytes that were to be allocated.
    pub needed: usize,
    /// Bytes that can be had without anything being swapped or killed, where that is known.
    pub left: Option<usize>,
}

/// Whether `needed` bytes more for a picture of `size` pixels can be had.
///
/// # Errors
/// When the system says that there are fewer.
pub fn check(size: [usize; 2], needed: usize) -> Result<(), OutOfMemory> {
    if needed <= LARGE {
        return Ok(());
    }
    let left = available();
    match left {
        Some(bytes) if bytes < needed => Err(OutOfMemory { size, needed, left }),
        _ => Ok(()),
    }
}

/// An empty list with room for a value of every pixel of a picture of `size`.
///
/// # Errors
/// When the system says that there is no such room, or does not grant it.
pub fn room_for_pixels<T>(size: [usize; 2]) -> Result<Vec<T>, OutOfMemory> {
    let pixels = size[0].saturating_mul(size[1]);
    let needed = pixels.saturating_mul(size_of::<T>());
    check(size, needed)?;
    let mut list = Vec::new();
    list.try_reserve_exact(pixels)
        .map_err(refused(size, needed))?;
    Ok(list)
}

/// What an allocation for a picture of `size` pixels, `needed` bytes in all, fails with.
pub fn refused(size: [usize; 2], needed: usize) -> impl Fn(TryReserveError) -> OutOfMemory {
    move |_| OutOfMemory {
        size,
        needed,
        left: None,
    }
}

/// Bytes that can be had without swapping: the kernel's own estimate (proc_meminfo(5), `MemAvailable`, since Linux 3.14).
#[cfg(target_os = "linux")]
fn available() -> Option<usize> {
    let table = std::fs::read_to_string("/proc/meminfo").ok()?;
    available_of(&table)
}

/// Other systems refuse an allocation that they cannot back, or swap for it.
#[cfg(not(target_os = "linux"))]
fn available() -> Option<usize> {
    None
}

/// The row `MemAvailable:   17482340 kB` of that table, in bytes.
#[cfg(target_os = "linux")]
fn available_of(table: &str) -> Option<usize> {
    let row = table
        .lines()
        .find_map(|row| row.strip_prefix("MemAvailable:"))?;
    let kibibytes: usize = row.trim().strip_suffix("kB")?.trim_end().parse().ok()?;
    kibibytes.checked_mul(1024)
}

/// A number of bytes as people read it.
struct Bytes(usize);

impl fmt::Display for Bytes {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        write!(formatter, "{:.0} MB", self.0 as f64 / 1e6)
    }
}

/// How a message about too little memory ends.
struct Left(Option<usize>);

impl fmt::Display for Left {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        match self.0 {
            Some(bytes) => write!(formatter, "and {} are left", Bytes(bytes)),
            None => write!(formatter, "more than the system grants"),
        }
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn the_kernel_s_row_is_read_in_bytes() {
        let table = "MemTotal:       24612345 kB\nMemFree:          1 kB\nMemAvailable:   17482340 kB\nBuffers: 7 kB\n";
        assert_eq!(available_of(table), Some(17_482_340 * 1024));
        assert_eq!(available_of("MemFree: 1 kB\n"), None);
        assert_eq!(available_of("MemAvailable: many kB\n"), None);
    }

    #[test]
    fn what_no_machine_has_is_refused_with_both_numbers() {
        let error =
            check([16384, 16384], usize::MAX / 2).expect_err("nobody has half of all addresses");
        assert!(error.left.is_some_and(|left| left > LARGE));
        let said = error.to_string();
        assert!(
            said.contains("16384x16384")
                && said.contains(" MB, and ")
                && said.ends_with(" MB are left")
        );
        check([1, 1], LARGE).expect("what is small is not asked for");
        assert!(room_for_pixels::<[u8; 1 << 40]>([16384, 16384]).is_err());
    }
}
