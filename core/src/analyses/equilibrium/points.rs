//! The points of a path.

use super::failure::Reason;
use super::result::Equilibrium;
use super::spot::{ParameterPath, Spot};

/// The end of a path.
#[derive(Clone, Debug, PartialEq)]
pub enum PathEnd {
    /// The path reached the last value of the range.
    Last,
    /// The path turned back and returned to the first value.
    First,
    /// The path could not be followed further.
    Lost(Reason),
    /// The path has the largest permitted number of points.
    Long,
    /// The observer stopped the analysis.
    Stopped,
}

/// A path of equilibria.
#[derive(Clone, Debug, PartialEq)]
pub struct EquilibriumPath {
    /// The values of the parameter; a path may turn back.
    pub values: Vec<f64>,
    /// The equilibrium at each value.
    pub points: Vec<Equilibrium>,
    /// Indices in `points` of the folds, where the path turns back.
    pub folds: Vec<usize>,
    /// Indices in `points` of the positions where the stability changes without a fold. Other paths cross there.
    pub branches: Vec<usize>,
    /// The end.
    pub end: PathEnd,
}

impl EquilibriumPath {
    /// Adds a point and returns its index.
    pub(super) fn add(&mut self, course: &ParameterPath<'_>, spot: &Spot) -> Result<usize, Reason> {
        self.points.push(course.equilibrium(spot)?);
        self.values.push(spot.value);
        Ok(self.values.len() - 1)
    }
}
