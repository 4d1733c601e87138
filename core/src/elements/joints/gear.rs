//! Gear pair: two wheels roll on each other at their pitch circles.
//!
//! θ is the direction from the centre of wheel i to the centre of wheel j, the arm. Relative to the arm, both wheels
//! have the same speed at the pitch point: Φ = rᵢ (φᵢ - θ) + σ rⱼ (φⱼ - θ) - offset = 0, with σ = 1 for external and
//! σ = -1 for internal teeth (Willis's equation, integrated). θ has a branch cut, so that Φ is taken modulo 2π (rᵢ +
//! σ rⱼ), nearest 0. λ is the tangential force of the teeth. Its line of action is normal to the line of centres, so
//! that the pins carry it: ∂Φ/∂Pⱼ has length |rᵢ + σ rⱼ|/|d| = 1. The mechanism must hold the centres
//! |rᵢ + σ rⱼ| apart.
//!
//! Teeth with a pressure angle α touch along the line of action, inclined by α to the tangent of the pitch circles
//! (Shigley 13-9). The normal force |λ|/cos α has the radial part |λ| tan α along the line of centres, which pushes
//! the teeth apart for both signs of λ: external wheels away from each other, a wheel inside a ring towards the
//! centre of the ring. The centres are held, so that this force does no work and changes only the reactions of the
//! pins.
//!
//! With backlash b, the flanks touch at Φ = ±b/2, and there is no force between. The element is then a force,
//! `forces/play.rs`.

use crate::elements::wheels::{
    centres, meshed, nearest, radii, radius_fault, rolled, whole_turn, BACKLASH, TANGENTIAL,
};
use crate::elements::{
    element, measure, At, Attachment, Backlash, BodyId, Equation, Fixes, Joint, Mark, Required,
    ResultQuantity, SceneSymbol,
};
use crate::math::{Listed, Real, ShortArray, Wrench};
use std::f64::consts::{FRAC_PI_2, PI};

element! {
    /// Gear pair: the pitch circles of two wheels roll on each other. Φ = r_i (angle_i - θ) + σ r_j
    /// (angle_j - θ) - offset, reduced modulo 2π (r_i + σ r_j) to the value nearest 0. θ is the
    /// direction from centre i to centre j. σ is 1 for external and -1 for internal teeth. The
    /// joints of the mechanism hold the centres at the distance r_i + r_j, or |r_i - r_j| for
    /// internal teeth. λ is the tangential force of the teeth. Wheel j carries the torque -σ λ r_j
    /// about its centre and a force of magnitude |λ| normal to the line of centres. With `backlash`,
    /// Φ is between -backlash/2 and backlash/2, and there is a force only at these limits.
    Gear, "gear" {
        /// Centre of wheel i, as `body.point`.
        i: point,
        /// Centre of wheel j, as `body.point`.
        j: point,
        /// Radii of the pitch circles.
        radii: optional_pair [m],
        /// Numbers of teeth, in place of radii.
        teeth: optional_pair,
        /// Module, if `teeth` is given: each radius is module × teeth / 2.
        module: optional_number [m],
        /// Whether one wheel is inside the other.
        internal: flag = false,
        /// Constant that is subtracted in Φ.
        offset: number [m] = 0.0,
        /// Pressure angle of the teeth: the force |λ| tan(pressure_angle) along the line of centres pushes them apart.
        pressure_angle: number [rad] = 0.0,
        /// Total play of the teeth along the pitch circle.
        backlash: optional_number [m],
        /// With `backlash`: rate after a hit of the flanks over the rate before it, from 0 to 1.
        restitution: number = 0.0,
    }
}

fn radii_of<S: Real>(e: &Gear<S>) -> [S; 2] {
    radii(e.radii, e.teeth, e.module)
}

/// σ, and rᵢ + σ rⱼ.
fn sum<S: Real>(e: &Gear<S>) -> (f64, S) {
    let [r_i, r_j] = radii_of(e);
    match e.internal {
        true => (-1.0, r_i - r_j),
        false => (1.0, r_i + r_j),
    }
}

/// The fault of a field that is missing, superfluous or impossible.
fn given(e: &Gear) -> Option<(&'static str, String)> {
    let refuse = |field, message: &str| Some((field, message.to_string()));
    match (e.radii, e.teeth, e.module) {
        (None, None, None) => refuse("radii", "missing; give radii, or teeth and module"),
        (Some(_), Some(_), _) => refuse("teeth", "not together with radii; remove one of them"),
        (Some(_), _, Some(_)) => refuse("module", "not together with radii; remove one of them"),
        (_, Some(_), None) => refuse("module", "missing; teeth need it"),
        (_, None, Some(_)) => refuse("teeth", "missing; module needs it"),
        _ => None,
    }
}

