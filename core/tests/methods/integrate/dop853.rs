//! DOP853: pair, estimate and extension those of scipy, of order 8 and 7; steps of its own.

use super::contract::OnCircle;
use super::*;
use kempe::integrate::{Atol, Dop853, StepControl};

/// Sees the steps from their ends only.
struct Ends;

impl Observer for Ends {
    fn step(&mut self, _: &Step<'_>) -> Flow {
        Flow::Continue
    }
    fn looks_inside(&self, _: f64, _: f64) -> bool {
        false
    }
}

fn ends<Y: Ode<Stop = String>>(
    method: &Dop853,
    mut system: Y,
    (t0, t_end): (f64, f64),
    y: &mut [f64],
) -> Done {
    method.integrate(&mut system, t0, t_end, y, &mut Ends).unwrap()
}

type F = fn(f64, &[f64], &mut [f64]);
const VDP: (F, &[f64]) = (van_der_pol, &[2.0, 0.0]);
const ORBIT: (F, &[f64]) = (kepler, &KEPLER_START);
const LINEAR: (F, &[f64]) = (relaxation, &[0.0]);

/// Length of the first accepted step, y₀ after it, and how often it was rejected.
fn first((f, y0): (F, &[f64]), method: &Dop853) -> (f64, f64, usize) {
    let mut seen = [f64::NAN; 2];
    let mut observer = |step: &Step<'_>| {
        seen = [step.t, step.y[0]];
        Flow::Stop
    };
    let (mut system, mut y) = (plain(y0.len(), f), y0.to_vec());
    let done = method.integrate(&mut system, 0.0, 2.0, &mut y, &mut observer).unwrap();
    (seen[0], seen[1], done.rejected)
}

/// The longest first step that `scipy.integrate.DOP853` accepts, by bisection, with the first component
/// after it, and the one that it chooses itself; scipy 1.17.1.
#[test]
fn it_judges_steps_as_scipy_does() {
    let cases = [
        (VDP, 1e-3, 0.48600037869134216, 1.8885981610151013, 0.0004997501249375312),
        (VDP, 1e-6, 0.25548769284709083, 1.9582849654001062, 0.0004997501249375312),
        (VDP, 1e-9, 0.14792418617516986, 1.9833748870954613, 0.0004997501249375312),
        (ORBIT, 1e-3, 0.5592497992907871, 0.06335029830690753, 0.0003240255242360249),
        (ORBIT, 1e-6, 0.19618373909713166, 0.4275225670284716, 0.0003240255242360249),
        (ORBIT, 1e-9, 0.07703046919399976, 0.48824820757699755, 0.0003240255242360249),
        (LINEAR, 1e-3, 0.011798614352705426, 0.905511069513287, 1e-4),
        (LINEAR, 1e-6, 0.004976964832222222, 0.6304185250374996, 1e-4),
        (LINEAR, 1e-9, 0.0019934261479334706, 0.3287978176746347, 1e-4),
    ];
    for (problem, rtol, longest, y, chosen) in cases {
        let method = Dop853::new(rtol, 1e-3 * rtol);
        // next to 1 the norm is known to rounding over the tolerance
        let near = 1e-12 + 1e-15 / rtol;
        let told = |h: f64| {
            first(
                problem,
                &Dop853 { control: StepControl { first_step: Some(h), ..method.control.clone() } },
            )
        };
        let (h, found, rejected) = told(longest * (1.0 - near));
        assert_eq!((h, rejected), (longest * (1.0 - near), 0), "{rtol}");
        assert!((found - y).abs() < 10.0 * near, "{found} {y}");
        let (h, _, rejected) = told(longest * (1.0 + near));
        assert!(rejected == 1 && (h / longest - 0.8).abs() < 1e-6, "{rtol} {h}");
        assert!((first(problem, &method).0 / chosen - 1.0).abs() < 1e-14, "{rtol}");
    }
}

