//! Factors of [W Aᵀ; A -μI] where rows of A come near to dependence.
//!
//! Where a pivot of S = A W⁻¹ Aᵀ falls below [`NEAR`] S_kk, one of two things holds. Either W is uneven:
//! a light body between heavy ones has small pivots wherever it stands. Then the factor is as good as
//! any. Or A itself is near to losing rank. This is told by the Gram matrix of A in a metric that knows
//! no masses, in which each body has the same mass and the arm of its farthest row as radius of
//! gyration. There
//!
//! ```text
//! S + ε² diag S,   ε² = ridge
//! ```
//!
//! is factorised instead: multipliers along a left singular vector of the singular value σ (relative to
//! the rows) are those of A times σ² / (σ² + ε²), so they stay bounded, and vanish with σ.

use super::pattern::Pattern;
use super::saddle::{Saddle, PIVOT_TOLERANCE};
use super::weight::{Dependent, Weight};
use crate::math::Real;

/// Pivots below this part of S_kk are looked at more closely: σ below about 0.05.
const NEAR: f64 = 2e-3;
/// In long chains rounding of far positions is felt further away: by so many groups the part grows by itself,
const LONG: f64 = 1e3;
/// up to this multiple.
const FARTHEST: f64 = 2.5;

impl<S: Real> Saddle<S> {
    /// Refuses pivots below 2e-3 of S_kk from now on, below 5e-3 in long chains, so that the caller can turn to
    /// [`factor_near`](Self::factor_near).
    pub fn refuse_near(&mut self) {
        self.least = NEAR * (1.0 + self.weights.len() as f64 / LONG).min(FARTHEST);
    }

    /// Factorises a matrix that was refused; whether with the ridge.
    ///
    /// # Errors
    /// As [`factor`](Self::factor), with [`PIVOT_TOLERANCE`].
    pub fn factor_near(&mut self, pattern: &Pattern, ridge: f64) -> Result<bool, Dependent> {
        let near = self.least;
        let without = self.without_masses(pattern);
        let masses = std::mem::replace(&mut self.weights, without);
        let geometric = self.factor(pattern).is_err();
        self.weights = masses;
        self.least = PIVOT_TOLERANCE;
        self.ridge = if geometric { ridge } else { 0.0 };
        let outcome = self.factor(pattern);
        (self.least, self.ridge) = (near, 0.0);
        outcome.map(|()| geometric)
    }

    /// Unit masses; radii of gyration such that no row turns its body more than it moves it, those of anchored
    /// groups about the anchor.
    fn without_masses(&self, pattern: &Pattern) -> Vec<Weight<S>> {
        let mut arms = vec![S::zero(); self.weights.len()];
        let mut held = vec![None; arms.len()];
        for anchor in &pattern.anchors {
            held[anchor.group as usize] = Some(self.weights[anchor.group as usize].shift);
        }
        for (row, group) in pattern.groups() {
            let [x, y, angle] = &self.entries[row];
            let moved = *x * *x + *y * *y;
            let turned = match held[group] {
                Some([a, b]) => *angle - a * *x - b * *y,
                None => *angle,
            };
            let arm = &mut arms[group];
            *arm = S::select(moved, arm.max(turned * turned / moved), *arm);
        }
        let inverse = |arm: S| S::select(arm, S::one() / arm, S::one());
        let weight = |(arm, held): (S, Option<[S; 2]>)| match held {
            Some(shift) => {
                Weight { inverse: [S::zero(), S::zero(), inverse(arm)], shift, held: S::one() }
            }
            None => Weight {
                inverse: [S::one(), S::one(), inverse(arm)],
                shift: [S::zero(); 2],
                held: S::zero(),
            },
        };
        arms.into_iter().zip(held).map(weight).collect()
    }
}
