//! Forward dynamics at its edges.

use crate::mechanisms::{close, every, four_bar, model, run, start, tolerances, worst, PENDULUM};
use kempe::analyses::dynamics::{dynamics, Failure, Options, Reason, Stabilization};
use kempe::analyses::State;
use kempe::equations::Gains;
use kempe::integrate::Flow;
use kempe::model::Model;

fn pendulum(force: &str) -> (Model, State) {
    let m = model(&format!("{PENDULUM}{force}"));
    let (state, _) = start(&m, &[("rod.angle", "0.1"), ("rod.omega", "1")], &[]);
    (m, state)
}

fn fails(m: &Model, state: &State, options: &Options) -> Box<Failure> {
    dynamics(m, state, options, |_| Flow::Continue).expect_err("must fail")
}

#[test]
fn the_grid_is_landed_on_exactly() {
    let (m, start) = four_bar();
    let run = run(&m, &start, &every(0.01, tolerances(15.0, 1e-3, 1e-6)));
    assert_eq!(run.trajectory.t.len(), 1501);
    assert_eq!(run.trajectory.t[1500], 15.0);
    for (k, t) in run.trajectory.t.iter().enumerate() {
        close("t", *t, k as f64 * 0.01, 2e-15 * 15.0);
    }
}

#[test]
fn a_step_of_output_beyond_the_end_reports_the_ends() {
    let (m, state) = pendulum("");
    for h in [2.0, 1e6] {
        let run = run(&m, &state, &every(h, tolerances(0.5, 1e-6, 1e-9)));
        assert_eq!(run.trajectory.t, [0.0, 0.5]);
    }
    let run = run(&m, &state, &every(0.3, tolerances(0.5, 1e-6, 1e-9)));
    assert_eq!(run.trajectory.t, [0.0, 0.3, 0.5]);
}

#[test]
fn no_time_at_all_reports_the_start() {
    let (m, state) = pendulum("");
    for options in [every(0.1, tolerances(0.0, 1e-6, 1e-9)), tolerances(0.0, 1e-6, 1e-9)] {
        let run = run(&m, &state, &options);
        assert!(run.reached && run.statistics.steps == 0);
        assert_eq!(run.trajectory.t, [0.0]);
        assert_eq!(run.trajectory.q, state.q);
        assert_eq!(run.accelerations(&m).unwrap().a.len(), 3);
    }
}

#[test]
fn backward_and_forward_again() {
    let (m, state) = pendulum("");
    let free = |t_end| Options {
        stabilization: Stabilization::None,
        ..every(0.25, tolerances(t_end, 1e-10, 1e-12))
    };
    let back = run(&m, &state, &free(-1.0)).trajectory;
    assert_eq!(back.t, [0.0, -0.25, -0.5, -0.75, -1.0]);
    let there = State { t: -1.0, q: back.q[12..].to_vec(), v: back.v[12..].to_vec(), z: vec![] };
    let forth = run(&m, &there, &free(0.0)).trajectory;
    assert!(worst(&forth.q[12..], &state.q) < 1e-8);
    assert!(worst(&forth.v[12..], &state.v) < 1e-8);
}

#[test]
fn options_that_cannot_be() {
    let (m, state) = pendulum("");
    let gains = |alpha, beta| Options {
        stabilization: Stabilization::Baumgarte(Gains { alpha, beta }),
        ..tolerances(1.0, 1e-6, 1e-9)
    };
    let output = |h| Options { output_step: Some(h), ..tolerances(1.0, 1e-6, 1e-9) };
    for (options, expected) in [
        (output(0.0), "output_step"),
        (output(-1.0), "output_step"),
        (output(f64::NAN), "output_step"),
        (output(f64::INFINITY), "output_step"),
        (gains(f64::NAN, 0.0), "alpha"),
        (gains(1.0, -1.0), "beta"),
        (tolerances(1.0, f64::NAN, 1e-9), "rtol"),
        (tolerances(f64::NAN, 1e-6, 1e-9), "t_end"),
        (tolerances(f64::INFINITY, 1e-6, 1e-9), "t_end"),
    ] {
        match fails(&m, &state, &options).reason {
            Reason::Option { name, message } => {
                assert!(name == expected && message.contains(expected), "{name}: {message}");
            }
            other => panic!("{other}"),
        }
    }
    let short = State { q: vec![0.0; 2], ..state };
    let failure = fails(&m, &short, &tolerances(1.0, 1e-6, 1e-9));
    assert!(failure.reason.to_string().contains("q: 2"), "{}", failure.reason);
}

