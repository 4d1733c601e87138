//! Linear equations on independent coordinates, against closed forms.

use crate::mechanisms::{model, start, PENDULUM};
use kempe::analyses::dynamics::Reason;
use kempe::analyses::linearization::{begins, linearize, Failure, Linearization};
use kempe::model::Model;
use kempe::State;
use std::f64::consts::PI;

const G: f64 = 9.81;

/// A row of parallelograms: cranks and couplers of 1 m and 1 kg.
fn windows(n: usize) -> Model {
    let mut text = format!("gravity = [0, -{G}]\n[bodies.ground]\npoints = {{ ");
    text += &(0..=n).map(|k| format!("P{k} = [{k}, 0]")).collect::<Vec<_>>().join(", ");
    text += " }\n";
    let bar = |name: String, ends: &str| {
        format!("[bodies.{name}]\ntype = 'bar'\nmass = 1\nlength = 1\nends = {ends}\n")
    };
    (0..=n).for_each(|k| text += &bar(format!("crank{k}"), "['A', 'B']"));
    (0..n).for_each(|k| text += &bar(format!("coupler{k}"), "['B', 'C']"));
    text += "[joints]\n";
    let pin = |name: String, i: String, j: String| {
        format!("{name} = {{ type = 'revolute', i = '{i}', j = '{j}' }}\n")
    };
    for k in 0..=n {
        text += &pin(format!("A{k}"), format!("ground.P{k}"), format!("crank{k}.A"));
    }
    for k in 0..n {
        text += &pin(format!("B{k}"), format!("crank{k}.B"), format!("coupler{k}.B"));
        text += &pin(format!("C{k}"), format!("coupler{k}.C"), format!("crank{}.B", k + 1));
    }
    model(&text)
}

/// All cranks at an angle.
fn turned(m: &Model, n: usize, angle: f64) -> State {
    let mut hints: Vec<(String, String)> =
        (0..=n).map(|k| (format!("crank{k}.angle"), angle.to_string())).collect();
    hints.extend((0..n).map(|k| (format!("coupler{k}.angle"), "0".to_string())));
    let hints: Vec<(&str, &str)> = hints.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
    start(m, &[("crank0.angle", &angle.to_string())], &hints).0
}

#[test]
fn stiffness_of_hanging_and_upright_windows() {
    for n in [1, 4] {
        let m = windows(n);
        let weight = G * (3 * n + 1) as f64 / 2.0;
        for (angle, expected) in [(-PI / 2.0, weight), (PI / 2.0, -weight)] {
            let state = turned(&m, n, angle);
            let Linearization { coordinates, stiffness: found, .. } =
                linearize(&m, &state, (&[], &[]), false).expect("regular");
            assert_eq!(coordinates, [2]);
            assert!((found[0] - expected).abs() < 1e-12 * weight, "{} {expected}", found[0]);
        }
    }
}

#[test]
fn stiffness_of_a_double_pendulum() {
    let bar = "type = 'bar'\nmass = 2\nlength = 3\nends = ['A', 'B']\n";
    let m = model(&format!(
        "gravity = [0, -{G}]\n[bodies.ground]\npoints = {{ O = [0, 0] }}\n[bodies.one]\n{bar}[bodies.two]\n{bar}\
         [joints]\nO = {{ type = 'revolute', i = 'ground.O', j = 'one.A' }}\n\
         P = {{ type = 'revolute', i = 'one.B', j = 'two.A' }}\n\
         [forces.spring]\ntype = 'torsion_spring'\ni = 'one'\nj = 'two'\nstiffness = 7\n"
    ));
    let state = start(&m, &[("one.angle", "-pi/2"), ("two.angle", "-pi/2")], &[]).0;
    let Linearization { coordinates, stiffness: found, .. } =
        linearize(&m, &state, (&[], &[]), false).expect("regular");
    assert_eq!(coordinates, [2, 5]);
    let (weight, k) = (2.0 * G * 3.0, 7.0);
    let expected = [1.5 * weight + k, -k, -k, 0.5 * weight + k];
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12 * weight, "{found} {expected}");
    }
}