/// Steps, evaluations and last state of `scipy.integrate.solve_ivp(f, (t0, t1), y0, method="DOP853",
/// rtol=…, atol=…, max_step=…)`, scipy 1.17.1, where the bound decides on the steps.
#[test]
fn bounded_steps_are_those_of_scipy() {
    let each = |atol: [f64; 2]| Atol::Each(atol.to_vec());
    let back: (F, &[f64]) = (van_der_pol, &[0.1, 0.0]);
    let cases = [
        (VDP, (0.0, 20.0), 0.02, Atol::Scalar(1e-6), 1002, -1.7283079289533134),
        (back, (0.0, -10.0), 0.02, Atol::Scalar(1e-6), 501, 4.9080912836966685e-05),
        (VDP, (0.0, 20.0), 0.05, each([1e-3, 1e-5]), 402, -1.7283079289627281),
        (ORBIT, (0.0, 20.0), 0.02, Atol::Scalar(1e-6), 1002, -0.5780432953034604),
        (ORBIT, (20.0, 0.0), 0.02, Atol::Scalar(1e-6), 1002, -0.5780432953035272),
        (LINEAR, (0.0, 2.0), 0.004, Atol::Scalar(1e-6), 502, -0.4115900596614714),
    ];
    for ((f, y0), span, max_step, atol, steps, last) in cases {
        let method =
            Dop853 { control: StepControl { atol, max_step, ..StepControl::new(1e-3, 0.0) } };
        let mut y = y0.to_vec();
        let done = ends(&method, plain(y0.len(), f), span, &mut y);
        assert_eq!((done.steps, done.evaluations), (steps, 2 + 12 * steps), "{span:?}");
        assert!((y[0] - last).abs() < 1e-12, "{} {last}", y[0]);
    }
}

/// Steps are chosen otherwise than by `solve_ivp(f, (0, t1), y0, method="DOP853", rtol=…, atol=…)`, scipy
/// 1.17.1, of which these are the evaluations and the error of the last state, against that at rtol
/// 2.3e-14. At equal error, which falls with the eighth power of the work, they cost as much on these
/// problems; mechanisms gain.
#[test]
fn at_equal_error_it_costs_what_scipy_does() {
    let cases = [
        (VDP, 20.0, -1.7283079289532963, [(782, 4.80e-5), (1406, 1.25e-6), (3074, 7.77e-10)]),
        (ORBIT, 20.0, -0.578043295303459, [(434, 2.24e-3), (806, 1.28e-4), (1610, 6.08e-8)]),
        (LINEAR, 2.0, -0.41159005966152235, [(926, 1.41e-6), (1190, 7.99e-9), (4394, 1.14e-12)]),
    ];
    let mut mean = 0.0;
    for ((f, y0), t_end, truth, runs) in cases {
        for ((evaluations, error), rtol) in runs.into_iter().zip([1e-3, 1e-6, 1e-9]) {
            let mut y = y0.to_vec();
            let method = Dop853::new(rtol, 1e-3 * rtol);
            let done = ends(&method, plain(y0.len(), f), (0.0, t_end), &mut y);
            let worse = ((y[0] - truth).abs() / error).powf(1.0 / 8.0);
            // scipy evaluates at the end of every trial, kempe only of the accepted ones
            let counted = (done.evaluations + done.rejected) as f64;
            let dearer = counted / f64::from(evaluations) * worse;
            assert!(dearer < 1.3, "{t_end} {rtol}: {dearer}");
            mean += dearer.ln() / 9.0;
        }
    }
    assert!(mean.abs() < 0.03, "{mean}");
}

#[test]
fn looking_inside_costs_three_stages_for_each_step_and_changes_nothing_else() {
    for ((f, y0), t_end) in [(VDP, 20.0), (ORBIT, 20.0), (LINEAR, 2.0)] {
        let method = Dop853::new(1e-6, 1e-9);
        let (mut y, mut z) = (y0.to_vec(), y0.to_vec());
        let done = ends(&method, plain(y0.len(), f), (0.0, t_end), &mut y);
        assert_eq!(done.evaluations, 2 + 12 * done.steps + 11 * done.rejected);
        let looked = run(&method, plain(y0.len(), f), (0.0, t_end), &mut z).unwrap();
        assert_eq!(looked.steps, done.steps);
        assert_eq!(looked.evaluations, done.evaluations + 3 * done.steps);
        assert_eq!(y, z);
    }
}

/// `solve_ivp(…, (0, 3), [2, 0], method="DOP853", rtol=1e-6, atol=1e-9, dense_output=True).sol` of van
/// der Pol's equation within the third step, scipy 1.17.1.
#[test]
fn the_extension_is_that_of_scipy() {
    let cases = [
        (0.010494752623688158, [1.9998921368978828, -0.020341993866449123]),
        (0.022988505747126443, [1.9994950282659245, -0.04294428735980324]),
        (0.045477261369315354, [1.998107958581404, -0.07958726629934497]),
    ];
    let mut seen = 0;
    let mut observer = |step: &Step<'_>| {
        for (t, truth) in cases.iter().filter(|(t, _)| step.t_old < *t && *t < step.t) {
            let (mut z, mut c) = ([0.0; 2], [0.0; 14]);
            step.interpolate(*t, &mut z);
            assert!((z[0] - truth[0]).abs() < 1e-14 && (z[1] - truth[1]).abs() < 1e-14, "{z:?}");
            assert_eq!(step.interpolant.degree(), 7);
            step.coefficients(&mut c);
            let (h, theta) = (step.t - step.t_old, (t - step.t_old) / (step.t - step.t_old));
            let sum = c[..7].iter().rev().fold(0.0, |sum, c| (sum + c) * theta);
            assert!((step.y_old[0] + h * sum - truth[0]).abs() < 1e-14);
            seen += 1;
        }
        Flow::Continue
    };
    let mut system = plain(2, van_der_pol);
    let method = Dop853::new(1e-6, 1e-9);
    method.integrate(&mut system, 0.0, 3.0, &mut [2.0, 0.0], &mut observer).unwrap();
    assert_eq!(seen, 3);
}

