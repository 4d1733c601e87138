//! The weights by which implicit methods measure errors: atol + rtol |y|.

use super::implicit_state::ImplicitState;
use super::step_control::{Atol, StepControl};

/// Error weights atol + rtol |y| of q, then of v.
#[derive(Clone, Debug)]
pub(super) struct ErrorWeights {
    rtol: f64,
    atol: Vec<f64>,
    pub weights: Vec<f64>,
}

impl ErrorWeights {
    pub fn new(options: &StepControl, n: usize) -> Self {
        let atol = match &options.atol {
            Atol::Scalar(atol) => vec![*atol; 2 * n],
            Atol::Each(atol) => atol.clone(),
        };
        Self { rtol: options.rtol, weights: vec![1.0; atol.len()], atol }
    }

    /// At the larger of two states.
    pub fn set(&mut self, old: &ImplicitState, new: &ImplicitState) {
        let values = |k: &'_ ImplicitState, i: usize| {
            if i < k.q.len() {
                k.q[i].abs()
            } else {
                k.v[i - k.q.len()].abs()
            }
        };
        for (i, (weight, atol)) in self.weights.iter_mut().zip(&self.atol).enumerate() {
            *weight = atol + self.rtol * values(old, i).max(values(new, i));
        }
    }

    /// √(mean (xᵢ / weightᵢ)²) over q and v; 0 / 0 counts as nothing.
    pub fn norm(&self, dq: &[f64], dv: &[f64]) -> f64 {
        let n = self.weights.len().max(1);
        let parts = dq.iter().chain(dv).zip(&self.weights);
        let sum: f64 = parts.filter(|(x, _)| **x != 0.0).map(|(x, w)| (x / w) * (x / w)).sum();
        (sum / n as f64).sqrt()
    }
}
