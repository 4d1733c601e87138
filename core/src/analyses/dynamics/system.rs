//! The equations of motion as a first-order system y = (q, v, work).

use crate::equations::{Gains, Singular, Workspace};
use crate::integrate::FirstOrder;
use crate::model::Model;

/// Works that are integrated beside the motion: dissipated, of drivers, of applied forces.
pub(super) const WORKS: usize = 3;

/// The right side of forward dynamics.
pub(super) struct Equations<'a> {
    pub model: &'a Model,
    pub workspace: Workspace,
    pub gains: Gains,
}

impl FirstOrder for Equations<'_> {
    type Stop = (f64, Singular);

    fn len(&self) -> usize {
        2 * self.model.layout.n_q + WORKS
    }

    /// Steps are judged by the motion alone.
    fn controlled(&self) -> usize {
        2 * self.model.layout.n_q
    }

    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Self::Stop> {
        let n = self.model.layout.n_q;
        let (q, v) = (&y[..n], &y[n..2 * n]);
        let outcome = self.workspace.accelerate(self.model, t, q, v, self.gains);
        if let Err(singular) = outcome {
            if y.iter().all(|y| y.is_finite()) {
                return Err((t, singular));
            }
            dy.fill(f64::NAN); // the trial state is off, not the mechanism: a shorter step may do
            return Ok(());
        }
        dy[..n].copy_from_slice(v);
        dy[n..2 * n].copy_from_slice(self.workspace.a());
        let powers = self.workspace.powers(self.model, v);
        dy[2 * n..].copy_from_slice(&[powers.dissipated, powers.drivers, powers.applied]);
        Ok(())
    }
}
