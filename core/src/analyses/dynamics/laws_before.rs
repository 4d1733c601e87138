//! Jumps of the laws of forces where a phase ends.

use super::motion_ode::MotionOde;
use super::sampling;
use crate::integrate::Step;
use crate::model::Model;

/// Largest difference of accelerations or multipliers without a jump, relative to both, and the part of the largest
/// one below which they are rounding errors.
const SAME: f64 = 1e-8;
const ROUNDING: f64 = 1e-12;

/// The laws of forces in the last step that was longer than the rounding errors of its times.
pub(super) struct LawsBefore {
    /// The pieces of switches.
    pieces: Vec<f64>,
    /// The values of sampled laws.
    sampled: Vec<f64>,
}

impl LawsBefore {
    /// The laws at the start of a phase.
    pub fn new(model: &Model, y: &[f64]) -> Self {
        Self { pieces: Vec::new(), sampled: sampling::held(model, y) }
    }

    /// Keeps the laws of a step that is longer than `rounding`.
    pub fn keep(&mut self, ode: &MotionOde<'_>, step: Option<Step<'_>>, rounding: f64) {
        if let Some(step) = step.filter(|step| (step.t - step.t_old).abs() > rounding) {
            self.sampled = sampling::held(ode.model, step.y);
            self.pieces.clone_from(&ode.workspace.motions.pieces);
        }
    }

    /// Whether the laws at a state give other accelerations or multipliers than those before it.
    pub fn jump(&self, ode: &mut MotionOde<'_>, t: f64, y: &[f64]) -> bool {
        let (model, workspace) = (ode.model, &mut ode.workspace);
        if self.sampled != sampling::held(model, y) {
            return true;
        }
        if self.pieces.is_empty() {
            return false;
        }
        workspace.motions.pieces.clone_from(&self.pieces);
        let [q, v, z, _] = model.layout.split(y);
        let mut solved = || {
            let is_solved = workspace.react(model, t, [q, v, z]).is_ok();
            workspace.motions.pieces.clear();
            is_solved.then(|| [workspace.a().to_vec(), workspace.lam().to_vec()])
        };
        let (Some(before), Some(after)) = (solved(), solved()) else { return false };
        before.iter().zip(&after).any(|(before, after)| {
            let largest = before.iter().chain(after).fold(0.0, |most: f64, x| most.max(x.abs()));
            let jumps = |(a, b): (&f64, &f64)| {
                (a - b).abs() > (SAME * a.abs().max(b.abs())).max(ROUNDING * largest)
            };
            before.iter().zip(after).any(jumps)
        })
    }
}
