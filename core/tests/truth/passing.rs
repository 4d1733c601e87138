//! N windows of parallelograms past singular positions, against the pendulum that they are: ψ from upright
//! obeys ψ″ = ω² sin ψ, ω² = 3 g (3 N + 1) / (2 L (4 N + 1)).

use crate::mechanisms::{close, count, run};
use crate::n_four_bar::{upright, windows};
use kempe::analyses::dynamics::{dynamics, Auto, Options, Reason, Scheme, Stabilization};
use kempe::analyses::State;
use kempe::integrate::{
    AlphaParameters, Dop853, ExplicitMethod, Flow, GeneralizedAlpha, Ode, Radau, Rk4,
};
use kempe::model::Model;
use kempe::stabilize::Projection;

struct Pendulum {
    rate_squared: f64,
}

impl Pendulum {
    fn of(windows: usize) -> Self {
        let n = windows as f64;
        Self { rate_squared: 1.5 * 9.81 * (3.0 * n + 1.0) / (4.0 * n + 1.0) }
    }

    /// (ψ, ψ′) at each of the times, from the first on.
    fn swing(&mut self, start: [f64; 2], times: &[f64]) -> Vec<[f64; 2]> {
        let method = Dop853::new(1e-13, 1e-14);
        let mut y = start;
        let mut all = vec![start];
        for ends in times.windows(2) {
            let mut stepper = method.start(self, (ends[0], ends[1]), &y).expect("it swings");
            while stepper.t() != ends[1] {
                stepper.step(self).expect("it swings");
            }
            y.copy_from_slice(stepper.y());
            all.push(y);
        }
        all
    }
}

impl Ode for Pendulum {
    type Stop = ();
    fn len(&self) -> usize {
        2
    }
    fn rate(&mut self, _: f64, y: &[f64], dy: &mut [f64]) -> Result<(), ()> {
        dy.copy_from_slice(&[y[1], self.rate_squared * y[0].sin()]);
        Ok(())
    }
}

fn every_tenth(scheme: Scheme, t_end: f64) -> Options {
    let stabilization = Stabilization::Projection(Projection::default());
    let output_step = Some(0.1);
    Options {
        method: scheme,
        stabilization,
        output_step,
        dense_output: false,
        ..Options::classical(t_end)
    }
}

fn at(rtol: f64) -> Scheme {
    Scheme::Dop853(Dop853::new(rtol, 1e-3 * rtol))
}

/// Largest error of B0; couplers have to stay level, or a window left its branch.
fn error(n: usize, m: &Model, state: &State, options: &Options, start: [f64; 2]) -> f64 {
    let run = run(m, state, options);
    let most = match &options.method {
        Scheme::Dop853(method) if method.control.step.is_none() => 300,
        method if method.control().step.is_some() => 6000,
        _ => 1500,
    };
    assert!(run.statistics.steps < most, "{:?}", run.statistics);
    let truth = Pendulum::of(n).swing(start, &run.trajectory.t);
    let mut error = 0.0_f64;
    for (q, [psi, _]) in run.trajectory.q.chunks_exact(m.layout.n_q).zip(truth) {
        error = error.max((2.0 * q[0] - psi.sin()).hypot(2.0 * q[1] - psi.cos()));
        for k in 0..n {
            close("coupler", q[3 * (n + 1 + k) + 2], 0.0, 1e-5);
        }
    }
    error
}

/// At the default, all of a thousand windows on one line at once, several times.
#[test]
fn a_thousand_windows_pass() {
    let (m, state) = upright(1000);
    let options = every_tenth(Scheme::Auto(Auto::default()), count(3, 10) as f64);
    let error = error(1000, &m, &state, &options, [0.0, 1.0]);
    assert!(error < 1e-6, "{error}");
}

/// The error is proportional to the tolerance.
#[test]
fn no_tolerance_is_unlucky() {
    for n in [1, 2, count(8, 40) as usize] {
        let (m, state) = upright(n);
        for k in 0..=16 {
            let rtol = 10_f64.powf(-6.0 - 0.25 * f64::from(k));
            let error = error(n, &m, &state, &every_tenth(at(rtol), 10.0), [0.0, 1.0]);
            assert!(error < 100.0 * rtol, "N = {n}, rtol {rtol:.1e}: {error:.1e}");
        }
    }
}

