//! Solutions of the true equations of motion with the factors of modified equations.
//!
//! The factors may be those of a matrix W = M + E with inertia added to light bodies, whose effect
//! `equations/take_back.rs` removes, and with damped rows if constraints are redundant. Let K be the true matrix, and
//! P the matrix of these solutions. The iteration x ← x + P⁻¹ (b - K x) then reduces rounding errors, the error of
//! redundant rows in proportion to their damping (the method of multipliers), and near singular positions the effect
//! of the ridge. The remainder is computed with K, so that the limit is exact. The same iteration corrects solutions of
//! `equations/downdates.rs` that have lost digits.

use super::augmented::Augmented;
use super::kinematics::Motions;
use super::mass::MassBlock;
use super::take_back::Directions;
use super::{constraints, mass};
use crate::math::{Largest, Real};
use crate::model::Model;
use crate::solve::Breakdown;
use std::ops::Range;

/// Number of corrections for redundant rows, each of which reduces the error by ten digits, and near singular
/// positions, where each multiplies the error by ε² / (σ² + ε²).
const FOR_REDUNDANCY: usize = 2;
/// Largest number of corrections for added inertia.
const MOST: usize = 6;
/// Remainder of an equation that is a rounding error, relative to the terms of the remainder.
const ROUNDING: f64 = 2e-15;
/// Relative size of a last correction. The error that remains is smaller by the same factor again.
const SMALL: f64 = 1e-9;
/// A larger remainder indicates a load on a coordinate without mass.
const SIGNIFICANT: f64 = 1e-9;
/// Smallest value of the terms relative to the largest term, so that bodies without load are not solved to more
/// digits than floating-point numbers have.
const LEAST: f64 = 1e-10;

/// Vectors of a solution, reused by the next one.
#[derive(Clone, Debug)]
pub struct Memory<S> {
    b: Vec<S>,
    /// |Φ_q|.
    magnitudes: Vec<S>,
    sizes: Vec<S>,
    terms: Vec<S>,
    correction: Vec<S>,
    masses: Vec<MassBlock<S>>,
    pub(super) directions: Directions<S>,
}

impl<S> Default for Memory<S> {
    fn default() -> Self {
        let [b, magnitudes, sizes, terms, correction] = [(); 5].map(|()| Vec::new());
        let (masses, directions) = (Vec::new(), Directions::default());
        Self { b, magnitudes, sizes, terms, correction, masses, directions }
    }
}

/// Solves K x = b. `x` contains b before and the solution afterwards, shape (n_q + n_rows).
///
/// # Errors
/// A load on a coordinate without mass or inertia that no joint supports.
pub fn solve<S: Real>(
    model: &Model<S>,
    motions: &Motions<S>,
    matrix: &Augmented<S>,
    x: &mut [S],
    memory: &mut Memory<S>,
) -> Result<(), Breakdown> {
    let Memory { b, magnitudes, sizes, terms, correction, masses, directions } = memory;
    let n = model.layout.n_q;
    b.clear();
    b.extend_from_slice(x);
    mass::put_blocks(model, motions, masses);
    let damped = matrix.regularised() || matrix.damps();
    let massless = directions.find(model, motions, matrix);
    let respond = |x: &mut [S]| {
        matrix.solve(x);
        let (a, lam) = x.split_at_mut(n);
        directions.take_back(a, lam);
    };
    respond(x);
    if matrix.additions().is_empty() {
        for _ in 0..FOR_REDUNDANCY {
            put_remainder(model, masses, matrix.jacobian(), (b, x), correction);
            respond(correction);
            x.iter_mut().zip(&*correction).for_each(|(x, dx)| *x += *dx);
        }
        return Ok(());
    }
    magnitudes.clear();
    magnitudes.extend(matrix.jacobian().iter().map(|x| x.abs()));
    let mut last = f64::INFINITY;
    for corrections in 0..MOST {
        put_remainder(model, masses, matrix.jacobian(), (b, x), correction);
        put_terms(model, masses, magnitudes, (b, x), sizes, terms);
        let left = largest(correction, terms);
        let needed = damped && corrections < FOR_REDUNDANCY;
        if !needed && (left <= ROUNDING || left > 0.5 * last) {
            last = left.min(last);
            break;
        }
        last = left;
        respond(correction);
        x.iter_mut().zip(&*correction).for_each(|(x, dx)| *x += *dx);
    }
    match massless {
        Some(column) if last > SIGNIFICANT => Err(Breakdown::Column(column)),
        _ => Ok(()),
    }
}

