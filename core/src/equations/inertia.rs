//! Masses and moments of inertia of the moving bodies, with precomputed inverses.

use crate::math::{Listed, Local, Real};
use crate::model::{Model, Weighed};

/// Inertia of a moving body in W, with what is added to massless ones.
#[derive(Clone, Copy, Debug)]
pub struct Inertia<S = f64> {
    /// 1/m, 1/kg, and 1/J about the mass centre, 1/(kg·m²).
    pub inverse: [S; 2],
    /// Mass, kg.
    pub mass: S,
    /// Mass centre in the body frame, m.
    pub center: Local<S>,
    /// Whether the mass centre may differ from the origin of the frame. Only then are rotation and translation
    /// coupled. This depends on the formulas, not on the values of parameters.
    pub coupled: bool,
}

/// Inertias of the moving bodies from those of all bodies, ground first.
pub(super) fn inertias<S: Real>(model: &Model<S>, all: &[Weighed<S>]) -> Vec<Inertia<S>> {
    let inertia = |(k, own): (usize, &Weighed<S>)| {
        let turns = model.bodies[k].turns;
        let turning = if turns { own.inertia } else { S::one() };
        Inertia {
            inverse: [S::one() / own.mass, S::one() / turning],
            mass: own.mass,
            center: own.center,
            coupled: turns && !model.blueprint.bodies[k].is_centred(),
        }
    };
    all.iter().enumerate().skip(1).map(inertia).list()
}
