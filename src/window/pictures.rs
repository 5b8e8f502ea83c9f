//! The pictures of the view: the frame, the two sides of a wipe, tinted squares; and the time of the last one.
//!
//! A frame is timed from its first stage to the display step, and nothing else is. A picture that is not computed yet is
//! shown as the frame dimmed, never as something else.

use std::borrow::Cow;

use fearless_simd::Level;
use hecs::World;
use rayon::prelude::*;
use web_time::Instant;

use crate::components::{Light, LightKind, ShadingMode, Side, TriangleId, View, ViewMode, Viewer};
use crate::output::memory::{self, OutOfMemory};
use crate::reference::Reference;
use crate::shading::{Method, SquareKind};
use crate::systems;
use crate::systems::frame::{Frame, Keep, SQUARE_EDGE, Workers, display_pixel};

/// The weight of a square's tint, of 256, and that on its outline.
const TINT_WEIGHT: u32 = 168;
const OUTLINE_WEIGHT: u32 = 232;

/// The tint of each of [`SquareKind::ALL`], 0x00RRGGBB: Okabe and Ito's colours (2008), which people who are colour-blind can
/// tell apart, from cool and cheap to hot and dear; the dearest is white.
pub const TINTS: [u32; SquareKind::ALL.len()] = [
    0x0056_b4e9,
    0x00f0_e442,
    0x00e6_9f00,
    0x00cc_79a7,
    0x00d5_5e00,
    0x00ff_ffff,
];

/// The frames of the present state.
pub struct Pictures {
    /// The frame as it is shaded; in a wipe the last side that was drawn, or the picture if the reference draws both.
    pub frame: Frame,
    levels: Frame,
    /// Left and right of the divider, except for exact Phong; 0x00RRGGBB.
    pub sides: [Vec<u32>; 2],
    /// The picture by one kind of lights each, and by all; in quarters.
    pub terms: Vec<u32>,
    /// The milliseconds of the last frame; `None` in a wipe that draws a side.
    pub time: Option<f64>,
}

impl Pictures {
    pub fn new(workers: Workers) -> Self {
        let level = workers.level();
        Pictures {
            frame: Frame::new(Keep::Display, workers),
            levels: levels(level),
            sides: Default::default(),
            terms: Vec::new(),
            time: None,
        }
    }

    /// Draws all pictures that `viewer` shows. Others are given back.
    ///
    /// # Errors
    /// If they do not fit in memory.
    pub fn draw(
        &mut self,
        world: &mut World,
        viewer: &Viewer,
        view: &View,
    ) -> Result<(), OutOfMemory> {
        self.time = None;
        if viewer.show != ViewMode::Tiles {
            self.levels = levels(self.frame.workers().level());
        }
        if viewer.show == ViewMode::Wipe && viewer.sides != [Side::Reference; 2] {
            let mut has_frame = false;
            for (side, pixels) in viewer.sides.iter().zip(&mut self.sides) {
                let view = side_view(side, view);
                memory::clear(pixels, view.map_or(0, |it| it.size[0] * it.size[1]));
                if let Some(view) = view {
                    if view.shading.is_none_or(ShadingMode::is_drawn) {
                        systems::draw(world, &view, &mut self.frame)?;
                        pixels.extend_from_slice(self.frame.pixels());
                        has_frame = true;
                    } else {
                        draw_by_reference(world, &view, pixels);
                    }
                }
            }
            if !has_frame {
                systems::draw(world, view, &mut self.frame)?;
            }
            return Ok(());
        }
        self.sides = Default::default();
        self.terms = Vec::new();
        if viewer.show == ViewMode::Terms {
            self.terms = terms(world, view, &mut self.frame)?;
        }
        let start = Instant::now();
        systems::draw(world, view, &mut self.frame)?;
        self.time = Some(start.elapsed().as_secs_f64() * 1e3);
        if viewer.show == ViewMode::Tiles {
            systems::draw(world, view, &mut self.levels)?;
        }
        Ok(())
    }

    /// The frame with its squares tinted, 0x00RRGGBB.
    pub fn tiles(&self) -> Vec<u32> {
        let mut pixels = self.frame.pixels().to_vec();
        tint(&mut pixels, self.levels.kinds(), self.levels.triangles());
        pixels
    }
}

/// Appends the picture of the reference in f64.
fn draw_by_reference(world: &World, view: &View, pixels: &mut Vec<u32>) {
    let reference = Reference::<f64>::new(world, view);
    let row = |y| {
        let mut row = Vec::new();
        reference.row(y, |_, seen| row.push(display_pixel(seen[0].levels)));
        row
    };
    pixels.par_extend((0..view.size[1]).into_par_iter().flat_map_iter(row));
}

