//! Saddle-point matrices solved by blocks against a dense reference, on random mechanisms.

mod matrix;

use kempe::math::{Dual, Lanes, Real};
use kempe::solve::{rank, Breakdown, Group, InverseMass, Pattern, RowBlock, Saddle};
use matrix::{chain, four_bar, hub, inverse_mass, tangle, Matrix, Random};

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
fn relative_residual(m: &Matrix, x: &[f64], b: &[f64]) -> f64 {
    let a = m.dense();
    let times = |row: &Vec<f64>| -> f64 { row.iter().zip(x).map(|(a, x)| a * x).sum() };
    let r: Vec<f64> = a.iter().zip(b).map(|(row, b)| b - times(row)).collect();
    let rows: Vec<f64> = a.iter().map(|row| row.iter().map(|a| a.abs()).sum()).collect();
    norm(&r) / (norm(&rows) * norm(x) + norm(b))
}

fn cases(random: &mut Random) -> Vec<Matrix> {
    let mut all = vec![chain(2, random), chain(3, random), chain(50, random), hub(20, random)];
    for _ in 0..20 {
        all.push(four_bar(random));
        all.push(tangle(12, random));
        all.push(tangle(40, random));
        let mut welded = tangle(12, random);
        welded.push(3, &[(Some(5), -1.0), (Some(11), 1.0)], random);
        welded.push(1, &[(Some(3), -1.0), (Some(7), 1.0), (Some(9), 1.0)], random);
        all.push(welded);
    }
    all
}

fn right_side(m: &Matrix, random: &mut Random) -> Vec<f64> {
    (0..m.n()).map(|_| random.next()).collect()
}

/// Without the padding of the last group.
fn unpadded(m: &Matrix, pattern: &Pattern, x: &[f64]) -> Vec<f64> {
    [&x[..m.unknowns()], &x[pattern.n_unknowns()..]].concat()
}

/// The other way round, with a number in the padding that must not matter.
fn padded(m: &Matrix, pattern: &Pattern, x: &[f64]) -> Vec<f64> {
    let padding = vec![1e3; pattern.n_unknowns() - m.unknowns()];
    [&x[..m.unknowns()], &padding, &x[m.unknowns()..]].concat()
}

/// Solved with the current factor, to a relative residual; the same with the right side beside the blocks.
fn solved(
    m: &Matrix,
    (pattern, saddle): (&Pattern, &mut Saddle<f64>),
    b: &[f64],
    bound: f64,
) -> Vec<f64> {
    let [mut x, mut beside] = [0, 1].map(|_| padded(m, pattern, b));
    saddle.solve(pattern, &mut x);
    let x = unpadded(m, pattern, &x);
    let residual = relative_residual(m, &x, b);
    assert!(residual < bound, "n = {}: {residual:e}", m.n());
    saddle.factor_and_solve(pattern, &mut beside).unwrap();
    let beside = unpadded(m, pattern, &beside);
    let apart: Vec<f64> = x.iter().zip(&beside).map(|(a, b)| a - b).collect();
    assert!(norm(&apart) <= 1e-12 * norm(&x), "n = {}", m.n());
    x
}

#[test]
fn random_mechanisms_are_solved_to_rounding() {
    let mut random = Random(7);
    for m in cases(&mut random) {
        let pattern = m.pattern();
        let mut saddle = m.saddle(&pattern);
        let b = right_side(&m, &mut random);
        saddle.factor(&pattern).unwrap();
        let x = solved(&m, (&pattern, &mut saddle), &b, 1e-13);
        let reference = dense_solve(m.dense(), b.clone());
        let difference: Vec<f64> = x.iter().zip(&reference).map(|(a, b)| a - b).collect();
        assert!(norm(&difference) < 1e-8 * norm(&reference), "n = {}", m.n());
    }
}

