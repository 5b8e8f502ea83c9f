//! The assignment's figures of the built-in scene: six pictures, the components of the light, and a sheet.
//!
//! They are drawn at tolerance 0, and their bytes are the same every time.

use std::path::Path;

use anyhow::{Context, Result};

use super::sheet::{half, sheet};
use crate::components::ShadingMode::{self, Gouraud, Phong};
use crate::components::View;
use crate::output::files::make_folder;
use crate::output::{encode_png, one_line, say, write_into};
use crate::questions::job::all_cores;
use crate::scene::Scene;
use crate::systems;
use crate::systems::frame::{Frame, Keep, Workers};

/// Width and height of a figure, in pixels.
const SIZE: [usize; 2] = [960, 720];

/// A file name, empty if there is no file; mode, camera and lights; heading and remark of the cell, and the sign between it
/// and the next one.
type Figure = (
    &'static str,
    ShadingMode,
    [&'static str; 2],
    [&'static str; 3],
);

/// The assignment's pictures in the order of the sheet, a row for each camera.
#[rustfmt::skip]
const FIGURES: [Figure; 6] = [
    ("gouraud-camera-1", Gouraud, ["1", "all"], ["Gouraud", "camera 1", ""]),
    ("phong-camera-1", Phong, ["1", "all"], ["Phong", "camera 1", ""]),
    ("phong-white-camera-1", Phong, ["1", "white,ambient"], ["Phong", "white and ambient, camera 1", ""]),
    ("gouraud-camera-2", Gouraud, ["2", "all"], ["Gouraud", "camera 2", ""]),
    ("phong-camera-2", Phong, ["2", "all"], ["Phong", "camera 2", ""]),
    ("phong-white-camera-2", Phong, ["2", "white,ambient"], ["Phong", "white and ambient, camera 2", ""]),
];

/// The terms of the model, and their sum.
#[rustfmt::skip]
const COMPONENTS: [Figure; 4] = [
    ("", Phong, ["1", "ambient"], ["Ambient", "", "+"]),
    ("", Phong, ["1", "white,red"], ["Diffuse", "white and red", "+"]),
    ("", Phong, ["1", "specular"], ["Specular", "", "="]),
    ("", Phong, ["1", "all"], ["Sum", "", ""]),
];

/// File name, title, number of columns and cells of each sheet.
#[rustfmt::skip]
const SHEETS: [(&str, &str, usize, &[Figure]); 2] = [
    ("sheet", "The lit cuboid, shaded two ways", 3, &FIGURES),
    ("components", "The components of the light (Phong, camera 1)", 4, &COMPONENTS),
];

/// Draws the assignment's figures into `folder`, which is created if absent, and reports each file on standard error.
///
/// # Errors
/// If the folder cannot be created or a file cannot be written; then none is.
pub fn figures(folder: &Path) -> Result<()> {
    make_folder(folder)?;
    let mut scene = Scene::load(None)?;
    let workers = Workers::new(all_cores(), fearless_simd::Level::new())
        .context("cannot start the threads that draw")?;
    let mut frame = Frame::new(Keep::Display, workers);
    let mut files = Vec::new();
    for (file, title, columns, figures) in SHEETS {
        let mut cells = Vec::new();
        for &(file, mode, [camera, lights], label) in figures {
            scene.look_from(camera)?;
            scene.switch_lights(lights)?;
            let view = View::of(&scene.world, SIZE).shaded(mode);
            systems::draw(&mut scene.world, &view.with_tolerance(0.0), &mut frame)?;
            if !file.is_empty() {
                files.push((format!("{file}.png"), encode_png(frame.pixels(), SIZE)?));
            }
            cells.push((half(frame.pixels(), SIZE), label));
        }
        let (pixels, size) = sheet(title, columns, &cells, SIZE.map(|side| side / 2));
        files.push((format!("{file}.png"), encode_png(&pixels, size)?));
    }
    write_into(folder, files.iter().map(|(name, content)| (name, content)))?;
    for (name, _) in &files {
        say(&format!("wrote {}", one_line(folder.join(name))));
    }
    Ok(())
}
