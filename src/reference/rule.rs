//! What a picture may be evaluated without: the rules of the model that are no component of the scene.
//!
//! Rule: each is left out alone, and everything else stays as it is.

/// A rule of the model that can be left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// A highlight exists only where n.l > 0. Without it s = max(0, o.r)^rho everywhere, so light shines through a face.
    SpecularGate,
    /// Phong's n is normalised after interpolation. Without it n is the affine combination of the unit normals of the
    /// corners, which is shorter than 1 inside a face, and r = 2 (n.l) n - l is no unit vector either. Gouraud does not
    /// interpolate n.
    UnitNormal,
    /// Positions and normals (Phong) or levels (Gouraud) are interpolated on the triangle. Without it they are affine
    /// functions of the pixel: the corners' weights in the pixel a, b, c become a za, b zb, c zc over their sum. Where a
    /// corner is behind the eye, that is the affine function with the corner's value where its line through the eye meets
    /// the picture. Both are one in orthographic projection.
    PerspectiveCorrect,
    /// The nearest cuboid is seen. Without it the one later in the file is, as if each were painted over those before it.
    DepthTest,
    /// What is nearer than the near plane is cut off. Without it everything before the eye is seen, nothing behind it; in
    /// orthographic projection everything along the line of sight, in both directions.
    NearPlane,
}
