//! Solutions of the true equations of motion with the factors of modified equations.
//!
//! Let K be the matrix of the equations, and P the factorised one. P contains the inertia E of coordinates that have none
//! (`equations/light.rs`), damped rows if constraints are redundant, and near singular positions the ridge. The iteration
//! x ← x + P⁻¹ (b - K x) removes these differences, and the rounding errors that light bodies cause. For redundant rows
//! it is the method of multipliers. The remainder is computed with K, so that the limit is exact.

use super::augmented::Augmented;
use super::kinematics::Motions;
use super::mass::MassBlock;
use super::{constraints, mass};
use crate::math::{Largest, Listed, Real, ShortArray};
use crate::model::Model;
use crate::solve::Breakdown;
use std::ops::Range;

/// Number of corrections for redundant rows, each of which reduces the error by ten digits, and near singular
/// positions, where each multiplies the error by ε² / (σ² + ε²). Without them, one correction is the least: the first
/// solution is a correction of zero, so the ratio of the two shows by which factor a correction reduces the error.
const FEWEST: usize = 2;
/// Largest number of corrections for light bodies and coordinates.
const MOST: usize = 10;
/// Accepted error after the last correction, relative to the solution. It is estimated from the last two corrections,
/// whose ratio is that of the errors.
const ROUNDING: f64 = 1e-15;
/// A larger remainder, relative to its terms, indicates a load on a coordinate without mass.
const SIGNIFICANT: f64 = 1e-9;
/// Smallest multipliers, relative to the largest force, that are solved to all digits.
const LEAST: f64 = 1e-10;
/// Multipliers below this part of heaviest mass times largest acceleration are rounding errors.
const ROUNDED: f64 = 1e-12;
/// Smallest value of the terms of a remainder relative to the largest terms, so that rounding errors do not
/// count as loads.
const LEAST_TERMS: f64 = 1e-4;

/// Vectors of a solution, reused by the next one.
#[derive(Clone, Debug)]
pub struct Memory<S> {
    b: Vec<S>,
    solution: Vec<S>,
    correction: Vec<S>,
    masses: Vec<MassBlock<S>>,
}

impl<S> Default for Memory<S> {
    fn default() -> Self {
        let [b, solution, correction] = [(); 3].each(|()| Vec::new());
        Self { b, solution, correction, masses: Vec::new() }
    }
}

impl<S: Real> Memory<S> {
    /// Room for b of the next [`correct_direct`], in two parts of these lengths.
    #[inline(always)]
    pub(super) fn right_side(&mut self, [n, rows]: [usize; 2]) -> [&mut [S]; 2] {
        if self.b.len() != n + rows {
            self.b.resize(n + rows, S::zero());
        }
        self.b.split_at_mut(n).into()
    }
}

/// A model at a state, with the factors of its matrix.
type At<'a, S> = (&'a Model<S>, &'a Motions<S>, &'a Augmented<S>);

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
    let (n, at) = (model.layout.n_q, matrix.plan().n_unknowns());
    let mut b = std::mem::take(&mut memory.b);
    let mut solution = std::mem::take(&mut memory.solution);
    b.clear();
    b.extend_from_slice(x);
    solution.clear();
    solution.resize(at + x.len() - n, S::zero());
    solution[..n].copy_from_slice(&b[..n]);
    solution[at..].copy_from_slice(&b[n..]);
    matrix.solve(&mut solution);
    let (f, right) = b.split_at(n);
    let outcome = correct((model, motions, matrix), [f, right], FEWEST, &mut solution, memory);
    x[..n].copy_from_slice(&solution[..n]);
    x[n..].copy_from_slice(&solution[at..]);
    (memory.b, memory.solution) = (b, solution);
    outcome
}

/// [`correct`] for b of [`Memory::right_side`], without redundant rows.
pub(super) fn correct_direct<S: Real>(
    at: At<'_, S>,
    solution: &mut [S],
    memory: &mut Memory<S>,
) -> Result<(), Breakdown> {
    let b = std::mem::take(&mut memory.b);
    let (f, right) = b.split_at(at.0.layout.n_q);
    let outcome = correct(at, [f, right], 1, solution, memory);
    memory.b = b;
    outcome
}

