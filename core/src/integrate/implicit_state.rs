//! A state of an implicit method: coordinates and velocities with accelerations, multipliers and powers.

use super::dae::Iterate;

/// A state on the constraints with its derivative.
#[derive(Clone, Debug)]
pub(super) struct ImplicitState {
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub a: Vec<f64>,
    pub lam: Vec<f64>,
    /// Rates of the quadratures.
    pub powers: Vec<f64>,
}

impl ImplicitState {
    pub fn new(n: usize, m: usize, works: usize) -> Self {
        Self {
            q: vec![0.0; n],
            v: vec![0.0; n],
            a: vec![0.0; n],
            lam: vec![0.0; m],
            powers: vec![0.0; works],
        }
    }

    pub fn point(&self) -> Iterate<'_> {
        Iterate { q: &self.q, v: &self.v, a: &self.a, lam: &self.lam }
    }

    pub fn copy_from(&mut self, other: &Self) {
        self.q.copy_from_slice(&other.q);
        self.v.copy_from_slice(&other.v);
        self.a.copy_from_slice(&other.a);
        self.lam.copy_from_slice(&other.lam);
        self.powers.copy_from_slice(&other.powers);
    }

    /// (v, a, powers): the derivative of y.
    pub fn derivative(&self, out: &mut [f64]) {
        let n = self.q.len();
        out[..n].copy_from_slice(&self.v);
        out[n..2 * n].copy_from_slice(&self.a);
        out[2 * n..].copy_from_slice(&self.powers);
    }
}
