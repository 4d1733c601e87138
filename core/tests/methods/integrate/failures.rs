//! Every way an integration fails.

use super::*;
use kempe::integrate::{Atol, Cause, Dop853, Manifold, Rk4, Rk45, StepControl, Structure};

fn cause(outcome: Outcome) -> Cause<String> {
    outcome.unwrap_err().cause
}

fn refused(outcome: Outcome) -> &'static str {
    let failure = outcome.unwrap_err();
    assert_eq!(failure.statistics.evaluations, 0);
    match failure.cause {
        Cause::Argument { name, .. } => name,
        other => panic!("{other:?}"),
    }
}

#[test]
fn arguments_are_refused_by_name() {
    let good = StepControl::default();
    let with = |control: StepControl, span: (f64, f64), y0: [f64; 2]| {
        refused(run(&Rk45 { control }, plain(2, oscillator), span, &mut y0.clone()))
    };
    let (span, y0) = ((0.0, 1.0), [1.0, 0.0]);
    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(with(good.clone(), (bad, 1.0), y0), "t0");
        assert_eq!(with(good.clone(), (0.0, bad), y0), "t_end");
        assert_eq!(with(good.clone(), span, [1.0, bad]), "y0");
        assert_eq!(with(StepControl::new(bad, 1e-6), span, y0), "rtol");
        assert_eq!(with(StepControl::new(1e-3, bad), span, y0), "atol");
    }
    assert_eq!(with(StepControl::new(-1e-3, 1e-6), span, y0), "rtol");
    assert_eq!(with(StepControl::new(1e-3, -1e-6), span, y0), "atol");
    let each = |atol: &[f64]| StepControl { atol: Atol::Each(atol.to_vec()), ..good.clone() };
    assert_eq!(with(each(&[1e-6, -1.0]), span, y0), "atol");
    assert_eq!(with(each(&[1e-6]), span, y0), "atol");
    for bad in [0.0, -1.0, f64::NAN] {
        assert_eq!(with(StepControl { max_step: bad, ..good.clone() }, span, y0), "max_step");
        assert_eq!(
            with(StepControl { first_step: Some(bad), ..good.clone() }, span, y0),
            "first_step"
        );
        let fixed = run(&Rk4::new(bad), plain(2, oscillator), span, &mut y0.clone());
        assert_eq!(refused(fixed), "step");
        assert_eq!(with(StepControl { step: Some(bad), ..good.clone() }, span, y0), "step");
    }
    let constant = StepControl { step: Some(0.1), ..good.clone() };
    assert_eq!(
        with(StepControl { first_step: Some(0.1), ..constant.clone() }, span, y0),
        "first_step"
    );
    assert_eq!(with(StepControl { max_step: 0.1, ..constant }, span, y0), "max_step");
    assert_eq!(with(StepControl { first_step: Some(2.0), ..good }, span, y0), "first_step");
    for bad in [f64::INFINITY, 1e-20] {
        let fixed = run(&Rk4::new(bad), plain(2, oscillator), span, &mut y0.clone());
        assert_eq!(refused(fixed), "step");
    }
    assert_eq!(refused(run(&Rk4::new(0.1), plain(2, oscillator), span, &mut [1.0])), "y0");
}

#[test]
fn a_tolerance_below_rounding_is_raised() {
    assert_eq!(Rk45::new(0.0, 1e-12).control.usable().rtol, 100.0 * f64::EPSILON);
    assert_eq!(Rk45::new(1e-9, 1e-12).control.usable().rtol, 1e-9);
    let raised = run(&Rk45::new(0.0, 0.0), plain(1, relaxation), (0.0, 0.01), &mut [0.5]).unwrap();
    let same = Rk45::new(100.0 * f64::EPSILON, 0.0);
    assert_eq!(raised, run(&same, plain(1, relaxation), (0.0, 0.01), &mut [0.5]).unwrap());
}

#[test]
fn a_singularity_makes_the_step_too_small() {
    // y' = y² from 1 has a pole at t = 1
    let square = |_: f64, y: &[f64], dy: &mut [f64]| dy[0] = y[0] * y[0];
    let failure =
        run(&Rk45::new(1e-6, 1e-9), plain(1, square), (0.0, 2.0), &mut [1.0]).unwrap_err();
    let Cause::StepTooSmall { t, h } = failure.cause else { panic!("{:?}", failure.cause) };
    assert!((t - 1.0).abs() < 1e-4 && h < 1e-14, "{t} {h}");
    assert_eq!(failure.t, t);
    assert!(failure.y[0] > 1e4 && failure.statistics.steps > 50);
}

/// y′ = 1 until t = 1, not a number after.
fn half_defined(t: f64, _: &[f64], dy: &mut [f64]) {
    dy[0] = if t <= 1.0 { 1.0 } else { f64::NAN };
}

