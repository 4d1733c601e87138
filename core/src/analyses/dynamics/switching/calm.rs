//! Holds released switches again after they have kept one piece.

use super::{History, Switching, CALM};
use crate::integrate::Step;
use crate::model::Model;

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
}
