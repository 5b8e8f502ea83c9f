//! How many bytes a picture takes -> whether this machine has them.
//!
//! Rule: what is large is asked for here before it is allocated. An allocation itself says nothing: Linux grants more
//! than there is and kills the program once that is written to (overcommit). Other systems, which lack the files that are
//! read here, refuse an allocation that they cannot back, or swap for it.

use std::collections::TryReserveError;
use std::fmt::Display;
use std::fs;
use std::path::Path;

/// Allocations up to this, in bytes, are not checked.
const LARGE: usize = 16 << 20;
/// Bytes that are to stay free for everything that is small, whose refusal would end the program without a message.
const SPARE: usize = 32 << 20;

/// Something large does not fit in memory.
#[derive(Debug, thiserror::Error)]
#[error("{what} does not fit in memory: it takes {}, {}", megabytes(*.needed), left_text(*.left))]
pub struct OutOfMemory {
    /// What was to be allocated.
    pub what: String,
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
    let [width, height] = size;
    check_for(format_args!("a picture of {width}x{height} pixels"), needed)
}

/// Whether `needed` bytes more can be had for `what`.
///
/// # Errors
/// When the system says that there are fewer.
pub fn check_for(what: impl Display, needed: usize) -> Result<(), OutOfMemory> {
    if needed <= LARGE {
        return Ok(());
    }
    let left = available().map(|bytes| bytes.saturating_sub(SPARE));
    match left {
        Some(bytes) if bytes < needed => Err(OutOfMemory {
            what: what.to_string(),
            needed,
            left,
        }),
        _ => Ok(()),
    }
}

/// An empty list with room for a value of every pixel of a picture of `size`.
///
/// # Errors
/// When the system says that there is no such room, or does not grant it.
pub fn reserve_pixels<T>(size: [usize; 2]) -> Result<Vec<T>, OutOfMemory> {
    let pixels = size[0].saturating_mul(size[1]);
    let needed = pixels.saturating_mul(size_of::<T>());
    check(size, needed)?;
    let mut list = Vec::new();
    list.try_reserve_exact(pixels)
        .map_err(refused(size, needed))?;
    Ok(list)
}

/// What an allocation for a picture of `size` pixels, `needed` bytes in all, fails with.
pub fn refused(
    [width, height]: [usize; 2],
    needed: usize,
) -> impl Fn(TryReserveError) -> OutOfMemory {
    move |_| OutOfMemory {
        what: format!("a picture of {width}x{height} pixels"),
        needed,
        left: None,
    }
}

/// Bytes that can be had without anything being swapped or killed: of the machine, of the control groups that the
/// process is in, and of its own address space.
fn available() -> Option<usize> {
    let read = |path: &Path| fs::read_to_string(path).ok();
    let left = [left_on_machine, left_in_groups, left_of_addresses];
    left.iter().filter_map(|left| left(&read)).min()
}

/// What a file says, where it can be read.
type Read<'a> = &'a dyn Fn(&Path) -> Option<String>;

/// The kernel's own estimate (proc_meminfo(5), `MemAvailable`, since Linux 3.14).
fn left_on_machine(read: Read) -> Option<usize> {
    kibibytes(&read(Path::new("/proc/meminfo"))?, "MemAvailable:")
}

/// What `ulimit -v` leaves (proc_pid_limits(5), proc_pid_status(5)).
fn left_of_addresses(read: Read) -> Option<usize> {
    let limits = read(Path::new("/proc/self/limits"))?;
    let limit: usize = first_number(&limits, "Max address space")?;
    let used = kibibytes(&read(Path::new("/proc/self/status"))?, "VmSize:")?;
    Some(limit.saturating_sub(used))
}

/// Where control groups of version 2, whose rows name no controller, and of version 1 are: the controller, the folder, and
/// what is called there limit, usage, and cached files long unread (cgroups(7); the kernel's admin-guide/cgroup-v2 and
/// cgroup-v1/memory).
const CONTROL_GROUPS: [[&str; 5]; 2] = [
    [
        "",
        "/sys/fs/cgroup",
        "memory.max",
        "memory.current",
        "inactive_file",
    ],
    [
        "memory",
        "/sys/fs/cgroup/memory",
        "memory.limit_in_bytes",
        "memory.usage_in_bytes",
        "total_inactive_file",
    ],
];

