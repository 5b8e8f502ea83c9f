//! What goes wrong around the program: readers that leave, disks that fill up, signals, memory that does not suffice.
//! In every case a file under its own name is whole.

use std::fs;
use std::path::Path;
use std::process::{Output, Stdio};

use shadetrade::scene::BUILT_IN;

use super::{decode, folder, in_shell, listing, said, shadetrade, stop};

/// Commands that write files, shortened to a second; the folder is `out`.
const WRITERS: [&str; 2] = [
    "trade --size 160x120 --seconds 0.05 -o out",
    "figures -o out",
];

/// Runs the program with the words of `line` in a shell that has done `first`.
fn run_after(first: &str, folder: &Path, line: &str) -> Output {
    in_shell(folder, &format!("{first}; exec $0 {line}"))
}

/// Asserts that every file of `folder` is whole or, where that is allowed, hidden; gives the names of the whole ones.
#[track_caller]
fn whole_files(folder: &Path, hidden_allowed: bool) -> Vec<String> {
    let mut names = listing(folder);
    names.retain(|name| {
        let hidden = name.starts_with(".shadetrade-");
        assert!(!hidden || hidden_allowed, "{name} is left");
        !hidden
    });
    for name in &names {
        let bytes = fs::read(folder.join(name)).expect("a file");
        let text = || str::from_utf8(&bytes).expect("text");
        match name.rsplit_once('.').map(|(_, extension)| extension) {
            Some("png") => drop(decode(&bytes)),
            Some("json") => drop(serde_json::from_str::<serde_json::Value>(text()).expect(name)),
            Some("md") => assert!(text().ends_with(".\n"), "{name} ends with a sentence"),
            Some("svg") => assert!(text().trim_end().ends_with("</svg>"), "{name}"),
            _ => panic!("{name} is none of ours"),
        }
    }
    names
}

#[test]
fn a_reader_that_leaves_early_is_no_error_of_any_command() {
    for line in [
        "render --size 64x48 -o -",
        "render --size 64x48 --reference -o -",
        "figures",
        "probe --pixel 5,5",
        "probe --pixel 480,300 --json",
        "trade --size 64x48 --seconds 0.05",
        "trade --size 64x48 --seconds 0.05 -o out",
        "completions zsh",
        "--version",
        "--help",
        "help trade",
    ] {
        let folder = folder();
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let output = shadetrade(folder.path())
            .args(line.split(' '))
            .stdout(writer)
            .output()
            .expect("the program starts");
        assert_eq!(output.status.code(), Some(0), "{line}: {}", said(&output));
        assert!(
            !said(&output).contains("error: "),
            "{line}: {}",
            said(&output)
        );
    }
}

