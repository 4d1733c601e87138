//! The guarantees for systems and observers.

use super::*;
use kempe::integrate::{Manifold, Rk4, Rk45, Structure};
use std::f64::consts::PI;

/// An oscillator that carries ∫ 1e6 y² dt as a quadrature.
struct WithQuadrature;

impl Ode for WithQuadrature {
    type Stop = String;
    fn len(&self) -> usize {
        3
    }
    fn structure(&self) -> Structure {
        Structure { states: 2, quadratures: 1, ..Structure::default() }
    }
    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), String> {
        oscillator(t, &y[..2], &mut dy[..2]);
        dy[2] = 1e6 * y[0] * y[0];
        Ok(())
    }
}

#[test]
fn quadratures_do_not_touch_the_steps() {
    let method = Rk45::new(1e-8, 1e-10);
    let (mut y, mut z) = ([1.0, 0.0], [1.0, 0.0, 0.0]);
    let bare = run(&method, plain(2, oscillator), (0.0, PI), &mut y).unwrap();
    let with = run(&method, WithQuadrature, (0.0, PI), &mut z).unwrap();
    assert_eq!(bare, with);
    assert_eq!(y, z[..2]);
    assert!((z[2] - 1e6 * PI / 2.0).abs() < 1.0, "{}", z[2]);
}

/// Motion on the unit circle, put back onto it after every step.
pub(super) struct OnCircle {
    pub calls: usize,
}

impl Ode for OnCircle {
    type Stop = String;
    fn len(&self) -> usize {
        2
    }
    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), String> {
        oscillator(t, y, dy);
        Ok(())
    }
    fn manifold(&mut self) -> Option<&mut dyn Manifold<Stop = String>> {
        Some(self)
    }
}

impl Manifold for OnCircle {
    type Stop = String;
    fn rate_projected(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), String> {
        self.rate(t, y, dy)
    }
    fn project(&mut self, _: f64, y: &mut [f64]) -> Result<bool, String> {
        self.calls += 1;
        let r = y[0].hypot(y[1]);
        y[0] /= r;
        y[1] /= r;
        Ok(true)
    }
}

fn check_projection(method: &impl ExplicitMethod, evaluations: impl Fn(&Done) -> usize) {
    let mut system = OnCircle { calls: 0 };
    let mut last = [1.0, 0.0];
    let mut observer = |step: &Step<'_>| {
        assert_eq!(step.y_old, last);
        assert!((step.y[0].hypot(step.y[1]) - 1.0).abs() < 1e-15);
        assert_eq!(step.dy, [step.y[1], -step.y[0]], "derivative of the projected state");
        let mut z = [0.0; 2];
        step.interpolate(step.t, &mut z);
        assert!((z[0] - step.y[0]).abs() < 1e-14 && (z[1] - step.y[1]).abs() < 1e-14);
        let mut b = [0.0; 8];
        step.coefficients(&mut b);
        let h = step.t - step.t_old;
        let end = step.y_old[1] + h * b[4..].iter().sum::<f64>();
        assert!((end - step.y[1]).abs() < 1e-14);
        assert!((b[0] - step.dy_old[0]).abs() < 1e-14);
        last.copy_from_slice(step.y);
        Flow::Continue
    };
    let mut y = [1.0, 0.0];
    let done = method.integrate(&mut system, 0.0, 5.0, &mut y, &mut observer).unwrap();
    assert_eq!(system.calls, done.steps);
    assert_eq!(done.evaluations, evaluations(&done));
    assert_eq!(y, last);
    assert!((y[0] - 5.0_f64.cos()).abs() < 1e-2);
}

#[test]
fn projection_is_taken_up_by_state_derivative_and_extension() {
    check_projection(&Rk45::new(1e-3, 1e-6), |s| 2 + 7 * s.steps + 6 * s.rejected);
    check_projection(&Rk4::new(0.2), |s| 1 + 4 * s.steps);
}

#[test]
fn an_observer_stops_normally() {
    for stop_at in [1, 3] {
        let mut seen = 0;
        let mut observer = |_: &Step<'_>| {
            seen += 1;
            if seen == stop_at {
                Flow::Stop
            } else {
                Flow::Continue
            }
        };
        let mut y = [1.0, 0.0];
        let mut system = plain(2, oscillator);
        let done = Rk4::new(0.25).integrate(&mut system, 0.0, 2.0, &mut y, &mut observer).unwrap();
        assert_eq!((done.steps, done.ended), (stop_at, Ended::Stopped));
        assert_eq!(done.t, 0.25 * stop_at as f64);
        assert!((y[0] - done.t.cos()).abs() < 1e-4);
    }
}

#[test]
fn no_interval_no_evaluation() {
    let mut y = [1.0, 0.5];
    let idle = |done: Done| (done.steps, done.evaluations, done.ended, done.t);
    let a = run(&Rk45::default(), plain(2, oscillator), (3.0, 3.0), &mut y).unwrap();
    let b = run(&Rk4::new(0.1), plain(2, oscillator), (3.0, 3.0), &mut y).unwrap();
    assert_eq!(idle(a), (0, 0, Ended::Reached, 3.0));
    assert_eq!(idle(b), (0, 0, Ended::Reached, 3.0));
    assert_eq!(y, [1.0, 0.5]);
}
