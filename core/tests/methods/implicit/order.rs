//! Observed orders at index 3 and 2 on smooth problems.

use crate::mechanisms::{every, four_bar, model, run, start, worst, PENDULUM};
use kempe::analyses::dynamics::{Options, Scheme, Stabilization};
use kempe::analyses::State;
use kempe::integrate::{AlphaParameters, Dop853, GeneralizedAlpha, Radau};
use kempe::model::Model;
use kempe::stabilize::Projection;

/// q, v and λ over a grid of times.
struct Found {
    q: Vec<f64>,
    v: Vec<f64>,
    lam: Vec<f64>,
}

fn found(m: &Model, state: &State, t_end: f64, grid: f64, scheme: Scheme) -> Found {
    let options = Options {
        method: scheme,
        stabilization: Stabilization::Projection(Projection::default()),
        dense_output: false,
        ..Options::classical(t_end)
    };
    let run = run(m, state, &every(grid, options));
    let lam = run.accelerations(m).unwrap().lam;
    Found { q: run.trajectory.q, v: run.trajectory.v, lam }
}

/// Slopes of log error of q, v and λ between halvings of the step.
fn slopes(
    (m, state): (&Model, &State),
    (t_end, grid): (f64, f64),
    steps: impl Iterator<Item = f64>,
    scheme: impl Fn(f64) -> Scheme,
) -> Vec<[f64; 3]> {
    let exact = found(m, state, t_end, grid, Scheme::Dop853(Dop853::new(1e-13, 1e-14)));
    let errors: Vec<[f64; 3]> = steps
        .map(|h| {
            let f = found(m, state, t_end, grid, scheme(h));
            [worst(&f.q, &exact.q), worst(&f.v, &exact.v), worst(&f.lam, &exact.lam)]
        })
        .collect();
    errors.windows(2).map(|e| std::array::from_fn(|k| (e[0][k] / e[1][k]).log2())).collect()
}

/// Orders of q, v and λ.
fn near(slopes: &[[f64; 3]], expected: [f64; 3]) {
    let good = |s: &[f64; 3]| (0..3).all(|k| (s[k] - expected[k]).abs() <= 0.15);
    assert!(slopes.len() >= 3 && slopes.iter().all(good), "{slopes:.3?}");
}

fn alpha(parameters: AlphaParameters) -> impl Fn(f64) -> Scheme {
    move |h| Scheme::GeneralizedAlpha(GeneralizedAlpha::constant(parameters, h, 1e-10, 1e-12))
}

fn halvings(first: f64) -> impl Iterator<Item = f64> {
    (0..4).map(move |k| first / 2f64.powi(k))
}

#[test]
fn generalized_alpha_is_of_order_two_on_a_pendulum() {
    let m = model(PENDULUM);
    let (state, _) = start(&m, &[("rod.angle", "0.2"), ("rod.omega", "1")], &[]);
    for rho in [0.0, 0.5, 0.8] {
        let scheme = alpha(AlphaParameters::chung_hulbert(rho));
        near(&slopes((&m, &state), (1.0, 0.125), halvings(1.0 / 128.0), scheme), [2.0; 3]);
    }
    let scheme = alpha(AlphaParameters::hht(-0.1));
    near(&slopes((&m, &state), (1.0, 0.125), halvings(1.0 / 128.0), scheme), [2.0; 3]);
}

#[test]
fn generalized_alpha_is_of_order_two_on_the_flagship() {
    let (m, state) = four_bar();
    let scheme = alpha(AlphaParameters::chung_hulbert(0.8));
    near(&slopes((&m, &state), (0.25, 0.03125), halvings(1.0 / 1024.0), scheme), [2.0; 3]);
}

fn radau(h: f64) -> Scheme {
    Scheme::Radau(Radau::constant(h, 1e-13, 1e-14))
}

#[test]
fn radau_is_of_order_five_on_a_pendulum() {
    let m = model(PENDULUM);
    let (state, _) = start(&m, &[("rod.angle", "0.2"), ("rod.omega", "1")], &[]);
    near(&slopes((&m, &state), (1.0, 0.25), halvings(1.0 / 16.0), radau), [5.0; 3]);
}

#[test]
fn radau_is_of_order_five_on_the_flagship() {
    let (m, state) = four_bar();
    near(&slopes((&m, &state), (0.125, 0.125), halvings(1.0 / 80.0), radau), [5.0; 3]);
}
