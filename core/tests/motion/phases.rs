//! Runs through phases with different constraints, and a stepper that the caller drives.

use crate::mechanisms::{column, four_bar, largest, model, run, start, worst, FOUR_BAR};
use kempe::analyses::dynamics::{
    dynamics, Auto, Options, Prepared, Reason, Run, Scheme, Stabilization, Stepper,
};
use kempe::analyses::State;
use kempe::equations::Gains;
use kempe::integrate::{
    AlphaParameters, Direction, Dop853, Flow, GeneralizedAlpha, Radau, Rk4, Rk45,
};
use kempe::model::Model;
use kempe::stabilize::Projection;

/// The flagship with its crank driven at 1 rad/s from 70° until a condition is true, and its start.
fn driven(release: &str) -> (Model, State) {
    let driver = "[drivers.motor]\ntype = 'coordinate_driver'\ncoordinate = 'crank.angle'\n\
                  value = '70*deg + t'\n";
    let text = FOUR_BAR.replacen("[start]", &format!("{driver}release = '{release}'\n[start]"), 1);
    assert!(text.contains("drivers.motor"));
    let m = model(&text);
    let (state, _) = start(&m, &[], &[("coupler.angle", "14*deg"), ("rocker.angle", "240*deg")]);
    (m, state)
}

/// Every method, with a stabilization that fits it.
fn all() -> Vec<(Scheme, Stabilization)> {
    let projection = Stabilization::Projection(Projection::default());
    let baumgarte = Stabilization::Baumgarte(Gains { alpha: 10.0, beta: 200.0 });
    let alpha = AlphaParameters::chung_hulbert(0.8);
    vec![
        (Scheme::Rk45(Rk45::new(1e-6, 1e-9)), baumgarte),
        (Scheme::Rk45(Rk45::new(1e-6, 1e-9)), Stabilization::BaumgarteFromStep),
        (Scheme::Dop853(Dop853::new(1e-8, 1e-11)), projection),
        (Scheme::Rk4(Rk4::new(1e-3)), projection),
        (Scheme::GeneralizedAlpha(GeneralizedAlpha::new(alpha, 1e-4, 1e-7)), projection),
        (Scheme::Radau(Radau::new(1e-6, 1e-9)), projection),
        (Scheme::Auto(Auto::default()), projection),
    ]
}

fn options(method: Scheme, stabilization: Stabilization) -> Options {
    Options { method, stabilization, ..Options::new(1.5) }
}

/// The state of a row.
fn state(run: &Run, row: usize, n: usize) -> State {
    let of = |table: &[f64]| table[row * n..(row + 1) * n].to_vec();
    let trajectory = &run.trajectory;
    let (q, v) = (of(&trajectory.q), of(&trajectory.v));
    State { t: trajectory.t[row], q, v, z: Vec::new() }
}

#[test]
fn a_driver_is_released_without_a_jump() {
    let ((released, _), (driven, start)) = (four_bar(), driven("t > 1"));
    let n = released.layout.n_q;
    for (scheme, stabilization) in all() {
        let options = options(scheme, stabilization);
        let name = format!("{:?} {:?}", options.method, options.stabilization);
        let run = run(&driven, &start, &options);
        assert!(run.reached && run.phases.len() == 2, "{name}");
        let row = run.phases[1];
        let (end, begin) = (state(&run, row - 1, n), state(&run, row, n));
        assert!(end.t == begin.t && (end.t - 1.0).abs() < 1e-14, "{name}: {}", end.t);
        assert!(worst(&end.q, &begin.q) < 1e-12 && worst(&end.v, &begin.v) < 1e-12, "{name}");
        let crank = begin.q[column(&released, "crank", 2)];
        assert!((crank - 70_f64.to_radians() - 1.0).abs() < 1e-5, "{name}: {crank}");
        // the motion afterwards is that of a run from there, unless Baumgarte's leaves the joints too open for a start
        let after = run.states_of(1);
        match dynamics(&released, &begin, &options, |_| Flow::Continue) {
            Ok(fresh) => assert_eq!((after.t, after.q, after.v), {
                let trajectory = &fresh.trajectory;
                (&trajectory.t[..], &trajectory.q[..], &trajectory.v[..])
            }),
            Err(failure) => {
                assert!(matches!(failure.reason, Reason::Start { .. }), "{}", failure.reason);
                assert!(!matches!(options.stabilization, Stabilization::Projection(_)), "{name}");
            }
        }
        // reactions follow the constraints of the phase
        let rows = |m: &Model, phase| {
            let found =
                Prepared::new(m).accelerations(run.states_of(phase), false, |_| Flow::Continue);
            found.expect("regular").lam.len() / run.states_of(phase).t.len()
        };
        assert_eq!((rows(&driven, 0), rows(&released, 1)), (9, 8), "{name}");
    }
}

