//! Values that the formulas of laws may use: parameters, time, and the motion of the bodies.

use crate::elements::{BodyId, Coordinate};
use crate::expression::Values;
use crate::math::{Lift, Motion, Real};
use crate::model::variable;

/// Parameters over `S`, time and coordinates over a scalar `T` that contains it.
#[derive(Debug)]
pub struct Laws<'a, S, T, F> {
    /// Values of the parameters.
    pub parameters: &'a [S],
    /// Time, s.
    pub t: T,
    /// The value of a coordinate of a body.
    pub coordinate: F,
}

impl<S: Real, T: Lift<S>, F: Fn(BodyId, Coordinate) -> T> Values<T> for Laws<'_, S, T, F> {
    fn parameter(&self, k: usize) -> T {
        T::lift(self.parameters[k])
    }
    fn time(&self) -> T {
        self.t
    }
    fn variable(&self, k: usize) -> T {
        let (body, coordinate) = variable(k);
        (self.coordinate)(body, coordinate)
    }
}

/// Laws at a state, without derivatives.
pub fn at<'a, S: Real>(
    parameters: &'a [S],
    motions: &'a [Motion<S>],
    t: S,
) -> Laws<'a, S, S, impl Fn(BodyId, Coordinate) -> S + 'a> {
    let coordinate = move |body: BodyId, c: Coordinate| {
        let m = &motions[body.0];
        c.of(&m.pose, &m.twist)
    };
    Laws { parameters, t, coordinate }
}