/// Corrects a solution of K x = b with the factors of the matrix. The `solution` has the layout of the matrix, b the
/// shapes (n_q), (n_rows). At least the `fewest` corrections are made.
///
/// # Errors
/// A load on a coordinate without mass or inertia that no joint supports.
pub(super) fn correct<S: Real>(
    of: At<'_, S>,
    b: [&[S]; 2],
    fewest: usize,
    solution: &mut [S],
    memory: &mut Memory<S>,
) -> Result<(), Breakdown> {
    let (model, motions, matrix) = of;
    let Memory { correction, masses, .. } = memory;
    let (n, at, rows) = (model.layout.n_q, matrix.plan().n_unknowns(), model.layout.n_rows);
    mass::put_blocks(model, motions, masses);
    let (least, light) = ([0.0, LEAST * most(b[0])], matrix.is_light());
    // a ridge must stay where rows are dependent
    let settles = light && !matrix.regularised();
    let (mut last, first) = (f64::INFINITY, most(&solution[at..]));
    for corrections in 1..=MOST {
        put_remainder(of, masses, b, solution, correction);
        matrix.solve(correction);
        for (k, dx) in correction.iter().enumerate() {
            solution[k] += *dx;
        }
        let of_part = |(part, least): (Range<usize>, f64)| {
            let (change, size) = (most(&correction[part.clone()]), most(&solution[part]));
            if change == 0.0 {
                0.0
            } else {
                change / size.max(least)
            }
        };
        let change = [0..n, at..at + rows].into_iter().zip(least).map(of_part).sum::<f64>(); // NaN if either is
        let stays = change.is_nan() || last <= 1.0 && change > 0.5 * last;
        let settled = stays || change * change <= ROUNDING * last.min(1.0);
        last = change;
        if corrections >= fewest && (settled || !settles) {
            break;
        }
    }
    if !settles || last <= SIGNIFICANT {
        return Ok(());
    }
    put_remainder(of, masses, b, solution, correction);
    // multipliers may be rounding errors of those that accelerate the bodies
    let heaviest =
        model.bodies.iter().fold(0.0_f64, |most, body| most.max(body.mass.largest_magnitude()));
    let closes = |&[_, column, entry]: &[u32; 3]| {
        (matrix.jacobian()[entry as usize] * solution[column as usize]).largest_magnitude()
    };
    let moves = matrix.plan().positions.iter().map(closes).fold(0.0, f64::max);
    // and without forces, of those of the first solution
    let unloaded = if most(b[0]) <= LEAST * first { LEAST_TERMS * first } else { 0.0 };
    let rounded = unloaded.max(ROUNDED * heaviest * moves);
    let lam = solution[at..].iter().map(|x| x.abs().max(S::constant(rounded))).list();
    let terms = terms(model, masses, matrix.jacobian(), b, [&solution[..n], &lam]);
    significant(&correction[..n], &terms).map_or(Ok(()), |column| Err(Breakdown::Column(column)))
}

/// The largest magnitude; NaN if a number is NaN.
fn most<S: Real>(x: &[S]) -> f64 {
    let mut largest = Largest::new();
    for x in x {
        largest.add(*x);
    }
    largest.get()
}

/// The first column with a significant remainder relative to its terms.
fn significant<S: Real>(remainder: &[S], terms: &[S]) -> Option<usize> {
    let part = |(r, terms): (&S, &S)| S::select(*terms, *r / *terms, S::zero());
    let mut ratios = remainder.iter().zip(terms).map(|both| part(both).largest_magnitude());
    ratios.position(|ratio| ratio > SIGNIFICANT)
}

/// Computes b - K x into `out`, in the layout of the matrix.
fn put_remainder<S: Real>(
    (model, _, matrix): At<'_, S>,
    masses: &[MassBlock<S>],
    [f, right]: [&[S]; 2],
    x: &[S],
    out: &mut Vec<S>,
) {
    let (n, at, entries) = (f.len(), matrix.plan().n_unknowns(), matrix.jacobian());
    out.clear();
    out.resize(x.len(), S::zero());
    mass::add_blocks(model, masses, &x[..n], out);
    for k in 0..n {
        out[k] = f[k] - out[k];
    }
    out[at..].copy_from_slice(right);
    for &[row, column, entry] in &matrix.plan().positions {
        let (row, column, entry) = (at + row as usize, column as usize, entries[entry as usize]);
        out[column] = out[column].minus_product(entry, x[row]);
        out[row] = out[row].minus_product(entry, x[column]);
    }
}

/// |f| + |M a| + |Φ_qᵀ| |λ|, the terms whose difference is the remainder of each coordinate, shape (n_q).
fn terms<S: Real>(
    model: &Model<S>,
    masses: &[MassBlock<S>],
    jacobian: &[S],
    [f, _]: [&[S]; 2],
    [a, lam]: [&[S]; 2],
) -> Vec<S> {
    let sizes = |x: &[S]| x.iter().map(|x| x.abs()).list();
    let mut terms = vec![S::zero(); f.len()];
    mass::add_blocks(model, masses, a, &mut terms);
    terms = sizes(&terms);
    constraints::add_transposed(model, &sizes(jacobian), &sizes(lam), &mut terms);
    terms.iter_mut().zip(f).for_each(|(out, f)| *out += f.abs());
    let least = terms.iter().copied().fold(S::zero(), S::max) * S::constant(LEAST_TERMS);
    terms.into_iter().map(|term| term.max(least)).list()
}
