//! External faults: readers that close the output, full disks, signals. In every case a file under its final name is
//! complete.

use std::fs;
use std::path::Path;
use std::process::{Output, Stdio};

use super::{decode, folder, in_shell, listing, said, shadetrade, stop};

/// Commands that write files, limited to a second; the folder is `out`.
const WRITERS: [&str; 2] = [
    "trade --size 160x120 --seconds 0.05 -o out",
    "figures -o out",
];

/// Runs the program with the arguments in `line` in a shell after the commands `first`.
fn run_after(first: &str, folder: &Path, line: &str) -> Output {
    in_shell(folder, &format!("{first}; exec $0 {line}"))
}

/// Asserts that every file of `folder` is complete or, if allowed, hidden. Returns the names of the complete ones.
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
            Some("md") => assert!(text().ends_with(".\n"), "{name} must end with a sentence"),
            Some("svg") => assert!(text().trim_end().ends_with("</svg>"), "{name}"),
            _ => panic!("{name} is not a known file"),
        }
    }
    names
}

#[test]
fn a_reader_that_closes_early_is_no_error_of_any_command() {
    for line in [
        "render -o -",
        "render --size 64x48 --reference -o -",
        "figures",
        "probe --pixel 5,5",
        "probe --pixel 480,300 --json",
        "trade --size 64x48 --seconds 0.05",
        "trade --size 64x48 --seconds 0.05 -o out",
        "completions zsh",
        "--help",
    ] {
        let folder = folder();
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let mut program = shadetrade(folder.path());
        let output = program.args(line.split(' ')).stdout(writer).output();
        let output = output.expect("the program starts");
        let said = said(&output);
        assert_eq!(output.status.code(), Some(0), "{line}: {said}");
        assert!(!said.contains("error: "), "{line}: {said}");
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
fn a_full_disk_is_an_error_and_every_file_is_complete() {
    // A limit on the file size stands for a full disk. Its signal is ignored.
    for (limit, line) in [(8, WRITERS[0]), (64, WRITERS[1])] {
        let folder = folder();
        let full = format!("trap '' XFSZ; ulimit -f {limit}");
        let output = run_after(&full, folder.path(), line);
        let said = said(&output);
        assert_eq!(output.status.code(), Some(1), "{line}: {said}");
        assert!(said.contains("error: cannot write out/"), "{line}: {said}");
        whole_files(&folder.path().join("out"), false);
    }
}

#[test]
fn a_signal_at_any_time_leaves_complete_files() {
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
            // A hidden file shows that one is being written.
            let has_files = || out.exists() && listing(&out).len() >= files;
            let ended = stop(child, signal, has_files);
            whole_files(&out, !ended.success());
        }
    }
}
