//! Observed order of the methods on mechanisms, as slopes.

use crate::mechanisms::{four_bar, model, run, start, tolerances, worst, DOUBLE_PENDULUM};
use kempe::analyses::dynamics::{Options, Scheme, Stabilization};
use kempe::analyses::State;
use kempe::integrate::Rk4;
use kempe::model::Model;

fn end(m: &Model, state: &State, options: &Options) -> Vec<f64> {
    let run = run(m, state, options);
    let n = m.layout.n_q;
    let last = (run.trajectory.t.len() - 1) * n;
    let mut y = run.trajectory.q[last..].to_vec();
    y.extend(&run.trajectory.v[last..]);
    y
}

fn rk4(t_end: f64, step: f64) -> Options {
    let scheme = Scheme::Rk4(Rk4::new(step));
    Options {
        method: scheme,
        stabilization: Stabilization::None,
        dense_output: false,
        ..Options::classical(t_end)
    }
}

/// Slopes of log error between successive halvings of the step.
fn slopes(m: &Model, state: &State, t_end: f64, first: f64) -> Vec<f64> {
    let exact = end(m, state, &rk4(t_end, first / 64.0));
    let errors: Vec<f64> =
        (0..4).map(|k| worst(&end(m, state, &rk4(t_end, first / 2f64.powi(k))), &exact)).collect();
    errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect()
}

#[test]
fn rk4_is_of_order_four_on_the_released_four_bar() {
    let (m, start) = four_bar();
    let slopes = slopes(&m, &start, 0.05, 0.05 / 16.0);
    assert!(slopes[1..].iter().all(|s| (3.8..4.4).contains(s)), "{slopes:?}");
}

#[test]
fn rk4_is_of_order_four_on_a_driven_double_pendulum() {
    let m = model(DOUBLE_PENDULUM);
    let (state, _) = start(&m, &[("lower.angle", "-1")], &[]);
    let slopes = slopes(&m, &state, 1.0, 1.0 / 32.0);
    assert!(slopes[1..].iter().all(|s| (3.8..4.3).contains(s)), "{slopes:?}");
}

/// For a 5(4) pair the error per step is held at the tolerance, so the global error is proportional
/// to it and the number of steps grows like tolerance^(-1/5).
#[test]
fn the_error_of_rk45_is_proportional_to_the_tolerance() {
    let (m, start) = four_bar();
    let free =
        |rtol: f64| Options { stabilization: Stabilization::None, ..tolerances(0.3, rtol, rtol) };
    let exact = end(&m, &start, &free(1e-13));
    let tolerances = [1e-4, 1e-6, 1e-8, 1e-10];
    let errors = tolerances.map(|rtol| worst(&end(&m, &start, &free(rtol)), &exact));
    let slope = (errors[0] / errors[3]).log10() / 6.0;
    assert!((0.8..1.2).contains(&slope), "{slope} of {errors:?}");
    let steps = tolerances.map(|rtol| run(&m, &start, &free(rtol)).statistics.steps as f64);
    let growth = (steps[3] / steps[1]).log10() / 4.0;
    assert!((0.17..0.23).contains(&growth), "{growth} of {steps:?}");
}
