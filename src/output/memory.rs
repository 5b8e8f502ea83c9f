//! A check of the free memory before a large allocation, and the rule by which buffers are given back.
//!
//! On Linux an allocation beyond the free memory succeeds, and the kernel kills the program that writes to it
//! (overcommit). Other systems lack `/proc/meminfo`; they refuse an allocation without memory for it, or swap.

use std::collections::TryReserveError;
use std::fs;

/// Allocations of up to this many bytes are not checked.
const LARGE: usize = 16 << 20;
/// Bytes kept free for small allocations, whose failure would end the program without a message.
const SPARE: usize = 32 << 20;

/// The pictures of a work do not fit in memory.
#[derive(Debug, thiserror::Error)]
#[error(
    "a picture of {}x{} pixels does not fit in memory: it takes {}, {}",
    .size[0], .size[1], megabytes(*.needed), left_text(*.left)
)]
pub struct OutOfMemory {
    /// Width and height of a picture, in pixels.
    pub size: [usize; 2],
    /// Bytes to allocate.
    pub needed: usize,
    /// Bytes available without swapping, if known.
    pub left: Option<usize>,
}

/// Checks that `needed` more bytes are available for a picture of `size` pixels.
///
/// # Errors
/// If the system reports fewer.
pub fn check(size: [usize; 2], needed: usize) -> Result<(), OutOfMemory> {
    if needed <= LARGE {
        return Ok(());
    }
    let left = available().map(|bytes| bytes.saturating_sub(SPARE));
    match left {
        Some(bytes) if bytes < needed => Err(OutOfMemory { size, needed, left }),
        _ => Ok(()),
    }
}

/// An empty vector with capacity for every pixel of a picture of `size`.
///
/// # Errors
/// If the system reports too little memory or refuses the allocation.
pub fn reserve_pixels<T>(size: [usize; 2]) -> Result<Vec<T>, OutOfMemory> {
    let pixels = size[0].saturating_mul(size[1]);
    let needed = pixels.saturating_mul(size_of::<T>());
    check(size, needed)?;
    let mut list = Vec::new();
    list.try_reserve_exact(pixels)
        .map_err(refused(size, needed))?;
    Ok(list)
}

/// A buffer with room for more than this many times its content is given back.
const SEVERAL: usize = 4;

/// Empties a buffer that will hold `len` elements next. It keeps its memory unless that is several times too large.
pub fn clear<T>(list: &mut Vec<T>, len: usize) {
    list.clear();
    if list.capacity() / SEVERAL > len {
        *list = Vec::new();
    }
}

/// Converts a refused allocation for a picture of `size` pixels, `needed` bytes in all, into [`OutOfMemory`].
pub fn refused(size: [usize; 2], needed: usize) -> impl Fn(TryReserveError) -> OutOfMemory {
    let left = None;
    move |_| OutOfMemory { size, needed, left }
}

/// Bytes available without swapping, if the system reports them.
fn available() -> Option<usize> {
    mem_available(&fs::read_to_string("/proc/meminfo").ok()?)
}

/// The kernel's own estimate (proc_meminfo(5), `MemAvailable`, since Linux 3.14), in bytes.
fn mem_available(table: &str) -> Option<usize> {
    let mut rows = table.lines();
    let row = rows.find_map(|row| row.strip_prefix("MemAvailable:"))?;
    let kibibytes: usize = row.split_whitespace().next()?.parse().ok()?;
    kibibytes.checked_mul(1024)
}

/// A number of bytes in megabytes.
fn megabytes(bytes: usize) -> String {
    format!("{:.0} MB", bytes as f64 / 1e6)
}

/// The end of a message about too little memory.
fn left_text(left: Option<usize>) -> String {
    left.map_or_else(
        || "more than the system grants".to_owned(),
        |bytes| format!("and {} are left", megabytes(bytes)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mem_available_is_read_in_bytes() {
        let table = "MemFree:          1 kB\nMemAvailable:   17482340 kB\nBuffers: 7 kB\n";
        assert_eq!(mem_available(table), Some(17_482_340 * 1024));
        for table in ["MemFree: 1 kB\n", "MemAvailable: many kB\n"] {
            assert_eq!(mem_available(table), None);
        }
    }

    #[test]
    fn a_buffer_is_given_back_if_it_is_several_times_too_large() {
        let mut list = vec![0; 400];
        clear(&mut list, 100);
        assert_eq!((list.len(), list.capacity()), (0, 400));
        clear(&mut list, 99);
        assert_eq!(list.capacity(), 0);
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn half_of_the_address_space_is_refused_with_both_numbers() {
        let error =
            check([16384, 16384], usize::MAX / 2).expect_err("nobody has half of all addresses");
        assert!(error.left.is_some_and(|left| left > LARGE));
        let said = error.to_string();
        assert!(
            said.contains("16384x16384")
                && said.contains(" MB, and ")
                && said.ends_with(" MB are left")
        );
        check([1, 1], LARGE).expect("a small allocation is not checked");
        assert!(reserve_pixels::<[u8; 1 << 40]>([16384, 16384]).is_err());
    }
}
