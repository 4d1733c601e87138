//! Sparse LDLᵀ against a dense reference, on random saddle-point matrices of mechanism shape.

use kempe::math::{Dual, Lanes, Real};
use kempe::solve::{bodies_first, Factor, Symbolic};

/// xorshift64*: reproducible numbers in [-1, 1).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A symmetric matrix by entries, with what the order needs.
struct Matrix {
    n: usize,
    n_first: usize,
    blocks: Vec<usize>,
    entries: Vec<(usize, usize)>,
    values: Vec<f64>,
}

impl Matrix {
    /// [M Φᵀ; Φ 0] of bodies joined by pins: `pins[k]` = (body, body or ground).
    fn mechanism(bodies: usize, pins: &[(usize, Option<usize>)], random: &mut Random) -> Self {
        let n_first = 3 * bodies;
        let mut m = Self {
            n: n_first + 2 * pins.len(),
            n_first,
            blocks: (0..bodies).map(|b| 3 * b).collect(),
            entries: vec![],
            values: vec![],
        };
        for i in 0..n_first {
            m.push(i, i, 1.5 + random.next());
        }
        for b in 0..bodies {
            m.push(3 * b + 2, 3 * b, 0.3 * random.next()); // origin off the mass centre
        }
        for (k, &(i, j)) in pins.iter().enumerate() {
            let row = n_first + 2 * k;
            m.blocks.push(row);
            for (body, sign) in [(Some(i), -1.0), (j, 1.0)] {
                let Some(body) = body else { continue };
                m.push(row, 3 * body, sign);
                m.push(row + 1, 3 * body + 1, sign);
                m.push(row, 3 * body + 2, random.next());
                m.push(3 * body + 2, row + 1, random.next()); // the other triangle will do
            }
        }
        m
    }

    fn push(&mut self, i: usize, j: usize, value: f64) {
        self.entries.push((i, j));
        self.values.push(value);
    }

    fn symbolic(&self) -> Symbolic {
        let order = bodies_first(self.n_first, self.n, &self.entries, Some(&self.blocks));
        Symbolic::new(self.n, &self.entries, &order)
    }

    fn dense(&self) -> Vec<Vec<f64>> {
        let mut a = vec![vec![0.0; self.n]; self.n];
        for (&(i, j), &value) in self.entries.iter().zip(&self.values) {
            a[i][j] += value;
            if i != j {
                a[j][i] += value;
            }
        }
        a
    }
}

fn four_bar(random: &mut Random) -> Matrix {
    Matrix::mechanism(3, &[(0, None), (0, Some(1)), (1, Some(2)), (2, None)], random)
}

/// A chain of `bodies` hung between two pins.
fn chain(bodies: usize, random: &mut Random) -> Matrix {
    let mut pins = vec![(0, None)];
    pins.extend((1..bodies).map(|b| (b - 1, Some(b))));
    pins.push((bodies - 1, None));
    Matrix::mechanism(bodies, &pins, random)
}

/// `arms` bodies on one hub: its joints become a dense block, with long columns.
fn hub(arms: usize, random: &mut Random) -> Matrix {
    let pins: Vec<_> = (1..=arms).map(|b| (0, Some(b))).collect();
    Matrix::mechanism(arms + 1, &pins, random)
}

/// Random loops over a tree.
fn tangle(bodies: usize, random: &mut Random) -> Matrix {
    let mut pins = vec![(0, None)];
    for b in 1..bodies {
        let parent = ((random.next() + 1.0) / 2.0 * b as f64) as usize;
        pins.push((parent, Some(b)));
    }
    for b in (4..bodies).step_by(4) {
        let other = (b + bodies / 2 + 1) % bodies; // odd, so no loop comes twice
        let joined = pins.contains(&(b, Some(other))) || pins.contains(&(other, Some(b)));
        if !joined {
            pins.push((b, Some(other)));
        }
    }
    Matrix::mechanism(bodies, &pins, random)
}

/// Gaussian elimination with partial pivoting.
fn dense_solve(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let p = (k..n).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs())).unwrap();
        a.swap(k, p);
        b.swap(k, p);
        for i in k + 1..n {
            let l = a[i][k] / a[k][k];
            let (pivot, row) = (a[k].clone(), &mut a[i]);
            for (r, p) in row.iter_mut().zip(&pivot).skip(k) {
                *r -= l * p;
            }
            b[i] -= l * b[k];
        }
    }
    for k in (0..n).rev() {
        let sum: f64 = (k + 1..n).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - sum) / a[k][k];
    }
    b
}

fn norm(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |m, v| m.max(v.abs()))
}

/// ‖b - A x‖ / (‖A‖ ‖x‖ + ‖b‖) in the maximum norm.
fn relative_residual(m: &Matrix, symbolic: &Symbolic, x: &[f64], b: &[f64]) -> f64 {
    let mut r = b.to_vec();
    symbolic.subtract_product(&m.values, x, &mut r);
    let mut rows = vec![0.0; m.n];
    for (&(i, j), v) in m.entries.iter().zip(&m.values) {
        rows[i] += v.abs();
        if i != j {
            rows[j] += v.abs();
        }
    }
    norm(&r) / (norm(&rows) * norm(x) + norm(b))
}

