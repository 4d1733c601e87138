//! The result of kinematics.

use super::solution::Point;
use std::sync::Arc;

/// A motion through chosen times.
#[derive(Clone, Debug, Default)]
pub struct Motion {
    /// The motion at the start and after each step of the continuation.
    pub points: Vec<Arc<Point>>,
    /// The chosen times, as places among the points.
    pub outputs: Vec<usize>,
    /// Steps that were taken again, shorter.
    pub rejected: usize,
    /// Whether the last time was reached; otherwise the observer stopped.
    pub reached: bool,
}

impl Motion {
    /// Steps of the continuation.
    pub fn steps(&self) -> usize {
        self.points.len().saturating_sub(1)
    }

    /// The motion at the chosen times.
    pub fn at_outputs(&self) -> impl Iterator<Item = &Point> {
        self.outputs.iter().map(|place| &*self.points[*place])
    }
}
