//! The record of a run: positions, velocities, accelerations and multipliers every 10 ms.

use super::linkage::{Equations, NONE, N_Q, N_ROWS, N_Y};

/// Trajectory on a grid; accelerations and multipliers with γ, not with γ̂.
#[derive(Clone, Debug, Default)]
pub struct Recorded {
    /// s.
    pub t: Vec<f64>,
    /// (q, v).
    pub y: Vec<[f64; N_Y]>,
    /// q̈.
    pub a: Vec<[f64; N_Q]>,
    /// λ.
    pub lam: Vec<[f64; N_ROWS]>,
}

impl Recorded {
    /// An empty record with capacity for a number of states.
    pub fn with_capacity(states: usize) -> Self {
        Self {
            t: Vec::with_capacity(states),
            y: Vec::with_capacity(states),
            a: Vec::with_capacity(states),
            lam: Vec::with_capacity(states),
        }
    }

    /// Stores a state with its accelerations and multipliers.
    #[inline]
    pub fn keep<E: Equations>(&mut self, t: f64, y: &[f64; N_Y]) {
        let found = E::solve(y, NONE);
        self.t.push(t);
        self.y.push(*y);
        self.a.push(found.a);
        self.lam.push(found.lam);
    }
}
