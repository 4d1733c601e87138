//! Integrators: observed order, step counts of scipy, and every promise of the contract.

use kempe::integrate::{
    locate, Atol, Cause, Direction, Ended, Failure, Flow, Method, Rk4, Rk45, Statistics, Step,
    System,
};
use std::f64::consts::PI;

/// A system by closure, without any stop.
struct Plain<F> {
    len: usize,
    f: F,
}

impl<F: FnMut(f64, &[f64], &mut [f64])> System for Plain<F> {
    type Stop = String;
    fn len(&self) -> usize {
        self.len
    }
    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), String> {
        (self.f)(t, y, dy);
        Ok(())
    }
}

fn plain<F: FnMut(f64, &[f64], &mut [f64])>(len: usize, f: F) -> Plain<F> {
    Plain { len, f }
}

type Outcome = Result<Statistics, Failure<String>>;

fn run<Y: System<Stop = String>>(
    method: &impl Method,
    mut system: Y,
    span: (f64, f64),
    y: &mut [f64],
) -> Outcome {
    method.integrate(&mut system, span.0, span.1, y, &mut |_: &Step<'_>| Flow::Continue)
}

fn van_der_pol(_: f64, y: &[f64], dy: &mut [f64]) {
    dy[0] = y[1];
    dy[1] = 2.0 * (1.0 - y[0] * y[0]) * y[1] - y[0];
}

fn kepler(_: f64, y: &[f64], dy: &mut [f64]) {
    let r3 = (y[0] * y[0] + y[1] * y[1]).powf(1.5);
    dy.copy_from_slice(&[y[2], y[3], -y[0] / r3, -y[1] / r3]);
}

fn relaxation(t: f64, y: &[f64], dy: &mut [f64]) {
    dy[0] = -200.0 * (y[0] - t.cos());
}

fn oscillator(_: f64, y: &[f64], dy: &mut [f64]) {
    dy.copy_from_slice(&[y[1], -y[0]]);
}

const KEPLER_START: [f64; 4] = [0.5, 0.0, 0.0, 1.732_050_807_568_877_2];

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

    let each = Rk45 { atol: Atol::Each(vec![1e-9, 1e-5]), max_step: 0.05, ..Rk45::new(1e-6, 0.0) };
    let mut y = [2.0, 0.0];
    let done = run(&each, plain(2, van_der_pol), (0.0, 20.0), &mut y).unwrap();
    assert_eq!((done.steps, done.evaluations), (401, 2408));

    let first = Rk45 { first_step: Some(1.0), ..Rk45::new(1e-6, 1e-9) };
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

/// Slope of log error over log step.
fn slope(errors: &[(f64, f64)]) -> f64 {
    let ((h1, e1), (h2, e2)) = (errors[0], errors[errors.len() - 1]);
    (e1 / e2).ln() / (h1 / h2).ln()
}

/// Errors at the end and, at worst, between steps for y″ = -y with a constant step.
fn oscillator_errors(method: &impl Method) -> (f64, f64) {
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
    let constant = |h| Rk45 { max_step: h, first_step: Some(h), ..Rk45::new(1e3, 1e3) };
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
    fn check(method: &impl Method) {
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

/// An oscillator that carries ∫ 1e6 y² dt as a quadrature.
struct WithQuadrature;

impl System for WithQuadrature {
    type Stop = String;
    fn len(&self) -> usize {
        3
    }
    fn controlled(&self) -> usize {
        2
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
struct OnCircle {
    calls: usize,
}

impl System for OnCircle {
    type Stop = String;
    fn len(&self) -> usize {
        2
    }
    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), String> {
        oscillator(t, y, dy);
        Ok(())
    }
    fn accepted(&mut self, _: f64, y: &mut [f64]) -> Result<bool, String> {
        self.calls += 1;
        let r = y[0].hypot(y[1]);
        y[0] /= r;
        y[1] /= r;
        Ok(true)
    }
}

fn check_projection(method: &impl Method, evaluations: impl Fn(&Statistics) -> usize) {
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
    let idle = |done: Statistics| (done.steps, done.evaluations, done.ended, done.t);
    let a = run(&Rk45::default(), plain(2, oscillator), (3.0, 3.0), &mut y).unwrap();
    let b = run(&Rk4::new(0.1), plain(2, oscillator), (3.0, 3.0), &mut y).unwrap();
    assert_eq!(idle(a), (0, 0, Ended::Reached, 3.0));
    assert_eq!(idle(b), (0, 0, Ended::Reached, 3.0));
    assert_eq!(y, [1.0, 0.5]);
}

/// All events of cos t - c on (0, 20) at the given tolerance.
fn crossings(direction: Direction, span: (f64, f64), level: f64) -> Vec<f64> {
    let mut found = vec![];
    let mut z = [0.0; 2];
    let mut system = plain(2, oscillator);
    let mut observer = |step: &Step<'_>| {
        let g = |_: f64, y: &[f64]| y[0] - level;
        if let Some(t) = locate(step, &mut z, g, direction, 1e-13) {
            assert!((z[0] - level).abs() < 1e-12);
            found.push(t);
        }
        Flow::Continue
    };
    let method = Rk45 { max_step: 0.01, ..Rk45::new(1e-12, 1e-14) };
    let mut y = [span.0.cos(), -span.0.sin()];
    method.integrate(&mut system, span.0, span.1, &mut y, &mut observer).unwrap();
    found
}

#[test]
fn events_are_located() {
    let falling = crossings(Direction::Falling, (0.0, 20.0), 0.0);
    let rising = crossings(Direction::Rising, (0.0, 20.0), 0.0);
    let any = crossings(Direction::Any, (0.0, 20.0), 0.0);
    assert_eq!((falling.len(), rising.len(), any.len()), (3, 3, 6));
    for (k, t) in any.iter().enumerate() {
        assert!((t - PI * (k as f64 + 0.5)).abs() < 1e-12, "{t}");
        assert_eq!(*t, if k % 2 == 0 { falling[k / 2] } else { rising[k / 2] });
    }
    let backward = crossings(Direction::Any, (20.0, 0.0), 0.5);
    assert_eq!(backward.len(), 7);
    assert!(backward.windows(2).all(|w| w[0] > w[1]));
    assert!((backward[6] - PI / 3.0).abs() < 1e-12, "{:e}", backward[6] - PI / 3.0);
}

/// A single step of y′ = 1 from -1 to 1, so that y = t.
fn with_unit_step(mut look: impl FnMut(&Step<'_>)) {
    let mut observer = |step: &Step<'_>| {
        look(step);
        Flow::Continue
    };
    let mut system = plain(1, |_: f64, _: &[f64], dy: &mut [f64]| dy[0] = 1.0);
    Rk4::new(2.0).integrate(&mut system, -1.0, 1.0, &mut [-1.0], &mut observer).unwrap();
}

#[test]
fn hard_roots_are_bracketed_in_few_evaluations() {
    let functions: [fn(f64) -> f64; 6] = [
        |t| t - 0.3,
        |t| (t - 0.3).powi(3),
        |t| if t < 0.3 { -1.0 } else { 1e9 },
        |t| (t - 0.3).cbrt(),
        |t| (20.0 * (t - 0.3)).exp() - 1.0,
        |t| (50.0 * (t - 0.3)).tanh(),
    ];
    for (k, f) in functions.iter().enumerate() {
        with_unit_step(|step| {
            let mut count = 0;
            let g = |_: f64, y: &[f64]| {
                count += 1;
                f(y[0])
            };
            let t = locate(step, &mut [0.0], g, Direction::Rising, 1e-12).unwrap();
            assert!((0.3 - 1e-15..=0.3 + 1.1e-12).contains(&t), "{k}: {:e}", t - 0.3);
            assert!(count <= 2 + 2 * 41, "{k}: {count} evaluations");
            if [0, 4, 5].contains(&k) {
                assert!(count <= 16, "{k}: {count} evaluations of a smooth function");
            }
        });
    }
}

#[test]
fn roots_at_the_ends_belong_to_one_step() {
    with_unit_step(|step| {
        let at = |c: f64| move |_: f64, y: &[f64]| y[0] - c;
        let mut y = [f64::NAN];
        assert_eq!(locate(step, &mut y, at(1.0), Direction::Any, 1e-9), Some(1.0));
        assert_eq!(y, [1.0]);
        assert_eq!(locate(step, &mut y, at(-1.0), Direction::Any, 1e-9), None);
        assert_eq!(locate(step, &mut y, at(0.0), Direction::Falling, 1e-9), None);
        assert_eq!(locate(step, &mut y, |_, _| f64::NAN, Direction::Any, 1e-9), None);
    });
}

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
    let good = Rk45::default();
    let with = |method: Rk45, span: (f64, f64), y0: [f64; 2]| {
        refused(run(&method, plain(2, oscillator), span, &mut y0.clone()))
    };
    let (span, y0) = ((0.0, 1.0), [1.0, 0.0]);
    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(with(good.clone(), (bad, 1.0), y0), "t0");
        assert_eq!(with(good.clone(), (0.0, bad), y0), "t_end");
        assert_eq!(with(good.clone(), span, [1.0, bad]), "y0");
        assert_eq!(with(Rk45::new(bad, 1e-6), span, y0), "rtol");
        assert_eq!(with(Rk45::new(1e-3, bad), span, y0), "atol");
    }
    assert_eq!(with(Rk45::new(-1e-3, 1e-6), span, y0), "rtol");
    assert_eq!(with(Rk45::new(1e-3, -1e-6), span, y0), "atol");
    let each = |atol: &[f64]| Rk45 { atol: Atol::Each(atol.to_vec()), ..good.clone() };
    assert_eq!(with(each(&[1e-6, -1.0]), span, y0), "atol");
    assert_eq!(with(each(&[1e-6]), span, y0), "atol");
    for bad in [0.0, -1.0, f64::NAN] {
        assert_eq!(with(Rk45 { max_step: bad, ..good.clone() }, span, y0), "max_step");
        assert_eq!(with(Rk45 { first_step: Some(bad), ..good.clone() }, span, y0), "first_step");
        let fixed = run(&Rk4::new(bad), plain(2, oscillator), span, &mut y0.clone());
        assert_eq!(refused(fixed), "step");
    }
    assert_eq!(with(Rk45 { first_step: Some(2.0), ..good }, span, y0), "first_step");
    for bad in [f64::INFINITY, 1e-20] {
        let fixed = run(&Rk4::new(bad), plain(2, oscillator), span, &mut y0.clone());
        assert_eq!(refused(fixed), "step");
    }
    assert_eq!(refused(run(&Rk4::new(0.1), plain(2, oscillator), span, &mut [1.0])), "y0");
}

#[test]
fn a_tolerance_below_rounding_is_raised() {
    assert_eq!(Rk45::new(0.0, 1e-12).rtol_used(), 100.0 * f64::EPSILON);
    assert_eq!(Rk45::new(1e-9, 1e-12).rtol_used(), 1e-9);
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
    assert_eq!((failure.t, failure.statistics.t), (t, t));
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
    assert_eq!(failure.y, y);
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
    let method = Rk45 { first_step: Some(1.9), ..Rk45::new(1e-2, 1e-4) };
    let mut y = [1.0];
    let done = run(&method, plain(1, root), (0.0, 1.9), &mut y).unwrap();
    assert!(done.rejected > 0);
    assert!((y[0] - 0.05_f64.powi(2)).abs() < 1e-3, "{}", y[0]);
}

#[test]
fn the_number_of_steps_can_be_bounded() {
    let most = Rk45 { max_steps: Some(5), ..Rk45::new(1e-6, 1e-9) };
    let failure = run(&most, plain(2, van_der_pol), (0.0, 20.0), &mut [2.0, 0.0]).unwrap_err();
    assert_eq!(failure.cause, Cause::MaxSteps { steps: 5 });
    assert_eq!(failure.statistics.steps, 5);
    assert!(failure.t > 0.0);
    let most = Rk4 { step: 0.1, max_steps: Some(5) };
    let outcome = run(&most, plain(2, oscillator), (0.0, 1.0), &mut [2.0, 0.0]);
    assert_eq!(cause(outcome), Cause::MaxSteps { steps: 5 });
    let enough = Rk4 { step: 0.1, max_steps: Some(10) };
    assert!(run(&enough, plain(2, oscillator), (0.0, 1.0), &mut [2.0, 0.0]).is_ok());
}

/// y′ = 1 that stops for good past t = 1, in the rate or at acceptance.
struct Stops {
    in_rate: bool,
}

impl System for Stops {
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
    fn accepted(&mut self, t: f64, _: &mut [f64]) -> Result<bool, String> {
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
            assert_eq!(cause(outcome), Cause::System("the crank locks".into()));
        }
        let method = Rk45 { max_step: 0.3, ..Rk45::default() };
        let failure = run(&method, Stops { in_rate }, (0.0, 2.0), &mut [0.0]).unwrap_err();
        assert_eq!(failure.to_string(), "the crank locks");
        assert!(failure.t <= 1.0 && failure.t > 0.6);
        assert_eq!(failure.statistics.rejected, 0);
    }
}
