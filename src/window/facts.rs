//! The facts about the picture, and the changes that outdate them.

use std::sync::Arc;

use super::comparison::{Comparison, Worst};
use super::document::is_another_scene;
use super::pictures::side_method;
use crate::components::{Side, View};
use crate::questions::probe::Probe;
use crate::questions::prove::Proof;
use crate::questions::requires::PartChanges;
use crate::questions::trade::{Measured, Measurement};
use crate::questions::vary::refined::Refined;
use crate::scene::SceneRecord;
use crate::shading::Method;

/// The last value found, perhaps of an earlier picture.
#[derive(Debug)]
pub struct Latest<T> {
    pub value: Option<T>,
    /// Whether it is about the present picture. The value of an earlier one stays until then.
    pub is_current: bool,
}

impl<T> Default for Latest<T> {
    fn default() -> Self {
        Latest {
            value: None,
            is_current: false,
        }
    }
}

impl<T> Latest<T> {
    pub fn finish(&mut self, value: Option<T>) {
        (self.value, self.is_current) = (value, true);
    }

    /// The value, if it is that of the present picture.
    pub fn current(&self) -> Option<&T> {
        self.value.as_ref().filter(|_| self.is_current)
    }
}

/// The known facts.
#[derive(Default)]
pub struct Facts {
    /// The pixels of a row on one face, from left to right, in the picture that is shown there.
    pub section: Latest<(Side, Vec<Probe>)>,
    pub comparison: Latest<Comparison>,
    /// The proof of the picture, or of both sides of a wipe.
    pub proof: Latest<([Side; 2], Proof)>,
    /// It is current from its first rows on.
    pub required: Latest<PartChanges>,
    /// Those of a number that is varied. They are about their own scene, whatever the picture is.
    pub curves: Latest<Refined>,
    /// The trade of the view: every method measured. It is current whatever method is on screen.
    pub trade: Latest<Measured>,
}

impl Facts {
    /// After a change of the picture, which is not [`Change::Nothing`]. The trade is about all methods.
    pub fn outdate(&mut self, change: Change) {
        self.section.is_current = false;
        self.comparison.is_current = false;
        self.proof.is_current = false;
        self.required.is_current = false;
        self.trade.is_current &= change == Change::Method;
    }

    /// The answer about a pixel, possibly of an earlier picture.
    pub fn probed(&self, pixel: Option<[usize; 2]>) -> Option<&Probe> {
        let (_, section) = self.section.value.as_ref()?;
        section.iter().find(|probe| Some(probe.pixel) == pixel)
    }

    /// The measurement of a method in the present view.
    pub fn measured(&self, method: Method) -> Option<&Measurement> {
        let mut measured = self.trade.current()?.methods.iter();
        measured.find(|it| it.method == method)
    }

    /// The median time of a method in the present view, in milliseconds.
    pub fn measured_time(&self, method: Option<Method>) -> Option<f64> {
        Some(self.measured(method?)?.timing.median)
    }

    /// The worst pixel of a side of a wipe or of the picture, as it is now; `shown` is the method on screen. The outer `None`
    /// says that it is not known yet, the inner one that nothing can be compared.
    pub fn worst(&self, side: &Side, shown: Option<Method>) -> Option<Option<Worst>> {
        if *side == Side::Reference {
            return Some(None);
        }
        let method = side_method(side, shown);
        let comparison = self.comparison.current();
        let compared = comparison.and_then(|it| it.worst_by(method, shown));
        let measured = || Some(self.measured(method?)?.error.map(Worst::from));
        compared.or_else(measured)
    }
}

/// The change between two pictures that facts are about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    Nothing,
    /// The same view is drawn by another method.
    Method,
    Scene,
}

/// The change from one state and view to others.
pub fn change(
    (before, view_before): (&Arc<SceneRecord>, &View),
    (after, view): (&Arc<SceneRecord>, &View),
) -> Change {
    let by_any_method = |view: &View| view.unshaded().with_tolerance(0.0);
    if Arc::ptr_eq(before, after) && view == view_before {
        Change::Nothing
    } else if by_any_method(view) != by_any_method(view_before) || is_another_scene(before, after) {
        Change::Scene
    } else if view != view_before || before.cuboid != after.cuboid {
        Change::Method
    } else {
        Change::Nothing
    }
}
