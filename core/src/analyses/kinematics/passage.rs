//! Positions near which steps in t become too short: change points and limits.

use super::failure::Reason;
use super::limit;
use super::path::{DrivenPath, PathPoint};
use super::solution::{Point, Solver};
use crate::math::Listed;

/// Longest step of the path, scaled.
const LONGEST: f64 = 1e-2;
/// Shortest step.
const SHORTEST: f64 = 1e-9;
/// Largest number of steps around a position where Φ_q is nearly singular.
const MOST: usize = 2000;

/// Follows the path by arc length past a position near which the steps in t become too short. The motion continues
/// beyond a change point and ends at a limit.
pub(super) fn around(solver: &mut Solver<'_>, from: &Point, goal: f64) -> Result<Point, Reason> {
    let sign = (goal - from.t).signum();
    let unit = solver.unit(from).unwrap_or_else(|| (goal - from.t).abs());
    let mut path = DrivenPath { solver, unit };
    let Some(mut place) = path.begin(from, sign) else {
        return Err(limit::lost(path.solver.model, from));
    };
    let mut ds = SHORTEST.sqrt();
    for _ in 0..MOST {
        let Some(next) = path.onward(&place, &mut ds) else {
            ds *= 0.5;
            if ds < SHORTEST {
                return Err(limit::lost(path.solver.model, from));
            }
            continue;
        };
        let forward = sign * next.tangent[next.q.len()];
        if forward <= 0.0 {
            return Err(limit::locate(&mut path, &place, ds, sign));
        }
        if sign * (next.t - goal) >= 0.0 {
            // the path passes the goal: the position there is interpolated and closed
            let PathPoint { t, q, .. } = &place;
            let share = (goal - t) / (next.t - t);
            let guess = q.iter().zip(&next.q).map(|(a, b)| a + share * (b - a)).list();
            return path
                .solver
                .point(goal, guess)
                .ok_or_else(|| limit::lost(path.solver.model, from));
        }
        let regular = forward > 0.1 && next.t != from.t;
        if let Some(point) = regular.then(|| path.solver.point(next.t, next.q.clone())).flatten() {
            return Ok(point);
        }
        place = next;
        ds = (1.5 * ds).min(LONGEST);
    }
    Err(limit::lost(path.solver.model, from))
}
