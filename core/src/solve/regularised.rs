//! Regularised factors of [W Aᵀ; A -μI] where rows of A come near to dependence (Tikhonov).
//!
//! Where a pivot of S = A W⁻¹ Aᵀ falls below [`NEAR`] S_kk, there are two possible causes. Either W is uneven: a light
//! body between heavy ones has small pivots in every position. Then the factor is as good as any. Or A itself is
//! near to losing rank. The Gram matrix of A in a metric without masses decides: each body has the same mass, and
//! the arm of its farthest row as radius of gyration. If that has a small pivot as well,
//!
//! ```text
//! S + ε² diag S,   ε² = ridge
//! ```
//!
//! is factorised instead: multipliers along a left singular vector of the singular value σ (relative to
//! the rows) are those of A times σ² / (σ² + ε²), so they stay bounded, and vanish with σ.

use super::breakdown::Breakdown;
use super::mass_block::{dot, InverseMass, PIVOT_TOLERANCE};
use super::pattern::Pattern;
use super::saddle::Saddle;
use crate::math::Real;

/// Pivots below this part of S_kk are examined: σ below about 0.05.
const NEAR: f64 = 2e-3;
/// In long chains, rounding errors of far positions add up: the part grows by itself with so many groups,
const LONG: f64 = 1e3;
/// up to this multiple.
const FARTHEST: f64 = 2.5;

impl<S: Real> Saddle<S> {
    /// Refuses pivots below 2e-3 of S_kk from now on, below 5e-3 in long chains, so that the caller can turn to
    /// [`factor_regularised`](Self::factor_regularised).
    pub fn refuse_near(&mut self) {
        self.least = NEAR * (1.0 + self.masses.len() as f64 / LONG).min(FARTHEST);
    }

    /// Factorises a matrix that [`factor`](Self::factor) has refused; whether with the ridge.
    ///
    /// # Errors
    /// As [`factor`](Self::factor), with [`PIVOT_TOLERANCE`].
    pub fn factor_regularised(&mut self, pattern: &Pattern, ridge: f64) -> Result<bool, Breakdown> {
        let near = self.least;
        let even = self.even_masses(pattern);
        let masses = std::mem::replace(&mut self.masses, even);
        let geometric = self.factor_reduced(pattern).is_err();
        self.masses = masses;
        self.least = PIVOT_TOLERANCE;
        self.ridge = if geometric { ridge } else { 0.0 };
        let outcome = self.factor_reduced(pattern);
        (self.least, self.ridge) = (near, 0.0);
        outcome.map(|()| geometric)
    }

    /// Unit masses; radii of gyration such that no row turns its body more than it moves it, along e for condensed
    /// groups.
    fn even_masses(&self, pattern: &Pattern) -> Vec<InverseMass<S>> {
        let (zero, one) = (S::zero(), S::one());
        let mut even = vec![InverseMass::diagonal([one; 3]); self.masses.len()];
        for place in &pattern.condensed {
            let group = place.group as usize;
            let direction = self.masses[group].direction;
            even[group] = InverseMass { translation: [zero; 2], along: one, direction, held: one };
        }
        let mut arms = vec![zero; even.len()];
        for (row, group) in pattern.rows_of_groups() {
            let entries = &self.entries[row];
            let moved = entries[0] * entries[0] + entries[1] * entries[1];
            let turned = dot(entries, &even[group].direction);
            let arm = &mut arms[group];
            *arm = S::select(moved, arm.max(turned * turned / moved), *arm);
        }
        for (mass, arm) in even.iter_mut().zip(arms) {
            mass.along = S::select(arm, one / arm, one);
        }
        even
    }
}
