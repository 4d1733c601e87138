//! Holds released switches again after they have kept one piece, and others where their functions are rounding errors.

use super::{History, Switching, CALM};
use crate::equations::{energy, reactive};
use crate::integrate::Step;
use crate::model::{size, Model, Switch, SwitchOwner};

/// Evaluations in a row after which a small load is noise. A search for a zero evaluates its end a few times.
const NOISY: usize = 16;

impl Switching {
    /// Holds released switches that have kept one piece for enough steps.
    pub(super) fn hold_calm(&mut self, model: &Model, step: &Step<'_>) {
        if self.on_state.iter().all(|k| !self.pieces[*k].is_nan()) {
            return;
        }
        self.evaluate_at(model, step, step.t);
        for k in &self.on_state {
            let piece = model.switches[*k].boundaries.piece(self.sigma[*k]);
            let History { last, calm: (before, steps), .. } = &mut self.history[*k];
            *steps = if piece == *before { *steps + 1 } else { 0 };
            *before = piece;
            // a switch that was on its boundary at the start was not released
            if self.pieces[*k].is_nan() && (last.is_nan() || *steps >= CALM) {
                self.pieces[*k] = piece;
            }
        }
    }

    /// Keeps the pieces of friction whose load is a rounding error beside the largest load or the forces of inertia, and
    /// so has no sign. A load that passes zero is that small too, but only where its zero is sought.
    pub(super) fn keep_through_noise(&mut self, model: &Model) {
        let Some(workspace) = &self.workspace else { return };
        let most = workspace.lam().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let inertia = energy::stirred(model, &self.motions) / size(model);
        let least = (reactive::NOISE * most.max(inertia)).max(f64::MIN_POSITIVE);
        for (k, switch) in model.switches.iter().enumerate() {
            let Switch { owner: SwitchOwner::Force(f), law: false, .. } = *switch else {
                continue;
            };
            let (sigma, piece, noisy) =
                (&mut self.sigma[k], self.pieces[k], &mut self.history[k].noisy);
            *noisy = if sigma.abs() <= least { noisy.saturating_add(1) } else { 0 };
            if model.forces[f].reaction.is_some() && *noisy > NOISY && !piece.is_nan() {
                *sigma = least.copysign(piece);
            }
        }
    }
}
