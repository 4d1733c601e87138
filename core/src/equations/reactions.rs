//! Joint reactions (Haug 6.6.8, 6.6.9): F″ = -Cᵀ Aᵀ Φ_rᵀ λ and T″ = -(Φ_φᵀ - s′ᵀ Bᵀ Φ_rᵀ) λ.

use super::laws;
use crate::elements::{Side, MOST_EQUATIONS};
use crate::math::{Local, Motion, Real, Rotation, Vec2, Wrench};
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
    let item = &model.constraints[k];
    let values = laws::at(&model.parameters, motions, t);
    let law = item.law.as_ref().map(|law| law.map(&mut |tape| tape.evaluate(&values)));
    let element = law.as_ref().unwrap_or(&item.element);
    let ends = element.ends();
    let [i, j] = ends.map(|b| &motions[b.0].pose);
    let mut rows = [[S::zero(); 6]; MOST_EQUATIONS];
    element.jacobian(i, j, t, &mut rows[..lam.len()]);
    let (first, pose) = match side {
        Side::I => (0, i),
        Side::J => (3, j),
    };
    let mut w = Wrench::zero();
    for (row, lam) in rows.iter().zip(lam) {
        let [x, y, angle] = [0, 1, 2].map(|c| row[first + c] * *lam);
        w = w + -Wrench { force: Vec2::new(x, y), torque: angle };
    }
    let at = element.attachment(side);
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
