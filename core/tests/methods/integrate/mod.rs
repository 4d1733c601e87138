//! Integrators: observed order, step counts of scipy, and every promise of the contract.

mod contract;
mod dop853;
mod events;
mod failures;
mod order;
mod path;
mod scipy;
mod second_order;
mod states;
mod whole;

use kempe::integrate::{ExplicitMethod, Flow, Ode, Step};
use whole::{Done, Ended, Explicit, Failure, Implicit, Observer};

/// A system by closure, without any stop.
struct Plain<F> {
    len: usize,
    f: F,
}

impl<F: FnMut(f64, &[f64], &mut [f64])> Ode for Plain<F> {
    type Stop = String;
    fn len(&self) -> usize {
        self.len
    }
    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), String> {
        (self.f)(t, y, dy);
        Ok(())
    }
}

fn plain<F: FnMut(f64, &[f64], &mut [f64])>(len: usize, f: F) -> Plain<F> {
    Plain { len, f }
}

type Outcome = Result<Done, Failure<String>>;

fn run<Y: Ode<Stop = String>>(
    method: &impl ExplicitMethod,
    mut system: Y,
    span: (f64, f64),
    y: &mut [f64],
) -> Outcome {
    method.integrate(&mut system, span.0, span.1, y, &mut |_: &Step<'_>| Flow::Continue)
}

fn van_der_pol(_: f64, y: &[f64], dy: &mut [f64]) {
    dy[0] = y[1];
    dy[1] = 2.0 * (1.0 - y[0] * y[0]) * y[1] - y[0];
}

fn kepler(_: f64, y: &[f64], dy: &mut [f64]) {
    let r3 = (y[0] * y[0] + y[1] * y[1]).powf(1.5);
    dy.copy_from_slice(&[y[2], y[3], -y[0] / r3, -y[1] / r3]);
}

fn relaxation(t: f64, y: &[f64], dy: &mut [f64]) {
    dy[0] = -200.0 * (y[0] - t.cos());
}

fn oscillator(_: f64, y: &[f64], dy: &mut [f64]) {
    dy.copy_from_slice(&[y[1], -y[0]]);
}

const KEPLER_START: [f64; 4] = [0.5, 0.0, 0.0, 1.732_050_807_568_877_2];
