//! Mechanisms without an equilibrium, and options that cannot be right.

use super::{found, holding, rest};
use crate::mechanisms::{model, start, PENDULUM};
use kempe::analyses::equilibrium::{Options, Reason};
use kempe::analyses::record::Outcome;
use kempe::elements::QuantityKind;

const WHEEL: &str = "[bodies.ground]\npoints = { O = [0, 0] }\n[bodies.wheel]\nmass = 1\ninertia = 1\n\
                     points = { O = [0, 0] }\n[joints.O]\ntype = 'revolute'\ni = 'ground.O'\nj = 'wheel.O'\n";

#[test]
fn a_torque_turns_a_free_wheel_without_end() {
    let m = model(&format!(
        "{WHEEL}[forces.drive]\ntype = 'torque'\ni = 'ground'\nj = 'wheel'\ntorque = 3\n"
    ));
    let (state, _) = start(&m, &[("wheel.angle", "0")], &[]);
    let reason = found(&m, &state, &Options::new()).expect_err("no equilibrium");
    let Reason::Endless { coordinate, force, .. } = &reason else { panic!("{reason}") };
    assert_eq!(coordinate, "wheel.angle");
    assert!((force - 3.0).abs() < 1e-12, "{force}");
    assert!(reason.to_string().contains("no equilibrium within reach"), "{reason}");
}

#[test]
fn a_free_wheel_rests_anywhere() {
    let m = model(WHEEL);
    let (state, _) = start(&m, &[("wheel.angle", "0.4")], &[]);
    let found = rest(&m, &state);
    assert_eq!(found.eigenvalues, [0.0]);
    assert!(!found.stable && found.state.q[2] == state.q[2]);
}

#[test]
fn a_law_that_jumps_has_no_equilibrium() {
    let law = "[forces.drive]\ntype = 'generalized_force'\ncoordinate = 'wheel.angle'\nvalue = 'if(wheel.angle > 0.5, -1, 1)'\n";
    let m = model(&format!("{WHEEL}{law}"));
    let (state, _) = start(&m, &[("wheel.angle", "0")], &[]);
    let reason = found(&m, &state, &Options::new()).expect_err("no equilibrium");
    assert!(matches!(reason, Reason::Lost { .. }), "{reason:?}");
}

#[test]
fn a_coordinate_is_held_once() {
    let m = model(PENDULUM);
    let (state, _) = start(&m, &[("rod.angle", "0.3")], &[]);
    let reason = found(&m, &state, &holding(&["rod.angle", "pin.angle"])).expect_err("twice");
    assert!(reason.to_string().contains("hold pin.angle already"), "{reason}");
    for name in ["rod.omega", "rod.colour", "pin.force", "nothing"] {
        let reason = found(&m, &state, &holding(&[name])).expect_err(name);
        assert!(matches!(reason, Reason::Option(_)), "{reason}");
    }
}

/// The parameter of a curve from formulas has no unit, so that the effort along it is an energy. It cannot be held.
#[test]
fn a_bead_slides_down_a_wire_without_end() {
    for curve in
        ["{ x = 'u/1000', y = '-u/1000', range = [-1000, 1000] }", "{ line = [[-1, 1], [1, -1]] }"]
    {
        let m = model(&format!(
            "gravity = [0, -9.81]\n[bodies.ground]\ncurves = {{ wire = {curve} }}\n[bodies.bead]\n\
             type = 'point_mass'\nmass = 2\n[joints.wire]\ntype = 'point_on_curve'\ni = 'bead.P'\n\
             curve = 'ground.wire'\n"
        ));
        let (state, _) = start(&m, &[("bead.x", "0.1")], &[]);
        let reason = found(&m, &state, &Options::new()).expect_err("no equilibrium");
        let Reason::Endless { coordinate, kind, moved, force } = &reason else {
            panic!("{reason}")
        };
        assert_eq!((coordinate.as_str(), *kind), ("bead.x", QuantityKind::Length));
        assert!((force / (2.0 * 9.81) - 1.0).abs() < 1e-5, "{force}"); // the path has tan = 1
        assert!(reason.to_string().ends_with(&format!(" by {moved:.3} m")), "{reason}");
        let hint = Outcome::from(reason).hint.unwrap_or_default();
        assert!(hint.contains(" N ") && hint.contains("hold = "), "{hint}");
    }
}
