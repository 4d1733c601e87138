//! Positions without duplicates, and without positions in which a freedom is left.

use crate::analyses::kinematics::{same, ALIKE};
use crate::analyses::second_order::mobility;
use crate::model::Model;

/// The positions found so far.
pub(super) struct Positions<'a> {
    model: &'a Model,
    t: f64,
    limit: usize,
    pub positions: Vec<Vec<f64>>,
    /// Positions in which the mechanism has degrees of freedom, with their number. Each is one of infinitely many.
    pub free: Vec<(Vec<f64>, usize)>,
    /// Number of positions beyond the limit.
    pub dropped: usize,
}

impl<'a> Positions<'a> {
    pub fn new(model: &'a Model, t: f64, limit: usize) -> Self {
        Self { model, t, limit, positions: Vec::new(), free: Vec::new(), dropped: 0 }
    }

    /// Whether further positions are discarded, or have degrees of freedom because there are too few equations.
    pub fn is_full(&self) -> bool {
        let layout = &self.model.layout;
        self.dropped > 0 || (layout.n_q > layout.n_rows && !self.free.is_empty())
    }

    /// Adds a position, unless the mechanism has degrees of freedom in it. Returns whether it is new.
    pub fn add(&mut self, q: Vec<f64>) -> bool {
        if self.knows(&q) {
            return false;
        }
        let found = mobility(self.model, self.t, &q);
        if found.degrees_of_freedom > 0 && found.singular.is_empty() {
            self.free.push((q, found.degrees_of_freedom));
            return false;
        }
        self.add_isolated(q)
    }

    fn knows(&self, q: &[f64]) -> bool {
        let mut known = self.positions.iter().chain(self.free.iter().map(|(free, _)| free));
        known.any(|known| same(self.model, known, q, ALIKE))
    }

    /// Adds a position in which the mechanism has no degree of freedom. Returns whether it is new.
    pub fn add_isolated(&mut self, q: Vec<f64>) -> bool {
        if self.knows(&q) {
            return false;
        }
        if self.positions.len() == self.limit {
            self.dropped += 1;
            return false;
        }
        self.positions.push(q);
        true
    }
}
