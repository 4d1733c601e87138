//! Coordinate driver (Haug 3.5.1, 3.5.2): a coordinate of a body follows a law.
//!
//! Φ = c - value(t), with c one of x, y, φ, measured in the frame of ground: the reaction of the driver
//! acts on ground. The law may use t and the positions of other bodies.

use crate::elements::{
    element, At, Attachment, BodyId, Coordinate, Equation, Fixes, Joint, SceneSymbol,
};
use crate::math::{Local, Real};

element! {
    /// Coordinate driver: x, y or angle of a body is a given function of time, Φ = coordinate - value
    /// (Haug 3.5.1, 3.5.2). The driving force or torque on the body is -λ.
    CoordinateDriver, "coordinate_driver" {
        /// Driven coordinate, as `body.x`, `body.y` or `body.angle`.
        coordinate: coordinate,
        /// Its value, m or rad; may use `t` and the positions of other bodies.
        value: law [m|rad],
    }
}

impl Joint for CoordinateDriver {
    fn bodies<S>(e: &CoordinateDriver<S>) -> Vec<BodyId> {
        vec![BodyId::GROUND, e.coordinate.body]
    }

    fn equations<S>(e: &CoordinateDriver<S>) -> Vec<Equation> {
        let coordinate = e.coordinate.coordinate;
        vec![Equation { name: coordinate.name(), unit: coordinate.unit() }]
    }

    fn residual<S: Real>(e: &CoordinateDriver<S>, at: &At<'_, S>, phi: &mut [S]) {
        let (i, j) = (at.i(), at.j());
        let from_ground = i.rotation.inverse(j.r - i.r);
        let measured = match e.coordinate.coordinate {
            Coordinate::X | Coordinate::Vx => from_ground.x,
            Coordinate::Y | Coordinate::Vy => from_ground.y,
            Coordinate::Angle | Coordinate::Omega => j.angle - i.angle,
        };
        phi[0] = measured - e.value;
    }

    fn symbols(e: &CoordinateDriver) -> Vec<SceneSymbol> {
        vec![SceneSymbol::drive(e.coordinate)]
    }

    fn attachment<S: Real>(_: &CoordinateDriver<S>, _: usize) -> Attachment<S> {
        Attachment { s: Local::zero(), axis: S::zero() }
    }

    fn fixes<S: Clone>(e: &CoordinateDriver<S>) -> Vec<Fixes<S>> {
        vec![Fixes::Coordinate(e.coordinate, e.value.clone())]
    }
}
