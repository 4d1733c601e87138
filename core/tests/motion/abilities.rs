//! Abilities that elements may have, in motion and by every method: first-order states, forces that depend on
//! reactions, internal coordinates, more than two bodies. The elements are those of `tests/elements`; the motions are
//! compared with scalar equations that are integrated here.

use crate::mechanisms::methods::{ends, integrated, last};
use crate::mechanisms::{close, column, model, pinned, request, run, start, worst, GRAVITY};
use kempe::analyses::assemble::{assemble, Request};
use kempe::analyses::dynamics::{dynamics, Auto, Options, Scheme};
use kempe::analyses::State;
use kempe::equations::reactions::{reaction, Frame};
use kempe::equations::{Gains, Workspace};
use kempe::integrate::{Dop853, Flow};
use kempe::model::Model;

const G: f64 = 9.81;

const LAGGING: &str = r#"
gravity = [0, 0]
[bodies.cart]
type = "point_mass"
mass = 2
[forces.spring]
type = "lag"
i = "ground"
j = "cart"
stiffness = 30
time = 0.2
"#;

#[test]
fn a_first_order_state_follows_the_motion() {
    let m = model(LAGGING);
    let set =
        [("cart.x", "0.1"), ("cart.y", "0"), ("cart.vx", "0.3"), ("spring.filtered", "-0.04")];
    let (state, _) = start(&m, &set, &[]);
    assert_eq!((state.q.len(), &state.z), (2, &vec![-0.04]));
    let truth = integrated([0.1, 0.3, -0.04], 1.0, |[x, v, z]| [v, -15.0 * z, (x - z) / 0.2]);
    ends(&m, &state, 1.0, |name, run, accuracy| {
        let t = &run.trajectory;
        let end = [last(&t.q, 2)[0], last(&t.v, 2)[0], last(&t.z, 1)[0]];
        assert!(worst(&end, &truth) < accuracy, "{name}: {end:?} {truth:?}");
        // between the steps z follows the interpolant
        let dense = run.dense.as_ref().expect("kept");
        let rows = dense.y.len() / m.layout.n_y();
        assert_eq!((m.layout.n_y(), rows + 1), (2 + 2 + 1 + 3, dense.t.len()), "{name}");
    });
}

#[test]
fn the_energies_balance_with_a_first_order_state() {
    let m = model(LAGGING);
    let (state, _) = start(&m, &[("cart.x", "0.1"), ("cart.y", "0")], &[]);
    let run = run(&m, &state, &Options::new(1.0));
    let energies = run.energies(&m).unwrap();
    let [kinetic, .., applied] = last(&energies, 5) else { panic!("five columns") };
    close("work of the spring", *applied, *kinetic, 1e-9);
}

#[test]
fn a_first_order_state_that_is_missing_is_refused() {
    let m = model(LAGGING);
    let (state, _) = start(&m, &[("cart.x", "0.1"), ("cart.y", "0")], &[]);
    let state = State { z: Vec::new(), ..state };
    let failure = dynamics(&m, &state, &Options::new(1.0), |_| Flow::Continue).unwrap_err();
    assert!(failure.reason.to_string().contains('z'), "{}", failure.reason);
}

#[test]
fn a_stiff_state_is_left_to_an_implicit_method() {
    let m = model(&LAGGING.replace("time = 0.2", "time = 1e-6"));
    let set = [("cart.x", "0.1"), ("cart.y", "0"), ("spring.filtered", "0.1")];
    let (state, _) = start(&m, &set, &[]);
    let options = Options { method: Scheme::Auto(Auto::default()), ..Options::new(1.0) };
    let run = run(&m, &state, &options);
    assert_eq!(run.choice.as_ref().map(|choice| choice.method), Some("radau"), "{:?}", run.choice);
    // with a fast filter it is a spring with slightly negative damping, k τ
    close("x", last(&run.trajectory.q, 2)[0], 0.1 * 15f64.sqrt().cos(), 1e-5);
}

/// A point mass of 1.5 kg, 0.4 m from its pin, with friction in the pin.
fn rubbing(arm: f64) -> Model {
    let bob = pinned("bob", "mass = 1.5\ninertia = 0.02\npoints = { O = [-0.4, 0] }");
    model(&format!(
        "{GRAVITY}{bob}[forces.friction]\ntype = 'rubbing'\njoint = 'pin'\ni = 'ground'\nj = 'bob'\narm = {arm}\nspeed = 0.4\n"
    ))
}

