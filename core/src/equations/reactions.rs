//! Joint reactions (Haug 6.6.8, 6.6.9): F″ = -Cᵀ Aᵀ Φ_rᵀ λ and T″ = -(Φ_φᵀ - s′ᵀ Bᵀ Φ_rᵀ) λ, and the
//! [loads](crate::elements::Joint::load) of joints.

use super::constraints;
use super::kinematics::Motions;
use crate::elements::derive::{ByThree, OfRows};
use crate::elements::{At, Attachment, BodyId};
use crate::math::{each, Dual, Lift, Listed, Local, Pose, Real, Rotation, Vec2, Wrench};
use crate::model::Model;
use std::ops::Range;

/// The frame in which the components of a reaction are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// The global frame.
    Global,
    /// The frame of the body on which the reaction acts.
    Body,
    /// The joint frame, fixed in that body: C of (6.6.8).
    Joint,
}

/// Force and torque of constraint `k` on a body, reduced to the joint point. `lam` contains the multipliers of its
/// rows. None if the constraint does not touch the body.
///
/// A body that occurs only in a law, such as the second wheel of a coupling by angles, has no joint point. Its
/// reaction is reduced to the origin of its frame, and its joint frame is the body frame. The reaction on ground is
/// opposite to the sum of the reactions on all other bodies.
pub fn reaction<S: Real>(
    model: &Model<S>,
    k: usize,
    body: BodyId,
    frame: Frame,
    motions: &Motions<S>,
    t: S,
    lam: &[S],
) -> Option<Wrench<S>> {
    let item = &model.constraints[k];
    if !touched(model, k).any(|known| known == body) {
        return None;
    }
    let at = attached(model, k, body, motions, t);
    let mut on_body = match body.is_ground() && item.law.is_some() {
        true => on_ground(model, k, motions, t, lam),
        false => against(model, k, body, motions, t, lam),
    };
    each_load(model, k, motions, t, lam, |on, w| {
        if on == body {
            on_body = on_body + w;
        }
    });
    Some(reduced(on_body, &motions[body.0].pose, at, frame))
}

/// The reactions of joint `k` on its body j at its joint point, in the global frame, for a unit multiplier of each of its
/// rows, without loads.
pub(super) fn units<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    t: S,
) -> Vec<Wrench<S>> {
    let Some(body) = model.constraints[k].bodies.get(1) else { return Vec::new() };
    let rows = model.layout.constraints[k].rows.len();
    let mut columns = OfRows::new(rows, [S::zero(); 3]);
    constraints::columns_by_body(model, k, motions, t, *body, columns.all());
    let at = attached(model, k, *body, motions, t);
    let unit = |[x, y, angle]: &[S; 3]| {
        let w = -Wrench { force: Vec2::new(*x, *y), torque: *angle };
        reduced(w, &motions[body.0].pose, at, Frame::Global)
    };
    columns.all().iter().map(unit).list()
}

/// The bodies on which constraint `k` acts, each once: those of the element, i and j first, then those of its laws.
///
/// Coordinates in a law are measured relative to ground, on which the opposite force acts.
pub fn touched<S>(model: &Model<S>, k: usize) -> impl Iterator<Item = BodyId> + '_ {
    let item = &model.constraints[k];
    let all = item.bodies.iter().enumerate();
    let own = all.filter(|(k, body)| !item.bodies[..*k].contains(body)).map(|(_, body)| *body);
    let blocks = model.layout.constraints[k].blocks.iter().filter_map(|block| block.body);
    let others = blocks.filter(|body| !item.bodies.contains(body));
    let ground = (item.measures_from_ground && !item.bodies.iter().any(|body| body.is_ground()))
        .then_some(BodyId(0));
    own.chain(others).chain(ground)
}

/// The global point at which the reaction of constraint `k` on a body is given. Its force acts at this point, and its
/// torque is about this point.
pub fn place<S: Real>(
    model: &Model<S>,
    k: usize,
    body: BodyId,
    motions: &Motions<S>,
    t: S,
) -> Vec2<S> {
    motions[body.0].pose.point(attached(model, k, body, motions, t).s)
}

