//! A [`Session`] -> how its picture is drawn, and what the components of its scene say.
//!
//! Rule: nothing here changes anything.

use hecs::Entity;

use super::{Session, Snapshot};
use crate::components::{Light, Name, Orbit, ShadingMode, Spin, View};

impl Session {
    /// How a picture of `size` pixels is to be drawn now.
    pub fn view(&self, size: [usize; 2]) -> View {
        View {
            projection: self.projection,
            tolerance: self.tolerance,
            ..self.scene.view(self.camera(), size)
        }
    }

    /// A copy of the picture of `size` pixels, for jobs.
    pub fn snapshot(&self, size: [usize; 2]) -> Snapshot {
        Snapshot {
            scene: self.scene.snapshot(),
            view: self.view(size),
            revision: self.revision,
        }
    }

    /// The light of this place in the file.
    pub fn light(&self, index: usize) -> Option<Light> {
        self.scene.get(*self.scene.lights.get(index)?)
    }

    /// The place in the file of the light so named.
    pub fn light_named(&self, name: &str) -> Option<usize> {
        self.scene.light_names().iter().position(|own| own == name)
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

    /// How all cuboids are shaded, where it is the same for all.
    pub fn shading(&self) -> Option<ShadingMode> {
        let mut query = self.scene.world.query::<&ShadingMode>();
        let mut modes = query.iter();
        let first = *modes.next()?;
        modes.all(|mode| *mode == first).then_some(first)
    }

    /// How far the cuboids have turned, and whether they go on: all do alike.
    pub fn spin(&self) -> Spin {
        let mut query = self.scene.world.query::<&Spin>();
        query.iter().next().copied().unwrap_or_default()
    }
}