/// What the group of the process and every group around it leaves. Cached files count as used there, though those long
/// unread give way.
fn left_in_groups(read: Read) -> Option<usize> {
    let groups = read(Path::new("/proc/self/cgroup"))?;
    let left = |row: &str| {
        let (controllers, path) = row.split_once(':')?.1.split_once(':')?;
        let is_named = |controller| controllers.split(',').any(|name| name == controller);
        let version = CONTROL_GROUPS.iter().find(|version| is_named(version[0]));
        let [_, root, limit, usage, cached] = *version?;
        let of_group = |group: &Path| {
            let file = |name: &str| read(&Path::new(root).join(group).join(name));
            let bytes = |name: &str| first_number(&file(name)?, "");
            let unread = file("memory.stat").and_then(|stat| first_number(&stat, cached));
            let used = bytes(usage)?.saturating_sub(unread.unwrap_or(0));
            Some(bytes(limit)?.saturating_sub(used))
        };
        let groups = Path::new(path.trim_start_matches('/')).ancestors();
        groups.filter_map(of_group).min()
    };
    groups.lines().filter_map(left).min()
}

/// The number after `key` in the row that starts with it.
fn first_number(table: &str, key: &str) -> Option<usize> {
    let row = table.lines().find_map(|row| row.strip_prefix(key))?;
    row.split_whitespace().next()?.parse().ok()
}

/// The same of a row such as `MemAvailable:   17482340 kB`, in bytes.
fn kibibytes(table: &str, key: &str) -> Option<usize> {
    first_number(table, key)?.checked_mul(1024)
}

/// A number of bytes as people read it.
fn megabytes(bytes: usize) -> String {
    format!("{:.0} MB", bytes as f64 / 1e6)
}

/// How a message about too little memory ends.
fn left_text(left: Option<usize>) -> String {
    left.map_or_else(
        || "more than the system grants".to_owned(),
        |bytes| format!("and {} are left", megabytes(bytes)),
    )
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;
    use std::path::PathBuf;

    use super::*;

    /// A machine on which these files say these things.
    fn machine(files: &[(&str, &str)]) -> impl Fn(&Path) -> Option<String> + use<> {
        let files = files
            .iter()
            .map(|(path, text)| (path.into(), (*text).to_owned()));
        let files: HashMap<PathBuf, String> = files.collect();
        move |path| files.get(path).cloned()
    }

    #[test]
    fn the_kernel_s_rows_are_read_in_bytes() {
        let table = "MemTotal:       24612345 kB\nMemFree:          1 kB\nMemAvailable:   17482340 kB\nBuffers: 7 kB\n";
        let read = machine(&[("/proc/meminfo", table)]);
        assert_eq!(left_on_machine(&read), Some(17_482_340 * 1024));
        for table in ["MemFree: 1 kB\n", "MemAvailable: many kB\n"] {
            assert_eq!(left_on_machine(&machine(&[("/proc/meminfo", table)])), None);
        }
        let limits = "Limit       Soft Limit   Hard Limit   Units\nMax address space   1048576   unlimited   bytes\n";
        let status = ("/proc/self/status", "VmPeak:  900 kB\nVmSize:      24 kB\n");
        let read = machine(&[("/proc/self/limits", limits), status]);
        assert_eq!(left_of_addresses(&read), Some(1000 * 1024));
        let unlimited = limits.replace("1048576", "unlimited");
        let read = machine(&[("/proc/self/limits", &unlimited), status]);
        assert_eq!(left_of_addresses(&read), None);
    }

    #[test]
    fn the_tightest_control_group_decides_in_either_version() {
        let second = [
            ("/proc/self/cgroup", "0::/outer/inner\n"),
            ("/sys/fs/cgroup/outer/inner/memory.max", "max\n"),
            ("/sys/fs/cgroup/outer/inner/memory.current", "5\n"),
            ("/sys/fs/cgroup/outer/memory.max", "1000\n"),
            ("/sys/fs/cgroup/outer/memory.current", "700\n"),
            (
                "/sys/fs/cgroup/outer/memory.stat",
                "anon 1\ninactive_file 200\n",
            ),
        ];
        assert_eq!(left_in_groups(&machine(&second)), Some(500));
        let first = [
            (
                "/proc/self/cgroup",
                "9:name=systemd:/\n4:cpu,memory:/a\n0::/\n",
            ),
            ("/sys/fs/cgroup/memory/a/memory.limit_in_bytes", "300\n"),
            ("/sys/fs/cgroup/memory/a/memory.usage_in_bytes", "100\n"),
            (
                "/sys/fs/cgroup/memory/memory.limit_in_bytes",
                "9223372036854771712\n",
            ),
            ("/sys/fs/cgroup/memory/memory.usage_in_bytes", "800\n"),
        ];
        assert_eq!(left_in_groups(&machine(&first)), Some(200));
        assert_eq!(left_in_groups(&machine(&first[..1])), None);
    }

    #[test]
    #[cfg(target_os = "linux")]
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
        assert!(reserve_pixels::<[u8; 1 << 40]>([16384, 16384]).is_err());
    }
}
