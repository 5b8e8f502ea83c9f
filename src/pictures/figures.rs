//! The assignment's figures of the built-in scene: six pictures, the components of the light, and a sheet.
//!
//! They are drawn at tolerance 0, and their bytes are the same every time.

use std::path::Path;

use anyhow::{Context, Result};

use super::sheet::{Cell, Picture, half, sheet};
use crate::components::{ShadingMode, View};
use crate::drawing::all_cores;
use crate::frame::{Frame, Keep, Workers};
use crate::memory;
use crate::output::{Output, make_folder, say};
use crate::scene::Scene;
use crate::systems;

/// Width and height of a figure, in pixels.
const SIZE: [usize; 2] = [960, 720];

/// Bytes of all pictures and of the encoded file that are held at the same time.
const MEMORY: usize = 30 << 20;

/// The assignment's pictures in the order of the sheet, a row for each camera: file name, mode, camera and lights.
const FIGURES: [(&str, ShadingMode, &str, &str); 6] = [
    ("gouraud-camera-1", ShadingMode::Gouraud, "1", "all"),
    ("phong-camera-1", ShadingMode::Phong, "1", "all"),
    ("phong-white-camera-1", ShadingMode::Phong, "1", WHITE),
    ("gouraud-camera-2", ShadingMode::Gouraud, "2", "all"),
    ("phong-camera-2", ShadingMode::Phong, "2", "all"),
    ("phong-white-camera-2", ShadingMode::Phong, "2", WHITE),
];

const WHITE: &str = "white,ambient";

/// The terms of the model and their sum, under Phong from camera 1: lights, heading, remark, and the sign before the next
/// picture.
const COMPONENTS: [(&str, &str, &str, &str); 4] = [
    ("ambient", "Ambient", "", "+"),
    ("white,red", "Diffuse", "white and red", "+"),
    ("specular", "Specular", "", "="),
    ("all", "Sum", "", ""),
];

/// Draws the assignment's figures into `folder`, which is created if absent, and reports each file on standard error.
///
/// # Errors
/// If the folder cannot be created or a file cannot be written. Files written before stay.
pub fn figures(folder: &Path) -> Result<()> {
    memory::check_for("the sheet of figures", MEMORY)?;
    make_folder(folder)?;
    let mut scene = Scene::load(None)?;
    let workers = Workers::new(all_cores(), fearless_simd::Level::new())
        .context("cannot start the threads that draw")?;
    let mut frame = Frame::new(Keep::Display, workers);
    let write = |name: &str, picture: &Picture| {
        let path = folder.join(name).with_extension("png");
        Output::File(path.clone()).write_png(&picture.pixels, picture.size)?;
        say(&format!(
            "wrote {}: {}x{}",
            path.display(),
            picture.size[0],
            picture.size[1]
        ));
        anyhow::Ok(())
    };

    let mut cells = Vec::new();
    for (name, mode, camera, lights) in FIGURES {
        let picture = draw(&mut scene, mode, camera, lights, &mut frame)?;
        write(name, &picture)?;
        let heading = match mode {
            ShadingMode::Gouraud => "Gouraud",
            _ => "Phong",
        };
        let remark = match lights {
            WHITE => format!("white and ambient, camera {camera}"),
            _ => format!("camera {camera}"),
        };
        cells.push(Cell {
            picture: half(&picture),
            heading,
            remark,
            joiner: "",
        });
    }
    let mut terms = Vec::new();
    for (lights, heading, remark, joiner) in COMPONENTS {
        let picture = draw(&mut scene, ShadingMode::Phong, "1", lights, &mut frame)?;
        terms.push(Cell {
            picture: half(&picture),
            heading,
            remark: remark.to_owned(),
            joiner,
        });
    }
    write(
        "components",
        &sheet("The components of the light (Phong, camera 1)", 4, &terms),
    )?;
    write(
        "sheet",
        &sheet("The lit cuboid, shaded two ways", 3, &cells),
    )
}

fn draw(
    scene: &mut Scene,
    mode: ShadingMode,
    camera: &str,
    lights: &str,
    frame: &mut Frame,
) -> Result<Picture> {
    scene.look_from(camera)?;
    scene.switch_lights(lights)?;
    let view = View::of(&scene.world, SIZE)
        .shaded(mode)
        .with_tolerance(0.0);
    systems::draw(&mut scene.world, &view, frame)?;
    Ok(Picture {
        size: SIZE,
        pixels: frame.pixels().to_vec(),
    })
}
