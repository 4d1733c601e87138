//! The ends of open curves, which a contact must not leave.

use crate::math::{Listed, Real};
use crate::model::Model;

/// A contact may leave its curve by this fraction of the range of u, because of rounding.
const SLACK: f64 = 1e-9;

/// The ranges of the internal coordinates that run along open curves, each with its constraint and column.
#[derive(Clone, Debug, Default)]
pub(super) struct Ranges(Vec<(usize, usize, [f64; 2])>);

impl Ranges {
    pub fn of(model: &Model) -> Self {
        let all = model.constraints.iter().zip(&model.layout.constraints).enumerate();
        let range = all.filter_map(|(k, (item, slots))| {
            let curve = &item.element.curve()?.curve;
            (!curve.periodic()).then(|| (k, slots.own.first, curve.range()))
        });
        Self(range.list())
    }

    /// Number of ranges.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// The distance of an internal coordinate, given by its column, from the nearer end of range `k`.
    pub fn margin<S: Real>(&self, k: usize, coordinate: impl Fn(usize) -> S) -> S {
        let (_, column, [a, b]) = self.0[k];
        let (u, slack) = (coordinate(column), SLACK * (b - a));
        (u - S::constant(a - slack)).min(S::constant(b + slack) - u)
    }

    /// The first constraint whose contact at the position `q` is beyond the end of its curve, with a description.
    pub fn beyond(&self, model: &Model, q: &[f64]) -> Option<(String, String)> {
        let (k, column, [a, b]) = self.0.iter().find(|(_, column, [a, b])| {
            let slack = SLACK * (b - a);
            q[*column] < a - slack || q[*column] > b + slack
        })?;
        let name = model.constraints[*k].name.clone();
        let message = format!(
            "the contact of {name} leaves its curve: u = {:.6} is not within {a:.6} to {b:.6}",
            q[*column]
        );
        Some((name, message))
    }
}

/// [`Ranges::beyond`] for all ranges of a model.
pub(super) fn beyond(model: &Model, q: &[f64]) -> Option<(String, String)> {
    Ranges::of(model).beyond(model, q)
}
