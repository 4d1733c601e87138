//! A force that follows a displacement with a delay: ż = (x - z)/τ of the x of body j seen from body i,
//! force -k z along global x on body j at its origin. The potential of the states is not known to it.

use crate::elements::{element, BodyId, Force, Nature, OwnState, Part, Situation, Wrenches};
use crate::math::{Real, Vec2, Wrench};

element! {
    /// A spring behind a first-order filter.
    Lag, "lag" {
        /// Body i.
        i: body,
        /// Body j.
        j: body,
        /// Force per filtered displacement.
        stiffness: law [N/m],
        /// Time constant.
        time: number [s],
    }
}

impl Force for Lag {
    const PARTS: &'static [Part] = &[Part { name: "filtered", nature: Nature::Applied }];

    fn bodies<S>(e: &Lag<S>) -> Vec<BodyId> {
        vec![e.i, e.j]
    }

    fn action<S: Real>(e: &Lag<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        let force = Vec2::new(-e.stiffness * at.z[0], S::zero());
        let arm = at.j().pose.r - at.i().pose.r;
        out.put(0, 0, -Wrench::at(arm, force));
        out.put(0, 1, Wrench { force, torque: S::zero() });
    }

    fn states<'a>(_: &dyn Fn(&str) -> Option<&'a str>) -> &'static [OwnState] {
        &[OwnState { name: "filtered", unit: "m" }]
    }

    fn state_rates<S: Real>(e: &Lag<S>, at: &Situation<'_, S>, out: &mut [S]) {
        let x = at.j().pose.r.x - at.i().pose.r.x;
        out[0] = (x - at.z[0]) / e.time;
    }
}
