//! Checks the imports of every module against the drawings of layers in the crate documentation: the rooms of the crate, and the
//! modules of `questions`.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The modules by layer from the top: the block of text under the heading of a page of the crate documentation.
fn layers(page: &'static str) -> Vec<Vec<&'static str>> {
    let (_, section) = page
        .split_once("# Who may import whom")
        .expect("it is there");
    let block = section.split("```").nth(1).expect("a block of text");
    let lines = block.lines().skip(1).map(|it| it.trim_start_matches("//!"));
    let layers = lines.map(|line| line.split_whitespace().collect::<Vec<_>>());
    layers.filter(|modules| !modules.is_empty()).collect()
}

/// Every source file below `folder`.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder of sources");
    let paths = entries.map(|entry| entry.expect("it can be read").path());
    let below = |path: PathBuf| {
        if path.is_dir() {
            sources(&path)
        } else {
            vec![path]
        }
    };
    let mut all: Vec<PathBuf> = paths.flat_map(below).collect();
    all.retain(|path| path.extension().is_some_and(|it| it == "rs"));
    all
}

/// The first names after one of the `roots`, such as `crate::`, including those in braces.
fn imported<'a>(code: &'a str, roots: &[&str]) -> Vec<&'a str> {
    let is_other = |letter: char| !letter.is_alphanumeric() && letter != '_';
    let words = |text: &'a str| text.split(is_other);
    let paths = roots.iter().flat_map(|root| code.split(root).skip(1));
    paths
        .flat_map(|path| match path.strip_prefix('{') {
            Some(braces) => words(braces.split(';').next().unwrap_or_default()).collect(),
            None => words(path).take(1).collect::<Vec<_>>(),
        })
        .collect()
}

/// Checks all imports below `folder` against the drawing of `page`, and returns how many were seen.
fn check_imports(folder: &Path, page: &'static str, roots: &[&str]) -> usize {
    let mut layer_of = HashMap::new();
    for (layer, modules) in layers(page).into_iter().enumerate() {
        layer_of.extend(modules.into_iter().map(|module| (module, layer)));
    }
    let mut arrows = 0;
    for path in sources(folder) {
        let inside = path.strip_prefix(folder).expect("below it");
        let inside = inside.with_extension("");
        let module = inside.iter().next().expect("a name").to_string_lossy();
        if module == "lib" {
            continue;
        }
        let layer = layer_of.get(&*module);
        let layer = *layer.unwrap_or_else(|| panic!("{module} is on no layer"));
        let text = fs::read_to_string(&path).expect("it can be read");
        let is_code = |line: &&str| !line.trim_start().starts_with("//");
        let code: Vec<&str> = text.lines().filter(is_code).collect();
        let parents = "super::".repeat(inside.iter().count());
        let code = code.join("\n").replace(&parents, roots[0]);
        for other in imported(&code, roots) {
            let Some(below) = layer_of.get(other).filter(|_| other != module) else {
                continue;
            };
            assert!(*below > layer, "{} imports {other}", path.display());
            arrows += 1;
        }
    }
    arrows
}

#[test]
fn every_room_imports_from_lower_lines_only() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let page = include_str!("../../src/lib.rs");
    let arrows = check_imports(&source, page, &["crate::", "shadetrade::"]);
    assert!(arrows > 100, "{arrows} imports were seen");
}

#[test]
fn a_question_imports_from_questions_of_lower_lines_only() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/questions");
    let page = include_str!("../../src/questions.rs");
    let arrows = check_imports(&source, page, &["crate::questions::"]);
    assert!(arrows > 20, "{arrows} imports were seen");
}
