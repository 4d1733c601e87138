//! A force with every kind of field: (Fx, Fy) plus the sum of some gusts along x, in the frame of i, on body j at
//! its origin, times a factor, reversed on the left side; none if it is off.

use crate::elements::{element, BodyId, Force, Nature, Part, Side, Situation, Wrenches};
use crate::math::{Local, Real, Wrench};

element! {
    /// A force of wind.
    Blower, "blower" {
        /// Body on which it acts.
        j: body,
        /// Body i, which takes the opposite force.
        i: body = "ground",
        /// Components.
        force: law_pair [N],
        /// Added along x.
        gusts: laws [N],
        /// Factor.
        factor: optional_law [rad],
        /// Where the wind comes from.
        side: side = "right",
        /// Whether it is off.
        off: flag = false,
        /// Added to both components.
        more: optional_pair [N],
        /// Subtracted from both components.
        less: optional_number [N],
    }
}

impl Force for Blower {
    const PARTS: &'static [Part] = &[Part { name: "wind", nature: Nature::Applied }];

    fn bodies<S>(e: &Blower<S>) -> Vec<BodyId> {
        vec![e.i, e.j]
    }

    fn action<S: Real>(e: &Blower<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        let mut sum = Local::new(e.force[0], e.force[1]);
        e.gusts.iter().for_each(|gust| sum.x += *gust);
        let more = e.more.unwrap_or([S::zero(); 2]);
        let less = e.less.unwrap_or(S::zero());
        sum = sum + Local::new(more[0] - less, more[1] - less);
        let sign = match (e.off, e.side) {
            (true, _) => 0.0,
            (false, Side::Right) => 1.0,
            (false, Side::Left) => -1.0,
        };
        let local = sum.scale(e.factor.unwrap_or(S::one()) * S::constant(sign));
        let force = at.i().pose.global(local);
        let arm = at.j().pose.r - at.i().pose.r;
        out.put(0, 0, -Wrench::at(arm, force));
        out.put(0, 1, Wrench { force, torque: S::zero() });
    }
}
