//! The commands `render` and `figures`: PNG files of a [`Drawing`], and the assignment's figures of the built-in scene.
//!
//! A rendered picture has the bytes of the window's frame. Figures are drawn at tolerance 0, and their bytes are the same every
//! time.

pub mod sheet;

use std::path::Path;
use std::time::{Duration, Instant};

use anyhow::Context;

use self::sheet::sheet;
use crate::components::ShadingMode::{self, Gouraud, Phong};
use crate::components::{TriangleId, View, viewer};
use crate::output::files::make_folder;
use crate::output::progress::{bands, with_bar};
use crate::output::words::counted;
use crate::output::{Monitor, Output, encode_png, finished, memory, one_line, say, write_into};
use crate::questions::job::{Drawing, all_cores};
use crate::questions::trade::batch::time_here;
use crate::questions::trade::budget;
use crate::questions::trade::timing::{self, Timing};
use crate::scene::Scene;
use crate::shading::simd;
use crate::systems::frame::{Frame, Keep, Workers, display_pixel};
use crate::{reference, systems};

/// Width and height of a figure, and of a picture on a sheet, in pixels.
const SIZE: [usize; 2] = [960, 720];
const CELL: [usize; 2] = [480, 360];

/// A file name, empty if there is no file; mode, camera and lights; label.
type Figure = (&'static str, ShadingMode, [&'static str; 2], &'static str);

/// The assignment's pictures in the order of the sheet, a row for each camera.
#[rustfmt::skip]
const FIGURES: [Figure; 6] = [
    ("gouraud-camera-1", Gouraud, ["1", "all"], "Gouraud, camera 1"),
    ("phong-camera-1", Phong, ["1", "all"], "Phong, camera 1"),
    ("phong-white-camera-1", Phong, ["1", "white,ambient"], "Phong, white and ambient, camera 1"),
    ("gouraud-camera-2", Gouraud, ["2", "all"], "Gouraud, camera 2"),
    ("phong-camera-2", Phong, ["2", "all"], "Phong, camera 2"),
    ("phong-white-camera-2", Phong, ["2", "white,ambient"], "Phong, white and ambient, camera 2"),
];

/// The terms of the model, and their sum.
#[rustfmt::skip]
const COMPONENTS: [Figure; 4] = [
    ("", Phong, ["1", "ambient"], "Ambient"),
    ("", Phong, ["1", "white,red"], "Diffuse: white and red"),
    ("", Phong, ["1", "specular"], "Specular"),
    ("", Phong, ["1", "all"], "Sum"),
];

/// File name, title, number of columns and cells of each sheet.
#[rustfmt::skip]
const SHEETS: [(&str, &str, usize, &[Figure]); 2] = [
    ("sheet", "The lit cuboid, shaded two ways", 3, &FIGURES),
    ("components", "The components of the light (Phong, camera 1)", 4, &COMPONENTS),
];

/// Draws one picture into `output` and reports it, with the time of a frame, on standard error.
///
/// The time of a method that a budget has chosen is the one by which it was chosen.
///
/// # Errors
/// If the picture does not fit in memory or cannot be written.
pub fn render(drawing: &mut Drawing, output: &Output) -> anyhow::Result<()> {
    let mut view = drawing.view();
    let budget = viewer(&drawing.scene.world).budget;
    let chosen = match budget {
        Some(budget) => budget::choose(drawing, budget, &time_here)?,
        None => None,
    };
    if let (Some(budget), Some((one, text))) = (budget, &chosen) {
        view = one.method.view(&view);
        say(&format!("a budget of {budget} ms chooses {text}"));
    }
    let mut frame = Frame::new(Keep::Display, drawing.workers()?);
    let world = &mut drawing.scene.world;
    let mut draw = |_| systems::draw(world, &view, &mut frame).map_err(anyhow::Error::from);
    let timing = if let Some((one, _)) = chosen {
        draw(0)?;
        one.timing
    } else {
        let times = timing::batch(0, 1, Duration::ZERO, Monitor::NONE, draw);
        Timing::of(&finished(times)?)
    };
    output.write_png(frame.pixels(), frame.size())?;
    let [width, height] = frame.size();
    say(&format!(
        "wrote {}: PNG, {width}x{height}, {} shaded; a frame takes {:.3} ms \
         (median of {}, PNG apart; {}, {})",
        output.name(),
        counted(frame.counts().covered_pixels as usize, "pixel"),
        timing.median,
        counted(timing.samples, "warm frame"),
        counted(frame.workers().threads(), "thread"),
        simd::name(frame.workers().level()),
    ));
    drawing.say_if_unseen(frame.counts().covered_pixels);
    Ok(())
}

/// Draws one picture with the f64 reference into `output` and reports it on standard error.
///
/// # Errors
/// As [`render`].
pub fn render_reference(drawing: &mut Drawing, output: &Output) -> anyhow::Result<()> {
    let view = drawing.view();
    let [width, height] = view.size;
    let (mut pixels, mut covered) = (memory::reserve_pixels(view.size)?, 0);
    let begin = Instant::now();
    let world = &drawing.scene.world;
    with_bar(async |monitor| {
        for rows in bands(height) {
            let truth = reference::picture(world, &view, rows, monitor).await?;
            let covered_here = truth.triangles.iter().filter(|it| **it != TriangleId::NONE);
            covered += covered_here.count();
            pixels.extend(truth.levels.into_iter().map(display_pixel));
        }
        Ok(())
    })?;
    let time = begin.elapsed();
    output.write_png(&pixels, view.size)?;
    say(&format!(
        "wrote {}: PNG, {width}x{height}, {} shaded by the reference in f64, in {:.3} s",
        output.name(),
        counted(covered, "pixel"),
        time.as_secs_f64()
    ));
    drawing.say_if_unseen(covered as u64);
    Ok(())
}

/// Draws the assignment's figures into `folder`, which is created if absent, and reports each file on standard error.
///
/// # Errors
/// If the folder cannot be created or a file cannot be written; then none is.
pub fn figures(folder: &Path) -> anyhow::Result<()> {
    make_folder(folder)?;
    let mut scene = Scene::load(None)?;
    let workers = Workers::new(all_cores(), fearless_simd::Level::new())
        .context("cannot start the threads that draw")?;
    let mut frame = Frame::new(Keep::Display, workers);
    let mut files = Vec::new();
    for (file, title, columns, figures) in SHEETS {
        let mut cells = Vec::new();
        for &(name, mode, [camera, lights], label) in figures {
            scene.look_from(camera)?;
            scene.switch_lights(lights)?;
            let mut draw = |size| {
                let view = View::of(&scene.world, size).shaded(mode);
                systems::draw(&mut scene.world, &view.with_tolerance(0.0), &mut frame)?;
                anyhow::Ok(frame.pixels().to_vec())
            };
            if !name.is_empty() {
                files.push((format!("{name}.png"), encode_png(&draw(SIZE)?, SIZE)?));
            }
            cells.push((draw(CELL)?, label.to_owned()));
        }
        let (pixels, size) = sheet(title, columns, &cells, CELL);
        files.push((format!("{file}.png"), encode_png(&pixels, size)?));
    }
    write_into(folder, files.iter().map(|(name, content)| (name, content)))?;
    for (name, _) in &files {
        say(&format!("wrote {}", one_line(folder.join(name))));
    }
    Ok(())
}
