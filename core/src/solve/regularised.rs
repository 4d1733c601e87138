//! Regularised factors of [W Aᵀ; A -μI] where rows of A are nearly dependent (Tikhonov).
//!
//! A pivot of S = A W⁻¹ Aᵀ below [`NEAR`] S_kk has two possible causes. The first is an uneven W: a light body
//! between heavy bodies has small pivots in every position, and the factor is accurate. The second is that A itself
//! is nearly rank deficient. To decide, the Gram matrix of A is factorised with uniform masses: each body has unit
//! mass, and the arm of its farthest row as radius of gyration. If this matrix has a small pivot as well,
//!
//! ```text
//! S + ε² diag S,   ε² = ridge
//! ```
//!
//! is factorised instead. Multipliers along a left singular vector with the singular value σ (relative to the rows)
//! are multiplied by σ² / (σ² + ε²). They stay bounded, and vanish with σ.

use super::breakdown::Breakdown;
use super::mass_block::{dot, InverseMass, PIVOT_TOLERANCE};
use super::pattern::Pattern;
use super::saddle::Saddle;
use crate::math::{indexed, Real};

/// Pivots below this fraction of S_kk are examined; this corresponds to σ below about 0.05.
const NEAR: f64 = 2e-3;
/// Number of groups after which [`NEAR`] is doubled, since rounding errors accumulate in long chains.
const LONG: f64 = 1e3;
/// Largest factor by which [`NEAR`] is increased in long chains.
const FARTHEST: f64 = 2.5;

impl<S: Real> Saddle<S> {
    /// From now on, refuses pivots below 2e-3 of S_kk, and below 5e-3 in long chains, so that the caller can call
    /// [`factor_regularised`](Self::factor_regularised) instead.
    #[inline]
    pub fn refuse_near(&mut self) {
        self.least = NEAR * (1.0 + self.masses.len() as f64 / LONG).min(FARTHEST);
    }

    /// Factorises a matrix that [`factor`](Self::factor) has refused. Returns whether the ridge was added.
    ///
    /// # Errors
    /// As [`factor`](Self::factor), with [`PIVOT_TOLERANCE`].
    pub fn factor_regularised(&mut self, pattern: &Pattern, ridge: f64) -> Result<bool, Breakdown> {
        let near = self.least;
        let even = self.even_masses(pattern);
        let masses = std::mem::replace(&mut self.masses, even);
        let light = std::mem::take(&mut self.light);
        let geometric = self.factor_reduced(pattern).is_err();
        (self.masses, self.light) = (masses, light);
        self.least = PIVOT_TOLERANCE;
        self.ridge = if geometric { ridge } else { 0.0 };
        let outcome = self.factor_reduced(pattern);
        (self.least, self.ridge) = (near, 0.0);
        outcome.map(|()| geometric)
    }

    /// Unit masses, with radii of gyration such that no row turns its body more than it moves it. Condensed groups
    /// have a unit mass along e. The unknowns of groups with fewer than three have masses with which each is at most 1
    /// in all rows: they may be parameters of curves, in any unit.
    fn even_masses(&self, pattern: &Pattern) -> Vec<InverseMass<S>> {
        let (zero, one) = (S::zero(), S::one());
        let mut even = vec![InverseMass::diagonal([one; 3]); self.masses.len()];
        for place in &pattern.condensed {
            let group = place.group as usize;
            let direction = self.masses[group].direction;
            even[group] = InverseMass { translation: [zero; 2], along: one, direction, held: one };
        }
        let mut arms = vec![zero; even.len()];
        let mut steepest = vec![[zero; 2]; even.len()];
        for row in pattern.rows_of_groups() {
            let (entries, group) = (&self.entries[row.entry as usize], row.group as usize);
            let squares = [entries[0] * entries[0], entries[1] * entries[1]];
            let moved = squares[0] + squares[1];
            if pattern.size(group) < 3 {
                let most = &mut steepest[group];
                *most = indexed(|k| most[k].max(squares[k]));
            }
            let turned = dot(entries, &even[group].direction);
            let arm = &mut arms[group];
            *arm = S::select(moved, arm.max(turned * turned / moved), *arm);
        }
        for ((mass, arm), steepest) in even.iter_mut().zip(arms).zip(steepest) {
            mass.along = S::select(arm, one / arm, one);
            for (inverse, most) in mass.translation.iter_mut().zip(steepest) {
                *inverse = S::select(most, one / most, *inverse);
            }
        }
        even
    }
}
