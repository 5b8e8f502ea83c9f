//! What was measured, and where: what a reader needs to judge times, and to have them again.
//!
//! Rule: every report of a measurement begins with it, in the same words.

use super::Request;
use super::machine::Machine;
use super::words::counted;
use crate::components::Projection;

/// What was measured, and where.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Where.
    pub machine: Machine,
    /// The command line.
    pub command: String,
    /// The scene's name.
    pub scene: String,
    /// The camera's name.
    pub camera: String,
    /// How the picture was projected.
    pub projection: Projection,
    /// Width and height in pixels.
    pub size: [usize; 2],
}

impl Subject {
    /// Of a measurement on this machine.
    pub fn of(request: &Request) -> Self {
        Subject {
            machine: Machine::this(request.level),
            command: request.command.clone(),
            scene: request.scene.name.clone(),
            camera: request.camera.clone(),
            projection: request.view.projection,
            size: request.view.size,
        }
    }

    /// What was measured, in words.
    pub fn view(&self) -> String {
        let [width, height] = self.size;
        format!(
            "{}, camera {}, {}, {width}x{height}",
            self.scene,
            self.camera,
            self.projection.name()
        )
    }

    /// Where, in words, with how many `threads` drew.
    pub fn place(&self, threads: &str) -> String {
        let machine = &self.machine;
        // The name and the number; what follows is a commit.
        let rustc: Vec<&str> = machine.rustc.split(' ').take(2).collect();
        format!(
            "{}, {}, {}, {threads}, {}, {}, {} build",
            machine.cpu,
            counted(machine.cores, "core", "cores"),
            machine.lanes,
            machine.os,
            rustc.join(" "),
            machine.profile
        )
    }
}
