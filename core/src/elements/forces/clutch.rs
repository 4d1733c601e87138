//! Friction clutch or brake: it transmits a torque up to its capacity between two bodies.
//!
//! With ω = ωⱼ - ωᵢ, the torque on body j is -capacity × sign ω while the clutch slips. Where ω is zero it may stick:
//! the torque then has any value up to the capacity, and an equation holds φⱼ - φᵢ. A one-way clutch only pushes: its
//! torque on body j is not negative, so that body j may run ahead.

use crate::elements::{
    element, holding_angle, Behaviour, BodyId, Constraint, Force, Mark, Mode, Nature, Part,
    ResultQuantity, SceneSymbol, Situation, Wrenches,
};
use crate::expression::Tape;
use crate::math::{Real, Wrench};

element! {
    /// Friction clutch or brake: with ω = omega_j - omega_i, the torque on body j is -capacity × sign ω
    /// while the clutch slips, and any torque up to the capacity while it sticks. The opposite torque
    /// acts on body i. With `one_way`, the torque on body j is never negative: body i drives body j,
    /// and body j may run ahead.
    Clutch, "clutch" {
        /// Body i: the driving side, or ground for a brake.
        i: body,
        /// Body j: the driven side.
        j: body,
        /// Largest torque; may use `t` and the state. Negative values count as 0.
        capacity: law [N*m],
        /// Whether body j may run ahead of body i freely.
        one_way: flag = false,
    }
}

/// ω, rad/s.
fn slip<S: Real>(at: &Situation<'_, S>) -> S {
    at.j().twist.omega - at.i().twist.omega
}

fn capacity<S: Real>(e: &Clutch<S>) -> S {
    S::select(e.capacity, e.capacity, S::zero())
}

/// The torque on body j.
fn torque<S: Real>(e: &Clutch<S>, at: &Situation<'_, S>) -> S {
    let (one, zero) = (S::one(), S::zero());
    let sense = match at.mode {
        mode if mode.holds() => return -at.multiplier,
        Mode::Slides(sign) => S::constant(sign),
        _ => S::select(slip(at), one, S::select(-slip(at), -one, zero)),
    };
    let ahead = if e.one_way { S::select(sense, zero, sense) } else { sense };
    -(ahead * capacity(e))
}

impl Force for Clutch {
    const PARTS: &'static [Part] = &[Part { name: "dry", nature: Nature::Dissipative }];
    const TOUCHES_OR_RUBS: bool = true;

    fn bodies<S>(e: &Clutch<S>) -> Vec<BodyId> {
        vec![e.i, e.j]
    }

    fn effort<S: Real>(e: &Clutch<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
        (torque(e, at), Wrench::zero())
    }

    fn put_effort<S: Real>(
        _: &Clutch<S>,
        _: &Situation<'_, S>,
        torque: S,
        mut out: impl Wrenches<S>,
    ) {
        out.put(0, 0, Wrench::torque(-torque));
        out.put(0, 1, Wrench::torque(torque));
    }

    fn action<S: Real>(e: &Clutch<S>, at: &Situation<'_, S>, out: impl Wrenches<S>) {
        Self::put_effort(e, at, torque(e, at), out);
    }

    fn result_quantities<S>(_: &Clutch<S>) -> &'static [ResultQuantity] {
        const fn of(name: &'static str, unit: &'static str) -> ResultQuantity {
            ResultQuantity { name, unit, negative: None }
        }
        const { &[of("torque", "N*m"), of("slip", "rad/s"), of("sticking", "")] }
    }

    fn results<S: Real>(e: &Clutch<S>, at: &Situation<'_, S>, out: &mut [S]) {
        let sticks = if at.mode.holds() { S::one() } else { S::zero() };
        out.copy_from_slice(&[torque(e, at), slip(at), sticks]);
    }

    fn behaviour<S: Real>(_: &Clutch<S>) -> Option<Behaviour<S>> {
        Some(Behaviour::Sticks)
    }

    fn threshold<S: Real>(_: &Clutch<S>, at: &Situation<'_, S>) -> S {
        slip(at)
    }

    fn limit<S: Real>(e: &Clutch<S>, _: &Situation<'_, S>) -> (S, Wrench<S>) {
        (capacity(e), Wrench::zero())
    }

    fn only_pushes<S>(e: &Clutch<S>) -> bool {
        e.one_way
    }

    fn holding(e: &Clutch<Tape>, _: f64, value: f64) -> Option<Constraint<Tape>> {
        Some(holding_angle(e.i, e.j, Tape::from(value)))
    }

    fn fault(e: &Clutch) -> Option<(&'static str, String)> {
        (e.capacity < 0.0).then(|| ("capacity", "must not be negative".to_string()))
    }

    fn symbols(e: &Clutch) -> Vec<SceneSymbol> {
        vec![SceneSymbol::between_bodies(Mark::RubbingPin, e.i, e.j)]
    }
}
