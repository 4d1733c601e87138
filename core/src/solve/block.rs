//! Arithmetic of blocks of at most 3 × 3 in registers. The sizes are constants, so that loops are unrolled.
//!
//! A block of U is stored by rows of three numbers. A block of L below the diagonal is stored by columns, without
//! gaps, as L D. Products with few rows are then sums of whole rows, and numbers are read in the same pairs in which
//! they were written. (A vector load that spans two recent scalar stores cannot be forwarded and stalls.) Loops over
//! indices need no function of the standard library, which is not inlined without optimisation across crates.

#![allow(clippy::needless_range_loop)]

use super::mass_block::dot;
use crate::math::{each, indexed, Real};

/// `N` items from `first`, with a single bounds check.
#[inline(always)]
pub(super) fn part<T, const N: usize>(x: &[T], first: u32) -> &[T; N] {
    let first = first as usize;
    x[first..first + N].first_chunk().expect("as long as the range")
}

/// `N` mutable items from `first`, with a single bounds check.
#[inline(always)]
pub(super) fn part_mut<T, const N: usize>(x: &mut [T], first: u32) -> &mut [T; N] {
    let first = first as usize;
    x[first..first + N].first_chunk_mut().expect("as long as the range")
}

/// A row a of A in one group, transformed by W⁻¹ = diag(d₀⁻¹, d₁⁻¹, 0) + d₂⁻¹ e eᵀ of the group.
#[derive(Clone, Copy, Debug)]
pub(super) struct TransformedRow<S> {
    /// a₀, a₁ and aᵀ e.
    pub plain: [S; 3],
    /// The same components times d₀⁻¹, d₁⁻¹ and d₂⁻¹.
    pub scaled: [S; 3],
}

/// y += A x, with A given by rows.
#[inline(always)]
pub(super) fn add_times<S: Real, const N: usize>(rows: &[[S; 3]; N], x: &[S; 3], y: &mut [S; N]) {
    for i in 0..N {
        let a = &rows[i];
        y[i] = y[i].plus_product(a[0], x[0]).plus_product(a[1], x[1]).plus_product(a[2], x[2]);
    }
}

/// target += A W⁻¹ Bᵀ.
#[inline(always)]
pub(super) fn add<S: Real, const M: usize, const N: usize>(
    target: &mut [[S; N]; M],
    a: &[TransformedRow<S>; M],
    b: &[TransformedRow<S>; N],
) {
    for i in 0..M {
        for j in 0..N {
            target[i][j] += dot(&a[i].plain, &b[j].scaled);
        }
    }
}

/// The `K` columns, of `M` numbers each, of a block that begins at index `first`.
#[inline(always)]
pub(super) fn columns<S: Real, const M: usize, const K: usize>(x: &[S], first: u32) -> [[S; M]; K] {
    let x = &x[first as usize..first as usize + M * K];
    indexed(|k| indexed(|i| x[k * M + i]))
}

/// Stores the columns of a block.
#[inline(always)]
pub(super) fn store<S: Real, const M: usize, const K: usize>(
    x: &mut [S],
    first: u32,
    columns: &[[S; M]; K],
) {
    let x = &mut x[first as usize..first as usize + M * K];
    for k in 0..K {
        for i in 0..M {
            x[k * M + i] = columns[k][i];
        }
    }
}

/// A D⁻¹, with A given by columns.
#[inline(always)]
pub(super) fn scaled<S: Real, const M: usize, const K: usize>(
    a: &[[S; M]; K],
    inverse: &[S; K],
) -> [[S; M]; K] {
    indexed(|k| each(a[k], |a| a * inverse[k]))
}

/// target -= A Bᵀ, with A and B given by their `K` columns.
#[inline(always)]
pub(super) fn subtract<S: Real, const M: usize, const N: usize, const K: usize>(
    target: &mut [[S; N]; M],
    a: &[[S; M]; K],
    b: &[[S; N]; K],
) {
    for k in 0..K {
        for i in 0..M {
            for j in 0..N {
                target[i][j] = target[i][j].minus_product(a[k][i], b[k][j]);
            }
        }
    }
}

