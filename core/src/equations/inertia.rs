//! Masses and moments of inertia of the moving bodies, inverted once.

use super::added_mass::Added;
use crate::expression::Tape;
use crate::math::{Local, Real};
use crate::model::{Body, Weighed};

/// Inertia of a moving body.
#[derive(Clone, Copy, Debug)]
pub struct Inertia<S = f64> {
    /// 1/m and 1/J about the mass centre, additions included: 1/kg, 1/(kg·m²).
    pub inverse: [S; 2],
    /// Mass, kg.
    pub mass: S,
    /// Mass centre in the body frame, m.
    pub center: Local<S>,
    /// Whether the mass centre can be off the origin of the frame; only then rotation and translation are
    /// coupled. This follows from the formulas and does not depend on the values of parameters.
    pub coupled: bool,
}

/// Inertias of all moving bodies that have loans, which may move their mass centres.
pub(super) fn lent<S: Real>(bodies: &[Body<S>], lent: &[Weighed<S>]) -> Vec<Inertia<S>> {
    let inertia = |(body, own): (&Body<S>, &Weighed<S>)| {
        let turning = if body.turns { own.inertia } else { S::one() };
        Inertia {
            inverse: [S::one() / own.mass, S::one() / turning],
            mass: own.mass,
            center: own.center,
            coupled: body.turns,
        }
    };
    bodies.iter().zip(lent).skip(1).map(inertia).collect()
}

/// Inertias of all moving bodies, given as formulas and as numbers, ground first.
pub(super) fn inertias<S: Real>(
    formulas: &[Body<Tape>],
    bodies: &[Body<S>],
    added: &[Added],
) -> Vec<Inertia<S>> {
    let moving = formulas.iter().zip(bodies).zip(added).skip(1);
    let inertia = |((formula, body), added): ((&Body<Tape>, &Body<S>), &Added)| {
        let plus = |own: S, added: f64| own + S::constant(added);
        let turning = if body.turns { plus(body.inertia, added.inertia) } else { S::one() };
        let (m, j) = (S::one() / plus(body.mass, added.mass), S::one() / turning);
        Inertia {
            inverse: [m, j],
            mass: body.mass,
            center: body.center,
            coupled: !formula.is_centred(),
        }
    };
    moving.map(inertia).collect()
}
