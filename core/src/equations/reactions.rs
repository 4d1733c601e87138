//! Joint reactions (Haug 6.6.8, 6.6.9): F″ = -Cᵀ Aᵀ Φ_rᵀ λ and T″ = -(Φ_φᵀ - s′ᵀ Bᵀ Φ_rᵀ) λ.

use crate::elements::{Attachment, BodyId, Side, MOST_EQUATIONS};
use crate::math::{Local, Motion, Pose, Real, Rotation, Vec2, Wrench};
use crate::model::Model;

/// The frame in which a reaction's components are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// Global.
    Global,
    /// Of the body that the reaction acts on.
    Body,
    /// Of the joint, fixed in that body: C of (6.6.8).
    Joint,
}

/// Force and torque of constraint `k` on its body i or j, reduced to the joint point; `lam` are the
/// multipliers of its own rows.
pub fn reaction<S: Real>(
    model: &Model<S>,
    k: usize,
    side: Side,
    frame: Frame,
    motions: &[Motion<S>],
    t: S,
    lam: &[S],
) -> Wrench<S> {
    let element = &model.constraints[k].element;
    let at = element.attachment(side);
    let ends = element.ends();
    let (body, own) = match side {
        Side::I => (ends[0], 0),
        Side::J => (ends[1], 3),
    };
    let w = match &model.constraints[k].law {
        Some(_) => by_law(model, k, body, motions, t, lam),
        None => {
            let [i, j] = ends.map(|b| &motions[b.0].pose);
            let mut rows = [[S::zero(); 6]; MOST_EQUATIONS];
            element.jacobian(i, j, t, &mut rows[..lam.len()]);
            against(rows.iter().map(|row| [0, 1, 2].map(|c| row[own + c])), lam)
        }
    };
    reduced(w, &motions[body.0].pose, at, frame)
}

/// The same on any body that the constraint touches, None for others. A body that only a law names,
/// such as the other wheel of a gear-like coupling, has no joint point: its reaction is reduced to
/// the origin of its frame, and its joint frame is the body frame.
pub fn reaction_on<S: Real>(
    model: &Model<S>,
    k: usize,
    body: BodyId,
    frame: Frame,
    motions: &[Motion<S>],
    t: S,
    lam: &[S],
) -> Option<Wrench<S>> {
    let [i, j] = model.constraints[k].element.ends();
    if body == i || body == j {
        let side = if body == j { Side::J } else { Side::I };
        return Some(reaction(model, k, side, frame, motions, t, lam));
    }
    model.layout.constraints[k].blocks.iter().find(|b| b.body == body)?;
    let at = Attachment { s: Local::zero(), axis: S::zero() };
    Some(reduced(by_law(model, k, body, motions, t, lam), &motions[body.0].pose, at, frame))
}

/// -Φ_qᵀ λ of one body for a constraint with a law, whose own derivatives count; what it takes from
/// all bodies together rests on ground.
fn by_law<S: Real>(
    model: &Model<S>,
    k: usize,
    body: BodyId,
    motions: &[Motion<S>],
    t: S,
    lam: &[S],
) -> Wrench<S> {
    let mut sum = Wrench::zero();
    for block in &model.layout.constraints[k].blocks {
        if block.body != body && !body.is_ground() {
            continue;
        }
        let mut rows = [S::zero(); 3 * MOST_EQUATIONS];
        let rows = &mut rows[..3 * lam.len()];
        super::constraints::law_block(model, &model.constraints[k], motions, t, block, rows);
        let w = against(rows.chunks_exact(3).map(|row| [row[0], row[1], row[2]]), lam);
        if !body.is_ground() {
            return w;
        }
        let arm = motions[block.body.0].pose.r;
        sum = sum + -Wrench { force: w.force, torque: w.torque + arm.cross(w.force) };
    }
    sum
}

/// -Σ λ row.
fn against<S: Real>(rows: impl Iterator<Item = [S; 3]>, lam: &[S]) -> Wrench<S> {
    let mut w = Wrench::zero();
    for ([x, y, angle], lam) in rows.zip(lam) {
        let row = Wrench { force: Vec2::new(x, y).scale(*lam), torque: angle * *lam };
        w = w + -row;
    }
    w
}

/// A wrench about the frame's origin, taken to the joint point and into a frame.
fn reduced<S: Real>(w: Wrench<S>, pose: &Pose<S>, at: Attachment<S>, frame: Frame) -> Wrench<S> {
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

/// Components in the frame asked for; the result's frame is the caller's knowledge from here on.
fn as_vector<S: Real>(s: Local<S>) -> Vec2<S> {
    Vec2::new(s.x, s.y)
}
