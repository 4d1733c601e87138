//! The values that laws may use: parameters, time, the motion of the bodies, and first-order states.

use super::kinematics::Motions;
use crate::elements::{BodyId, Coordinate, Followed};
use crate::expression::{Tape, Values};
use crate::math::{Lift, Motion, Real};
use crate::model::{Model, Variable};

/// Parameters over `S`. Time, coordinates and states over a scalar `T` that contains `S`.
pub struct Laws<'a, S, T, F> {
    /// Values of the parameters.
    pub parameters: &'a [S],
    /// Time, s.
    pub t: T,
    /// The value of a coordinate of a body.
    pub coordinate: F,
    /// Internal coordinates of joints and their rates; empty if laws may not use them.
    pub own: [&'a [T]; 2],
    /// First-order states; empty if laws may not use them.
    pub z: &'a [T],
    /// The held piece of each switch of the model; empty if no piece is held.
    pub pieces: &'a [f64],
    /// The value of a law that the host program computes; None if laws may not use it.
    pub function: Option<&'a dyn Fn(usize) -> T>,
}

impl<S: Real, T: Lift<S>, F: Fn(BodyId, Coordinate) -> T> Values<T> for Laws<'_, S, T, F> {
    fn parameter(&self, k: usize) -> T {
        T::lift(self.parameters[k])
    }
    fn time(&self) -> T {
        self.t
    }
    fn variable(&self, k: usize) -> T {
        match Variable::at(k) {
            Variable::Coordinate(body, coordinate) => (self.coordinate)(body, coordinate),
            Variable::State(k) => self.z[k],
            Variable::Function(k) => self.function.map_or(T::constant(f64::NAN), |f| f(k)),
            Variable::Internal { place, rate } => {
                let value = self.own[usize::from(rate)].get(place);
                value.copied().unwrap_or(T::constant(f64::NAN))
            }
        }
    }
    fn piece(&self, k: usize) -> f64 {
        self.pieces.get(k).copied().unwrap_or(f64::NAN)
    }
}

/// The values at a state, without derivatives, internal coordinates and held pieces.
pub fn at<'a, S: Real>(
    parameters: &'a [S],
    motions: &'a [Motion<S>],
    z: &'a [S],
    t: S,
) -> Laws<'a, S, S, impl Fn(BodyId, Coordinate) -> S + 'a> {
    let coordinate = move |body: BodyId, c: Coordinate| {
        let m = &motions[body.0];
        c.of(&m.pose, &m.twist)
    };
    Laws { parameters, t, coordinate, own: [&[]; 2], z, pieces: &[], function: None }
}

/// The values at a state, with internal coordinates and held pieces.
pub fn held<'a, S: Real>(
    parameters: &'a [S],
    motions: &'a Motions<S>,
    z: &'a [S],
    t: S,
) -> Laws<'a, S, S, impl Fn(BodyId, Coordinate) -> S + 'a> {
    Laws { pieces: &motions.pieces, own: motions.internals(), ..at(parameters, motions, z, t) }
}

/// The value of a position quantity at a position of the mechanism.
pub fn position(model: &Model, of: &Followed<Tape>, t: f64, q: &[f64]) -> f64 {
    match of {
        Followed::Coordinate(of) => {
            q[model.layout.bodies[of.body.0].first + of.coordinate.column()]
        }
        Followed::Quantity(of) => {
            let motions = Motions::at_rest(&model.layout, q);
            let values = held(&model.parameters, &motions, &[], t);
            of.value.evaluate(&values)
        }
    }
}
