//! Solutions of the true equations of motion by factors of modified ones.
//!
//! The factors may be those of a matrix W with inertia added to bodies that have none, and with damped
//! rows where constraints are redundant. With K the true matrix, x ← x + W⁻¹ (b - K x) is repeated. The
//! remainder is computed with K, so the limit is exact. Each step multiplies the error of an angle with added
//! inertia ε by ε / (ε + J), where J is the inertia of the bodies that the angle moves through its joints. It
//! multiplies the error of redundant rows by their damping (the method of multipliers).

use super::augmented::Augmented;
use super::kinematics::Motions;
use super::{constraints, mass, Compiled};
use crate::math::Real;
use crate::model::Model;
use crate::solve::Breakdown;

/// Steps for redundant rows, whose error falls by ten digits in each, and near singular positions,
/// where it falls by ε² / (σ² + ε²).
const FOR_REDUNDANCY: usize = 2;
/// Most steps for added inertia: an angle that nothing resists does not converge at all.
const MOST: usize = 50;
/// Correction of accelerations, relative to the largest, that ends the steps.
const SETTLED: f64 = 1e-14;
/// Remainder of the equations that is rounding, relative to the largest load or multiplier. It ends the steps where no
/// body accelerates, so that corrections have no scale of their own.
const ROUNDING: f64 = 1e-13;
/// Correction that is accepted where rounding prevents a smaller one.
const ACCEPTED: f64 = 1e-9;

/// Solves K x = b; `x` contains b at first and the solution afterwards, shape (n_q + n_rows).
///
/// # Errors
/// The angle of a body without inertia on which a torque acts while no joint prevents its rotation.
pub(super) fn solve<S: Real>(
    (model, compiled): (&Model<S>, &Compiled<S>),
    motions: &Motions<S>,
    matrix: &Augmented<S>,
    x: &mut [S],
) -> Result<(), Breakdown> {
    let (b, correction) = (x.to_vec(), &mut *vec![S::zero(); x.len()]);
    let n = model.layout.n_q;
    matrix.solve(x);
    if matrix.regularised() || !compiled.adds_mass {
        for _ in 0..FOR_REDUNDANCY {
            step(model, motions, matrix, &b, x, correction);
        }
        return Ok(());
    }
    let mut last = f64::INFINITY;
    for _ in 0..MOST {
        let left = step(model, motions, matrix, &b, x, correction);
        let relative = largest(&correction[..n]) / largest(&x[..n]).max(f64::MIN_POSITIVE);
        if relative <= SETTLED || (relative <= ACCEPTED && relative >= 0.5 * last) {
            return Ok(());
        }
        if relative >= 0.5 * last && left <= ROUNDING * largest(&b).max(largest(&x[n..])) {
            return Ok(());
        }
        last = relative;
    }
    Err(Breakdown::Column(unresisted(model, &compiled.added_inertia, correction)))
}

/// One correction; returns the largest remainder before it.
fn step<S: Real>(
    model: &Model<S>,
    motions: &Motions<S>,
    matrix: &Augmented<S>,
    b: &[S],
    x: &mut [S],
    correction: &mut [S],
) -> f64 {
    remainder(model, motions, matrix.jacobian(), b, x, correction);
    let left = largest(correction);
    matrix.solve(correction);
    x.iter_mut().zip(correction.iter()).for_each(|(x, dx)| *x += *dx);
    left
}

/// b - K x.
fn remainder<S: Real>(
    model: &Model<S>,
    motions: &Motions<S>,
    jacobian: &[S],
    b: &[S],
    x: &[S],
    out: &mut [S],
) {
    let n = model.layout.n_q;
    let (a, lam) = x.split_at(n);
    let (upper, lower) = out.split_at_mut(n);
    upper.fill(S::zero());
    constraints::add_transposed(model, jacobian, lam, upper);
    mass::add_times(model, motions, a, upper);
    constraints::times_all(model, jacobian, a, lower);
    out.iter_mut().zip(b).for_each(|(out, b)| *out = *b - *out);
}

/// Largest magnitude over all entries and lanes.
fn largest<S: Real>(x: &[S]) -> f64 {
    let one = S::one();
    x.iter().map(|x| 1.0 / (one / *x).least_magnitude()).fold(0.0, f64::max)
}

/// The coordinate with added inertia that was corrected most.
fn unresisted<S: Real>(model: &Model<S>, added: &[S], correction: &[S]) -> usize {
    let bodies = model.layout.bodies[1..].iter().zip(added);
    let angles = bodies.filter(|(_, added)| added.least_magnitude() > 0.0);
    let angles = angles.map(|(columns, _)| columns.first + 2);
    let own = model.layout.owners[added.len()..].iter().flat_map(|columns| columns.range());
    let size = |column: &usize| largest(&correction[*column..=*column]);
    angles.chain(own).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(0)
}
