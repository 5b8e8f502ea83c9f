//! A [`Session`] -> what others may know of it.
//!
//! Rule: nothing here changes anything.

use hecs::Entity;

use super::{Measuring, Requires, Session};
use crate::components::{Light, Name, Orbit, Projection, ShadingMode, Spin};
use crate::probe::{Probe, Profile};
use crate::scene::Scene;
use crate::window::composition::FrameTimes;
use crate::window::examination::ReferenceResult;
use crate::window::view_state::ViewState;

impl Session {
    /// What is seen.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The light of this place in the file.
    pub fn light(&self, index: usize) -> Option<Light> {
        self.scene.get(*self.scene.lights.get(index)?)
    }

    /// The place in the file of the light so named.
    pub fn light_named(&self, name: &str) -> Option<usize> {
        let mut lights = self.scene.lights.iter();
        lights.position(|&entity| {
            let own = self.scene.world.get::<&Name>(entity);
            own.is_ok_and(|own| own.0 == name)
        })
    }

    /// What the scene file calls an entity.
    pub fn name(&self, entity: Entity) -> String {
        let own = self.scene.world.get::<&Name>(entity);
        own.map_or_else(|_| String::new(), |own| own.0.clone())
    }

    /// Which camera of the file the picture is seen from.
    pub fn camera(&self) -> usize {
        self.scene.active_camera()
    }

    /// How far the camera has been moved.
    pub fn orbit(&self) -> Orbit {
        self.scene.camera(self.camera()).1
    }

    /// How the picture is projected.
    pub fn projection(&self) -> Projection {
        self.projection
    }

    /// How all cuboids are shaded, where it is the same for all.
    pub fn shading(&self) -> Option<ShadingMode> {
        let mut query = self.scene.world.query::<&ShadingMode>();
        let mut modes = query.iter();
        let first = *modes.next()?;
        modes.all(|mode| *mode == first).then_some(first)
    }

    /// How far the picture may err from its own mode, in levels.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// How the scene is looked at.
    pub fn state(&self) -> &ViewState {
        &self.state
    }

    /// What is known of the pixel that is probed.
    pub fn probed(&self) -> Option<&Probe> {
        self.probe.as_ref()
    }

    /// The levels along the row of the pixel that is probed.
    pub fn profile(&self) -> Option<&Profile> {
        self.profile.as_ref()
    }

    /// What is measured, or was.
    pub fn measuring(&self) -> &Measuring {
        &self.measuring
    }

    /// What the scene requires, where it is shown.
    pub fn requires(&self) -> Option<&Requires> {
        self.requires.as_ref()
    }

    /// The number of the present picture: every change makes it larger.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// What the reference says of the present picture.
    pub fn reference(&self) -> Option<&ReferenceResult> {
        self.reference.as_ref()
    }

    /// What frames of what is shown take.
    pub fn times(&self) -> &FrameTimes {
        &self.times
    }

    /// Whether the drawn picture has one colour beside the background.
    pub fn is_flat(&self) -> bool {
        self.flat
    }

    /// How far the cuboids have turned, and whether they go on: all do alike.
    pub fn spin(&self) -> Spin {
        let mut query = self.scene.world.query::<&Spin>();
        query.iter().next().copied().unwrap_or_default()
    }
}
