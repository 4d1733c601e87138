//! Projection on mechanisms of every kind, and its guarantees for one state.

use crate::mechanisms::{
    every, four_bar, largest, model, pinned, rate, residual, run, start, tolerances, worst, Random,
    SLIDER_CRANK,
};
use kempe::analyses::assemble::{assemble, Request};
use kempe::analyses::dynamics::{dynamics, Options, Reason, Scheme, Stabilization};
use kempe::analyses::State;
use kempe::equations::{dense, energy, kinematics, mass, Workspace};
use kempe::integrate::{Flow, Rk4};
use kempe::model::Model;
use kempe::solve::Breakdown;
use kempe::stabilize::{Projection, Projector};

fn projected(options: Options) -> Options {
    Options { stabilization: Stabilization::Projection(Projection::default()), ..options }
}

fn project(m: &Model, state: &State) -> Result<(State, bool), Breakdown> {
    let (mut projector, mut workspace) =
        (Projector::new(m, Projection::default()), Workspace::new(m));
    let mut out = state.clone();
    let changed = projector.project(&mut workspace, state.t, (&mut out.q, &mut out.v), false)?;
    Ok((out, changed))
}

/// M x at a state.
fn mass_times(m: &Model, state: &State, x: &[f64]) -> Vec<f64> {
    let motions = kinematics::Motions::at(&m.layout, &state.q, &state.v);
    let bodies = m.bodies[1..].iter().zip(&motions[1..]).zip(x.chunks_exact(3));
    bodies.flat_map(|((b, motion), x)| mass::block(b, motion).times([x[0], x[1], x[2]])).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The flagship with everything a little off, and its rate of motion.
fn off(size: f64) -> (Model, State) {
    let (m, mut state) = four_bar();
    let mut random = Random::new(7);
    state.q.iter_mut().for_each(|q| *q += size * random.next());
    state.v = random.many(9);
    (m, state)
}

#[test]
fn the_nearest_state_in_the_metric_of_the_masses() {
    for size in [1e-3, 1e-5] {
        let (m, state) = off(size);
        let (found, changed) = project(&m, &state).unwrap();
        assert!(changed);
        assert!(largest(&residual(&m, &found)) < 1e-11 && largest(&rate(&m, &found)) < 1e-11);
        // the velocities found span the admissible ones, of which there is one direction
        let phi_q = dense::jacobian(&m, &kinematics::Motions::at_rest(&m.layout, &found.q), 0.0);
        assert!(phi_q.chunks_exact(9).all(|row| dot(row, &found.v).abs() < 1e-11));
        let momentum = mass_times(&m, &found, &found.v);
        let by = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<f64>>();
        let [dq, dv] = [by(&found.q, &state.q), by(&found.v, &state.v)];
        let cosine = |x: &[f64]| {
            let norm = dot(&mass_times(&m, &found, x), x).sqrt();
            dot(&momentum, x) / (norm * dot(&momentum, &found.v).sqrt())
        };
        // chord directions are those of a state nearby
        assert!(cosine(&dv).abs() < 10.0 * size, "{:.2e}", cosine(&dv));
        assert!(cosine(&dq).abs() < 10.0 * size, "{:.2e}", cosine(&dq));
        let kinetic = |state: &State| {
            energy::kinetic(&m, &kinematics::Motions::at(&m.layout, &state.q, &state.v))
        };
        assert!(kinetic(&found) < kinetic(&state));
    }
}

#[test]
fn a_state_on_the_constraints_is_left_alone() {
    let (m, _) = four_bar();
    let guess = [("coupler.angle", "14*deg"), ("rocker.angle", "240*deg")];
    let set = [("crank.angle", "70*deg"), ("crank.omega", "3")];
    let (state, _) = start(&m, &set, &guess);
    assert_eq!(project(&m, &state).unwrap(), (state, false));
}

#[test]
fn a_factor_from_elsewhere_only_costs_iterations() {
    let (m, state) = off(1e-3);
    let (found, _) = project(&m, &state).unwrap();
    let (mut projector, mut workspace) =
        (Projector::new(&m, Projection::default()), Workspace::new(&m));
    let (_, mut elsewhere) = off(1.0);
    let gains = kempe::equations::Gains::default();
    workspace.accelerate(&m, 0.0, [&elsewhere.q, &elsewhere.v, &[]], gains).unwrap();
    elsewhere = state;
    let State { q, v, .. } = &mut elsewhere;
    projector.project(&mut workspace, 0.0, (q, v), true).unwrap();
    assert!(projector.factorisations > 0);
    assert!(largest(&residual(&m, &elsewhere)) < 1e-11 && largest(&rate(&m, &elsewhere)) < 1e-11);
    assert!(worst(&elsewhere.q, &found.q) < 0.01);
}

#[test]
fn a_start_that_is_open_is_refused_by_name() {
    let (m, mut state) = off(1e-3);
    let short = projected(tolerances(0.1, 1e-6, 1e-9));
    let refused = |state: &State| {
        let failure = dynamics(&m, state, &short, |_| Flow::Continue).unwrap_err();
        let Reason::Start { t, message, .. } = failure.reason else { panic!("{failure:?}") };
        assert_eq!((t, failure.run.trajectory.t.len()), (0.0, 0));
        message
    };
    assert!(refused(&state).contains("joint C is open by 1.07"));
    // assembled anew, it starts nearby
    let request = Request { state: Some(state.clone()), ..Request::default() };
    let (first, _) = assemble(&m, &request).unwrap();
    assert!(largest(&residual(&m, &first)) < 1e-11);
    assert!(worst(&first.q, &state.q) < 0.1);
    run(&m, &first, &short);

    state.q[0] = 1e6; // the crank a thousand kilometres away, at any angle
    state.q[3] = -1e6;
    let message = refused(&state);
    assert!(message.contains("joint B is open by 2.000e6 m"), "{message}");
}

#[test]
fn a_tolerance_of_nothing_is_refused() {
    let (m, state) = four_bar();
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let stabilization = Stabilization::Projection(Projection { tolerance });
        let options = Options { stabilization, ..tolerances(0.1, 1e-6, 1e-9) };
        let failure = dynamics(&m, &state, &options, |_| Flow::Continue).unwrap_err();
        let named = matches!(failure.reason, Reason::Option { name: "tolerance", .. });
        assert!(named, "{failure:?}");
    }
}

