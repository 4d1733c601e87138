//! Degrees of freedom and redundant constraints.
//!
//! The rank is the rank of the row-scaled Φ_q. If an equation depends on the others, it is omitted and the mechanism
//! is moved slightly. If the equation still holds, it is redundant; if not, it restricts the motion, and the position
//! is singular. Several dependent equations may restrict the motion together. They are therefore examined at a
//! neighbouring admissible position if fewer equations are dependent there. The left null vectors of Φ_q show all
//! joints that take part in a dependence.

use super::closing::{Closing, Halt};
use super::dependence::{self, Dependent, MOST_DENSE};
use crate::elements::{BodyId, Coordinate, CoordinateOf};
use crate::equations::augmented::Augmented;
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::math::Listed;
use crate::model::{column_scales, row_scales, Model};
use crate::solve::RANK_TOLERANCE;
use std::sync::Arc;

/// The rank is certain if all pivots keep this fraction of their magnitude.
const BEYOND_DOUBT: f64 = 1e-7;
/// Size of the excursion to a neighbouring position, rad.
const EXCURSION: f64 = 3e-3;
/// Size of the excursion without the dependent equations, rad: small compared with [`EXCURSION`], so that the
/// mechanism stays on its branch.
const EXCURSION_WITHOUT: f64 = 3e-4;
/// Largest residual of an equation that holds, relative to the size of the mechanism. Other equations have a residual
/// of the order of the squared excursion.
const HOLDS: f64 = 1e-11;
/// Largest residual as a multiple of the opening of the joints at the start, for lengths that do not match exactly.
/// An excursion changes this residual by a fraction of itself.
const MISMATCH: f64 = 10.0;
/// Largest number of bodies whose angles are tried to reach a neighbouring position, and of excursions without the
/// dependent equations.
pub(super) const EXCURSIONS: usize = 6;

/// The mobility of a mechanism at a position.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mobility {
    /// Number of coordinates minus number of independent constraint equations.
    pub degrees_of_freedom: usize,
    /// Number of independent constraint equations.
    pub rank: usize,
    /// Groups of constraints (indices) that repeat each other. Consecutive equations with equal groups share an
    /// entry.
    pub redundant: Vec<Vec<usize>>,
    /// Groups of constraints that depend on each other only at this position, as in `redundant`.
    pub singular: Vec<Vec<usize>>,
    /// The equations that repeat others. [`Mobility::redundant`] contains their groups.
    pub redundant_equations: Vec<Dependent>,
    /// The equations that depend on others only at this position.
    pub singular_equations: Vec<Dependent>,
    /// The equations that depend on others in every position, because they hold only to second order.
    pub second_order: Vec<Dependent>,
    /// The coordinates, or differences of angles, that these equations keep constant.
    pub kept: Vec<String>,
}

/// Mobility without the linear constraints that equations of second order imply.
pub(super) fn plain(model: &Model, t: f64, q: &[f64], stop: Halt<'_>) -> Mobility {
    let (n, m) = (model.layout.n_q, model.layout.n_rows);
    let here = dependent_equations(model, t, q, stop);
    if here.is_empty() {
        return Mobility { degrees_of_freedom: n - m, rank: m, ..Mobility::default() };
    }
    let rank = m - here.len();
    let [redundant_equations, singular_equations] = judge(model, t, q, here, stop);
    let groups = |equations: &[Dependent]| {
        let mut groups: Vec<Vec<usize>> = equations.iter().map(|e| e.group.clone()).list();
        groups.dedup();
        groups
    };
    Mobility {
        degrees_of_freedom: n.saturating_sub(rank),
        rank,
        redundant: groups(&redundant_equations),
        singular: groups(&singular_equations),
        redundant_equations,
        singular_equations,
        ..Mobility::default()
    }
}

/// The equations that depend on others at a position, redundant or only there. The result is invalid if `stop`
/// returned true.
pub(super) fn dependent_equations(
    model: &Model,
    t: f64,
    q: &[f64],
    stop: Halt<'_>,
) -> Vec<Dependent> {
    match beyond_doubt(model, t, q) {
        true => Vec::new(),
        false => dependence::at(model, t, q, RANK_TOLERANCE, stop),
    }
}

/// The redundant equations, and the equations that are dependent only at this position.
fn judge(
    model: &Model,
    t: f64,
    q: &[f64],
    here: Vec<Dependent>,
    stop: Halt<'_>,
) -> [Vec<Dependent>; 2] {
    let found = split(model, t, q, &here, stop);
    if found[1].len() < 2 {
        return found;
    }
    let mut best: Option<(Vec<f64>, Vec<Dependent>)> = None;
    for held in (0..=EXCURSIONS).take_while(|_| !stop()) {
        let Some(near) = neighbour(model, t, q, held, stop) else { continue };
        let there = dependence::at(model, t, &near, RANK_TOLERANCE, stop);
        let fewest = best.as_ref().map_or(&here, |(_, dependent)| dependent).len();
        if there.len() < fewest {
            let full = there.is_empty();
            best = Some((near, there));
            if full {
                break;
            }
        }
    }
    match best {
        Some((near, there)) => {
            let [redundant, _] = split(model, t, &near, &there, stop);
            [redundant, here]
        }
        None => found,
    }
}