#[test]
fn a_closed_standard_output_or_error_breaks_nothing() {
    for (closed, line) in [
        (">&-", "render --size 64x48 -o a.png"),
        ("2>&-", "render --size 64x48 -o a.png"),
        (">&- 2>&- <&-", "render --size 64x48 -o a.png"),
    ] {
        let folder = folder();
        let output = run_after(&format!("exec {closed}"), folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{closed}: {}", said(&output));
        assert_eq!(whole_files(folder.path(), false), ["a.png"]);
    }
}

#[test]
fn a_disk_that_fills_up_is_an_error_and_every_file_is_whole() {
    // A limit on the size of a file stands in for a full disk.
    for (limit, line) in [
        (1, WRITERS[0]),
        (8, WRITERS[0]),
        (8, WRITERS[1]),
        (64, WRITERS[1]),
    ] {
        let folder = folder();
        let full = format!("ulimit -f {limit}");
        let output = run_after(&full, folder.path(), line);
        assert_eq!(output.status.code(), Some(1), "{line}: {}", said(&output));
        assert!(
            said(&output).contains("error: cannot write out/"),
            "{line}: {}",
            said(&output)
        );
        whole_files(&folder.path().join("out"), false);
    }
}

#[test]
fn a_signal_at_any_time_leaves_whole_files() {
    for line in WRITERS {
        for (signal, files) in [
            ("KILL", 1),
            ("INT", 1),
            ("TERM", 2),
            ("KILL", 4),
            ("INT", 6),
        ] {
            let folder = folder();
            let out = folder.path().join("out");
            let child = shadetrade(folder.path())
                .args(line.split(' '))
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .spawn()
                .expect("the program starts");
            // Hidden ones count: then one is being written.
            let has_files = || out.exists() && listing(&out).len() >= files;
            let ended = stop(child, signal, has_files);
            whole_files(&out, !ended.success());
        }
    }
}

#[test]
#[cfg(target_os = "linux")]
fn threads_that_the_system_refuses_are_an_error_and_no_variable_asks_for_them() {
    // Stacks of a gigabyte in 16 GB of addresses: the last one that is refused leaves room for what the others still need.
    let limit = "export RAYON_NUM_THREADS=1000 RUST_MIN_STACK=1000000000; ulimit -v 16000000";
    let folder = folder();
    for line in [
        "render --size 64x48 --reference -o a.png",
        "probe --size 64x48 --pixel 30,20",
        "prove --size 16x12",
        "trade --size 16x12 --quick",
    ] {
        let output = run_after(limit, folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{line}: {}", said(&output));
    }
    for line in [
        "render --size 64x48 -o a.png",
        "render --size 64x48 --reference -o a.png",
        "probe --size 64x48 --pixel 30,20",
        "prove --size 16x12",
        "extremes",
        "extremes --chart",
    ] {
        let output = run_after(limit, folder.path(), &format!("{line} --threads 1000"));
        assert_eq!(output.status.code(), Some(1), "{line}: {}", said(&output));
        let cause = "Resource temporarily unavailable";
        assert_eq!(said(&output).matches(cause).count(), 1, "{}", said(&output));
        let words = "error: cannot start the threads that draw";
        assert!(
            said(&output).starts_with(words),
            "{line}: {}",
            said(&output)
        );
    }
}

#[test]
#[cfg(target_os = "linux")]
fn little_memory_is_an_error_and_never_an_abort() {
    // A picture of 16 million pixels takes 64 MB, besides the program itself; the limits are in kibibytes.
    for (limit, line) in [
        (80_000, "render --size 4000x4000 --threads 2 -o a.png"),
        (80_000, "render --size 4000x4000 --reference -o a.png"),
        (160_000, "trade --quick --size 4000x4000"),
        (60_000, "figures"),
        (60_000, "extremes"),
        (400_000, "extremes"),
    ] {
        let folder = folder();
        let output = run_after(&format!("ulimit -v {limit}"), folder.path(), line);
        assert_eq!(output.status.code(), Some(1), "{line}: {}", said(&output));
        if line.contains("4000x4000") {
            let size = said(&output).contains("4000x4000");
            assert!(size, "{line}: {}", said(&output));
        }
        assert!(said(&output).contains(" MB"), "{line}: {}", said(&output));
        assert_eq!(listing(folder.path()), [""; 0]);
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_scene_that_memory_cannot_hold_is_an_error_and_never_an_abort() {
    let folder = folder();
    let (_, built_in) = BUILT_IN[0];
    let lights = |count| {
        (0..count).map(|index| {
            format!("[[light]]\nname='{index}'\nkind='ambient'\ncolor=[1,1,1]\nintensity=1\n")
        })
    };
    let many: String = lights(100_000).collect();
    let numbers = format!("background = [{}]", "1,".repeat(2_000_000));
    for (name, text) in [
        (
            "many",
            built_in.replacen("[[light]]", &(many + "[[light]]"), 1),
        ),
        ("dense", numbers),
    ] {
        fs::write(folder.path().join(name), text).expect("it is written");
        // In kibibytes: less than is read, than is parsed, and than anything takes.
        for limit in [50_000, 60_000, 100_000, 200_000] {
            let line = format!("render ./{name} --size 64x48 -o a.png");
            let output = run_after(&format!("ulimit -v {limit}"), folder.path(), &line);
            assert_eq!(output.status.code(), Some(1), "{line}: {}", said(&output));
            let words = format!("error: cannot read the scene \"./{name}\": ");
            assert!(said(&output).starts_with(&words), "{}", said(&output));
        }
    }
}

#[test]
#[cfg(target_os = "linux")]
fn memory_that_does_not_suffice_is_an_error_of_every_command_that_draws() {
    // 16384 x 16384 pixels of four bytes are 1074 MB; the limit is in kibibytes.
    for line in [
        "render --size 16384x16384 -o a.png",
        "render --size 16384x16384 --threads 8 -o a.png",
        "render --size 16384x16384 --reference -o a.png",
        "trade --size 16384x16384 --threads 3",
    ] {
        let folder = folder();
        let output = run_after("ulimit -v 600000", folder.path(), line);
        assert_eq!(output.status.code(), Some(1), "{line}: {}", said(&output));
        for words in ["error: ", "16384x16384", "does not fit in memory", " MB"] {
            assert!(said(&output).contains(words), "{line}: {}", said(&output));
        }
        assert_eq!(listing(folder.path()), [""; 0]);
    }
}
