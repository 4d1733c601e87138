//! The limits of friction, and which friction leads others that stick together with it.

use super::forces::{self, Acting};
use super::kinematics::Motions;
use crate::elements::Mode;
use crate::math::Real;
use crate::model::{size, Model};

/// Limit of friction at which it no longer leads, relative to the limits of the friction that follows it.
const LEADS: f64 = 1e-3;

/// The limit of friction `k` against a multiplier of this sign in N, that of a torque over the size of the mechanism.
pub fn limit<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
    multiplier: S,
) -> S {
    let element = forces::at_state(model, &model.forces[k], motions, acting);
    let at = forces::reported(model, k, motions, acting);
    let (limit, _) = element.limit_against(&at, multiplier);
    limit * weight(model, k)
}

/// The factor of an effort of friction `k` that makes it a force.
fn weight<S: Real>(model: &Model<S>, k: usize) -> S {
    let quantities = model.forces[k].element.result_quantities();
    let turns = quantities.first().is_some_and(|of| of.unit == "N*m");
    S::constant(if turns { 1.0 / size(model) } else { 1.0 })
}

/// The limit of friction `k` that holds, beyond a small part of the limits of the friction that follows it. Friction in
/// one direction may have no part in the force: what it carries counts there, if the multiplier exceeds `noise`. Where
/// the result is negative, another one has to lead, because the efforts of the others are found from its own. None if
/// none follows.
pub fn lead<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
    noise: f64,
) -> Option<S> {
    let of = |k: usize, multiplier: S| limit(model, k, motions, acting, multiplier);
    let own = forces::reported(model, k, motions, acting).multiplier;
    let (most, noise) = (of(k, own), S::constant(noise));
    let carried = (own.abs() - noise) * weight(model, k);
    let part = S::select(most, carried / most, S::one());
    let sense = |other: usize| match model.forces[other].mode {
        Mode::Follows { leader, sense } if leader == k => Some((other, S::constant(sense) * own)),
        _ => None,
    };
    let beyond = |(other, multiplier): (usize, S)| {
        let limit = of(other, multiplier);
        let counts = match model.forces[other].element.only_pushes() {
            true => S::select(carried, part * limit, S::zero()),
            false => limit,
        };
        most + noise * weight(model, k) - S::constant(LEADS) * counts
    };
    (0..model.forces.len()).filter_map(sense).map(beyond).reduce(S::min)
}
