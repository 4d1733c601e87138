//! Equations of constraints that depend on earlier equations at a position.

use super::closing::Halt;
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::math::{Listed, Ordered};
use crate::model::{column_scales, Model, MOST_REPORTED};
use crate::solve::{groups_first, normalize_rows, rank, SparseRank, SparseRow};

/// A row does not take part if its factor in a left null vector is below this fraction.
const PART: f64 = 1e-6;
/// Largest number of equations for which the dense rank is computed. The dense method eliminates rows with large
/// remainders first; its cost is cubic.
pub(super) const MOST_DENSE: usize = 300;

/// An equation that depends on others.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dependent {
    /// Its row of Φ_q.
    pub row: usize,
    /// The constraints (indices) that take part, ascending.
    pub group: Vec<usize>,
    /// The rows k that take part, with their factors y_k: Σ y_k Φ_q,k = 0.
    pub factors: Vec<(usize, f64)>,
}

/// The dependent equations, ascending by row. Their remainder is at most `tolerance`. The result is invalid if `stop`
/// returned true.
pub(super) fn at(
    model: &Model,
    t: f64,
    q: &[f64],
    tolerance: f64,
    stop: Halt<'_>,
) -> Vec<Dependent> {
    let (rows, lengths) = scaled_rows(model, t, q);
    let mut found = match rows.len() <= MOST_DENSE {
        true => dense(model, &rows, tolerance),
        false => sparse(model, rows, tolerance, stop).unwrap_or_default(),
    };
    for dependent in &mut found {
        for (row, factor) in &mut dependent.factors {
            // a row of zeros has the length 0
            *factor /= if lengths[*row] > 0.0 { lengths[*row] } else { 1.0 };
        }
    }
    found
}

/// The rows of Φ_q, scaled to length 1, and their original lengths. Lengths are divided by the size of the mechanism.
fn scaled_rows(model: &Model, t: f64, q: &[f64]) -> (Vec<SparseRow>, Vec<f64>) {
    let mut entries = vec![0.0; model.layout.n_entries];
    constraints::jacobian(model, &Motions::at_rest(&model.layout, q), t, &mut entries);
    let scales = column_scales(model);
    let mut rows: Vec<SparseRow> = vec![Vec::new(); model.layout.n_rows];
    for (row, column, at) in model.layout.positions() {
        // a law without a derivative at this position has zero rows
        let entry = Some(entries[at] * scales[column]).filter(|x| x.is_finite());
        rows[row].push((column, entry.unwrap_or(0.0)));
    }
    let mut lengths = Vec::with_capacity(rows.len());
    for row in &mut rows {
        row.order_by_key(|(column, _)| *column);
        let mut values: Vec<f64> = row.iter().map(|(_, x)| *x).list();
        let columns = values.len();
        lengths.push(normalize_rows(&mut values, columns).first().copied().unwrap_or(0.0));
        row.iter_mut().zip(values).for_each(|((_, x), value)| *x = value);
    }
    (rows, lengths)
}

fn dense(model: &Model, rows: &[SparseRow], tolerance: f64) -> Vec<Dependent> {
    let n = model.layout.n_q;
    let mut full = vec![0.0; rows.len() * n];
    for (row, entries) in rows.iter().enumerate() {
        entries.iter().for_each(|(column, x)| full[row * n + column] = *x);
    }
    let found = rank(&full, n, tolerance);
    let pairs = found.dependent.iter().zip(&found.left_null);
    pairs.map(|(row, y)| dependent(model, *row, y.iter().copied().enumerate())).list()
}

fn sparse(
    model: &Model,
    mut rows: Vec<SparseRow>,
    tolerance: f64,
    stop: Halt<'_>,
) -> Option<Vec<Dependent>> {
    let place = places(model);
    for row in &mut rows {
        row.iter_mut().for_each(|(column, _)| *column = place[*column]);
        row.order_by_key(|(column, _)| *column);
    }
    let found = SparseRank::new(&rows, model.layout.n_q, tolerance, stop)?;
    let one = |(k, row): (usize, &usize)| {
        // more groups are never reported
        let others = if k < MOST_REPORTED { found.dependence(&rows, *row) } else { Vec::new() };
        let mut parts: SparseRow = others.into_iter().chain([(*row, 1.0)]).list();
        parts.order_by_key(|(row, _)| *row);
        dependent(model, *row, parts.into_iter())
    };
    Some(found.dependent.iter().enumerate().map(one).list())
}

/// Index of each column in an order with little fill-in.
fn places(model: &Model) -> Vec<usize> {
    let layout = &model.layout;
    let first: Vec<usize> = layout.owners.iter().map(|owner| owner.first).list();
    let entries: Vec<(usize, usize)> = layout
        .constraints
        .iter()
        .flat_map(|slots| slots.blocks.windows(2))
        .map(|pair| (pair[0].columns.first, pair[1].columns.first))
        .list();
    let order = groups_first(layout.n_q, layout.n_q, &entries, Some(&first));
    let mut place = vec![0; layout.n_q];
    order.iter().enumerate().for_each(|(k, column)| place[*column] = k);
    place
}

/// The equation with the rows that take part in its dependence.
fn dependent(model: &Model, row: usize, parts: impl Iterator<Item = (usize, f64)>) -> Dependent {
    let factors: Vec<(usize, f64)> = parts.filter(|(_, part)| part.abs() > PART).list();
    let mut group: Vec<usize> = factors.iter().map(|(row, _)| model.layout.owner(*row).0).list();
    group.dedup();
    Dependent { row, group, factors }
}
