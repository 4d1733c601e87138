//! Linear complementarity problems: w = A z + b with w ≥ 0, z ≥ 0 and wᵀz = 0.
//!
//! Lemke's method (*Bimatrix equilibrium points and mathematical programming*, Management Science 11 (1965) 681) with the
//! lexicographic choice of pivots, so that it never repeats a basis. The tableau is dense.
//!
//! A problem may have several solutions. Then the one is wanted that is the limit of the solutions for b + ε c with small ε:
//! the pivots are chosen for such an ε, and the unknowns are those for ε = 0.
//!
//! Where columns depend on each other, rounding errors may end the path of the method early. Each column of the
//! artificial unknown has a path of its own, so others are tried.

use crate::math::{Listed, Random};

/// Smaller entries are not used as pivots. The numbers of a problem should be about 1.
const LEAST: f64 = 1e-11;
/// Largest number of pivots for each unknown.
const MOST: usize = 200;

/// Largest number of paths.
const PATHS: usize = 20;
/// Largest error of the conditions, relative to 1 or to the largest unknown.
const ERROR: f64 = 1e-9;

/// The small ε.
const SMALL: f64 = 1e-7;

/// A solution z; None if the method finds none. Among several solutions it is the limit of those for b + ε c.
pub fn solve(a: &[Vec<f64>], b: &[f64], c: &[f64]) -> Option<Vec<f64>> {
    if b.iter().all(|b| *b >= 0.0) {
        return Some(vec![0.0; b.len()]);
    }
    let mut random = Random::new(b.len() as u64);
    // a limit may not exist within the rounding errors
    (0..2 * PATHS).find_map(|path| {
        let column = |_| if path == 0 { 1.0 } else { 1.0 + random.uniform() };
        let artificial: Vec<f64> = (0..b.len()).map(column).list();
        let small = if path < PATHS { SMALL } else { 0.0 };
        let near: Vec<f64> = b.iter().zip(c).map(|(b, c)| b + small * c).list();
        follow(a, [&near, b], &artificial).filter(|z| error(a, b, z) < ERROR)
    })
}

/// The unknowns for b in the basis that is found for the numbers `near` it. The path depends on the column of the
/// artificial unknown.
fn follow(a: &[Vec<f64>], [near, b]: [&[f64]; 2], artificial: &[f64]) -> Option<Vec<f64>> {
    let n = b.len();
    let mut tableau = Tableau::new(a, [near, b], artificial);
    // the artificial unknown replaces the w that needs it most
    let need = |i: usize| near[i] / artificial[i];
    let mut row = (0..n).min_by(|i, k| need(*i).total_cmp(&need(*k)))?;
    if near[row] >= 0.0 {
        return None;
    }
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

/// The largest error of w ≥ 0 and wᵀz = 0.
fn error(a: &[Vec<f64>], b: &[f64], z: &[f64]) -> f64 {
    let most = z.iter().fold(1.0, |most: f64, z| most.max(*z));
    let of = |((row, b), own): ((&Vec<f64>, &f64), &f64)| {
        let w = b + row.iter().zip(z).map(|(a, z)| a * z).sum::<f64>();
        (-w).max((w * own).abs() / most) / most
    };
    a.iter().zip(b).zip(z).map(of).fold(0.0, f64::max)
}

/// The equations w - A z - c z₀ = b, with the column c of the artificial unknown z₀, in terms of the unknowns that are
/// not in the basis. The columns are w, z, z₀, the numbers near b, and b.
struct Tableau {
    n: usize,
    rows: Vec<Vec<f64>>,
    /// The unknown of each row: w from 0, z from n, and z₀.
    basis: Vec<usize>,
}

impl Tableau {
    fn new(a: &[Vec<f64>], [near, b]: [&[f64]; 2], artificial: &[f64]) -> Self {
        let n = b.len();
        let row = |i: usize| {
            let own = (0..n).map(|k| if k == i { 1.0 } else { 0.0 });
            own.chain(a[i].iter().map(|x| -x)).chain([-artificial[i], near[i], b[i]]).list()
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
                z[unknown - self.n] = row[2 * self.n + 2].max(0.0);
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
            let z = solve(&a, &b, &vec![0.0; n]).expect("there is a solution");
            for (row, b) in a.iter().zip(&b) {
                let w = b + row.iter().zip(&z).map(|(a, z)| a * z).sum::<f64>();
                assert!(w > -1e-10, "{w}");
            }
            let w = |i: usize| b[i] + (0..n).map(|k| a[i][k] * z[k]).sum::<f64>();
            assert!((0..n).all(|i| (w(i) * z[i]).abs() < 1e-10));
        }
    }

    /// The impacts of a block on two to six feet in a line: all but three columns depend on others.
    #[test]
    fn problems_with_dependent_columns() {
        let mut random = Random::new(7);
        let mut of = |least: f64, most: f64| least + (most - least) * random.uniform();
        for case in 0..5000 {
            let n = 2 + case % 5;
            let (friction, inertia) = (of(0.1, 0.9), 10_f64.powf(of(-1.5, 0.0)));
            let places: Vec<f64> = (0..n).map(|_| of(-0.6, 0.6)).list();
            let normal = places.iter().map(|x| [0.0, 1.0, *x]).list();
            let rows = [normal, vec![[1.0, 0.0, 0.3]; n]].concat();
            let turn = if case % 2 == 0 { 1e-10 } else { of(-1.0, 1.0) };
            let speed = [of(-1.0, 1.0), of(-1.0, 0.0), turn];
            let dot = |g: &[f64; 3], h: &[f64; 3]| g[0] * h[0] + g[1] * h[1] + g[2] * h[2];
            let over_mass = |g: &[f64; 3]| [g[0], g[1], g[2] / inertia];
            // the normal directions, two of friction, and the slacks
            let own = |k: usize| if k < 2 * n { (k, 1.0) } else { (k - n, -1.0) };
            let (mut a, mut b) = (vec![vec![0.0; 4 * n]; 4 * n], vec![0.0; 4 * n]);
            for i in 0..3 * n {
                let (row, sign) = own(i);
                b[i] = sign * dot(&rows[row], &speed);
                for (k, a) in a[i][..3 * n].iter_mut().enumerate() {
                    let (column, other) = own(k);
                    *a = sign * other * dot(&rows[row], &over_mass(&rows[column]));
                }
            }
            for k in 0..n {
                let slack = 3 * n + k;
                (a[n + k][slack], a[2 * n + k][slack], a[slack][k]) = (1.0, 1.0, friction);
                (a[slack][n + k], a[slack][2 * n + k]) = (-1.0, -1.0);
            }
            let z = solve(&a, &b, &vec![0.0; 4 * n]);
            assert!(z.is_some_and(|z| error(&a, &b, &z) < ERROR), "{case}");
        }
    }

    #[test]
    fn a_problem_without_a_solution_is_told() {
        assert_eq!(solve(&[vec![-1.0]], &[-1.0], &[0.0]), None);
    }
}
