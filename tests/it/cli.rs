//! The program on the command line: it is run as a process and judged by exit status, standard output, standard error
//! and files.

mod errors;
mod export;
#[cfg(unix)]
mod faults;
mod files;
mod help;
mod lessons;
#[cfg(unix)]
mod names;
mod pictures;
mod proofs;
mod requires;
mod trade;

use std::fs;
use std::path::Path;
#[cfg(unix)]
use std::process::{Child, ExitStatus};
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::TempDir;

/// The text of the default scene.
const SCENE: &str = include_str!("../../assets/scenes/cuboid.toml");

/// A black cube of one unit, for a scene file.
fn cube(name: &str, place: [f64; 3]) -> String {
    format!(
        "[[cuboid]]\nname = \"{name}\"\nsize = [1.0, 1.0, 1.0]\nposition = {place:?}\nshading = \"phong\"\n\
         [cuboid.material]\nambient = [0.0, 0.0, 0.0]\ndiffuse = [0.0, 0.0, 0.0]\nspecular = [0.0, 0.0, 0.0]\nshininess = 1.0\n"
    )
}

/// A temporary folder for one test.
fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder can be made")
}

/// Writes a file.
fn put(folder: &Path, name: &str, content: impl AsRef<[u8]>) {
    fs::write(folder.join(name), content).expect("it is written");
}

/// The content of a file.
fn get(folder: &Path, name: &str) -> Vec<u8> {
    fs::read(folder.join(name)).expect("it can be read")
}

/// The program in `folder`, without a display.
fn shadetrade(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_shadetrade"));
    command
        .current_dir(folder)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET");
    command
}

/// Runs the program in `folder` with the arguments in `line`.
fn run(folder: &Path, line: &str) -> Output {
    let mut program = shadetrade(folder);
    program.args(line.split_whitespace());
    program.output().expect("the program starts")
}

/// Runs a shell script in `folder`, with the program as `$0`.
#[cfg(unix)]
fn in_shell(folder: &Path, script: &str) -> Output {
    Command::new("sh")
        .args(["-c", script, env!("CARGO_BIN_EXE_shadetrade")])
        .current_dir(folder)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .expect("there is a shell")
}

/// Sends a signal once `is_time` returns true, unless the program ends before. Returns its exit status.
#[cfg(unix)]
fn stop(mut program: Child, signal: &str, is_time: impl Fn() -> bool) -> ExitStatus {
    while !is_time() && program.try_wait().expect("its state is known").is_none() {
        std::thread::yield_now();
    }
    crate::support::signal::send(signal, &program);
    program.wait().expect("it ends")
}

/// Standard error as text.
fn said(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("messages are UTF-8")
}

/// Asserts an exit status, one paragraph with each of `words` on standard error, and no standard output. Bars separate
/// words.
#[track_caller]
fn assert_failed(output: &Output, status: i32, words: &str) {
    let said = said(output);
    assert_eq!(output.status.code(), Some(status), "{said}");
    let is_paragraph = said.starts_with("error: ") && said.ends_with('\n');
    assert!(is_paragraph && output.stdout.is_empty(), "{said}");
    for internal in ["\n\n", "panicked", "backtrace", "src/"] {
        assert!(!said.contains(internal), "{internal:?}: {said}");
    }
    for word in words.split('|') {
        assert!(said.contains(word), "no {word:?}: {said}");
    }
}

/// Runs `line`, asserts success, and returns its standard error.
#[track_caller]
fn assert_works(folder: &Path, line: &str) -> String {
    let output = run(folder, line);
    let said = said(&output);
    assert_eq!(output.status.code(), Some(0), "`{line}` said: {said}");
    said
}

/// Runs `line` and returns its exit status and the JSON on standard output.
#[track_caller]
pub fn json(folder: &Path, line: &str) -> (Option<i32>, Value) {
    let output = run(folder, line);
    let json = serde_json::from_slice(&output.stdout);
    (
        output.status.code(),
        json.unwrap_or_else(|_| panic!("{}", said(&output))),
    )
}

/// The keys of an object, in order.
pub fn keys(object: &Value) -> String {
    let object = object.as_object().expect("an object");
    object.keys().cloned().collect::<Vec<_>>().join(" ")
}

/// Width, height and RGB bytes of a PNG; panics unless it is an 8-bit RGB PNG.
#[track_caller]
fn decode(png: &[u8]) -> (u32, u32, Vec<u8>) {
    let picture =
        image::load_from_memory_with_format(png, image::ImageFormat::Png).expect("whole PNG data");
    assert_eq!(picture.color(), image::ColorType::Rgb8);
    (picture.width(), picture.height(), picture.into_bytes())
}

/// The names in `folder` in order, with hidden files.
pub fn listing(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let names = entries.map(|entry| entry.expect("an entry").file_name());
    let mut names: Vec<String> = names.filter_map(|name| name.into_string().ok()).collect();
    names.sort();
    names
}
