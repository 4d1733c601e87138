//! Pairs of rows [±I b] of A at one group, such as those of a revolute joint. Their products with W⁻¹ need few
//! numbers.
//!
//! With W⁻¹ = diag(d₀⁻¹, d₁⁻¹, 0) + d₂⁻¹ e eᵀ, the product with another pair is ±diag(d₀⁻¹, d₁⁻¹) + d₂⁻¹ ρ ρ′ᵀ, where
//! ρ = [±I b] e. The functions are generic in the block size because their callers are; they are meant for two rows.

#![allow(clippy::needless_range_loop)] // as in block.rs

use super::mass_block::InverseMass;
use crate::math::{each, indexed, Real};

/// A pair of rows [±I b] with the mass of its group.
#[derive(Clone, Copy, Debug)]
pub struct PinBlock<S> {
    /// ρ.
    pub(super) along: [S; 2],
    /// ρ/d₂.
    scaled: [S; 2],
    /// 1/d₀ and 1/d₁.
    translation: [S; 2],
}

impl<S: Real> PinBlock<S> {
    /// All zero.
    #[inline]
    pub(super) fn zero() -> Self {
        let zero = [S::zero(); 2];
        Self { along: zero, scaled: zero, translation: zero }
    }

    /// The pin block of rows [±I b] at a group.
    #[inline(always)]
    pub(super) fn new(sign: f64, b: &[S; 2], mass: &InverseMass<S>) -> Self {
        let e = &mass.direction;
        let along = indexed(|i| (b[i] * e[2]).plus_product(S::constant(sign), e[i]));
        Self { along, scaled: each(along, |r| r * mass.along), translation: mass.translation }
    }

    /// target += U W⁻¹ Uᵀ, in the lower triangle.
    #[inline(always)]
    pub(super) fn add_square<const N: usize>(&self, target: &mut [[S; N]; N]) {
        for i in 0..N {
            for j in 0..i + 1 {
                target[i][j] = target[i][j].plus_product(self.along[i], self.scaled[j]);
            }
            target[i][i] += self.translation[i];
        }
    }

    /// target += U W⁻¹ U′ᵀ with ρ′ of another pair. `sign` is the product of both signs.
    #[inline(always)]
    pub(super) fn add_product<const M: usize, const N: usize>(
        &self,
        other: &[S; 2],
        sign: f64,
        target: &mut [[S; N]; M],
    ) {
        let signed = each(self.translation, |inverse| S::constant(sign) * inverse);
        for i in 0..2 {
            for j in 0..2 {
                target[i][j] = target[i][j].plus_product(self.scaled[i], other[j]);
            }
            target[i][i] += signed[i];
        }
    }

    /// target += U W⁻¹ aᵀ with a row a, transformed and scaled by W⁻¹.
    #[inline(always)]
    pub(super) fn add_product_with_row<const M: usize, const N: usize>(
        &self,
        row: &[S; 3],
        sign: f64,
        target: &mut [[S; N]; M],
    ) {
        for (i, target) in target.iter_mut().enumerate().take(2) {
            let along = (self.along[i] * row[2]).plus_product(S::constant(sign), row[i]);
            target[0] += along;
        }
    }

    /// x -= W⁻¹ Uᵀ λ, with e of the group.
    #[inline(always)]
    pub(super) fn subtract_transposed<const N: usize>(
        &self,
        sign: f64,
        e: &[S; 3],
        lambda: &[S; N],
        x: &mut [S; 3],
    ) {
        let along = (self.scaled[0] * lambda[0]).plus_product(self.scaled[1], lambda[1]);
        let mut found = *x;
        for i in 0..2 {
            found[i] = found[i].minus_product(S::constant(sign) * self.translation[i], lambda[i]);
        }
        for i in 0..3 {
            found[i] = found[i].minus_product(e[i], along);
        }
        *x = found;
    }
}