/// The joint frame on a body, with its origin at the point where the reaction acts.
pub(super) fn attached<S: Real>(
    model: &Model<S>,
    k: usize,
    body: BodyId,
    motions: &Motions<S>,
    t: S,
) -> Attachment<S> {
    let item = &model.constraints[k];
    let Some(place) = item.bodies.iter().position(|b| *b == body) else {
        return Attachment { s: Local::zero(), axis: S::zero() };
    };
    let joint = item.element.attachment(place);
    match contact(model, k, motions, t) {
        // the point where the reaction acts, in the frame of this body
        Some(contact) => {
            let pose = motions[body.0].pose;
            Attachment { s: pose.rotation.inverse(contact - pose.r), ..joint }
        }
        None => joint,
    }
}

/// The joints with a load.
pub(super) fn loaded<S: Real>(model: &Model<S>) -> impl Iterator<Item = usize> + '_ {
    let all = model.constraints.iter().enumerate();
    all.filter(|(_, item)| item.element.has_load()).map(|(k, _)| k)
}

/// Adds the loads of all joints to Q, shape (n_q).
pub fn add_loads<S: Real>(model: &Model<S>, motions: &Motions<S>, t: S, lam: &[S], q: &mut [S]) {
    for k in loaded(model) {
        let own = &lam[model.layout.constraints[k].rows.clone()];
        add_load(model, k, motions, t, own, q);
    }
}

/// Adds the load of joint `k` for the multipliers `lam` of its rows to Q, shape (n_q).
pub(super) fn add_load<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    t: S,
    lam: &[S],
    q: &mut [S],
) {
    each_load(model, k, motions, t, lam, |body, w| {
        model.layout.bodies[body.0].add([w.force.x, w.force.y, w.torque], q);
    });
}

/// Adds the derivatives of the loads of all joints with respect to the multiplier of one row, shape (n_q).
pub fn add_load_slopes<S: Real>(
    model: &Model<S>,
    motions: &Motions<S>,
    t: S,
    (lam, row): (&[S], usize),
    out: &mut [S],
) {
    for k in loaded(model) {
        let rows = &model.layout.constraints[k].rows;
        if !rows.contains(&row) {
            continue;
        }
        let seeded = |at: usize| match at == row {
            true => ByThree::<S>::variable(lam[at], 0),
            false => Dual::lift(lam[at]),
        };
        let lam: Vec<ByThree<S>> = rows.clone().map(seeded).list();
        let item = &model.constraints[k];
        let element = item.element.map(&mut |x: &S| Dual::lift(*x));
        let pose = |body: &BodyId| motions[body.0].pose.lift();
        let bodies: Vec<Pose<ByThree<S>>> = item.bodies.iter().map(pose).list();
        let at = At { bodies: &bodies, own: &[], t: Dual::lift(t) };
        element.load(&at, &lam, &mut |place, w: Wrench<ByThree<S>>| {
            let slopes = each([w.force.x, w.force.y, w.torque], |x| x.slope[0]);
            model.layout.bodies[item.bodies[place].0].add(slopes, out);
        });
    }
}

/// Calls `visit` with the load of constraint `k` on each of its bodies, about the origin of the body frame.
pub(super) fn each_load<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    t: S,
    lam: &[S],
    mut visit: impl FnMut(BodyId, Wrench<S>),
) {
    let item = &model.constraints[k];
    positions(model, k, motions, t, |at| {
        item.element.load(at, lam, &mut |place, w| visit(item.bodies[place], w));
    });
}

/// Calls `f` with the positions of the participants of constraint `k`.
fn positions<S: Real, R>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    t: S,
    f: impl FnOnce(&At<'_, S>) -> R,
) -> R {
    let item = &model.constraints[k];
    let (own, _) = motions.own(model.layout.constraints[k].own);
    let mut bodies = constraints::poses(&item.bodies, motions);
    f(&At { bodies: bodies.all(), own, t })
}

