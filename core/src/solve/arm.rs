//! Pairs of rows [±I b] of A, such as those of a revolute joint: their products need b alone.
//!
//! With W = Lw Dw Lwᵀ, [±I b] Lw⁻ᵀ = [±I b′] keeps its form, so that of U only b′ is stored. The
//! functions are generic in the size of blocks for the sake of their callers; they are meant for two rows.

use super::pattern::Owner;
use super::weight::Weight;
use crate::math::Real;

/// Such a pair in one group.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arm<S> {
    /// 1/d₀ and 1/d₁.
    inverse: [S; 2],
    /// b′.
    plain: [S; 2],
    /// b′/d₂.
    scaled: [S; 2],
}

/// b′ of the pair from the rows of A and the weight of the group.
#[inline(always)]
pub(super) fn bent<S: Real>(rows: &[[S; 3]; 2], weight: &Weight<S>, owner: &Owner) -> [S; 2] {
    let b = [rows[0][2], rows[1][2]];
    if !owner.coupled {
        return b;
    }
    let sign = S::constant(owner.sign);
    [b[0] - sign * weight.shift[0], b[1] - sign * weight.shift[1]]
}

impl<S: Real> Arm<S> {
    /// Nothing yet.
    pub fn zero() -> Self {
        let none = [S::zero(); 2];
        Self { inverse: none, plain: none, scaled: none }
    }

    /// From b′ and the weight of the group.
    #[inline(always)]
    pub fn new(plain: [S; 2], weight: &Weight<S>) -> Self {
        let [d0, d1, d2] = weight.inverse;
        Self { inverse: [d0, d1], plain, scaled: plain.map(|b| b * d2) }
    }

    /// target += U Dw⁻¹ Uᵀ, the lower triangle.
    #[inline(always)]
    pub fn add_square<const N: usize>(&self, target: &mut [[S; N]; N]) {
        for (i, target) in target.iter_mut().enumerate() {
            for (j, target) in target.iter_mut().enumerate().take(i + 1) {
                *target += self.plain[i] * self.scaled[j];
            }
            target[i] += self.inverse[i];
        }
    }

    /// target += U Dw⁻¹ U′ᵀ with another pair; `sign` is the product of both signs.
    #[inline(always)]
    pub fn add_product<const M: usize, const N: usize>(
        &self,
        other: &Self,
        sign: f64,
        target: &mut [[S; N]; M],
    ) {
        // the diagonal and what is beside it, two numbers at a time
        let along =
            [0, 1].map(|i| S::constant(sign) * self.inverse[i] + self.scaled[i] * other.plain[i]);
        let across = [0, 1].map(|i| self.scaled[i] * other.plain[1 - i]);
        for i in 0..2 {
            target[i][i] += along[i];
            target[i][1 - i] += across[i];
        }
    }

    /// y += U x.
    #[inline(always)]
    pub fn add_times<const N: usize>(&self, sign: f64, x: &[S; 3], y: &mut [S; N]) {
        for (y, b) in y.iter_mut().zip(&self.plain) {
            *y += *b * x[2];
        }
        for (y, x) in y.iter_mut().zip(x) {
            *y += S::constant(sign) * *x;
        }
    }

    /// x -= Dw⁻¹ Uᵀ λ.
    #[inline(always)]
    pub fn subtract_transposed<const N: usize>(&self, sign: f64, lambda: &[S; N], x: &mut [S; 3]) {
        let mut found = *x;
        for (i, lambda) in lambda.iter().enumerate() {
            found[i] -= S::constant(sign) * self.inverse[i] * *lambda;
            found[2] -= self.scaled[i] * *lambda;
        }
        *x = found;
    }
}
