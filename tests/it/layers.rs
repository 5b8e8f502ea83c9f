//! Checks the imports of every module against the drawing of layers in the crate documentation.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The modules by layer from the top: the block of text under the heading in the crate documentation.
fn layers() -> Vec<Vec<&'static str>> {
    let (_, page) = include_str!("../../src/lib.rs")
        .split_once("# Who may import whom")
        .expect("the front page has it");
    let block = page.split("```").nth(1).expect("a block of text");
    let lines = block
        .lines()
        .skip(1)
        .map(|line| line.trim_start_matches("//!"));
    let layers = lines.map(|line| line.split_whitespace().collect::<Vec<_>>());
    layers.filter(|modules| !modules.is_empty()).collect()
}

/// Every source file below `folder`.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder of sources");
    let paths = entries.map(|entry| entry.expect("it can be read").path());
    paths
        .flat_map(|path| {
            if path.is_dir() {
                sources(&path)
            } else {
                vec![path]
            }
        })
        .filter(|path| path.extension().is_some_and(|extension| extension == "rs"))
        .collect()
}

/// The first names after `crate::` or, in the program, `shadetrade::`, including those in braces.
fn imported(code: &str) -> Vec<&str> {
    let words = |text| {
        str::split(text, |letter: char| {
            !letter.is_alphanumeric() && letter != '_'
        })
    };
    let paths = ["crate::", "shadetrade::"].map(|root| code.split(root).skip(1));
    paths
        .into_iter()
        .flatten()
        .flat_map(|path| match path.strip_prefix('{') {
            Some(braces) => words(braces.split(';').next().unwrap_or_default()).collect(),
            None => words(path).take(1).collect::<Vec<_>>(),
        })
        .collect()
}

#[test]
fn every_module_imports_from_lower_layers_only() {
    let layers = layers();
    let modules = (0..).zip(&layers);
    let layer_of: HashMap<&str, usize> = modules
        .flat_map(|(layer, modules)| modules.iter().map(move |module| (*module, layer)))
        .collect();
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut arrows = 0;
    for path in sources(&source) {
        let inside = path
            .strip_prefix(&source)
            .expect("below it")
            .with_extension("");
        let module = inside.iter().next().expect("a name").to_string_lossy();
        if module == "lib" {
            continue;
        }
        let layer = *layer_of
            .get(&*module)
            .unwrap_or_else(|| panic!("{module} is on no layer"));
        let text = fs::read_to_string(&path).expect("it can be read");
        let is_code = |line: &&str| !line.trim_start().starts_with("//");
        let code: Vec<&str> = text.lines().filter(is_code).collect();
        let root = "super::".repeat(inside.iter().count());
        let code = code.join("\n").replace(&root, "crate::");
        for other in imported(&code) {
            let Some(below) = layer_of.get(other).filter(|_| other != module) else {
                continue;
            };
            assert!(*below > layer, "{} imports {other}", path.display());
            arrows += 1;
        }
    }
    assert!(arrows > 100, "{arrows} imports were seen");
}
