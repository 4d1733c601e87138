//! Bodies without moment of inertia, and with hardly any: the point pendulum of LIM's benchmark A01.

use crate::mechanisms::{close, every, model, pinned, run, start, tolerances, GRAVITY};
use crate::{number, reference};
use kempe::analyses::dynamics::{dynamics, Options, Run, Scheme};
use kempe::equations::{Gains, Workspace};
use kempe::integrate::{Dop853, Flow};
use kempe::model::Model;

/// A point mass at the tip of a massless rod, as one body.
fn on_its_rod(inertia: &str) -> Model {
    let fields = format!("mass = 1\ninertia = {inertia}\npoints = {{ O = [1, 0] }}");
    model(&format!("{GRAVITY}{}", pinned("bob", &fields)))
}

/// The same with a rod that is no body.
const AT_A_DISTANCE: &str = r#"
gravity = [0, -9.81]
[bodies.ground]
points = { O = [0, 0] }
[bodies.bob]
mass = 1
inertia = 0
points = { P = [0, 0] }
[joints.rod]
type = "distance"
i = "ground.O"
j = "bob.P"
length = 1
"#;

fn released(m: &Model, options: &Options) -> Run {
    let given = [("bob.y", "0"), ("bob.angle", "0")];
    let hung = m.constraints[0].element.constant_columns();
    let (state, _) = start(m, &given[usize::from(hung)..], &[("bob.x", "-1")]);
    assert_eq!(state.q, [-1.0, 0.0, 0.0]);
    run(m, &state, options)
}

fn strict(t_end: f64) -> Options {
    Options { method: Scheme::Dop853(Dop853::new(1e-12, 1e-14)), ..Options::classical(t_end) }
}

#[test]
fn the_point_pendulum() {
    let truth = reference("pendulum");
    let models = [on_its_rod("0"), on_its_rod("1e-13"), model(AT_A_DISTANCE)];
    let options = every(10.0, strict(20.0));
    for m in &models {
        let run = released(m, &options);
        assert_eq!(run.trajectory.t, [0.0, 10.0, 20.0]);
        for (t, q) in ["10", "20"].into_iter().zip(run.trajectory.q.chunks(3).skip(1)) {
            let point = &truth["point"][t];
            close("x", q[0], number(&point["x"]), 1e-8);
            close("y", q[1], number(&point["y"]), 1e-8);
        }
    }
}

/// α = g cos φ / (1 + J) for m = L = 1, and the reaction g sin φ + φ̇² along the rod, to the last digits.
#[test]
fn accelerations_and_reactions_are_exact() {
    for inertia in ["0", "1e-13"] {
        let m = on_its_rod(inertia);
        let turning = 1.0 + m.bodies[1].inertia;
        let mut workspace = Workspace::new(&m);
        for angle in [0.0_f64, 0.4, 1.3, 2.9, -0.8] {
            let (sin, cos, omega) = (angle.sin(), angle.cos(), 1.7);
            let (q, v) = ([-cos, -sin, angle], [sin * omega, -cos * omega, omega]);
            workspace.accelerate(&m, 0.0, [&q, &v, &[]], Gains::default()).unwrap();
            close("α", workspace.a()[2], 9.81 * cos / turning, 5e-15 * 9.81);
            let pull = 9.81 * sin + omega * omega;
            let lam = workspace.lam();
            close("λ along", -(lam[0] * cos + lam[1] * sin), pull, 1e-13);
            close("λ across", lam[0] * sin - lam[1] * cos, 0.0, 2e-12);
        }
    }
}

#[test]
fn an_angle_that_nothing_turns_stays() {
    let m = model(AT_A_DISTANCE);
    let run = released(&m, &strict(3.0));
    assert!(run.trajectory.q.chunks(3).all(|q| q[2] == 0.0));
    assert!(run.accelerations(&m).unwrap().a.chunks(3).all(|a| a[2] == 0.0));
}

#[test]
fn a_torque_on_an_angle_that_nothing_resists_is_refused() {
    let motor = "[forces.motor]\ntype = \"torque\"\nj = \"bob\"\ntorque = 1\n";
    let m = model(&format!("{AT_A_DISTANCE}{motor}"));
    let (state, _) = start(&m, &[("bob.y", "0"), ("bob.angle", "0")], &[("bob.x", "-1")]);
    let failure =
        dynamics(&m, &state, &tolerances(1.0, 1e-6, 1e-9), |_| Flow::Continue).unwrap_err();
    let told = failure.reason.to_string();
    assert!(
        told.contains("a torque acts on bob") && told.contains("no moment of inertia"),
        "{told}"
    );
}
