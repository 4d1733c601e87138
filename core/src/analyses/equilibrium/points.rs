//! The points of a path.

use super::failure::Reason;
use super::result::Equilibrium;
use super::spot::{ParameterPath, Spot};

/// The end of a path.
#[derive(Clone, Debug, PartialEq)]
pub enum PathEnd {
    /// It reached the last value of the range.
    Last,
    /// It turned and came back to the first value.
    First,
    /// It could not be followed further.
    Lost(Reason),
    /// It has very many points.
    Long,
    /// The observer stopped it.
    Stopped,
}

/// A path of equilibria.
#[derive(Clone, Debug, PartialEq)]
pub struct EquilibriumPath {
    /// The values of the parameter; a path may turn back.
    pub values: Vec<f64>,
    /// The equilibrium at each value.
    pub points: Vec<Equilibrium>,
    /// Places among the points of the folds, where the path turns back.
    pub folds: Vec<usize>,
    /// Places of points where the stability changes without a fold: other paths cross there.
    pub branches: Vec<usize>,
    /// The end.
    pub end: PathEnd,
}

impl EquilibriumPath {
    /// Adds a point; returns its place.
    pub(super) fn add(&mut self, course: &ParameterPath<'_>, spot: &Spot) -> Result<usize, Reason> {
        self.points.push(course.equilibrium(spot)?);
        self.values.push(spot.value);
        Ok(self.values.len() - 1)
    }
}
