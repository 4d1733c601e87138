//! A circuit: the curve of positions through a given position, followed by arc length through all limits until it
//! closes.

use super::path::{DrivenPath, PathPoint};
use super::solution::Solver;
use crate::elements::BodyId;
use crate::math::Listed;
use crate::model::{size, Model};
use std::f64::consts::TAU;

/// First and longest step of the path, scaled.
const FIRST: f64 = 1e-3;
const LONGEST: f64 = 0.05;
/// Shortest step.
const SHORTEST: f64 = 1e-8;
/// Largest number of steps, and of turns of a driven angle.
const MOST: usize = 4000;
const MOST_TURNS: f64 = 8.0;
/// Largest travel of a driven length, relative to the size of the mechanism.
const FARTHEST: f64 = 20.0;
/// Largest difference between two positions that count as equal: angles in rad, lengths relative to the size of the
/// mechanism.
const SAME: f64 = 1e-6;

/// The same near a dead point, where Newton's method finds only half of the digits.
pub(in crate::analyses) const ALIKE: f64 = 1e-5;

/// Whether all bodies have the same position in `a` and `b`, up to whole turns.
pub(in crate::analyses) fn same(model: &Model, a: &[f64], b: &[f64], tolerance: f64) -> bool {
    let size = size(model);
    (1..model.bodies.len()).map(BodyId).all(|body| {
        let columns = model.layout.bodies[body.0];
        let pairs = columns.range().enumerate();
        pairs.map(|(c, k)| (c, b[k] - a[k])).all(|(c, d)| match c {
            2 => (d - TAU * (d / TAU).round()).abs() <= tolerance,
            _ => d.abs() <= tolerance * size,
        })
    })
}

/// The other positions on the circuit of a regular position `q` with the same value of t. If `turns` is set, the
/// driven value is an angle, and values that differ by whole turns count as equal.
pub(in crate::analyses) fn circuit(model: &Model, t: f64, q: &[f64], turns: bool) -> Vec<Vec<f64>> {
    let mut found = Vec::new();
    // a path that does not close is followed from its start in both directions
    if !follow(model, (t, q), turns, 1.0, &mut found) {
        follow(model, (t, q), turns, -1.0, &mut found);
    }
    found
}

/// Follows the path in one direction. Returns true if it closes or cannot begin.
fn follow(
    model: &Model,
    (t, q): (f64, &[f64]),
    turns: bool,
    sign: f64,
    found: &mut Vec<Vec<f64>>,
) -> bool {
    let mut solver = Solver::new(model);
    let Some(start) = solver.point(t, q.to_vec()) else { return true };
    let unit = solver.unit(&start).unwrap_or(1.0);
    let mut path = DrivenPath { solver: &mut solver, unit };
    let Some(mut place) = path.begin(&start, sign) else { return true };
    let period = if turns { TAU } else { f64::INFINITY };
    let farthest = if turns { MOST_TURNS * TAU } else { FARTHEST * size(model) };
    let mut ds = FIRST;
    for step in 0..MOST {
        let Some(next) = path.onward(&place, &mut ds) else {
            ds *= 0.5;
            if ds < SHORTEST {
                return false;
            }
            continue;
        };
        if let Some(level) = crossed(place.t - t, next.t - t, period).filter(|_| step > 0) {
            if let Some(there) = at_level(&mut path, &place, &next, (t + level, ds)) {
                if same(model, &there, q, SAME) && (next.t - place.t) * sign > 0.0 {
                    return true;
                }
                found.push(there);
            }
        }
        if (next.t - t).abs() > farthest {
            return false;
        }
        place = next;
        ds = (1.3 * ds).min(LONGEST);
    }
    false
}

/// The multiple of the period between two values, if any. Without a period, only 0 is considered.
fn crossed(a: f64, b: f64, period: f64) -> Option<f64> {
    if period.is_infinite() {
        return (a * b <= 0.0 && a != b && a != 0.0).then_some(0.0);
    }
    let (low, high) = (a.min(b), a.max(b));
    let level = period * (high / period).floor();
    (level >= low && level != a).then_some(level)
}

/// The position between two points of the path at which t equals `level`.
fn at_level(
    path: &mut DrivenPath<'_, '_>,
    from: &PathPoint,
    to: &PathPoint,
    (level, ds): (f64, f64),
) -> Option<Vec<f64>> {
    let n = from.q.len();
    let (mut low, mut high) = (from.clone(), to.clone());
    let (mut from_s, mut to_s) = (0.0, ds);
    for _ in 0..8 {
        let share = ((level - low.t) / (high.t - low.t)).clamp(0.0, 1.0);
        let guess: Vec<f64> = (0..n).map(|k| low.q[k] + share * (high.q[k] - low.q[k])).list();
        if let Some(point) = path.solver.point(level, guess.clone()) {
            let moved: Vec<f64> = (0..n).map(|k| point.q[k] - guess[k]).list();
            if path.solver.norm(&moved) <= 0.5 * ds {
                return Some(point.q);
            }
        }
        let s = 0.5 * (from_s + to_s);
        let middle = path.advance(from, s)?;
        if (middle.t - level) * (low.t - level) > 0.0 {
            (low, from_s) = (middle, s);
        } else {
            (high, to_s) = (middle, s);
        }
    }
    None
}
