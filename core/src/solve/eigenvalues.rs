//! Eigenvalues of a dense real matrix by the QR algorithm with double shifts (Golub and Van Loan, *Matrix Computations*,
//! 4th ed., 7.4 and 7.5), after balancing (Parlett and Reinsch, *Numerische Mathematik* 13, 1969).

use crate::math::{Complex, Listed, ShortArray};

/// Largest number of steps for one eigenvalue; two to four are usual.
const STEPS: usize = 300;
/// Number of steps after which an exceptional shift is taken.
const EXCEPTIONAL: usize = 10;

/// The eigenvalues of a row-major matrix of shape (n, n). Complex ones are exactly conjugate. They are NaN if the matrix
/// is not finite.
pub fn eigenvalues(matrix: &[f64], n: usize) -> Vec<Complex> {
    assert_eq!(matrix.len(), n * n, "a square matrix");
    let mut a = Square { n, of: matrix.to_vec() };
    a.balance();
    a.reduce();
    let mut found = Vec::with_capacity(n);
    // rows and columns from `end` are done
    let (mut end, mut steps) = (n, 0);
    while end > 0 {
        let begin = a.begin_of_block(end);
        match end - begin {
            1 => found.push(Complex::new(a.at(begin, begin), 0.0)),
            2 => found.extend(a.pair(begin)),
            _ if steps < STEPS => {
                steps += 1;
                a.step(begin, end, steps % EXCEPTIONAL == 0);
                continue;
            }
            size => found.extend(vec![Complex::new(f64::NAN, 0.0); size]),
        }
        (end, steps) = (begin, 0);
    }
    found
}

/// A square matrix, row by row.
struct Square {
    n: usize,
    of: Vec<f64>,
}

impl Square {
    fn at(&self, i: usize, j: usize) -> f64 {
        self.of[i * self.n + j]
    }

    /// Scales rows and columns by powers of two, so that both have similar sizes. The eigenvalues do not change.
    fn balance(&mut self) {
        let n = self.n;
        let mut scaled = true;
        while scaled {
            scaled = false;
            for k in 0..n {
                let others = || (0..n).filter(|j| *j != k);
                let mut column: f64 = others().map(|j| self.at(j, k).abs()).sum();
                let row: f64 = others().map(|j| self.at(k, j).abs()).sum();
                if !(column > 0.0 && row > 0.0 && column.is_finite() && row.is_finite()) {
                    continue;
                }
                let (mut factor, before) = (1.0, column + row);
                while column < row / 2.0 {
                    (factor, column) = (factor * 2.0, column * 4.0);
                }
                while column >= row * 2.0 {
                    (factor, column) = (factor / 2.0, column / 4.0);
                }
                if (column + row) / factor < 0.95 * before {
                    scaled = true;
                    (0..n).for_each(|j| self.of[k * n + j] /= factor);
                    (0..n).for_each(|j| self.of[j * n + k] *= factor);
                }
            }
        }
    }

    /// Makes all entries below the first subdiagonal zero, by reflections.
    fn reduce(&mut self) {
        for k in 1..self.n.saturating_sub(1) {
            let column: Vec<f64> = (k..self.n).map(|i| self.at(i, k - 1)).list();
            self.reflect(k, &column, (k - 1, self.n), (0, self.n));
            (k + 1..self.n).for_each(|i| self.of[i * self.n + k - 1] = 0.0);
        }
    }

    /// Applies, to the rows and columns from `k`, the reflection that turns a vector into the first axis: to rows in a
    /// range of columns, and to columns in a range of rows.
    fn reflect(&mut self, k: usize, vector: &[f64], columns: (usize, usize), rows: (usize, usize)) {
        let largest = vector.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        if vector[1..].iter().all(|x| *x == 0.0) || !largest.is_finite() {
            return;
        }
        let mut v: Vec<f64> = vector.iter().map(|x| x / largest).list();
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v[0] += length.copysign(v[0]);
        let factor = 2.0 / v.iter().map(|x| x * x).sum::<f64>();
        let n = self.n;
        for j in columns.0..columns.1 {
            let sum: f64 = v.iter().enumerate().map(|(i, x)| x * self.of[(k + i) * n + j]).sum();
            v.iter().enumerate().for_each(|(i, x)| self.of[(k + i) * n + j] -= factor * sum * x);
        }
        for i in rows.0..rows.1 {
            let row = &mut self.of[i * n + k..i * n + k + v.len()];
            let sum: f64 = v.iter().zip(&*row).map(|(x, a)| x * a).sum();
            v.iter().zip(row).for_each(|(x, a)| *a -= factor * sum * x);
        }
    }

