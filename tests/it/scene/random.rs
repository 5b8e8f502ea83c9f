//! Random records, with every optional key. Numbers are as often near the ends of their ranges as near 0.

use std::ops::RangeInclusive;

use glam::DVec3;
use proptest::collection::vec;
use proptest::option::of;
use proptest::prelude::*;
use proptest::sample::select;
use shadetrade::components::{
    LightKind, Magnifier, Material, Orbit, Projection, ShadingMode, Side, Tab, Tolerance, ViewMode,
};
use shadetrade::scene::range::{
    Angle, Coordinate, DisplayLevel, FieldOfView, Length, Milliseconds, OrbitAngle, Share,
    Shininess, Strength, Zoom,
};
use shadetrade::scene::{CameraRecord, CuboidRecord, LightRecord, SceneRecord, ViewRecord};

/// A number as often near 0 as far from it, and sometimes an end of its range.
fn number(range: RangeInclusive<f64>) -> impl Strategy<Value = f64> {
    let (least, most) = range.into_inner();
    let smallest = if least > 0.0 { least } else { 1e-320 };
    let size = (smallest.ln()..most.ln()).prop_map(f64::exp);
    let number = (size, any::<bool>()).prop_map(|(size, below)| if below { -size } else { size });
    prop_oneof![8 => number, 1 => Just(least), 1 => Just(most)]
        .prop_map(move |number| number.clamp(least, most) + 0.0)
}

fn three(range: &RangeInclusive<f64>) -> impl Strategy<Value = DVec3> {
    [(); 3]
        .map(|()| number(range.clone()))
        .prop_map(DVec3::from)
}

/// A text of any characters, or an ordinary name. The name of a light holds no comma.
fn name() -> impl Strategy<Value = String> {
    prop_oneof![any::<String>(), Just("white".to_owned())].prop_map(|name| name.replace(',', ""))
}

pub fn cuboid() -> impl Strategy<Value = CuboidRecord> {
    let coefficients = [(); 3].map(|()| three(&Strength::RANGE));
    let material = (coefficients, number(Shininess::RANGE));
    let modes = select(vec![ShadingMode::Gouraud, ShadingMode::Phong]);
    let places = (
        three(&Length::RANGE),
        three(&Coordinate::RANGE),
        three(&Angle::RANGE),
    );
    (name(), places, modes, material).prop_map(
        |(name, (size, position, rotation), shading, (coefficients, shininess))| {
            let [ambient, diffuse, specular] = coefficients;
            let material = Material {
                ambient,
                diffuse,
                specular,
                shininess,
            };
            CuboidRecord {
                name,
                size,
                position,
                rotation,
                shading,
                material,
            }
        },
    )
}

pub fn light() -> impl Strategy<Value = LightRecord> {
    let kind = (
        select(LightKind::ALL.to_vec()),
        three(&Coordinate::RANGE),
        any::<bool>(),
    );
    let strengths = (
        three(&Strength::RANGE),
        number(Strength::RANGE),
        number(Strength::RANGE),
    );
    (name(), kind, strengths).prop_map(|(name, (kind, position, on), (color, intensity, gain))| {
        LightRecord {
            color,
            gain,
            on,
            ..LightRecord::new(name, kind, intensity, position)
        }
    })
}

fn orbit() -> impl Strategy<Value = Orbit> {
    (
        number(OrbitAngle::RANGE),
        number(OrbitAngle::RANGE),
        number(Zoom::RANGE),
    )
        .prop_map(|(azimuth, elevation, zoom)| Orbit {
            azimuth,
            elevation,
            zoom,
        })
}

