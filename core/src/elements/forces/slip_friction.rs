//! Friction of a joint that may slip, such as a wheel on a line: Coulomb's law along the quantity `slipped` of the joint.
//!
//! With the rate v of this quantity and the magnitude N of the reaction of the joint, the effort along it is -μ N sign v
//! while the joint slides. Where v is zero, the effort may have any value up to μ_s N, and an equation holds the
//! quantity. The reaction in turn depends on the friction, see `equations/reactive.rs`.
//!
//! The friction is a part of the joint: it has the name of the joint, and no file contains it.

use crate::elements::{
    element, holding, Behaviour, BodyId, Constraint, Force, JointId, Mode, Nature, Part,
    ResultQuantity, Situation, Wrenches,
};
use crate::expression::Tape;
use crate::math::{Real, Wrench};

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

/// A factor times the load, and its derivatives with respect to the reaction.
fn times_load<S: Real>(factor: S, at: &Situation<'_, S>) -> (S, Wrench<S>) {
    let (force, zero) = (at.reaction.force, S::zero());
    let squared = force.dot(force);
    let size = S::select(squared, squared.sqrt(), zero);
    let along = force.scale(S::select(squared, factor / size, zero));
    (factor * size, Wrench { force: along, torque: zero })
}

/// The effort along the slip, and its derivatives with respect to the reaction.
fn effort<S: Real>(e: &SlipFriction<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
    let (one, zero, speed) = (S::one(), S::zero(), at.rate(&e.coordinate));
    let sense = match at.mode {
        mode if mode.holds() => return (-at.multiplier, Wrench::zero()),
        Mode::Slides(sign) => S::constant(sign),
        _ => S::select(speed, one, S::select(-speed, -one, zero)),
    };
    times_load(-sense * e.kinetic, at)
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

    fn behaviour<S: Real>(_: &SlipFriction<S>) -> Option<Behaviour<S>> {
        Some(Behaviour::Sticks)
    }

    fn threshold<S: Real>(e: &SlipFriction<S>, at: &Situation<'_, S>) -> S {
        at.rate(&e.coordinate)
    }

    fn limit<S: Real>(e: &SlipFriction<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
        times_load(e.r#static, at)
    }

    fn holding(e: &SlipFriction<Tape>, _: f64, value: f64) -> Option<Constraint<Tape>> {
        Some(holding(e.coordinate.of.clone(), Tape::from(value)))
    }
}