/// φ̈ and the force in the pin: J φ̈ = -m g l cos φ - μ r F tanh(ω/ω₀), where F depends on φ̈.
fn rubbed([phi, omega]: [f64; 2], arm: f64) -> (f64, f64) {
    let (mass, length, inertia) = (1.5, 0.4, 0.02 + 1.5 * 0.16);
    let (s, c) = phi.sin_cos();
    let mut alpha = 0.0;
    let mut load = 0.0;
    for _ in 0..200 {
        let (ax, ay) =
            (-length * (s * alpha + c * omega * omega), length * (c * alpha - s * omega * omega));
        load = mass * ax.hypot(ay + G);
        let torque = -mass * G * length * c - arm * load * (omega / 0.4f64).tanh();
        let before = std::mem::replace(&mut alpha, torque / inertia);
        if alpha == before {
            break;
        }
    }
    (alpha, load)
}

#[test]
fn friction_depends_on_the_reaction() {
    let arm = 0.05;
    let m = rubbing(arm);
    let (state, _) = start(&m, &[("bob.angle", "0.5"), ("bob.omega", "2")], &[]);
    let [phi, omega] = integrated([0.5, 2.0], 1.5, |y| [y[1], rubbed(y, arm).0]);
    let free = integrated([0.5, 2.0], 1.5, |y| [y[1], rubbed(y, 0.0).0]);
    assert!((phi - free[0]).abs() > 0.1, "friction matters");
    let (alpha, load) = rubbed([phi, omega], arm);
    ends(&m, &state, 1.5, |name, run, accuracy| {
        let (q, v) = (last(&run.trajectory.q, 3), last(&run.trajectory.v, 3));
        assert!(worst(&[q[2], v[2]], &[phi, omega]) < 10.0 * accuracy, "{name}: {q:?} {phi}");
        let found = run.accelerations(&m).unwrap();
        let (a, lam) = (last(&found.a, 3)[2], last(&found.lam, 2));
        let errors = [a - alpha, lam[0].hypot(lam[1]) - load];
        assert!(worst(&errors, &[0.0; 2]) < 300.0 * accuracy, "{name}: {errors:?}");
        let energies = run.energies(&m).unwrap();
        let sum = |row: &[f64]| row[0] + row[1] + row[2];
        let lost = last(&energies, 5)[2];
        assert!(lost > 0.5, "{name}: {lost}");
        close(name, sum(last(&energies, 5)), sum(&energies[..5]), 30.0 * accuracy);
    });
}

#[test]
fn friction_that_no_reaction_agrees_with_is_refused() {
    // μ r above the length: the torque of friction outgrows that of any force in the pin
    let m = rubbing(2.0);
    let (state, _) = start(&m, &[("bob.angle", "0.5"), ("bob.omega", "2")], &[]);
    let mut workspace = Workspace::new(&m);
    let outcome = workspace.accelerate(&m, 0.0, [&state.q, &state.v, &[]], Gains::default());
    let Err(_) = outcome else { panic!("{:?} {:?}", workspace.a(), workspace.lam()) };
    let failure = dynamics(&m, &state, &Options::new(1.0), |_| Flow::Continue).unwrap_err();
    let message = failure.reason.to_string();
    assert!(message.contains("pin") && message.contains("friction"), "{message}");
}

#[test]
fn a_bead_on_a_parabola() {
    let bend = 1.5;
    let m = model(
        r#"
gravity = [0, -9.81]
[bodies.bead]
type = "point_mass"
mass = 0.7
[joints.wire]
type = "bead"
i = "bead.P"
j = "ground"
bend = 1.5
"#,
    );
    let set = [("bead.x", "0.4"), ("bead.vx", "0")];
    let (state, report) = start(&m, &set, &[("bead.y", "0.24")]);
    assert_eq!((m.layout.n_q, m.layout.n_rows, report.degrees_of_freedom), (3, 2, 1));
    assert!(worst(&state.q, &[0.4, bend * 0.16, 0.4]) < 1e-10, "{:?}", state.q);
    let [u, rate] = integrated([0.4, 0.0], 1.0, |[u, v]| {
        let slope = 2.0 * bend * u;
        [v, -(slope * 2.0 * bend * v * v + G * slope) / (1.0 + slope * slope)]
    });
    ends(&m, &state, 1.0, |name, run, accuracy| {
        let (q, v) = (last(&run.trajectory.q, 3), last(&run.trajectory.v, 3));
        let truth = [u, bend * u * u, u, rate, 2.0 * bend * u * rate, rate];
        let error = worst(&[q, v].concat(), &truth);
        assert!(error < 20.0 * accuracy, "{name}: {error:.1e}");
    });
}

