//! Laws that a host computes, at each evaluation and sampled.

use crate::mechanisms::{close, model, run, start};
use kempe::analyses::dynamics::{dynamics, Auto, Options, Scheme, Stepper};
use kempe::analyses::State;
use kempe::case::{read, Format};
use kempe::equations::tangent::Tangent;
use kempe::integrate::{AlphaParameters, Dop853, Flow, GeneralizedAlpha, Radau, Rk4, Rk45};
use kempe::math::{Jet, Lanes, Real};
use kempe::model::{build, FunctionLaw, Functions, Host, Model, Sampling, Value};
use std::sync::{Arc, Mutex};

/// A law as a function of x = (t, q, v, z), and the calls of it.
struct Calls<F> {
    f: F,
    at: Mutex<Vec<f64>>,
}

impl<F> std::fmt::Debug for Calls<F> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a function")
    }
}

impl<F: Fn(&[f64]) -> f64 + Send + Sync> Host for Calls<F> {
    fn value(&self, _: usize, x: &[f64]) -> f64 {
        self.at.lock().unwrap().push(x[0]);
        (self.f)(x)
    }
    fn slopes(&self, _: usize, _: &[f64]) -> Vec<f64> {
        Vec::new()
    }
}

/// A mass on a slide in the direction of x, drawn by the force `drive.force`.
const SLIDE: &str = r#"
[bodies.ground]
points = { O = [0, 0] }
[bodies.cart]
mass = 2
inertia = 0.3
points = { S = [0, 0] }
[joints.slide]
type = "translational"
i = "ground.O"
j = "cart.S"
[forces.drive]
type = "force"
j = "cart.S"
force = [LAW, 0]
"#;

/// The slide with a function in the place of its law.
fn with<F: Fn(&[f64]) -> f64 + Send + Sync + 'static>(
    f: F,
    sampling: Option<Sampling>,
) -> (Model, Arc<Calls<F>>) {
    let text = format!("kempe = 1\n{}", SLIDE.replace("LAW", "0"));
    let (mut case, _) = read(&text, Format::Toml).unwrap();
    for (name, value) in &mut case.definition.forces[0].fields {
        if name == "force" {
            *value = Value::List(vec![Value::Function(0), 0.0.into()]);
        }
    }
    let (element, field, unit) = ("drive".to_string(), "force_1".to_string(), String::new());
    let laws = vec![FunctionLaw { element, field, unit, sampling, slopes: false }];
    let host = Arc::new(Calls { f, at: Mutex::default() });
    case.definition.functions = Some(Functions { laws, host: host.clone() });
    (build(&case.definition, &[]).unwrap(), host)
}

fn methods() -> Vec<Scheme> {
    vec![
        Scheme::Rk45(Rk45::new(1e-10, 1e-12)),
        Scheme::Dop853(Dop853::new(1e-10, 1e-12)),
        Scheme::Rk4(Rk4::new(1e-3)),
        Scheme::Radau(Radau::new(1e-10, 1e-12)),
        Scheme::GeneralizedAlpha(GeneralizedAlpha::constant(
            AlphaParameters::chung_hulbert(0.8),
            1e-3,
            1e-10,
            1e-12,
        )),
        Scheme::Auto(Auto::default()),
    ]
}

fn options(method: Scheme, t_end: f64) -> Options {
    Options { method, output_step: Some(0.1), ..Options::new(t_end) }
}

#[test]
fn a_function_is_the_formula_for_every_method() {
    let written = model(&SLIDE.replace("LAW", "\"-50*cart.x - 3*cart.vx + sin(t)\""));
    let (computed, _) = with(|x| -50.0 * x[1] - 3.0 * x[4] + x[0].sin(), None);
    for method in methods() {
        let of = |m: &Model| {
            let (state, _) = start(m, &[("cart.x", "0.2")], &[]);
            run(m, &state, &options(method.clone(), 1.0)).trajectory
        };
        let (a, b) = (of(&written), of(&computed));
        assert_eq!(a.t, b.t);
        for (a, b) in a.q.iter().zip(&b.q) {
            // Newton's iterations of implicit methods stop at other errors
            close("q", *a, *b, 1e-11);
        }
    }
}

