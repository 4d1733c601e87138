//! One equation between three bodies: the angle of body k is the sum of those of bodies i and j.

use crate::elements::{element, At, Attachment, BodyId, Equation, Joint};
use crate::math::{Local, Real};

element! {
    /// A differential: angle_k = angle_i + angle_j.
    Pulley, "pulley" {
        /// Body i.
        i: body,
        /// Body j.
        j: body,
        /// Body k.
        k: body,
        /// Weight of the angle of body i.
        ratio: number = 1.0,
    }
}

impl Joint for Pulley {
    fn bodies<S>(e: &Pulley<S>) -> Vec<BodyId> {
        vec![e.i, e.j, e.k]
    }

    fn equations<S>(_: &Pulley<S>) -> Vec<Equation> {
        vec![Equation::angle("angle")]
    }

    fn residual<S: Real>(e: &Pulley<S>, at: &At<'_, S>, phi: &mut [S]) {
        let [i, j, k] = [&at.bodies[0], &at.bodies[1], &at.bodies[2]];
        phi[0] = k.angle - e.ratio * (i.angle - k.angle) - j.angle;
    }

    fn attachment<S: Real>(_: &Pulley<S>, _: usize) -> Attachment<S> {
        Attachment { s: Local::zero(), axis: S::zero() }
    }
}
