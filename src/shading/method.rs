//! The methods: a definition of the picture and a tolerance each.

use serde::Serialize;

use crate::components::{ShadingMode, View};

/// A way to draw: a definition of the picture, and the permitted error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Method {
    /// Its name in reports.
    pub id: &'static str,
    /// The definition the picture is held to.
    pub mode: ShadingMode,
    /// In levels, against the exact evaluation of the same mode.
    pub tolerance: f64,
}

impl Method {
    /// This mode within this tolerance, in levels; one that is not of [`METHODS`] has no id.
    pub fn of(mode: ShadingMode, tolerance: f64) -> Method {
        let mut known = METHODS.iter();
        let known = known.find(|it| (it.mode, it.tolerance) == (mode, tolerance));
        known.copied().unwrap_or(method("", mode, tolerance))
    }

    /// `view` as this method draws it.
    pub fn view(&self, view: &View) -> View {
        view.shaded(self.mode).with_tolerance(self.tolerance)
    }
}

/// A method with a name.
const fn method(id: &'static str, mode: ShadingMode, tolerance: f64) -> Method {
    Method {
        id,
        mode,
        tolerance,
    }
}

/// The methods of a report: by mode, exact Phong last.
pub const METHODS: &[Method] = &[
    method("gouraud-0", ShadingMode::Gouraud, 0.0),
    method("gouraud-0.5", ShadingMode::Gouraud, 0.5),
    method("phong-unit-vectors", ShadingMode::UnitVectors, 0.0),
    method("phong-4", ShadingMode::Phong, 4.0),
    method("phong-2", ShadingMode::Phong, 2.0),
    method("phong-1", ShadingMode::Phong, 1.0),
    method("phong-0.5", ShadingMode::Phong, 0.5),
    method("phong-0.25", ShadingMode::Phong, 0.25),
    method("phong-0", ShadingMode::Phong, 0.0),
];

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
