//! The block-diagonal part W of a saddle-point matrix, and how pivots are judged.

use crate::math::Real;

/// The block of W of one group, [d₀ 0 b₀; 0 d₁ b₁; b₀ b₁ d₂], by its factors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weight<S = f64> {
    /// 1/d₀, 1/d₁ and 1/(d₂ - b₀²/d₀ - b₁²/d₁).
    pub inverse: [S; 3],
    /// b₀/d₀ and b₁/d₁; not read for groups that are not coupled.
    pub shift: [S; 2],
}

/// What cannot be eliminated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dependent {
    /// A row of A that depends on the others.
    Row(usize),
    /// An unknown whose pivot in W is not positive.
    Column(usize),
}

/// Whether every pivot of W is positive and finite, in every lane.
#[inline(always)]
pub(super) fn check<S: Real>(weights: &[Weight<S>]) -> Result<(), Dependent> {
    let good = |i: S| above_zero(i) && above_zero(S::constant(f64::MAX) - i);
    if weights.iter().all(|w| w.inverse.iter().all(|i| good(*i))) {
        return Ok(());
    }
    let bad = weights.iter().flat_map(|w| &w.inverse).position(|i| !good(*i));
    bad.map_or(Ok(()), |column| Err(Dependent::Column(column)))
}

/// x > 0 in every lane; NaN is not.
#[inline(always)]
pub(super) fn above_zero<S: Real>(x: S) -> bool {
    S::select(x, S::one(), S::zero()).least_magnitude() > 0.0
}
