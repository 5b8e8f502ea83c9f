//! Random records, with every optional key. Numbers are as often near the ends of their ranges as near 0.

use proptest::prelude::*;
use shadetrade::components::numbers::range_of;
use shadetrade::scene::{CameraRecord, CuboidRecord, LightRecord};

use crate::support::prelude::*;

/// A number at a key, as often near 0 as far from it, and sometimes an end of its range.
fn number(random: &mut Random, key: &str) -> f64 {
    let (least, most) = range_of(key).into_inner();
    let smallest = if least > 0.0 { least } else { 1e-320 };
    let size = random.between(smallest, most);
    let number = [least, most, size, -size][random.below(20).min(2 + random.below(2))];
    number.clamp(least, most) + 0.0
}

fn three(random: &mut Random, key: &str) -> DVec3 {
    DVec3::from([(); 3].map(|()| number(random, key)))
}

fn maybe<T>(random: &mut Random, of: impl FnOnce(&mut Random) -> T) -> Option<T> {
    (random.below(2) == 0).then(|| of(random))
}

/// An ordinary name, or a text of any characters. The name of a light holds no comma.
pub fn name(random: &mut Random) -> String {
    let letter = |random: &mut Random| match random.below(3) {
        0 => char::from(random.below(128) as u8),
        1 => random.one_of(&['"', '\'', '\\', '\n', '\u{7f}', 'é', '#']),
        _ => char::from_u32(random.below(0x0011_0000) as u32).unwrap_or('.'),
    };
    let letters = 0..random.below(8);
    let text: String = letters.map(|_| letter(random)).collect();
    maybe(random, |_| "white".to_owned()).unwrap_or_else(|| text.replace(',', ""))
}

pub fn cuboid(random: &mut Random) -> CuboidRecord {
    let [ambient, diffuse, specular] = [(); 3].map(|()| three(random, "intensity"));
    CuboidRecord {
        rotation: three(random, "rotation"),
        shading: random.one_of(&ShadingMode::ALL),
        normals: random.one_of(&NormalMode::ALL),
        material: Material {
            ambient,
            diffuse,
            specular,
            shininess: number(random, "shininess"),
        },
        ..records::cuboid(
            name(random),
            three(random, "size"),
            three(random, "position"),
        )
    }
}

pub fn light(random: &mut Random) -> LightRecord {
    let kind = random.one_of(&LightKind::ALL);
    let [intensity, gain] = [(); 2].map(|()| number(random, "intensity"));
    LightRecord {
        color: three(random, "intensity"),
        gain,
        on: random.below(2) == 0,
        ..records::light(name(random), kind, intensity, three(random, "position"))
    }
}

/// A camera whose numbers fit together.
pub fn camera(random: &mut Random) -> CameraRecord {
    let mut scene = SceneRecord {
        cuboid: vec![records::cuboid("cuboid", [1.0; 3], [0.0; 3])],
        ..SceneRecord::default()
    };
    let name = name(random);
    loop {
        scene.camera = vec![any_camera(random)];
        if scene.check().is_ok() {
            return CameraRecord {
                name,
                ..scene.camera.remove(0)
            };
        }
    }
}

fn any_camera(random: &mut Random) -> CameraRecord {
    let [position, target, up] = [(); 3].map(|()| three(random, "position"));
    let sees = [number(random, "fov"), number(random, "size")];
    let orbit = maybe(random, |random| Orbit {
        azimuth: number(random, "azimuth"),
        elevation: number(random, "azimuth"),
        zoom: number(random, "zoom"),
    });
    CameraRecord {
        up,
        near: maybe(random, |random| number(random, "size")),
        orbit: orbit.unwrap_or_default(),
        ..records::camera("camera", position, target, sees)
    }
}

fn tolerance(random: &mut Random) -> f64 {
    maybe(random, |random| number(random, "tolerance").max(1e-4)).unwrap_or(0.0)
}

fn side(random: &mut Random) -> Side {
    let [gouraud, phong] = [ShadingMode::Gouraud, ShadingMode::Phong].map(|mode| Side::Method {
        segments: None,
        mode,
        tolerance: tolerance(random),
    });
    let shortcut = Side::Method {
        segments: None,
        mode: ShadingMode::UnitVectors,
        tolerance: 0.0,
    };
    let sides = [Side::Picture, Side::Reference, shortcut, gouraud, phong];
    random.one_of(&sides)
}

/// A view. Its camera is chosen where the cameras are known.
pub fn view(random: &mut Random) -> Viewer {
    use ViewMode::{Error, Picture, Tiles, Wipe};
    if random.below(4) == 0 {
        return Viewer::default();
    }
    let pixel = |random: &mut Random| [(); 2].map(|()| number(random, "pixel"));
    let budget = maybe(random, |random| number(random, "budget"));
    Viewer {
        camera: None,
        projection: random.one_of(&Projection::ALL),
        tolerance: budget.map_or_else(|| tolerance(random), |_| Viewer::TOLERANCE),
        budget,
        show: random.one_of(&[Picture, Wipe, Error, Tiles]),
        sides: [side(random), side(random)],
        divider: number(random, "divider"),
        turned: random.below(360) as u32,
        pixel: maybe(random, pixel),
        turns: false,
    }
}

/// Renames duplicate and empty names.
pub fn with_own_names(mut record: SceneRecord) -> SceneRecord {
    fn tell_apart<'a>(names: impl Iterator<Item = &'a mut String>) {
        let mut known = Vec::new();
        for name in names {
            while ["", "all", "none"].contains(&&**name) || known.contains(name) {
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

/// A legal record.
pub fn record() -> impl Strategy<Value = SceneRecord> {
    any::<u64>().prop_map(|seed| {
        let random = &mut Random(seed);
        let [cuboids, lights, cameras] = [0, 1, 0].map(|least| least..1 + random.below(3));
        let mut record = with_own_names(SceneRecord {
            background: three(random, "background"),
            cuboid: cuboids.map(|_| cuboid(random)).collect(),
            light: lights.map(|_| light(random)).collect(),
            camera: cameras.map(|_| camera(random)).collect(),
            view: view(random),
        });
        let active = random.below(record.camera.len());
        record.view.camera = (active > 0).then(|| record.camera[active].name.clone());
        record
    })
}
