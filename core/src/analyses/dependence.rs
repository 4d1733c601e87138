//! Equations of constraints that depend on the earlier ones at a position.

use super::closing::Stop;
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::model::{column_scales, Model, MOST_REPORTED};
use crate::solve::{groups_first, normalize_rows, rank, SparseRank, SparseRow};

/// Part of a left null vector below which a row does not take part.
const PART: f64 = 1e-6;
/// Largest number of equations for which the dense rank is found. It takes the clearest rows first; its cost is cubic.
pub(super) const MOST_DENSE: usize = 300;

/// The dependent equations at a position.
#[derive(Clone, Debug, Default)]
pub(super) struct Dependence {
    /// Their rows, ascending.
    pub rows: Vec<usize>,
    /// For each of them the constraints (indices) that take part.
    pub groups: Vec<Vec<usize>>,
}

/// The dependent equations, whose remainder is at most `tolerance`; without a meaning if `stop` became true.
pub(super) fn at(model: &Model, t: f64, q: &[f64], tolerance: f64, stop: Stop<'_>) -> Dependence {
    let rows = scaled_rows(model, t, q);
    match rows.len() <= MOST_DENSE {
        true => dense(model, &rows, tolerance),
        false => sparse(model, rows, tolerance, stop).unwrap_or_default(),
    }
}

/// The rows of Φ_q, of length 1. The size of the mechanism makes metres and radians comparable.
fn scaled_rows(model: &Model, t: f64, q: &[f64]) -> Vec<SparseRow> {
    let mut entries = vec![0.0; model.layout.n_entries];
    constraints::jacobian(model, &Motions::at_rest(&model.layout, q), t, &mut entries);
    let scales = column_scales(model);
    let mut rows: Vec<SparseRow> = vec![Vec::new(); model.layout.n_rows];
    for (row, column, at) in model.layout.positions() {
        // a law without a derivative at this position has zero rows
        let entry = Some(entries[at] * scales[column]).filter(|x| x.is_finite());
        rows[row].push((column, entry.unwrap_or(0.0)));
    }
    for row in &mut rows {
        row.sort_unstable_by_key(|(column, _)| *column);
        let mut values: Vec<f64> = row.iter().map(|(_, x)| *x).collect();
        let columns = values.len();
        normalize_rows(&mut values, columns);
        row.iter_mut().zip(values).for_each(|((_, x), value)| *x = value);
    }
    rows
}

fn dense(model: &Model, rows: &[SparseRow], tolerance: f64) -> Dependence {
    let n = model.layout.n_q;
    let mut full = vec![0.0; rows.len() * n];
    for (row, entries) in rows.iter().enumerate() {
        entries.iter().for_each(|(column, x)| full[row * n + column] = *x);
    }
    let found = rank(&full, n, tolerance);
    let group = |y: &Vec<f64>| owners(model, y.iter().copied().enumerate());
    Dependence { groups: found.left_null.iter().map(group).collect(), rows: found.dependent }
}

fn sparse(
    model: &Model,
    mut rows: Vec<SparseRow>,
    tolerance: f64,
    stop: Stop<'_>,
) -> Option<Dependence> {
    let place = places(model);
    for row in &mut rows {
        row.iter_mut().for_each(|(column, _)| *column = place[*column]);
        row.sort_unstable_by_key(|(column, _)| *column);
    }
    let found = SparseRank::new(&rows, model.layout.n_q, tolerance, stop)?;
    let group = |(k, row): (usize, &usize)| {
        // more groups are never reported
        let others = if k < MOST_REPORTED { found.dependence(&rows, *row) } else { Vec::new() };
        let mut parts: SparseRow = others.into_iter().chain([(*row, 1.0)]).collect();
        parts.sort_unstable_by_key(|(row, _)| *row);
        owners(model, parts.into_iter())
    };
    let groups = found.dependent.iter().enumerate().map(group).collect();
    Some(Dependence { groups, rows: found.dependent })
}

/// The place of each column in an order with little fill.
fn places(model: &Model) -> Vec<usize> {
    let layout = &model.layout;
    let first: Vec<usize> = layout.owners.iter().map(|owner| owner.first).collect();
    let entries: Vec<(usize, usize)> = layout
        .constraints
        .iter()
        .flat_map(|slots| slots.blocks.windows(2))
        .map(|pair| (pair[0].columns.first, pair[1].columns.first))
        .collect();
    let order = groups_first(layout.n_q, layout.n_q, &entries, Some(&first));
    let mut place = vec![0; layout.n_q];
    order.iter().enumerate().for_each(|(k, column)| place[*column] = k);
    place
}

/// The constraints with rows that take part, ascending.
fn owners(model: &Model, parts: impl Iterator<Item = (usize, f64)>) -> Vec<usize> {
    let rows = parts.filter(|(_, part)| part.abs() > PART);
    let mut owners: Vec<usize> = rows.map(|(row, _)| model.layout.owner(row).0).collect();
    owners.dedup();
    owners
}
