//! What was changed in a scene -> the way back, and forth again.
//!
//! ```text
//! a change: note(what was before) --> steps        undo: steps --swap with the scene--> undone        redo: the other way
//! ```
//! Rules: a step holds what is not in the scene at the moment, so that going back and forth restores every bit. Changes
//! that belong together are one step.

use std::collections::VecDeque;
use std::time::Duration;

use hecs::Entity;

use crate::scene::Scene;
use crate::scene::edit::{Editable, Parameter};

/// How many steps are kept.
const STEPS: usize = 2000;
/// Changes of one number that follow one another within this time are one step.
const PAUSE: Duration = Duration::from_millis(600);

/// What a change belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// It stands alone.
    Single,
    /// It is one of several changes of a number.
    Number(Parameter),
    /// It is a part of the drag that goes on.
    Drag,
}

/// What a step swaps with the scene.
pub enum Saved {
    Entities(Vec<(Entity, Editable)>),
    Scene(Box<Scene>),
}

struct Step {
    saved: Saved,
    change: Change,
    /// When it was last changed.
    at: Duration,
}

impl Step {
    fn swap(&mut self, scene: &mut Scene) {
        match &mut self.saved {
            Saved::Scene(other) => std::mem::swap(scene, other),
            Saved::Entities(entities) => {
                for (entity, saved) in entities {
                    let now = scene.editable(*entity);
                    scene.restore(*entity, *saved);
                    *saved = now;
                }
            }
        }
    }
}

/// The steps that can be undone and redone.
#[derive(Default)]
pub struct History {
    steps: VecDeque<Step>,
    undone: VecDeque<Step>,
}

impl History {
    /// Keeps what was there before a change at the time `at`.
    pub fn note(&mut self, saved: Saved, change: Change, at: Duration) {
        self.undone.clear();
        let goes_on = |last: &&mut Step| match change {
            Change::Single => false,
            Change::Number(_) => last.change == change && at < last.at + PAUSE,
            Change::Drag => last.change == change,
        };
        if let Some(last) = self.steps.back_mut().filter(goes_on) {
            last.at = at;
            return;
        }
        self.steps.push_back(Step { saved, change, at });
        if self.steps.len() > STEPS {
            self.steps.pop_front();
        }
    }

    /// What follows is another step.
    pub fn end_step(&mut self) {
        if let Some(last) = self.steps.back_mut() {
            last.change = Change::Single;
        }
    }

    /// Takes back the last step; whether there was one.
    pub fn undo(&mut self, scene: &mut Scene) -> bool {
        exchange(&mut self.steps, &mut self.undone, scene)
    }

    /// Does the step again that was last taken back; whether there was one.
    pub fn redo(&mut self, scene: &mut Scene) -> bool {
        exchange(&mut self.undone, &mut self.steps, scene)
    }
}

/// Exchanges the last step of `from` with the scene and keeps it in `to`, where nothing joins it; whether there was one.
fn exchange(from: &mut VecDeque<Step>, to: &mut VecDeque<Step>, scene: &mut Scene) -> bool {
    let Some(mut step) = from.pop_back() else {
        return false;
    };
    step.swap(scene);
    step.change = Change::Single;
    to.push_back(step);
    true
}
