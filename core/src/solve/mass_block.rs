//! The block-diagonal part W of a saddle-point matrix, represented by the inverses of its blocks.

use super::breakdown::Breakdown;
use super::structure::Group;
use crate::math::{Listed, Real};

/// Smallest accepted ratio of a pivot to the diagonal entry before cancellation.
pub const PIVOT_TOLERANCE: f64 = 1e-13;

/// W⁻¹ of one group: diag(d₀⁻¹, d₁⁻¹, 0) + d₂⁻¹ e eᵀ.
///
/// A block [d₀ 0 b₀; 0 d₁ b₁; b₀ b₁ c] has e = (-b₀/d₀, -b₁/d₁, 1) and d₂ = c - b₀²/d₀ - b₁²/d₁. A
/// [condensed](super::Condensation) group can move only along e: d₀⁻¹ = d₁⁻¹ = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InverseMass<S = f64> {
    /// 1/d₀ and 1/d₁; 0 for a condensed group.
    pub translation: [S; 2],
    /// 1/d₂.
    pub along: S,
    /// e.
    pub direction: [S; 3],
    /// 1/d₀ of a condensed group, otherwise 0. Pivots are compared with the diagonal of S without condensation,
    /// because the contribution of a condensed group to S may vanish.
    pub held: S,
}

impl<S: Real> InverseMass<S> {
    /// The inverse of a diagonal block, from the inverses of its entries. Missing entries of a smaller group must be
    /// 1.
    #[inline(always)]
    pub fn diagonal([d0, d1, d2]: [S; 3]) -> Self {
        let zero = S::zero();
        let direction = [zero, zero, S::one()];
        Self { translation: [d0, d1], along: d2, direction, held: zero }
    }

    /// W⁻¹ f.
    #[inline(always)]
    pub(super) fn times(&self, f: &[S; 3]) -> [S; 3] {
        let ([d0, d1], [e0, e1, e2]) = (self.translation, self.direction);
        let s = self.along * dot(&self.direction, f);
        [(f[0] * d0).plus_product(e0, s), (f[1] * d1).plus_product(e1, s), e2 * s]
    }
}

/// Checks that every pivot of W is positive and finite, in every lane. For groups that are not `free`, only the pivot
/// along e is checked.
#[inline(always)]
pub(super) fn check<S: Real>(
    masses: &[InverseMass<S>],
    free: &[u32],
    starts: &[u32],
) -> Result<(), Breakdown> {
    let moves = |k: &u32| masses[*k as usize].translation.iter().all(|i| is_usable(*i));
    if masses.iter().all(|mass| is_usable(mass.along)) && free.iter().all(moves) {
        return Ok(());
    }
    let turned = masses.iter().position(|mass| !is_usable(mass.along));
    let turned = turned.map(|group| starts[group] as usize + 2);
    let moved = free.iter().find(|k| !moves(k)).map(|k| {
        let first = usize::from(is_usable(masses[*k as usize].translation[0]));
        starts[*k as usize] as usize + first
    });
    let bad = turned.into_iter().chain(moved).min();
    bad.map_or(Ok(()), |column| Err(Breakdown::Column(column)))
}

/// Whether the inverse of a pivot is positive and finite, in every lane.
#[inline(always)]
pub(super) fn is_usable<S: Real>(inverse: S) -> bool {
    above_zero(inverse) && above_zero(S::constant(f64::MAX) - inverse)
}

/// Whether x > 0 in every lane. False for NaN.
#[inline(always)]
pub(super) fn above_zero<S: Real>(x: S) -> bool {
    S::select(x, S::one(), S::zero()).least_magnitude() > 0.0
}

/// aᵀ b.
#[inline(always)]
pub(super) fn dot<S: Real>(a: &[S; 3], b: &[S; 3]) -> S {
    (a[0] * b[0]).plus_product(a[1], b[1]).plus_product(a[2], b[2])
}

/// Indices of the groups with a diagonal block of W, of those with a coupled block, and of all groups that are not
/// `condensed`. The first two exclude condensed groups as well.
pub(super) fn kinds(groups: &[Group], condensed: &[bool]) -> [Vec<u32>; 3] {
    let numbers = || (0..).zip(groups.iter().zip(condensed));
    let select = |which: &dyn Fn(&Group) -> bool| {
        let free = numbers().filter(|(_, (group, condensed))| !**condensed && which(group));
        free.map(|(k, _)| k).list()
    };
    [select(&|group| !group.coupled), select(&|group| group.coupled), select(&|_| true)]
}
