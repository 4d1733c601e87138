//! Quantities of points and elements in laws and drivers.
//!
//! A torque whose law is a quantity has that value; it is compared with a formula written down by hand.

use crate::mechanisms::{close, faults, model, start};
use kempe::elements::{BodyId, QuantityKind};
use kempe::equations::forces::{each_wrench, Acting};
use kempe::equations::kinematics::Motions;
use kempe::expression::unit::Unit;
use kempe::model::Model;

/// Bodies a and b with every kind of element between them, and `probe`, a torque on a third body.
fn between(law: &str) -> String {
    format!(
        r#"
[parameters]
p = 0.3
[bodies.ground]
points = {{ O = [0.5, -0.2] }}
[bodies.a]
mass = 1
inertia = 1
points = {{ A = ["p", 0.1], S = [-0.2, 0.4] }}
[bodies.b]
mass = 1
inertia = 1
points = {{ A = [-0.7, 0.6] }}
[bodies.c]
mass = 1
inertia = 1
[joints.pin]
type = "revolute"
i = "a.A"
j = "b.A"
[joints.slide]
type = "translational"
i = "a.S"
j = "b.A"
axes = ["2*p", 0.1]
[joints.rod]
type = "distance"
i = "ground.O"
j = "b.A"
length = "0.4 + 0.1*t"
[forces.coil]
type = "torsion_spring"
i = "a"
j = "b"
stiffness = 3
[forces.spring]
type = "spring_damper"
i = "a.S"
j = "b.A"
stiffness = 2
[forces.probe]
type = "torque"
j = "c"
torque = "{law}"
"#
    )
}

const Q: [f64; 9] = [0.3, -0.8, 0.7, 1.1, 0.4, -2.3, 0.0, 0.0, 0.0];
const V: [f64; 9] = [0.2, 0.5, -1.7, -0.6, 0.9, 2.4, 0.0, 0.0, 0.0];

/// The torque of `probe` at (q, v), N·m.
fn probe(model: &Model, q: &[f64], v: &[f64]) -> f64 {
    let mut motions = Motions::new(&model.layout);
    motions.place(&model.layout, q, v);
    let acting = Acting { z: &[], lam: None, t: 0.0 };
    let k = model.force("probe").unwrap();
    let mut torque = 0.0;
    each_wrench(model, k, &motions, acting, |_, body, wrench| {
        if body == BodyId(3) {
            torque += wrench.torque;
        }
    });
    torque
}

/// Global position of a point of a body of [`Q`].
fn point(q: &[f64], body: usize, s: [f64; 2]) -> [f64; 2] {
    let [x, y, angle] = q[3 * body..][..3] else { unreachable!() };
    let (sin, cos) = angle.sin_cos();
    [x + cos * s[0] - sin * s[1], y + sin * s[0] + cos * s[1]]
}

/// Each position quantity with its rate, and its value by hand.
fn by_hand(q: &[f64]) -> Vec<(&'static str, &'static str, f64)> {
    let (a_s, b_a) = (point(q, 0, [-0.2, 0.4]), point(q, 1, [-0.7, 0.6]));
    let a_a = point(q, 0, [0.3, 0.1]);
    let d = [b_a[0] - a_s[0], b_a[1] - a_s[1]];
    let slide = q[2] + 0.6;
    vec![
        ("pin.angle", "pin.omega", q[5] - q[2]),
        ("coil.angle", "coil.omega", q[5] - q[2]),
        ("slide.displacement", "slide.rate", slide.cos() * d[0] + slide.sin() * d[1]),
        ("spring.length", "spring.rate", d[0].hypot(d[1])),
        ("rod.length", "rod.rate", (b_a[0] - 0.5).hypot(b_a[1] + 0.2)),
        ("a.A.x", "a.A.vx", a_a[0]),
        ("b.A.y", "b.A.vy", b_a[1]),
        ("ground.O.y", "ground.O.vy", -0.2),
        ("probe.angle", "probe.omega", q[8]),
    ]
}

#[test]
fn a_law_sees_each_quantity_and_its_rate() {
    let h = 1e-3;
    let moved = |by: f64| -> Vec<f64> { Q.iter().zip(V).map(|(q, v)| q + by * v).collect() };
    let near = [-2.0, -1.0, 1.0, 2.0].map(|k| by_hand(&moved(k * h)));
    for (k, (position, rate, value)) in by_hand(&Q).into_iter().enumerate() {
        let at = |law: &str| probe(&model(&between(law)), &Q, &V);
        close(position, at(position), value, 1e-14);
        let [a, b, c, d] = near.each_ref().map(|values| values[k].2);
        close(rate, at(rate), (a - 8.0 * b + 8.0 * c - d) / (12.0 * h), 1e-10);
    }
}