#[test]
fn short_groups_are_solved_to_rounding() {
    let mut random = Random(23);
    let mut solvable = 0;
    for k in 0..120 {
        let bodies = 4 + k % 9;
        let mut m = Matrix::mechanism(bodies, &[], &mut random);
        for b in 1..bodies {
            let size = 1 + usize::from(b % 4 == 3);
            m.push(size, &[(Some(b - 1), -1.0), (Some(b), 1.0)], &mut random);
        }
        let three = [0, 2, 3].map(|b| (Some((k + b) % bodies), 1.0));
        m.push(3, &three, &mut random);
        let m = m.shortened(&mut random);
        let pattern = m.pattern();
        let mut saddle = m.saddle(&pattern);
        let b = right_side(&m, &mut random);
        // more rows than short groups have unknowns: damped
        saddle.damping = vec![0.3; m.rows()];
        let mut dense = m.dense();
        (m.unknowns()..m.n()).for_each(|k| dense[k][k] = -0.3);
        saddle.factor(&pattern).unwrap();
        let mut x = padded(&m, &pattern, &b);
        saddle.solve(&pattern, &mut x);
        let mut beside = padded(&m, &pattern, &b);
        saddle.factor_and_solve(&pattern, &mut beside).unwrap();
        let reference = dense_solve(dense, b.clone());
        for x in [x, beside] {
            let x = unpadded(&m, &pattern, &x);
            let apart: Vec<f64> = x.iter().zip(&reference).map(|(a, b)| a - b).collect();
            assert!(norm(&apart) < 1e-11 * norm(&reference), "n = {}: {:e}", m.n(), norm(&apart));
        }
        // and without damping, where A has full rank
        saddle.damping.clear();
        if saddle.factor(&pattern).is_ok() {
            solved(&m, (&pattern, &mut saddle), &b, 1e-11);
            solvable += 1;
        }
    }
    assert!(solvable >= 5, "{solvable}");
}

#[test]
fn condensed_groups_are_solved_to_rounding() {
    let mut random = Random(17);
    let (mut pins, mut slides, mut solvable) = (0, 0, 0);
    for (n, mut m) in cases(&mut random).into_iter().enumerate() {
        m.masses.iter_mut().for_each(|mass| mass[1] = mass[0]);
        // more condensed groups, by a pin or a slide, and one with a second pair that stays
        match n % 3 {
            0 => m.push_slide(1, &mut random),
            _ => m.push(2, &[(Some(1), -1.0)], &mut random),
        }
        if n % 2 == 0 {
            m.push(2, &[(Some(0), -1.0)], &mut random);
        }
        let (pattern, mut saddle) = m.condensed();
        assert_eq!(pattern.condensed().len(), m.condensable().len());
        let b = right_side(&m, &mut random);
        if saddle.factor(&pattern).is_err() {
            // two pins of one body, or a body too many
            let dense = m.dense();
            let rows: Vec<f64> =
                dense[m.unknowns()..].iter().flat_map(|row| row[..m.unknowns()].to_vec()).collect();
            assert!(rank(&rows, m.unknowns(), 1e-6).rank < m.rows(), "n = {}", m.n());
            continue;
        }
        solvable += 1;
        let of_slides = pattern.condensed().iter().filter(|place| place.sign == 0.0).count();
        slides += of_slides;
        pins += pattern.condensed().len() - of_slides;
        solved(&m, (&pattern, &mut saddle), &b, 1e-12);
    }
    assert!(pins > 20 && slides > 5 && solvable > 30, "{pins} {slides} {solvable}");
}

#[test]
fn condensed_rows_that_depend_on_each_other_are_refused() {
    let mut m = four_bar(&mut Random(29));
    m.push_slide(1, &mut Random(31));
    let n = m.entries.len();
    m.entries[n - 1] = m.entries[n - 2];
    m.masses.iter_mut().for_each(|mass| mass[1] = mass[0]);
    let (pattern, mut saddle) = m.condensed();
    assert_eq!(saddle.factor(&pattern), Err(Breakdown::Row(m.rows() - 2)));
    let mut x = vec![1.0; m.n()];
    assert!(saddle.factor_and_solve(&pattern, &mut x).is_err());
}