/// The equations that still hold near a position when they are omitted, and the others.
fn split(
    model: &Model,
    t: f64,
    q: &[f64],
    dependent: &[Dependent],
    stop: Halt<'_>,
) -> [Vec<Dependent>; 2] {
    let rows: Vec<usize> = dependent.iter().map(|one| one.row).list();
    if rows.is_empty() {
        return [Vec::new(), Vec::new()];
    }
    let mut closing = Closing::new(model, t, stop).without(&rows);
    let scales = row_scales(model);
    let mismatch =
        closing.phi(q).iter().zip(&scales).fold(0.0, |most: f64, (x, s)| most.max((x / s).abs()));
    let small = HOLDS.max(MISMATCH * mismatch);
    let mut holds = vec![true; rows.len()];
    // one excursion may by chance keep an equation almost satisfied
    for number in 0..EXCURSIONS {
        let mut near = moved(model, q, EXCURSION_WITHOUT, number);
        if !closing.close(&mut near).1 {
            continue;
        }
        let phi = closing.phi(&near);
        for (row, holds) in rows.iter().zip(&mut holds) {
            *holds &= phi[*row].abs() <= small * scales[*row];
        }
        if !holds.contains(&true) {
            break;
        }
    }
    let mut split = [Vec::new(), Vec::new()];
    for (holds, one) in holds.iter().zip(dependent) {
        split[usize::from(!holds)].push(one.clone());
    }
    split
}

/// Remainder of a row that counts as dependent near a singular position.
const NEAR: f64 = 0.05;

/// The constraints (indices) that depend on each other at or near a position. The constraint with `row` is one of
/// them.
pub(super) fn dependent(model: &Model, t: f64, q: &[f64], row: usize) -> Vec<usize> {
    let own = model.layout.owner(row).0;
    if model.layout.n_rows > MOST_DENSE {
        return vec![own];
    }
    let found = dependence::at(model, t, q, NEAR, &|| false).into_iter().map(|one| one.group);
    found.into_iter().find(|group| group.contains(&own)).unwrap_or(vec![own])
}

/// Whether the sparse factorisation shows full rank. Its cost is linear in the size of the model.
pub(super) fn beyond_doubt(model: &Model, t: f64, q: &[f64]) -> bool {
    if model.layout.n_rows > model.layout.n_q {
        return false;
    }
    let mut matrix = Augmented::new(model);
    let motions = Motions::at_rest(&model.layout, q);
    matrix.set_weights(&column_scales(model).iter().map(|scale| 1.0 / (scale * scale)).list());
    constraints::jacobian(model, &motions, t, matrix.jacobian_mut());
    matrix.factor().is_ok() && matrix.cancellation().is_none_or(|(_, kept)| kept > BEYOND_DOUBT)
}

/// A position near this one on an admissible motion, if it exists. Where branches meet, Newton's method returns to
/// the intersection; therefore the angle of body `held` is kept away from it (ground: no body).
pub(super) fn neighbour(
    model: &Model,
    t: f64,
    q: &[f64],
    held: usize,
    stop: Halt<'_>,
) -> Option<Vec<f64>> {
    let extended = match held.checked_sub(1) {
        Some(_) => {
            let columns = model.layout.bodies.get(held).filter(|columns| columns.count == 3)?;
            Some(holding(model, BodyId(held), columns.of(q)[2] + EXCURSION))
        }
        None => None,
    };
    let mut closing = Closing::new(extended.as_ref().unwrap_or(model), t, stop);
    let mut near = moved(model, q, EXCURSION, 0);
    let (_, closed) = closing.close(&mut near);
    let unit = column_scales(model);
    let moved = q.iter().zip(&near).enumerate().any(|(k, (a, b))| (a - b).abs() > 1e-5 * unit[k]);
    (closed && moved).then_some(near)
}

/// `q` with the excursion of this number added to each coordinate. The excursions are fixed arbitrary numbers without
/// a symmetry of the mechanism.
pub(super) fn moved(model: &Model, q: &[f64], size: f64, number: usize) -> Vec<f64> {
    let first = 1.0 + 0.618 * number as f64;
    let part = |k: usize| ((12.9898 * (k as f64 + first)).sin() * 43758.5453).fract();
    let unit = column_scales(model);
    q.iter().enumerate().map(|(k, q)| q + size * part(k) * unit[k]).list()
}

fn holding(model: &Model, body: BodyId, angle: f64) -> Model {
    let held = CoordinateOf { body, coordinate: Coordinate::Angle };
    let blueprint =
        model.blueprint.holding(&[("neighbour".to_string(), held.into(), angle.into())]);
    Model::new(&Arc::new(blueprint), &model.parameters)
}
