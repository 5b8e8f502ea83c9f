//! A check of the free memory before a large allocation, and the rule by which buffers are given back.
//!
//! On Linux an allocation beyond the free memory succeeds, and the kernel kills the program that writes to it
//! (overcommit). Other systems lack `/proc/meminfo`; they refuse an allocation without memory for it, or swap.

use std::collections::TryReserveError;
use std::{fmt, fs};

/// Allocations of up to this many bytes are not checked.
const LARGE: usize = 16 << 20;
/// Bytes kept free for small allocations, whose failure would end the program without a message.
const SPARE: usize = 32 << 20;

/// The purpose of an allocation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// A picture, or several of its size: width and height, in pixels.
    Picture([usize; 2]),
    /// The grids of this number of cuboids with several segments.
    Grids(usize),
}

impl From<[usize; 2]> for Content {
    fn from(size: [usize; 2]) -> Self {
        Content::Picture(size)
    }
}

impl fmt::Display for Content {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Content::Picture([width, height]) => {
                write!(formatter, "a picture of {width}x{height} pixels")
            }
            Content::Grids(1) => write!(formatter, "the grids of 1 cuboid"),
            Content::Grids(cuboids) => write!(formatter, "the grids of {cuboids} cuboids"),
        }
    }
}

/// Something does not fit in memory.
#[derive(Debug, thiserror::Error)]
#[error("memory has no room for {content}: {:.0} MB are needed", *.needed as f64 / 1e6)]
pub struct OutOfMemory {
    pub content: Content,
    /// Bytes to allocate.
    pub needed: usize,
}

/// Checks that `needed` more bytes are available.
///
/// # Errors
/// If the system reports fewer.
pub fn check(content: impl Into<Content>, needed: usize) -> Result<(), OutOfMemory> {
    if needed > LARGE && available().is_some_and(|bytes| bytes.saturating_sub(SPARE) < needed) {
        let content = content.into();
        return Err(OutOfMemory { content, needed });
    }
    Ok(())
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

/// Converts a refused allocation of `needed` bytes into [`OutOfMemory`].
pub fn refused(
    content: impl Into<Content>,
    needed: usize,
) -> impl FnOnce(TryReserveError) -> OutOfMemory {
    let content = content.into();
    move |_| OutOfMemory { content, needed }
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
    fn half_of_the_address_space_is_refused_in_words_that_say_what_does_not_fit() {
        let half = usize::MAX / 2;
        for (content, words) in [
            (
                Content::Picture([16384, 100]),
                "a picture of 16384x100 pixels",
            ),
            (Content::Grids(6000), "the grids of 6000 cuboids"),
            (Content::Grids(1), "the grids of 1 cuboid"),
        ] {
            let error = check(content, half).expect_err("nobody has half of all addresses");
            assert_eq!((error.content, error.needed), (content, half));
            assert!(
                error.to_string().contains(&format!("{words}: 92233720368")),
                "{error}"
            );
        }
        check([1, 1], LARGE).expect("a small allocation is not checked");
        assert!(reserve_pixels::<[u8; 1 << 40]>([16384, 16384]).is_err());
    }
}
