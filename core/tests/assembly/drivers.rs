//! Drivers with laws of time and of other bodies.

use crate::mechanisms::{close, largest, model, rate, residual, run, start, tolerances, FOUR_BAR};
use kempe::analyses::assemble::{assemble, Request};
use kempe::analyses::dynamics::{Accelerations, Options};

fn driven(value: &str) -> String {
    let driver = format!("[drivers.motor]\ntype = \"coordinate_driver\"\ncoordinate = \"crank.angle\"\nvalue = \"{value}\"\n\n[forces.spring]");
    FOUR_BAR.replace("[forces.spring]", &driver)
}

#[test]
fn the_law_holds_at_the_time_of_assembly() {
    let m = model(&driven("1 + 0.5*t + 0.1*sin(3*t)"));
    for t in [0.0, 0.7, 2.0_f64] {
        let (state, report) = assemble(&m, &Request { t, ..Request::default() }).unwrap();
        assert_eq!((state.t, report.degrees_of_freedom), (t, 0));
        close("angle", state.q[2], 1.0 + 0.5 * t + 0.1 * (3.0 * t).sin(), 1e-13);
        close("omega", state.v[2], 0.5 + 0.3 * (3.0 * t).cos(), 1e-12);
        assert!(largest(&residual(&m, &state)) < 1e-11 && largest(&rate(&m, &state)) < 1e-11);
        let run = run(&m, &state, &Options::classical(t));
        close("alpha", run.accelerations(&m).unwrap().a[2], -0.9 * (3.0 * t).sin(), 1e-11);
    }
}

#[test]
fn the_driver_leads_the_motion() {
    let m = model(&driven("1.2 + 0.8*t"));
    let (state, _) = start(&m, &[], &[("coupler.angle", "14*deg"), ("rocker.angle", "240*deg")]);
    let run = run(&m, &state, &tolerances(1.0, 1e-8, 1e-10));
    for (k, t) in run.trajectory.t.iter().enumerate() {
        close("angle", run.trajectory.q[9 * k + 2], 1.2 + 0.8 * t, 1e-7);
    }
}

/// Two wheels on ground, the second driven by the first as by gears: one freedom.
const GEARS: &str = r#"
[bodies.ground]
points = { O = [0, 0], P = [3, 0] }
[bodies.first]
mass = 2
inertia = 0.5
points = { O = [0, 0] }
[bodies.second]
mass = 1
inertia = 0.2
points = { P = [0, 0] }
[joints.O]
type = "revolute"
i = "ground.O"
j = "first.O"
[joints.P]
type = "revolute"
i = "ground.P"
j = "second.P"
[drivers.gear]
type = "coordinate_driver"
coordinate = "second.angle"
value = "2*first.angle"
[forces.load]
type = "torsion_spring"
i = "ground"
j = "second"
stiffness = 3
"#;

#[test]
fn a_coupling_of_two_bodies() {
    let m = model(GEARS);
    let (state, report) = start(&m, &[("first.angle", "0.4"), ("first.omega", "1.5")], &[]);
    assert_eq!(report.degrees_of_freedom, 1);
    close("angle", state.q[5], 0.8, 1e-13);
    close("omega", state.v[5], 3.0, 1e-13);
    let run = run(&m, &state, &tolerances(1.0, 1e-10, 1e-12));
    // J1 + 4 J2 = 1.3, k = 4 * 3: θ'' = -12/1.3 θ
    let w = (12.0_f64 / 1.3).sqrt();
    let last = 6 * (run.trajectory.t.len() - 1);
    close("angle", run.trajectory.q[last + 2], 0.4 * w.cos() + 1.5 / w * w.sin(), 1e-8);
    let Accelerations { a, lam, .. } = run.accelerations(&m).unwrap();
    close("alpha", a[2], -12.0 / 1.3 * 0.4, 1e-10);
    // torque of the gear on the driven wheel is -λ, on the other 2 λ
    close("second", -3.0 * 0.8 - lam[4], 0.2 * a[5], 1e-10);
    close("first", 2.0 * lam[4], 0.5 * a[2], 1e-10);
}

/// 2 φ1 - φ2 = value: the value has the sign of the sum, and its rate that of the rates.
#[test]
fn a_coupling_with_a_value_that_changes() {
    let coupling = "[joints.sum]\ntype = \"coupling\"\nterms = { \"first.angle\" = 2, \"P.angle\" = -1 }\nvalue = \"0.3 + 0.5*t\"\n";
    let driver = GEARS.find("[drivers.gear]").expect("a driver");
    let load = GEARS.find("[forces.load]").expect("a force");
    let m = model(&(GEARS[..driver].to_string() + coupling + &GEARS[load..]));
    let (state, _) = start(&m, &[("first.angle", "0.4"), ("first.omega", "1.5")], &[]);
    close("angle", state.q[5], 0.5, 1e-12);
    close("omega", state.v[5], 2.5, 1e-12);
}
