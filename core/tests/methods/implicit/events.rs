//! Events within the steps of every method on mechanisms: their times are as good as the continuous
//! extension.

use crate::mechanisms::{column, four_bar, model, start, worst, PENDULUM};
use kempe::analyses::dynamics::{Options, Scheme, Stabilization, Stepper};
use kempe::analyses::State;
use kempe::integrate::{
    AlphaParameters, Direction, Dop853, GeneralizedAlpha, Radau, Rk4, Rk45, StepControl,
};
use kempe::model::Model;
use kempe::stabilize::Projection;

fn options(t_end: f64, scheme: Scheme) -> Options {
    let stabilization = Stabilization::Projection(Projection::default());
    Options { method: scheme, stabilization, dense_output: false, ..Options::classical(t_end) }
}

/// Where component `k` of (q, v) passes a level: the times within the steps of a method.
fn times(m: &Model, from: &State, options: &Options, (k, level): (usize, f64)) -> Vec<f64> {
    let value = |q: &[f64], v: &[f64]| if k < q.len() { q[k] } else { v[k - q.len()] } - level;
    let mut found = Vec::new();
    let mut stepper = Stepper::new(m, from, options).expect("a start");
    while !stepper.is_at_end() {
        stepper.step().unwrap_or_else(|failure| panic!("{}", failure.reason));
        let g = |_: f64, [q, v, _]: [&[f64]; 3]| value(q, v);
        if let Some(event) = stepper.locate(g, Direction::Any).expect("an interpolant") {
            let off = value(&event.q, &event.v);
            assert!(off.abs() < 1e-12, "{off:.1e}");
            found.push(event.t);
        }
    }
    found
}

fn exact(m: &Model, from: &State, t_end: f64, event: (usize, f64)) -> Vec<f64> {
    let scheme = Scheme::Dop853(Dop853::new(1e-13, 1e-15));
    let found = times(m, from, &options(t_end, scheme), event);
    assert!(found.len() > 2, "{found:?}");
    found
}

/// Mean slope of the log error of the times over three halvings of the step.
fn slope(
    (m, from): &(Model, State),
    t_end: f64,
    event: (usize, f64),
    first: f64,
    scheme: fn(f64) -> Scheme,
) -> f64 {
    let exact = exact(m, from, t_end, event);
    let error = |h: f64| worst(&times(m, from, &options(t_end, scheme(h)), event), &exact);
    (error(first) / error(first / 8.0)).log2() / 3.0
}

fn alpha(h: f64) -> Scheme {
    let parameters = AlphaParameters::chung_hulbert(0.8);
    Scheme::GeneralizedAlpha(GeneralizedAlpha::constant(parameters, h, 1e-11, 1e-13))
}

fn hht(h: f64) -> Scheme {
    let parameters = AlphaParameters::hht(-0.1);
    Scheme::GeneralizedAlpha(GeneralizedAlpha::constant(parameters, h, 1e-11, 1e-13))
}

fn radau(h: f64) -> Scheme {
    Scheme::Radau(Radau::constant(h, 1e-10, 1e-12))
}

fn rk45(h: f64) -> Scheme {
    Scheme::Rk45(Rk45 { control: StepControl { step: Some(h), ..StepControl::default() } })
}

/// A rod that swings, with the components of y that are its angle and its rate.
fn pendulum() -> ((Model, State), [usize; 2]) {
    let m = model(PENDULUM);
    let (state, _) = start(&m, &[("rod.angle", "0.2"), ("rod.omega", "1")], &[]);
    ((m, state), [2, 5])
}

/// The same of the flagship's crank, which swings about 2.1 rad.
fn crank() -> ((Model, State), [usize; 2]) {
    let (m, state) = four_bar();
    let (k, n) = (column(&m, "crank", 2), m.layout.n_q);
    ((m, state), [k, n + k])
}

/// Between the ends the polynomial of Hermite is better than the ends are.
#[test]
fn with_generalized_alpha_times_are_of_order_two() {
    for scheme in [alpha, hht] {
        let (rod, [angle, rate]) = pendulum();
        let (bars, [turn, speed]) = crank();
        for found in [
            slope(&rod, 4.0, (angle, -1.5), 1.0 / 64.0, scheme),
            slope(&rod, 4.0, (rate, 0.3), 1.0 / 64.0, scheme),
            slope(&bars, 1.0, (turn, 2.0), 1.0 / 512.0, scheme),
            slope(&bars, 1.0, (speed, 0.3), 1.0 / 512.0, scheme),
        ] {
            assert!((found - 2.0).abs() < 0.1, "{found:.2}");
        }
    }
}

/// The ends are of order 5; between them a step errs by h⁵ in q and by h⁴ in v.
#[test]
fn with_radau_times_are_of_order_five_and_four() {
    let (rod, [angle, rate]) = pendulum();
    let (bars, [turn, speed]) = crank();
    for (found, least) in [
        (slope(&rod, 4.0, (angle, -1.5), 1.0 / 16.0, radau), 4.8),
        (slope(&rod, 4.0, (rate, 0.3), 1.0 / 16.0, radau), 4.0),
        (slope(&bars, 1.0, (turn, 2.0), 1.0 / 128.0, radau), 4.8),
        (slope(&bars, 1.0, (speed, 0.3), 1.0 / 128.0, radau), 4.0),
    ] {
        assert!((least..5.3).contains(&found), "{found:.2}, at least {least}");
    }
}

#[test]
fn with_an_explicit_method_times_are_of_its_order() {
    let (bars, [turn, speed]) = crank();
    for component in [(turn, 2.0), (speed, 0.3)] {
        let found = slope(&bars, 1.0, component, 1.0 / 256.0, rk45);
        assert!((4.0..5.5).contains(&found), "{found:.2}");
    }
}

/// With steps of chosen length, forward and backward.
#[test]
fn controlled_steps_find_the_same_events() {
    let ((m, from), [turn, speed]) = crank();
    let parameters = AlphaParameters::chung_hulbert(0.8);
    for event in [(turn, 2.0), (speed, 0.3)] {
        let exact = exact(&m, &from, 1.0, event);
        for (scheme, bound) in [
            (Scheme::GeneralizedAlpha(GeneralizedAlpha::new(parameters, 1e-6, 1e-9)), 1e-4),
            (Scheme::Radau(Radau::new(1e-8, 1e-11)), 1e-9),
            (Scheme::Dop853(Dop853::new(1e-8, 1e-11)), 1e-8),
            (Scheme::Rk4(Rk4::new(1e-3)), 1e-8),
        ] {
            let off = worst(&times(&m, &from, &options(1.0, scheme.clone()), event), &exact);
            assert!(off < bound, "{scheme:?}: {off:.1e}");
        }
    }
    let ((m, from), [angle, _]) = pendulum();
    let radau = Scheme::Radau(Radau::new(1e-9, 1e-12));
    let back = times(&m, &from, &options(-3.0, radau), (angle, -1.5));
    assert!(worst(&back, &exact(&m, &from, -3.0, (angle, -1.5))) < 1e-8);
    assert!(back.windows(2).all(|pair| pair[1] < pair[0]));
}