/// Largest |Φ| and |Φ̇| over all reported states of a run over `t_end` at loose tolerances.
fn open(m: &Model, state: &State, options: &Options) -> (f64, f64) {
    let run = run(m, state, options);
    let n = m.layout.n_q;
    let (mut phi, mut dphi) = (0.0, 0.0);
    for (k, &t) in run.trajectory.t.iter().enumerate() {
        let [q, v] = [&run.trajectory.q, &run.trajectory.v].map(|x| x[k * n..][..n].to_vec());
        let state = State { t, q, v, z: vec![] };
        phi = f64::max(phi, largest(&residual(m, &state)));
        dphi = f64::max(dphi, largest(&rate(m, &state)));
    }
    (phi, dphi)
}

const PARALLELOGRAM: &str = r#"
gravity = [0, -9.81]
redundancy = "allow"
[bodies.ground]
points = { P = [0, 0], Q = [1, 0], R = [2, 0] }
[bodies.first]
type = "bar"
mass = 1
length = 1
ends = ["A", "B"]
[bodies.second]
type = "bar"
mass = 1
length = 1
ends = ["A", "B"]
[bodies.third]
type = "bar"
mass = 1
length = 1
ends = ["A", "B"]
[bodies.plate]
mass = 2
inertia = 0.5
points = { P = [-1, 0], Q = [0, 0], R = [1, 0] }
[joints.P]
type = "revolute"
i = "ground.P"
j = "first.A"
[joints.Q]
type = "revolute"
i = "ground.Q"
j = "second.A"
[joints.R]
type = "revolute"
i = "ground.R"
j = "third.A"
[joints.BP]
type = "revolute"
i = "first.B"
j = "plate.P"
[joints.BQ]
type = "revolute"
i = "second.B"
j = "plate.Q"
[joints.BR]
type = "revolute"
i = "third.B"
j = "plate.R"
"#;