/// The global point where the reaction of constraint `k` acts, if this point moves on body j.
fn contact<S: Real>(model: &Model<S>, k: usize, motions: &Motions<S>, t: S) -> Option<Vec2<S>> {
    let item = &model.constraints[k];
    let on_j = positions(model, k, motions, t, |at| item.element.contact(at))?;
    Some(motions[item.bodies[1].0].pose.point(on_j))
}

/// The results of constraint `k` in addition to its reaction, in the order of its declaration. `lam` contains the
/// multipliers of its rows.
pub fn results<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    t: S,
    lam: &[S],
    out: &mut [S],
) {
    positions(model, k, motions, t, |at| model.constraints[k].element.results(at, lam, out));
}

/// -Φ_qᵀ λ in the columns of one body: the wrench about the origin of its frame.
fn against<S: Real>(
    model: &Model<S>,
    k: usize,
    body: BodyId,
    motions: &Motions<S>,
    t: S,
    lam: &[S],
) -> Wrench<S> {
    let mut rows = OfRows::new(lam.len(), [S::zero(); 3]);
    constraints::columns_by_body(model, k, motions, t, body, rows.all());
    let mut w = Wrench::zero();
    for ([x, y, angle], lam) in rows.all().iter().zip(lam) {
        let row = Wrench { force: Vec2::new(*x, *y).scale(*lam), torque: *angle * *lam };
        w = w + -row;
    }
    w
}

/// Minus the sum of the reactions of a constraint with a law on all moving bodies, about the global origin.
fn on_ground<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    t: S,
    lam: &[S],
) -> Wrench<S> {
    let mut sum = Wrench::zero();
    for body in model.layout.constraints[k].blocks.iter().filter_map(|block| block.body) {
        let w = against(model, k, body, motions, t, lam);
        let arm = motions[body.0].pose.r;
        sum = sum + -Wrench { force: w.force, torque: w.torque + arm.cross(w.force) };
    }
    sum
}

/// A wrench about the origin of the frame, reduced to the joint point and expressed in the requested frame.
pub(super) fn reduced<S: Real>(
    w: Wrench<S>,
    pose: &Pose<S>,
    at: Attachment<S>,
    frame: Frame,
) -> Wrench<S> {
    let arm = pose.global(at.s);
    let force = match frame {
        Frame::Global => w.force,
        Frame::Body => as_vector(pose.rotation.inverse(w.force)),
        Frame::Joint => {
            let in_body = as_vector(pose.rotation.inverse(w.force));
            as_vector(Rotation::new(at.axis).inverse(in_body))
        }
    };
    Wrench { force, torque: w.torque - arm.cross(w.force) }
}

/// Converts components to the vector type. The caller is responsible for the frame.
fn as_vector<S: Real>(s: Local<S>) -> Vec2<S> {
    Vec2::new(s.x, s.y)
}

/// The rows of the multipliers that force `k` sees as its reaction: those of its joint, or that of the contact at rest to
/// which it belongs.
pub(super) fn rows_seen<S>(model: &Model<S>, k: usize) -> Range<usize> {
    let item = &model.forces[k];
    match (item.reaction, item.load_row) {
        (Some(joint), _) => model.layout.constraints[joint.0].rows.clone(),
        (None, Some(row)) => row..row + 1,
        (None, None) => 0..0,
    }
}

/// The reaction that force `k` sees for a unit multiplier of each of these rows.
pub(super) fn units_seen<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    t: S,
) -> Vec<Wrench<S>> {
    let item = &model.forces[k];
    match (item.reaction, item.load_row) {
        (Some(joint), _) => units(model, joint.0, motions, t),
        (None, Some(_)) => vec![of_row(S::one())],
        (None, None) => Vec::new(),
    }
}

/// The reaction that stands for the multiplier of one row.
pub(super) fn of_row<S: Real>(lam: S) -> Wrench<S> {
    Wrench { force: Vec2::new(lam, S::zero()), torque: S::zero() }
}
