//! The energy that force elements have dissipated from the start of a run up to a state, for conditions.
//!
//! The power is integrated on the interpolant of each step, as in reports. So the sums need no states of their own, and
//! steps do not depend on the conditions of a run.

use crate::equations::forces::{self, Acting};
use crate::equations::kinematics::Motions;
use crate::model::Model;

/// Places of Gauss and Legendre in [0, 1]. The rule is exact to degree 9.
pub(super) const PLACES: [f64; 5] = [
    0.046_910_077_030_668,
    0.230_765_344_947_158_45,
    0.5,
    0.769_234_655_052_841_5,
    0.953_089_922_969_332,
];
/// Their weights.
const WEIGHTS: [f64; 5] = [
    0.118_463_442_528_094_54,
    0.239_314_335_249_683_24,
    0.284_444_444_444_444_44,
    0.239_314_335_249_683_24,
    0.118_463_442_528_094_54,
];

/// The force elements that conditions watch, each with the energy that it has dissipated, J.
#[derive(Clone, Debug, Default)]
pub(super) struct SoFar {
    elements: Vec<(usize, f64)>,
}

impl SoFar {
    /// Watches these elements too; sums that exist go on.
    pub fn watch(&mut self, elements: impl Iterator<Item = usize>) {
        for k in elements {
            if self.of(k).is_none() {
                self.elements.push((k, 0.0));
            }
        }
    }

    /// Whether no element is watched.
    pub fn is_empty(&self) -> bool {
        self.elements.is_empty()
    }

    /// The energy that a force element has dissipated, J; None if it is not watched.
    pub fn of(&self, force: usize) -> Option<f64> {
        self.elements.iter().find(|(k, _)| *k == force).map(|(_, energy)| *energy)
    }

    /// Adds the energy of a duration; `powers` are those at the [`PLACES`] in it.
    pub fn add(&mut self, duration: f64, powers: &[Vec<f64>]) {
        for (k, (_, energy)) in self.elements.iter_mut().enumerate() {
            let power: f64 = powers.iter().zip(WEIGHTS).map(|(row, weight)| weight * row[k]).sum();
            *energy += duration * power;
        }
    }

    /// The power that each element dissipates at a state, W.
    pub fn powers(&self, model: &Model, motions: &Motions, acting: Acting<'_, f64>) -> Vec<f64> {
        let of = |(k, _): &(usize, f64)| forces::dissipated(model, *k, motions, acting);
        self.elements.iter().map(of).collect()
    }
}
