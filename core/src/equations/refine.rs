//! Solutions of the true equations of motion by factors of modified ones.
//!
//! The factors may be those of a matrix W with inertia added to bodies that have none, and with damped
//! rows where constraints are redundant. With K the true matrix, x ← x + W⁻¹ (b - K x) is repeated: the
//! remainder is computed with K alone, so that what it converges to is exact. Each step multiplies the
//! error of an angle with the inertia ε added by ε / (ε + J), J being what the angle has to turn through
//! its joints; that of redundant rows by their damping (the method of multipliers).

use super::augmented::{Augmented, Dependent};
use super::{constraints, mass, Compiled};
use crate::math::{Motion, Real};
use crate::model::Model;

/// Steps for redundant rows, whose error falls by ten digits in each, and near singular positions,
/// where it falls by ε² / (σ² + ε²).
const FOR_REDUNDANCY: usize = 2;
/// Most steps for added inertia: an angle that nothing resists does not converge at all.
const MOST: usize = 50;
/// Corrections of accelerations so small, relative to the largest, end the steps.
const SETTLED: f64 = 1e-14;
/// Where rounding keeps them from getting so small, this is accepted.
const ACCEPTED: f64 = 1e-9;

/// Solves K x = b; `x` comes with b and leaves with the solution, shape (n_q + n_rows).
///
/// # Errors
/// The angle of a body without inertia that a torque turns while nothing resists.
pub(super) fn solve<S: Real>(
    (model, compiled): (&Model<S>, &Compiled<S>),
    motions: &[Motion<S>],
    matrix: &Augmented<S>,
    x: &mut [S],
) -> Result<(), Dependent> {
    let (b, correction) = (x.to_vec(), &mut *vec![S::zero(); x.len()]);
    let n = model.layout.n_q;
    matrix.solve(x);
    if matrix.regularised() || !compiled.has_added_inertia() {
        for _ in 0..FOR_REDUNDANCY {
            step(model, motions, matrix, &b, x, correction);
        }
        return Ok(());
    }
    let mut last = f64::INFINITY;
    for _ in 0..MOST {
        step(model, motions, matrix, &b, x, correction);
        let relative = largest(&correction[..n]) / largest(&x[..n]).max(f64::MIN_POSITIVE);
        if relative <= SETTLED || (relative <= ACCEPTED && relative >= 0.5 * last) {
            return Ok(());
        }
        last = relative;
    }
    Err(Dependent::Column(unresisted(&compiled.added_inertia, correction)))
}

fn step<S: Real>(
    model: &Model<S>,
    motions: &[Motion<S>],
    matrix: &Augmented<S>,
    b: &[S],
    x: &mut [S],
    correction: &mut [S],
) {
    remainder(model, motions, matrix.jacobian(), b, x, correction);
    matrix.solve(correction);
    x.iter_mut().zip(correction.iter()).for_each(|(x, dx)| *x += *dx);
}

/// b - K x.
fn remainder<S: Real>(
    model: &Model<S>,
    motions: &[Motion<S>],
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
    let bodies = model.bodies.iter().zip(motions).skip(1);
    for ((out, a), (body, motion)) in upper.chunks_exact_mut(3).zip(a.chunks_exact(3)).zip(bodies) {
        let inertial = mass::block(body, motion).times([a[0], a[1], a[2]]);
        out.iter_mut().zip(inertial).for_each(|(out, f)| *out += f);
    }
    for (k, slots) in model.layout.constraints.iter().enumerate() {
        constraints::times(model, k, jacobian, a, &mut lower[slots.rows.clone()]);
    }
    out.iter_mut().zip(b).for_each(|(out, b)| *out = *b - *out);
}

/// Largest magnitude over all entries and lanes.
fn largest<S: Real>(x: &[S]) -> f64 {
    let one = S::one();
    x.iter().map(|x| 1.0 / (one / *x).least_magnitude()).fold(0.0, f64::max)
}

/// The angle with added inertia that was corrected most.
fn unresisted<S: Real>(added: &[S], correction: &[S]) -> usize {
    let angles = (0..added.len()).filter(|b| added[*b].least_magnitude() > 0.0);
    let size = |column: &usize| largest(&correction[*column..=*column]);
    let most = angles.map(|b| 3 * b + 2).max_by(|a, b| size(a).total_cmp(&size(b)));
    most.unwrap_or(0)
}