#[test]
fn redundant_joints_stay_closed() {
    let m = model(PARALLELOGRAM);
    let guess = [("second.angle", "1"), ("third.angle", "1"), ("plate.angle", "0")];
    let (state, _) = start(&m, &[("first.angle", "1"), ("first.omega", "3")], &guess);
    let options = projected(every(0.01, tolerances(0.25, 1e-3, 1e-6)));
    let (phi, dphi) = open(&m, &state, &options);
    assert!(phi < 1e-11 && dphi < 1e-10, "{phi:.2e} {dphi:.2e}");
}

#[test]
fn a_slide_stays_straight() {
    let m = model(SLIDER_CRANK);
    let set = [("crank.angle", "0.3"), ("crank.omega", "40")];
    let (state, _) = start(&m, &set, &[("rod.angle", "-0.1"), ("piston.x", "0.4")]);
    let options = projected(every(0.003, tolerances(1.0, 1e-3, 1e-6)));
    let (phi, dphi) = open(&m, &state, &options);
    assert!(phi < 1e-12 && dphi < 1e-10, "{phi:.2e} {dphi:.2e}");
}

#[test]
fn a_driver_is_followed() {
    let text = format!(
        "{SLIDER_CRANK}\n[drivers.motor]\ntype = \"coordinate_driver\"\n\
         coordinate = \"crank.angle\"\nvalue = \"1000*t + 0.2*sin(30*t)\"\n"
    );
    let m = model(&text);
    let (state, _) = start(&m, &[], &[("rod.angle", "-0.1"), ("piston.x", "0.4")]);
    let options = projected(tolerances(2.0, 1e-3, 1e-6));
    let (phi, dphi) = open(&m, &state, &options);
    // angles of 2000 rad are known to 2e-13 rad, their rates of 1000 rad/s are those of rounding too
    assert!(phi < 1e-11 && dphi < 1e-8, "{phi:.2e} {dphi:.2e}");
}

#[test]
fn constant_steps_are_projected_and_keep_their_order() {
    let (m, state) = four_bar();
    let constant = |step: f64, stabilization| {
        let scheme = Scheme::Rk4(Rk4::new(step));
        Options { method: scheme, stabilization, dense_output: false, ..Options::classical(0.05) }
    };
    let projection = Stabilization::Projection(Projection::default());
    let end = |options: &Options| {
        let q = run(&m, &state, options).trajectory.q;
        q[q.len() - 9..].to_vec()
    };
    let exact = end(&projected(tolerances(0.05, 1e-13, 1e-15)));
    let errors = [16.0, 32.0, 64.0].map(|n| worst(&end(&constant(0.05 / n, projection)), &exact));
    let slopes = [(errors[0] / errors[1]).log2(), (errors[1] / errors[2]).log2()];
    assert!(slopes.iter().all(|s| (3.7..4.6).contains(s)), "{slopes:?} of {errors:?}");
    let (phi, _) = open(&m, &state, &constant(1e-3, projection));
    assert!(phi < 2e-11, "{phi:.2e}");
}

/// After 1e16 rad the spacing of numbers is 2 rad: no angle closes the joint, and rounding is no excuse.
#[test]
fn coordinates_without_digits_left_are_refused() {
    let m = model(&pinned("rod", "mass = 1\ninertia = 0\npoints = { O = [1, 0] }"));
    let turned =
        |angle: f64| State { t: 0.0, q: vec![-1.0, 0.5, angle], v: vec![0.0; 3], z: vec![] };
    let (found, _) = project(&m, &turned(1e6)).unwrap();
    assert!(largest(&residual(&m, &found)) < 1e-8);
    let Breakdown::Open { gap, .. } = project(&m, &turned(1e16)).unwrap_err() else {
        panic!("open")
    };
    assert!(gap.abs() > 1e-8, "{gap:.1e}");
}

/// A damped mechanism comes to rest, down to the least numbers there are.
#[test]
fn rates_below_the_normal_numbers_are_rest() {
    let (m, mut state) = four_bar();
    state.v = vec![2e-321, 1e-322, 3e-321, -2e-321, 5e-324, 1e-320, 0.0, 3e-322, 1e-321];
    let (found, _) = project(&m, &state).unwrap();
    assert!(largest(&found.v) < 1e-300);
}
