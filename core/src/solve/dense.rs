//! Small dense systems.

/// Solves A x = b by elimination with partial pivoting. `a` is row-major, of shape (n, n), and is overwritten; `b`
/// becomes x. Returns false if a pivot is zero or not finite.
pub fn solve_dense(a: &mut [f64], b: &mut [f64]) -> bool {
    let n = b.len();
    if eliminate(a, b).0 == 0.0 {
        return false;
    }
    for k in (0..n).rev() {
        let sum: f64 = (k + 1..n).map(|column| a[k * n + column] * b[column]).sum();
        b[k] = (b[k] - sum) / a[k * n + k];
    }
    true
}

/// The sign of the determinant of a row-major matrix of shape (n, n), which is overwritten, and the ratio of the
/// smallest to the largest pivot. The sign is 0 if a pivot is zero or not finite.
pub fn sign_of_determinant(a: &mut [f64], n: usize) -> (f64, f64) {
    eliminate(a, &mut vec![0.0; n])
}

/// Gaussian elimination with exchanges of rows. Returns the sign of the determinant, which is 0 if a pivot is zero or
/// not finite, and the ratio of the smallest to the largest pivot.
fn eliminate(a: &mut [f64], b: &mut [f64]) -> (f64, f64) {
    let n = b.len();
    assert_eq!(a.len(), n * n, "a square matrix");
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    let mut sign = 1.0;
    for k in 0..n {
        let best = (k..n).max_by(|i, j| a[i * n + k].abs().total_cmp(&a[j * n + k].abs()));
        let best = best.unwrap_or(k);
        let pivot = a[best * n + k];
        if pivot == 0.0 || !pivot.is_finite() {
            return (0.0, 0.0);
        }
        if best != k {
            (k..n).for_each(|column| a.swap(k * n + column, best * n + column));
            b.swap(k, best);
            sign = -sign;
        }
        sign *= pivot.signum();
        (least, most) = (least.min(pivot.abs()), most.max(pivot.abs()));
        let (above, below) = a.split_at_mut((k + 1) * n);
        let own = &above[k * n + k + 1..];
        for (i, row) in below.chunks_exact_mut(n).enumerate() {
            let factor = row[k] / pivot;
            if factor != 0.0 {
                row[k + 1..].iter_mut().zip(own).for_each(|(x, own)| *x -= factor * own);
                b[k + 1 + i] -= factor * b[k];
            }
        }
    }
    (sign, least / most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_that_needs_an_exchange_of_rows_is_solved() {
        // x = (1, 2, 3)
        let mut a = vec![0.0, 2.0, 1.0, 1.0, 1.0, 1.0, 2.0, 0.0, -1.0];
        let mut b = vec![7.0, 6.0, -1.0];
        assert!(solve_dense(&mut a, &mut b));
        assert!(b.iter().zip([1.0, 2.0, 3.0]).all(|(x, y): (&f64, f64)| (x - y).abs() < 1e-15));
    }

    #[test]
    fn the_sign_of_a_determinant() {
        assert_eq!(sign_of_determinant(&mut [0.0, 2.0, 3.0, 1.0], 2), (-1.0, 2.0 / 3.0));
        assert_eq!(sign_of_determinant(&mut [2.0, 0.0, 3.0, 1.0], 2).0, 1.0);
        assert_eq!(sign_of_determinant(&mut [1.0, 2.0, 2.0, 4.0], 2).0, 0.0);
    }

    #[test]
    fn a_singular_system_is_refused() {
        assert!(!solve_dense(&mut [1.0, 2.0, 2.0, 4.0], &mut [1.0, 2.0]));
    }
}
