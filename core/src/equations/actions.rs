//! The actions of force elements as they are reported: with torques about the places at which the forces act.

use super::forces::{at_state, each_closer, each_wrench, reported, Acting};
use super::kinematics::Motions;
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
