//! Abilities of every method: laws, drivers, bodies without inertia, redundancy, energy, both directions
//! of time, errors that help.

use crate::mechanisms::{
    close, every, four_bar, largest, model, rate, residual, run, start, worst, DOUBLE_PENDULUM,
};
use kempe::analyses::dynamics::{dynamics, Auto, Options, Reason, Run, Scheme, Stabilization};
use kempe::analyses::State;
use kempe::equations::Gains;
use kempe::integrate::{AlphaParameters, Dop853, Flow, GeneralizedAlpha, Radau, StepControl};
use kempe::model::Model;
use kempe::stabilize::Projection;

fn options(t_end: f64, scheme: Scheme) -> Options {
    let stabilization = Stabilization::Projection(Projection::default());
    Options { method: scheme, stabilization, ..Options::classical(t_end) }
}

fn alpha(rtol: f64) -> Scheme {
    let parameters = AlphaParameters::chung_hulbert(0.8);
    Scheme::GeneralizedAlpha(GeneralizedAlpha::new(parameters, rtol, 1e-3 * rtol))
}

fn radau(rtol: f64) -> Scheme {
    Scheme::Radau(Radau::new(rtol, 1e-3 * rtol))
}

fn exact(m: &Model, state: &State, t_end: f64) -> Run {
    let scheme = Scheme::Dop853(Dop853::new(1e-12, 1e-14));
    run(m, state, &every(0.1 * t_end, options(t_end, scheme)))
}

/// Both methods against DOP853: q within their own bounds, λ relative to the largest, drift at rounding.
fn agree(m: &Model, state: &State, t_end: f64, bounds: [f64; 2]) {
    let exact = exact(m, state, t_end);
    for (scheme, bound) in [(alpha(1e-6), bounds[0]), (radau(1e-9), bounds[1])] {
        let found = run(m, state, &every(0.1 * t_end, options(t_end, scheme)));
        let (q, v) = (&found.trajectory.q, &found.trajectory.v);
        let off = worst(q, &exact.trajectory.q);
        assert!(off < bound, "q off by {off:.1e}, allowed {bound:.1e}");
        let [lam, truth] = [&found, &exact].map(|run| run.accelerations(m).unwrap().lam);
        let off = worst(&lam, &truth) / largest(&truth).max(1.0);
        assert!(off < 100.0 * bound, "lambda off by {off:.1e}");
        let scale = largest(v).max(1.0);
        for (k, &t) in found.trajectory.t.iter().enumerate() {
            let n = m.layout.n_q;
            let range = k * n..(k + 1) * n;
            let (q, v) = (q[range.clone()].to_vec(), v[range].to_vec());
            let state = State { t, q, v, z: Vec::new() };
            assert!(largest(&residual(m, &state)) < 1e-10);
            assert!(largest(&rate(m, &state)) < 1e-10 * scale);
        }
    }
}

/// Forces on the driven double pendulum: friction, and a torque that depends on time.
const FORCES: &str = r#"
[forces.friction]
type = "torsion_spring"
i = "upper"
j = "lower"
damping = "0.1 + 0.05*lower.omega^2"
[forces.push]
type = "torque"
j = "lower"
torque = "0.5*cos(2*t)"
"#;

#[test]
fn drivers_and_laws_of_time_and_state() {
    let m = model(&format!("{DOUBLE_PENDULUM}{FORCES}"));
    let (state, _) = start(&m, &[("lower.angle", "-1")], &[]);
    agree(&m, &state, 1.0, [3e-4, 1e-8]);
}

/// Works are quadratures: the balance closes to the error of the method.
#[test]
fn the_energy_balance_closes() {
    let m = model(&format!("{DOUBLE_PENDULUM}{FORCES}"));
    let (state, _) = start(&m, &[("lower.angle", "-1")], &[]);
    for (scheme, bound) in [(alpha(1e-6), 1e-3), (radau(1e-9), 1e-7)] {
        let found = run(&m, &state, &options(1.0, scheme));
        let balance = |row: &[f64]| row[0] + row[1] + row[2] - row[3] - row[4];
        let energies = found.energies(&m).unwrap();
        let rows: Vec<f64> = energies.chunks_exact(5).map(balance).collect();
        let works = energies.chunks_exact(5).last().unwrap()[2..].to_vec();
        assert!(works.iter().all(|w| w.abs() > 1e-2), "all kinds of work are done: {works:?}");
        let off = rows.iter().fold(0.0, |most: f64, b| most.max((b - rows[0]).abs()));
        assert!(off < bound, "{off:.1e}, allowed {bound:.1e}");
    }
}