impl Joint for Gear {
    const RESULTS: &'static [ResultQuantity] = &[TANGENTIAL];
    const LOOSE: &'static [&'static str] = &[BACKLASH];

    fn bodies<S>(e: &Gear<S>) -> Vec<BodyId> {
        vec![e.i.body, e.j.body]
    }

    fn equations<S>(_: &Gear<S>) -> Vec<Equation> {
        vec![Equation::length("tangential")]
    }

    fn residual<S: Real>(e: &Gear<S>, at: &At<'_, S>, phi: &mut [S]) {
        let (sigma, sum) = sum(e);
        let d = measure::apart(at, &e.i, &e.j);
        phi[0] = nearest(rolled(d, radii_of(e), sigma, at) - e.offset, sum);
    }

    fn requires<S: Real>(e: &Gear<S>, at: &At<'_, S>) -> Vec<Required<S>> {
        centres(measure::apart(at, &e.i, &e.j), Some(sum(e).1.abs()))
    }

    fn modulus(e: &Gear) -> Option<f64> {
        Some(whole_turn(sum(e).1))
    }

    fn phase_mut<S>(e: &mut Gear<S>) -> Option<&mut S> {
        Some(&mut e.offset)
    }

    fn backlash<S: Clone>(e: &Gear<S>) -> Option<Backlash<S>> {
        let restitution = Some(e.restitution.clone());
        e.backlash.clone().map(|size| Backlash { field: BACKLASH, size, half: 0.5, restitution })
    }

    fn play<S: Real>(e: &Gear<S>, at: &At<'_, S>) -> S {
        let d = measure::apart(at, &e.i, &e.j);
        -meshed(d, radii_of(e), sum(e).0, (e.offset, at))
    }

    fn pitch(e: &Gear) -> Option<f64> {
        e.module.map(|module| PI * module)
    }

    fn symbols(e: &Gear) -> Vec<SceneSymbol> {
        let radii = radii_of(e);
        let larger = radii[0].max(radii[1]);
        let mark = |radius| match e.internal && radius == larger {
            true => Mark::ToothedRing,
            false => Mark::ToothedWheel,
        };
        let wheels = SceneSymbol::wheels(radii.each(mark), radii, [&e.i, &e.j]);
        wheels.into_iter().map(|wheel| SceneSymbol { module: e.module, ..wheel }).list()
    }

    fn results<S: Real>(_: &Gear<S>, _: &At<'_, S>, lam: &[S], out: &mut [S]) {
        out[0] = lam[0];
    }

    fn has_load<S: Real>(e: &Gear<S>) -> bool {
        e.pressure_angle.largest_magnitude() != 0.0
    }

    fn load<S: Real>(
        e: &Gear<S>,
        at: &At<'_, S>,
        lam: &[S],
        out: &mut dyn FnMut(usize, Wrench<S>),
    ) {
        let d = measure::apart(at, &e.i, &e.j);
        let radial = S::constant(sum(e).0) * lam[0].abs() * e.pressure_angle.tan();
        let force = d.scale(radial / d.norm());
        out(0, Wrench::at(at.i().global(e.i.s), -force));
        out(1, Wrench::at(at.j().global(e.j.s), force));
    }

    fn attachment<S: Real>(e: &Gear<S>, body: usize) -> Attachment<S> {
        Attachment { s: [e.i.s, e.j.s][body], axis: S::zero() }
    }

    fn fixes<S: Clone>(_: &Gear<S>) -> Vec<Fixes<S>> {
        vec![Fixes::Turn]
    }

    fn fault(e: &Gear) -> Option<(&'static str, String)> {
        let number = |z: &f64| *z >= 1.0 && z.fract() == 0.0;
        if let Some(fault) = given(e) {
            return Some(fault);
        }
        if let Some(z) = e.teeth.iter().flatten().find(|z| !number(z)) {
            return Some(("teeth", format!("{z}; must be whole numbers from 1")));
        }
        if !(0.0..FRAC_PI_2).contains(&e.pressure_angle) {
            let message = format!("{} rad; must be at least 0 and less than π/2", e.pressure_angle);
            return Some(("pressure_angle", message));
        }
        if e.backlash.unwrap_or(0.0) == 0.0 && e.restitution != 0.0 {
            return Some(("restitution", "needs backlash; remove it".to_string()));
        }
        if e.backlash.is_some() && e.pressure_angle != 0.0 {
            let message = "not together with backlash; remove one of them".to_string();
            return Some(("pressure_angle", message));
        }
        let field = if e.radii.is_some() { "radii" } else { "module" };
        let faults = radii_of(e).each(|radius| radius_fault(field, radius, false));
        let equal = e.internal && sum(e).1 == 0.0;
        let same = (field, "internal wheels of equal radii have no arm; must differ".to_string());
        faults.into_iter().flatten().next().or(equal.then_some(same))
    }
}
