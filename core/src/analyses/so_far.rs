//! Sums over a run from its start up to a state, for conditions: the energy that force elements have dissipated, and
//! the balances of energies and reactions.
//!
//! The power is integrated on the interpolant of each step, as in reports. The sums therefore need no states of their
//! own, and the steps do not depend on the conditions of a run.
//!
//! The balances measure integration errors. Inside a step they would measure the errors of the interpolant. They
//! therefore keep their values during a step and change at its end. Shorter steps would not locate their events more
//! accurately.

use super::balances::{Energies, EnergyBalance, ReactionBalance};
use crate::equations::actions;
use crate::equations::forces::Acting;
use crate::equations::kinematics::Motions;
use crate::equations::newton_euler::Balances;
use crate::math::Listed;
use crate::model::Model;
use serde::{Deserialize, Serialize};

/// Nodes of the Gauss–Legendre rule on [0, 1], which is exact up to degree 9.
pub(super) const PLACES: [f64; 5] = [
    0.046_910_077_030_668,
    0.230_765_344_947_158_45,
    0.5,
    0.769_234_655_052_841_5,
    0.953_089_922_969_332,
];
/// Weights of the nodes.
pub(super) const WEIGHTS: [f64; 5] = [
    0.118_463_442_528_094_54,
    0.239_314_335_249_683_24,
    0.284_444_444_444_444_44,
    0.239_314_335_249_683_24,
    0.118_463_442_528_094_54,
];

/// The force elements that conditions use, each with the energy that it has dissipated, J, and the balances that
/// conditions use.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct SoFar {
    elements: Vec<(usize, f64)>,
    energy: Option<EnergyBalance>,
    /// The balance of the forces, and its value at the last state.
    reactions: Option<(ReactionBalance, f64)>,
}

impl SoFar {
    /// Sums the energy that an element dissipates. A sum that already exists is continued.
    pub fn watch_element(&mut self, k: usize) {
        if self.of(k).is_none() {
            self.elements.push((k, 0.0));
        }
    }

    /// Computes the balance of energy.
    pub fn watch_energy(&mut self) {
        self.energy.get_or_insert_with(EnergyBalance::new);
    }

    /// Computes the balance of the forces on the bodies.
    pub fn watch_reactions(&mut self) {
        self.reactions.get_or_insert_with(|| (ReactionBalance::default(), f64::NAN));
    }

    /// Whether dissipated energies are summed.
    pub fn sums(&self) -> bool {
        !self.elements.is_empty()
    }

    /// Whether balances are computed.
    pub fn balances(&self) -> bool {
        self.energy.is_some() || self.reactions.is_some()
    }

    /// Whether the balances have a value.
    pub fn has_begun(&self) -> bool {
        let values = [self.energy_balance(), self.reaction_balance()];
        values.into_iter().flatten().all(|value| !value.is_nan())
    }

    /// The balance of energy. None if it is not computed.
    pub fn energy_balance(&self) -> Option<f64> {
        self.energy.map(|balance| balance.present())
    }

    /// The largest balance of a body or internal coordinate. None if it is not computed.
    pub fn reaction_balance(&self) -> Option<f64> {
        self.reactions.as_ref().map(|(_, present)| *present)
    }

    /// The energy that a force element has dissipated, J. None if it is not summed.
    pub fn of(&self, force: usize) -> Option<f64> {
        self.elements.iter().find(|(k, _)| *k == force).map(|(_, energy)| *energy)
    }

    /// Adds the energy over a duration; `powers` are the powers at the [`PLACES`] in it.
    pub fn add(&mut self, duration: f64, powers: &[Vec<f64>]) {
        for (k, (_, energy)) in self.elements.iter_mut().enumerate() {
            let power: f64 = powers.iter().zip(WEIGHTS).map(|(row, weight)| weight * row[k]).sum();
            *energy += duration * power;
        }
    }

    /// The power that each element dissipates at a state, W.
    pub fn powers(&self, model: &Model, motions: &Motions, acting: Acting<'_, f64>) -> Vec<f64> {
        let of = |(k, _): &(usize, f64)| actions::dissipated(model, *k, motions, acting);
        self.elements.iter().map(of).list()
    }

    /// Updates the balances with a state. The first state is the start of the run.
    pub fn balance(
        &mut self,
        energies: impl FnOnce() -> Energies<f64>,
        reactions: impl FnOnce() -> Balances,
    ) {
        if let Some(balance) = &mut self.energy {
            balance.add(energies());
        }
        if let Some((balance, present)) = &mut self.reactions {
            let at = reactions();
            balance.add(&at);
            *present = balance.largest(&at);
        }
    }
}