#[test]
fn mass_ratios_of_a_million_million_keep_the_digits() {
    let mut random = Random(13);
    for _ in 0..20 {
        let mut m = four_bar(&mut random);
        for (mass, scale) in m.masses.iter_mut().zip([1e-6, 1.0, 1e6]) {
            *mass = mass.map(|d| d * scale);
        }
        let pattern = m.pattern();
        let b = right_side(&m, &mut random);
        let mut x = b.clone();
        m.saddle(&pattern).factor_and_solve(&pattern, &mut x).unwrap();
        let reference = dense_solve(m.dense(), b.clone());
        let difference: Vec<f64> = x.iter().zip(&reference).map(|(a, b)| a - b).collect();
        let relative = norm(&difference) / norm(&reference);
        assert!(relative < 1e-11, "{relative:e}");
    }
}

#[test]
fn damping_stands_on_the_diagonal() {
    // W = I, A = (1 0 0): [1 1; 1 -μ] (x, λ) = (3, 1)
    let blocks = [RowBlock { size: 1, touches: vec![(0, 0)], signs: vec![] }];
    let pattern = Pattern::new(&[Group::body(false)], &blocks, &[]);
    let mut saddle = Saddle::new(&pattern);
    saddle.entries[0] = [1.0, 0.0, 0.0];
    saddle.damping.push(3.0);
    let mut x = [3.0, 0.0, 0.0, 1.0];
    saddle.factor_and_solve(&pattern, &mut x).unwrap();
    assert_eq!(x, [2.5, 0.0, 0.0, 0.5]);
}

#[test]
fn a_repeated_joint_is_refused_by_its_row_at_any_scale() {
    for scale in [1e-8, 1.0, 1e8] {
        let mut m = four_bar(&mut Random(11));
        let copied = m.blocks[3].clone();
        let first = m.entries.len();
        let from = copied.touches[0].1 / 3;
        for r in 0..copied.size {
            m.entries.push(m.entries[from + r].map(|e| scale * e));
        }
        let touches = vec![(copied.touches[0].0, 3 * first)];
        m.blocks.push(RowBlock { size: copied.size, touches, signs: vec![] });
        let pattern = m.pattern();
        let refused = m.saddle(&pattern).factor(&pattern).unwrap_err();
        let Breakdown::Row(row) = refused else { panic!("{refused:?}") };
        assert!((6..10).contains(&row), "{row}");
    }
}

#[test]
fn near_dependence_shows_as_cancellation() {
    // rows (1, 0) and (1, 1e-4) with W = I: the second pivot is 1e-8 out of 1, in one block or in two
    let apart = [0, 1].map(|r| RowBlock { size: 1, touches: vec![(0, 3 * r)], signs: vec![] });
    let together = [RowBlock { size: 2, touches: vec![(0, 0)], signs: vec![] }];
    for blocks in [&apart[..], &together[..]] {
        let pattern = Pattern::new(&[Group::body(false)], blocks, &[]);
        let mut saddle = Saddle::new(&pattern);
        saddle.entries.copy_from_slice(&[[1.0, 0.0, 0.0], [1.0, 1e-4, 0.0]]);
        saddle.factor(&pattern).unwrap();
        let (row, ratio) = saddle.cancellation(&pattern).unwrap();
        assert_eq!(row, 1);
        assert!((ratio / 1e-8 - 1.0).abs() < 1e-3, "{ratio:e}");
    }
}

#[test]
fn unusable_masses_and_rows_are_refused() {
    let blocks = [RowBlock { size: 1, touches: vec![(1, 0)], signs: vec![] }];
    let pattern = Pattern::new(&[Group::body(false); 2], &blocks, &[]);
    let good = [1.0, 2.0, 3.0];
    let refused = |group: usize, column: usize, inverse: f64, entries: [f64; 3]| {
        let mut saddle = Saddle::new(&pattern);
        let mut diagonal = [1.0; 3];
        diagonal[column] = inverse;
        saddle.masses[group] = InverseMass::diagonal(diagonal);
        saddle.entries[0] = entries;
        saddle.factor(&pattern).err()
    };
    assert_eq!(refused(0, 0, 1.0, good), None);
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(refused(0, 2, bad, good), Some(Breakdown::Column(2)), "{bad}");
        assert_eq!(refused(1, 0, bad, good), Some(Breakdown::Column(3)), "{bad}");
    }
    for bad in [0.0, f64::NAN, f64::INFINITY] {
        assert_eq!(refused(0, 0, 1.0, [0.0, bad, 0.0]), Some(Breakdown::Row(0)), "{bad}");
    }
    let mut lanes = Saddle::<Lanes>::new(&pattern);
    lanes.entries[0][0] = Lanes::new([1.0, 0.0, 1.0, 1.0]);
    assert_eq!(lanes.factor(&pattern), Err(Breakdown::Row(0)));
    let nothing = Pattern::new(&[], &[RowBlock { size: 2, touches: vec![], signs: vec![] }], &[]);
    assert_eq!(Saddle::<f64>::new(&nothing).factor(&nothing), Err(Breakdown::Row(0)));
}

