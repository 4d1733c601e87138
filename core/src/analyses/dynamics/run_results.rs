//! Quantities that follow from the reported states of a run.

use super::accelerations::{accelerations, Accelerations};
use super::energies::energies;
use super::failure::Reason;
use super::model_cache::ModelCache;
use super::run::Run;
use crate::integrate::Flow;
use crate::model::Model;

impl Run {
    /// Accelerations and multipliers at the reported states, without stabilization.
    ///
    /// # Errors
    /// As [`Prepared::accelerations`](super::Prepared::accelerations).
    pub fn accelerations(&self, model: &Model) -> Result<Accelerations, Reason> {
        let watch = |_| Flow::Continue;
        accelerations(
            (model, &ModelCache::default()),
            self.trajectory.states(),
            self.passing,
            watch,
        )
    }

    /// Kinetic, potential, dissipated energy, work of drivers, work of applied forces at the reported states, J:
    /// rows of [`ENERGIES`](super::ENERGIES).
    ///
    /// # Errors
    /// As [`Prepared::energies`](super::Prepared::energies).
    pub fn energies(&self, model: &Model) -> Result<Vec<f64>, Reason> {
        energies((model, &ModelCache::default()), self.trajectory.states(), &self.trajectory.works)
    }
}
