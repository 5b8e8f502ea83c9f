//! The methods: a definition of the picture and a tolerance each.

use serde::Serialize;

use crate::components::{Segments, ShadingMode, Side, View};

/// A way to draw: a definition of the picture, and the permitted error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Method {
    /// Its name in reports.
    pub id: &'static str,
    /// The definition the picture is held to.
    pub mode: ShadingMode,
    /// The segments of Gouraud; `None` leaves each cuboid its own.
    pub segments: Option<Segments>,
    /// In levels, against the exact evaluation of the same mode and segments. Flat shading, and what the reference draws, have none.
    pub tolerance: f64,
}

impl Method {
    /// This mode with the cuboids' own segments, within this tolerance in levels.
    pub fn of(mode: ShadingMode, tolerance: f64) -> Method {
        Method::with(mode, None, tolerance)
    }

    /// This mode and these segments within this tolerance; one that is not of [`METHODS`] has no id.
    pub fn with(mode: ShadingMode, segments: Option<Segments>, tolerance: f64) -> Method {
        let has_tolerance = matches!(mode, ShadingMode::Gouraud | ShadingMode::Phong);
        let unknown = if has_tolerance {
            Method {
                segments,
                ..method("", mode, tolerance)
            }
        } else {
            method("", mode, 0.0)
        };
        let known = METHODS
            .iter()
            .find(|it| Method { id: "", ..**it } == unknown);
        known.copied().unwrap_or(unknown)
    }

    /// `view` as this method draws it.
    pub fn view(&self, view: &View) -> View {
        View {
            segments: self.segments,
            ..view.shaded(self.mode).with_tolerance(self.tolerance)
        }
    }
}

impl From<Method> for Side {
    fn from(method: Method) -> Side {
        Side::Method {
            mode: method.mode,
            segments: method.segments,
            tolerance: method.tolerance,
        }
    }
}

/// A method with a name.
const fn method(id: &'static str, mode: ShadingMode, tolerance: f64) -> Method {
    Method {
        id,
        mode,
        segments: None,
        tolerance,
    }
}

/// Gouraud with this number of segments, within half a level.
const fn grid(id: &'static str, segments: u32) -> Method {
    Method {
        segments: Segments::new(segments),
        ..method(id, ShadingMode::Gouraud, 0.5)
    }
}

/// The methods of a report: by mode, flat shading first, Gouraud with its own segments and then with ever more, exact Phong last.
pub const METHODS: &[Method] = &[
    method("flat", ShadingMode::Flat, 0.0),
    method("gouraud-0", ShadingMode::Gouraud, 0.0),
    method("gouraud-0.5", ShadingMode::Gouraud, 0.5),
    grid("gouraud-1x1-0.5", 1),
    grid("gouraud-2x2-0.5", 2),
    grid("gouraud-4x4-0.5", 4),
    grid("gouraud-8x8-0.5", 8),
    grid("gouraud-16x16-0.5", 16),
    grid("gouraud-32x32-0.5", 32),
    grid("gouraud-64x64-0.5", 64),
    grid("gouraud-128x128-0.5", 128),
    grid("gouraud-256x256-0.5", 256),
    method("phong-unit-vectors", ShadingMode::UnitVectors, 0.0),
    method("blinn-phong", ShadingMode::BlinnPhong, 0.0),
    method("phong-4", ShadingMode::Phong, 4.0),
    method("phong-2", ShadingMode::Phong, 2.0),
    method("phong-1", ShadingMode::Phong, 1.0),
    method("phong-0.5", ShadingMode::Phong, 0.5),
    method("phong-0.25", ShadingMode::Phong, 0.25),
    method("phong-0", ShadingMode::Phong, 0.0),
];

/// The [`METHODS`] that differ in a scene: without the one whose segments are those of all cuboids.
pub fn methods(own: Option<Segments>) -> impl Iterator<Item = Method> {
    METHODS
        .iter()
        .copied()
        .filter(move |it| it.segments.is_none() || it.segments != own)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn methods_have_unique_names_and_end_with_exact_phong() {
        let mut ids: Vec<_> = METHODS.iter().map(|method| method.id).collect();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), METHODS.len());
        assert_eq!(
            METHODS.last().map(|method| (method.mode, method.tolerance)),
            Some((ShadingMode::Phong, 0.0))
        );
    }
}
