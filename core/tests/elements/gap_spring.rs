//! A rotational spring with play: the torque on body j is -(k (θ - gap) + p) where θ = φⱼ - φᵢ exceeds the gap, the opposite
//! on the other side, and 0 in the play. With a preload p it jumps at both ends of the play.

use crate::elements::{element, BodyId, Force, Nature, Part, Situation, Wrenches};
use crate::math::{Real, Wrench};

element! {
    /// A torsion spring with play.
    GapSpring, "gap_spring" {
        /// Body i.
        i: body,
        /// Body j.
        j: body,
        /// Torque per angle outside the play.
        stiffness: number [N*m/rad],
        /// Half the play.
        gap: number [rad],
        /// Torque at the end of the play.
        preload: number [N*m] = 0.0,
    }
}

/// The angle beyond each end of the play.
fn beyond<S: Real>(e: &GapSpring<S>, at: &Situation<'_, S>) -> [S; 2] {
    let angle = at.j().pose.angle - at.i().pose.angle;
    [angle - e.gap, -angle - e.gap]
}

impl Force for GapSpring {
    const PARTS: &'static [Part] = &[Part { name: "stiffness", nature: Nature::Conservative }];

    fn bodies<S>(e: &GapSpring<S>) -> Vec<BodyId> {
        vec![e.i, e.j]
    }

    fn switch_count<S: Real>(_: &GapSpring<S>) -> usize {
        2
    }

    fn switches<S: Real>(e: &GapSpring<S>, at: &Situation<'_, S>, out: &mut [S]) {
        out.copy_from_slice(&beyond(e, at));
    }

    fn action<S: Real>(e: &GapSpring<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        let [above, below] = beyond(e, at);
        let torque =
            |switch: usize, by: S| at.choose(switch, by, e.stiffness * by + e.preload, S::zero());
        let torque = torque(1, below) - torque(0, above);
        out.put(0, 0, Wrench::torque(-torque));
        out.put(0, 1, Wrench::torque(torque));
    }

    fn potential<S: Real>(e: &GapSpring<S>, at: &Situation<'_, S>) -> S {
        let half = S::constant(0.5);
        let stored = |switch: usize, by: S| {
            at.choose(switch, by, half * e.stiffness * by * by + e.preload * by, S::zero())
        };
        let [above, below] = beyond(e, at);
        stored(0, above) + stored(1, below)
    }
}
