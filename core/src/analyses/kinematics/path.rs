//! The branch parametrised by its arc length s in the space of (q, t), where it is a regular curve even if q is not a
//! function of t.
//!
//! With y = (q, t), scaled, a point of the curve solves Φ(y) = 0 and τᵀ(y - y₀) = s with the tangent τ at y₀
//! (Keller's pseudo-arclength continuation, in *Applications of Bifurcation Theory*, 1977).

use super::solution::{Point, Solver};
use crate::math::Listed;
use crate::solve::solve_dense;

/// Least cosine of the angle between the tangents at two neighbouring points.
const ALONG: f64 = 0.95;
/// Scaled residual of a closed position, and largest number of iterations.
const CLOSED: f64 = 1e-13;
const ITERATIONS: usize = 8;

/// A point of the path.
#[derive(Clone, Debug)]
pub(super) struct PathPoint {
    pub t: f64,
    pub q: Vec<f64>,
    /// The unit tangent (q′, t′), scaled.
    pub tangent: Vec<f64>,
}

/// The path from a regular point.
pub(super) struct DrivenPath<'s, 'a> {
    pub solver: &'s mut Solver<'a>,
    /// Scale of t.
    pub unit: f64,
}

impl DrivenPath<'_, '_> {
    /// The path point of a regular point. Its tangent points towards increasing t if `sign` is positive.
    pub fn begin(&mut self, from: &Point, sign: f64) -> Option<PathPoint> {
        let columns = &self.solver.columns;
        let mut tangent: Vec<f64> =
            from.v.iter().zip(columns).map(|(v, scale)| sign * v * self.unit / scale).list();
        tangent.push(sign);
        normalize(&mut tangent);
        Some(PathPoint { t: from.t, q: from.q.clone(), tangent })
    }

    /// The path point at the distance `ds` along the tangent. None if Newton's method fails or the tangent turns too
    /// far.
    pub fn advance(&mut self, from: &PathPoint, ds: f64) -> Option<PathPoint> {
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
            let done = gap <= CLOSED;
            // the right side of the last row is 0: corrections are normal to the tangent
            let mut right: Vec<f64> = phi.iter().map(|x| -x).list();
            right.push(0.0);
            if done {
                right.fill(0.0);
                right[n] = 1.0;
            }
            let step = self.solved(t, &q, &from.tangent, right)?;
            if done {
                let mut tangent = step;
                normalize(&mut tangent);
                let cosine: f64 = tangent.iter().zip(&from.tangent).map(|(a, b)| a * b).sum();
                return (cosine >= ALONG).then_some(PathPoint { t, q, tangent });
            }
            let size = step.iter().map(|x| x * x).sum::<f64>().sqrt();
            if size >= 0.5 * last && size > 1e-14 {
                return None;
            }
            shift(&mut q, &mut t, &step, self.unit);
            last = size;
        }
        None
    }

    /// Solves the linear system whose matrix consists of Φ_q and Φ_t with the tangent as last row.
    fn solved(
        &mut self,
        t: f64,
        q: &[f64],
        tangent: &[f64],
        mut right: Vec<f64>,
    ) -> Option<Vec<f64>> {
        let mut matrix = self.solver.extended(t, q, self.unit);
        matrix.extend_from_slice(tangent);
        solve_dense(&mut matrix, &mut right).then_some(right)
    }
}

fn normalize(x: &mut [f64]) {
    let length = x.iter().map(|x| x * x).sum::<f64>().sqrt();
    x.iter_mut().for_each(|x| *x /= length);
}
