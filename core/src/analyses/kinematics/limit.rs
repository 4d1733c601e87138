//! The limit of a motion: the extreme value of t on its path.

use super::dead_point::Limit;
use super::failure::{self, Reason};
use super::path::{DrivenPath, PathPoint};
use super::solution::Point;
use crate::math::Listed;
use crate::model::Model;

/// Part of the path to which a limit is located; the error of t is about its square.
const LOCATED: f64 = 1e-8;
/// Largest number of bisections.
const MOST: usize = 60;

/// Locates the limit between a point of the path and the point at the distance `ds` beyond it, where t has reversed.
pub(super) fn locate(
    path: &mut DrivenPath<'_, '_>,
    from: &PathPoint,
    ds: f64,
    sign: f64,
) -> Reason {
    let n = from.q.len();
    let forward = |place: &PathPoint| sign * place.tangent[n];
    let (mut low, mut high) = (0.0, ds);
    let mut best = from.clone();
    let mut values = [forward(from), -1.0];
    for k in 0..MOST {
        if high - low < LOCATED * ds {
            break;
        }
        // regula falsi, and bisection in every third trial
        let share = if k % 3 == 2 { 0.5 } else { values[0] / (values[0] - values[1]) };
        let middle = low + share.clamp(0.01, 0.99) * (high - low);
        let Some(place) = path.advance(from, middle) else { break };
        let value = forward(&place);
        if value.abs() < forward(&best).abs() {
            best = place;
        }
        if value > 0.0 {
            (low, values[0]) = (middle, value);
        } else {
            (high, values[1]) = (middle, value);
        }
    }
    let PathPoint { t, q, tangent, .. } = best;
    let rates: Vec<f64> =
        tangent.iter().zip(&path.solver.columns).map(|(x, scale)| x * scale).list();
    Reason::Limit(Box::new(Limit::new(path.solver.model, t, q, &rates)))
}

/// The reason for a motion that cannot be followed further although no limit was found.
pub(super) fn lost(model: &Model, from: &Point) -> Reason {
    failure::lost(model, from.t, &from.q)
}
