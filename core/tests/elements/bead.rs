//! A bead on a parabola fixed in body j: Φ = Pᵢ - Pⱼ(u) with Pⱼ(u) = (u, b u²) in the frame of j and the
//! internal coordinate u.

use crate::elements::{element, At, Attachment, BodyId, Equation, Joint};
use crate::math::{Local, Pose, Real};

element! {
    /// A point on a parabola.
    Bead, "bead" {
        /// Point of body i.
        i: point,
        /// Body j, which carries the parabola.
        j: body,
        /// b in y = b x².
        bend: number [1/m],
    }
}

impl Joint for Bead {
    const OWN: usize = 1;

    fn bodies<S>(e: &Bead<S>) -> Vec<BodyId> {
        vec![e.i.body, e.j]
    }

    fn equations<S>(_: &Bead<S>) -> Vec<Equation> {
        vec![Equation::length("x"), Equation::length("y")]
    }

    fn residual<S: Real>(e: &Bead<S>, at: &At<'_, S>, phi: &mut [S]) {
        let u = at.own[0];
        let gap = at.i().point(e.i.s) - at.j().point(Local::new(u, e.bend * u * u));
        phi.copy_from_slice(&[gap.x, gap.y]);
    }

    fn attachment<S: Real>(e: &Bead<S>, body: usize) -> Attachment<S> {
        Attachment { s: [e.i.s, Local::zero()][body], axis: S::zero() }
    }

    fn own_start(e: &Bead, bodies: &[Pose]) -> Vec<f64> {
        let apart = bodies[0].point(e.i.s) - bodies[1].r;
        vec![bodies[1].rotation.inverse(apart).x]
    }
}