#[test]
fn a_derivative_that_is_not_finite_is_named_with_its_time() {
    let mut y = [0.0];
    let failure =
        run(&Rk45::new(1e-3, 1e-6), plain(1, half_defined), (0.0, 2.0), &mut y).unwrap_err();
    let Cause::NotFinite { t } = failure.cause else { panic!("{:?}", failure.cause) };
    assert!(t > 1.0 && t < 1.0 + 1e-14, "{t:e}");
    assert!(failure.t <= 1.0 && failure.t > 1.0 - 1e-14, "steps shrink up to the edge");
    assert_eq!(*failure.y, y);
    assert!((y[0] - failure.t).abs() < 1e-14);

    let failure = run(&Rk4::new(0.3), plain(1, half_defined), (0.0, 2.0), &mut [0.0]).unwrap_err();
    assert!(matches!(failure.cause, Cause::NotFinite { t } if (t - 1.05).abs() < 1e-12));
    assert_eq!(failure.statistics.steps, 3);

    let never = |_: f64, _: &[f64], dy: &mut [f64]| dy[0] = f64::INFINITY;
    let at_once = run(&Rk45::default(), plain(1, never), (0.5, 2.0), &mut [0.0]);
    assert_eq!(cause(at_once), Cause::NotFinite { t: 0.5 });
}

#[test]
fn a_trial_outside_the_domain_only_shortens_the_step() {
    // y' = -sqrt(y), not a number below 0; ends before it gets there
    let root = |_: f64, y: &[f64], dy: &mut [f64]| dy[0] = -y[0].sqrt();
    let method =
        Rk45 { control: StepControl { first_step: Some(1.9), ..StepControl::new(1e-2, 1e-4) } };
    let mut y = [1.0];
    let done = run(&method, plain(1, root), (0.0, 1.9), &mut y).unwrap();
    assert!(done.rejected > 0);
    assert!((y[0] - 0.05_f64.powi(2)).abs() < 1e-3, "{}", y[0]);
}

/// An oscillator with a quadrature that neither the motion nor its error contains, which is `flaw` at one evaluation.
struct Flawed {
    flaw: f64,
    at: usize,
    evaluations: usize,
}

impl Ode for Flawed {
    type Stop = String;

    fn len(&self) -> usize {
        3
    }

    fn structure(&self) -> Structure {
        Structure { states: 2, quadratures: 1, ..Structure::default() }
    }

    fn rate(&mut self, _: f64, y: &[f64], dy: &mut [f64]) -> Result<(), String> {
        assert!(y.iter().all(|y| y.is_finite()), "asked where nothing is: {y:?}");
        self.evaluations += 1;
        let work = if self.evaluations == self.at { self.flaw } else { y[1] };
        dy.copy_from_slice(&[y[1], -y[0], work]);
        Ok(())
    }
}

fn flawed(method: &impl ExplicitMethod, flaw: f64, at: usize) -> Outcome {
    let mut system = Flawed { flaw, at, evaluations: 0 };
    let mut inside = [0.0; 3];
    let mut seen = |step: &Step<'_>| {
        step.interpolate(step.t_old + 0.3 * (step.t - step.t_old), &mut inside);
        let all = [step.y_old, step.y, step.dy_old, step.dy, &inside];
        assert!(all.iter().all(|x| x.iter().all(|x| x.is_finite())), "{step:?}");
        Flow::Continue
    };
    method.integrate(&mut system, 0.0, 1.0, &mut [1.0, 0.0, 0.0], &mut seen)
}

#[test]
fn one_stage_that_is_not_finite_refuses_its_step_whatever_comes_of_it() {
    let (pair, eighth, fixed) = (Rk45::new(1e-4, 1e-6), Dop853::new(1e-6, 1e-8), Rk4::new(0.2));
    let [five, eight] =
        [flawed(&pair, 0.0, 0), flawed(&eighth, 0.0, 0)].map(|outcome| outcome.unwrap());
    for flaw in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for at in 2..=five.evaluations {
            let found = flawed(&pair, flaw, at).unwrap();
            // the probe before the first step is none of its stages
            assert_eq!(found.rejected > five.rejected, at > 2, "{at}: {found:?}");
        }
        for at in 2..=eight.evaluations {
            flawed(&eighth, flaw, at).unwrap();
        }
        for at in 1..=20 {
            let Cause::NotFinite { t } = cause(flawed(&fixed, flaw, at)) else { panic!("{at}") };
            let stage = [0.0, 0.5, 0.5, 1.0][(at + 3) % 4];
            let begin = 0.2 * ((at - 1) / 4) as f64;
            assert!((t - begin - 0.2 * stage).abs() < 1e-12, "{at}: {t}");
        }
    }
}

#[test]
fn the_number_of_steps_can_be_bounded() {
    let most = Rk45 { control: StepControl { max_steps: Some(5), ..StepControl::new(1e-6, 1e-9) } };
    let failure = run(&most, plain(2, van_der_pol), (0.0, 20.0), &mut [2.0, 0.0]).unwrap_err();
    assert_eq!(failure.cause, Cause::MaxSteps { steps: 5 });
    assert_eq!(failure.statistics.steps, 5);
    assert!(failure.t > 0.0);
}

