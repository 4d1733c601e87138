//! The states from which a run may start: their joints are closed to 1e-9 of the size of the mechanism.

use crate::mechanisms::{
    close, four_bar, largest, model, rate, residual, start, with, DOUBLE_PENDULUM, FOUR_BAR,
    PENDULUM, SLIDER_CRANK,
};
use kempe::analyses::assemble::{assemble, Request};
use kempe::analyses::dynamics::{
    dynamics, Change, Options, Prepared, Reason, Scheme, Stabilization, Stepper,
};
use kempe::analyses::{EventOption, State};
use kempe::equations::Gains;
use kempe::integrate::{Flow, Rk45};
use kempe::model::Model;
use kempe::stabilize::Projection;

/// Every stabilization.
fn all() -> [Stabilization; 4] {
    [
        Stabilization::None,
        Stabilization::Baumgarte(Gains { alpha: 10.0, beta: 200.0 }),
        Stabilization::BaumgarteFromStep,
        Stabilization::Projection(Projection::default()),
    ]
}

fn options(stabilization: Stabilization) -> Options {
    Options { method: Scheme::Rk45(Rk45::new(1e-6, 1e-9)), stabilization, ..Options::new(0.01) }
}

/// The refusal of a start: joint, message and remedy.
fn refused(m: &Model, state: &State, stabilization: Stabilization) -> [String; 3] {
    let failure = dynamics(m, state, &options(stabilization), |_| Flow::Continue).unwrap_err();
    assert!(failure.run.trajectory.t.is_empty());
    let Reason::Start { t, name, message, hint } = failure.reason else { panic!("{failure:?}") };
    assert_eq!(t, state.t);
    [name, message, hint.to_string()]
}

fn accepted(m: &Model, state: &State, stabilization: Stabilization) {
    let outcome = dynamics(m, state, &options(stabilization), |_| Flow::Continue);
    let run = outcome.unwrap_or_else(|failure| panic!("{}", failure.reason));
    assert_eq!(run.trajectory.q[..state.q.len()], state.q, "it is not moved");
    assert_eq!(run.trajectory.v[..state.v.len()], state.v, "it is not moved");
}

#[test]
fn assembled_states_are_accepted_and_not_moved() {
    let speed = [("crank.angle", "0.3"), ("crank.omega", "40")];
    let cases = [
        four_bar(),
        (model(SLIDER_CRANK), start(&model(SLIDER_CRANK), &speed, &[]).0),
        (model(DOUBLE_PENDULUM), start(&model(DOUBLE_PENDULUM), &[("lower.omega", "3")], &[]).0),
        (
            model(PENDULUM),
            start(&model(PENDULUM), &[("rod.angle", "1e5"), ("rod.omega", "9")], &[]).0,
        ),
    ];
    for (m, state) in cases {
        all().into_iter().for_each(|stabilization| accepted(&m, &state, stabilization));
    }
}

/// The coupler of the flagship grows by 1 m about its centre: it leaves B and C by 0.5 m.
#[test]
fn a_state_of_other_lengths_is_refused_with_the_gap() {
    let (_, state) = four_bar();
    let longer = with(FOUR_BAR, &[("L2", 27.0)]);
    for stabilization in all() {
        let [name, message, hint] = refused(&longer, &state, stabilization);
        assert!(name == "B" || name == "C", "{name}");
        let gap = format!("joint {name} is open by 5.000e-1 m; at most 2.0e-8 m is accepted");
        assert!(message.contains(&gap), "{message}");
        assert!(hint.contains("kp.assemble(model, from_state=state)"), "{hint}");
    }
    // the remedy
    let request = Request { state: Some(state), ..Request::default() };
    let (closed, _) = assemble(&longer, &request).unwrap();
    all().into_iter().for_each(|stabilization| accepted(&longer, &closed, stabilization));
    // other numbers that do not open a joint
    let (_, state) = four_bar();
    let softer = with(FOUR_BAR, &[("k", 5e5)]);
    all().into_iter().for_each(|stabilization| accepted(&softer, &state, stabilization));
}

/// The rod of the pendulum reaches 0.5 m from its frame, which is the size of the mechanism.
#[test]
fn the_limits_are_1e_9_of_the_size_and_of_the_pace() {
    let m = model(PENDULUM);
    for omega in [0.0, 0.2, 50.0] {
        let rates = [("rod.angle", "0.3"), ("rod.omega", &omega.to_string())];
        let (state, _) = start(&m, &rates, &[]);
        let pace = f64::max(omega, 1.0);
        for (part, holds) in [(0.9e-9, true), (1.1e-9, false)] {
            let (mut open, mut opens) = (state.clone(), state.clone());
            open.q[1] += 0.5 * part;
            opens.v[0] += 0.5 * part * pace;
            for stabilization in all() {
                for moved in [&open, &opens] {
                    let run = dynamics(&m, moved, &options(stabilization), |_| Flow::Continue);
                    assert_eq!(run.is_ok(), holds, "{omega} {part} {stabilization:?}");
                }
            }
        }
    }
}

