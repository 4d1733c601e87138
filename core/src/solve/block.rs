//! Arithmetic of blocks of at most 3 × 3, in registers: sizes are constants, so loops unroll.
//!
//! A block is stored as rows of three, of which it may use fewer.

use crate::math::Real;

/// `M` rows of the store, from row `first`: one bounds check.
#[inline(always)]
pub(super) fn rows<S, const M: usize>(store: &[[S; 3]], first: u32) -> &[[S; 3]; M] {
    store[first as usize..].first_chunk().expect("the plan fits the store")
}

/// `N` numbers from `first`.
#[inline(always)]
pub(super) fn part<S, const N: usize>(x: &[S], first: u32) -> &[S; N] {
    x[first as usize..].first_chunk().expect("the plan fits the vector")
}

/// The same, to be changed.
#[inline(always)]
pub(super) fn part_mut<S, const N: usize>(x: &mut [S], first: u32) -> &mut [S; N] {
    x[first as usize..].first_chunk_mut().expect("the plan fits the vector")
}

/// Splits `count` off the front.
#[inline(always)]
pub(super) fn take<'a, T>(rest: &mut &'a [T], count: u32) -> &'a [T] {
    let (front, back) = rest.split_at(count as usize);
    *rest = back;
    front
}

/// Splits `count` off the back.
#[inline(always)]
pub(super) fn take_back<'a, T>(rest: &mut &'a [T], count: u32) -> &'a [T] {
    let (front, back) = rest.split_at(rest.len() - count as usize);
    *rest = front;
    back
}

/// aᵀ b over the first `K` components.
#[inline(always)]
fn dot<S: Real, const K: usize>(a: &[S; 3], b: &[S; 3]) -> S {
    let mut sum = a[0] * b[0];
    for k in 1..K {
        sum += a[k] * b[k];
    }
    sum
}

/// target += A Bᵀ over `K` columns.
#[inline(always)]
pub(super) fn add<S: Real, const M: usize, const N: usize, const K: usize>(
    target: &mut [[S; N]; M],
    a: &[[S; 3]; M],
    b: &[[S; 3]; N],
) {
    for (target, a) in target.iter_mut().zip(a) {
        for (target, b) in target.iter_mut().zip(b) {
            *target += dot::<S, K>(a, b);
        }
    }
}

/// target -= A Bᵀ over `K` columns.
#[inline(always)]
pub(super) fn subtract<S: Real, const M: usize, const N: usize, const K: usize>(
    target: &mut [[S; N]; M],
    a: &[[S; 3]; M],
    b: &[[S; 3]; N],
) {
    for (target, a) in target.iter_mut().zip(a) {
        for (target, b) in target.iter_mut().zip(b) {
            *target -= dot::<S, K>(a, b);
        }
    }
}

/// y -= A x over `K` columns.
#[inline(always)]
pub(super) fn subtract_times<S: Real, const M: usize, const K: usize>(
    y: &mut [S; M],
    a: &[[S; 3]; M],
    x: &[S; K],
) {
    for (y, a) in y.iter_mut().zip(a) {
        for k in 0..K {
            *y -= a[k] * x[k];
        }
    }
}

/// y -= Aᵀ x for the first `N` columns.
#[inline(always)]
pub(super) fn subtract_transposed<S: Real, const M: usize, const N: usize>(
    y: &mut [S; N],
    a: &[[S; 3]; M],
    x: &[S; M],
) {
    for (a, x) in a.iter().zip(x) {
        for c in 0..N {
            y[c] -= a[c] * *x;
        }
    }
}

/// L and 1 / D of a diagonal block: unit lower triangle without its diagonal, and the pivots.
#[derive(Clone, Copy, Debug)]
pub(super) struct Diagonal<S, const N: usize> {
    pub lower: [[S; N]; N],
    pub pivot: [S; N],
    pub inverse: [S; N],
}

/// L D Lᵀ of a diagonal block, of which the lower triangle is read.
#[inline(always)]
pub(super) fn factorise<S: Real, const N: usize>(mut s: [[S; N]; N]) -> Diagonal<S, N> {
    let (mut pivot, mut inverse) = ([S::zero(); N], [S::zero(); N]);
    for j in 0..N {
        pivot[j] = s[j][j];
        inverse[j] = S::one() / pivot[j];
        for i in j + 1..N {
            let l = s[i][j] * inverse[j];
            for c in j + 1..i {
                s[i][c] -= s[i][j] * s[c][j]; // s[c][j] is scaled already
            }
            s[i][i] -= s[i][j] * l;
            s[i][j] = l;
        }
    }
    Diagonal { lower: s, pivot, inverse }
}

impl<S: Real, const N: usize> Diagonal<S, N> {
    /// x ← L⁻¹ x.
    #[inline(always)]
    pub fn forward(&self, x: &mut [S; N]) {
        for i in 1..N {
            for j in 0..i {
                x[i] -= self.lower[i][j] * x[j];
            }
        }
    }
}

/// x ← L⁻ᵀ x with the triangle in stored rows.
#[inline(always)]
pub(super) fn backward<S: Real, const N: usize>(lower: &[[S; 3]; N], x: &mut [S; N]) {
    for j in (0..N).rev() {
        for i in j + 1..N {
            x[j] -= lower[i][j] * x[i];
        }
    }
}
