//! Whole turns: springs are relaxed as far as whole turns can, unless a guess fixes them.

use crate::mechanisms::{close, model, start, FOUR_BAR};
use std::f64::consts::{PI, TAU};

const SET: [(&str, &str); 1] = [("crank.angle", "70*deg")];

fn rocker(free: &str, guess: &[(&str, &str)]) -> (f64, Vec<String>) {
    let m = model(&FOUR_BAR.replace("270*deg", free));
    let (state, report) = start(&m, &SET, guess);
    (state.q[8], report.warnings)
}

#[test]
fn the_nearest_turn_is_taken() {
    let upper = [("coupler.angle", "14*deg")];
    let base = 4.213075806186499;
    for (free, turns) in
        [("270*deg", 0.0), ("630*deg", 1.0), ("-90*deg", -1.0), ("(270 - 3*360)*deg", -3.0)]
    {
        let (angle, warnings) = rocker(free, &upper);
        close(free, angle, base + turns * TAU, 1e-11);
        assert!(warnings.is_empty(), "{warnings:?}");
        let free: f64 = (270.0 + 360.0 * turns) * PI / 180.0;
        assert!((angle - free).abs() <= PI);
    }
}

#[test]
fn a_guess_fixes_the_turn_and_is_warned_of() {
    let (angle, warnings) = rocker("630*deg", &[("rocker.angle", "240*deg")]);
    close("as guessed", angle, 4.213075806186499, 1e-11);
    assert!(
        warnings.len() == 1
            && warnings[0].contains("spring")
            && warnings[0].contains("half a turn"),
        "{warnings:?}"
    );
    let (angle, warnings) = rocker("270*deg", &[("rocker.angle", "(240 + 720)*deg")]);
    close("as guessed", angle, 4.213075806186499 + 2.0 * TAU, 1e-11);
    assert_eq!(warnings.len(), 1);
}

#[test]
fn springs_in_a_row_relax_one_after_the_other() {
    let m = model(
        r#"
[bodies.ground]
points = { O = [0, 0] }
[bodies.one]
type = "bar"
mass = 1
length = 1
ends = ["A", "B"]
[bodies.two]
type = "bar"
mass = 1
length = 1
ends = ["A", "B"]
[joints.O]
type = "revolute"
i = "ground.O"
j = "one.A"
[joints.P]
type = "revolute"
i = "one.B"
j = "two.A"
[forces.first]
type = "torsion_spring"
i = "ground"
j = "one"
stiffness = 1
free_angle = "5*pi"
[forces.second]
type = "torsion_spring"
i = "two"
j = "one"
stiffness = 1
free_angle = "-4*pi"
"#,
    );
    let (state, report) = start(&m, &[], &[]);
    assert!(report.warnings.is_empty(), "{:?}", report.warnings);
    assert!((state.q[2] - 5.0 * PI).abs() <= PI * (1.0 + 1e-12), "{}", state.q[2]);
    assert!((state.q[2] - state.q[5] + 4.0 * PI).abs() <= PI * (1.0 + 1e-12), "{}", state.q[5]);
}

/// The free angle is infinite at t = 0; found by a random case.
#[test]
fn a_free_angle_without_a_value_turns_nothing() {
    let (angle, warnings) = rocker("1/t", &[("coupler.angle", "14*deg")]);
    // the turn of the placement stays
    close("rocker", angle, 4.213075806186499 - TAU, 1e-11);
    assert!(warnings.is_empty(), "{warnings:?}");
}
