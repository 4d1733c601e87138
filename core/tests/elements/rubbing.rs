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

    fn action<S: Real>(e: &Rubbing<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        let squared = at.reaction.force.dot(at.reaction.force);
        let load = S::select(squared, squared.sqrt(), S::zero());
        let rate = at.j().twist.omega - at.i().twist.omega;
        let torque = -e.arm * load * (rate / e.speed).tanh();
        out.put(0, 0, Wrench::torque(-torque));
        out.put(0, 1, Wrench::torque(torque));
    }
}
