//! Single numbers: what the display step makes of any level, and what a scene file may not hold.

use anyhow::{Result, bail, ensure};
use glam::DVec3;

use super::scene_spec::scene;
use super::{Case, case};
use crate::frame::display_step;
use crate::scene::Scene;

/// The cases.
pub fn cases() -> Vec<Case> {
    vec![
        case(
            "levels NaN, infinite, negative, halves, and beside halves",
            "0 0 255 0 0 0 1 1 255 255",
            |_| {
                let (nan, infinity) = (f64::NAN, f64::INFINITY);
                let below = [nan, -infinity, infinity, -0.0, -1e300, 0.499_999_999];
                let above = [0.5, 1.499_999_999, 254.5, 1e300];
                let levels = below.into_iter().chain(above);
                let bytes: Vec<String> = levels
                    .map(|level| display_step(level).to_string())
                    .collect();
                expect(bytes.join(" "), "0 0 255 0 0 0 1 1 255 255")
            },
        ),
        case(
            "all floats from 0 to 255 in order",
            "never a smaller byte, all 256, each within half a level",
            |_| {
                let (mut last, mut steps) = (0, 0);
                // Every 17th float.
                for bits in (0..=255.0_f32.to_bits()).step_by(17) {
                    let level = f64::from(f32::from_bits(bits));
                    let byte = display_step(level);
                    if byte < last || (f64::from(byte) - level).abs() > 0.5 || byte - last > 1 {
                        bail!("{level} is shown as {byte}");
                    }
                    steps += u32::from(byte != last);
                    last = byte;
                }
                expect(format!("{steps} steps up"), "255 steps up")
            },
        ),
        case(
            "numbers in a scene that are no numbers, infinite or out of range",
            "each is refused, and its key named",
            |_| refused(),
        ),
    ]
}

/// A key with the value that it has in the default scene, and values that it must not have.
const REFUSED: [(&str, &str, &[&str]); 9] = [
    ("fov", "30.0", &["nan", "0.0", "179.000001"]),
    ("height", "6.3", &["inf", "0.0", "1e-101"]),
    ("position", "[7.0, 5.0, 8.0]", &["[7.0, 5.0, 1.1e100]"]),
    ("target", "[0.0, 0.0, 0.0]", &["[7.0, 5.0, 8.0]"]),
    ("up", "[0.0, 1.0, 0.0]", &["[7.0, 5.0, 8.0]"]),
    (
        "size",
        "[4.0, 3.0, 2.0]",
        &["[4.0, 3.0, 0.0]", "[4.0, 3.0, 1e400]"],
    ),
    ("rotation", "[0.0, 0.0, 0.0]", &["[0.0, 0.0, -inf]"]),
    ("shininess", "76.8", &["1000001.0", "-1.0"]),
    ("intensity", "170.0", &["1e31", "-1e-300"]),
];

fn refused() -> Result<String> {
    let text = scene().up(DVec3::Y).text();
    let mut count = 0;
    for (key, right, all) in REFUSED {
        for wrong in all {
            let changed =
                text.replacen(&format!("{key} = {right}"), &format!("{key} = {wrong}"), 1);
            match Scene::parse("extreme", &changed) {
                Err(error) if changed != text && error.to_string().contains(key) => count += 1,
                Err(error) => bail!("{key} = {wrong}: {error}"),
                Ok(_) => bail!("{key} = {wrong} is taken"),
            }
        }
    }
    Ok(format!("{count} are refused"))
}

fn expect(found: String, expected: &str) -> Result<String> {
    ensure!(found == expected, found);
    Ok(found)
}
