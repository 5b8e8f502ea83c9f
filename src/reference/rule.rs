//! Rules of the model that the reference can leave out, one at a time. They are not components of a scene.

/// A rule of the model that can be left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// A highlight exists only where n.l > 0. Without the rule its factor is max(0, o.r)^rho everywhere, so a light
    /// behind a face may cause a highlight on it.
    SpecularGate,
    /// The diffuse factor is max(0, n.l). Without the rule it is n.l, so a light behind a face takes light away.
    DiffuseClamp,
    /// A highlight goes with o.r. Without the rule it goes with n.h to four times the power, h = unit(l + o): its factor is
    /// max(0, n.h)^(4 rho) where n.l > 0, and 0 where l = -o (Blinn 1977, "Models of Light Reflection for Computer
    /// Synthesized Pictures", SIGGRAPH '77; the factor 4: Fisher and Woo, Graphics Gems IV, 1994).
    Reflection,
    /// Phong's n is normalised after interpolation. Without the rule n is the affine combination of the unit normals of
    /// the corners, which is shorter than 1 inside a face, and r = 2 (n.l) n - l is no unit vector either. Gouraud is
    /// not affected, because it does not interpolate n; nor are face normals, which are the same all over a face.
    UnitNormal,
    /// Positions and normals (Phong) or levels (Gouraud) are interpolated on the triangle. Without the rule they are
    /// affine functions of the pixel: the corners' weights a, b, c become a za, b zb, c zc over their sum. A corner
    /// behind the eye is projected through the eye. In orthographic projection the rule has no effect.
    PerspectiveCorrect,
    /// The nearest cuboid is visible. Without the rule each cuboid is painted over those before it in the file.
    DepthTest,
    /// Surfaces nearer than the near plane are invisible. Without the rule everything in front of the eye is visible; in
    /// orthographic projection everything along the line of sight, in both directions.
    NearPlane,
}

impl Rule {
    /// The name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Rule::SpecularGate => "specular gate",
            Rule::DiffuseClamp => "diffuse clamp",
            Rule::Reflection => "every highlight by o.r",
            Rule::UnitNormal => "unit normal",
            Rule::PerspectiveCorrect => "perspective-correct interpolation",
            Rule::DepthTest => "depth test",
            Rule::NearPlane => "near plane",
        }
    }
}
