//! Four equations between three bodies: they keep two distances from body i and do not turn against it.

use crate::elements::{element, At, Attachment, BodyId, Equation, Joint};
use crate::math::{Local, Real};

element! {
    /// Body j and body k follow body i in height and angle.
    Levels, "levels" {
        /// Body i.
        i: body,
        /// Body j.
        j: body,
        /// Body k.
        k: body,
        /// Height of body j above body i, and of body k above body j.
        steps: pair [m],
    }
}

impl Joint for Levels {
    fn bodies<S>(e: &Levels<S>) -> Vec<BodyId> {
        vec![e.i, e.j, e.k]
    }

    fn equations<S>(_: &Levels<S>) -> Vec<Equation> {
        let lengths = ["lower", "upper"].map(Equation::length);
        let angles = ["angle_j", "angle_k"].map(Equation::angle);
        [lengths, angles].concat()
    }

    fn residual<S: Real>(e: &Levels<S>, at: &At<'_, S>, phi: &mut [S]) {
        let [i, j, k] = [&at.bodies[0], &at.bodies[1], &at.bodies[2]];
        let height =
            |a: &crate::math::Pose<S>, b: &crate::math::Pose<S>| i.rotation.inverse(b.r - a.r).y;
        phi.copy_from_slice(&[
            height(i, j) - e.steps[0],
            height(j, k) - e.steps[1],
            j.angle - i.angle,
            k.angle - i.angle,
        ]);
    }

    fn attachment<S: Real>(_: &Levels<S>, _: usize) -> Attachment<S> {
        Attachment { s: Local::zero(), axis: S::zero() }
    }
}
