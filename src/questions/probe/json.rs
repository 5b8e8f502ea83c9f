//! The evaluation of a pixel as JSON, and the label of its triangle.

use glam::DVec3;
use serde_json::{Map, Value, json};

use super::{Probe, ProbedSurface};
use crate::reference::LightSample;
use crate::systems::frame::display_step;

/// The levels under one mode.
type Levels<T> = fn(&T) -> DVec3;

impl ProbedSurface {
    /// The number of the triangle, and the reference's number if it differs.
    pub fn triangle_label(&self) -> String {
        let own = self.triangle;
        match &self.sample {
            Some(sample) if sample.triangle != own => {
                format!("triangle {own} (reference: {})", sample.triangle)
            }
            _ => format!("triangle {own}"),
        }
    }
}

impl Probe {
    /// The evaluation as JSON. A quantity that does not exist or is not finite is null.
    pub fn json(&self) -> Value {
        let Some(surface) = &self.surface else {
            return json!({"pixel": self.pixel, "object": null});
        };
        let sample = surface.sample.as_ref();
        let shaded = |levels: DVec3, term: Levels<LightSample>| {
            let named_term = |light: &LightSample| (light.name.clone(), json!(term(light)));
            let terms = surface.lights().iter().map(named_term);
            json!({
                "levels": levels,
                "terms": terms.collect::<Map<_, _>>(),
                "bytes": bytes(levels),
            })
        };
        json!({
            "pixel": self.pixel,
            "object": surface.object,
            "triangle": surface.triangle,
            "position": sample.map(|it| it.position),
            "normal": sample.map(|it| it.normal),
            "to_eye": sample.map(|it| it.to_eye),
            "lights": surface.lights(),
            "gouraud": shaded(surface.gouraud, |light| light.gouraud),
            "phong": shaded(surface.phong, |light| light.phong),
            "reference": {
                "triangle": sample.map(|it| it.triangle),
                "gouraud": sample.map(|it| json!({"levels": it.gouraud})),
                "phong": sample.map(|it| json!({"levels": it.phong})),
                "blinn_phong": sample.map(|it| json!({"levels": it.blinn_phong})),
            },
        })
    }
}

/// The levels after the display step.
pub(super) fn bytes(levels: DVec3) -> [u8; 3] {
    levels.to_array().map(display_step)
}