#[test]
fn bodies_without_inertia() {
    let on_its_rod = r#"
gravity = [0, -9.81]
[bodies.ground]
points = { O = [0, 0] }
[bodies.bob]
mass = 1
inertia = 0
points = { O = [1, 0] }
[joints.pin]
type = "revolute"
i = "ground.O"
j = "bob.O"
"#;
    let m = model(on_its_rod);
    let (state, _) = start(&m, &[("bob.angle", "0.3")], &[("bob.x", "-1")]);
    agree(&m, &state, 1.0, [3e-4, 1e-8]);
    let at_a_distance = on_its_rod
        .replace("points = { O = [1, 0] }", "points = { P = [0, 0] }")
        .replace("bob.O", "bob.P")
        .replace("revolute", "distance")
        + "length = 1\n";
    let m = model(&at_a_distance);
    let (state, _) = start(&m, &[("bob.y", "0"), ("bob.angle", "0.3")], &[("bob.x", "-1")]);
    agree(&m, &state, 1.0, [3e-4, 1e-8]);
}

#[test]
fn redundant_constraints_that_are_allowed() {
    let text = crate::mechanisms::FOUR_BAR.replace(
        "[forces.spring]",
        "[joints.D2]\ntype = \"revolute\"\ni = \"ground.D\"\nj = \"rocker.D\"\n\n[forces.spring]",
    );
    let m = model(&text).allowing_redundancy();
    let (plain, state) = four_bar();
    for (scheme, same) in [(alpha(1e-5), alpha(1e-5)), (radau(1e-8), radau(1e-8))] {
        let found = run(&m, &state, &every(0.1, options(0.5, scheme)));
        let expected = run(&plain, &state, &every(0.1, options(0.5, same)));
        assert!(worst(&found.trajectory.q, &expected.trajectory.q) < 1e-5);
    }
}

#[test]
fn the_flagship_to_its_end() {
    let (m, state) = four_bar();
    let exact = exact(&m, &state, 15.0);
    let found = run(&m, &state, &every(1.5, options(15.0, radau(1e-8))));
    assert!(worst(&found.trajectory.q, &exact.trajectory.q) < 1e-8);
}

#[test]
fn backward_in_time() {
    let (m, state) = four_bar();
    for (scheme, back, bound) in
        [(alpha(1e-6), alpha(1e-6), 1e-4), (radau(1e-9), radau(1e-9), 1e-7)]
    {
        let there = run(&m, &state, &options(0.1, scheme));
        let n = m.layout.n_q;
        let last = (there.trajectory.t.len() - 1) * n;
        let end = State {
            t: 0.1,
            q: there.trajectory.q[last..].to_vec(),
            v: there.trajectory.v[last..].to_vec(),
            z: Vec::new(),
        };
        let home = run(&m, &end, &options(0.0, back));
        let last = (home.trajectory.t.len() - 1) * n;
        assert_eq!(home.trajectory.t.last(), Some(&0.0));
        let off = worst(&home.trajectory.q[last..], &state.q);
        assert!(off < bound, "{off:.1e}");
    }
}

/// Without projection the positions still meet their constraints: they are among the equations of
/// generalized-α; those of Radau are integrated and drift with its error.
#[test]
fn without_projection() {
    let (m, state) = four_bar();
    for (scheme, bound) in [(alpha(1e-6), 1e-8), (radau(1e-8), 1e-6)] {
        let options = Options { stabilization: Stabilization::None, ..options(0.5, scheme) };
        let found = run(&m, &state, &options);
        let n = m.layout.n_q;
        let q = found.trajectory.q[found.trajectory.q.len() - n..].to_vec();
        let gap = largest(&residual(&m, &State { q, ..state.clone() }));
        assert!(gap > 0.0 && gap < bound, "{gap:.1e}");
    }
}

/// With steps of different lengths and without projection, the velocities of a driven rod are those of its law. A
/// deviation of order h² that is carried into longer steps grows to 29 % here.
#[test]
fn variable_steps_without_projection() {
    let (law, t_end) = ("sin(5*t) + 0.2*sin(60*t)*exp(-20*(t - 0.4)^2)", 1.0);
    let speed = |t: f64| {
        let bell = (-20.0 * (t - 0.4) * (t - 0.4)).exp();
        let swing = 60.0 * (60.0 * t).cos() - 40.0 * (t - 0.4) * (60.0 * t).sin();
        5.0 * (5.0 * t).cos() + 0.2 * bell * swing
    };
    for (size, mass) in [(1e-3, 1e3), (1.0, 1.0), (1e3, 1e-3)] {
        let m = model(&format!(
            "kempe = 1\ntitle = \"rod\"\ngravity = [0, -9.81]\n[bodies.ground]\npoints = {{ O = [0, 0] }}\n\
             [bodies.rod]\ntype = \"bar\"\nmass = {mass}\nlength = {size}\nends = [\"O\", \"P\"]\n\
             [joints.pin]\ntype = \"revolute\"\ni = \"ground.O\"\nj = \"rod.O\"\n\
             [drivers.drive]\ntype = \"coordinate_driver\"\ncoordinate = \"rod.angle\"\nvalue = \"{law}\"\n"
        ));
        let (state, _) = start(&m, &[], &[]);
        for parameters in [AlphaParameters::chung_hulbert(0.8), AlphaParameters::hht(-0.1)] {
            let scheme = Scheme::GeneralizedAlpha(GeneralizedAlpha::new(parameters, 1e-4, 1e-7));
            let options = Options { stabilization: Stabilization::None, ..options(t_end, scheme) };
            let found = run(&m, &state, &options).trajectory;
            let off = found.t.iter().zip(found.v.chunks(3)).map(|(t, v)| (v[2] - speed(*t)).abs());
            let off = off.fold(0.0, f64::max) / speed(0.0);
            assert!(off < 1e-8, "size {size}: {off:.1e}");
        }
    }
}

