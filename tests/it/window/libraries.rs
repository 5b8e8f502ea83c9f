//! A library that the window loads, and that the machine lacks.

use std::fs;
use std::process::Command;

#[test]
fn a_library_that_is_missing_is_told_and_is_no_missing_display() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    // Which of them is searched for by name, and not at the place where the build found it, depends on the machine.
    let libraries = [
        "libX11.so",
        "libX11.so.6",
        "libXcursor.so",
        "libXcursor.so.1",
    ];
    for name in libraries {
        fs::write(folder.path().join(name), "no library").expect("written");
    }
    let output = Command::new(env!("CARGO_BIN_EXE_shadetrade"))
        .current_dir(folder.path())
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("XMODIFIERS")
        .env("DISPLAY", ":12345")
        .env("LD_LIBRARY_PATH", folder.path())
        .output()
        .expect("the program starts");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("failed to load"), "{said}");
    let entries = fs::read_dir(folder.path()).expect("listed").count();
    assert_eq!(entries, libraries.len(), "no figures are drawn instead");
}