#[test]
fn derivatives_of_a_function_are_differences() {
    let written = model(&SLIDE.replace("LAW", "\"cos(3*cart.x)*cart.vx^2 + cart.angle\""));
    let (computed, _) = with(|x| (3.0 * x[1]).cos() * x[4] * x[4] + x[3], None);
    let state = State { t: 0.3, q: vec![0.4, 0.0, 0.1], v: vec![1.7, 0.0, 0.0], z: vec![] };
    let of = |m: &Model| {
        let mut tangent = Tangent::new(m);
        let motions = kempe::equations::kinematics::Motions::at(&m.layout, &state.q, &state.v);
        tangent.linearize(m, &motions, state.t, [&[0.0; 3], &[0.0; 2], &[]]);
        (tangent.stiffness[0], tangent.damping[0])
    };
    let ((k, d), (k_of, d_of)) = (of(&written), of(&computed));
    assert!(k[0][0].abs() > 1.0 && k[0][2] == -1.0 && d[0][0].abs() > 0.5);
    for (row, row_of) in k.iter().chain(&d).zip(k_of.iter().chain(&d_of)) {
        (0..3).for_each(|c| close("derivative", row[c], row_of[c], 1e-6));
    }
}

/// x'' = u/m with u held from sample to sample is a linear map from sample to sample.
fn sampled_by_hand(gains: [f64; 2], period: f64, samples: usize) -> Vec<[f64; 3]> {
    let ([mut x, mut v], mut rows) = ([0.2, 0.0], Vec::new());
    for _ in 0..samples {
        let u = -gains[0] * x - gains[1] * v;
        rows.push([x, v, u]);
        x += v * period + 0.25 * u * period * period;
        v += 0.5 * u * period;
    }
    rows
}

#[test]
fn a_sampled_law_is_called_at_its_times_and_held_between() {
    let sampling = Sampling { period: 0.02, start: 0.0 };
    for method in methods() {
        let (m, host) = with(|x| -30.0 * x[1] - 4.0 * x[4], Some(sampling));
        let (state, _) = start(&m, &[("cart.x", "0.2")], &[]);
        let output_step = Some(0.01);
        let run = run(&m, &state, &Options { output_step, ..options(method, 1.0) });
        let called = host.at.lock().unwrap().clone();
        let times: Vec<f64> = (0..50).map(|k| f64::from(k) * 0.02).collect();
        assert_eq!(called, times);
        // the rows at even places are those of the samples, those between have the value held
        let rows = sampled_by_hand([30.0, 4.0], 0.02, 50);
        for (k, [x, v, u]) in rows.iter().enumerate() {
            let (q, rate, z) = (&run.trajectory.q, &run.trajectory.v, &run.trajectory.z);
            close("x", q[6 * k], *x, 1e-10);
            close("v", rate[6 * k], *v, 1e-10);
            close("u", z[2 * k], *u, 1e-9);
            close("u between", z[2 * k + 1], *u, 1e-9);
        }
        assert_eq!(run.trajectory.z.len(), 101);
        // no sample at the end: the value held until then
        close("u at the end", run.trajectory.z[100], rows[49][2], 1e-9);
    }
}

#[test]
fn a_run_in_parts_samples_once_at_each_time() {
    let sampling = Sampling { period: 0.1, start: 0.05 };
    let (m, host) = with(|x| 1.0 + x[0], Some(sampling));
    let (state, _) = start(&m, &[], &[]);
    let first =
        run(&m, &state, &Options { output_step: None, ..options(Options::new(1.0).method, 0.45) });
    let n = first.trajectory.t.len() - 1;
    let row = |x: &[f64], width: usize| x[width * n..].to_vec();
    let at = &first.trajectory;
    let (q, v, z) = (row(&at.q, 3), row(&at.v, 3), row(&at.z, 1));
    close("held before the first sample", first.trajectory.z[0], 0.0, 0.0);
    close("held", z[0], 1.35, 1e-12);
    let next = State { t: 0.45, q, v, z };
    let second = run(&m, &next, &options(Options::new(1.0).method, 0.8));
    close("held at once", second.trajectory.z[0], 1.45, 1e-12);
    let called = host.at.lock().unwrap().clone();
    let expected = [0.05, 0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75];
    assert_eq!(called.len(), expected.len(), "{called:?}");
    called.iter().zip(expected).for_each(|(is, t)| close("time", *is, t, 1e-15));
}

