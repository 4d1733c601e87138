//! The extension of DOP853 for systems of second order: one evaluation, through the step before.

use super::*;
use kempe::integrate::{Dop853, StepControl, Structure, TrialChanges};

/// q̈ = a(t, q) with w = ∫ q̇² dt; y = (q, v, w).
struct Mass<F> {
    a: F,
    /// Whether it declares that q is a position.
    told: bool,
    /// Whether every step changes the equations.
    changes: bool,
}

impl<F: Fn(f64, f64) -> f64> Ode for Mass<F> {
    type Stop = String;
    fn len(&self) -> usize {
        3
    }
    fn structure(&self) -> Structure {
        let positions = usize::from(self.told);
        Structure { positions, states: 2 - 2 * positions, quadratures: 1 }
    }
    fn trial_changes(&mut self) -> Option<&mut dyn TrialChanges> {
        Some(self)
    }
    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), String> {
        dy.copy_from_slice(&[y[1], (self.a)(t, y[0]), y[1] * y[1]]);
        Ok(())
    }
}

impl<F> TrialChanges for Mass<F> {
    fn before_trial(&mut self, _: f64, _: &[f64], _: f64) -> bool {
        self.changes
    }
}

/// q = cos t.
fn oscillating(told: bool) -> Mass<impl Fn(f64, f64) -> f64> {
    Mass { a: |_, q: f64| -q, told, changes: false }
}

/// Largest errors between the ends of steps against a `truth` of (q, v, w), w only over the step.
struct Errors<F> {
    truth: F,
    look: bool,
    worst: [f64; 3],
}

impl<F: Fn(&Step<'_>, f64) -> [f64; 3]> Observer for Errors<F> {
    fn step(&mut self, step: &Step<'_>) -> Flow {
        let mut z = [0.0; 3];
        // the first step has none before
        for k in 0..=8 * i32::from(step.t_old != 0.0) {
            let t = step.t_old + f64::from(k) / 8.0 * (step.t - step.t_old);
            step.interpolate(t, &mut z);
            let truth = (self.truth)(step, t);
            for (worst, (z, truth)) in self.worst.iter_mut().zip(z.iter().zip(truth)) {
                *worst = worst.max((z - truth).abs());
            }
        }
        Flow::Continue
    }
    fn looks_inside(&self, _: f64, _: f64) -> bool {
        self.look
    }
}

fn circle(step: &Step<'_>, t: f64) -> [f64; 3] {
    let (s, c) = (t - step.t_old).sin_cos();
    let [q, v] = [step.y_old[0], step.y_old[1]];
    let h = t - step.t_old;
    // ∫ (v cos - q sin)²
    let w = 0.5 * (v * v * (h + s * c) + q * q * (h - s * c)) - q * v * s * s;
    [q * c + v * s, v * c - q * s, step.y_old[2] + w]
}

fn constant(told: bool, h: f64, look: bool) -> ([f64; 3], Done, [f64; 3]) {
    let mut observer = Errors { truth: circle, look, worst: [0.0; 3] };
    let (mut y, method) = (
        [1.0, 0.0, 0.0],
        Dop853 { control: StepControl { step: Some(h), ..StepControl::default() } },
    );
    let done = method.integrate(&mut oscillating(told), 0.0, 8.0, &mut y, &mut observer).unwrap();
    (y, done, observer.worst)
}

#[test]
fn it_is_as_good_as_the_step_for_one_evaluation() {
    let (y, done, fine) = constant(true, 0.5, true);
    assert_eq!(done.evaluations, 1 + 12 * 16 + 3 + 15, "{done:?}");
    let (_, _, coarse) = constant(true, 1.0, true);
    for (k, order) in [9.0, 9.0, 9.0].into_iter().enumerate() {
        let slope = (coarse[k] / fine[k]).log2();
        assert!((slope - order).abs() < 1.0, "component {k}: {slope}");
    }
    let (same, plain, between) = constant(false, 0.5, true);
    assert_eq!((same, plain.evaluations), (y, 1 + 15 * 16));
    for k in 0..3 {
        assert!(fine[k] < between[k], "component {k}: {} of {}", fine[k], between[k]);
    }
    let (same, done, _) = constant(true, 0.5, false);
    assert_eq!((same, done.evaluations), (y, 1 + 12 * 16));
}