#[test]
fn a_pendulum_with_inputs_and_outputs() {
    let m = model(PENDULUM);
    let state = start(&m, &[("rod.angle", "0.3"), ("rod.omega", "2")], &[]).0;
    let names = |all: &[&str]| all.iter().map(ToString::to_string).collect::<Vec<_>>();
    let outputs = names(&["rod.P.x", "rod.alpha", "pin.fy"]);
    let found = linearize(&m, &state, (&names(&["rod.angle"]), &outputs), false).expect("regular");
    let (s, c, rate) = (0.3_f64.sin(), 0.3_f64.cos(), 2.0);
    let alpha = -1.5 * G * c;
    let slope = 1.5 * G * s;
    let close = |found: &[f64], expected: &[f64]| {
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found - expected).abs() < 1e-12 * expected.abs().max(1.0),
                "{found} {expected}"
            );
        }
    };
    close(&found.mass, &[1.0 / 3.0]);
    close(&found.a, &[0.0, 1.0, slope, 0.0]);
    close(&found.b, &[0.0, 3.0]);
    // the pin carries m (a_y + g) with a_y = (cos φ α - sin φ ω²) / 2
    let by_angle = (c * slope - s * alpha - c * rate * rate) / 2.0;
    close(&found.c, &[-s, 0.0, slope, 0.0, by_angle, -2.0 * s * rate / 2.0]);
    close(&found.d, &[0.0, 3.0, 1.5 * c]);
    close(&found.values, &[c, alpha, (c * alpha - s * rate * rate) / 2.0 + G]);
}

#[test]
fn unknown_names_and_flat_windows_are_refused() {
    let m = model(PENDULUM);
    let state = start(&m, &[], &[]).0;
    let refused = linearize(&m, &state, (&["rod.omega".to_string()], &[]), false);
    assert!(matches!(refused, Err(Failure::Name(_))), "{refused:?}");
    let refused = linearize(&m, &state, (&[], &["rod.speed".to_string()]), false);
    assert!(matches!(refused, Err(Failure::Name(_))), "{refused:?}");
    let m = windows(1);
    let state = turned(&m, 1, 0.0);
    assert!(matches!(linearize(&m, &state, (&[], &[]), false), Err(Failure::Singular { .. })));
}

/// A bar of a given mass that hangs from a pendulum, with or without a spring and a damper between them.
fn hung(mass: f64, spring: bool) -> (Model, State) {
    let mut text = format!(
        "{PENDULUM}[bodies.tail]\ntype = 'bar'\nmass = {mass}\nlength = 1\nends = ['P', 'Q']\n\
         [joints.P]\ntype = 'revolute'\ni = 'rod.P'\nj = 'tail.P'\n"
    );
    if spring {
        text += "[forces.s]\ntype = 'torsion_spring'\ni = 'rod'\nj = 'tail'\nstiffness = 3\ndamping = 0.1\n";
    }
    let m = model(&text);
    let state = start(&m, &[("rod.angle", "-pi/2"), ("tail.angle", "-pi/2")], &[]).0;
    (m, state)
}

#[test]
fn a_massless_body_without_a_determined_motion_is_refused() {
    for spring in [false, true] {
        let (m, state) = hung(0.0, spring);
        let failures = [
            linearize(&m, &state, (&[], &[]), false).expect_err("refused"),
            begins(&m, &state).expect_err("refused"),
        ];
        for failure in failures {
            let Failure::Motion(found) = &failure else { panic!("{failure:?}") };
            let Reason::Singular { name, message, .. } = &found.reason else { panic!("{found:?}") };
            assert!(
                name == "tail" && message.contains("no inertia resists tail.angle"),
                "{message}"
            );
        }
        let (m, state) = hung(1e-6, spring);
        assert_eq!(
            linearize(&m, &state, (&[], &[]), false).expect("with mass").coordinates,
            [2, 5]
        );
    }
}
