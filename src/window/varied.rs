//! The number that is varied, and what its curves are of.

use std::sync::Arc;

use hecs::World;

use super::desk::Desk;
use super::inspector::Tab;
use crate::components::{Mesh, names};
use crate::questions::job::camera_name;
use crate::questions::vary::refined::Refined;
use crate::questions::vary::variable::{Variable, present};
use crate::scene::SceneRecord;
use crate::scene::key::Key;

/// A number of the scene, and its range.
pub struct Varied {
    pub variable: Variable,
    /// The state that was looked at, and the size of the picture.
    seen: Option<(Arc<SceneRecord>, [usize; 2])>,
    /// The present value, and the curves without a point; or the reason why the scene has none.
    pub wanted: Result<(f64, Refined), String>,
}

impl Varied {
    pub fn of(variable: Variable) -> Self {
        Varied {
            variable,
            seen: None,
            wanted: Err(String::new()),
        }
    }

    /// Looks at the state of the scene, if it is another one.
    pub fn look(&mut self, state: &Arc<SceneRecord>, size: [usize; 2]) {
        let is_known = |(seen, seen_size): &(Arc<SceneRecord>, [usize; 2])| {
            Arc::ptr_eq(seen, state) && *seen_size == size
        };
        if self.seen.as_ref().is_some_and(is_known) {
            return;
        }
        self.seen = Some((Arc::clone(state), size));
        let value = present(&self.variable.key, state);
        let refined = || Refined::new(self.variable.clone(), state, size);
        let wanted = value.and_then(|value| Ok((value, refined()?)));
        let wanted = wanted.map_err(|error| format!("{error:#}"));
        match (&mut self.wanted, wanted) {
            // The scene of the curves stays the same record, which is compared by its address in each step.
            (Ok((before, known)), Ok((value, new))) if known.is_same(&new) => *before = value,
            (_, wanted) => self.wanted = wanted,
        }
    }
}

impl Desk {
    /// Shows a number of a scene against the error.
    pub fn vary(&mut self, key: Key, record: &SceneRecord) {
        match Variable::around(key, record) {
            Ok(variable) => {
                self.varied = Some(Varied::of(variable));
                self.open(Tab::Vary);
            }
            Err(error) => self.say(format!("{error:#}")),
        }
    }
}

/// The numbers that are offered first, by their names.
pub fn common_keys(world: &World) -> Vec<(&'static str, Key)> {
    let camera = Key::from("camera").child(&camera_name(world));
    let mut keys = vec![("distance", camera.child("orbit").child("zoom"))];
    if let Some(name) = names::<Mesh>(world).first() {
        let cuboid = Key::from("cuboid").child(name);
        keys.push(("segments", cuboid.child("segments")));
        keys.push(("shininess", cuboid.child("material").child("shininess")));
    }
    keys.push(("tolerance", Key::from("view.tolerance")));
    keys
}
