//! Energy balance of driven mechanisms and of forces with laws.

use crate::mechanisms::{every, model, run, start, tolerances};
use kempe::model::Model;

const CRANK: &str = r#"
gravity = [0, -9.81]
[bodies.ground]
points = { O = [0, 0] }
[bodies.crank]
mass = 2
inertia = 0.3
center = [0.1, 0.2]
points = { O = [-0.4, 0], P = [0.5, 0] }
[bodies.arm]
type = "bar"
mass = 1
length = 0.8
ends = ["P", "E"]
[joints.O]
type = "revolute"
i = "ground.O"
j = "crank.O"
[joints.P]
type = "revolute"
i = "crank.P"
j = "arm.P"
[forces.damped]
type = "torsion_spring"
i = "crank"
j = "arm"
stiffness = 5
damping = 0.4
free_angle = "0.3"
"#;

fn balances(m: &Model) -> Vec<f64> {
    let (state, _) =
        start(m, &[], &[("crank.angle", "0.2"), ("arm.angle", "-0.5"), ("arm.omega", "1")]);
    let run = run(m, &state, &every(0.05, tolerances(2.0, 1e-10, 1e-12)));
    let energy: Vec<[f64; 5]> =
        run.energies(m).unwrap().chunks(5).map(|e| e.try_into().unwrap()).collect();
    let kinetic = energy.iter().map(|e| e[0]).fold(0.0, f64::max);
    let balance = |e: &[f64; 5]| e[0] + e[1] + e[2] - e[3] - e[4];
    for e in &energy {
        let off = (balance(e) - balance(&energy[0])).abs();
        assert!(off < 1e-7 * kinetic, "{off:.2e} of {kinetic}");
    }
    energy.last().unwrap().to_vec()
}

#[test]
fn of_a_free_mechanism() {
    let end = balances(&model(CRANK));
    assert!(end[2] > 0.01 && end[3] == 0.0 && end[4] == 0.0, "{end:?}");
}

#[test]
fn of_a_driver_with_a_law_of_time() {
    let driver = r#"
[drivers.motor]
type = "coordinate_driver"
coordinate = "crank.angle"
value = "0.2 + 0.5*sin(3*t)"
"#;
    let end = balances(&model(&format!("{CRANK}{driver}")));
    assert!(end[3].abs() > 0.1 && end[4] == 0.0, "{end:?}");
}

#[test]
fn of_a_driver_that_couples_two_bodies() {
    let driver = r#"
[drivers.gear]
type = "coordinate_driver"
coordinate = "arm.angle"
value = "-2*crank.angle + 0.1*crank.x"
"#;
    let end = balances(&model(&format!("{CRANK}{driver}")));
    assert!(end[3].abs() < 1e-8, "a coupling does no work: {end:?}");
}

#[test]
fn of_forces_with_laws_of_time_and_state() {
    let force = r#"
[forces.actuator]
type = "torsion_spring"
i = "ground"
j = "crank"
stiffness = "4 + sin(t)"
damping = "0.1*crank.omega^2"
free_angle = "0.5*arm.angle"
"#;
    let end = balances(&model(&format!("{CRANK}{force}")));
    assert!(end[4].abs() > 0.01, "{end:?}");
}
