//! Observed orders, the continuous extension, and where fixed steps land.

use super::*;
use kempe::integrate::{Dop853, Rk4, Rk45, StepControl};

/// Slope of log error over log step.
fn slope(errors: &[(f64, f64)]) -> f64 {
    let ((h1, e1), (h2, e2)) = (errors[0], errors[errors.len() - 1]);
    (e1 / e2).ln() / (h1 / h2).ln()
}

/// Errors at the end and, at worst, between steps for y″ = -y with a constant step.
fn oscillator_errors(method: &impl ExplicitMethod) -> (f64, f64) {
    let mut system = plain(2, oscillator);
    let (mut between, mut y, mut z) = (0.0_f64, [1.0, 0.0], [0.0; 2]);
    let mut observer = |step: &Step<'_>| {
        for k in 1..8 {
            // the extension itself: from the exact state, its error is local
            let theta = f64::from(k) / 8.0;
            let t = step.t_old + theta * (step.t - step.t_old);
            step.interpolate(t, &mut z);
            let tau = t - step.t_old;
            let exact = step.y_old[0] * tau.cos() + step.y_old[1] * tau.sin();
            between = between.max((z[0] - exact).abs());
        }
        Flow::Continue
    };
    method.integrate(&mut system, 0.0, 2.0, &mut y, &mut observer).unwrap();
    ((y[0] - 2.0_f64.cos()).hypot(y[1] + 2.0_f64.sin()), between)
}

#[test]
fn observed_orders() {
    let steps = [0.1, 0.05, 0.025];
    let rk4 = steps.map(|h| (h, oscillator_errors(&Rk4::new(h))));
    let constant = |h| Rk45 { control: StepControl { step: Some(h), ..StepControl::default() } };
    let rk45 = steps.map(|h| (h, oscillator_errors(&constant(h))));
    let end = |all: [(f64, (f64, f64)); 3]| slope(&all.map(|(h, e)| (h, e.0)));
    let between = |all: [(f64, (f64, f64)); 3]| slope(&all.map(|(h, e)| (h, e.1)));
    assert!((end(rk4) - 4.0).abs() < 0.1, "{}", end(rk4));
    assert!((end(rk45) - 5.0).abs() < 0.1, "{}", end(rk45));
    // local errors, one order above: cubic Hermite 3 + 1, Shampine's quartic 4 + 1
    assert!((between(rk4) - 4.0).abs() < 0.1, "{}", between(rk4));
    assert!((between(rk45) - 5.0).abs() < 0.1, "{}", between(rk45));
}

#[test]
fn extensions_begin_and_end_in_the_states_with_their_slopes() {
    fn check(method: &impl ExplicitMethod) {
        let mut observer = |step: &Step<'_>| {
            let (mut z, mut b) = ([0.0; 2], [0.0; 8]);
            let h = step.t - step.t_old;
            step.coefficients(&mut b);
            for i in 0..2 {
                step.interpolate(step.t_old, &mut z);
                assert_eq!(z[i], step.y_old[i]);
                step.interpolate(step.t, &mut z);
                assert!((z[i] - step.y[i]).abs() < 1e-14);
                let b = &b[4 * i..4 * i + 4];
                assert!((step.y_old[i] + h * b.iter().sum::<f64>() - step.y[i]).abs() < 1e-14);
                assert!((b[0] - step.dy_old[i]).abs() < 1e-14);
                let end = b[0] + 2.0 * b[1] + 3.0 * b[2] + 4.0 * b[3];
                assert!((end - step.dy[i]).abs() < 1e-13);
            }
            Flow::Continue
        };
        let mut system = plain(2, oscillator);
        method.integrate(&mut system, 0.0, 2.0, &mut [1.0, 0.0], &mut observer).unwrap();
    }
    check(&Rk4::new(0.1));
    check(&Rk45::new(1e-3, 1e-6));
}

#[test]
fn fixed_steps_land_without_drift() {
    for (t0, t_end, step, count) in [
        (0.0, 1.0, 0.1, 10),
        (0.0, 0.7, 0.1, 7),
        (0.3, 0.75, 0.2, 3),
        (1.0, -1.0, 0.3, 7),
        (0.0, 1.0, 5.0, 1),
    ] {
        let mut times = vec![];
        let mut system = plain(2, oscillator);
        let mut observer = |s: &Step<'_>| {
            times.push(s.t);
            Flow::Continue
        };
        let done = Rk4::new(step)
            .integrate(&mut system, t0, t_end, &mut [1.0, 0.0], &mut observer)
            .unwrap();
        assert_eq!((done.steps, done.evaluations), (count, 4 * count + 1));
        assert_eq!(*times.last().unwrap(), t_end);
        for (k, t) in times[..count - 1].iter().enumerate() {
            assert_eq!(*t, t0 + (k + 1) as f64 * f64::copysign(step, t_end - t0));
        }
    }
}

/// The tolerances have no effect: 1e-14 would need hundreds of steps.
#[test]
fn a_pair_with_a_constant_step_lands_as_well() {
    for (t0, t_end, step, count) in [(0.0, 1.0, 0.1, 10), (0.3, 0.75, 0.2, 3), (1.0, -1.0, 0.3, 7)]
    {
        let mut times = vec![];
        let mut observer = |s: &Step<'_>| {
            times.push(s.t);
            Flow::Continue
        };
        let method =
            Dop853 { control: StepControl { step: Some(step), ..StepControl::new(1e-14, 1e-14) } };
        let mut system = plain(2, oscillator);
        let done =
            method.integrate(&mut system, t0, t_end, &mut [1.0, 0.0], &mut observer).unwrap();
        assert_eq!((done.steps, done.rejected), (count, 0));
        assert_eq!(*times.last().unwrap(), t_end);
        for (k, t) in times[..count - 1].iter().enumerate() {
            assert_eq!(*t, t0 + (k + 1) as f64 * f64::copysign(step, t_end - t0));
        }
    }
}

#[test]
fn there_and_back_again() {
    for back in [false, true] {
        let (mut y, span) = ([1.0, 0.0], if back { (2.0, 0.0) } else { (0.0, 2.0) });
        let sign = if back { -1.0 } else { 1.0 };
        run(&Rk45::new(1e-10, 1e-12), plain(2, oscillator), span, &mut y).unwrap();
        assert!((y[0] - 2.0_f64.cos()).abs() < 1e-9);
        assert!((y[1] + sign * 2.0_f64.sin()).abs() < 1e-9);
    }
}
