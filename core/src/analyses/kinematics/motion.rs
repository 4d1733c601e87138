//! The result of kinematics.

use super::solution::Point;
use std::sync::Arc;

/// A motion through chosen times.
#[derive(Clone, Debug, Default)]
pub struct Motion {
    /// The motion at the start and after each step of the continuation.
    pub points: Vec<Arc<Point>>,
    /// Indices into `points` of the chosen times.
    pub outputs: Vec<usize>,
    /// Number of rejected steps.
    pub rejected: usize,
    /// Whether the last time was reached; false if the observer stopped the analysis.
    pub reached: bool,
}

impl Motion {
    /// Number of steps of the continuation.
    pub fn steps(&self) -> usize {
        self.points.len().saturating_sub(1)
    }

    /// The motion at the chosen times.
    pub fn at_outputs(&self) -> impl Iterator<Item = &Point> {
        self.outputs.iter().map(|place| &*self.points[*place])
    }
}
