//! The errors of assembly at impossible positions.

use crate::mechanisms::{asked, close, model, refused, FOUR_BAR};
use kempe::analyses::assemble::{assemble, targets, Fault, Request, Target};
use kempe::analyses::State;

fn slider(value: &str) -> String {
    format!(
        "[bodies.slider]\nmass = 1\ninertia = 1\n[drivers.motor]\ntype = \"coordinate_driver\"\ncoordinate = \"slider.x\"\nvalue = \"{value}\"\n"
    )
}

#[test]
fn a_law_without_a_value_is_named() {
    for (value, t, what) in [
        ("sqrt(t - 1)", 0.0, "value"),
        ("ln(t)", 0.0, "value"),
        ("sqrt(t)", 0.0, "derivative"),
        ("sqrt(slider.y)", 0.0, "derivative"),
    ] {
        let m = model(&slider(value));
        let failure = assemble(&m, &Request { t, ..Request::default() }).expect_err(value);
        assert_eq!(failure.name, "motor", "{value}: {failure}");
        let expected = format!("the law of driver motor has no finite {what} at t = 0 s");
        assert_eq!(failure.message, expected, "{value}");
    }
}

#[test]
fn two_values_for_one_coordinate() {
    let failure = refused(&model(&slider("1 + t")), &[("slider.x", "3")]);
    assert_eq!(failure.fault, Fault::Open);
    assert!(failure.message.contains("slider.x = 3 m"), "{failure}");
    close("a length", failure.gap, 2.0, 1e-12);
    let m = model(FOUR_BAR);
    let failure = refused(&m, &[("crank.angle", "1"), ("rocker.angle", "1")]);
    assert_eq!(failure.fault, Fault::Open);
    let both = "set crank.angle = 57.29578° and set rocker.angle = 57.29578° contradict each other";
    assert!(failure.message.starts_with(both), "{failure}");
}

#[test]
fn a_state_that_is_not_a_number_does_no_harm() {
    let m = model(FOUR_BAR);
    for bad in [f64::NAN, f64::INFINITY] {
        let mut state = State { t: 0.0, q: vec![0.1; 9], v: vec![0.0; 9], z: vec![] };
        state.q[4] = bad;
        let request = Request { state: Some(state), ..Request::default() };
        if let Ok((state, _)) = assemble(&m, &request) {
            assert!(state.q.iter().chain(&state.v).all(|x| x.is_finite()));
        }
        let mut state = State { t: 0.0, q: vec![0.1; 9], v: vec![0.0; 9], z: vec![] };
        state.v[2] = bad;
        let request = Request { state: Some(state), ..Request::default() };
        if let Ok((state, _)) = assemble(&m, &request) {
            assert!(state.q.iter().chain(&state.v).all(|x| x.is_finite()));
        }
    }
}

#[test]
fn wishes_that_cannot_be_read() {
    let m = model(FOUR_BAR);
    for (key, value, parts) in [
        ("crnak.angle", "1", ["unknown body 'crnak'", "'crank'"]),
        ("crank.angel", "1", ["'angel'", "'angle'"]),
        ("ground.x", "1", ["ground does not move", ""]),
        ("crank", "1", ["body.coordinate", ""]),
        ("crank.angle", "1/0", ["start.set.crank.angle", ""]),
        ("crank.angle", "t", ["start.set.crank.angle", "t"]),
    ] {
        let found = targets(&m, "set", &[(key.to_string(), value.into())]).expect_err(key);
        let text = found[0].to_string();
        assert!(parts.iter().all(|part| text.contains(part)), "{key} = {value}: {text}");
    }
    let value = |key: &str, text: &str| match &asked(&m, "set", &[(key, text)])[0] {
        Target::Coordinate(target) => target.value,
        other => panic!("not a coordinate: {other:?}"),
    };
    close("a formula", value("crank.angle", "L1*30*deg/10"), 30_f64.to_radians(), 1e-15);
    close("a unit", value("crank.x", "250 mm"), 0.25, 1e-16);
}

#[test]
fn a_loop_that_only_newton_meets() {
    // a triangle of three moving bars between two ground pins too far apart
    let bar = |n: &str| {
        format!("[bodies.{n}]\ntype = \"bar\"\nmass = 1\nlength = 1\nends = [\"P\", \"Q\"]\n")
    };
    let pin = |n: &str, i: &str, j: &str| {
        format!("[joints.{n}]\ntype = \"revolute\"\ni = \"{i}\"\nj = \"{j}\"\n")
    };
    let text = [
        "[bodies.ground]\npoints = { O = [0, 0], E = [3.5, 0] }\n".to_string(),
        bar("a"),
        bar("b"),
        bar("c"),
        pin("A", "ground.O", "a.P"),
        pin("B", "a.Q", "b.P"),
        pin("C", "b.Q", "c.P"),
        pin("D", "c.Q", "ground.E"),
    ]
    .concat();
    let failure = refused(&model(&text), &[]);
    assert!(failure.message.contains("the loop A-B-C-D cannot close"), "{failure}");
    close("3 m of links between pins 3.5 m apart", failure.gap, 0.5, 0.05);
}

/// Only openings of one kind add up. This constraint closes its length and misses its angle.
#[test]
fn an_angle_that_is_missed_is_no_length() {
    let m = model(
        "[bodies.a]\nmass = 1\ninertia = 1\n[joints.given]\ntype = 'constraint'\n\
         residual = ['a.x - 1', 'sin(a.angle) - 2']\nunits = ['m', 'rad']\n",
    );
    let failure = refused(&m, &[]);
    assert!(failure.message.ends_with("given would have to change by 1 rad"), "{failure}");
    assert_eq!((failure.name.as_str(), failure.gap), ("given", 0.0));
}