/// One window, `below` the line by an angle, with the rate that leads it to rest on the line times
/// √(1 + excess).
fn thrown(below: f64, excess: f64) -> (Model, State, [f64; 2]) {
    let psi = std::f64::consts::FRAC_PI_2 + below;
    let rate = -(2.0 * Pendulum::of(1).rate_squared * below.sin() * (1.0 + excess)).sqrt();
    let (x, y) = (psi.sin(), psi.cos());
    let angle = std::f64::consts::FRAC_PI_2 - psi;
    let crank = |at: f64| [at + x / 2.0, y / 2.0, angle];
    let q = [crank(0.0), crank(1.0), [0.5 + x, y, 0.0]].concat();
    let turning = [y / 2.0 * rate, -x / 2.0 * rate, -rate];
    let v = [turning, turning, [y * rate, -x * rate, 0.0]].concat();
    (windows(1), State { t: 0.0, q, v, z: vec![] }, [psi, rate])
}

/// It turns back shortly before the line, or passes it slowly and comes back.
#[test]
fn what_comes_near_slowly_turns_or_passes() {
    for below in [0.3, 0.8] {
        for excess in [-0.01, -0.003, 0.02, 0.1] {
            let (m, state, start) = thrown(below, excess);
            for rtol in [1e-6, 1e-8, 1e-9] {
                let error = error(1, &m, &state, &every_tenth(at(rtol), 5.0), start);
                assert!(error < 100.0 * rtol, "{below} {excess} {rtol:.1e}: {error:.1e}");
            }
        }
    }
}

/// A mechanism at rest on the line could continue along either branch.
#[test]
fn what_comes_to_rest_on_the_line_is_undecided() {
    for below in [0.3, 0.8] {
        for excess in [-1e-4, -1e-6, 0.0, 1e-6, 1e-4] {
            let (m, state, _) = thrown(below, excess);
            for rtol in [1e-6, 1e-8] {
                let options = every_tenth(at(rtol), 5.0);
                let failure = dynamics(&m, &state, &options, |_| Flow::Continue).unwrap_err();
                let singular = matches!(failure.reason, Reason::Singular { t, .. } if t < 0.5);
                assert!(singular, "{below} {excess} {rtol:.1e}: {}", failure.reason);
            }
        }
    }
}

/// Methods that leave the line to DOP853, each with the error that it may have.
fn handing_over() -> Vec<(Scheme, f64)> {
    let alpha = AlphaParameters::chung_hulbert(0.8);
    vec![
        (Scheme::Radau(Radau::new(1e-8, 1e-11)), 1e-5),
        (Scheme::Radau(Radau::constant(2e-3, 1e-10, 1e-12)), 1e-6),
        (Scheme::GeneralizedAlpha(GeneralizedAlpha::new(alpha, 1e-6, 1e-9)), 2e-2),
        (Scheme::GeneralizedAlpha(GeneralizedAlpha::constant(alpha, 2e-3, 1e-10, 1e-12)), 1e-2),
        (Scheme::Rk4(Rk4::new(2e-3)), 1e-6),
    ]
}

#[test]
fn methods_that_cannot_place_their_steps_pass_as_well() {
    for n in [1, 2, count(8, 40) as usize] {
        let (m, state) = upright(n);
        for (scheme, allowed) in handing_over() {
            let error = error(n, &m, &state, &every_tenth(scheme.clone(), 3.0), [0.0, 1.0]);
            assert!(error < allowed, "N = {n}, {scheme:?}: {error:.1e}");
        }
    }
    let (m, state, start) = thrown(0.3, 0.1);
    for (scheme, allowed) in handing_over() {
        let error = error(1, &m, &state, &every_tenth(scheme.clone(), 5.0), start);
        assert!(error < 100.0 * allowed, "slowly, {scheme:?}: {error:.1e}");
    }
}

#[test]
fn by_these_methods_too_rest_on_the_line_is_undecided() {
    for excess in [-1e-4, 0.0, 1e-4] {
        let (m, state, _) = thrown(0.3, excess);
        for (scheme, _) in handing_over() {
            let options = every_tenth(scheme.clone(), 5.0);
            let failure = dynamics(&m, &state, &options, |_| Flow::Continue).unwrap_err();
            let singular = matches!(failure.reason, Reason::Singular { t, .. } if t < 0.5);
            assert!(singular, "{excess} {scheme:?}: {}", failure.reason);
        }
    }
}

/// The steps of a constant step end at the times of its grid again, behind the line.
#[test]
fn behind_the_line_a_constant_step_is_on_its_grid() {
    let (m, state) = upright(1);
    let step = 7e-3;
    let options = every_tenth(Scheme::Rk4(Rk4::new(step)), 2.0);
    let run = run(&m, &state, &Options { output_step: None, ..options });
    let on_grid = |t: &&f64| (*t / step - (*t / step).round()).abs() < 1e-9;
    let times = &run.trajectory.t;
    let off = times.iter().filter(|t| !on_grid(t)).count();
    assert!((1..40).contains(&off) && times.len() > 280 - 60, "{off} of {}", times.len());
    let last: Vec<&f64> = times.iter().rev().skip(1).take(20).collect();
    assert!(last.iter().all(on_grid), "{last:?}");
}