fn cases(random: &mut Random) -> Vec<Matrix> {
    let mut all = vec![chain(2, random), chain(3, random), chain(50, random), hub(20, random)];
    for _ in 0..20 {
        all.push(four_bar(random));
        all.push(tangle(12, random));
        all.push(tangle(40, random));
    }
    all
}

#[test]
fn random_mechanisms_are_solved_to_rounding() {
    let mut random = Random(7);
    for m in cases(&mut random) {
        let symbolic = m.symbolic();
        let mut factor = Factor::new(&symbolic);
        let b: Vec<f64> = (0..m.n).map(|_| random.next()).collect();
        factor.factor(&symbolic, &m.values).unwrap();
        let mut x = b.clone();
        factor.solve(&symbolic, &mut x);
        let residual = relative_residual(&m, &symbolic, &x, &b);
        assert!(residual < 1e-13, "n = {}: {residual:e}", m.n);
        let reference = dense_solve(m.dense(), b.clone());
        let difference: Vec<f64> = x.iter().zip(&reference).map(|(a, b)| a - b).collect();
        assert!(norm(&difference) < 1e-8 * norm(&reference), "n = {}", m.n);
        factor.refine(&symbolic, &m.values, &b, &mut x);
        assert!(relative_residual(&m, &symbolic, &x, &b) < 1e-15, "n = {}", m.n);
    }
}

#[test]
fn inertia_is_that_of_the_saddle_point() {
    let mut random = Random(3);
    for m in cases(&mut random) {
        let symbolic = m.symbolic();
        let mut factor = Factor::new(&symbolic);
        factor.factor(&symbolic, &m.values).unwrap();
        for (unknown, pivot) in factor.pivots(&symbolic) {
            assert_eq!(pivot > 0.0, unknown < m.n_first, "unknown {unknown}: {pivot}");
        }
    }
}

#[test]
fn duplicates_and_mirrored_entries_are_summed() {
    // [[2, 1], [1, 3]] x = (3, 4) has x = (1, 1)
    let entries = [(0, 0), (1, 0), (0, 1), (1, 1), (0, 0)];
    let values = [0.5, 0.25, 0.75, 3.0, 1.5];
    for order in [[0, 1], [1, 0]] {
        let symbolic = Symbolic::new(2, &entries, &order);
        let mut factor = Factor::new(&symbolic);
        factor.factor(&symbolic, &values).unwrap();
        let mut x = [3.0, 4.0];
        factor.solve(&symbolic, &mut x);
        assert!((x[0] - 1.0).abs() < 1e-15 && (x[1] - 1.0).abs() < 1e-15, "{x:?}");
    }
}

#[test]
fn a_repeated_joint_is_refused_by_its_row_at_any_scale() {
    for scale in [1e-8, 1.0, 1e8] {
        let mut random = Random(11);
        let mut m = four_bar(&mut random);
        let repeated = m.n - 2; // the first row of the joint that fixes body 2, once more
        let row: Vec<_> = m.entries.iter().zip(&m.values).map(|(&e, &v)| (e, v)).collect();
        let copy = m.n;
        m.n += 1;
        m.blocks.push(copy);
        for ((i, j), v) in row {
            if i == repeated {
                m.push(copy, j, scale * v);
            } else if j == repeated {
                m.push(copy, i, scale * v);
            }
        }
        let symbolic = m.symbolic();
        let mut factor = Factor::new(&symbolic);
        let refused = factor.factor(&symbolic, &m.values).unwrap_err();
        assert!([repeated, copy].contains(&refused.index), "{refused}");
        assert!(refused.ratio < 1e-15, "{refused}");
    }
}

#[test]
fn near_dependence_shows_as_cancellation() {
    // rows (1, 0) and (1, 1e-4) of Φ with M = I: the second pivot is -1e-8 out of 2
    let entries = [(0, 0), (1, 1), (2, 0), (3, 0), (3, 1)];
    let symbolic = Symbolic::new(4, &entries, &[0, 1, 2, 3]);
    let mut factor = Factor::new(&symbolic);
    factor.factor(&symbolic, &[1.0, 1.0, 1.0, 1.0, 1e-4]).unwrap();
    let (index, ratio) = factor.cancellation(&symbolic).unwrap();
    assert_eq!(index, 3);
    assert!((ratio / 0.5e-8 - 1.0).abs() < 1e-3, "{ratio:e}");
}

