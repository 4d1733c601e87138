//! DOP853: step for step that of scipy, of order 8, with an extension of order 7.

use super::*;
use kempe::integrate::{Atol, Dop853, Observer};

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

fn ends<Y: FirstOrder<Stop = String>>(
    method: &Dop853,
    mut system: Y,
    (t0, t_end): (f64, f64),
    y: &mut [f64],
) -> Statistics {
    method.integrate(&mut system, t0, t_end, y, &mut Ends).unwrap()
}

/// Steps, evaluations and last state of `scipy.integrate.solve_ivp(f, (t0, t1), y0, method="DOP853",
/// rtol=…, atol=…)`, scipy 1.17.1.
#[test]
fn it_takes_the_steps_of_scipy() {
    type F = fn(f64, &[f64], &mut [f64]);
    let vdp: (F, &[f64]) = (van_der_pol, &[2.0, 0.0]);
    let orbit: (F, &[f64]) = (kepler, &KEPLER_START);
    let linear: (F, &[f64]) = (relaxation, &[0.0]);
    #[rustfmt::skip]
    let cases = [
        (vdp, 20.0, 1e-3, 46, 782, -1.7282598954149815),
        (vdp, 20.0, 1e-6, 90, 1406, -1.7283066749982205),
        (vdp, 20.0, 1e-9, 202, 3074, -1.7283079281765217),
        (orbit, 20.0, 1e-3, 27, 434, -0.5757983790045282),
        (orbit, 20.0, 1e-6, 50, 806, -0.5781708213777429),
        (orbit, 20.0, 1e-9, 103, 1610, -0.57804335613626),
        (linear, 2.0, 1e-3, 67, 926, -0.4115914677401125),
        (linear, 2.0, 1e-6, 89, 1190, -0.4115900516756487),
        (linear, 2.0, 1e-9, 364, 4394, -0.4115900596603852),
    ];
    for ((f, y0), t_end, rtol, steps, evaluations, last) in cases {
        let method = Dop853::new(rtol, 1e-3 * rtol);
        let (mut y, mut z) = (y0.to_vec(), y0.to_vec());
        let done = ends(&method, plain(y0.len(), f), (0.0, t_end), &mut y);
        // in one case scipy itself needs 1586 or 1610, as an ulp in the start decides on rejections
        let slack = if evaluations == 1610 { 24 } else { 0 };
        assert_eq!(done.steps, steps, "{t_end} {rtol}");
        assert!(done.evaluations.abs_diff(evaluations) <= slack, "{t_end} {rtol}");
        assert_eq!(done.evaluations, 2 + 12 * (done.steps + done.rejected));
        // an ulp in the start of van der Pol's equation moves scipy's own result by 6e-9 at rtol 1e-3
        assert!((y[0] - last).abs() < (1e-5 * rtol).max(1e-9), "{} {last}", y[0]);
        // looking inside costs three stages for each step and changes nothing else
        let looked = run(&method, plain(y0.len(), f), (0.0, t_end), &mut z).unwrap();
        assert_eq!((looked.steps, looked.evaluations), (steps, done.evaluations + 3 * steps));
        assert_eq!(y, z);
    }
}

/// As above, backward in time and with the other options.
#[test]
fn it_takes_the_steps_of_scipy_backward_and_with_options() {
    let mut y = KEPLER_START.to_vec();
    let done = ends(&Dop853::new(1e-6, 1e-9), plain(4, kepler), (20.0, 0.0), &mut y);
    assert_eq!((done.steps, done.evaluations), (50, 806));
    assert!((y[1] + 0.8633708308311508).abs() < 1e-10);

    let first = Dop853 { first_step: Some(1.0), ..Dop853::new(1e-6, 1e-9) };
    let done = ends(&first, plain(2, van_der_pol), (0.0, 20.0), &mut [2.0, 0.0]);
    assert_eq!((done.steps, done.evaluations), (88, 1453));

    let atol = Atol::Each(vec![1e-9, 1e-5]);
    let each = Dop853 { atol, max_step: 0.05, ..Dop853::new(1e-6, 0.0) };
    let done = ends(&each, plain(2, van_der_pol), (0.0, 20.0), &mut [2.0, 0.0]);
    assert_eq!((done.steps, done.evaluations), (400, 4802));
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
            assert_eq!(step.dense.degree(), 7);
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
    let method = Dop853 { step: Some(h), ..Dop853::default() };
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

/// Motion on the unit circle, put back onto it after every step.
struct OnCircle;

impl FirstOrder for OnCircle {
    type Stop = String;
    fn len(&self) -> usize {
        2
    }
    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), String> {
        oscillator(t, y, dy);
        Ok(())
    }
    fn accepted(&mut self, _: f64, y: &mut [f64]) -> Result<bool, String> {
        let r = y[0].hypot(y[1]);
        y.iter_mut().for_each(|y| *y /= r);
        Ok(true)
    }
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
    let done = method.integrate(&mut OnCircle, 0.0, 5.0, &mut y, &mut observer).unwrap();
    assert_eq!(done.evaluations, 2 + 16 * done.steps + 12 * done.rejected);
    assert!((y[0] - 5.0_f64.cos()).abs() < 1e-3);
}

/// Where only an extra stage leaves the domain the step stands, with the lesser extension.
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
    let method = Dop853 { first_step: Some(0.1), ..Dop853::new(1e-3, 1e-6) };
    let (mut system, mut y, mut errors) = (system, [1.0, 0.0], Errors { look: true, between: 0.0 });
    let done = method.integrate(&mut system, 0.0, 0.1, &mut y, &mut errors).unwrap();
    assert_eq!((done.steps, done.rejected, done.evaluations), (1, 0, 15));
    assert!(errors.between > 1e-8 && errors.between < 1e-6, "{}", errors.between);
}
