//! Changes of the multipliers on which forces depend, each beside its own load.
//!
//! Forces and torques have different units, and the loads of light and heavy bodies different magnitudes. A small load
//! is therefore compared only with itself.

use crate::math::{Largest, Listed, Real, Wrench};
use std::ops::Range;

/// The rows of the multipliers of each load: those of a force, that of a torque, or one row alone.
#[derive(Default)]
pub(super) struct LoadRows(Vec<Vec<usize>>);

impl LoadRows {
    /// Adds the rows of a reaction, from the first one on, with the reaction for a unit multiplier of each.
    pub fn add<S: Real>(&mut self, first: usize, units: &[Wrench<S>]) {
        let pushes = |k: &usize| largest([units[*k].force.x, units[*k].force.y].into_iter()) > 0.0;
        let (forces, torques): (Vec<usize>, Vec<usize>) = (0..units.len()).partition(pushes);
        let rows = [forces, torques].map(|of| of.into_iter().map(|k| first + k).list());
        self.0.extend(rows.into_iter().filter(|rows| !rows.is_empty()));
    }

    /// Adds rows that are loads alone.
    pub fn add_rows(&mut self, rows: Range<usize>) {
        self.0.extend(rows.map(|row| vec![row]));
    }

    /// The largest change relative to its load, which is at least `noise`.
    pub fn largest_part<S: Real>(&self, lam: &[S], change: &[S], noise: f64) -> f64 {
        let part = |rows: &Vec<usize>| {
            let of = |x: &[S]| rows.iter().fold(S::zero(), |most, row| most.max(x[*row].abs()));
            of(change) / of(lam).max(S::constant(noise))
        };
        largest(self.0.iter().map(part))
    }
}

/// Largest magnitude over all entries and lanes. NaN if an entry is NaN.
pub(super) fn largest<S: Real>(x: impl Iterator<Item = S>) -> f64 {
    let mut largest = Largest::new();
    x.for_each(|x| largest.add(x));
    largest.get()
}