#[test]
fn the_step_to_a_sample_beyond_an_event_does_not_call_the_law() {
    let sampling = Sampling { period: 0.1, start: 0.0 };
    let (m, host) = with(|_| 4.0, Some(sampling));
    let (state, _) = start(&m, &[], &[]);
    // x = t² is 0.0625 at 0.25 s
    let stop = Some("cart.x > 0.0625".to_string());
    let options = Options { stop, output_step: None, ..options(Options::new(1.0).method, 1.0) };
    let run = run(&m, &state, &options);
    close("end", *run.trajectory.t.last().unwrap(), 0.25, 1e-12);
    assert_eq!(*host.at.lock().unwrap(), [0.0, 0.1, 0.2]);
}

#[test]
fn a_restart_at_a_sample_takes_it_once() {
    let (m, host) = with(|x| 1.0 + x[4], Some(Sampling { period: 0.1, start: 0.0 }));
    let (state, _) = start(&m, &[], &[]);
    let mut stepper = Stepper::new(&m, &state, &Options::new(0.35)).unwrap();
    while !stepper.is_at_end() {
        stepper.step().unwrap();
        if stepper.state().t == 0.2 {
            let mut v = stepper.state().v;
            v[0] = 5.0;
            stepper.restart(&State { v, ..stepper.state() }).unwrap();
        }
    }
    assert_eq!(*host.at.lock().unwrap(), [0.0, 0.1, 0.2, 3.0 * 0.1]);
    // from 0.2 s on the force is 1 + 5 at first
    close("v", stepper.state().v[0], 5.0 + 0.3 + 0.025 * (1.0 + 5.3), 1e-9);
}

#[test]
fn a_sampled_law_refuses_a_run_backward_and_a_million_samples() {
    let refused = |t_end: f64, period: f64| {
        let (m, _) = with(|_| 0.0, Some(Sampling { period, start: 0.0 }));
        let (state, _) = start(&m, &[], &[]);
        let options = Options::new(t_end);
        let outcome = dynamics(&m, &state, &options, |_| Flow::Continue);
        outcome.unwrap_err().reason.to_string()
    };
    assert!(refused(-1.0, 0.1).contains("the sampled force_1 of drive cannot run backward"));
    assert!(refused(100.0, 1e-5).contains("more than a million samples"));
}

#[test]
fn the_next_sample_of_a_time() {
    let sampling = Sampling { period: 0.1, start: 0.3 };
    let next = |t: f64| sampling.time(sampling.next(t));
    close("before the start", next(-2.0), 0.3, 0.0);
    close("at a sample, up to rounding", next(0.1 + 0.2 + 3.0 * 0.1), 0.6, 1e-15);
    close("between", next(0.61), 0.7, 1e-15);
    assert!(sampling.is_at(0.6) && !sampling.is_at(0.601) && !sampling.is_at(0.2));
}

#[test]
fn time_derivatives_of_a_function_are_differences() {
    // along x = 0.3 + 2 τ + τ², y = 1 - τ
    let at = [Jet::new(0.3, 2.0, 2.0), Jet::new(1.0, -1.0, 0.0)];
    let found: Jet = Jet::of_values(&|x: &[f64]| x[0] * x[0] * x[1], &at);
    let (x, y) = (Jet::new(0.3, 2.0, 2.0), Jet::new(1.0, -1.0, 0.0));
    let exact: Jet = x * x * y;
    close("value", found.value, exact.value, 0.0);
    close("rate", found.rate, exact.rate, 1e-6);
    close("second", found.second, exact.second, 1e-5);
}

#[test]
fn lanes_of_a_function_are_its_values() {
    let lanes = |a: [f64; 4]| Lanes::new(a);
    let (x, y) = (lanes([1.0, 2.0, 3.0, 4.0]), lanes([0.1, 0.2, 0.3, 0.4]));
    let found = Lanes::of_values(&|x: &[f64]| x[0].sin() + x[1], &[x, y]).to_array();
    let expected = [1.0_f64, 2.0, 3.0, 4.0].map(|x| x.sin() + 0.1 * x);
    found.iter().zip(expected).for_each(|(is, x)| close("lane", *is, x, 1e-15));
}