/// Errors for y″ = -y with a constant step: at the end; at worst between the ends, from the exact
/// state.
struct Errors {
    look: bool,
    between: f64,
}

impl Observer for Errors {
    fn step(&mut self, step: &Step<'_>) -> Flow {
        let mut z = [0.0; 2];
        for k in 1..8 {
            let tau = f64::from(k) / 8.0 * (step.t - step.t_old);
            step.interpolate(step.t_old + tau, &mut z);
            let exact = step.y_old[0] * tau.cos() + step.y_old[1] * tau.sin();
            self.between = self.between.max((z[0] - exact).abs());
        }
        Flow::Continue
    }
    fn looks_inside(&self, _: f64, _: f64) -> bool {
        self.look
    }
}

fn errors(h: f64, look: bool) -> [f64; 2] {
    let method = Dop853 { control: StepControl { step: Some(h), ..StepControl::default() } };
    let (mut y, mut observer) = ([1.0, 0.0], Errors { look, between: 0.0 });
    method.integrate(&mut plain(2, oscillator), 0.0, 4.0, &mut y, &mut observer).unwrap();
    [(y[0] - 4.0_f64.cos()).hypot(y[1] + 4.0_f64.sin()), observer.between]
}

#[test]
fn observed_orders() {
    let slope = |look, which: usize| (errors(0.5, look)[which] / errors(0.25, look)[which]).log2();
    assert!((slope(true, 0) - 8.0).abs() < 0.3, "{}", slope(true, 0));
    // local errors, one order above: Hairer's extension 7 + 1, cubic Hermite 3 + 1
    assert!((slope(true, 1) - 8.0).abs() < 0.3, "{}", slope(true, 1));
    assert!((slope(false, 1) - 4.0).abs() < 0.1, "{}", slope(false, 1));
}

#[test]
fn projection_is_taken_up_by_state_derivative_and_extension() {
    let mut observer = |step: &Step<'_>| {
        assert!((step.y[0].hypot(step.y[1]) - 1.0).abs() < 1e-15);
        assert_eq!(step.dy, [step.y[1], -step.y[0]], "derivative of the projected state");
        let mut z = [0.0; 2];
        step.interpolate(step.t, &mut z);
        assert!((z[0] - step.y[0]).abs() < 1e-13 && (z[1] - step.y[1]).abs() < 1e-13);
        Flow::Continue
    };
    let (mut y, method) = ([1.0, 0.0], Dop853::new(1e-3, 1e-6));
    let done =
        method.integrate(&mut OnCircle { calls: 0 }, 0.0, 5.0, &mut y, &mut observer).unwrap();
    assert_eq!(done.evaluations, 2 + 15 * done.steps + 11 * done.rejected);
    assert!((y[0] - 5.0_f64.cos()).abs() < 1e-3);
}

/// If only an extra stage leaves the domain, the step is accepted with the lesser extension.
#[test]
fn an_extra_stage_off_the_domain_costs_the_extension_alone() {
    let mut calls = 0;
    let system = plain(2, |t, y: &[f64], dy: &mut [f64]| {
        calls += 1;
        oscillator(t, y, dy);
        if calls == 1 + 12 + 2 {
            dy[0] = f64::NAN; // the second of the three
        }
    });
    let method =
        Dop853 { control: StepControl { first_step: Some(0.1), ..StepControl::new(1e-3, 1e-6) } };
    let (mut system, mut y, mut errors) = (system, [1.0, 0.0], Errors { look: true, between: 0.0 });
    let done = method.integrate(&mut system, 0.0, 0.1, &mut y, &mut errors).unwrap();
    assert_eq!((done.steps, done.rejected, done.evaluations), (1, 0, 15));
    assert!(errors.between > 1e-8 && errors.between < 1e-6, "{}", errors.between);
}
