//! The time -> how far the cuboids have turned about their own x axes.
//!
//! Rule: turning goes by whole degrees counted from the scene's own angles, so that nothing drifts and a full turn ends
//! where it began, bit for bit.

use std::time::Duration;

use hecs::World;

use crate::components::Transform;
use crate::scene::Scene;

/// How long one degree takes, as in the assignment's program.
const DEGREE_TIME: Duration = Duration::from_millis(30);

/// How far the cuboids have turned.
#[derive(Debug)]
pub struct Turning {
    /// When the next degree is due; `None` while nothing turns.
    due: Option<Duration>,
    degrees: u32,
    /// The cuboids' own angles about x, in the order of the scene.
    own_angles: Vec<f64>,
}

impl Turning {
    /// At rest, as the scene has the cuboids.
    pub fn new(scene: &Scene) -> Self {
        let own_angles = scene
            .cuboids
            .iter()
            .map(|&entity| angle(&scene.world, entity))
            .collect();
        Turning {
            due: None,
            degrees: 0,
            own_angles,
        }
    }

    /// Whether the cuboids turn.
    pub fn is_on(&self) -> bool {
        self.due.is_some()
    }

    /// How far they have turned, in degrees, 0..360.
    pub fn degrees(&self) -> u32 {
        self.degrees
    }

    /// Starts or stops at the time `now`.
    pub fn switch(&mut self, now: Duration) {
        self.due = if self.is_on() {
            None
        } else {
            Some(now + DEGREE_TIME)
        };
    }

    /// Turns as far as is due at the time `now`; returns whether that is any further.
    pub fn tick(&mut self, now: Duration, scene: &mut Scene) -> bool {
        let Some(due) = self.due.filter(|due| *due <= now) else {
            return false;
        };
        let more = 1 + (now.saturating_sub(due).as_millis() / DEGREE_TIME.as_millis()) as u32;
        self.due = Some(due + DEGREE_TIME * more);
        self.turn_to(self.degrees + more, scene);
        true
    }

    /// Turns the cuboids so many degrees from where the scene has them.
    pub fn turn_to(&mut self, degrees: u32, scene: &mut Scene) {
        self.degrees = degrees % 360;
        for (&entity, own) in scene.cuboids.iter().zip(&self.own_angles) {
            // Rz * Ry * Rx turns about x first, so the x angle is the one about the cuboid's own axis.
            if let Ok(mut transform) = scene.world.get::<&mut Transform>(entity) {
                transform.rotation.x = own + f64::from(self.degrees);
            }
        }
    }
}

fn angle(world: &World, entity: hecs::Entity) -> f64 {
    world
        .get::<&Transform>(entity)
        .map_or(0.0, |transform| transform.rotation.x)
}