#[test]
fn a_force_uses_its_own_quantities_without_a_name() {
    let found = probe(&model(&between("50 + 10*abs(angle) - 2*omega")), &Q[..], &V[..]);
    let mut q = Q;
    q[8] = -0.4;
    let mut v = V;
    v[8] = 0.3;
    let turned = probe(&model(&between("50 + 10*abs(angle) - 2*omega")), &q, &v);
    close("at rest", found, 50.0, 1e-14);
    close("turned", turned, 50.0 + 4.0 - 0.6, 1e-14);
}

#[test]
fn a_parameter_with_the_name_of_an_own_quantity_is_refused_and_the_remedies_work() {
    let text = between("angle").replace("p = 0.3", "p = 0.3\nangle = 2");
    let found = faults(&text);
    assert!(found.contains("'angle' is a parameter and a quantity of 'probe'"), "{found}");
    assert_eq!(faults(&text.replace("\"angle\"", "\"probe.angle\"")), "");
    assert_eq!(
        faults(&text.replace("\nangle = 2", "\nphi = 2").replace("\"angle\"", "\"phi\"")),
        ""
    );
}

#[test]
fn an_unknown_quantity_gets_a_suggestion() {
    let found = faults(&between("slide.displacment"));
    assert!(found.contains("slide.displacement"), "{found}");
}

/// A slider on a driven line, and a quantity of it driven.
fn driven(coordinate: &str, value: &str) -> String {
    format!(
        r#"
gravity = [0, -9.81]
[bodies.ground]
points = {{ O = [0, 0] }}
[bodies.arm]
type = "bar"
mass = 2
length = 1
ends = ["O", "P"]
[bodies.block]
mass = 0.5
inertia = 0.01
points = {{ C = [0, 0], K = [0.1, 0.2] }}
[joints.O]
type = "revolute"
i = "ground.O"
j = "arm.O"
[joints.slide]
type = "translational"
i = "arm.O"
j = "block.C"
[drivers.turn]
type = "coordinate_driver"
coordinate = "O.angle"
value = "0.4 + 2*t"
[drivers.push]
type = "coordinate_driver"
coordinate = "{coordinate}"
value = "{value}"
"#
    )
}

#[test]
fn drivers_follow_quantities_of_joints_and_points() {
    let (sin, cos) = 0.4_f64.sin_cos();
    for (coordinate, value, u) in [
        ("slide.displacement", "0.7 + 0.1*t", 0.7),
        // K is 0.1 along and 0.2 beside the arm
        ("block.K.x", "0.3", (0.3 + 0.2 * sin) / cos - 0.1),
        ("block.K.y", "0.5", (0.5 - 0.2 * cos) / sin - 0.1),
    ] {
        let m = model(&driven(coordinate, value));
        let (state, _) = start(&m, &[], &[("block.x", "0.6"), ("block.y", "0.3")]);
        close("arm", state.q[2], 0.4, 1e-12);
        close(coordinate, state.q[3], u * cos, 1e-12);
        close(coordinate, state.q[4], u * sin, 1e-12);
    }
}

#[test]
fn a_driver_of_an_unsuitable_quantity_is_refused() {
    for (coordinate, message) in [
        ("slide.rate", "'rate' is not a position quantity of 'slide'"),
        ("slide.angle", "'angle' is not a position quantity of 'slide'"),
        ("ground.O.x", "'ground.O.x' does not move"),
        ("nothing.x", "unknown body 'nothing'"),
    ] {
        let found = faults(&driven(coordinate, "1"));
        assert!(found.contains(message), "{coordinate}: {found}");
    }
}

/// Effort times quantity is an energy; a number has no unit.
#[test]
fn an_effort_along_a_quantity_does_work() {
    let joule = Unit::parse("J").unwrap().dimension;
    for kind in [QuantityKind::Length, QuantityKind::Angle, QuantityKind::Pure] {
        let factor = if kind == QuantityKind::Pure { "" } else { &format!("*{}", kind.unit()) };
        let product = format!("{}{factor}", kind.unit_of_effort());
        assert_eq!(Unit::parse(&product).unwrap().dimension, joule, "{product}");
        assert_eq!(kind.unit_of_rate(2), format!("{}/s^2", kind.unit()));
    }
}
