//! Step for step the control of scipy.

use super::*;
use kempe::integrate::{Atol, Rk45, StepControl};

/// Steps, evaluations and last state of `scipy.integrate.solve_ivp(f, (t0, t1), y0, method="RK45",
/// rtol=…, atol=…)`, scipy 1.17.1.
#[test]
fn rk45_takes_the_steps_of_scipy() {
    type F = fn(f64, &[f64], &mut [f64]);
    let vdp: (F, &[f64]) = (van_der_pol, &[2.0, 0.0]);
    let orbit: (F, &[f64]) = (kepler, &KEPLER_START);
    let linear: (F, &[f64]) = (relaxation, &[0.0]);
    #[rustfmt::skip]
    let cases = [
        (vdp, 20.0, 1e-3, 72, 572, -1.7202219955507565),
        (vdp, 20.0, 1e-6, 245, 1808, -1.728306224300819),
        (vdp, 20.0, 1e-9, 934, 5906, -1.7283079273485091),
        (orbit, 20.0, 1e-3, 37, 290, -0.7229774670076338),
        (orbit, 20.0, 1e-6, 121, 926, -0.5780269251036969),
        (orbit, 20.0, 1e-9, 476, 2996, -0.5780432018624032),
        (linear, 2.0, 1e-3, 128, 830, -0.41167721299391186),
        (linear, 2.0, 1e-6, 249, 1502, -0.4115899725811571),
        (linear, 2.0, 1e-9, 887, 5330, -0.4115900595509496),
    ];
    for ((f, y0), t_end, rtol, steps, evaluations, last) in cases {
        let mut y = y0.to_vec();
        let done = run(&Rk45::new(rtol, 1e-3 * rtol), plain(y0.len(), f), (0.0, t_end), &mut y);
        let done = done.unwrap();
        assert_eq!((done.steps, done.evaluations), (steps, evaluations), "{t_end} {rtol}");
        assert_eq!(done.evaluations, 2 + 6 * (done.steps + done.rejected));
        assert!((y[0] - last).abs() < 1e-9 * last.abs(), "{} {last}", y[0]);
        assert_eq!((done.t, done.ended), (t_end, Ended::Reached));
    }
}

/// As above, backward in time and with the other options.
#[test]
fn rk45_takes_the_steps_of_scipy_backward_and_with_options() {
    let mut y = KEPLER_START.to_vec();
    let done = run(&Rk45::new(1e-6, 1e-9), plain(4, kepler), (20.0, 0.0), &mut y).unwrap();
    assert_eq!((done.steps, done.evaluations), (121, 926));
    assert!((y[1] + 0.8633556388994765).abs() < 1e-10);

    let mut y = [0.1, 0.0];
    let done = run(&Rk45::new(1e-6, 1e-9), plain(2, van_der_pol), (0.0, -10.0), &mut y).unwrap();
    assert_eq!((done.steps, done.evaluations), (38, 230));
    assert!((y[0] - 4.9081311863546624e-05).abs() < 1e-13);

    let each = Rk45 {
        control: StepControl {
            atol: Atol::Each(vec![1e-9, 1e-5]),
            max_step: 0.05,
            ..StepControl::new(1e-6, 0.0)
        },
    };
    let mut y = [2.0, 0.0];
    let done = run(&each, plain(2, van_der_pol), (0.0, 20.0), &mut y).unwrap();
    assert_eq!((done.steps, done.evaluations), (401, 2408));

    let first =
        Rk45 { control: StepControl { first_step: Some(1.0), ..StepControl::new(1e-6, 1e-9) } };
    let mut y = [2.0, 0.0];
    let done = run(&first, plain(2, van_der_pol), (0.0, 20.0), &mut y).unwrap();
    assert_eq!((done.steps, done.rejected, done.evaluations), (243, 60, 1819));
}

/// The first step of van der Pol's equation, rtol 1e-6, atol 1e-9, and `dense_output().Q` of
/// `scipy.integrate.RK45`, scipy 1.17.1.
#[test]
fn coefficients_are_laid_out_as_in_scipy() {
    let q = [
        [0.0, -0.0004997501247375476, 4.994998125168246e-07, -3.6351259458993736e-10],
        [-2.0, 0.0029985007490255437, -2.9137510475914542e-06, 1.6220848214888966e-09],
    ];
    let mut seen = [f64::NAN; 8];
    let mut system = plain(2, van_der_pol);
    let method = Rk45::new(1e-6, 1e-9);
    let mut observer = |step: &Step<'_>| {
        assert!((step.t - 0.0004997501249375313).abs() < 1e-18);
        step.coefficients(&mut seen);
        Flow::Stop
    };
    let done = method.integrate(&mut system, 0.0, 20.0, &mut [2.0, 0.0], &mut observer).unwrap();
    assert_eq!((done.steps, done.ended), (1, Ended::Stopped));
    for (seen, q) in seen.iter().zip(q.as_flattened()) {
        assert!((seen - q).abs() < 2e-14, "{seen:e} {q:e}");
    }
}
