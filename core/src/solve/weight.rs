//! The block-diagonal part W of a saddle-point matrix, and how pivots are judged.

use crate::math::Real;

/// The block of W of one group, [d₀ 0 b₀; 0 d₁ b₁; b₀ b₁ d₂], by its factors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weight<S = f64> {
    /// 1/d₀, 1/d₁ and 1/(d₂ - b₀²/d₀ - b₁²/d₁); 0 for the first two where the group is anchored.
    pub inverse: [S; 3],
    /// b₀/d₀ and b₁/d₁; not read for groups that are not coupled.
    pub shift: [S; 2],
    /// 1/d₀ = 1/d₁ where the group is anchored, else 0: pivots are judged by what rows would weigh without anchors,
    /// since those of an anchored group may vanish.
    pub held: S,
}

/// What cannot be eliminated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dependent {
    /// A row of A that depends on the others.
    Row(usize),
    /// An unknown whose pivot in W is not positive.
    Column(usize),
}

/// Whether every pivot of W is positive and finite, in every lane; of groups that are not `loose`, the last.
#[inline(always)]
pub(super) fn check<S: Real>(weights: &[Weight<S>], loose: &[u32]) -> Result<(), Dependent> {
    let good = |i: S| above_zero(i) && above_zero(S::constant(f64::MAX) - i);
    let turns = |w: &Weight<S>| good(w.inverse[2]);
    let moves = |k: &u32| weights[*k as usize].inverse[..2].iter().all(|i| good(*i));
    if weights.iter().all(turns) && loose.iter().all(moves) {
        return Ok(());
    }
    let turned = weights.iter().position(|w| !turns(w)).map(|group| 3 * group + 2);
    let moved = loose.iter().find(|k| !moves(k)).map(|k| {
        let first = usize::from(good(weights[*k as usize].inverse[0]));
        3 * *k as usize + first
    });
    let bad = turned.into_iter().chain(moved).min();
    bad.map_or(Ok(()), |column| Err(Dependent::Column(column)))
}

/// x > 0 in every lane; NaN is not.
#[inline(always)]
pub(super) fn above_zero<S: Real>(x: S) -> bool {
    S::select(x, S::one(), S::zero()).least_magnitude() > 0.0
}
