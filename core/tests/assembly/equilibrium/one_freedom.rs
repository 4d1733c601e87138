//! Mechanisms of one freedom against closed forms.

use super::{found, holding, rest};
use crate::mechanisms::{close, column, model, start, PENDULUM};
use kempe::analyses::equilibrium::Options;
use std::f64::consts::PI;

/// m g l / 2 of the pendulum.
const MOMENT: f64 = 9.81 / 2.0;

#[test]
fn a_pendulum_falls_from_nearly_upright() {
    let m = model(PENDULUM);
    let angle = column(&m, "rod", 2);
    for (at, down) in
        [("90.001*deg", -PI / 2.0 + 2.0 * PI), ("89.999*deg", -PI / 2.0), ("200*deg", 1.5 * PI)]
    {
        let (state, _) = start(&m, &[("rod.angle", at)], &[]);
        let found = rest(&m, &state);
        close(at, found.state.q[angle], down, 1e-14);
        assert!(found.stable && found.coordinates == ["rod.angle"]);
        close("eigenvalue", found.eigenvalues[0], MOMENT, 1e-13);
        // the pin carries the weight: λ balances Q, so that joint j is pulled up
        close("vertical", found.lam[1], -9.81, 1e-12);
    }
}

#[test]
fn a_pendulum_that_stands_is_at_rest_but_not_stable() {
    let m = model(PENDULUM);
    let (state, _) = start(&m, &[("rod.angle", "90*deg")], &[]);
    let found = rest(&m, &state);
    close("angle", found.state.q[column(&m, "rod", 2)], PI / 2.0, 1e-14);
    assert!(!found.stable);
    close("eigenvalue", found.eigenvalues[0], -MOMENT, 1e-13);
}

#[test]
fn the_nearest_equilibrium_may_be_unstable() {
    let m = model(PENDULUM);
    let (state, _) = start(&m, &[("rod.angle", "100*deg")], &[]);
    let options = Options { nearest: true, ..Options::new() };
    let found = found(&m, &state, &options).expect("an equilibrium");
    close("angle", found.state.q[column(&m, "rod", 2)], PI / 2.0, 1e-12);
    assert!(!found.stable);
}

#[test]
fn a_holder_carries_the_moment_of_the_weight() {
    let m = model(PENDULUM);
    for (name, factor) in [("rod.angle", 1.0), ("pin.angle", 1.0)] {
        let (state, _) = start(&m, &[("rod.angle", "0.3")], &[]);
        let found = found(&m, &state, &holding(&[name])).expect("an equilibrium");
        close("angle", found.state.q[column(&m, "rod", 2)], 0.3, 1e-14);
        close(name, found.holders[0], factor * MOMENT * 0.3_f64.cos(), 1e-12);
        assert!(found.eigenvalues.is_empty() && found.stable);
    }
}

/// The current of a motor at rest is voltage / resistance, and its torque bends the spring.
#[test]
fn a_motor_with_inductance_stalls_against_a_spring() {
    let text = "[bodies.ground]\npoints = { O = [0, 0] }\n[bodies.wheel]\nmass = 1\ninertia = 1\npoints = { O = [0, 0] }\n\
                [joints.O]\ntype = 'revolute'\ni = 'ground.O'\nj = 'wheel.O'\n\
                [forces.motor]\ntype = 'motor'\nj = 'wheel'\nvoltage = 12\nresistance = 0.5\ninductance = 0.01\n\
                torque_constant = 0.2\n\
                [forces.spring]\ntype = 'torsion_spring'\ni = 'ground'\nj = 'wheel'\nstiffness = 30\n";
    let m = model(text);
    let (state, _) = start(&m, &[("wheel.angle", "0")], &[]);
    let found = rest(&m, &state);
    close("current", found.state.z[0], 24.0, 1e-12);
    close("angle", found.state.q[2], 0.2 * 24.0 / 30.0, 1e-13);
    close("stiffness", found.eigenvalues[0], 30.0, 1e-12);
}

/// A weight hangs on a cable that only pulls, beside one that is slack.
#[test]
fn a_slack_cable_carries_nothing() {
    let text = "gravity = [0, -10]\n[bodies.ground]\npoints = { A = [0, 0], B = [0, -4] }\n\
                [bodies.weight]\ntype = 'point_mass'\nmass = 2\nat = [0.1, -1]\n\
                [forces.upper]\ntype = 'spring_damper'\ni = 'ground.A'\nj = 'weight.P'\nstiffness = 100\nfree_length = 1\nonly = 'tension'\n\
                [forces.lower]\ntype = 'spring_damper'\ni = 'ground.B'\nj = 'weight.P'\nstiffness = 100\nfree_length = 3\nonly = 'tension'\n";
    let m = model(text);
    let (state, _) = start(&m, &[("weight.x", "0.4"), ("weight.y", "-0.2")], &[]);
    let found = rest(&m, &state);
    close("x", found.state.q[0], 0.0, 1e-12);
    close("y", found.state.q[1], -1.2, 1e-12);
    assert!(found.stable, "{:?}", found.eigenvalues);
    // the cable turns like a pendulum: m g / length
    close("sideways", found.eigenvalues[0], 20.0 / 1.2, 1e-10);
    close("along", found.eigenvalues[1], 100.0, 1e-10);
}

/// A driven slider-crank without freedom: the effort balances the weight by virtual work.
#[test]
fn a_driven_mechanism_has_the_reactions_of_statics() {
    let text = format!(
        "{}\n[drivers.motor]\ntype = 'coordinate_driver'\ncoordinate = 'crank.angle'\nvalue = '0.7 + 5*t'\n",
        crate::mechanisms::SLIDER_CRANK
    );
    let m = model(&text);
    let (state, _) = start(&m, &[], &[("piston.x", "0.35")]);
    let found = rest(&m, &state);
    let (r, l, angle) = (0.1_f64, 0.3_f64, 0.7_f64);
    // heights of the crank's centre and of the rod's centre are r sin(angle) / 2 each
    let effort = 9.81 * (1.0 * 0.5 + 0.5 * 0.5) * r * angle.cos();
    assert_eq!(found.efforts[0].0, "motor");
    close("effort", found.efforts[0].1, effort, 1e-12);
    assert!(found.stable && found.eigenvalues.is_empty());
    let _ = l;
}