#[test]
fn zero_missing_and_non_finite_pivots_are_refused() {
    let symbolic = Symbolic::new(2, &[(0, 0), (1, 1)], &[1, 0]);
    let mut factor = Factor::new(&symbolic);
    for bad in [0.0, f64::NAN, f64::INFINITY] {
        assert_eq!(factor.factor(&symbolic, &[bad, 1.0]).unwrap_err().index, 0);
        assert_eq!(factor.factor(&symbolic, &[1.0, bad]).unwrap_err().index, 1);
    }
    let symbolic = Symbolic::new(2, &[(0, 0)], &[0, 1]);
    let mut factor = Factor::new(&symbolic);
    assert_eq!(factor.factor(&symbolic, &[1.0]).unwrap_err().index, 1);
    let mut lanes = Factor::new(&symbolic);
    let symbolic = Symbolic::new(1, &[(0, 0)], &[0]);
    for bad in [0.0, f64::NAN, f64::INFINITY] {
        lanes.clone_from(&Factor::new(&symbolic));
        assert!(lanes.factor(&symbolic, &[Lanes([1.0, bad])]).is_err(), "{bad}");
    }
}

#[test]
fn lanes_equal_scalars() {
    let mut random = Random(5);
    let designs: [Matrix; 4] = std::array::from_fn(|_| four_bar(&mut random));
    let symbolic = designs[0].symbolic();
    let values: Vec<Lanes<4>> = (0..designs[0].values.len())
        .map(|e| Lanes(std::array::from_fn(|w| designs[w].values[e])))
        .collect();
    let mut x: Vec<Lanes<4>> =
        (0..17).map(|_| Lanes(std::array::from_fn(|_| random.next()))).collect();
    let b = x.clone();
    let mut factor = Factor::new(&symbolic);
    factor.factor(&symbolic, &values).unwrap();
    factor.solve(&symbolic, &mut x);
    for (w, design) in designs.iter().enumerate() {
        let mut single = Factor::new(&symbolic);
        single.factor(&symbolic, &design.values).unwrap();
        let mut y: Vec<f64> = b.iter().map(|b| b.0[w]).collect();
        single.solve(&symbolic, &mut y);
        let lane: Vec<f64> = x.iter().map(|x| x.0[w]).collect();
        assert_eq!(lane, y);
    }
}

#[test]
fn dual_solutions_carry_the_derivative() {
    let mut random = Random(9);
    let m = four_bar(&mut random);
    let symbolic = m.symbolic();
    let slope: Vec<f64> = m.values.iter().map(|_| random.next()).collect();
    let b: Vec<f64> = (0..m.n).map(|_| random.next()).collect();
    let at = |h: f64| -> Vec<f64> {
        let values: Vec<f64> = m.values.iter().zip(&slope).map(|(v, s)| v + h * s).collect();
        let mut factor = Factor::new(&symbolic);
        factor.factor(&symbolic, &values).unwrap();
        let mut x = b.clone();
        factor.solve(&symbolic, &mut x);
        x
    };
    let values: Vec<Dual<1>> =
        m.values.iter().zip(&slope).map(|(&value, &s)| Dual { value, slope: [s] }).collect();
    let mut factor = Factor::new(&symbolic);
    factor.factor(&symbolic, &values).unwrap();
    let mut x: Vec<Dual<1>> = b.iter().map(|&b| Dual::constant(b)).collect();
    factor.solve(&symbolic, &mut x);
    let h = 1e-4;
    let sample = [at(-2.0 * h), at(-h), at(h), at(2.0 * h)];
    for (i, x) in x.iter().enumerate() {
        let [a, b, c, d] = [0, 1, 2, 3].map(|k: usize| sample[k][i]);
        let difference = (a - 8.0 * b + 8.0 * c - d) / (12.0 * h);
        let error = (x.slope[0] - difference).abs();
        assert!(error < 1e-7 * (1.0 + difference.abs()), "{i}: {} {difference}", x.slope[0]);
    }
}

#[test]
fn coordinates_go_before_rows_and_blocks_stay_together() {
    let m = tangle(30, &mut Random(2));
    let order = bodies_first(m.n_first, m.n, &m.entries, Some(&m.blocks));
    assert!(order[..m.n_first].iter().all(|&i| i < m.n_first));
    let mut sorted = order.clone();
    sorted.sort_unstable();
    assert!(sorted.into_iter().eq(0..m.n));
    for (k, &i) in order.iter().enumerate() {
        if !m.blocks.contains(&i) {
            assert_eq!(order[k - 1], i - 1);
        }
    }
}

#[test]
fn fill_of_chains_is_linear_with_and_without_blocks() {
    // dense 3 × 4 blocks below the bodies; among the rows of the joints a block tridiagonal
    let m = chain(2000, &mut Random(1));
    let fill = m.symbolic().fill();
    assert!(fill < 20 * 2000, "{fill}");
    let order = bodies_first(m.n_first, m.n, &m.entries, None);
    let single = Symbolic::new(m.n, &m.entries, &order).fill();
    assert!(single < 20 * 2000, "{single}");
}

#[test]
fn a_ring_is_eliminated_without_a_dense_block() {
    let bodies = 500;
    let pins: Vec<_> =
        (0..bodies).map(|b| (b, Some((b + 1) % bodies))).chain([(0, None)]).collect();
    let m = Matrix::mechanism(bodies, &pins, &mut Random(4));
    assert!(m.symbolic().fill() < 26 * bodies, "{}", m.symbolic().fill());
}
