//! Degrees of freedom and redundant constraints.
//!
//! The rank is that of the row-scaled Φ_q. If a rank deficiency vanishes at a neighbouring admissible
//! position, the position is singular. If it remains, the constraints are redundant. The left null vectors
//! of Φ_q give all joints that take part.

use super::closing::Closing;
use crate::elements::{BodyId, Coordinate, CoordinateOf};
use crate::equations::augmented::Augmented;
use crate::equations::kinematics::Motions;
use crate::equations::{self, constraints};
use crate::model::{column_scales, Model};
use crate::solve::{normalize_rows, rank, Rank, RANK_TOLERANCE};
use std::sync::Arc;

/// Part of a left null vector below which a row does not take part.
const PART: f64 = 1e-6;
/// If all pivots keep this part of their magnitude, the rank is certain.
const BEYOND_DOUBT: f64 = 1e-7;
/// Size of the excursion to a neighbouring position, rad.
const EXCURSION: f64 = 3e-3;

/// Largest number of bodies whose angle is tried to reach a neighbouring position.
const EXCURSIONS: usize = 6;

/// How a mechanism can move at a position.
#[derive(Clone, Debug, PartialEq)]
pub struct Mobility {
    /// Coordinates less independent constraints.
    pub degrees_of_freedom: usize,
    /// Independent constraint equations.
    pub rank: usize,
    /// Groups of constraints (indices) that repeat each other, one for each dependent equation.
    pub redundant: Vec<Vec<usize>>,
    /// Groups that are dependent at this position only.
    pub singular: Vec<Vec<usize>>,
}

/// Mobility at an assembled position.
pub fn mobility(model: &Model, t: f64, q: &[f64]) -> Mobility {
    let (n, m) = (model.layout.n_q, model.layout.n_rows);
    if beyond_doubt(model, t, q) {
        let degrees_of_freedom = n - m;
        return Mobility { degrees_of_freedom, rank: m, redundant: vec![], singular: vec![] };
    }
    let here = dense_rank(model, t, q);
    let mut redundant = groups(model, &here);
    let mut singular = Vec::new();
    if !redundant.is_empty() {
        let near = (0..=EXCURSIONS).filter_map(|held| neighbour(model, t, q, held));
        let near = near.map(|q| dense_rank(model, t, &q)).max_by_key(|near| near.rank);
        if let Some(near) = near.filter(|near| near.rank > here.rank) {
            singular = std::mem::replace(&mut redundant, groups(model, &near));
        }
    }
    Mobility { degrees_of_freedom: n - here.rank, rank: here.rank, redundant, singular }
}

/// Largest number of equations for which all joints of a near dependence are determined.
const MOST_ROWS: usize = 300;
/// Remainder of a row that counts as dependent near a singular position.
const NEAR: f64 = 0.05;

/// The constraints (indices) that depend on each other at or near a position; the constraint with `row` is one
/// of them.
pub(super) fn dependent(model: &Model, t: f64, q: &[f64], row: usize) -> Vec<usize> {
    let own = model.layout.owner(row).0;
    if model.layout.n_rows > MOST_ROWS {
        return vec![own];
    }
    let found = groups(model, &scaled_rank(model, t, q, NEAR));
    found.into_iter().find(|group| group.contains(&own)).unwrap_or(vec![own])
}

/// Whether the sparse factorisation shows full rank; its cost is linear in the size of the model.
fn beyond_doubt(model: &Model, t: f64, q: &[f64]) -> bool {
    if model.layout.n_rows > model.layout.n_q {
        return false;
    }
    let mut matrix = Augmented::new(model);
    let motions = Motions::at_rest(&model.layout, q);
    matrix.set_weights(&vec![1.0; q.len()]);
    constraints::jacobian(model, &motions, t, matrix.jacobian_mut());
    matrix.factor().is_ok() && matrix.cancellation().is_none_or(|(_, kept)| kept > BEYOND_DOUBT)
}

fn dense_rank(model: &Model, t: f64, q: &[f64]) -> Rank {
    scaled_rank(model, t, q, RANK_TOLERANCE)
}

fn scaled_rank(model: &Model, t: f64, q: &[f64], tolerance: f64) -> Rank {
    let n = model.layout.n_q;
    let mut dense = equations::dense::jacobian(model, &Motions::at_rest(&model.layout, q), t);
    // the size of the mechanism makes metres and radians comparable
    let scales = column_scales(model);
    for row in dense.chunks_exact_mut(n.max(1)) {
        row.iter_mut().zip(&scales).for_each(|(entry, scale)| *entry *= scale);
    }
    // a law without a derivative at this position has zero rows
    dense.iter_mut().filter(|entry| !entry.is_finite()).for_each(|entry| *entry = 0.0);
    normalize_rows(&mut dense, n);
    rank(&dense, n, tolerance)
}

fn groups(model: &Model, rank: &Rank) -> Vec<Vec<usize>> {
    let of = |y: &Vec<f64>| {
        let rows = y.iter().enumerate().filter(|(_, part)| part.abs() > PART);
        let mut group: Vec<usize> = rows.map(|(row, _)| model.layout.owner(row).0).collect();
        group.dedup();
        group
    };
    let mut groups: Vec<Vec<usize>> = rank.left_null.iter().map(of).collect();
    groups.dedup();
    groups
}

/// A position a little way along an admissible motion, if there is one. Where branches meet, Newton's method
/// returns to the meeting point; therefore the angle of body `held` is kept away from it (ground: none).
fn neighbour(model: &Model, t: f64, q: &[f64], held: usize) -> Option<Vec<f64>> {
    let extended = match held.checked_sub(1) {
        Some(_) => {
            let columns = model.layout.bodies.get(held).filter(|columns| columns.count == 3)?;
            Some(holding(model, BodyId(held), columns.of(q)[2] + EXCURSION))
        }
        None => None,
    };
    let mut closing = Closing::new(extended.as_ref().unwrap_or(model), t);
    // fixed arbitrary numbers, which have no symmetry of the mechanism
    let excursion =
        |k: usize| EXCURSION * ((12.9898 * (k as f64 + 1.0)).sin() * 43758.5453).fract();
    let unit = column_scales(model);
    let mut near: Vec<f64> =
        q.iter().enumerate().map(|(k, q)| q + excursion(k) * unit[k]).collect();
    let (_, closed) = closing.close(&mut near);
    let moved = q.iter().zip(&near).enumerate().any(|(k, (a, b))| (a - b).abs() > 1e-5 * unit[k]);
    (closed && moved).then_some(near)
}

fn holding(model: &Model, body: BodyId, angle: f64) -> Model {
    let held = CoordinateOf { body, coordinate: Coordinate::Angle };
    let blueprint = model.blueprint.holding(&[("neighbour".to_string(), held, angle.into())]);
    Model::new(&Arc::new(blueprint), &model.parameters)
}
