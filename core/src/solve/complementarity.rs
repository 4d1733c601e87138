//! Linear complementarity problems: w = A z + b with w ≥ 0, z ≥ 0 and wᵀz = 0.
//!
//! Lemke's method (*Bimatrix equilibrium points and mathematical programming*, Management Science 11 (1965) 681) with the
//! lexicographic choice of pivots, so that it never repeats a basis. The tableau is dense.

use crate::math::Listed;

/// Smaller entries are not used as pivots. The numbers of a problem should be about 1.
const LEAST: f64 = 1e-11;
/// Largest number of pivots for each unknown.
const MOST: usize = 200;

/// A solution z; None if the method finds none.
pub fn solve(a: &[Vec<f64>], b: &[f64]) -> Option<Vec<f64>> {
    let n = b.len();
    if b.iter().all(|b| *b >= 0.0) {
        return Some(vec![0.0; n]);
    }
    let mut tableau = Tableau::new(a, b);
    // the artificial unknown replaces the smallest w
    let mut row = (0..n).min_by(|i, k| b[*i].total_cmp(&b[*k]))?;
    let mut entering = 2 * n;
    for _ in 0..MOST * n.max(1) {
        let left = tableau.pivot(row, entering);
        if left == 2 * n {
            return Some(tableau.solution());
        }
        entering = (left + n) % (2 * n);
        row = tableau.leaving(entering)?;
    }
    None
}

/// The equations w - A z - e z₀ = b in terms of the unknowns that are not in the basis. The columns are w, z, z₀ and b.
struct Tableau {
    n: usize,
    rows: Vec<Vec<f64>>,
    /// The unknown of each row: w from 0, z from n, and z₀.
    basis: Vec<usize>,
}

impl Tableau {
    fn new(a: &[Vec<f64>], b: &[f64]) -> Self {
        let n = b.len();
        let row = |i: usize| {
            let own = (0..n).map(|k| if k == i { 1.0 } else { 0.0 });
            own.chain(a[i].iter().map(|x| -x)).chain([-1.0, b[i]]).list()
        };
        Self { n, rows: (0..n).map(row).list(), basis: (0..n).list() }
    }

    /// Exchanges the unknown of a row with another one, and returns it.
    fn pivot(&mut self, row: usize, entering: usize) -> usize {
        let factor = 1.0 / self.rows[row][entering];
        self.rows[row].iter_mut().for_each(|x| *x *= factor);
        let own = self.rows[row].clone();
        for (k, other) in self.rows.iter_mut().enumerate() {
            let factor = other[entering];
            if k != row && factor != 0.0 {
                other.iter_mut().zip(&own).for_each(|(x, own)| *x -= factor * own);
                other[entering] = 0.0;
            }
        }
        std::mem::replace(&mut self.basis[row], entering)
    }

    /// The row whose unknown becomes zero first as another one grows.
    fn leaving(&self, entering: usize) -> Option<usize> {
        let positive = (0..self.n).filter(|k| self.rows[*k][entering] > LEAST);
        let last = 2 * self.n + 1;
        let order = |i: &usize, k: &usize| {
            let (x, y) = (&self.rows[*i], &self.rows[*k]);
            let part = |row: &[f64], c: usize| row[c] / row[entering];
            let apart = |c: usize| part(x, c) - part(y, c);
            let differs = |c: &usize| apart(*c).abs() > 1e-13;
            // the artificial unknown leaves where it can
            let artificial = |row: usize| self.basis[row] != 2 * self.n;
            match apart(last) {
                by if by.abs() > 1e-13 => by.total_cmp(&0.0),
                _ if artificial(*i) != artificial(*k) => artificial(*i).cmp(&artificial(*k)),
                _ => (0..self.n).find(differs).map_or(i.cmp(k), |c| apart(c).total_cmp(&0.0)),
            }
        };
        positive.min_by(order)
    }

    fn solution(&self) -> Vec<f64> {
        let mut z = vec![0.0; self.n];
        for (row, unknown) in self.rows.iter().zip(&self.basis) {
            if (self.n..2 * self.n).contains(unknown) {
                z[unknown - self.n] = row[2 * self.n + 1].max(0.0);
            }
        }
        z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Random problems with positive definite matrices have one solution.
    #[test]
    fn solutions_meet_their_conditions() {
        let mut seed = 1_u64;
        let mut next = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        for n in 1..9 {
            let of: Vec<Vec<f64>> = (0..n).map(|_| (0..n).map(|_| next()).list()).list();
            let product = |i: usize, k: usize| {
                (0..n).map(|m| of[i][m] * of[k][m]).sum::<f64>() + if i == k { 0.1 } else { 0.0 }
            };
            let a: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|k| product(i, k)).list()).list();
            let b: Vec<f64> = (0..n).map(|_| next()).list();
            let z = solve(&a, &b).expect("there is a solution");
            for (row, b) in a.iter().zip(&b) {
                let w = b + row.iter().zip(&z).map(|(a, z)| a * z).sum::<f64>();
                assert!(w > -1e-10, "{w}");
            }
            let w = |i: usize| b[i] + (0..n).map(|k| a[i][k] * z[k]).sum::<f64>();
            assert!((0..n).all(|i| (w(i) * z[i]).abs() < 1e-10));
        }
    }

    #[test]
    fn a_problem_without_a_solution_is_told() {
        assert_eq!(solve(&[vec![-1.0]], &[-1.0]), None);
    }
}