/// The kinds of lights whose terms a quarter of the picture shows, row by row from the top; `None` is their sum.
pub const QUARTERS: [Option<LightKind>; 4] = [
    Some(LightKind::Ambient),
    Some(LightKind::Diffuse),
    Some(LightKind::Specular),
    None,
];

/// The picture at half its size by the lights of each of [`QUARTERS`], in one picture of the whole size.
fn terms(world: &mut World, view: &View, frame: &mut Frame) -> Result<Vec<u32>, OutOfMemory> {
    let [width, height] = view.size;
    let size = view.size.map(|side| side.div_ceil(2));
    let mut pixels = memory::reserve_pixels(view.size)?;
    pixels.resize(width * height, 0);
    for (quarter, kind) in QUARTERS.into_iter().enumerate() {
        let lights = world.query_mut::<&mut Light>().into_iter();
        let put_out = |light: &mut Light| {
            let was_on = light.on;
            light.on &= kind.is_none_or(|kind| light.kind == kind);
            was_on
        };
        let were_on: Vec<bool> = lights.map(put_out).collect();
        let drawn = systems::draw(world, &View { size, ..*view }, frame);
        let lights = world.query_mut::<&mut Light>().into_iter();
        lights
            .zip(were_on)
            .for_each(|(light, was_on)| light.on = was_on);
        drawn?;
        let [left, top] = [quarter % 2 * size[0], quarter / 2 * size[1]];
        let lines = pixels.chunks_exact_mut(width).skip(top);
        for (line, drawn) in lines.zip(frame.pixels().chunks_exact(size[0])) {
            let line = &mut line[left..];
            let count = line.len().min(size[0]);
            line[..count].copy_from_slice(&drawn[..count]);
        }
    }
    Ok(pixels)
}

/// An empty frame for the squares of the picture.
fn levels(level: Level) -> Frame {
    Frame::new(Keep::Levels, Workers::alone(level))
}

/// The pictures left and right of the divider; where there is none, both are the picture.
pub fn sides(viewer: &Viewer) -> [Side; 2] {
    match viewer.show {
        ViewMode::Wipe => viewer.sides,
        _ => [Side::Picture; 2],
    }
}

/// The method of a side; `None` for the reference, and where the cuboids have different modes. `shown` is that on screen.
pub fn side_method(side: &Side, shown: Option<Method>) -> Option<Method> {
    match *side {
        Side::Picture => shown,
        Side::Method {
            mode,
            segments,
            tolerance,
        } => Some(Method::with(mode, segments, tolerance)),
        Side::Reference => None,
    }
}

/// The view of one side of a wipe; `None` for the reference.
pub fn side_view(side: &Side, view: &View) -> Option<View> {
    match side {
        Side::Picture => Some(*view),
        _ => side_method(side, None).map(|method| method.view(view)),
    }
}

/// The view that draws what a side shows: that of exact Phong for the reference.
pub fn exact_view(side: &Side, view: &View) -> View {
    let exact = || view.shaded(ShadingMode::Phong).with_tolerance(0.0);
    side_view(side, view).unwrap_or_else(exact)
}

/// `known`, or `picture` without colour and most of its light.
pub fn or_dimmed<'a>(known: Option<&'a [u32]>, picture: &[u32]) -> Cow<'a, [u32]> {
    let dim = |pixel: &u32| mix(0, grey(*pixel), 85);
    known.map_or_else(|| picture.iter().map(dim).collect(), Cow::from)
}

/// A pixel without its colour.
fn grey(pixel: u32) -> u32 {
    let [_, red, green, blue] = pixel.to_be_bytes().map(u32::from);
    // Luma after ITU-R BT.601, in parts of 256.
    let grey = (77 * red + 150 * green + 29 * blue) / 256;
    grey << 16 | grey << 8 | grey
}

/// Tints the grey of each pixel of a triangle by the kind of its square, and draws the square's outline; see [`Frame::kinds`].
fn tint(pixels: &mut [u32], kinds: &[u8], triangles: &[TriangleId]) {
    for ((pixel, kind), triangle) in pixels.iter_mut().zip(kinds).zip(triangles) {
        if *triangle != TriangleId::NONE {
            let tint = TINTS[usize::from(kind & !SQUARE_EDGE)];
            let is_edge = kind & SQUARE_EDGE != 0;
            let weight = if is_edge { OUTLINE_WEIGHT } else { TINT_WEIGHT };
            *pixel = mix(grey(*pixel), tint, weight);
        }
    }
}

/// `other` with this weight of 256 over `one`.
pub fn mix(one: u32, other: u32, weight: u32) -> u32 {
    [16, 8, 0].iter().fold(0, |mixed, shift| {
        let [one, other] = [one, other].map(|pixel| pixel >> shift & 0xff);
        mixed | (one * (256 - weight) + other * weight) >> 8 << shift
    })
}
