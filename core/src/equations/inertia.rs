//! Masses and moments of inertia of the moving bodies, inverted once.

use crate::math::{Local, Real};
use crate::model::{Model, Weighed};

/// Inertia of a moving body in W, with loans and additions.
#[derive(Clone, Copy, Debug)]
pub struct Inertia<S = f64> {
    /// 1/m and 1/J about the mass centre: 1/kg, 1/(kg·m²).
    pub inverse: [S; 2],
    /// Mass, kg.
    pub mass: S,
    /// Mass centre in the body frame, m.
    pub center: Local<S>,
    /// Whether the mass centre can be off the origin of the frame; only then rotation and translation are
    /// coupled. This follows from the formulas and does not depend on the values of parameters.
    pub coupled: bool,
}

/// Inertias of all moving bodies from those of all bodies, ground first; loans may have moved the mass centres of `moved`.
pub(super) fn inertias<S: Real>(
    model: &Model<S>,
    all: &[Weighed<S>],
    moved: &[bool],
) -> Vec<Inertia<S>> {
    let inertia = |(k, own): (usize, &Weighed<S>)| {
        let turns = model.bodies[k].turns;
        let turning = if turns { own.inertia } else { S::one() };
        Inertia {
            inverse: [S::one() / own.mass, S::one() / turning],
            mass: own.mass,
            center: own.center,
            coupled: turns && (moved[k] || !model.blueprint.bodies[k].is_centred()),
        }
    };
    all.iter().enumerate().skip(1).map(inertia).collect()
}