#[test]
fn one_equation_between_three_bodies() {
    // wheels with angles a, b and c, and (1 + n) c = n a + b
    let (ratio, inertias, torque) = (2.0, [0.3, 0.2, 0.5], 1.2);
    let wheel = |name: &str, inertia: f64| {
        format!(
            "[bodies.{name}]\nmass = 1\ninertia = {inertia}\npoints = {{ O = [0, 0] }}\n\
             [joints.pin_{name}]\ntype = 'revolute'\ni = 'ground.O'\nj = '{name}.O'\n"
        )
    };
    let wheels: String =
        ["a", "b", "c"].into_iter().zip(inertias).map(|(n, j)| wheel(n, j)).collect();
    let m = model(&format!(
        "[bodies.ground]\npoints = {{ O = [0, 0] }}\n{wheels}[joints.gears]\ntype = 'pulley'\ni = 'a'\n\
         j = 'b'\nk = 'c'\nratio = {ratio}\n[forces.drive]\ntype = 'torque'\nj = 'a'\ntorque = {torque}\n"
    ));
    let (state, _) = assemble(&m, &Request::default()).unwrap();
    // J_k φ̈_k = T_k - w_k λ with the weights w = (-n, -1, 1 + n) of the equation, and Σ w_k φ̈_k = 0
    let weights = [-ratio, -1.0, 1.0 + ratio];
    let compliance: f64 = weights.iter().zip(inertias).map(|(w, j)| w * w / j).sum();
    let lam = weights[0] * torque / inertias[0] / compliance;
    let alpha: Vec<f64> = (0..3)
        .map(|k| (if k == 0 { torque } else { 0.0 } - weights[k] * lam) / inertias[k])
        .collect();
    ends(&m, &state, 1.0, |name, run, accuracy| {
        let angles = ["a", "b", "c"].map(|b| last(&run.trajectory.q, 9)[column(&m, b, 2)]);
        let truth: Vec<f64> = alpha.iter().map(|alpha| alpha / 2.0).collect();
        assert!(worst(&angles, &truth) < 10.0 * accuracy, "{name}: {angles:?} {truth:?}");
        let found = run.accelerations(&m).unwrap();
        close(name, last(&found.lam, 7)[6], lam, 1e-9);
    });
}

const PENDULUM: &str = r#"
gravity = [0, -9.81]
[bodies.ground]
points = { O = [0.1, 0.2] }
[bodies.upper]
mass = 1
inertia = 0.1
points = { O = [-0.5, 0], A = [0.5, 0.1] }
[bodies.lower]
mass = 2
inertia = 0.2
points = { A = [-0.4, 0] }
[joints.pin]
type = "revolute"
i = "ground.O"
j = "upper.O"
[joints.knee]
type = "KNEE"
i = "upper.A"
j = "lower.A"
"#;

#[test]
fn reactions_do_not_depend_on_how_a_pin_is_written() {
    let models = ["revolute", "turned_pin"].map(|kind| model(&PENDULUM.replace("KNEE", kind)));
    let set = [("upper.angle", "0.3"), ("lower.angle", "-0.4"), ("upper.omega", "1.5")];
    let runs = models.each_ref().map(|m| {
        let (state, _) = assemble(m, &request(m, &set, &[])).unwrap();
        let options = Options {
            method: Scheme::Dop853(Dop853::new(1e-12, 1e-13)),
            output_step: Some(0.1),
            ..Options::new(1.0)
        };
        run(m, &state, &options)
    });
    let [plain, turned] = &runs;
    assert!(worst(&plain.trajectory.q, &turned.trajectory.q) < 1e-9);
    let found = [plain, turned].map(|run| run.trajectory.t.len());
    assert_eq!(found, [11, 11]);
    let multipliers = [0, 1].map(|k| runs[k].accelerations(&models[k]).unwrap().lam);
    assert!(worst(&multipliers[0], &multipliers[1]) > 0.1, "the multipliers differ");
    for (row, t) in plain.trajectory.t.iter().enumerate() {
        for body in [1, 2] {
            let forces = [0, 1].map(|k| {
                let (m, run) = (&models[k], &runs[k]);
                let q = &run.trajectory.q[6 * row..6 * row + 6];
                let motions = kempe::equations::kinematics::Motions::at_rest(&m.layout, q);
                let lam = &multipliers[k][4 * row + 2..4 * row + 4];
                let body = kempe::elements::BodyId(body);
                let w = reaction(m, 1, body, Frame::Global, &motions, *t, lam).expect("joined");
                [w.force.x, w.force.y, w.torque]
            });
            assert!(worst(&forces[0], &forces[1]) < 1e-7, "t = {t}: {forces:?}");
        }
    }
}
