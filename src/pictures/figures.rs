//! The built-in scene in, the assignment's figures out: its pictures, the components of its light, and a sheet.
//!
//! Rule: every pixel is exact (tolerance 0), and the same bytes come out every time.

use std::path::Path;

use anyhow::{Context, Result};

use super::sheet::{Cell, Picture, half, sheet};
use crate::components::{Projection, ShadingMode, View};
use crate::drawing::all_cores;
use crate::frame::{Frame, Keep, Workers};
use crate::memory;
use crate::output::{Output, make_folder, say};
use crate::scene::{LightChoice, Scene};
use crate::systems;

/// Width and height of a figure, in pixels.
const SIZE: [usize; 2] = [960, 720];

/// Bytes that all pictures take that are held at once, the file that is written among them.
const MEMORY: usize = 28 << 20;

/// One picture of the built-in scene, and what its label says.
struct Figure {
    shading: ShadingMode,
    camera: &'static str,
    lights: &'static str,
    heading: &'static str,
    remark: &'static str,
}

/// The assignment's pictures by file name, in the order of the sheet: a row for each camera.
const FIGURES: [(&str, Figure); 6] = {
    use ShadingMode::{Gouraud, Phong};
    const fn all(
        shading: ShadingMode,
        camera: &'static str,
        heading: &'static str,
        remark: &'static str,
    ) -> Figure {
        Figure {
            shading,
            camera,
            lights: "all",
            heading,
            remark,
        }
    }
    const fn white(camera: &'static str, remark: &'static str) -> Figure {
        Figure {
            shading: Phong,
            camera,
            lights: "white,ambient",
            heading: "Phong",
            remark,
        }
    }
    [
        ("gouraud-camera-1", all(Gouraud, "1", "Gouraud", "camera 1")),
        ("phong-camera-1", all(Phong, "1", "Phong", "camera 1")),
        (
            "phong-white-camera-1",
            white("1", "white and ambient, camera 1"),
        ),
        ("gouraud-camera-2", all(Gouraud, "2", "Gouraud", "camera 2")),
        ("phong-camera-2", all(Phong, "2", "Phong", "camera 2")),
        (
            "phong-white-camera-2",
            white("2", "white and ambient, camera 2"),
        ),
    ]
};

/// The terms of the model one by one, and their sum; each with what stands between it and the next.
const COMPONENTS: [(Figure, &str); 4] = {
    const fn term(lights: &'static str, heading: &'static str, remark: &'static str) -> Figure {
        Figure {
            shading: ShadingMode::Phong,
            camera: "1",
            lights,
            heading,
            remark,
        }
    }
    [
        (term("ambient", "Ambient", ""), "+"),
        (term("white,red", "Diffuse", "white and red"), "+"),
        (term("specular", "Specular", ""), "="),
        (term("all", "Sum", ""), ""),
    ]
};

/// Draws the assignment's figures into `folder`, which is made if absent, and says on standard error what it wrote.
///
/// # Errors
/// When the folder cannot be made or a file cannot be written; the files before it are then there.
pub fn figures(folder: &Path) -> Result<()> {
    memory::check_for(|| "the sheet of figures".to_owned(), MEMORY)?;
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
    for (name, figure) in &FIGURES {
        let picture = draw(&mut scene, figure, &mut frame)?;
        write(name, &picture)?;
        cells.push(Cell {
            picture: half(&picture),
            heading: figure.heading,
            remark: figure.remark,
            joiner: "",
        });
    }
    let mut terms = Vec::new();
    for (figure, joiner) in &COMPONENTS {
        let picture = half(&draw(&mut scene, figure, &mut frame)?);
        terms.push(Cell {
            picture,
            heading: figure.heading,
            remark: figure.remark,
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

fn draw(scene: &mut Scene, figure: &Figure, frame: &mut Frame) -> Result<Picture> {
    let camera = scene
        .find_camera(figure.camera)
        .context("the built-in scene lacks a camera")?;
    scene.switch_lights(&figure.lights.parse::<LightChoice>()?)?;
    let view = View {
        size: SIZE,
        viewpoint: scene.viewpoint(camera),
        projection: Projection::Perspective,
        background: scene.background,
        shading: Some(figure.shading),
        tolerance: 0.0,
    };
    systems::draw(&mut scene.world, &view, frame)?;
    Ok(Picture {
        size: SIZE,
        pixels: frame.pixels().to_vec(),
    })
}