/// y -= A x, with A given by its `K` columns.
#[inline(always)]
pub(super) fn subtract_times<S: Real, const M: usize, const K: usize>(
    y: &mut [S; M],
    a: &[[S; M]; K],
    x: &[S; K],
) {
    for k in 0..K {
        for i in 0..M {
            y[i] = y[i].minus_product(a[k][i], x[k]);
        }
    }
}

/// y -= Aᵀ x, with A given by columns.
#[inline(always)]
pub(super) fn subtract_products<S: Real, const M: usize, const N: usize>(
    y: &mut [S; N],
    a: &[[S; M]; N],
    x: &[S; M],
) {
    for i in 0..N {
        for k in 0..M {
            y[i] = y[i].minus_product(a[i][k], x[k]);
        }
    }
}

/// y += Aᵀ x, with A given by rows.
#[inline]
pub(super) fn add_transposed<S: Real>(rows: &[[S; 3]], x: &[S], y: &mut [S; 3]) {
    for (a, x) in rows.iter().zip(x) {
        for c in 0..3 {
            y[c] = y[c].plus_product(a[c], *x);
        }
    }
}

/// x -= W⁻¹ Aᵀ λ, with A given by rows and e of the group.
#[inline(always)]
pub(super) fn subtract_transposed<S: Real, const N: usize>(
    rows: &[TransformedRow<S>; N],
    e: &[S; 3],
    lambda: &[S; N],
    x: &mut [S; 3],
) {
    let mut along = S::zero();
    for k in 0..N {
        let scaled = &rows[k].scaled;
        x[0] = x[0].minus_product(scaled[0], lambda[k]);
        x[1] = x[1].minus_product(scaled[1], lambda[k]);
        along = along.plus_product(scaled[2], lambda[k]);
    }
    for i in 0..3 {
        x[i] = x[i].minus_product(e[i], along);
    }
}

/// A diagonal block of S before elimination. Only its lower triangle is summed.
#[derive(Clone, Copy, Debug)]
pub(super) struct DiagonalBlock<S, const N: usize> {
    pub s: [[S; N]; N],
    /// The sums with which the pivots are compared.
    pub magnitude: [S; N],
}

impl<S: Real, const N: usize> DiagonalBlock<S, N> {
    #[inline(always)]
    pub fn read(x: &[S], first: u32) -> Self {
        let x = &x[first as usize..first as usize + numbers(N)];
        let mut s = [[S::zero(); N]; N];
        for i in 0..N {
            for j in 0..i {
                s[i][j] = x[2 * N + i * (i - 1) / 2 + j];
            }
            s[i][i] = x[i];
        }
        Self { s, magnitude: indexed(|i| x[N + i]) }
    }

    #[inline(always)]
    pub fn store(&self, x: &mut [S], first: u32) {
        let diagonal = indexed(|i| self.s[i][i]);
        store_triangle(x, first, [&diagonal, &self.magnitude], &self.s);
    }
}

/// Stores a diagonal block or its factor in the order described at [`numbers`].
#[inline(always)]
fn store_triangle<S: Real, const N: usize>(
    x: &mut [S],
    first: u32,
    [diagonal, magnitude]: [&[S; N]; 2],
    lower: &[[S; N]; N],
) {
    let x = &mut x[first as usize..first as usize + numbers(N)];
    for i in 0..N {
        (x[i], x[N + i]) = (diagonal[i], magnitude[i]);
    }
    for i in 1..N {
        for j in 0..i {
            x[2 * N + i * (i - 1) / 2 + j] = lower[i][j];
        }
    }
}

/// L and D⁻¹ of a diagonal block: the unit lower triangle without its diagonal, and the pivots.
#[derive(Clone, Copy, Debug)]
pub(super) struct DiagonalFactor<S, const N: usize> {
    pub lower: [[S; N]; N],
    pub pivot: [S; N],
    pub inverse: [S; N],
}

