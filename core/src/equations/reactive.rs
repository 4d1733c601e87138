//! Forces that depend on reactions, such as friction in a joint.
//!
//! With such forces Q depends on λ, and the equations of motion are no longer linear:
//!
//! ```text
//! [ M   Φ_qᵀ ] [ q̈ ]   [ Q(λ) ]
//! [ Φ_q  0   ] [ λ ] = [ γ    ]
//! ```
//!
//! Q depends only on the multipliers u of the joints whose reactions the forces use. The linear equations with Q(u)
//! have new multipliers u′(u). Newton's method solves u′(u) = u with the matrix I - ∂u′/∂u, which has one row for
//! each of the few multipliers u; its columns are exact.
//!
//! There may be several solutions or none. The solution of the motion is the one that follows continuously from the
//! solution u₀ without these forces, as a factor f on the forces grows from 0 to 1: u = (1 - f) u₀ + f u′(u), because
//! u′ is linear in Q. The determinant of I - f ∂u′/∂u is 1 at f = 0. If it becomes zero before f = 1, the forces
//! exceed the reactions that balance them: a friction paradox (Painlevé 1895). Newton's method begins at u₀ with f =
//! 1. Only if it fails, f grows in steps. The result does not depend on earlier evaluations.

use super::reaction_slopes::rows_of;
use super::reactions;
use crate::math::{Largest, Listed, Real};
use crate::model::Model;

/// Largest number of iterations for one factor of the forces.
const MOST: usize = 12;
/// Accepted change of the multipliers, relative to the largest of the solved multipliers.
const ACCEPTED: f64 = 1e-12;
/// Accepted change of the multipliers, relative to the largest multiplier of the mechanism, if the change no longer
/// decreases.
const ROUNDING: f64 = 1e-10;
/// Size, relative to the largest force, of a load that is a rounding error. Its direction, and with it the friction,
/// is arbitrary.
const NOISE: f64 = 1e-13;
/// The first and the smallest step of the factor of the forces.
const FIRST: f64 = 0.25;
const LEAST: f64 = 1e-5;

/// Whether forces depend on reactions. If so, the motion depends on the loads of joints.
pub fn depends<S: Real>(model: &Model<S>) -> bool {
    model.forces.iter().any(|force| force.reaction.is_some())
}

/// The rows of the multipliers on which forces or loads of joints depend, ascending.
pub fn rows<S: Real>(model: &Model<S>) -> Vec<usize> {
    let of_loads =
        reactions::loaded(model).flat_map(|joint| model.layout.constraints[joint].rows.clone());
    let mut rows: Vec<usize> = of_loads.list();
    (0..model.forces.len()).flat_map(|k| rows_of(model, k)).append_to(&mut rows);
    rows.sort_unstable();
    rows.dedup();
    rows
}

/// The linear equations, with forces at given multipliers.
pub(super) trait Response<S> {
    /// The reason why the linear equations have no solution.
    type Error;
    /// All multipliers, shape (n_rows), with Q at the multipliers `lam`.
    fn multipliers(&mut self, lam: &[S]) -> Result<Vec<S>, Self::Error>;
    /// The largest generalized force at the last multipliers.
    fn largest_force(&self) -> f64;
    /// The derivatives of all multipliers with respect to the multiplier of one row in Q, shape (n_rows).
    fn slopes(&mut self, lam: &[S], row: usize) -> Result<Vec<S>, Self::Error>;
}

/// Solves u′(u) = u for the multipliers in `rows`. `lam`, shape (n_rows), contains the multipliers without these
/// forces, and on return the solution.
///
/// Returns whether there is a solution that follows continuously from the multipliers without these forces.
///
/// # Errors
/// The errors of the linear equations.
pub(super) fn solve<S: Real, R: Response<S>>(
    rows: &[usize],
    lam: &mut [S],
    response: &mut R,
) -> Result<bool, R::Error> {
    let free = lam.to_vec();
    let mut path = Path { rows, free: &free, response };
    if path.newton(lam, S::one())? {
        return Ok(true);
    }
    if !free.iter().all(|x| x.is_finite()) {
        return Ok(true); // the solution is not finite either
    }
    lam.copy_from_slice(&free);
    let (mut factor, mut step) = (0.0, FIRST);
    while factor < 1.0 {
        let next = f64::min(factor + step, 1.0);
        let mut trial = lam.to_vec();
        if path.newton(&mut trial, S::constant(next))? {
            lam.copy_from_slice(&trial);
            (factor, step) = (next, 2.0 * step);
        } else if step < LEAST {
            return Ok(false);
        } else {
            step *= 0.25;
        }
    }
    Ok(true)
}