#[test]
fn a_force_that_ceases_to_exist_names_the_time() {
    let (m, state) = pendulum(
        "[forces.s]\ntype = \"torsion_spring\"\ni = \"ground\"\nj = \"rod\"\nstiffness = \"sqrt(0.5 - t)\"\n",
    );
    let failure = fails(&m, &state, &tolerances(1.0, 1e-6, 1e-9));
    let Reason::Integration { t, message, .. } = &failure.reason else {
        panic!("{}", failure.reason)
    };
    close("time", *t, 0.5, 1e-2);
    assert!(message.contains("infinite or undefined at t = 0.5"), "{message}");
    assert!(failure.run.trajectory.t.len() > 3, "what came before is kept");
    let last = *failure.run.trajectory.t.last().unwrap();
    assert!(last > 0.4 && failure.run.accelerations(&m).unwrap().lam.iter().all(|x| x.is_finite()));
}

#[test]
fn a_driver_that_ceases_to_exist_names_the_time() {
    let m = model(&format!(
        "{PENDULUM}[drivers.motor]\ntype = \"coordinate_driver\"\ncoordinate = \"rod.angle\"\nvalue = \"sqrt(0.5 - t)\"\n"
    ));
    let (state, _) = start(&m, &[], &[]);
    let failure = fails(&m, &state, &tolerances(1.0, 1e-6, 1e-9));
    let text = failure.reason.to_string();
    assert!(text.contains("t = 0.5") || text.contains("t = 0.49"), "{text}");
    assert!(!text.contains("singular"), "{text}");
}

#[test]
fn huge_stiffness_is_followed_not_blown_up() {
    let (m, state) = pendulum(
        "[forces.s]\ntype = \"torsion_spring\"\ni = \"ground\"\nj = \"rod\"\nstiffness = 1e9\n",
    );
    let run = run(&m, &state, &tolerances(0.01, 1e-8, 1e-10));
    let kinetic: Vec<f64> = run.energies(&m).unwrap().chunks(5).map(|e| e[0] + e[1]).collect();
    let off = kinetic.iter().map(|e| (e - kinetic[0]).abs()).fold(0.0, f64::max);
    assert!(off < 1e-5 * kinetic[0], "{off} of {}", kinetic[0]);
}

#[test]
fn a_singular_start_is_named() {
    let twins = PENDULUM.to_string()
        + "[joints.pin2]\ntype = \"revolute\"\ni = \"ground.O\"\nj = \"rod.O\"\n";
    let m = model(&twins);
    let allowed = m.allowing_redundancy();
    let (state, _) = kempe::analyses::assemble::assemble(&allowed, &Default::default()).unwrap();
    let failure = fails(&m, &state, &tolerances(1.0, 1e-6, 1e-9));
    match &failure.reason {
        Reason::Singular { t, name, message } => {
            assert!(*t == 0.0 && name.starts_with("pin") && message.contains("t = 0"), "{message}");
        }
        other => panic!("{other}"),
    }
    // allowed, it moves as with one pin, and the two share the load
    let (double, single) = (run(&allowed, &state, &tolerances(1.0, 1e-9, 1e-12)), {
        let m = model(PENDULUM);
        run(&m, &State { z: vec![], ..state.clone() }, &tolerances(1.0, 1e-9, 1e-12))
    });
    let end = |run: &kempe::analyses::dynamics::Run, n: usize, table: &[f64]| {
        table[(run.trajectory.t.len() - 1) * n..].to_vec()
    };
    let (a, b) = (end(&double, 3, &double.trajectory.q), end(&single, 3, &single.trajectory.q));
    assert!(worst(&a, &b) < 1e-7, "{a:?} {b:?}");
    let both = double.accelerations(&allowed).unwrap().lam;
    let alone = single.accelerations(&model(PENDULUM)).unwrap().lam;
    let (two, one) = (end(&double, 4, &both), end(&single, 2, &alone));
    // how twins share is rounding (1e-16) over damping (1e-10); what they carry together is not
    let (first, only) = (&both[..4], &alone[..2]);
    for k in 0..2 {
        close("load at the start", first[k] + first[k + 2], only[k], 1e-9);
        close("load at the end", two[k] + two[k + 2], one[k], 1e-9);
        close("shared at the start", first[k], first[k + 2], 1e-5 * 9.81);
        close("shared at the end", two[k], two[k + 2], 1e-5 * 9.81);
    }
}

#[test]
fn the_observer_stops_a_run() {
    let (m, start) = four_bar();
    let options = tolerances(15.0, 1e-6, 1e-9);
    let run = dynamics(&m, &start, &options, |t| if t > 0.1 { Flow::Stop } else { Flow::Continue });
    let run = run.unwrap();
    assert!(!run.reached && *run.trajectory.t.last().unwrap() < 1.0);
}
