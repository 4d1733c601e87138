//! The branch parametrised by its arc length s in the space of (q, t), where it is a regular curve even if q is not a
//! function of t.
//!
//! With y = (q, t), scaled, a point of the curve solves Φ(y) = 0 and τᵀ(y - y₀) = s with the tangent τ at y₀
//! (Keller's pseudo-arclength continuation, in *Applications of Bifurcation Theory*, 1977).

use super::solution::{Point, Solver, CLOSED};
use crate::math::Listed;
use crate::solve::solve_dense;

/// Least cosine of the angle between the tangents at two neighbouring points.
const ALONG: f64 = 0.95;
/// Step below which the path crosses another branch, or passes it at a distance that rounding errors do not resolve,
/// and the step with which it does so.
const CROSSING: [f64; 2] = [1e-6, 1e-4];
/// Largest number of iterations.
const ITERATIONS: usize = 8;

/// A point of the path.
#[derive(Clone, Debug)]
pub(super) struct PathPoint {
    pub t: f64,
    pub q: Vec<f64>,
    /// The unit tangent (q′, t′), scaled.
    pub tangent: Vec<f64>,
    /// The sign of the determinant of Φ_q and Φ_t with the tangent as last row; see [`Solver::sign`]. It is constant
    /// along a branch, and another one on a branch that nearly crosses it.
    pub orientation: f64,
}

/// The path from a regular point.
pub(super) struct DrivenPath<'s, 'a> {
    pub solver: &'s mut Solver<'a>,
    /// Scale of t.
    pub unit: f64,
}

impl DrivenPath<'_, '_> {
    /// The path point of a regular point. Its tangent points towards increasing t if `sign` is positive. None if Φ_q is
    /// not square.
    pub fn begin(&mut self, from: &Point, sign: f64) -> Option<PathPoint> {
        let Point { t, q, v, .. } = from;
        let columns = &self.solver.columns;
        if self.solver.rows.len() != columns.len() {
            return None;
        }
        let mut tangent: Vec<f64> =
            v.iter().zip(columns).map(|(v, scale)| sign * v * self.unit / scale).list();
        tangent.push(sign);
        normalize(&mut tangent);
        let mut matrix = self.matrix(*t, q, &tangent);
        let orientation = self.solver.sign(&mut matrix, q.len() + 1);
        Some(PathPoint { t: *t, q: q.clone(), tangent, orientation })
    }

    /// The path point at the distance `ds` along the tangent, or beyond another branch that crosses the path there,
    /// which changes `ds`.
    pub fn onward(&mut self, from: &PathPoint, ds: &mut f64) -> Option<PathPoint> {
        let [least, length] = CROSSING;
        if let Some(next) = self.point(from, *ds, false) {
            return Some(next);
        }
        let crosses = *ds < least || from.orientation == 0.0;
        let next = crosses.then(|| self.point(from, length, true)).flatten()?;
        *ds = length;
        Some(next)
    }

    /// The path point at the distance `ds` along the tangent. None if Newton's method fails, if the tangent turns too
    /// far, or if the point lies on a neighbouring branch.
    pub fn advance(&mut self, from: &PathPoint, ds: f64) -> Option<PathPoint> {
        self.point(from, ds, false)
    }

    /// The path point at the distance `ds`, which lies beyond a singular position if the path `crosses` another branch.
    fn point(&mut self, from: &PathPoint, ds: f64, crosses: bool) -> Option<PathPoint> {
        let n = from.q.len();
        let columns = self.solver.columns.clone();
        let (mut q, mut t) = (from.q.clone(), from.t);
        let shift = |q: &mut [f64], t: &mut f64, step: &[f64], unit: f64| {
            for ((q, scale), dq) in q.iter_mut().zip(&columns).zip(step) {
                *q += scale * dq;
            }
            *t += unit * step[n];
        };
        let first: Vec<f64> = from.tangent.iter().map(|x| ds * x).list();
        shift(&mut q, &mut t, &first, self.unit);
        let mut last = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let phi = self.solver.phi(t, &q);
            let gap = phi.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            if gap.is_nan() {
                return None;
            }
            let mut matrix = self.matrix(t, &q, &from.tangent);
            // the right side of the last row is 0: corrections are normal to the tangent
            let mut step: Vec<f64> = phi.iter().map(|x| -x).chain([0.0]).list();
            if !solve_dense(&mut matrix.clone(), &mut step) {
                return None;
            }
            let size = step.iter().map(|x| x * x).sum::<f64>().sqrt();
            if gap > CLOSED && size >= 0.5 * last && size > 1e-14 {
                return None;
            }
            shift(&mut q, &mut t, &step, self.unit);
            last = size;
            if gap <= CLOSED {
                let mut tangent = vec![0.0; n + 1];
                tangent[n] = 1.0;
                solve_dense(&mut matrix.clone(), &mut tangent);
                normalize(&mut tangent);
                let cosine: f64 = tangent.iter().zip(&from.tangent).map(|(a, b)| a * b).sum();
                let orientation = self.solver.sign(&mut matrix, n + 1);
                let continues = (orientation == from.orientation && orientation != 0.0) != crosses;
                return (cosine >= ALONG && continues).then_some(PathPoint {
                    t,
                    q,
                    tangent,
                    orientation,
                });
            }
        }
        None
    }

    /// The matrix of Φ_q and Φ_t with the tangent as last row.
    fn matrix(&mut self, t: f64, q: &[f64], tangent: &[f64]) -> Vec<f64> {
        let mut matrix = self.solver.extended(t, q, self.unit);
        matrix.extend_from_slice(tangent);
        matrix
    }
}

fn normalize(x: &mut [f64]) {
    let length = x.iter().map(|x| x * x).sum::<f64>().sqrt();
    x.iter_mut().for_each(|x| *x /= length);
}
