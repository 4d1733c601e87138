//! Friction of a joint that may slip, such as a wheel on a line: Coulomb's law along the quantity `slipped` of the joint.
//!
//! With the rate v of this quantity and the magnitude N of the reaction of the joint, the effort along it is -μ N sign v
//! while the joint slides. Where v is zero, the effort may have any value up to μ_s N, and an equation holds the
//! quantity. The reaction in turn depends on the friction, see `equations/reactive.rs`. Where the reaction changes its
//! sign, N has a bend, at which a step ends.
//!
//! The friction is a part of the joint: it has the name of the joint, and no file contains it.

use crate::elements::{
    element, holding, Behaviour, BodyId, Constraint, Force, JointId, Mode, Nature, Part,
    ResultQuantity, Situation, Wrenches,
};
use crate::expression::Tape;
use crate::math::{Real, Vec2, Wrench};

element! {
    /// Friction of a joint that may slip.
    SlipFriction, "joint (friction)" {
        /// The joint.
        joint: joint,
        /// Its quantity `slipped`.
        coordinate: acted,
        /// Coefficient of friction while the joint slides.
        kinetic: number,
        /// Coefficient of friction up to which the joint sticks.
        r#static: number,
    }
}

/// The reaction of the joint across the slip, and its direction.
fn across<S: Real>(e: &SlipFriction<S>, at: &Situation<'_, S>) -> (S, Vec2<S>) {
    let [x, y, _] = e.coordinate.gradient[1];
    let normal = Vec2::new(x, y).perp();
    (at.reaction.force.dot(normal), normal)
}

/// A factor times the load, and its derivatives with respect to the reaction.
fn times_load<S: Real>(factor: S, e: &SlipFriction<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
    let (across, normal) = across(e, at);
    let factor = at.choose(0, across, factor, -factor);
    (factor * across, Wrench { force: normal.scale(factor), torque: S::zero() })
}

/// The effort along the slip, and its derivatives with respect to the reaction.
fn effort<S: Real>(e: &SlipFriction<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
    let (one, zero, speed) = (S::one(), S::zero(), at.rate(&e.coordinate));
    let sense = match at.mode {
        mode if mode.holds() => return (-at.multiplier, Wrench::zero()),
        Mode::Slides(sign) => S::constant(sign),
        _ => S::select(speed, one, S::select(-speed, -one, zero)),
    };
    times_load(-sense * e.kinetic, e, at)
}

impl Force for SlipFriction {
    const PARTS: &'static [Part] = &[Part { name: "friction", nature: Nature::Dissipative }];
    const TOUCHES_OR_RUBS: bool = true;

    fn bodies<S>(e: &SlipFriction<S>) -> Vec<BodyId> {
        e.coordinate.of.bodies().into()
    }

    fn reaction<S>(e: &SlipFriction<S>) -> Option<JointId> {
        Some(e.joint)
    }

    fn effort<S: Real>(e: &SlipFriction<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
        effort(e, at)
    }

    fn put_effort<S: Real>(
        e: &SlipFriction<S>,
        _: &Situation<'_, S>,
        effort: S,
        mut out: impl Wrenches<S>,
    ) {
        for (body, wrench) in e.coordinate.wrenches(effort).into_iter().enumerate() {
            out.put(0, body, wrench);
        }
    }

    fn action<S: Real>(e: &SlipFriction<S>, at: &Situation<'_, S>, out: impl Wrenches<S>) {
        Self::put_effort(e, at, effort(e, at).0, out);
    }

    fn result_quantities<S>(_: &SlipFriction<S>) -> &'static [ResultQuantity] {
        const fn of(name: &'static str, unit: &'static str) -> ResultQuantity {
            ResultQuantity { name, unit, negative: None }
        }
        const { &[of("tangential", "N"), of("sticking", "")] }
    }

    fn results<S: Real>(e: &SlipFriction<S>, at: &Situation<'_, S>, out: &mut [S]) {
        let sticks = if at.mode.holds() { S::one() } else { S::zero() };
        out.copy_from_slice(&[-effort(e, at).0, sticks]);
    }

    fn switch_count<S: Real>(_: &SlipFriction<S>) -> usize {
        1
    }

    fn switches<S: Real>(e: &SlipFriction<S>, at: &Situation<'_, S>, out: &mut [S]) {
        out[0] = across(e, at).0;
    }

    fn behaviour<S: Real>(_: &SlipFriction<S>) -> Option<Behaviour<S>> {
        Some(Behaviour::Sticks)
    }

    fn threshold<S: Real>(e: &SlipFriction<S>, at: &Situation<'_, S>) -> S {
        at.rate(&e.coordinate)
    }

    fn limit<S: Real>(e: &SlipFriction<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
        times_load(e.r#static, e, at)
    }

    fn holding(e: &SlipFriction<Tape>, _: f64, value: f64) -> Option<Constraint<Tape>> {
        Some(holding(e.coordinate.of.clone(), Tape::from(value)))
    }
}
