//! Null vectors of a dense matrix whose rank is known, by elimination with full pivoting.

use crate::math::{Complex, Field, Listed};

/// Vectors x with A x = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct NullSpace {
    /// A basis: each vector has one at a column of its own where the others have zero.
    pub vectors: Vec<Vec<Complex>>,
    /// The smallest pivot, and the largest magnitude that is left of A; the latter is zero for the given rank.
    pub pivots: [f64; 2],
}

/// The null space of dimension `count` of a matrix, given row by row. The rows and columns should have
/// magnitudes of the same order.
pub fn null_space(a: &[Complex], columns: usize, count: usize) -> NullSpace {
    let mut a = a.to_vec();
    let rows = a.len() / columns.max(1);
    let rank = columns - count;
    let mut order: Vec<usize> = (0..columns).list();
    let mut least = f64::INFINITY;
    let largest = |a: &[Complex], order: &[usize], done: usize| {
        let mut best = (done, done, 0.0_f64);
        for row in done..rows {
            for (place, at) in order.iter().enumerate().skip(done) {
                let size = a[row * columns + at].magnitude();
                if size > best.2 {
                    best = (row, place, size);
                }
            }
        }
        best
    };
    for done in 0..rank.min(rows) {
        let (row, place, size) = largest(&a, &order, done);
        least = least.min(size);
        (0..columns).for_each(|k| a.swap(row * columns + k, done * columns + k));
        order.swap(place, done);
        let inverse = a[done * columns + order[done]].reciprocal();
        for below in done + 1..rows {
            let factor = a[below * columns + order[done]] * inverse;
            for at in &order[done..] {
                let part = factor * a[done * columns + at];
                a[below * columns + at] -= part;
            }
        }
    }
    let left = largest(&a, &order, rank).2;
    let vector = |free: &usize| {
        let mut x = vec![Complex::zero(); columns];
        x[*free] = Complex::one();
        for k in (0..rank).rev() {
            let known = order[k + 1..rank].iter().chain([free]);
            let sum = known.fold(Complex::zero(), |sum, at| sum + a[k * columns + at] * x[*at]);
            x[order[k]] = -(sum * a[k * columns + order[k]].reciprocal());
        }
        x
    };
    NullSpace { vectors: order[rank..].iter().map(vector).list(), pivots: [least, left] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_null_space_of_a_complex_matrix() {
        let i = Complex::new(0.0, 1.0);
        let one = Complex::one();
        let found = null_space(&[one, i, -i, one], 2, 1);
        let [x, y] = found.vectors[0][..] else { panic!("two components") };
        assert!((x + i * y).magnitude() < 1e-15 && found.pivots[1] < 1e-15);
        assert_eq!(found.pivots[0], 1.0);
    }
}
