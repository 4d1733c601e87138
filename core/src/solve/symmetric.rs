//! Dense symmetric matrices: eigenvalues, eigenvectors, and a test of positive definiteness.
//!
//! Cyclic Jacobi rotations (Golub and Van Loan, *Matrix Computations*, 4th ed., 8.5) compute small eigenvalues
//! accurately even if others are large. For matrices of many rows they are slow; three diagonals are faster.

use super::rank::dot;
use super::tridiagonal::by_tridiagonal;
use crate::math::{Listed, Ordered};
/// Number of rows above which a matrix is reduced to three diagonals.
const MANY: usize = 40;
/// Largest number of sweeps; five to ten are usual.
const SWEEPS: usize = 60;

/// Eigenvalues and orthonormal eigenvectors of a symmetric matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct Eigen {
    /// The eigenvalues, ascending.
    pub values: Vec<f64>,
    /// The eigenvector of each eigenvalue.
    pub vectors: Vec<Vec<f64>>,
}

impl Eigen {
    /// Eigenvalues and eigenvectors of the symmetric part of a row-major matrix of shape (n, n).
    pub fn of(matrix: &[f64], n: usize) -> Self {
        assert_eq!(matrix.len(), n * n, "a square matrix");
        let mut a: Vec<f64> =
            (0..n * n).map(|k| 0.5 * (matrix[k] + matrix[(k % n) * n + k / n])).list();
        if n > MANY {
            let (values, vectors) = by_tridiagonal(a, n);
            return Self::ascending(&values, vectors);
        }
        let mut vectors: Vec<Vec<f64>> =
            (0..n).map(|k| (0..n).map(|j| f64::from(u8::from(j == k))).list()).list();
        for _ in 0..SWEEPS {
            let mut rotated = false;
            for p in 0..n {
                for q in p + 1..n {
                    rotated |= rotate(&mut a, n, (p, q), &mut vectors);
                }
            }
            if !rotated {
                break;
            }
        }
        let values: Vec<f64> = (0..n).map(|k| a[k * n + k]).list();
        Self::ascending(&values, vectors)
    }

    fn ascending(values: &[f64], mut vectors: Vec<Vec<f64>>) -> Self {
        let mut order: Vec<usize> = (0..values.len()).list();
        order.order_by(|i, j| values[*i].total_cmp(&values[*j]));
        Self {
            values: order.iter().map(|k| values[*k]).list(),
            vectors: order.iter().map(|k| std::mem::take(&mut vectors[*k])).list(),
        }
    }
}

/// Makes the entry (p, q) zero by a rotation, unless it is negligible compared with the diagonal. Returns whether it
/// rotated.
fn rotate(a: &mut [f64], n: usize, (p, q): (usize, usize), vectors: &mut [Vec<f64>]) -> bool {
    let [app, aqq, apq] = [a[p * n + p], a[q * n + q], a[p * n + q]];
    if apq == 0.0 || apq.abs() <= 0.1 * f64::EPSILON * (app.abs() * aqq.abs()).sqrt() {
        return false;
    }
    let theta = (aqq - app) / (2.0 * apq);
    let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
    let c = 1.0 / t.hypot(1.0);
    let s = t * c;
    if !s.is_finite() || s == 0.0 {
        return false;
    }
    for k in 0..n {
        let (x, y) = (a[k * n + p], a[k * n + q]);
        (a[k * n + p], a[k * n + q]) = (c * x - s * y, s * x + c * y);
    }
    for k in 0..n {
        let (x, y) = (a[p * n + k], a[q * n + k]);
        (a[p * n + k], a[q * n + k]) = (c * x - s * y, s * x + c * y);
    }
    (a[p * n + q], a[q * n + p]) = (0.0, 0.0);
    let (before, from_q) = vectors.split_at_mut(q);
    for (x, y) in before[p].iter_mut().zip(&mut from_q[0]) {
        (*x, *y) = (c * *x - s * *y, s * *x + c * *y);
    }
    true
}

/// Whether a symmetric matrix of shape (n, n) is positive definite, so that its Cholesky factorisation succeeds.
pub fn is_positive(matrix: &[f64], n: usize) -> bool {
    let mut l = matrix.to_vec();
    for k in 0..n {
        let own = l[k * n..k * n + k].to_vec();
        let pivot = l[k * n + k] - dot(&own, &own);
        if pivot.is_nan() || pivot <= 1e-13 * matrix[k * n + k].abs() {
            return false;
        }
        let root = pivot.sqrt();
        l[k * n + k] = root;
        for i in k + 1..n {
            l[i * n + k] = (l[i * n + k] - dot(&own, &l[i * n..i * n + k])) / root;
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The matrix of second differences has the eigenvalues 2 - 2 cos(k π / (n + 1)).
    #[test]
    fn second_differences() {
        [12, MANY + 20].into_iter().for_each(compare);
    }

    fn compare(n: usize) {
        let entry = |k: usize| match (k / n).abs_diff(k % n) {
            0 => 2.0,
            1 => -1.0,
            _ => 0.0,
        };
        let matrix: Vec<f64> = (0..n * n).map(entry).collect();
        let Eigen { values, vectors } = Eigen::of(&matrix, n);
        for (k, value) in values.iter().enumerate() {
            let angle = (k + 1) as f64 * std::f64::consts::PI / (n + 1) as f64;
            assert!((value - (2.0 - 2.0 * angle.cos())).abs() < 3e-14, "{k}: {value}");
            let x = &vectors[k];
            for row in 0..n {
                let product: f64 = (0..n).map(|j| matrix[row * n + j] * x[j]).sum();
                assert!((product - value * x[row]).abs() < 3e-14, "{k}, {row}");
            }
        }
        assert!(is_positive(&matrix, n));
    }

    #[test]
    fn an_indefinite_matrix_is_not_positive() {
        let matrix = [1.0, 2.0, 2.0, 1.0];
        assert!(!is_positive(&matrix, 2));
        let values = Eigen::of(&matrix, 2).values;
        assert!((values[0] + 1.0).abs() < 1e-15 && (values[1] - 3.0).abs() < 1e-15, "{values:?}");
    }

    #[test]
    fn a_singular_matrix_is_not_positive() {
        assert!(!is_positive(&[1.0, 1.0, 1.0, 1.0], 2));
    }
}
