//! Mechanisms without joints, without bodies, without freedom.

use crate::mechanisms::{close, every, model, residual, run, start, tolerances};
use kempe::analyses::mobility;

#[test]
fn a_free_body_falls() {
    let m = model(
        "gravity = [1, -9.81]\n[bodies.stone]\nmass = 2\ninertia = 0.5\ncenter = [0.3, -0.1]\n",
    );
    let ask = [("stone.x", "1"), ("stone.y", "2"), ("stone.angle", "0.4"), ("stone.omega", "3")];
    let (state, report) = start(&m, &ask, &[]);
    assert_eq!(report.degrees_of_freedom, 3);
    assert_eq!(state.v[2], 3.0);
    let run = run(&m, &state, &every(0.25, tolerances(1.0, 1e-10, 1e-12)));
    assert_eq!(run.trajectory.t.len(), 5);
    assert!(run.accelerations(&m).unwrap().lam.is_empty());
    let centre = |k: usize| {
        let q = &run.trajectory.q[3 * k..];
        kempe::math::Pose::new(q[0], q[1], q[2]).point(m.bodies[1].center)
    };
    close("angle", run.trajectory.q[14], 3.4, 1e-9);
    // with the frame's origin at rest the centre starts at ω ⊥ arm
    let arm = centre(0) - kempe::math::Vec2::new(1.0, 2.0);
    close("x", centre(4).x, centre(0).x - 3.0 * arm.y + 0.5, 1e-8);
    close("y", centre(4).y, centre(0).y + 3.0 * arm.x - 4.905, 1e-8);
}

#[test]
fn nothing_moves_in_a_model_without_bodies() {
    let m = model("[bodies.ground]\npoints = { O = [0, 0] }\n");
    let (state, report) = start(&m, &[], &[]);
    assert!(state.q.is_empty() && report.degrees_of_freedom == 0);
    let run = run(&m, &state, &every(0.5, tolerances(1.0, 1e-6, 1e-9)));
    assert_eq!(run.trajectory.t, [0.0, 0.5, 1.0]);
    assert_eq!(run.energies(&m).unwrap(), [0.0; 15]);
}

/// Two bars and ground: a truss.
const TRUSS: &str = r#"
gravity = [0, -10]
[bodies.ground]
points = { P = [0, 0], Q = [2, 0] }
[bodies.left]
type = "bar"
mass = 1
length = "sqrt(2)"
ends = ["P", "T"]
[bodies.right]
type = "bar"
mass = 1
length = "sqrt(2)"
ends = ["Q", "T"]
[joints.P]
type = "revolute"
i = "ground.P"
j = "left.P"
[joints.Q]
type = "revolute"
i = "ground.Q"
j = "right.Q"
[joints.T]
type = "revolute"
i = "left.T"
j = "right.T"
"#;

#[test]
fn a_truss_stands_and_has_reactions() {
    let m = model(TRUSS);
    let (state, report) = start(&m, &[], &[("left.angle", "pi/4"), ("right.angle", "3*pi/4")]);
    assert_eq!(report.degrees_of_freedom, 0);
    assert!(crate::mechanisms::largest(&residual(&m, &state)) < 1e-12);
    let run = run(&m, &state, &every(0.1, tolerances(0.5, 1e-8, 1e-10)));
    let last = run.trajectory.t.len() - 1;
    let lam = &run.accelerations(&m).unwrap().lam[6 * last..];
    // each bar's weight half on its foot; the feet push the crown up against 10 N, at 45°: the force
    // on ground is λ
    close("foot", lam[1], -10.0, 1e-9);
    close("thrust", lam[0], -5.0, 1e-9);
    close("thrust", lam[2], 5.0, 1e-9);
    close("crown", lam[5], 0.0, 1e-9);
    close("crown", run.trajectory.q[6 * last + 2], std::f64::consts::FRAC_PI_4, 1e-9);
}

#[test]
fn a_driven_mechanism_without_freedom_follows_its_law() {
    let m = model(
        r#"
[bodies.crank]
mass = 1
inertia = 2
[drivers.x]
type = "coordinate_driver"
coordinate = "crank.x"
value = "1 + sin(2*t)"
[drivers.y]
type = "coordinate_driver"
coordinate = "crank.y"
value = "t^3"
[drivers.angle]
type = "coordinate_driver"
coordinate = "crank.angle"
value = "crank.x*crank.y + 0.5*t"
"#,
    );
    let request = kempe::analyses::assemble::Request { t: 0.4, ..Default::default() };
    let (state, report) = kempe::analyses::assemble::assemble(&m, &request).unwrap();
    assert_eq!(report.degrees_of_freedom, 0);
    let t = 0.4_f64;
    let (x, dx, ddx) = (1.0 + (2.0 * t).sin(), 2.0 * (2.0 * t).cos(), -4.0 * (2.0 * t).sin());
    let (y, dy, ddy) = (t.powi(3), 3.0 * t * t, 6.0 * t);
    let run = run(&m, &state, &tolerances(0.4, 1e-6, 1e-9));
    close("x", state.q[0], x, 1e-14);
    close("vx", state.v[0], dx, 1e-13);
    close("ax", run.accelerations(&m).unwrap().a[0], ddx, 1e-12);
    close("angle", state.q[2], x * y + 0.5 * t, 1e-14);
    close("omega", state.v[2], dx * y + x * dy + 0.5, 1e-13);
    close("alpha", run.accelerations(&m).unwrap().a[2], ddx * y + 2.0 * dx * dy + x * ddy, 1e-12);
    assert_eq!(mobility(&m, 0.4, &state.q).degrees_of_freedom, 0);
}
