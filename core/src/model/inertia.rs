//! What the equations of motion ask of a body over and over, worked out once.

use super::model::Body;
use crate::expression::Tape;
use crate::math::{Local, Real, Vec2};

/// Inertia and weight of a moving body.
#[derive(Clone, Copy, Debug)]
pub struct Inertia<S = f64> {
    /// 1/m, 1/m and 1/J about the mass centre, added inertia included: 1/kg, 1/kg, 1/(kg·m²).
    pub inverse: [S; 3],
    /// Mass, kg.
    pub mass: S,
    /// m g, N.
    pub weight: Vec2<S>,
    /// Mass centre in the body frame, m.
    pub center: Local<S>,
    /// Whether the mass centre can be off the origin of the frame: only then are rotation and translation
    /// coupled. Decided by the formulas, whatever the parameters.
    pub coupled: bool,
}

/// Of all moving bodies, given as formulas and as numbers, ground first.
pub(super) fn inertias<S: Real>(
    formulas: &[Body<Tape>],
    bodies: &[Body<S>],
    added: &[S],
    gravity: Vec2<S>,
) -> Vec<Inertia<S>> {
    let zero = |tape: &Tape| tape.constant() == Some(0.0);
    let moving = formulas.iter().zip(bodies).zip(added).skip(1);
    let inertia = |((formula, body), added): ((&Body<Tape>, &Body<S>), &S)| {
        let (m, j) = (S::one() / body.mass, S::one() / (body.inertia + *added));
        Inertia {
            inverse: [m, m, j],
            mass: body.mass,
            weight: gravity.scale(body.mass),
            center: body.center,
            coupled: !(zero(&formula.center.x) && zero(&formula.center.y)),
        }
    };
    moving.map(inertia).collect()
}
