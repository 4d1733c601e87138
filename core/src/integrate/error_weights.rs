//! The error weights of implicit methods: atol + rtol |y|.

use super::implicit_state::ImplicitState;
use super::step_control::{Atol, StepControl};

/// Relative error of the positions beyond which a step may end on another solution branch of the constraints.
const FAR: f64 = 1e-2;

/// Error weights of q, then of v, then of z.
#[derive(Clone, Debug)]
pub(super) struct ErrorWeights {
    rtol: f64,
    atol: Vec<f64>,
    pub weights: Vec<f64>,
}

impl ErrorWeights {
    /// Weights for `controlled` components.
    pub fn new(control: &StepControl, controlled: usize) -> Self {
        let atol = match &control.atol {
            Atol::Scalar(atol) | Atol::Scaled(atol) => vec![*atol; controlled],
            Atol::Each(atol) => atol.clone(),
        };
        Self { rtol: control.rtol, weights: vec![1.0; atol.len()], atol }
    }

    /// Sets the weights from the larger magnitude of two states, component by component.
    pub fn set(&mut self, old: &ImplicitState, new: &ImplicitState) {
        let mut weights = self.weights.iter_mut().zip(&self.atol);
        for (old, new) in [(&old.q, &new.q), (&old.v, &new.v), (&old.z, &new.z)] {
            for ((a, b), (weight, atol)) in old.iter().zip(new).zip(weights.by_ref()) {
                *weight = atol + self.rtol * a.abs().max(b.abs());
            }
        }
    }

    /// The norm above which errors normal to the constraints count, although the constraints remove them.
    pub fn far(&self) -> f64 {
        FAR / self.rtol
    }

    /// The norm of the errors of quadratures of a magnitude `scale`.
    pub fn of_quadratures(&self, scale: f64, errors: impl ExactSizeIterator<Item = f64>) -> f64 {
        let n = errors.len().max(1);
        (errors.map(|x| x * x).sum::<f64>() / n as f64).sqrt() / (self.rtol * scale)
    }

    /// √(mean (xᵢ / weightᵢ)²) over q, v and z. A quotient 0 / 0 counts as zero.
    pub fn norm(&self, dq: &[f64], dv: &[f64], dz: &[f64]) -> f64 {
        let n = self.weights.len().max(1);
        let parts = dq.iter().chain(dv).chain(dz).zip(&self.weights);
        let sum: f64 = parts.filter(|(x, _)| **x != 0.0).map(|(x, w)| (x / w) * (x / w)).sum();
        (sum / n as f64).sqrt()
    }
}