#[test]
fn dense_output_and_a_grid_span_the_phases() {
    let (driven, start) = driven("t > 0.33");
    let options = Options { output_step: Some(0.1), ..Options::new(1.0) };
    let run = run(&driven, &start, &options);
    let times = [0.0, 0.1, 0.2, 0.3, 0.33, 0.33, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];
    assert!(worst(&run.trajectory.t, &times) < 1e-12, "{:?}", run.trajectory.t);
    assert_eq!(run.phases, [0, 5]);
    let dense = run.dense.expect("an option");
    assert!(dense.t.contains(&run.trajectory.t[4]) && dense.t.last() == Some(&1.0));
    assert_eq!(dense.c.len(), (dense.t.len() - 1) * driven.layout.n_y() * dense.degree);
}

/// At constant speed the crank has turned by half a radian after half a second.
#[test]
fn an_event_ends_a_phase() {
    let (driven, start) = driven("crank.angle > 70*deg + 0.5");
    for (scheme, stabilization) in all() {
        let options = options(scheme, stabilization);
        let run = run(&driven, &start, &options);
        let t = run.trajectory.t[run.phases[1]];
        assert!((t - 0.5).abs() < 1e-5, "{:?}: {t}", options.method);
        assert_eq!(run.trajectory.t.last(), Some(&1.5));
    }
}

#[test]
fn a_stepper_takes_the_steps_of_a_run() {
    let (m, start) = four_bar();
    for (scheme, stabilization) in all() {
        let options = options(scheme, stabilization);
        let run = dynamics(&m, &start, &options, |_| Flow::Continue).expect("a run");
        let mut stepper = Stepper::new(&m, &start, &options).expect("a start");
        let mut steps = 0;
        while !stepper.is_at_end() {
            stepper.step().expect("a step");
            steps += 1;
        }
        assert_eq!(steps, run.statistics.steps);
        let last = state(&run, run.trajectory.t.len() - 1, m.layout.n_q);
        assert_eq!(stepper.state(), last, "{:?}", options.method);
        assert_eq!(stepper.works(), run.trajectory.works.rchunks(3).next().expect("a row"));
    }
}

/// The crank is sent back where it has turned by an angle: two states at one time.
#[test]
fn a_stepper_locates_and_restarts_by_every_method() {
    let (m, start) = four_bar();
    let (n, crank) = (m.layout.n_q, column(&m, "crank", 2));
    for (scheme, stabilization) in all() {
        let mut stepper = Stepper::new(&m, &start, &options(scheme, stabilization)).expect("start");
        let turned = |q: &[f64]| (q[crank] - start.q[crank]).abs();
        let event = loop {
            assert!(!stepper.is_at_end(), "no event");
            stepper.step().expect("a step");
            let g = |_: f64, [q, _, _]: [&[f64]; 3]| turned(q) - 0.01;
            if let Some(event) = stepper.locate(g, Direction::Rising).expect("an interpolant") {
                break event;
            }
        };
        assert!((turned(&event.q) - 0.01).abs() < 1e-9);
        let inside = stepper.interpolate(event.t).expect("one").expect("within the step");
        assert_eq!(inside, event);
        let back = State { v: event.v.iter().map(|v| -v).collect(), ..event.clone() };
        stepper.restart(&back).expect("a state");
        let state = stepper.state();
        assert_eq!((state.t, state.q.len()), (event.t, n));
        let off = worst(&state.v, &back.v) / largest(&back.v);
        // the interpolant is as good as the tolerance: the state is projected
        assert!(off < 2e-2, "{off:.1e}");
        stepper.step().expect("a step");
        assert!(turned(&stepper.state().q) < 0.01);
    }
}