/// The solutions for all factors of the forces.
struct Path<'a, S, R> {
    rows: &'a [usize],
    /// The multipliers without the forces.
    free: &'a [S],
    response: &'a mut R,
}

impl<S: Real, R: Response<S>> Path<'_, S, R> {
    fn of(&self, lam: &[S]) -> Vec<S> {
        self.rows.iter().map(|row| lam[*row]).list()
    }

    /// Newton's method from `lam`. Returns whether it converged with positive determinants.
    fn newton(&mut self, lam: &mut [S], factor: S) -> Result<bool, R::Error> {
        let free = self.of(self.free);
        let mut last = f64::INFINITY;
        for _ in 0..MOST {
            let found = self.response.multipliers(lam)?;
            let own = self.of(&found).into_iter().zip(&free).zip(self.of(lam));
            let gap: Vec<S> =
                own.map(|((new, free), old)| *free + factor * (new - *free) - old).list();
            let (size, left) = (largest(&self.of(&found)), largest(&gap));
            let noise = NOISE * self.response.largest_force().max(largest(&found));
            if size <= noise {
                return Ok(true);
            }
            let columns = self.columns(lam, factor)?;
            let Some(step) = eliminate(columns, gap) else { return Ok(false) };
            let rounding = noise.max(ROUNDING * largest(&found));
            if left <= ACCEPTED * size || (left >= last && left <= rounding) {
                return Ok(true);
            }
            last = left;
            step.into_iter().zip(self.rows).for_each(|(step, row)| lam[*row] += step);
        }
        Ok(false)
    }

    /// I - f ∂u′/∂u, by columns.
    fn columns(&mut self, lam: &[S], factor: S) -> Result<Vec<Vec<S>>, R::Error> {
        let mut columns = Vec::with_capacity(self.rows.len());
        for (k, row) in self.rows.iter().enumerate() {
            let slopes = self.response.slopes(lam, *row)?;
            let mut column: Vec<S> =
                self.of(&slopes).into_iter().map(|slope| -(factor * slope)).list();
            column[k] += S::one();
            columns.push(column);
        }
        Ok(columns)
    }
}

/// Solves A x = b, where A is given by its columns. None if the determinant of A is not positive.
///
/// Rows are not exchanged. If A is far from the unit matrix, the factor of the forces takes smaller steps.
fn eliminate<S: Real>(mut columns: Vec<Vec<S>>, mut b: Vec<S>) -> Option<Vec<S>> {
    let n = b.len();
    let mut determinant = S::one();
    for k in 0..n {
        let pivot = columns[k][k];
        determinant = determinant * S::select(pivot, S::one(), -S::one());
        for row in (0..n).filter(|row| *row != k) {
            let factor = columns[k][row] / pivot;
            for column in columns.iter_mut().skip(k + 1) {
                let above = column[k];
                column[row] -= factor * above;
            }
            let above = b[k];
            b[row] -= factor * above;
        }
    }
    let positive = determinant.in_lanes().iter().all(|sign| *sign > 0.0);
    let x: Vec<S> = b.iter().enumerate().map(|(k, b)| *b / columns[k][k]).list();
    (positive && x.iter().all(|x| x.is_finite())).then_some(x)
}

/// Largest magnitude over all entries and lanes. NaN if an entry is NaN.
pub(super) fn largest<S: Real>(x: &[S]) -> f64 {
    let mut largest = Largest::new();
    x.iter().for_each(|x| largest.add(*x));
    largest.get()
}
