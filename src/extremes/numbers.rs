//! Single numbers: what the display step makes of any level, and what a scene file may not hold.

use super::bench::Trouble;
use super::setting::Setting;
use super::{Case, Rule};
use crate::frame::display_step;
use crate::scene::Scene;

/// The cases.
pub const CASES: &[Case] = &[
    Case {
        name: "levels NaN, infinite, negative, halves, and beside halves",
        rule: Rule::Own("0 0 255 0 0 0 1 1 255 255", |_| {
            let levels = [
                f64::NAN,
                f64::NEG_INFINITY,
                f64::INFINITY,
                -0.0,
                -1e300,
                0.499_999_999,
                0.5,
                1.499_999_999,
                254.5,
                1e300,
            ];
            let bytes = levels
                .map(|level| display_step(level).to_string())
                .join(" ");
            expect(bytes, "0 0 255 0 0 0 1 1 255 255")
        }),
    },
    Case {
        name: "all floats from 0 to 255 in order",
        rule: Rule::Own(
            "never a smaller byte, all 256, each within half a level",
            |_| {
                let (mut last, mut steps) = (0, 0);
                // Every 17th float.
                for bits in (0..=255.0_f32.to_bits()).step_by(17) {
                    let level = f64::from(f32::from_bits(bits));
                    let byte = display_step(level);
                    if byte < last || (f64::from(byte) - level).abs() > 0.5 || byte - last > 1 {
                        return Err(Trouble::Wrong(format!("{level} is shown as {byte}")));
                    }
                    steps += u32::from(byte != last);
                    last = byte;
                }
                expect(format!("{steps} steps up"), "255 steps up")
            },
        ),
    },
    Case {
        name: "numbers in a scene that are no numbers, infinite or out of range",
        rule: Rule::Own("each is refused, and its key named", |_| {
            let text = Setting::default().text();
            let wrong = [
                ("fov = 30.0", "fov = nan"),
                ("fov = 30.0", "fov = 0.0"),
                ("fov = 30.0", "fov = 179.000001"),
                ("height = 6.3", "height = inf"),
                ("height = 6.3", "height = 0.0"),
                ("height = 6.3", "height = 1e-101"),
                (
                    "position = [7.0, 5.0, 8.0]",
                    "position = [7.0, 5.0, 1.1e100]",
                ),
                ("target = [0.0, 0.0, 0.0]", "target = [7.0, 5.0, 8.0]"),
                ("up = [0.0, 1.0, 0.0]", "up = [7.0, 5.0, 8.0]"),
                ("size = [4.0, 3.0, 2.0]", "size = [4.0, 3.0, 0.0]"),
                ("size = [4.0, 3.0, 2.0]", "size = [4.0, 3.0, 1e400]"),
                ("rotation = [0.0, 0.0, 0.0]", "rotation = [0.0, 0.0, -inf]"),
                ("shininess = 76.8", "shininess = 1000001.0"),
                ("shininess = 76.8", "shininess = -1.0"),
                ("intensity = 170.0", "intensity = 1e31"),
                ("intensity = 170.0", "intensity = -1e-300"),
            ];
            for (right, replaced) in wrong {
                let key = right.split(' ').next().unwrap_or(right);
                let changed = text.replacen(right, replaced, 1);
                match Scene::parse("extreme", &changed) {
                    Err(error) if changed != text && error.to_string().contains(key) => {}
                    Err(error) => return Err(Trouble::Wrong(format!("{replaced}: {error}"))),
                    Ok(_) => return Err(Trouble::Wrong(format!("{replaced} is taken"))),
                }
            }
            Ok(format!("{} are refused", wrong.len()))
        }),
    },
];

fn expect(found: String, expected: &str) -> Result<String, Trouble> {
    if found == expected {
        Ok(found)
    } else {
        Err(Trouble::Wrong(found))
    }
}
