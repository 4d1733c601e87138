//! The block factorisation against the definition of a solution, real and complex, and its cost.

use crate::mechanisms::Random;
use kempe::math::{Complex, Field};
use kempe::solve::{BlockLu, LuPlan};

/// A chain of `n` bodies, coupled with their neighbours, each joined to the one before (or ground).
struct Chain {
    sizes: Vec<usize>,
    entries: Vec<(usize, usize)>,
    bodies: usize,
}

fn chain(n: usize) -> Chain {
    let joints = (0..n).map(|k| 1 + k % 3 % 2 + usize::from(k % 5 == 0));
    let mut entries = Vec::new();
    for k in 0..n {
        entries.push((n + k, k));
        if k > 0 {
            entries.push((n + k, k - 1));
            entries.push((k, k - 1));
        }
    }
    Chain { sizes: std::iter::repeat_n(3, n).chain(joints).collect(), entries, bodies: n }
}

/// Fills matrix and full copy; bodies dominated by their diagonal, constraints without one.
fn filled<F: Field>(
    chain: &Chain,
    plan: &LuPlan,
    mut number: impl FnMut() -> F,
) -> (BlockLu<F>, Vec<Vec<F>>) {
    let starts: Vec<usize> =
        (0..chain.sizes.len()).map(|b| chain.sizes[..b].iter().sum()).collect();
    let n = plan.unknowns();
    let mut full = vec![vec![F::zero(); n]; n];
    let mut lu = BlockLu::new(plan);
    lu.clear(plan);
    let mut put = |row: usize, column: usize, diagonal: f64| {
        for r in 0..chain.sizes[row] {
            for c in 0..chain.sizes[column] {
                let extra = if r == c { F::from_real(diagonal) } else { F::zero() };
                let entry = number() + extra;
                lu.block_mut(plan.slot(row, column))[r][c] = entry;
                full[starts[row] + r][starts[column] + c] = entry;
            }
        }
    };
    (0..chain.bodies).for_each(|b| put(b, b, 12.0));
    for &(a, b) in &chain.entries {
        let joined = if a >= chain.bodies { 3.0 } else { 0.0 };
        put(a, b, joined);
        put(b, a, joined);
    }
    (lu, full)
}

fn worst_residual<F: Field>(full: &[Vec<F>], x: &[F], b: &[F]) -> f64 {
    let mut worst = 0.0;
    for (row, b) in full.iter().zip(b) {
        let mut sum = -*b;
        row.iter().zip(x).for_each(|(e, x)| sum += *e * *x);
        worst = f64::max(worst, sum.magnitude());
    }
    worst
}

fn solves<F: Field>(mut number: impl FnMut() -> F) {
    for n in [1, 2, 3, 7, 20] {
        let chain = chain(n);
        let plan = LuPlan::new(chain.sizes.clone(), n, &chain.entries);
        let (mut lu, full) = filled(&chain, &plan, &mut number);
        lu.factor(&plan).expect("it is regular");
        let b: Vec<F> = (0..plan.unknowns()).map(|_| number()).collect();
        let mut x = b.clone();
        lu.solve(&plan, &mut x);
        let residual = worst_residual(&full, &x, &b);
        assert!(residual < 1e-12, "{n}: {residual:.1e}");
    }
}

#[test]
fn real_systems_are_solved() {
    let mut random = Random::new(1);
    solves(move || random.next());
}

#[test]
fn complex_systems_are_solved() {
    let mut random = Random::new(2);
    solves(move || Complex::new(random.next(), random.next()));
}

#[test]
fn dependent_rows_are_refused() {
    let sizes = vec![3, 1, 1];
    let plan = LuPlan::new(sizes, 1, &[(1, 0), (2, 0)]);
    let mut lu = BlockLu::<f64>::new(&plan);
    lu.clear(&plan);
    for d in 0..3 {
        lu.block_mut(plan.slot(0, 0))[d][d] = 2.0 + d as f64;
    }
    for (row, factor) in [(1, 1.0), (2, -3.0)] {
        for c in 0..3 {
            let entry = factor * (1.0 + 0.3 * c as f64);
            lu.block_mut(plan.slot(row, 0))[0][c] = entry;
            lu.block_mut(plan.slot(0, row))[c][0] = entry;
        }
    }
    let refused = lu.factor(&plan).expect_err("two rows are multiples of each other");
    assert!(refused == 3 || refused == 4, "{refused}");
}

/// Twice the chain, twice the memory: no fill beyond the neighbours, coupled bodies or not.
#[test]
fn memory_grows_with_the_length_of_a_chain() {
    let stored = |n: usize| {
        let chain = chain(n);
        LuPlan::new(chain.sizes.clone(), n, &chain.entries).stored()
    };
    let (short, long) = (stored(500), stored(1000));
    assert!(long <= 2 * short + 10, "{short} {long}");
    assert!(long < 1000 * 14, "{long}");
}
