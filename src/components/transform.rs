//! Position and rotation of an entity.

use glam::{DMat3, DVec3};

/// The position and the rotation of an entity.
///
/// A light uses only the position.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Transform {
    /// The centre, in world units.
    pub position: DVec3,
    /// Angles about the fixed x, y and z axes, in degrees, applied in that order: Rz * Ry * Rx.
    pub rotation: DVec3,
}

impl Transform {
    /// A position without rotation.
    pub fn at(position: DVec3) -> Self {
        Transform {
            position,
            rotation: DVec3::ZERO,
        }
    }

    /// The rotation as a matrix whose columns are the entity's own axes in world space.
    ///
    /// Angles are reduced to one turn before they become radians, so 1e9 degrees are as exact as 280. Quarter turns are
    /// exact.
    pub fn axes(&self) -> DMat3 {
        let [(sx, cx), (sy, cy), (sz, cz)] = self.rotation.to_array().map(sin_cos_degrees);
        let about_x = DMat3::from_cols_array(&[1.0, 0.0, 0.0, 0.0, cx, sx, 0.0, -sx, cx]);
        let about_y = DMat3::from_cols_array(&[cy, 0.0, -sy, 0.0, 1.0, 0.0, sy, 0.0, cy]);
        let about_z = DMat3::from_cols_array(&[cz, sz, 0.0, -sz, cz, 0.0, 0.0, 0.0, 1.0]);
        about_z * about_y * about_x
    }

    /// The transform turned further about the entity's own x axis.
    #[must_use]
    pub fn turned(mut self, degrees: u32) -> Self {
        self.rotation.x += f64::from(degrees);
        self
    }
}

/// The place of a cuboid in one frame: its [`Transform`] turned as the [`Viewer`](super::Viewer) says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorldTransform {
    /// The centre, in world units.
    pub position: DVec3,
    /// The cuboid's own axes in world space: see [`Transform::axes`].
    pub axes: DMat3,
}

/// Sine and cosine of an angle in degrees, exact at quarter turns.
fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    // The remainder of a float division is exact, whatever the size of the angle.
    let turn = degrees % 360.0;
    let quarter = (turn / 90.0).round();
    let (sin, cos) = (turn - 90.0 * quarter).to_radians().sin_cos();
    match quarter.rem_euclid(4.0) as u8 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(rotation: [f64; 3]) -> DMat3 {
        let transform = Transform {
            position: DVec3::ZERO,
            rotation: rotation.into(),
        };
        transform.axes()
    }

    #[test]
    fn quarter_turns_are_exact_in_both_directions_and_any_number_of_times() {
        let [x, y, z] = DVec3::AXES;
        // The directions of +x, +y and +z after none, one, two and three quarters about each axis.
        let about_x = [[x, y, z], [x, z, -y], [x, -y, -z], [x, -z, y]];
        let about_y = [[x, y, z], [-z, y, x], [-x, y, -z], [z, y, -x]];
        let about_z = [[x, y, z], [y, -x, z], [-x, -y, z], [-y, x, z]];
        for quarters in -9..=9_i32 {
            let degrees = 90.0 * f64::from(quarters);
            let place = quarters.rem_euclid(4) as usize;
            for (rotation, expected) in [
                ([degrees, 0.0, 0.0], about_x[place]),
                ([0.0, degrees, 0.0], about_y[place]),
                ([0.0, 0.0, degrees], about_z[place]),
            ] {
                let [right, up, towards] = expected;
                let expected = DMat3::from_cols(right, up, towards);
                assert_eq!(turned(rotation), expected, "{rotation:?}");
            }
        }
    }

    #[test]
    fn angles_between_quarter_turns_are_those_of_a_table() {
        // The cosine and the sine of 60 degrees.
        let (half, root) = (0.5, 3.0_f64.sqrt() / 2.0);
        for (degrees, cos, sin) in [
            (60.0, half, root),
            (120.0, -half, root),
            (150.0, -root, half),
            (210.0, -root, -half),
            (300.0, half, -root),
            (-60.0, half, -root),
            // 2,777,777 turns and 280 degrees.
            (1e9, 0.173_648_177_666_930_33, -0.984_807_753_012_208),
        ] {
            let seen = turned([0.0, 0.0, degrees]).x_axis;
            assert!(
                (seen - DVec3::new(cos, sin, 0.0)).length() < 1e-15,
                "{degrees}: {seen}"
            );
        }
    }
}
