//! Switches of laws and forces: runs step to them exactly, whatever the method.

mod curves;
mod in_time;
mod jumps;
mod kinks;
mod of_elements;
mod on_state;

use crate::mechanisms;
use kempe::analyses::dynamics::{dynamics, Auto, Options, Run, Scheme, Stabilization};
use kempe::analyses::State;
use kempe::integrate::{AlphaParameters, Dop853, Flow, GeneralizedAlpha, Radau, Rk4, Rk45};
use kempe::model::Model;
use kempe::stabilize::Projection;

/// Moment of inertia of the wheel.
const INERTIA: f64 = 2.0;

/// A wheel on a pin, with a torque.
fn wheel(torque: &str) -> (Model, State) {
    wheel_with(torque, "")
}

/// A wheel on a pin, with a torque and further tables of the file.
fn wheel_with(torque: &str, more: &str) -> (Model, State) {
    let text = format!(
        "[bodies.ground]\npoints = {{ O = [0, 0] }}\n[bodies.wheel]\nmass = 1\ninertia = {INERTIA}\n\
         points = {{ O = [0, 0] }}\n[joints.pin]\ntype = 'revolute'\ni = 'ground.O'\nj = 'wheel.O'\n\
         [forces.drive]\ntype = 'torque'\nj = 'wheel'\ntorque = '{torque}'\n{more}"
    );
    let model = mechanisms::model(&text);
    let state = State { t: 0.0, q: vec![0.0; 3], v: vec![0.0; 3], z: Vec::new() };
    (model, state)
}

/// Every method, at a relative tolerance or a step.
fn methods(rtol: f64, step: f64) -> Vec<Scheme> {
    let atol = 1e-3 * rtol;
    let mut alpha = GeneralizedAlpha::new(AlphaParameters::chung_hulbert(0.8), rtol, atol);
    alpha.control.step = Some(step);
    // the errors of a method of order 2 add up over its many steps: to 6 rtol for a smooth pulse at rtol = 1e-3 and to
    // 60 rtol at 1e-6, with switches or without
    let rough = rtol.max(1e-3);
    let adaptive = GeneralizedAlpha::new(AlphaParameters::chung_hulbert(0.8), rough, 1e-3 * rough);
    let mut radau = Radau::new(rtol, atol);
    radau.control.step = Some(step);
    let mut auto = Auto::default();
    (auto.control.rtol, auto.control.atol) = (rtol, kempe::integrate::Atol::Scalar(atol));
    vec![
        Scheme::Rk45(Rk45::new(rtol, atol)),
        Scheme::Dop853(Dop853::new(rtol, atol)),
        Scheme::Rk4(Rk4::new(step)),
        Scheme::Radau(Radau::new(rtol, atol)),
        Scheme::Radau(radau),
        Scheme::GeneralizedAlpha(alpha),
        Scheme::GeneralizedAlpha(adaptive),
        Scheme::Auto(auto),
    ]
}

/// Options of a run by a method.
fn options(method: Scheme, t_end: f64) -> Options {
    let stabilization = Stabilization::Projection(Projection::default());
    Options { method, stabilization, ..Options::new(t_end) }
}

/// Runs, or panics with the law and the method.
#[track_caller]
fn run(what: &str, model: &Model, state: &State, options: &Options) -> Run {
    dynamics(model, state, options, |_| Flow::Continue)
        .unwrap_or_else(|failure| panic!("{what} by {:?}: {}", options.method, failure.reason))
}

/// The order of a method by its errors with steps near 0.04 and 0.01. The errors depend on the places of the switches
/// within the steps, so those of eight steps are added.
fn order(error: impl Fn(f64) -> f64) -> f64 {
    let size =
        |h: f64| -> f64 { (0..8).map(|k| error(h * (1.0 - 0.03 * f64::from(k))).powi(2)).sum() };
    0.25 * (size(0.04) / size(0.01)).log2()
}