/// q = t⁹ is in its reach, whatever the steps.
#[test]
fn it_is_exact_to_the_ninth_degree_over_unequal_steps() {
    let (mut worst, mut last, mut ratios) = ([0.0_f64; 2], f64::NAN, [f64::NAN; 2]);
    let mut observer = |step: &Step<'_>| {
        let (h, mut z) = (step.t - step.t_old, [0.0; 3]);
        let ratio = h / last;
        if (0.4..2.0).contains(&ratio) {
            ratios = [ratios[0].min(ratio), ratios[1].max(ratio)];
            for k in 0..=8 {
                let t = step.t_old + f64::from(k) / 8.0 * h;
                step.interpolate(t, &mut z);
                let errors = [z[0] - t.powi(9), z[1] - 9.0 * t.powi(8)];
                worst = [worst[0].max(errors[0].abs()), worst[1].max(errors[1].abs())];
            }
        }
        last = h;
        Flow::Continue
    };
    let a = |t: f64, _: f64| 72.0 * t.powi(7);
    let mut system = Mass { a, told: true, changes: false };
    let method =
        Dop853 { control: StepControl { first_step: Some(0.1), ..StepControl::new(1e-12, 1e-12) } };
    method.integrate(&mut system, 0.0, 1.0, &mut [0.0; 3], &mut observer).unwrap();
    assert!(worst[0] < 1e-13 && worst[1] < 1e-12, "{worst:?}");
    assert!(ratios[0] < 0.6 && ratios[1] > 1.0, "{ratios:?}");
}

#[test]
fn rates_are_the_derivative_of_positions_and_both_meet_the_ends() {
    let mut observer = |step: &Step<'_>| {
        let (h, d) = (step.t - step.t_old, step.interpolant.degree());
        let (mut c, mut z) = (vec![0.0; 3 * d], [0.0; 3]);
        step.coefficients(&mut c);
        step.interpolate(step.t, &mut z);
        assert!(z.iter().zip(step.y).all(|(z, y)| (z - y).abs() < 1e-13), "{z:?}");
        if step.t_old > 0.0 {
            assert_eq!(d, 9);
            let (q, v) = c.split_at(d);
            for k in 0..d - 1 {
                let expected = (k + 2) as f64 * q[k + 1] / h;
                assert!((v[k] - expected).abs() < 1e-12 * expected.abs().max(1.0), "{k}");
            }
            assert_eq!((q[0], v[0]), (step.y_old[1], step.dy_old[1]));
        }
        Flow::Continue
    };
    let (mut y, method) = (
        [1.0, 0.0, 0.0],
        Dop853 { control: StepControl { step: Some(0.5), ..StepControl::default() } },
    );
    method.integrate(&mut oscillating(true), 0.0, 8.0, &mut y, &mut observer).unwrap();
}

/// Where the step before does not serve, the three extra stages do.
#[test]
fn it_does_without_where_equations_change_or_steps_differ_much() {
    let step = Some(0.5);
    let mut looks = |_: &Step<'_>| Flow::Continue;
    let mut changing = Mass { changes: true, ..oscillating(true) };
    let (mut y, method) =
        ([1.0, 0.0, 0.0], Dop853 { control: StepControl { step, ..StepControl::default() } });
    let done = method.integrate(&mut changing, 0.0, 8.0, &mut y, &mut looks).unwrap();
    assert_eq!(done.evaluations, 1 + 16 * (12 + 1 + 3));

    // 0.001, 0.01, 0.1 and the rest
    let growing =
        Dop853 { control: StepControl { first_step: Some(1e-3), ..StepControl::new(0.1, 0.1) } };
    let mut y = [1.0, 0.0, 0.0];
    let done = growing.integrate(&mut oscillating(true), 0.0, 1.0, &mut y, &mut looks).unwrap();
    assert_eq!((done.steps, done.evaluations), (4, 1 + 4 * 15));
}

/// If it cannot be evaluated inside, the step is accepted with the lesser extension.
#[test]
fn a_state_inside_off_the_domain_costs_the_extension_alone() {
    let calls = std::cell::Cell::new(0);
    let a = |_: f64, q: f64| {
        calls.set(calls.get() + 1);
        // the one inside the second step
        match calls.get() == 1 + 15 + 12 + 1 {
            true => f64::NAN,
            false => -q,
        }
    };
    let mut observer = Errors { truth: circle, look: true, worst: [0.0; 3] };
    let mut system = Mass { a, told: true, changes: false };
    let (mut y, method) = (
        [1.0, 0.0, 0.0],
        Dop853 { control: StepControl { step: Some(0.1), ..StepControl::default() } },
    );
    let done = method.integrate(&mut system, 0.0, 0.2, &mut y, &mut observer).unwrap();
    assert_eq!((done.steps, done.evaluations), (2, 29));
    assert!(observer.worst[0] > 1e-8 && observer.worst[0] < 1e-6, "{:?}", observer.worst);
}