/// At rest, and refused six times for each state that is accepted.
struct Reluctant(usize);

impl Ode for Reluctant {
    type Stop = String;

    fn len(&self) -> usize {
        1
    }

    fn rate(&mut self, _: f64, _: &[f64], dy: &mut [f64]) -> Result<(), String> {
        dy[0] = 0.0;
        Ok(())
    }

    fn manifold(&mut self) -> Option<&mut dyn Manifold<Stop = String>> {
        Some(self)
    }
}

impl Manifold for Reluctant {
    type Stop = String;

    fn rate_projected(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), String> {
        self.rate(t, y, dy)
    }

    fn project(&mut self, _: f64, _: &mut [f64]) -> Result<bool, String> {
        self.0 += 1;
        match self.0 % 7 {
            0 => Ok(false),
            _ => Err("not here".to_string()),
        }
    }
}

#[test]
fn a_run_that_gets_nowhere_ends_before_its_steps_are_counted_out() {
    let first_step = Some(1e-9);
    let method = Rk45 {
        control: StepControl {
            max_steps: Some(40_000),
            first_step,
            ..StepControl::new(1e-6, 1e-3)
        },
    };
    let failure = run(&method, Reluctant(0), (0.0, 1e300), &mut [0.0]).unwrap_err();
    assert!(matches!(failure.cause, Cause::StepTooSmall { .. }), "{:?}", failure.cause);
    let found = failure.statistics;
    assert!((20_000..20_006).contains(&found.rejected) && found.steps < 3_400, "{found:?}");
}

/// Nothing is evaluated if the steps cannot reach the end.
#[test]
fn too_many_steps_are_refused_before_the_first() {
    fn check(method: &impl ExplicitMethod, needed: f64, step: f64) {
        let failure = run(method, plain(2, oscillator), (0.0, 1.0), &mut [2.0, 0.0]).unwrap_err();
        assert_eq!(failure.cause, Cause::TooManySteps { needed, step, most: 5 });
        assert_eq!((failure.statistics.evaluations, failure.y), (0, Box::from([2.0, 0.0])));
    }
    let max_steps = Some(5);
    check(&Rk4 { control: StepControl { max_steps, ..StepControl::constant(0.1) } }, 10.0, 0.1);
    check(&Rk4 { control: StepControl { max_steps, ..StepControl::constant(1e-12) } }, 1e12, 1e-12);
    check(
        &Rk45 { control: StepControl { step: Some(0.1), max_steps, ..StepControl::default() } },
        10.0,
        0.1,
    );
    check(
        &Dop853 { control: StepControl { max_step: 1e-12, max_steps, ..StepControl::default() } },
        1e12,
        1e-12,
    );
    for max_steps in [Some(10), None] {
        let enough = Rk4 { control: StepControl { max_steps, ..StepControl::constant(0.1) } };
        assert!(run(&enough, plain(2, oscillator), (0.0, 1.0), &mut [2.0, 0.0]).is_ok());
    }
}

/// y′ = 1 that stops past t = 1, in the rate or at acceptance.
struct Stops {
    in_rate: bool,
}

impl Ode for Stops {
    type Stop = String;
    fn len(&self) -> usize {
        1
    }
    fn rate(&mut self, t: f64, _: &[f64], dy: &mut [f64]) -> Result<(), String> {
        dy[0] = 1.0;
        if self.in_rate && t > 1.0 {
            Err("the crank locks".into())
        } else {
            Ok(())
        }
    }
    fn manifold(&mut self) -> Option<&mut dyn Manifold<Stop = String>> {
        Some(self)
    }
}

impl Manifold for Stops {
    type Stop = String;
    fn rate_projected(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), String> {
        self.rate(t, y, dy)
    }
    fn project(&mut self, t: f64, _: &mut [f64]) -> Result<bool, String> {
        if !self.in_rate && t > 1.0 {
            Err("the crank locks".into())
        } else {
            Ok(false)
        }
    }
}

#[test]
fn a_system_that_stops_is_a_failure_at_once() {
    for in_rate in [true, false] {
        for method in [0.3, 0.4] {
            let outcome = run(&Rk4::new(method), Stops { in_rate }, (0.0, 2.0), &mut [0.0]);
            let Cause::Equations { t, error } = cause(outcome) else { panic!("the system fails") };
            assert!(t > 1.0 && t <= 1.2 + 1e-12 && error == "the crank locks", "{error} at {t}");
        }
        let method = Rk45 { control: StepControl { max_step: 0.3, ..StepControl::default() } };
        let failure = run(&method, Stops { in_rate }, (0.0, 2.0), &mut [0.0]).unwrap_err();
        assert!(
            matches!(failure.cause, Cause::Equations { error, .. } if error == "the crank locks")
        );
        // an evaluation that stops does so at once; a refused end is tried nearer and nearer
        let least = if in_rate { 0.6 } else { 1.0 - 1e-9 };
        assert!(failure.t <= 1.0 && failure.t > least, "{}", failure.t);
        assert_eq!(failure.statistics.rejected == 0, in_rate);
    }
}
