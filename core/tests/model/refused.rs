//! Impossible values are errors, with the name of the value and a remedy.

use crate::mechanisms::faults;

const TWO: &str = r#"
[parameters]
L = 1
[bodies.ground]
points = { O = [0, 0], Q = [1, 0] }
[bodies.crank]
type = "bar"
mass = 1
length = "L"
ends = ["A", "B"]
[bodies.rocker]
type = "bar"
mass = 1
length = "L"
ends = ["A", "B"]
"#;

#[track_caller]
fn says(section: &str, expected: &[&str]) {
    let found = faults(&format!("{TWO}{section}"));
    for part in expected {
        assert!(found.contains(part), "'{part}' is not in: {found}");
    }
}

fn pin(i: &str, j: &str) -> String {
    format!("[joints.pin]\ntype = \"revolute\"\ni = \"{i}\"\nj = \"{j}\"\n")
}

fn driver(value: &str) -> String {
    format!("[drivers.motor]\ntype = \"coordinate_driver\"\ncoordinate = \"crank.angle\"\nvalue = \"{value}\"\n")
}

#[test]
fn nothing_of_a_sound_model() {
    assert_eq!(faults(TWO), "");
    assert_eq!(
        faults(&format!("{TWO}{}{}", pin("ground.O", "crank.A"), driver("2*rocker.angle + t"))),
        ""
    );
}

#[test]
fn rods_without_length() {
    for length in ["0", "-L", "L - 1"] {
        let rod = format!(
            "[joints.rod]\ntype = \"distance\"\ni = \"ground.O\"\nj = \"crank.A\"\nlength = \"{length}\"\n"
        );
        says(&rod, &["joints.rod.length: ", " m; must be > 0"]);
    }
}

#[test]
fn negative_moments_of_inertia_but_not_none() {
    let body = |inertia: &str| format!("[bodies.bob]\nmass = 1\ninertia = \"{inertia}\"\n");
    says(&body("-L"), &["bodies.bob.inertia: -1 kg·m²; must not be negative"]);
    says(&body("0/0*L"), &["bodies.bob.inertia"]);
    assert_eq!(faults(&format!("{TWO}{}", body("0"))), "");
}

#[test]
fn a_torque_between_a_body_and_itself() {
    let torque = "[forces.motor]\ntype = \"torque\"\nj = \"ground\"\ntorque = 1\n";
    says(torque, &["both ends of this force are on 'ground'"]);
    let unknown =
        "[forces.motor]\ntype = \"torque\"\nj = \"crank\"\ni = \"rokcer\"\ntorque = \"sin(t)\"\n";
    says(unknown, &["unknown body 'rokcer'", "did you mean 'rocker'?"]);
}

#[test]
fn unknown_bodies_and_points_with_a_suggestion() {
    says(
        &pin("ground.O", "crnak.A"),
        &["joints.pin.j", "unknown body 'crnak'", "did you mean 'crank'?"],
    );
    says(&pin("ground.O", "crank.C"), &["body 'crank' has no point 'C'", "A, B"]);
    says(&pin("ground", "crank.A"), &["joints.pin.i", "must have the form body.point"]);
}

#[test]
fn several_faults_at_once() {
    let found = faults(&format!("{TWO}{}{}", pin("gruond.O", "crank.C"), driver("t +")));
    assert!(found.lines().count() >= 3, "{found}");
}

#[test]
fn a_joint_of_a_body_with_itself() {
    says(&pin("crank.A", "crank.B"), &["joints.pin", "both ends", "'crank'"]);
    says(&pin("crank.A", "crank.A"), &["joints.pin", "both ends", "'crank'"]);
    says(&pin("ground.O", "ground.Q"), &["joints.pin", "both ends", "'ground'"]);
    let spring =
        "[forces.s]\ntype = \"torsion_spring\"\ni = \"crank\"\nj = \"crank\"\nstiffness = 1\n";
    says(spring, &["forces.s", "both ends", "'crank'"]);
}

#[test]
fn a_driver_that_uses_velocities() {
    says(&driver("2*rocker.omega"), &["drivers.motor.value", "positions, not velocities"]);
    says(&driver("t*rocker.vx"), &["drivers.motor.value", "positions, not velocities"]);
}

#[test]
fn a_driver_that_uses_the_coordinate_it_drives() {
    says(&driver("0.5*crank.angle + 1"), &["drivers.motor.value", "crank.angle", "drives"]);
    let other = driver("crank.x");
    assert_eq!(faults(&format!("{TWO}{other}")), "", "another coordinate of the body is fine");
}

#[test]
fn a_driver_of_ground_or_of_a_rate() {
    says(&driver("t").replace("crank.angle", "ground.angle"), &["ground does not move"]);
    says(&driver("t").replace("crank.angle", "crank.omega"), &["not one of x, y, angle"]);
}

#[test]
fn laws_where_only_parameters_may_stand() {
    let heavy = TWO.replacen("mass = 1", "mass = \"1 + t\"", 1);
    let found = faults(&heavy);
    assert!(found.contains("bodies.crank.mass") && found.contains("only laws"), "{found}");
    let long = TWO.replacen("length = \"L\"", "length = \"rocker.x\"", 1);
    let found = faults(&long);
    assert!(found.contains("bodies.crank.length") && found.contains("only laws"), "{found}");
}

#[test]
fn numbers_that_cannot_be() {
    for (mass, part) in
        [("-1", "-1 kg; must not be negative"), ("\"1/(L-1)\"", "inf kg; must be finite")]
    {
        let found = faults(&TWO.replacen("mass = 1", &format!("mass = {mass}"), 1));
        assert!(found.contains("bodies.crank.mass") && found.contains(part), "{mass}: {found}");
    }
    let found = faults(&TWO.replacen("length = \"L\"", "length = 0", 1));
    assert!(found.contains("bodies.crank.length") && found.contains("must be > 0"), "{found}");
    let found = faults(&TWO.replace("L = 1", "L = \"sqrt(-K)\"\nK = 1"));
    assert!(found.contains("parameters.L") && found.contains("finite"), "{found}");
    let found = faults(&TWO.replace("L = 1", "L = \"K\"\nK = \"L\""));
    assert!(found.contains("parameters."), "{found}");
    says("gravity_ = [0, 1]", &["gravity_"]);
}

#[test]
fn values_of_springs_that_are_not_finite() {
    let spring = "[forces.s]\ntype = \"torsion_spring\"\ni = \"ground\"\nj = \"crank\"\nstiffness = \"1/(L - 1)\"\n";
    says(spring, &["forces.s", "inf"]);
}

#[test]
fn units_that_do_not_fit() {
    let found = faults(&TWO.replacen("length = \"L\"", "length = \"250 kg\"", 1));
    assert!(
        found.contains("bodies.crank.length") && found.contains("'250 kg' is in kg; must be in m"),
        "{found}"
    );
}