    /// The first row of the last block before `end` that no negligible entry divides.
    fn begin_of_block(&mut self, end: usize) -> usize {
        for k in (1..end).rev() {
            let beside = self.at(k - 1, k - 1).abs() + self.at(k, k).abs();
            if self.at(k, k - 1).abs() <= f64::EPSILON * beside {
                self.of[k * self.n + k - 1] = 0.0;
                return k;
            }
        }
        0
    }

    /// The two eigenvalues of the block of two rows at `k`.
    fn pair(&self, k: usize) -> [Complex; 2] {
        let [a, b, c, d] =
            [(k, k), (k, k + 1), (k + 1, k), (k + 1, k + 1)].each(|(i, j)| self.at(i, j));
        let half = 0.5 * (a - d);
        let square = half * half + b * c;
        if square < 0.0 {
            let (re, im) = (0.5 * (a + d), (-square).sqrt());
            return [Complex::new(re, im), Complex::new(re, -im)];
        }
        let root = half + square.sqrt().copysign(half);
        let other = if root == 0.0 { d } else { d - b * c / root };
        [Complex::new(d + root, 0.0), Complex::new(other, 0.0)]
    }

    /// One step with two shifts in the block of at least three rows from `begin` to `end`.
    fn step(&mut self, begin: usize, end: usize, exceptional: bool) {
        let [m, l] = [end - 2, end - 1];
        let (sum, product) = if exceptional {
            let size = self.at(l, m).abs() + self.at(m, m - 1).abs();
            (1.5 * size, size * size)
        } else {
            let determinant = self.at(m, m) * self.at(l, l) - self.at(m, l) * self.at(l, m);
            (self.at(m, m) + self.at(l, l), determinant)
        };
        let [p, q] = [begin, begin + 1];
        let below = self.at(q, p);
        let mut vector = vec![
            self.at(p, p) * (self.at(p, p) - sum) + self.at(p, q) * below + product,
            below * (self.at(p, p) + self.at(q, q) - sum),
            below * self.at(q + 1, q),
        ];
        for k in begin..end - 1 {
            let columns = (k.max(begin + 1) - 1, end);
            self.reflect(k, &vector, columns, (begin, (k + 4).min(end)));
            vector = (k + 1..(k + 4).min(end)).map(|i| self.at(i, k)).list();
            if k > begin {
                (k + 1..(k + 3).min(end)).for_each(|i| self.of[i * self.n + k - 1] = 0.0);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The companion matrix of a polynomial has its roots as eigenvalues: here 1, 2, 3, -1 ± 2i and 1000.
    #[test]
    fn the_roots_of_a_polynomial() {
        let roots = [(1.0, 0.0), (2.0, 0.0), (3.0, 0.0), (-1.0, 2.0), (-1.0, -2.0), (1e3, 0.0)];
        let mut polynomial = vec![Complex::new(1.0, 0.0)];
        for (re, im) in roots {
            polynomial.push(Complex::new(0.0, 0.0));
            for k in (1..polynomial.len()).rev() {
                polynomial[k] = polynomial[k] - Complex::new(re, im) * polynomial[k - 1];
            }
        }
        let n = roots.len();
        let entry = |k: usize| match (k / n, k % n) {
            (0, j) => -polynomial[j + 1].re,
            (i, j) => f64::from(u8::from(i == j + 1)),
        };
        let matrix: Vec<f64> = (0..n * n).map(entry).collect();
        let found = eigenvalues(&matrix, n);
        for (re, im) in roots {
            let off = |s: &Complex| (s.re - re).hypot(s.im - im) / re.hypot(im);
            let least = found.iter().map(off).fold(f64::INFINITY, f64::min);
            assert!(least < 1e-11, "{re} {im}: {found:?}");
        }
    }

    #[test]
    fn a_cyclic_permutation_needs_exceptional_shifts() {
        let n = 4;
        let matrix: Vec<f64> =
            (0..n * n).map(|k| f64::from(u8::from((k / n + 1) % n == k % n))).collect();
        for s in eigenvalues(&matrix, n) {
            assert!((s.re.hypot(s.im) - 1.0).abs() < 1e-14, "{s:?}");
        }
    }

    #[test]
    fn small_and_infinite_matrices() {
        assert!(eigenvalues(&[], 0).is_empty());
        assert_eq!(eigenvalues(&[2.0], 1), [Complex::new(2.0, 0.0)]);
        assert_eq!(eigenvalues(&[f64::NAN; 9], 3).len(), 3);
        assert_eq!(eigenvalues(&[0.0, 1.0, 0.0, 0.0], 2), [Complex::new(0.0, 0.0); 2]);
    }
}
