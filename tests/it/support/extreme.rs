//! Numbers of a scene at any magnitude that the scene format allows.

use serde_json::Value;

use super::prelude::*;

/// The scene with one of its numbers replaced by one of any magnitude. The format refuses illegal numbers.
pub fn exaggerated(record: &SceneRecord, random: &mut Random) -> SceneRecord {
    loop {
        let mut scene = serde_json::to_value(record).expect("a record is JSON");
        let kind = random.one_of(&["background", "cuboid", "cuboid", "light", "light", "camera"]);
        let Some(number) = any_number(&mut scene[kind], random) else {
            continue;
        };
        let ordinary = random.between(1e-20, 1e20);
        let any = random.between(1e-300, 1e300);
        let ends = random.one_of(&[0.0, 5e-324, 1e-100, 1e6, 1e30, 1e100, f64::MAX]);
        let size = random.one_of(&[ends, any, any, ordinary, ordinary]);
        *number = (size * random.one_of(&[1.0, -1.0])).into();
        let scene = toml::Value::try_from(scene).expect("TOML has all that JSON has");
        if let Ok(record) = SceneRecord::from_tree(scene) {
            return record;
        }
    }
}

/// A number below `value`, reached by a random path.
fn any_number<'a>(value: &'a mut Value, random: &mut Random) -> Option<&'a mut Value> {
    let mut children: Vec<&mut Value> = match value {
        Value::Number(_) => return Some(value),
        Value::Array(all) => all.iter_mut().collect(),
        Value::Object(all) => all.values_mut().collect(),
        _ => Vec::new(),
    };
    if children.is_empty() {
        return None;
    }
    let chosen = random.below(children.len());
    any_number(children.swap_remove(chosen), random)
}

/// Makes the first cuboid a sheet or a needle, whose narrow faces lie between two pixels.
pub fn flatten(record: &mut SceneRecord, random: &mut Random) {
    let size = &mut record.cuboid[0].size;
    for axis in 0..=random.below(2) {
        size[axis] = (size[axis] * random.between(1e-9, 1e-2)).max(1e-100);
    }
}

/// Moves the eye to a tiny height above a face, which it looks along or down at.
pub fn graze(record: &mut SceneRecord, random: &mut Random) {
    let (cuboid, camera) = (&mut record.cuboid[0], &mut record.camera[0]);
    let height = random.between(1e-12, 1e3) * random.one_of(&[0.0, 1.0, 1.0, 1.0]);
    let axis = random.below(3);
    cuboid.rotation *= random.one_of(&[0.0, 1.0, 1.0]);
    let axes = turned(cuboid.rotation).axes();
    let mut over = cuboid.size / 2.0 * DVec3::new(0.3, -0.2, 0.34);
    over[axis] = cuboid.size[axis] / 2.0 + height;
    let mut ahead = DVec3::new(0.54, 0.31, -0.84);
    ahead[axis] = random.one_of(&[0.0, -1e-5, -0.1, -1.0]);
    camera.position = cuboid.position + axes * over;
    camera.target = camera.position + axes * ahead * height.min(1.0);
    camera.up = axes.col(axis) + DVec3::new(1e-3, 2e-3, 0.0);
    camera.near = Some(height * 1e-3);
    camera.height = 3.0 * height;
}
