//! Pin friction that depends on the reaction of its joint: torque on body j is -μ r |F| tanh(ω/ω₀) with
//! |F| the force of the joint and ω = φ̇ⱼ - φ̇ᵢ.

use crate::elements::{element, BodyId, Force, JointId, Nature, Part, Situation, Wrenches};
use crate::math::{Real, Wrench};

element! {
    /// Friction in a pin.
    Rubbing, "rubbing" {
        /// The joint.
        joint: joint,
        /// Body i of the joint.
        i: body,
        /// Body j of the joint.
        j: body,
        /// μ r.
        arm: number [m],
        /// ω₀.
        speed: number [rad/s] = 0.1,
    }
}

impl Force for Rubbing {
    const PARTS: &'static [Part] = &[Part { name: "friction", nature: Nature::Dissipative }];

    fn bodies<S>(e: &Rubbing<S>) -> Vec<BodyId> {
        vec![e.i, e.j]
    }

    fn reaction<S>(e: &Rubbing<S>) -> Option<JointId> {
        Some(e.joint)
    }

    fn effort<S: Real>(e: &Rubbing<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
        let force = at.reaction.force;
        let squared = force.dot(force);
        let load = S::select(squared, squared.sqrt(), S::zero());
        let rate = at.j().twist.omega - at.i().twist.omega;
        let per_load = -e.arm * (rate / e.speed).tanh();
        let slope = force.scale(S::select(squared, per_load / load, S::zero()));
        (per_load * load, Wrench { force: slope, torque: S::zero() })
    }

    fn put_effort<S: Real>(
        _: &Rubbing<S>,
        _: &Situation<'_, S>,
        effort: S,
        mut out: impl Wrenches<S>,
    ) {
        out.put(0, 0, Wrench::torque(-effort));
        out.put(0, 1, Wrench::torque(effort));
    }

    fn action<S: Real>(e: &Rubbing<S>, at: &Situation<'_, S>, out: impl Wrenches<S>) {
        Self::put_effort(e, at, Self::effort(e, at).0, out);
    }
}
