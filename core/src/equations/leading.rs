//! The limits of friction, and which friction leads others that stick together with it.

use super::forces::{self, Acting};
use super::kinematics::Motions;
use crate::elements::Mode;
use crate::math::Real;
use crate::model::{size, Model};

/// Limit of friction at which it no longer leads, relative to the limits of the friction that follows it.
const LEADS: f64 = 1e-3;

/// The limit of friction `k` in N, that of a torque over the size of the mechanism.
pub fn limit<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
) -> S {
    let element = forces::at_state(model, &model.forces[k], motions, acting);
    let (limit, _) = element.limit(&forces::reported(model, k, motions, acting));
    let turns = element.result_quantities().first().is_some_and(|of| of.unit == "N*m");
    if turns {
        limit / S::constant(size(model))
    } else {
        limit
    }
}

/// The limit of friction `k` beyond a small part of the limits of the friction that follows it. Where it is negative,
/// another one has to lead, because the efforts of the others are found from its own. None if none follows.
pub fn lead<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
) -> Option<S> {
    let follows = |other: &usize| matches!(model.forces[*other].mode, Mode::Follows { leader, .. } if leader == k);
    let others = (0..model.forces.len()).filter(follows);
    let beyond = |other: usize| {
        limit(model, k, motions, acting) - S::constant(LEADS) * limit(model, other, motions, acting)
    };
    others.map(beyond).reduce(S::min)
}
