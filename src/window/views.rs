//! Pictures in, what a view makes of them out: a wipe between two, tiles tinted, a picture that waits.
//!
//! Rule: pure functions of pixels, 0x00RRGGBB, row by row from the top; what is written is what was there, mixed with
//! nothing but the colours named here.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::canvas::mix;
use crate::components::ShadingMode;
use crate::frame::{NO_TRIANGLE, OUTLINE};
use crate::shading::TileKind;

/// What the window shows of the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ViewMode {
    /// The picture as it is shaded.
    #[default]
    Picture,
    /// Gouraud left of a divider, Phong right of it.
    GouraudPhong,
    /// The picture left of a divider, the reference, exact Phong, right of it.
    MethodReference,
    /// How far the picture errs from exact Phong.
    ErrorMap,
    /// The picture, each tile tinted by how it was drawn.
    Tiles,
}

impl ViewMode {
    /// All of them, in the order in which a key steps through them.
    pub const ALL: [ViewMode; 5] = [
        ViewMode::Picture,
        ViewMode::GouraudPhong,
        ViewMode::MethodReference,
        ViewMode::ErrorMap,
        ViewMode::Tiles,
    ];

    /// What it is called.
    pub fn label(self) -> &'static str {
        match self {
            ViewMode::Picture => "picture",
            ViewMode::GouraudPhong => "Gouraud | Phong",
            ViewMode::MethodReference => "method | reference",
            ViewMode::ErrorMap => "error map",
            ViewMode::Tiles => "tiles",
        }
    }

    /// The one so many steps on, or back where negative; the first follows the last.
    #[must_use]
    pub fn stepped(self, steps: i32) -> Self {
        let count = ViewMode::ALL.len() as i64;
        let index = self as i64 + i64::from(steps);
        ViewMode::ALL[index.rem_euclid(count) as usize]
    }

    /// Whether the reference is shown, or how far the picture is from it.
    pub fn compares(self) -> bool {
        matches!(self, ViewMode::MethodReference | ViewMode::ErrorMap)
    }
}

/// What a mode is called.
pub fn mode_label(mode: ShadingMode) -> &'static str {
    match mode {
        ShadingMode::Gouraud => "Gouraud",
        ShadingMode::Phong => "Phong",
        ShadingMode::UnitVectors => "unit vectors",
    }
}

/// The tint of every tile kind in the order of [`TileKind::ALL`], from cool and cheap to hot and dear, 0x00RRGGBB.
/// Okabe and Ito's colours (2008), which people who are colour-blind can tell apart, and white for the dearest.
pub const TINTS: [u32; TileKind::ALL.len()] = [
    0x0000_72b2,
    0x0056_b4e9,
    0x00f0_e442,
    0x00e6_9f00,
    0x00d5_5e00,
    0x00ff_ffff,
];

/// How much of a tint covers the picture, of 256.
const TINT_WEIGHT: u32 = 112;

/// The same on the outline of a square.
const OUTLINE_WEIGHT: u32 = 232;

/// `left` up to column `divider`, from there on `right`; both have rows of `width`.
pub fn wipe(pixels: &mut Vec<u32>, left: &[u32], right: &[u32], width: usize, divider: usize) {
    pixels.clear();
    pixels.extend_from_slice(left);
    let divider = divider.min(width);
    for (row, right) in pixels
        .chunks_exact_mut(width)
        .zip(right.chunks_exact(width))
    {
        row[divider..].copy_from_slice(&right[divider..]);
    }
}

/// Tints every pixel that shows a triangle by how its square was drawn, and draws the square's outline; see
/// [`crate::frame::Frame::kinds`].
pub fn tint(pixels: &mut [u32], kinds: &[u8], triangles: &[u32]) {
    for ((pixel, kind), triangle) in pixels.iter_mut().zip(kinds).zip(triangles) {
        if *triangle != NO_TRIANGLE {
            let weight = if kind & OUTLINE == 0 {
                TINT_WEIGHT
            } else {
                OUTLINE_WEIGHT
            };
            *pixel = mix(*pixel, TINTS[usize::from(kind & !OUTLINE)], weight);
        }
    }
}

/// What is known; else `picture` without colour and most of the light, as it is not yet what was asked for.
pub fn or_dimmed<'a>(known: Option<&'a Vec<u32>>, picture: &[u32]) -> Cow<'a, [u32]> {
    let dim = |pixel: &u32| {
        let [_, red, green, blue] = pixel.to_be_bytes().map(u32::from);
        // Luma after ITU-R BT.601 in parts of 256, a third of it.
        let grey = (77 * red + 150 * green + 29 * blue) / (3 * 256);
        grey << 16 | grey << 8 | grey
    };
    known.map_or_else(|| picture.iter().map(dim).collect(), Into::into)
}
