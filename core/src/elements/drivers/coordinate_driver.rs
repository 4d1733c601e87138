//! Coordinate driver (Haug 3.5.1, 3.5.2): a coordinate of a body follows a law.
//!
//! Φ = c - value(t), with c one of x, y, φ. The law may use t and the positions of other bodies.

use crate::elements::{
    element, Attachment, BodyId, Coordinate, CoordinateOf, Equation, Formula, Joint, Side,
};
use crate::math::{Local, Pose, Real, Twist};

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
    const FORMULAS: [Formula; 1] = [Formula {
        residual: "j.coordinate - value",
        jacobian: ["0", "0", "0", "is_x", "is_y", "is_angle"],
        gamma: "ddt(value)",
    }];

    fn ends<S>(e: &CoordinateDriver<S>) -> [BodyId; 2] {
        [BodyId::GROUND, e.coordinate.body]
    }

    fn equations<S>(e: &CoordinateDriver<S>) -> [Equation; 1] {
        let coordinate = e.coordinate.coordinate;
        [Equation { name: coordinate.name(), unit: coordinate.unit() }]
    }

    fn residual<S: Real>(e: &CoordinateDriver<S>, _: &Pose<S>, j: &Pose<S>, _: S) -> [S; 1] {
        [e.coordinate.coordinate.of(j, &Twist::zero()) - e.value]
    }

    fn attachment<S: Real>(_: &CoordinateDriver<S>, _: Side) -> Attachment<S> {
        Attachment { s: Local::zero(), axis: S::zero() }
    }

    /// Closed form: a single one in the driven column.
    fn jacobian<S: Real>(e: &CoordinateDriver<S>, _: &Pose<S>, _: &Pose<S>, _: S) -> [[S; 6]; 1] {
        let driven = match e.coordinate.coordinate {
            Coordinate::X | Coordinate::Vx => 3,
            Coordinate::Y | Coordinate::Vy => 4,
            Coordinate::Angle | Coordinate::Omega => 5,
        };
        [std::array::from_fn(|k| if k == driven { S::one() } else { S::zero() })]
    }
}
