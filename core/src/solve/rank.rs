//! Numerical rank of a dense matrix, its independent rows and its left null vectors.
//!
//! Householder QR factorisation with row pivoting, Aᵀ P = Q R (Golub and Van Loan, *Matrix Computations*, 4th ed.,
//! 5.4.2), with one change. Of the rows that are long enough it chooses the *earliest* instead of the longest, so
//! that the later of two redundant joints is reported as dependent. A vector y with yᵀ A = 0 is then P [-R₁₁⁻¹ R₁₂;
//! 1], orthonormalised. Its nonzero components are the rows that take part in the dependence.
//!
//! Rows should have comparable length ([`normalize_rows`]). The cost is O(m n rank).

use crate::math::Listed;
/// Relative tolerance for rows of length 1 whose entries contain only rounding errors.
pub const RANK_TOLERANCE: f64 = 1e-9;

/// Smallest remainder, as a fraction of the largest, with which a row is chosen before longer rows.
const LONG_ENOUGH: f64 = 0.1;

/// Dependence of the rows of a matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct Rank {
    /// Numerical rank.
    pub rank: usize,
    /// Independent rows, in the order in which they were chosen; length rank.
    pub independent: Vec<usize>,
    /// The other rows, ascending.
    pub dependent: Vec<usize>,
    /// Orthonormal basis of the left null space, (m - rank) vectors of length m. Of the dependent rows, the k-th
    /// vector contains `dependent[k]` and possibly earlier ones.
    pub left_null: Vec<Vec<f64>>,
    /// |r_kk|: the remainder of each independent row when it was chosen. The values are of the order of the singular
    /// values, but not sorted.
    pub kept: Vec<f64>,
    /// Remainder of the largest dependent row; 0 without dependent rows.
    pub dropped: f64,
}

impl Rank {
    /// The smallest kept remainder divided by the largest dropped one. It is large if the rank is beyond doubt
    /// (infinite for full rank or exact dependence), and near 1 if the tolerance decided it.
    #[inline]
    pub fn gap(&self) -> f64 {
        let least = self.kept.iter().copied().fold(f64::INFINITY, f64::min);
        least / self.dropped
    }
}

/// Divides each row of the row-major `matrix` with `columns` columns by its Euclidean length. A row of zeros is not
/// changed. Returns the lengths.
///
/// # Panics
/// If the matrix does not have a whole number of rows.
pub fn normalize_rows(matrix: &mut [f64], columns: usize) -> Vec<f64> {
    count_rows(matrix, columns);
    let rows = matrix.chunks_exact_mut(columns.max(1));
    rows.map(|row| {
        let length = length(row);
        if length > 0.0 {
            row.iter_mut().for_each(|a| *a /= length);
        }
        length
    })
    .list()
}

/// Rank of the row-major `matrix` with `columns` columns. A row is dependent if its remainder is at most `tolerance`
/// times the length of the longest row (default: [`RANK_TOLERANCE`]).
///
/// # Panics
/// If the matrix does not have a whole number of rows, or an entry is not finite.
pub fn rank(matrix: &[f64], columns: usize, tolerance: f64) -> Rank {
    assert!(matrix.iter().all(|a| a.is_finite()), "a finite matrix");
    let m = count_rows(matrix, columns);
    let mut rows: Vec<Vec<f64>> = matrix.chunks_exact(columns.max(1)).map(<[f64]>::to_vec).list();
    let bound = tolerance * rows.iter().map(|row| length(row)).fold(0.0, f64::max);
    let mut left: Vec<usize> = (0..m).list();
    let (mut independent, mut kept, mut dropped) = (vec![], vec![], 0.0);
    while !left.is_empty() {
        let k = independent.len();
        let remainder: Vec<f64> = left.iter().map(|&i| length(&rows[i][k..])).list();
        let largest = remainder.iter().copied().fold(0.0, f64::max);
        if largest <= bound {
            dropped = largest;
            break;
        }
        let at = remainder.iter().position(|&r| r >= LONG_ENOUGH * largest).unwrap_or(0);
        let pivot = left.remove(at);
        reflect(&mut rows, pivot, &left, k);
        kept.push(rows[pivot][k].abs());
        independent.push(pivot);
    }
    let left_null = left_null(&rows, &independent, &left);
    Rank { rank: independent.len(), independent, dependent: left, left_null, kept, dropped }
}

fn count_rows(matrix: &[f64], columns: usize) -> usize {
    if columns == 0 {
        assert!(matrix.is_empty(), "no entries without columns");
        return 0;
    }
    assert_eq!(matrix.len() % columns, 0, "whole rows");
    matrix.len() / columns
}

/// Euclidean length, without overflow or underflow.
fn length(x: &[f64]) -> f64 {
    let square = dot(x, x);
    if (1e-280..1e280).contains(&square) {
        return square.sqrt();
    }
    let largest = x.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    if largest == 0.0 {
        return 0.0;
    }
    largest * x.iter().map(|v| (v / largest) * (v / largest)).sum::<f64>().sqrt()
}

/// Applies to the rows `left` the reflection that makes all components of row `pivot` after the k-th zero.
fn reflect(rows: &mut [Vec<f64>], pivot: usize, left: &[usize], k: usize) {
    let mut v = rows[pivot][k..].to_vec();
    let beta = -length(&v).copysign(v[0]);
    v[0] -= beta;
    let scale = length(&v);
    v.iter_mut().for_each(|a| *a /= scale);
    for &i in left {
        let tail = &mut rows[i][k..];
        let twice = 2.0 * dot(tail, &v);
        tail.iter_mut().zip(&v).for_each(|(a, v)| *a -= twice * v);
    }
    rows[pivot][k..].fill(0.0);
    rows[pivot][k] = beta;
}

/// The scalar product, as four sums that are computed in parallel.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (fours, others) = (a.chunks_exact(4), b.chunks_exact(4));
    let last = fours.remainder().iter().zip(others.remainder()).map(|(a, b)| a * b).sum::<f64>();
    let mut sums = [0.0; 4];
    for (a, b) in fours.zip(others) {
        for k in 0..4 {
            sums[k] += a[k] * b[k];
        }
    }
    sums.iter().sum::<f64>() + last
}

/// For each dependent row d, the y with y_d = 1 that satisfies R₁₁ y = -r_d over the independent rows. Gram–Schmidt
/// follows, twice for orthogonality to rounding.
fn left_null(rows: &[Vec<f64>], independent: &[usize], dependent: &[usize]) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::with_capacity(dependent.len());
    for &d in dependent {
        let mut y = vec![0.0; rows.len()];
        y[d] = 1.0;
        for k in (0..independent.len()).rev() {
            // row k of R₁₁ consists of component k of the independent rows from the k-th on
            let later: f64 = independent[k + 1..].iter().map(|&i| rows[i][k] * y[i]).sum();
            let i = independent[k];
            y[i] = -(rows[d][k] + later) / rows[i][k];
        }
        for _ in 0..2 {
            for earlier in &basis {
                let part = dot(&y, earlier);
                y.iter_mut().zip(earlier).for_each(|(y, e)| *y -= part * e);
            }
            let size = length(&y);
            y.iter_mut().for_each(|y| *y /= size);
        }
        basis.push(y);
    }
    basis
}
