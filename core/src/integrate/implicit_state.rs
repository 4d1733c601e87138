//! A state of an implicit method: (q, v, z) with accelerations, multipliers, rates of z and powers.

use super::dae::{DaeLengths, DaeRates, Iterate};

/// A state and its derivative.
#[derive(Clone, Debug)]
pub(super) struct ImplicitState {
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub a: Vec<f64>,
    pub lam: Vec<f64>,
    /// First-order states.
    pub z: Vec<f64>,
    pub dz: Vec<f64>,
    /// Rates of the quadratures.
    pub powers: Vec<f64>,
}

impl ImplicitState {
    pub fn new(lengths: DaeLengths) -> Self {
        let DaeLengths { coordinates, multipliers, states, quadratures, .. } = lengths;
        Self {
            q: vec![0.0; coordinates],
            v: vec![0.0; coordinates],
            a: vec![0.0; coordinates],
            lam: vec![0.0; multipliers],
            z: vec![0.0; states],
            dz: vec![0.0; states],
            powers: vec![0.0; quadratures],
        }
    }

    pub fn iterate(&self) -> Iterate<'_> {
        let Self { q, v, a, lam, z, dz, .. } = self;
        Iterate { q, v, a, lam, z, dz }
    }

    /// The state, and the memory for its derivative.
    pub fn rates(&mut self) -> ([&[f64]; 3], DaeRates<'_>) {
        let Self { q, v, a, lam, z, dz, powers } = self;
        ([q, v, z], DaeRates { a, lam, dz, powers })
    }

    /// Copies q, v and z from y.
    pub fn set(&mut self, y: &[f64]) {
        let (n, s) = (self.q.len(), self.z.len());
        self.q.copy_from_slice(&y[..n]);
        self.v.copy_from_slice(&y[n..2 * n]);
        self.z.copy_from_slice(&y[2 * n..][..s]);
    }

    /// Copies q, v and z into y.
    pub fn write(&self, y: &mut [f64]) {
        let (n, s) = (self.q.len(), self.z.len());
        y[..n].copy_from_slice(&self.q);
        y[n..2 * n].copy_from_slice(&self.v);
        y[2 * n..][..s].copy_from_slice(&self.z);
    }

    pub fn copy_from(&mut self, other: &Self) {
        self.q.copy_from_slice(&other.q);
        self.v.copy_from_slice(&other.v);
        self.a.copy_from_slice(&other.a);
        self.lam.copy_from_slice(&other.lam);
        self.z.copy_from_slice(&other.z);
        self.dz.copy_from_slice(&other.dz);
        self.powers.copy_from_slice(&other.powers);
    }

    /// Writes the derivative of y, (v, a, z′, powers).
    pub fn derivative(&self, out: &mut [f64]) {
        let (n, s) = (self.q.len(), self.z.len());
        out[..n].copy_from_slice(&self.v);
        out[n..2 * n].copy_from_slice(&self.a);
        out[2 * n..][..s].copy_from_slice(&self.dz);
        out[2 * n + s..].copy_from_slice(&self.powers);
    }
}

/// Relative difference of two step sizes below which the steps share their matrices. Differences of times are subject
/// to rounding.
const SAME: f64 = 1e-6;

/// Whether the matrices of a step serve a step of size `h`.
pub(super) fn serves(made_for: Option<f64>, h: f64) -> bool {
    made_for.is_some_and(|made_for| (made_for - h).abs() <= SAME * h.abs())
}
