//! Steps to the breaks of curves.
//!
//! The pieces of a curve do not extend beyond their ends, so a step must not end before a break and the next step
//! pass over it. The interpolant of a step across the break gives its time only roughly. The step is therefore taken
//! again up to later times, until its own interpolant reaches the break at its end.

use super::{After, Due, Switching, AGAIN};
use crate::integrate::Step;
use crate::model::{Model, SwitchOwner};

/// Fraction of a step over which the rate of u is computed.
const PART: f64 = 1e-3;

impl Switching {
    /// How the run continues if a step should have ended at the break of a curve but the contact has not reached the
    /// break. None for other steps.
    pub(super) fn approach(&mut self, model: &Model, step: &Step<'_>) -> Option<After> {
        let due = self.due.as_ref().filter(|due| due.t == step.t)?;
        let &[(k, piece)] = &due.changes[..] else { return None };
        let switch = &model.switches[k];
        if switch.law || !matches!(switch.owner, SwitchOwner::Constraint(_)) {
            return None;
        }
        let tries = due.tries;
        let mut margin = |t: f64| {
            self.evaluate_at(model, step, t);
            switch.boundaries.margin(self.sigma[k], self.pieces[k])
        };
        let part = PART * (step.t - step.t_old);
        let [before, left] = [margin(step.t - part), margin(step.t)];
        let later = step.t + part * left / (before - left);
        let spacing = 4.0 * f64::EPSILON * step.t.abs().max(step.t_old.abs());
        if left <= 0.0 || (later - step.t).abs() <= 1e2 * spacing {
            return None;
        }
        let next = self.schedule.times.get(self.next).map_or(self.t_end, |(t, _)| *t);
        let within = before > left && self.sign * (next - later) > 0.0;
        self.due = (within && tries < 2 * AGAIN).then(|| Due {
            t: later,
            changes: vec![(k, piece)],
            tries: tries + 1,
        });
        Some(if self.due.is_some() { After::Again } else { After::Accept })
    }
}