#[test]
fn rates_that_open_a_joint_are_refused() {
    let (m, mut state) = four_bar();
    state.v[3] = 0.25; // the coupler alone moves to the right: at B and at C
    for stabilization in all() {
        let [name, message, _] = refused(&m, &state, stabilization);
        assert!(name == "B" || name == "C", "{name}");
        let rate = format!("joint {name} opens at 2.500e-1 m/s; at most 2.0e-8 m/s is accepted");
        assert!(message.contains(&rate), "{message}");
    }
    state.q[0] = f64::NAN;
    let [name, ..] = refused(&m, &state, all()[0]);
    assert!(name == "A" || name == "B", "{name}");
}

/// The angle 0.3 sin 5 t - π/2 of the driver at t = 0.1, with a state of t = 0.
#[test]
fn a_driver_holds_at_the_time_of_the_start() {
    let m = model(DOUBLE_PENDULUM);
    let (mut state, _) = start(&m, &[], &[]);
    state.t = 0.1;
    let [name, message, _] = refused(&m, &state, all()[3]);
    assert_eq!(name, "motor");
    let off = format!("driver motor is open by {:.3e} rad", 0.3 * 0.5_f64.sin());
    assert!(message.contains(&off), "{message}");
    state.t = 0.0;
    let later = Options { t_start: Some(0.1), ..options(all()[3]) };
    assert!(dynamics(&m, &state, &later, |_| Flow::Continue).is_err());
}

#[test]
fn steppers_and_changes_refuse_open_joints() {
    let (m, state) = four_bar();
    let longer = with(FOUR_BAR, &[("L2", 27.0)]);
    let is_start = |reason: &Reason| matches!(reason, Reason::Start { .. });
    for stabilization in all() {
        let options = options(stabilization);
        let begun = Stepper::new(&longer, &state, &options).map(|_| ());
        assert!(begun.is_err_and(|failure| is_start(&failure.reason)));
        let mut stepper = Stepper::new(&m, &state, &options).unwrap();
        stepper.step().unwrap();
        let mut open = stepper.state();
        open.q[0] += 30.0; // farther than the mechanism is large
        assert!(is_start(&stepper.restart(&open).unwrap_err().reason));
        // the event gives the coupler a length that does not fit by more than a hundredth of the size
        let events = vec![EventOption { acts: true, ..EventOption::new("change", "t > 0.005") }];
        let options = Options { events, ..options };
        let parameters = vec![("L2".to_string(), 27.0)];
        let mut act = |_: &str, _: &State, _: &_| {
            Some(Change { parameters: parameters.clone(), ..Change::default() })
        };
        let run = Prepared::new(&m).dynamics_with(&state, &options, |_| Flow::Continue, &mut act);
        match stabilization {
            Stabilization::None => assert!(run.is_ok(), "drift of the size is documented"),
            _ => assert!(is_start(&run.unwrap_err().reason), "{stabilization:?}"),
        }
    }
}

/// A state that drifted is assembled anew at the nearest place, found here by a search over the crank angle.
#[test]
fn assembly_from_a_state_keeps_near_it() {
    let (m, mut state) = four_bar();
    for (k, q) in state.q.iter_mut().enumerate() {
        *q += 1e-3 * (1.0 + 3.0 * k as f64).sin();
    }
    state.v.iter_mut().enumerate().for_each(|(k, v)| *v = (2.0 + k as f64).cos());
    state.t = 2.5;
    // lengths over the size of 20 m, angles in rad
    let apart = |q: &[f64]| {
        let scaled = q.iter().zip(&state.q).enumerate();
        let scaled = scaled.map(|(k, (a, b))| (a - b) / if k % 3 == 2 { 1.0 } else { 20.0 });
        scaled.map(|x| x * x).sum::<f64>().sqrt()
    };
    let request = Request { t: state.t, state: Some(state.clone()), ..Request::default() };
    let (found, _) = assemble(&m, &request).unwrap();
    assert!(largest(&residual(&m, &found)) < 1e-10 && largest(&rate(&m, &found)) < 1e-10);
    assert_eq!(found.t, 2.5);
    let nearest = (-300..=300).map(|k| {
        let angle = format!("{}", state.q[2] + 1e-5 * f64::from(k));
        let guess = [("coupler.angle", "14*deg"), ("rocker.angle", "240*deg")];
        apart(&start(&m, &[("crank.angle", &angle)], &guess).0.q)
    });
    let nearest = nearest.fold(f64::INFINITY, f64::min);
    close("distance", apart(&found.q), nearest, 1e-3 * nearest);
    let found = State { t: 0.0, ..found };
    all().into_iter().for_each(|stabilization| accepted(&m, &found, stabilization));
}
