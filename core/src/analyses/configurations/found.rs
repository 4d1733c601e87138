//! Positions without duplicates.

use crate::analyses::kinematics::same;
use crate::model::Model;

/// Largest difference between two positions that count as equal. Near a dead point, Newton's method finds only half
/// of the digits.
const SAME: f64 = 1e-5;

/// The positions found so far.
pub(super) struct Positions<'a> {
    model: &'a Model,
    limit: usize,
    pub positions: Vec<Vec<f64>>,
    /// Number of positions beyond the limit.
    pub dropped: usize,
}

impl<'a> Positions<'a> {
    pub fn new(model: &'a Model, limit: usize) -> Self {
        Self { model, limit, positions: Vec::new(), dropped: 0 }
    }

    /// Whether further positions are discarded.
    pub fn is_full(&self) -> bool {
        self.dropped > 0
    }

    /// Adds a position; returns whether it is new.
    pub fn add(&mut self, q: Vec<f64>) -> bool {
        if self.positions.iter().any(|other| same(self.model, other, &q, SAME)) {
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