/// Corrects an inexact solution of K x = b with the factors of the matrix. The `solution` has the layout of the matrix,
/// b the shapes (n_q), (n_rows). Returns whether the solution is then exact to rounding errors.
pub(super) fn correct<S: Real>(
    model: &Model<S>,
    motions: &Motions<S>,
    matrix: &Augmented<S>,
    b: [&[S]; 2],
    solution: &mut [S],
    memory: &mut Memory<S>,
) -> bool {
    let Memory { correction, masses, .. } = memory;
    let (n, at, rows) = (model.layout.n_q, matrix.plan().n_unknowns(), model.layout.n_rows);
    mass::put_blocks(model, motions, masses);
    let least = [0.0, LEAST * most(b[0])];
    let mut last = f64::INFINITY;
    for _ in 0..MOST {
        correction.clear();
        correction.resize(solution.len(), S::zero());
        let (a, lam) = solution.split_at(at);
        let (upper, lower) = correction.split_at_mut(at);
        let x = [&a[..n], &lam[..rows]];
        put_parts(model, masses, matrix.jacobian(), b, x, [&mut upper[..n], &mut lower[..rows]]);
        matrix.solve(correction);
        solution.iter_mut().zip(&*correction).for_each(|(x, dx)| *x += *dx);
        let parts = [0..n, at..at + rows].into_iter().zip(least);
        let of_part = |(part, least): (Range<usize>, f64)| {
            let (change, size) = (most(&correction[part.clone()]), most(&solution[part]));
            if change == 0.0 {
                0.0
            } else {
                change / size.max(least)
            }
        };
        let change = parts.map(of_part).sum::<f64>(); // NaN if either is
        if change <= SMALL {
            return true;
        }
        if change.is_nan() || change > 0.5 * last {
            return false;
        }
        last = change;
    }
    false
}

/// The largest magnitude; NaN if a number is NaN.
fn most<S: Real>(x: &[S]) -> f64 {
    let mut largest = Largest::new();
    x.iter().for_each(|x| largest.add(*x));
    largest.get()
}

/// The largest remainder, relative to its terms.
fn largest<S: Real>(remainder: &[S], terms: &[S]) -> f64 {
    let part = |(r, terms): (&S, &S)| S::select(*terms, *r / *terms, S::zero());
    remainder.iter().zip(terms).map(|both| part(both).largest_magnitude()).fold(0.0, f64::max)
}

/// Computes b - K x into `out`.
fn put_remainder<S: Real>(
    model: &Model<S>,
    masses: &[MassBlock<S>],
    jacobian: &[S],
    (b, x): (&[S], &[S]),
    out: &mut Vec<S>,
) {
    let n = model.layout.n_q;
    out.clear();
    out.resize(x.len(), S::zero());
    let ((f, right), (a, lam), (upper, lower)) =
        (b.split_at(n), x.split_at(n), out.split_at_mut(n));
    put_parts(model, masses, jacobian, [f, right], [a, lam], [upper, lower]);
}

/// Computes b - K x into `out`, which is zero before. Coordinates and rows are given separately.
fn put_parts<S: Real>(
    model: &Model<S>,
    masses: &[MassBlock<S>],
    jacobian: &[S],
    [f, right]: [&[S]; 2],
    [a, lam]: [&[S]; 2],
    [upper, lower]: [&mut [S]; 2],
) {
    constraints::add_transposed(model, jacobian, lam, upper);
    mass::add_blocks(model, masses, a, upper);
    constraints::times_all(model, jacobian, a, lower);
    upper.iter_mut().zip(f).for_each(|(out, b)| *out = *b - *out);
    lower.iter_mut().zip(right).for_each(|(out, b)| *out = *b - *out);
}

/// Computes |b| + |M a| + |Φ_qᵀ| |λ| and |b| + |Φ_q| |a| into `out`, with the `magnitudes` of Φ_q. These are the
/// terms whose difference is the remainder. `sizes` is scratch memory.
fn put_terms<S: Real>(
    model: &Model<S>,
    masses: &[MassBlock<S>],
    magnitudes: &[S],
    (b, x): (&[S], &[S]),
    sizes: &mut Vec<S>,
    out: &mut Vec<S>,
) {
    let n = model.layout.n_q;
    sizes.clear();
    sizes.extend(x.iter().map(|x| x.abs()));
    out.clear();
    out.resize(x.len(), S::zero());
    let (upper, lower) = out.split_at_mut(n);
    mass::add_blocks(model, masses, &x[..n], upper);
    upper.iter_mut().for_each(|out| *out = out.abs());
    constraints::add_transposed(model, magnitudes, &sizes[n..], upper);
    constraints::times_all(model, magnitudes, &sizes[..n], lower);
    out.iter_mut().zip(b).for_each(|(out, b)| *out += b.abs());
    let (upper, lower) = out.split_at_mut(n);
    for part in [upper, lower] {
        let least = part.iter().copied().fold(S::zero(), S::max) * S::constant(LEAST);
        part.iter_mut().for_each(|out| *out = out.max(least));
    }
}