pub fn camera() -> impl Strategy<Value = CameraRecord> {
    let places = (
        three(&Coordinate::RANGE),
        three(&Coordinate::RANGE),
        three(&Coordinate::RANGE),
    );
    let sees = (
        number(FieldOfView::RANGE),
        number(Length::RANGE),
        of(number(Length::RANGE)),
    );
    (name(), places, sees, of(orbit())).prop_map(
        |(name, (position, target, up), (fov, height, near), orbit)| CameraRecord {
            up,
            near,
            orbit: orbit.unwrap_or_default(),
            ..CameraRecord::new(name, position, target, [fov, height])
        },
    )
}

fn side() -> impl Strategy<Value = Side> {
    let tolerance = prop_oneof![Just(0.0), number(1e-4..=255.0)];
    let modes = select(vec![ShadingMode::Gouraud, ShadingMode::Phong]);
    let method = (modes, tolerance).prop_map(|(mode, tolerance)| Side::Method { mode, tolerance });
    let shortcut = Side::Method {
        mode: ShadingMode::UnitVectors,
        tolerance: 0.0,
    };
    prop_oneof![
        Just(Side::Picture),
        Just(Side::Reference),
        Just(shortcut),
        method
    ]
}

/// A view. Its camera is chosen where the cameras are known.
pub fn view() -> impl Strategy<Value = ViewRecord> {
    use ViewMode::{Difference, Error, Picture, Tiles, Wipe};
    let view_modes = vec![Picture, Wipe, Error, Difference, Tiles];
    let tabs = vec![Tab::Pixel, Tab::Scene, Tab::Required, Tab::Proof];
    let pixel = || [0..16_384_usize, 0..16_384_usize];
    let magnifier = (0..7, pixel()).prop_map(|(power, corner)| Magnifier {
        scale: 1_usize << power,
        corner,
    });
    let picture = (
        select(Projection::ALL.to_vec()),
        prop_oneof![Just(0.0), number(1e-4..=255.0)],
        of(number(Milliseconds::RANGE)),
        0..360_u32,
    );
    let show = (select(view_modes), [side(), side()], number(Share::RANGE));
    let window = (of(pixel()), magnifier, of(select(tabs)));
    let changed = (picture, show, window).prop_map(
        |(
            (projection, tolerance, budget, turned),
            (show, sides, divider),
            (pixel, magnifier, inspector),
        )| {
            ViewRecord {
                camera: None,
                projection,
                tolerance: budget.map_or(tolerance, |_| Tolerance::default().0),
                budget,
                show,
                sides,
                divider,
                turned,
                pixel,
                magnifier,
                inspector,
            }
        },
    );
    prop_oneof![Just(ViewRecord::default()), changed]
}

/// Renames duplicate and empty names.
pub fn with_own_names(mut record: SceneRecord) -> SceneRecord {
    fn tell_apart<'a>(names: impl Iterator<Item = &'a mut String>) {
        let mut known = Vec::new();
        for name in names {
            if ["", "all", "none"].contains(&&**name) || known.contains(name) {
                *name = format!("{name} {}", known.len());
            }
            known.push(name.clone());
        }
    }
    tell_apart(record.cuboid.iter_mut().map(|it| &mut it.name));
    tell_apart(record.light.iter_mut().map(|it| &mut it.name));
    tell_apart(record.camera.iter_mut().map(|it| &mut it.name));
    record
}

/// A legal record. A random view is almost never parallel to `up`.
pub fn record() -> impl Strategy<Value = SceneRecord> {
    let all = (
        three(&DisplayLevel::RANGE),
        vec(cuboid(), 1..4),
        vec(light(), 0..4),
        vec(camera(), 1..4),
    );
    let record = (all, view(), any::<prop::sample::Index>());
    record
        .prop_map(|((background, cuboid, light, camera), view, active)| {
            let mut record = with_own_names(SceneRecord {
                background,
                cuboid,
                light,
                camera,
                view,
            });
            let active = active.index(record.camera.len());
            record.view.camera = (active > 0).then(|| record.camera[active].name.clone());
            record
        })
        .prop_filter("the numbers of a camera fit together", |record| {
            record.check().is_ok()
        })
}
