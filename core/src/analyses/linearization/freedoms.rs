//! Independent coordinates u at a position, and the matrix N with δq = N δu. It satisfies Φ_q N = 0, and its rows for
//! u form the unit matrix.
//!
//! Arbitrary vectors, one for each degree of freedom, are projected onto Φ_q x = 0 and made orthonormal. The
//! independent coordinates are then chosen one by one, by elimination with threshold pivoting, angles before lengths,
//! so that no entry of N becomes large. Each column costs two projections with the sparse factors. A coordinate that
//! occurs in no constraint, as those inside of a beam, is independent, and its column is a unit vector.

use super::failure::Failure;
use super::least_norm::LeastNorm;
use crate::analyses::mobility::Mobility;
use crate::analyses::second_order::mobility;
use crate::math::{Listed, Ordered};
use crate::model::Model;
use crate::solve::dot;
use std::ops::Range;

/// Fraction of the largest remaining entry from which a coordinate is chosen.
const ENOUGH: f64 = 0.1;

/// Independent coordinates and the basis N.
#[derive(Clone, Debug, PartialEq)]
pub struct Freedoms {
    /// Indices of the independent coordinates in q, ascending.
    pub coordinates: Vec<usize>,
    /// N by columns, each of shape (n_q).
    pub basis: Vec<Vec<f64>>,
    /// The part of each column outside of which it is zero.
    spans: Vec<Range<usize>>,
    /// Number of coordinates.
    n_q: usize,
}

impl Freedoms {
    /// The independent coordinates at time `t` and a position `q` that satisfies the constraints. Drivers hold their
    /// coordinates.
    ///
    /// # Errors
    /// [`Failure::Singular`] if constraints are dependent at this position although they are not redundant elsewhere.
    pub fn at(model: &Model, t: f64, q: &[f64]) -> Result<Self, Failure> {
        Self::with_factors(model, t, q).map(|(freedoms, _)| freedoms)
    }

    /// The mobility at a position that is not singular.
    pub(super) fn regular(model: &Model, t: f64, q: &[f64]) -> Result<Mobility, Failure> {
        let found = mobility(model, t, q);
        match found.singular.is_empty() {
            true => Ok(found),
            false => Err(Failure::singular(model, t, &found.singular)),
        }
    }

    pub(super) fn with_factors<'a>(
        model: &'a Model,
        t: f64,
        q: &[f64],
    ) -> Result<(Self, LeastNorm<'a>), Failure> {
        let found = Self::regular(model, t, q)?;
        let factors = LeastNorm::new(model, t, q, !found.redundant.is_empty())
            .map_err(|breakdown| Failure::breakdown(model, t, breakdown))?;
        let mut bound = vec![false; q.len()];
        model.layout.positions().for_each(|(_, column, _)| bound[column] = true);
        let unbound = (0..q.len()).filter(|column| !bound[*column]).list();
        let free = orthonormal(&factors, &bound, found.degrees_of_freedom - unbound.len());
        let coordinates = independent(model, &bound, &free);
        let mut basis = free;
        solve_for(&coordinates, &mut basis);
        for column in &mut basis {
            scale(column, &factors.scales, 1);
            factors.project(column);
            scale(column, &factors.scales, -1);
        }
        solve_for(&coordinates, &mut basis);
        for (column, &own) in basis.iter_mut().zip(&coordinates) {
            scale(column, &factors.scales, 1);
            let unit = column[own];
            column.iter_mut().for_each(|x| *x /= unit);
        }
        let unit = |own: &usize| (0..q.len()).map(|k| f64::from(u8::from(k == *own))).list();
        let further = unbound.iter().map(|own| (*own, unit(own)));
        let mut all: Vec<_> = coordinates.into_iter().zip(basis).chain(further).list();
        all.order_by_key(|(own, _)| *own);
        let (coordinates, basis): (_, Vec<_>) = all.into_iter().unzip();
        let spans = spans(&basis);
        Ok((Self { coordinates, basis, spans, n_q: q.len() }, factors))
    }

    /// Nᵀ f, shape (f) for f of shape (n_q).
    pub fn reduce(&self, f: &[f64]) -> Vec<f64> {
        let all = self.basis.iter().zip(&self.spans);
        all.map(|(column, span)| dot(&column[span.clone()], &f[span.clone()])).list()
    }

    /// N α, shape (n_q).
    pub fn extend(&self, alpha: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.n_q];
        for ((column, span), alpha) in self.basis.iter().zip(&self.spans).zip(alpha) {
            let entries = x[span.clone()].iter_mut().zip(&column[span.clone()]);
            entries.for_each(|(x, n)| *x += alpha * n);
        }
        x
    }

    /// Replaces the basis by one that is orthonormal in scaled coordinates, by the Gram–Schmidt method applied twice.
    pub(in crate::analyses) fn orthonormalize(&mut self, scales: &[f64]) {
        self.basis.iter_mut().for_each(|column| scale(column, scales, -1));
        (0..2).for_each(|_| orthonormalize(&mut self.basis));
        self.basis.iter_mut().for_each(|column| scale(column, scales, 1));
        self.spans = spans(&self.basis);
    }

    /// Adds a motion N α to x so that the independent components of x become zero.
    pub(super) fn without_motion(&self, x: &mut [f64]) {
        for (column, &own) in self.basis.iter().zip(&self.coordinates) {
            let part = x[own];
            if part != 0.0 {
                x.iter_mut().zip(column).for_each(|(x, n)| *x -= part * n);
                x[own] = 0.0;
            }
        }
    }
}