#[test]
fn dense_output_is_that_of_the_steps() {
    let m = model(&format!("{DOUBLE_PENDULUM}{FORCES}"));
    let (state, _) = start(&m, &[("lower.angle", "-1")], &[]);
    let exact = exact(&m, &state, 1.0);
    for (scheme, off) in [(alpha(1e-5), 1e-3), (radau(1e-7), 1e-5)] {
        // without projection the reported states are those of the interpolant
        let options = Options { stabilization: Stabilization::None, ..options(1.0, scheme) };
        let found = run(&m, &state, &every(0.1, options));
        let dense = found.dense.expect("it was kept");
        assert_eq!((dense.degree, dense.t.len()), (4, found.statistics.steps + 1));
        let error = worst(&found.trajectory.q, &exact.trajectory.q);
        assert!(error < off, "{error:.1e}");
    }
}

fn refused(options: &Options) -> Reason {
    let (m, state) = four_bar();
    dynamics(&m, &state, options, |_| Flow::Continue).expect_err("it cannot be").reason
}

#[test]
fn baumgarte_is_refused() {
    let given = Stabilization::Baumgarte(Gains { alpha: 10.0, beta: 200.0 });
    for stabilization in [given, Stabilization::BaumgarteFromStep] {
        for scheme in [alpha(1e-4), radau(1e-6), Scheme::Auto(Auto::default())] {
            let reason = refused(&Options { stabilization, ..options(1.0, scheme) });
            assert!(reason.to_string().contains("use projection or none"), "{reason}");
        }
    }
}

#[test]
fn a_constant_step_that_is_too_long_says_so() {
    for scheme in [
        Scheme::GeneralizedAlpha(GeneralizedAlpha::constant(
            AlphaParameters::hht(-0.1),
            1.5,
            1e-10,
            1e-12,
        )),
        Scheme::Radau(Radau::constant(1.5, 1e-10, 1e-12)),
    ] {
        let Reason::Integration { message, hint, .. } = refused(&options(15.0, scheme)) else {
            panic!("an integration that failed")
        };
        assert!(message.contains("Newton's iteration"), "{message}");
        assert!(hint.contains("smaller step"), "{hint}");
    }
}

#[test]
fn steps_are_counted_and_bounded() {
    let (m, state) = four_bar();
    let found = run(&m, &state, &options(0.2, radau(1e-6)));
    let s = found.statistics;
    assert!(s.jacobians > 0 && s.jacobians <= s.steps + s.rejected);
    assert!(s.iterations >= s.steps && s.factorisations >= 2 * s.jacobians);
    let bounded = Scheme::Radau(Radau {
        control: StepControl { max_steps: Some(3), ..StepControl::new(1e-6, 1e-9) },
    });
    assert!(refused(&options(0.2, bounded)).to_string().contains("max_steps = 3"));
}

#[test]
fn it_can_be_stopped() {
    let (m, state) = four_bar();
    for scheme in [alpha(1e-4), radau(1e-6)] {
        let mut looks = 0;
        let stop = |_| {
            looks += 1;
            if looks > 5 {
                Flow::Stop
            } else {
                Flow::Continue
            }
        };
        let found = dynamics(&m, &state, &options(15.0, scheme), stop).expect("no failure");
        assert!(!found.reached && found.statistics.steps == 6);
    }
}

/// The same numbers, run after run.
#[test]
fn runs_repeat_to_the_last_bit() {
    let (m, state) = four_bar();
    let once = run(&m, &state, &options(0.3, radau(1e-7)));
    let again = run(&m, &state, &options(0.3, radau(1e-7)));
    assert_eq!(once.trajectory, again.trajectory);
    close("same", 0.0, worst(&once.trajectory.q, &again.trajectory.q), 0.0);
}
