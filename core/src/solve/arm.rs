//! Pairs of rows [±I b] of A, such as those of a revolute joint: their products need b alone.
//!
//! With W = Lw Dw Lwᵀ, [±I b] Lw⁻ᵀ = [±I b′] keeps its form, so that of U only b′ is stored. The
//! functions are generic in the size of blocks for the sake of their callers; they are meant for two rows.

use crate::math::Real;

/// Such a pair in one group, with the weight of the group.
#[derive(Clone, Copy, Debug)]
pub struct Arm<S> {
    /// b′.
    pub(super) plain: [S; 2],
    /// b′/d₂.
    scaled: [S; 2],
    /// 1/d₀ and 1/d₁.
    inverse: [S; 2],
}

impl<S: Real> Arm<S> {
    /// With b′ = 0 and no weight.
    pub(super) fn zero() -> Self {
        let zero = [S::zero(); 2];
        Self { plain: zero, scaled: zero, inverse: zero }
    }

    /// From b′ and the inverse of Dw.
    #[inline(always)]
    pub(super) fn new(plain: &[S; 2], [d0, d1, d2]: &[S; 3]) -> Self {
        Self { plain: *plain, scaled: plain.map(|b| b * *d2), inverse: [*d0, *d1] }
    }

    /// target += U Dw⁻¹ Uᵀ, the lower triangle.
    #[inline(always)]
    pub(super) fn add_square<const N: usize>(&self, target: &mut [[S; N]; N]) {
        for (i, target) in target.iter_mut().enumerate() {
            for (j, target) in target.iter_mut().enumerate().take(i + 1) {
                *target = target.plus_product(self.plain[i], self.scaled[j]);
            }
            target[i] += self.inverse[i];
        }
    }

    /// target += U Dw⁻¹ U′ᵀ with b′ of another pair; `sign` is the product of both signs.
    #[inline(always)]
    pub(super) fn add_product<const M: usize, const N: usize>(
        &self,
        other: &[S; 2],
        sign: f64,
        target: &mut [[S; N]; M],
    ) {
        let signed = self.inverse.map(|inverse| S::constant(sign) * inverse);
        for i in 0..2 {
            for j in 0..2 {
                target[i][j] = target[i][j].plus_product(self.scaled[i], other[j]);
            }
            target[i][i] += signed[i];
        }
    }

    /// y += U x.
    #[inline(always)]
    pub(super) fn add_times<const N: usize>(&self, sign: f64, x: &[S; 3], y: &mut [S; N]) {
        for (y, b) in y.iter_mut().zip(&self.plain) {
            *y = y.plus_product(*b, x[2]);
        }
        for (y, x) in y.iter_mut().zip(x) {
            *y = y.plus_product(S::constant(sign), *x);
        }
    }

    /// x -= Dw⁻¹ Uᵀ λ.
    #[inline(always)]
    pub(super) fn subtract_transposed<const N: usize>(
        &self,
        sign: f64,
        lambda: &[S; N],
        x: &mut [S; 3],
    ) {
        let mut found = *x;
        for (i, lambda) in lambda.iter().enumerate() {
            found[i] = found[i].minus_product(S::constant(sign) * self.inverse[i], *lambda);
            found[2] = found[2].minus_product(self.scaled[i], *lambda);
        }
        *x = found;
    }
}
