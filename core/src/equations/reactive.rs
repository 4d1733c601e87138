//! Forces that depend on reactions, such as friction in a joint.
//!
//! With them Q depends on λ, and the equations of motion are no longer linear:
//!
//! ```text
//! [ M   Φ_qᵀ ] [ q̈ ]   [ Q(λ) ]
//! [ Φ_q  0   ] [ λ ] = [ γ    ]
//! ```
//!
//! Only the multipliers u of the joints on which forces depend enter Q. Solving the linear equations with Q(u) gives
//! new multipliers u′(u), and Newton's method solves u′(u) - u = 0. Its start is the solution without these forces, so
//! that the result does not depend on earlier evaluations. Its matrix has one row for each of the few multipliers u; the
//! columns are differences.

use super::reactions;
use crate::math::Real;
use crate::model::Model;

/// Most iterations.
const MOST: usize = 30;
/// Relative size of the differences.
const DIFFERENCE: f64 = 1e-7;
/// Accepted change of the multipliers, relative to the largest.
const ACCEPTED: f64 = 1e-12;

/// The rows of the multipliers on which forces, or loads of joints, depend, ascending.
pub fn rows<S: Real>(model: &Model<S>) -> Vec<usize> {
    let joints = model.forces.iter().filter_map(|force| force.reaction.map(|joint| joint.0));
    let joints = joints.chain(reactions::loaded(model));
    let mut rows: Vec<usize> =
        joints.flat_map(|joint| model.layout.constraints[joint].rows.clone()).collect();
    rows.sort_unstable();
    rows.dedup();
    rows
}

/// Solves u′(u) = u for the multipliers in `rows`. `lam`, shape (n_rows), contains the multipliers without these forces,
/// and then the solution. `respond` gives all multipliers of the linear equations with Q at its argument.
///
/// Returns whether the iteration converged.
///
/// # Errors
/// That of `respond`.
pub(super) fn solve<S: Real, E>(
    rows: &[usize],
    lam: &mut [S],
    mut respond: impl FnMut(&[S]) -> Result<Vec<S>, E>,
) -> Result<bool, E> {
    let of = |lam: &[S]| -> Vec<S> { rows.iter().map(|row| lam[*row]).collect() };
    for _ in 0..MOST {
        let found = respond(lam)?;
        let gap: Vec<S> = of(&found).iter().zip(of(lam)).map(|(new, old)| *new - old).collect();
        if largest(&gap) <= ACCEPTED * largest(&found) {
            return Ok(true);
        }
        let h = S::constant(DIFFERENCE * largest(&found).max(f64::MIN_POSITIVE));
        let mut columns = Vec::with_capacity(rows.len());
        for (k, &row) in rows.iter().enumerate() {
            let kept = lam[row];
            lam[row] = kept + h;
            let moved = of(&respond(lam)?);
            lam[row] = kept;
            let mut column: Vec<S> =
                moved.iter().zip(of(&found)).map(|(moved, found)| (found - *moved) / h).collect();
            column[k] += S::one();
            columns.push(column);
        }
        eliminate(columns, gap).into_iter().zip(rows).for_each(|(step, row)| lam[*row] += step);
    }
    Ok(false)
}

/// Solves A x = b, where A is given by its columns, without pivoting: where A is far from the unit matrix, the iteration
/// does not converge anyway.
fn eliminate<S: Real>(mut columns: Vec<Vec<S>>, mut b: Vec<S>) -> Vec<S> {
    let n = b.len();
    for k in 0..n {
        for row in (0..n).filter(|row| *row != k) {
            let factor = columns[k][row] / columns[k][k];
            for column in columns.iter_mut().skip(k + 1) {
                let above = column[k];
                column[row] -= factor * above;
            }
            let above = b[k];
            b[row] -= factor * above;
        }
    }
    b.iter().enumerate().map(|(k, b)| *b / columns[k][k]).collect()
}

/// Largest magnitude over all entries and lanes; NaN where one is not a number.
fn largest<S: Real>(x: &[S]) -> f64 {
    let each = x.iter().map(|x| 1.0 / (S::one() / *x).least_magnitude());
    each.fold(0.0, |most, size| if most.is_nan() || size <= most { most } else { size })
}
