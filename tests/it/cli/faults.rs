//! External faults: readers that close the output, full disks, signals. In every case a file under its final name is
//! complete.

use std::path::Path;
use std::process::Stdio;

use super::{assert_failed, decode, folder, get, in_shell, listing, put, said, shadetrade, stop};

/// Commands that write files, limited to a second; the folder is `out`.
const WRITERS: [&str; 2] = [
    "trade --size 160x120 --seconds 0.05 -o out",
    "figures -o out",
];

/// Asserts that every file of `folder` is complete or, if allowed, hidden.
#[track_caller]
fn assert_whole(folder: &Path, hidden_allowed: bool) {
    for name in listing(folder) {
        if name.starts_with(".shadetrade-") {
            assert!(hidden_allowed, "{name} is left");
            continue;
        }
        let bytes = get(folder, &name);
        match name.rsplit_once('.').map(|(_, extension)| extension) {
            Some("png") => drop(decode(&bytes)),
            Some("json") => drop(serde_json::from_slice::<serde_json::Value>(&bytes).expect(&name)),
            Some("md") => assert!(bytes.ends_with(b".\n"), "{name} must end with a sentence"),
            Some("svg") => assert!(bytes.trim_ascii_end().ends_with(b"</svg>"), "{name}"),
            _ => panic!("{name} is not a known file"),
        }
    }
}

#[test]
fn a_reader_that_closes_early_is_no_error_of_any_command() {
    for line in [
        "render --size 64x48 -o -",
        "probe --pixel 480,300 --json",
        "trade --size 64x48 --quick --methods phong-1 -o out",
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
fn a_closed_standard_output_or_error_breaks_no_file() {
    let folder = folder();
    for closed in [">&-", "2>&-", ">&- 2>&- <&-"] {
        let script = format!("exec {closed}; exec $0 render --size 64x48 -o a.png");
        let output = in_shell(folder.path(), &script);
        assert_eq!(output.status.code(), Some(0), "{closed}: {}", said(&output));
        assert_eq!(listing(folder.path()), ["a.png"]);
        assert_whole(folder.path(), false);
    }
}

#[test]
fn an_unusable_standard_output_is_an_error() {
    let folder = folder();
    for line in [
        "render --size 9x9 -o -",
        "probe --pixel 3,3",
        "completions bash",
        "--help",
    ] {
        let output = in_shell(folder.path(), &format!("exec $0 {line} > /dev/full"));
        assert_failed(&output, 1, "cannot write to standard output: No space left");
    }
}

#[test]
fn a_full_disk_is_an_error_and_every_file_is_complete() {
    // A limit on the file size stands for a full disk. Its signal is ignored.
    let folder = folder();
    put(folder.path(), "a.png", "old");
    let render = "render --size 960x720 -o a.png";
    for (limit, line, name) in [
        (8, WRITERS[0], "out/"),
        (64, WRITERS[1], "out/"),
        (8, render, "a.png: "),
    ] {
        let script = format!("trap '' XFSZ; ulimit -f {limit}; exec $0 {line} > /dev/null");
        let words = format!("error: cannot write {name}");
        assert_failed(&in_shell(folder.path(), &script), 1, &words);
    }
    assert_whole(&folder.path().join("out"), false);
    assert_eq!(get(folder.path(), "a.png"), b"old");
    assert_eq!(listing(folder.path()), ["a.png", "out"]);
}

#[test]
fn a_signal_at_any_time_leaves_complete_files() {
    for (line, signal, files) in [
        (WRITERS[0], "TERM", 2),
        (WRITERS[0], "INT", 6),
        (WRITERS[1], "KILL", 1),
    ] {
        let folder = folder();
        let out = folder.path().join("out");
        let mut program = shadetrade(folder.path());
        let program = program.args(line.split(' '));
        let program = program.stdout(Stdio::null()).stderr(Stdio::null());
        // A hidden file shows that one is being written.
        let has_files = || out.exists() && listing(&out).len() >= files;
        let ended = stop(program.spawn().expect("it starts"), signal, has_files);
        assert_whole(&out, !ended.success());
    }
}
