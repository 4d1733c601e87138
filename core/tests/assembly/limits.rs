//! Results that no run and no assembly may give, with extreme numbers; found by random runs.

use crate::mechanisms::{close, four_bar, largest, model, rate, start, PENDULUM};
use kempe::analyses::dynamics::{dynamics, most_steps, Failure, Options, Reason, Scheme};
use kempe::analyses::State;
use kempe::integrate::{Flow, Rk4, Rk45, StepControl};
use kempe::model::Model;

fn failed(m: &Model, state: &State, options: &Options) -> Box<Failure> {
    dynamics(m, state, options, |_| Flow::Continue).expect_err("must not succeed")
}

/// Positions and rates are finite numbers still, their squares are not.
#[test]
fn a_kinetic_energy_that_is_no_number_is_no_success() {
    let m = model(&PENDULUM.replace("gravity = [0, -9.81]", ""));
    let (mut state, _) = start(&m, &[("rod.angle", "0")], &[]);
    state.v = vec![0.0, 5e154, 1e155];
    let scheme = Scheme::Rk4(Rk4::new(1e-200));
    for dense_output in [false, true] {
        let options =
            Options { method: scheme.clone(), dense_output, ..Options::classical(3e-200) };
        let found = dynamics(&m, &state, &options, |_| Flow::Continue);
        let energies = found.and_then(|run| run.energies(&m));
        let told = energies.unwrap_err().to_string();
        assert!(told.contains("infinite or undefined"), "{told}");
    }
}

/// The rows before are kept; the later rows do not matter.
#[test]
fn a_partial_solution_is_finite() {
    let m = model(
        "[bodies.ground]\n[bodies.ball]\nmass = 1\ninertia = 1\n[forces.push]\ntype = \"torque\"\n\
         j = \"ball\"\ntorque = \"ball.angle^3\"\n",
    );
    let (state, _) = start(&m, &[("ball.angle", "1")], &[]);
    let scheme = Scheme::Rk4(Rk4::new(0.25));
    let failure = failed(&m, &state, &Options { method: scheme, ..Options::classical(100.0) });
    assert!(matches!(failure.reason, Reason::Integration { .. }), "{:?}", failure.reason);
    let run = &failure.run;
    assert!(run.trajectory.t.len() > 3);
    for table in [&run.trajectory.q, &run.accelerations(&m).unwrap().a, &run.energies(&m).unwrap()]
    {
        assert!(table.iter().all(|x| x.is_finite()), "{table:?}");
    }
    assert!(run.dense.as_ref().unwrap().c.iter().all(|x| x.is_finite()));
}

/// A driver's rate goes through a light body without inertia to one a million times as heavy.
#[test]
fn rates_are_found_whatever_the_masses_are() {
    let m = model(
        r#"
[bodies.ground]
points = { O = [0, 0] }
[bodies.light]
mass = 0.1
inertia = 0
points = { P = [-0.5, 0], Q = [0.5, 0] }
[bodies.heavy]
mass = 1e6
inertia = 0
points = { P = [-0.3, 0], Q = [0.7, 0] }
[joints.J0]
type = "revolute"
i = "ground.O"
j = "light.P"
[joints.J1]
type = "revolute"
i = "light.Q"
j = "heavy.P"
[drivers.motor]
type = "coordinate_driver"
coordinate = "light.angle"
value = "0.3 + 2*t"
"#,
    );
    let (state, _) = start(&m, &[("heavy.angle", "0.3"), ("heavy.omega", "0.06")], &[]);
    close("light.omega", state.v[2], 2.0, 1e-9);
    close("heavy.omega", state.v[5], 0.06, 1e-9);
    assert!(largest(&rate(&m, &state)) < 1e-9, "{:?}", rate(&m, &state));
}

#[test]
fn a_run_without_end_ends() {
    let (m, state) = four_bar();
    assert_eq!(most_steps(&m), 333_333);
    let scheme =
        Scheme::Rk45(Rk45 { control: StepControl { max_step: 1e-12, ..StepControl::default() } });
    let failure = failed(&m, &state, &Options { method: scheme, ..Options::classical(1.0) });
    let Reason::Integration { t, message, hint } = failure.reason else { panic!("integration") };
    assert_eq!((t, failure.run.trajectory.t.len()), (0.0, 1));
    assert!(message.contains("more than max_steps = 333333"), "{message}");
    assert!(hint.contains("larger steps"), "{hint}");

    let options = Options { output_step: Some(1e-12), ..Options::classical(1.0) };
    let Reason::Option { name, .. } = failed(&m, &state, &options).reason else { panic!("option") };
    assert_eq!(name, "output_step");
}