#[test]
fn lanes_equal_scalars() {
    let mut random = Random(5);
    let designs: [Matrix; 4] = std::array::from_fn(|_| four_bar(&mut random));
    let pattern = designs[0].pattern();
    let mut saddle = Saddle::<Lanes>::new(&pattern);
    for (k, mass) in saddle.masses.iter_mut().enumerate() {
        let lane = |c: usize| Lanes::new(std::array::from_fn(|w| designs[w].masses[k][c]));
        *mass = inverse_mass(&std::array::from_fn(lane));
    }
    for (k, row) in saddle.entries.iter_mut().enumerate() {
        *row =
            std::array::from_fn(|c| Lanes::new(std::array::from_fn(|w| designs[w].entries[k][c])));
    }
    let mut x: Vec<Lanes> =
        (0..designs[0].n()).map(|_| Lanes::new(std::array::from_fn(|_| random.next()))).collect();
    let b = x.clone();
    saddle.factor_and_solve(&pattern, &mut x).unwrap();
    for (w, design) in designs.iter().enumerate() {
        let mut y: Vec<f64> = b.iter().map(|b| b.to_array()[w]).collect();
        design.saddle(&pattern).factor_and_solve(&pattern, &mut y).unwrap();
        let lane: Vec<f64> = x.iter().map(|x| x.to_array()[w]).collect();
        assert_eq!(lane, y);
    }
}

#[test]
fn dual_solutions_carry_the_derivative() {
    let mut random = Random(9);
    let m = four_bar(&mut random);
    let pattern = m.pattern();
    let slope: Vec<[f64; 3]> = m.entries.iter().map(|e| e.map(|_| random.next())).collect();
    let drift: Vec<[f64; 5]> = m.masses.iter().map(|d| d.map(|_| 0.1 * random.next())).collect();
    let b = right_side(&m, &mut random);
    let at = |h: f64| -> Vec<f64> {
        let mut moved = m.clone();
        let entries = moved.entries.as_flattened_mut().iter_mut();
        entries.zip(slope.as_flattened()).for_each(|(e, s)| *e += h * s);
        let masses = moved.masses.as_flattened_mut().iter_mut();
        masses.zip(drift.as_flattened()).for_each(|(d, s)| *d += h * s);
        let mut x = b.clone();
        moved.saddle(&pattern).factor_and_solve(&pattern, &mut x).unwrap();
        x
    };
    let dual = |value: f64, slope: f64| Dual { value, slope: [slope, 0.0, 0.0] };
    let mut saddle = Saddle::<Dual<3>>::new(&pattern);
    for ((mass, d), s) in saddle.masses.iter_mut().zip(&m.masses).zip(&drift) {
        *mass = inverse_mass(&std::array::from_fn(|c| dual(d[c], s[c])));
    }
    for ((row, e), s) in saddle.entries.iter_mut().zip(&m.entries).zip(&slope) {
        *row = std::array::from_fn(|c| dual(e[c], s[c]));
    }
    let mut x: Vec<Dual<3>> = b.iter().map(|&b| Dual::constant(b)).collect();
    saddle.factor_and_solve(&pattern, &mut x).unwrap();
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
fn fill_of_chains_and_rings_is_linear() {
    // a block tridiagonal: one block below each but the last; a ring doubles it
    assert_eq!(chain(2000, &mut Random(1)).pattern().fill(), 2000);
    let bodies = 500;
    let pins: Vec<_> =
        (0..bodies).map(|b| (b, Some((b + 1) % bodies))).chain([(0, None)]).collect();
    let fill = Matrix::mechanism(bodies, &pins, &mut Random(4)).pattern().fill();
    assert!(fill < 2 * bodies + 4, "{fill}");
}