/// L D Lᵀ of a diagonal block. Only the lower triangle is read.
#[inline(always)]
pub(super) fn factorise<S: Real, const N: usize>(mut s: [[S; N]; N]) -> DiagonalFactor<S, N> {
    let (mut pivot, mut inverse) = ([S::zero(); N], [S::zero(); N]);
    if N == 2 {
        // from the determinant, so that the second division need not wait for the first
        let det = (s[0][0] * s[1][1]).minus_product(s[1][0], s[1][0]);
        let (first, second) = (S::one() / s[0][0], S::one() / det);
        (pivot[0], pivot[1]) = (s[0][0], det * first);
        (inverse[0], inverse[1]) = (first, s[0][0] * second);
        s[1][0] = s[1][0] * first;
        return DiagonalFactor { lower: s, pivot, inverse };
    }
    for j in 0..N {
        pivot[j] = s[j][j];
        inverse[j] = S::one() / pivot[j];
        for i in j + 1..N {
            let l = s[i][j] * inverse[j];
            for c in j + 1..i {
                s[i][c] = s[i][c].minus_product(s[i][j], s[c][j]); // s[c][j] is already scaled
            }
            s[i][i] = s[i][i].minus_product(s[i][j], l);
            s[i][j] = l;
        }
    }
    DiagonalFactor { lower: s, pivot, inverse }
}

impl<S: Real, const N: usize> DiagonalFactor<S, N> {
    /// x ← L⁻¹ x.
    #[inline(always)]
    pub fn forward(&self, x: &mut [S; N]) {
        for i in 1..N {
            for j in 0..i {
                x[i] = x[i].minus_product(self.lower[i][j], x[j]);
            }
        }
    }

    /// y ← L⁻ᵀ D⁻¹ y.
    #[inline(always)]
    pub fn back(&self, y: &mut [S; N]) {
        if N == 2 {
            // as in `backward`
            let last = y[1] * self.inverse[1];
            (y[0], y[1]) = (y[0] * self.inverse[0], last);
            let l = [self.lower[1][0], S::zero()];
            for i in 0..N {
                y[i] = y[i].minus_product(l[i], last);
            }
            return;
        }
        for j in (0..N).rev() {
            y[j] = y[j] * self.inverse[j];
            for i in j + 1..N {
                y[j] = y[j].minus_product(self.lower[i][j], y[i]);
            }
        }
    }

    /// Stores D⁻¹ and L, with the sums with which the pivots were compared.
    #[inline(always)]
    pub fn store(&self, x: &mut [S], first: u32, magnitude: &[S; N]) {
        store_triangle(x, first, [&self.inverse, magnitude], &self.lower);
    }
}

/// Number of values stored for a diagonal block of `n` rows: the n diagonal entries, later D⁻¹; the n sums with which
/// the pivots are compared; and the entries left of the diagonal of S, later of L, row by row.
#[inline]
pub(super) fn numbers(n: usize) -> usize {
    2 * n + n * (n - 1) / 2
}

/// y ← L⁻¹ y, for one or more right sides.
#[inline(always)]
pub(super) fn forward<S: Real, const M: usize, const N: usize>(
    x: &[S],
    first: u32,
    y: &mut [[S; M]; N],
) {
    let l = &x[first as usize..first as usize + numbers(N)][2 * N..];
    for i in 1..N {
        for j in 0..i {
            let known = y[j];
            for c in 0..M {
                y[i][c] = y[i][c].minus_product(l[i * (i - 1) / 2 + j], known[c]);
            }
        }
    }
}

/// y ← L⁻ᵀ y.
#[inline(always)]
pub(super) fn backward<S: Real, const N: usize>(x: &[S], first: u32, y: &mut [S; N]) {
    let l = &x[first as usize..first as usize + numbers(N)][2 * N..];
    if N == 2 {
        // both numbers by the same operations, so that they are written as a pair; they are read as one
        let (l, last) = ([l[0], S::zero()], y[1]);
        for i in 0..N {
            y[i] -= l[i] * last;
        }
        return;
    }
    for j in (0..N).rev() {
        for i in j + 1..N {
            y[j] -= l[i * (i - 1) / 2 + j] * y[i];
        }
    }
}
