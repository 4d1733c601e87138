//! Direct-current motor: a torque on body j, and the opposite on body i, from a voltage or from a linear torque–speed
//! curve.
//!
//! With the current i, the relative rate ω = φ̇ⱼ - φ̇ᵢ and the torque constant k:
//!
//! ```text
//! T = k i        L di/dt = u - R i - k ω
//! ```
//!
//! With an inductance L, the current is a first-order state; without it, i = (u - k ω) / R. The voltage u is a law.
//! The source supplies the power u i, the resistance dissipates R i², the inductance stores the energy L i²/2, and
//! the remaining power k ω i is that of the torque. All states are allowed.
//!
//! In the second form, the torque is linear in the speed, between the stall torque T₀ and the free speed ω₀, with a
//! command c: T = T₀ (c - ω/ω₀). There is no circuit, and the power T ω counts as applied.

use crate::elements::{
    element, measure, At, BodyId, Force, Mark, Measured, Nature, OwnPowers, OwnState, Part,
    SceneSymbol, Situation, Wrenches,
};
use crate::math::{Real, Wrench};

element! {
    /// Direct-current motor: the torque on body j is torque_constant × current. The opposite torque
    /// acts on body i, which is ground by default. The current satisfies inductance × d
    /// current/dt = voltage - resistance × current - torque_constant × omega, where omega =
    /// omega_j - omega_i. With an inductance, `current` is a state of the motor, which is 0 at the
    /// start unless it is set. In the second form of the motor, torque = stall_torque (command -
    /// omega / free_speed).
    Motor, "motor" {
        /// Body j, the rotor.
        j: body,
        /// Voltage; may use `t` and the state.
        voltage: optional_law [V],
        /// Resistance of the winding; required with `voltage`.
        resistance: optional_number [Ohm],
        /// Torque per current, equal to voltage per angular velocity; required with `voltage`.
        torque_constant: optional_number [N*m/A],
        /// Inductance of the winding.
        inductance: number [H] = 0.0,
        /// Torque at rest, in place of `voltage`.
        stall_torque: optional_number [N*m],
        /// Angular velocity without torque; required with `stall_torque`.
        free_speed: optional_number [rad/s],
        /// Fraction of the full voltage, with `stall_torque`; may use `t` and the state.
        command: law = 1.0,
        /// Body i, the stator.
        i: body = "ground",
    }
}

/// ω.
fn rate<S: Real>(at: &Situation<'_, S>) -> S {
    at.j().twist.omega - at.i().twist.omega
}

/// A circuit with its voltage.
struct Circuit<S> {
    voltage: S,
    resistance: S,
    torque_constant: S,
}

impl<S: Real> Circuit<S> {
    /// The parameters of the voltage form; None in the other form.
    fn of(e: &Motor<S>) -> Option<Self> {
        let (voltage, resistance) = (e.voltage?, e.resistance?);
        Some(Self { voltage, resistance, torque_constant: e.torque_constant? })
    }

    /// The back electromotive force k ω.
    fn induced(&self, at: &Situation<'_, S>) -> S {
        self.torque_constant * rate(at)
    }

    /// The current: the state or, without inductance, the current that follows from the voltage.
    fn current(&self, at: &Situation<'_, S>) -> S {
        match at.z.first() {
            Some(current) => *current,
            None => (self.voltage - self.induced(at)) / self.resistance,
        }
    }
}

/// The torque on body j.
fn torque<S: Real>(e: &Motor<S>, at: &Situation<'_, S>) -> S {
    match (Circuit::of(e), e.stall_torque, e.free_speed) {
        (Some(circuit), ..) => circuit.torque_constant * circuit.current(at),
        (None, Some(stall), Some(free)) => stall * (e.command - rate(at) / free),
        _ => S::zero(),
    }
}

/// The fault of a field that is missing or does not belong to the form.
fn form(e: &Motor) -> Option<(&'static str, String)> {
    let refuse = |field, message: &str| Some((field, message.to_string()));
    let other = "not together with voltage; remove one of them";
    let circuit = "not together with stall_torque; remove one of them";
    match (e.voltage, e.stall_torque) {
        (None, None) => refuse("voltage", "missing; give voltage, or stall_torque and free_speed"),
        (Some(_), Some(_)) => refuse("stall_torque", other),
        (Some(_), None) if e.free_speed.is_some() => refuse("free_speed", other),
        (Some(_), None) if e.command != 1.0 => refuse("command", other),
        (Some(_), None) if e.resistance.is_none() => refuse("resistance", "missing"),
        (Some(_), None) if e.torque_constant.is_none() => refuse("torque_constant", "missing"),
        (None, Some(_)) if e.resistance.is_some() => refuse("resistance", circuit),
        (None, Some(_)) if e.torque_constant.is_some() => refuse("torque_constant", circuit),
        (None, Some(_)) if e.inductance != 0.0 => refuse("inductance", circuit),
        (None, Some(_)) if e.free_speed.is_none() => refuse("free_speed", "missing"),
        _ => None,
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
        let torque = torque(e, at);
        out.put(0, 0, Wrench::torque(-torque));
        out.put(0, 1, Wrench::torque(torque));
    }

    fn states<'a>(given: &dyn Fn(&str) -> Option<&'a str>) -> &'static [OwnState] {
        match given("inductance").is_some() {
            true => &[OwnState { name: "current", unit: "A" }],
            false => &[],
        }
    }

    fn state_rates<S: Real>(e: &Motor<S>, at: &Situation<'_, S>, out: &mut [S]) {
        if let (Some(rate), Some(c)) = (out.first_mut(), Circuit::of(e)) {
            *rate = (c.voltage - c.resistance * at.z[0] - c.induced(at)) / e.inductance;
        }
    }

    fn own_powers<S: Real>(e: &Motor<S>, at: &Situation<'_, S>) -> OwnPowers<S> {
        match Circuit::of(e) {
            Some(circuit) => {
                let current = circuit.current(at);
                OwnPowers {
                    dissipated: circuit.resistance * current * current,
                    applied: circuit.voltage * current,
                }
            }
            None => OwnPowers { dissipated: S::zero(), applied: torque(e, at) * rate(at) },
        }
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
        let positive = |field, x: Option<f64>| {
            let wrong = x.is_some_and(|x| x <= 0.0);
            wrong.then(|| (field, "must be positive".to_string()))
        };
        let negative = || ("inductance", "must not be negative".to_string());
        form(e)
            .or_else(|| positive("resistance", e.resistance))
            .or_else(|| positive("free_speed", e.free_speed))
            .or_else(|| positive("stall_torque", e.stall_torque))
            .or_else(|| (e.inductance < 0.0).then(negative))
    }
}
