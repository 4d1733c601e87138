//! A torque on body j while the force of a joint exceeds a limit: a switch on a reaction.

use crate::elements::{element, BodyId, Force, JointId, Nature, Part, Situation, Wrenches};
use crate::math::{Real, Wrench};

element! {
    /// A torque that a joint force switches on.
    Overload, "overload" {
        /// The joint.
        joint: joint,
        /// Body i.
        i: body,
        /// Body j.
        j: body,
        /// Torque above the limit.
        torque: number [N*m],
        /// Limit of the joint force.
        limit: number [N],
    }
}

/// |F|² - limit².
fn excess<S: Real>(e: &Overload<S>, at: &Situation<'_, S>) -> S {
    at.reaction.force.dot(at.reaction.force) - e.limit * e.limit
}

impl Force for Overload {
    const PARTS: &'static [Part] = &[Part { name: "torque", nature: Nature::Applied }];

    fn bodies<S>(e: &Overload<S>) -> Vec<BodyId> {
        vec![e.i, e.j]
    }

    fn reaction<S>(e: &Overload<S>) -> Option<JointId> {
        Some(e.joint)
    }

    fn switch_count<S: Real>(_: &Overload<S>) -> usize {
        1
    }

    fn switches<S: Real>(e: &Overload<S>, at: &Situation<'_, S>, out: &mut [S]) {
        out[0] = excess(e, at);
    }

    fn effort<S: Real>(e: &Overload<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
        (at.choose(0, excess(e, at), e.torque, S::zero()), Wrench::zero())
    }

    fn put_effort<S: Real>(
        _: &Overload<S>,
        _: &Situation<'_, S>,
        effort: S,
        mut out: impl Wrenches<S>,
    ) {
        out.put(0, 0, Wrench::torque(-effort));
        out.put(0, 1, Wrench::torque(effort));
    }

    fn action<S: Real>(e: &Overload<S>, at: &Situation<'_, S>, out: impl Wrenches<S>) {
        Self::put_effort(e, at, Self::effort(e, at).0, out);
    }
}
