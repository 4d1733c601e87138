//! Coordinate driver (Haug 3.5.1, 3.5.2): a coordinate of a body follows a law.
//!
//! Φ = c - value(t), with c one of x, y, φ, measured in the frame of ground: what drives the body
//! stands on ground and presses against it. The law may use t and the positions of other bodies.

use crate::elements::{
    element, Attachment, BodyId, Coordinate, CoordinateOf, Equation, Joint, Side,
};
use crate::math::{Local, Pose, Real};

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

impl CoordinateDriver {
    /// A driver that holds a coordinate where it is told: what `set` does during assembly.
    pub fn hold(coordinate: CoordinateOf, value: f64) -> Self {
        Self { coordinate, value }
    }
}

impl Joint<1> for CoordinateDriver {
    fn ends<S>(e: &CoordinateDriver<S>) -> [BodyId; 2] {
        [BodyId::GROUND, e.coordinate.body]
    }

    fn equations<S>(e: &CoordinateDriver<S>) -> [Equation; 1] {
        let coordinate = e.coordinate.coordinate;
        [Equation { name: coordinate.name(), unit: coordinate.unit() }]
    }

    fn residual<S: Real>(e: &CoordinateDriver<S>, i: &Pose<S>, j: &Pose<S>, _: S) -> [S; 1] {
        let from_ground = i.rotation.inverse(j.r - i.r);
        let measured = match e.coordinate.coordinate {
            Coordinate::X | Coordinate::Vx => from_ground.x,
            Coordinate::Y | Coordinate::Vy => from_ground.y,
            Coordinate::Angle | Coordinate::Omega => j.angle - i.angle,
        };
        [measured - e.value]
    }

    fn attachment<S: Real>(_: &CoordinateDriver<S>, _: Side) -> Attachment<S> {
        Attachment { s: Local::zero(), axis: S::zero() }
    }

    /// Closed form: a one in the driven column; against it, the ground's columns.
    fn jacobian<S: Real>(e: &CoordinateDriver<S>, i: &Pose<S>, j: &Pose<S>, _: S) -> [[S; 6]; 1] {
        let (zero, one) = (S::zero(), S::one());
        let arm = j.r - i.r;
        [match e.coordinate.coordinate {
            Coordinate::X | Coordinate::Vx => [-one, zero, arm.y, one, zero, zero],
            Coordinate::Y | Coordinate::Vy => [zero, -one, -arm.x, zero, one, zero],
            Coordinate::Angle | Coordinate::Omega => [zero, zero, -one, zero, zero, one],
        }]
    }
}
