//! Eigenvalues and eigenvectors of a large symmetric matrix: reflections to three diagonals, then implicit QL steps
//! (Golub and Van Loan, *Matrix Computations*, 4th ed., 8.3). The errors are rounding errors of the largest eigenvalue.

use super::rank::dot;
use crate::math::Listed;

/// Largest number of steps for one eigenvalue; two are usual.
const STEPS: usize = 60;

/// The eigenvalues of the symmetric row-major matrix `a` of shape (n, n), and the eigenvector of each of them.
pub(super) fn by_tridiagonal(mut a: Vec<f64>, n: usize) -> (Vec<f64>, Vec<Vec<f64>>) {
    let reflections = (0..n.saturating_sub(2)).map(|k| reflect(&mut a, n, k)).list();
    let mut diagonal = (0..n).map(|k| a[k * n + k]).list();
    let mut beside = (0..n).map(|k| if k + 1 < n { a[(k + 1) * n + k] } else { 0.0 }).list();
    let mut vectors: Vec<Vec<f64>> =
        (0..n).map(|k| (0..n).map(|j| f64::from(u8::from(j == k))).list()).list();
    for x in &mut vectors {
        for (k, v) in reflections.iter().enumerate().rev() {
            let part = 2.0 * dot(v, &x[k + 1..]);
            x[k + 1..].iter_mut().zip(v).for_each(|(x, v)| *x -= part * v);
        }
    }
    for first in 0..n {
        for _ in 0..STEPS {
            let Some(last) = block(&diagonal, &mut beside, first) else { break };
            step(&mut diagonal, &mut beside, (first, last), &mut vectors);
        }
    }
    (diagonal, vectors)
}

/// Makes the entries of column `k` below the subdiagonal zero, by a reflection of the rows and columns after `k`.
/// Returns its unit vector.
fn reflect(a: &mut [f64], n: usize, k: usize) -> Vec<f64> {
    let mut v: Vec<f64> = (k + 1..n).map(|i| a[i * n + k]).list();
    let length = dot(&v, &v).sqrt();
    if length == 0.0 {
        return v;
    }
    let below = -length.copysign(v[0]);
    v[0] -= below;
    let size = dot(&v, &v).sqrt();
    v.iter_mut().for_each(|x| *x /= size);
    let rows = || (k + 1..n).map(|i| i * n + k + 1..(i + 1) * n);
    let product: Vec<f64> = rows().map(|row| dot(&a[row], &v)).list();
    let along = dot(&product, &v);
    let w: Vec<f64> = product.iter().zip(&v).map(|(p, v)| 2.0 * (p - along * v)).list();
    for (i, row) in rows().enumerate() {
        for ((x, v_j), w_j) in a[row].iter_mut().zip(&v).zip(&w) {
            *x -= v[i] * w_j + w[i] * v_j;
        }
    }
    a[(k + 1) * n + k] = below;
    v
}

/// The last row of the block from `first` that no negligible entry divides; None for a single row.
fn block(diagonal: &[f64], beside: &mut [f64], first: usize) -> Option<usize> {
    for k in first..diagonal.len() {
        let size = diagonal[k].abs() + diagonal.get(k + 1).map_or(0.0, |x| x.abs());
        if beside[k].abs() <= f64::EPSILON * size {
            beside[k] = 0.0;
        }
        if beside[k] == 0.0 {
            return (k > first).then_some(k);
        }
    }
    None
}

/// One QL step with Wilkinson's shift in the block from `first` to `last`.
fn step(
    diagonal: &mut [f64],
    beside: &mut [f64],
    (first, last): (usize, usize),
    vectors: &mut [Vec<f64>],
) {
    let half = (diagonal[first + 1] - diagonal[first]) / (2.0 * beside[first]);
    let shift = diagonal[first] - beside[first] / (half + half.hypot(1.0).copysign(half));
    let mut g = diagonal[last] - shift;
    let (mut s, mut c, mut p) = (1.0, 1.0, 0.0);
    for i in (first..last).rev() {
        let (f, b) = (s * beside[i], c * beside[i]);
        let r = f.hypot(g);
        beside[i + 1] = r;
        if r == 0.0 {
            diagonal[i + 1] -= p;
            beside[last] = 0.0;
            return;
        }
        (s, c) = (f / r, g / r);
        g = diagonal[i + 1] - p;
        let change = (diagonal[i] - g) * s + 2.0 * c * b;
        p = s * change;
        diagonal[i + 1] = g + p;
        g = c * change - b;
        let (low, high) = vectors.split_at_mut(i + 1);
        for (x, y) in low[i].iter_mut().zip(&mut high[0]) {
            (*x, *y) = (c * *x - s * *y, s * *x + c * *y);
        }
    }
    diagonal[first] -= p;
    beside[first] = g;
    beside[last] = 0.0;
}