/// Multiplies (`power` = 1) or divides (-1) by the scales.
fn scale(x: &mut [f64], scales: &[f64], power: i32) {
    x.iter_mut().zip(scales).for_each(|(x, scale)| *x *= scale.powi(power));
}

/// Vectors of bound coordinates with Φ_q x = 0 that are orthonormal in scaled coordinates.
fn orthonormal(factors: &LeastNorm<'_>, bound: &[bool], count: usize) -> Vec<Vec<f64>> {
    let n = factors.scales.len();
    // fixed pseudo-random numbers
    let part = |k: usize| (12.9898 * (k as f64 + 1.618)).sin() * 43758.5453;
    let entry = |k: usize| if bound[k % n] { part(k).fract() - 0.5 } else { 0.0 };
    let probe = |j: usize| (0..n).map(|k| entry(j * n + k)).list();
    let mut found: Vec<Vec<f64>> = (0..count).map(probe).list();
    // the second pass removes the rounding errors of the first
    for _ in 0..2 {
        for column in &mut found {
            scale(column, &factors.scales, 1);
            factors.project(column);
            scale(column, &factors.scales, -1);
        }
        orthonormalize(&mut found);
    }
    found
}

/// The parts outside of which the columns are zero.
fn spans(columns: &[Vec<f64>]) -> Vec<Range<usize>> {
    let span = |column: &Vec<f64>| {
        let first = column.iter().position(|x| *x != 0.0).unwrap_or(0);
        first..column.iter().rposition(|x| *x != 0.0).map_or(first, |last| last + 1)
    };
    columns.iter().map(span).list()
}

/// The modified Gram–Schmidt method.
fn orthonormalize(columns: &mut [Vec<f64>]) {
    let mut spans = spans(columns);
    for k in 0..columns.len() {
        let (before, rest) = columns.split_at_mut(k);
        let (own, mut mine) = (&mut rest[0], spans[k].clone());
        for (other, span) in before.iter().zip(&spans) {
            let both = mine.start.max(span.start)..mine.end.min(span.end);
            let part = if both.is_empty() { 0.0 } else { dot(&own[both.clone()], &other[both]) };
            if part != 0.0 {
                let entries = own[span.clone()].iter_mut().zip(&other[span.clone()]);
                entries.for_each(|(a, b)| *a -= part * *b);
                mine = mine.start.min(span.start)..mine.end.max(span.end);
            }
        }
        spans[k] = mine;
        let length = dot(own, own).sqrt();
        own.iter_mut().for_each(|x| *x /= length);
    }
}

/// The independent coordinates, ascending. Each step of the elimination chooses the first coordinate whose entry is
/// large enough relative to the largest entry, angles before lengths.
fn independent(model: &Model, bound: &[bool], free: &[Vec<f64>]) -> Vec<usize> {
    let lengths = model.layout.lengths();
    let mut order: Vec<usize> = (0..lengths.len()).filter(|row| bound[*row]).list();
    order.order_by_key(|row| lengths[*row]);
    let mut left = free.to_vec();
    let mut taken = Vec::with_capacity(left.len());
    while let Some(count) = left.len().checked_sub(1) {
        let sizes: Vec<f64> = order
            .iter()
            .map(|row| left.iter().fold(0.0, |most: f64, column| most.max(column[*row].abs())))
            .list();
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        let at = sizes.iter().position(|size| *size >= ENOUGH * largest).unwrap_or(0);
        let row = order.remove(at);
        let size = |j: &usize| left[*j][row].abs();
        let best = (0..=count).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(count);
        let pivot = left.swap_remove(best);
        for column in &mut left {
            let part = column[row] / pivot[row];
            column.iter_mut().zip(&pivot).for_each(|(x, pivot)| *x -= part * pivot);
        }
        taken.push(row);
    }
    taken.sort_unstable();
    taken
}

/// Combines the columns so that their rows `taken` become the unit matrix (Gauss–Jordan on columns).
fn solve_for(taken: &[usize], columns: &mut [Vec<f64>]) {
    for (k, &row) in taken.iter().enumerate() {
        let size = |j: &usize| columns[*j][row].abs();
        let best = (k..columns.len()).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(k);
        columns.swap(k, best);
        let pivot = columns[k][row];
        columns[k].iter_mut().for_each(|x| *x /= pivot);
        let own = columns[k].clone();
        for (_, other) in columns.iter_mut().enumerate().filter(|(j, _)| *j != k) {
            let part = other[row];
            if part != 0.0 {
                other.iter_mut().zip(&own).for_each(|(x, own)| *x -= part * own);
                other[row] = 0.0;
            }
        }
    }
}
