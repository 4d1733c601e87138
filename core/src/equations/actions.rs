//! The actions of elements as they are reported: with torques about the places at which the forces act, with their
//! results and powers, with all parts of a force together, and with the friction of joints.

use super::forces::{at_state, each_wrench, potential, reported, threshold, Acting};
use super::kinematics::Motions;
use super::powers::Powers;
use super::reactions::{self, attached, reduced, Frame};
use crate::elements::BodyId;
use crate::math::{Real, Vec2, Wrench};
use crate::model::Model;

/// Calls `visit` with the part, body and value of every wrench of force `k`, in the global frame. The torque is about
/// the [place](place) of the force on this body.
#[inline]
pub fn each_action<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
    mut visit: impl FnMut(usize, BodyId, Wrench<S>),
) {
    let arms = arms(model, k, motions, acting);
    for own in model.whole(k) {
        // the friction of a contact is the last part of the contact
        let parts = |k: usize| model.forces[k].element.parts().len();
        let first = parts(k) - parts(own);
        each_wrench(model, own, motions, acting, |part, body, w| {
            let arm = arms.iter().find(|(own, _)| *own == body);
            let arm = arm.map_or(Vec2::zero(), |(_, arm)| *arm);
            let torque = w.torque - arm.cross(w.force);
            visit(first + part, body, Wrench { torque, ..w });
        });
    }
}

/// The [reaction](reactions::reaction) of joint or driver `k` on a body, with its friction. `acting` contains the
/// multipliers.
pub fn reaction<S: Real>(
    model: &Model<S>,
    k: usize,
    body: BodyId,
    frame: Frame,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
) -> Option<Wrench<S>> {
    let own = &acting.lam?[model.layout.constraints[k].rows.clone()];
    let mut sum = reactions::reaction(model, k, body, frame, motions, acting.t, own)?;
    if let Some(friction) = model.constraints[k].companion {
        let at = attached(model, k, body, motions, acting.t);
        each_wrench(model, friction, motions, acting, |_, on, w| {
            if on == body {
                sum = sum + reduced(w, &motions[body.0].pose, at, frame);
            }
        });
    }
    Some(sum)
}

/// The results of joint or driver `k` in addition to its reaction, in the order of its declaration. The friction of a
/// joint gives the last of them. `acting` contains the multipliers.
pub fn results_of_joint<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
    out: &mut [S],
) {
    let lam = acting.lam.unwrap_or_default();
    let own = &lam[model.layout.constraints[k].rows.clone()];
    reactions::results(model, k, motions, acting.t, own, out);
    let own = model.constraints[k].companion;
    if let Some(friction) = own.filter(|own| model.forces[*own].element.driver().is_none()) {
        let first = out.len() - model.forces[friction].element.result_quantities().len();
        results_of_part(model, friction, motions, acting, &mut out[first..]);
    }
}

/// The global point at which force `k` acts on a body: its point, or the origin of the body for an element without
/// points.
pub fn place<S: Real>(
    model: &Model<S>,
    k: usize,
    body: BodyId,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
) -> Vec2<S> {
    let arms = arms(model, k, motions, acting);
    let arm = arms.iter().find(|(own, _)| *own == body).map_or(Vec2::zero(), |(_, arm)| *arm);
    motions[body.0].pose.r + arm
}

/// The bodies on which force `k` acts at a point, each with the vector from its origin to this point: that of the
/// closest part.
fn arms<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
) -> Vec<(BodyId, Vec2<S>)> {
    let mut found: Vec<(BodyId, Vec2<S>)> = Vec::new();
    each_closer(model, k, motions, acting, |part, closer| {
        let at = reported(model, part, motions, acting);
        let arms = at_state(model, &model.forces[part], motions, acting).arms(&at);
        for (body, arm) in arms.into_iter().flatten().enumerate() {
            let body = at.bodies[body];
            match (found.iter_mut().find(|(known, _)| *known == body), closer) {
                (Some((_, known)), Some(closer)) => {
                    let pick = |own: S, other: S| S::select(closer, own, other);
                    *known = Vec2::new(pick(arm.x, known.x), pick(arm.y, known.y));
                }
                _ => found.push((body, arm)),
            }
        }
    });
    found
}

/// The results of force `k` in addition to its wrenches, in `out`. Of several parts, forces add up; the other results
/// are those of the part with the least threshold.
#[inline]
pub fn results<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
    out: &mut [S],
) {
    results_of_part(model, k, motions, acting, out);
    if model.forces[k].further.is_empty() {
        return;
    }
    let mut own = vec![S::zero(); out.len()];
    each_closer(model, k, motions, acting, |part, closer| {
        let Some(closer) = closer else { return };
        results_of_part(model, part, motions, acting, &mut own);
        let quantities = model.forces[k].element.result_quantities();
        for ((to, own), of) in out.iter_mut().zip(&own).zip(quantities) {
            *to = if of.unit == "N" { *to + *own } else { S::select(closer, *own, *to) };
        }
    });
}

/// Calls `visit` for each part of force `k`. The second argument is positive where the threshold of a further part is
/// less than those of the parts before it.
fn each_closer<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
    mut visit: impl FnMut(usize, Option<S>),
) {
    visit(k, None);
    let parts = model.forces[k].further.clone();
    if parts.is_empty() {
        return;
    }
    let mut least = threshold(model, k, motions, acting);
    for part in parts {
        let own = threshold(model, part, motions, acting);
        visit(part, Some(least - own));
        least = S::select(least - own, own, least);
    }
}

/// The results of one part of a force. The friction of a contact gives the last of them.
#[inline]
fn results_of_part<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
    out: &mut [S],
) {
    for k in model.with_companion(k) {
        let element = at_state(model, &model.forces[k], motions, acting);
        let first = out.len() - element.result_quantities().len();
        element.results(&reported(model, k, motions, acting), &mut out[first..]);
    }
}

/// Potential energy of force `k` with its further parts, J.
pub fn stored<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
) -> S {
    let of = |part| potential(model, part, motions, acting);
    model.parts(k).fold(S::zero(), |sum, part| sum + of(part))
}

/// Power that force `k` dissipates, W, with its further parts and the friction of a contact.
pub fn dissipated<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
) -> S {
    let mut powers = Powers::zero();
    for k in model.whole(k) {
        let element = at_state(model, &model.forces[k], motions, acting);
        let at = reported(model, k, motions, acting);
        element.action(&at, &mut |part: usize, body: usize, w: Wrench<S>| {
            powers.add(element.parts()[part].nature, || w.power(at.body(body).twist));
        });
        powers.add_own(element.own_powers(&at));
    }
    powers.dissipated
}
