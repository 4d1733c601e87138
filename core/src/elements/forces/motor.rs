//! Direct-current motor: a torque on body j, opposite on body i, from a voltage.
//!
//! With the current i, the relative rate ω = φ̇ⱼ - φ̇ᵢ and the torque constant k:
//!
//! ```text
//! T = k i        L di/dt = u - R i - k ω
//! ```
//!
//! With an inductance L the current is a first-order state; without it i = (u - k ω) / R. The voltage u is a law.
//! Energy: the source gives u i, the resistance takes R i², the inductance stores L i²/2, and the rest, k ω i, is the
//! power of the torque. All states.

use crate::elements::{
    element, measure, At, BodyId, Force, Mark, Measured, Nature, OwnPowers, OwnState, Part,
    SceneSymbol, Situation, Wrenches,
};
use crate::math::{Real, Wrench};

element! {
    /// Direct-current motor: torque = torque_constant × current on body j, opposite on body i, which is ground
    /// unless given. inductance × d current/dt = voltage - resistance × current - torque_constant × omega with
    /// omega = omega_j - omega_i. With an inductance, `current` is a state of the motor, 0 at the start unless set.
    Motor, "motor" {
        /// Body j, the rotor.
        j: body,
        /// Voltage; may use `t` and the state.
        voltage: law [V],
        /// Resistance of the winding.
        resistance: number [Ohm],
        /// Torque over current, which is also voltage over rate.
        torque_constant: number [N*m/A],
        /// Inductance of the winding.
        inductance: number [H] = 0.0,
        /// Body i, the stator.
        i: body = "ground",
    }
}

/// The back electromotive force k ω.
fn induced<S: Real>(e: &Motor<S>, at: &Situation<'_, S>) -> S {
    e.torque_constant * (at.j().twist.omega - at.i().twist.omega)
}

/// The current: the state, or without inductance that of the voltage.
fn current<S: Real>(e: &Motor<S>, at: &Situation<'_, S>) -> S {
    match at.z.first() {
        Some(current) => *current,
        None => (e.voltage - induced(e, at)) / e.resistance,
    }
}

impl Force for Motor {
    const MEASURED: &'static [Measured] = &[Measured::ANGLE];
    const PARTS: &'static [Part] = &[Part { name: "drive", nature: Nature::Exchanged }];

    fn bodies<S>(e: &Motor<S>) -> Vec<BodyId> {
        vec![e.i, e.j]
    }

    fn measure<S: Real>(_: &Motor<S>, at: &At<'_, S>, out: &mut [S]) {
        out[0] = measure::turned(at);
    }

    fn action<S: Real>(e: &Motor<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        let torque = e.torque_constant * current(e, at);
        out.put(0, 0, Wrench::torque(-torque));
        out.put(0, 1, Wrench::torque(torque));
    }

    fn states(given: &dyn Fn(&str) -> bool) -> &'static [OwnState] {
        match given("inductance") {
            true => &[OwnState { name: "current", unit: "A" }],
            false => &[],
        }
    }

    fn state_rates<S: Real>(e: &Motor<S>, at: &Situation<'_, S>, out: &mut [S]) {
        if let Some(rate) = out.first_mut() {
            *rate = (e.voltage - e.resistance * at.z[0] - induced(e, at)) / e.inductance;
        }
    }

    fn own_powers<S: Real>(e: &Motor<S>, at: &Situation<'_, S>) -> OwnPowers<S> {
        let current = current(e, at);
        OwnPowers { dissipated: e.resistance * current * current, applied: e.voltage * current }
    }

    fn own_energy<S: Real>(e: &Motor<S>, at: &Situation<'_, S>) -> S {
        match at.z.first() {
            Some(current) => S::constant(0.5) * e.inductance * *current * *current,
            None => S::zero(),
        }
    }

    fn symbols(e: &Motor) -> Vec<SceneSymbol> {
        vec![SceneSymbol::between_bodies(Mark::TorqueArrow, e.i, e.j)]
    }

    fn fault(e: &Motor) -> Option<(&'static str, String)> {
        if e.resistance <= 0.0 {
            return Some(("resistance", "must be positive".to_string()));
        }
        (e.inductance < 0.0).then(|| ("inductance", "must not be negative".to_string()))
    }
}
