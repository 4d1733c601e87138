//! Elements whose physics are formulas of a model: every row of Φ_q, ν and γ against differences, and reactions.

use crate::mechanisms::{close, model, Random};
use kempe::elements::BodyId;
use kempe::equations::constraints::{jacobian, residual, velocity_terms};
use kempe::equations::kinematics::Motions;
use kempe::equations::reactions::{reaction, Frame};
use kempe::model::Model;

/// Laws of positions and time in joints and drivers; the formulas of `rows` and the law of `free` also name positions
/// from ground, all others relative positions only.
const LAWS: &str = r#"
[parameters]
p = 0.3
[bodies.ground]
points = { O = [0.5, -0.2] }
[bodies.a]
mass = 1
inertia = 1
points = { A = ["p", 0.1], S = [-0.2, 0.4] }
[bodies.b]
mass = 1
inertia = 1
points = { A = [-0.7, 0.6] }
[bodies.c]
mass = 1
inertia = 1
points = { C = [0.4, 0.9] }
[joints.pin]
type = "revolute"
i = "a.A"
j = "b.A"
[joints.slide]
type = "translational"
i = "a.S"
j = "b.A"
axes = ["2*p", 0.1]
[joints.cylinder]
type = "distance"
i = "a.S"
j = "c.C"
length = "2.4 + 0.1*sin(t)"
[joints.coupled]
type = "coupling"
terms = { "slide.displacement" = 2, "c.angle" = "-p", "pin.angle" = 0.4 }
value = "0.2*t^2"
[joints.related]
type = "coupling"
terms = { "slide.displacement" = -1.5, "pin.angle" = 0.4 }
[joints.rows]
type = "constraint"
residual = ["a.A.x*c.C.y - 0.3*t", "sin(pin.angle) - slide.displacement"]
units = ["m", "m"]
[drivers.shift]
type = "coordinate_driver"
coordinate = "slide.displacement"
value = "0.7*t + 0.1"
[drivers.point]
type = "coordinate_driver"
coordinate = "c.C.y"
value = "0.2*c.x + t"
[drivers.turn]
type = "coordinate_driver"
coordinate = "pin.angle"
value = "0.7*t + 0.1*t^3"
"#;

const T: f64 = 0.7;
const N: usize = 9;

fn moving(model: &Model, q: &[f64], v: &[f64]) -> Motions {
    let mut motions = Motions::new(&model.layout);
    motions.place(&model.layout, q, v);
    motions
}

fn phi(model: &Model, q: &[f64], t: f64) -> Vec<f64> {
    let mut out = vec![0.0; model.layout.n_rows];
    residual(model, &moving(model, q, &[0.0; N]), t, &mut out);
    out
}

/// Φ, Φ_q and the terms of velocity and acceleration at random states.
fn each(mut check: impl FnMut(&Model, &[f64; N], &[f64; N])) {
    let model = model(LAWS);
    let mut random = Random::new(3);
    for _ in 0..200 {
        let [q, v] = [(); 2].map(|()| std::array::from_fn(|_| 2.0 * random.next()));
        check(&model, &q, &v);
    }
}

#[test]
fn columns_are_differences() {
    let h = 1e-6;
    each(|model, q, v| {
        let mut entries = vec![0.0; model.layout.n_entries];
        jacobian(model, &moving(model, q, v), T, &mut entries);
        for slots in &model.layout.constraints {
            for block in &slots.blocks {
                for (c, column) in block.columns.range().enumerate() {
                    let at = |h: f64| {
                        let mut q = *q;
                        q[column] += h;
                        phi(model, &q, T)
                    };
                    let (up, down) = (at(h), at(-h));
                    for (r, row) in slots.rows.clone().enumerate() {
                        let stated = entries[block.row(r)][c];
                        close("Φ_q", stated, (up[row] - down[row]) / (2.0 * h), 2e-8);
                    }
                }
            }
        }
    });
}

#[test]
fn rates_and_gamma_are_differences_along_a_motion() {
    let h = 2e-3;
    each(|model, q, v| {
        let m = model.layout.n_rows;
        let [mut value, mut rate, mut gamma] = [(); 3].map(|()| vec![0.0; m]);
        velocity_terms(model, &moving(model, q, v), T, &mut value, &mut rate, &mut gamma);
        let later = |h: f64| -> Vec<f64> {
            let q: Vec<f64> = q.iter().zip(v).map(|(q, v)| q + h * v).collect();
            phi(model, &q, T + h)
        };
        let [a, b, here, c, d] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| later(k * h));
        for k in 0..m {
            let first = (a[k] - 8.0 * b[k] + 8.0 * c[k] - d[k]) / (12.0 * h);
            let second =
                (-a[k] + 16.0 * b[k] - 30.0 * here[k] + 16.0 * c[k] - d[k]) / (12.0 * h * h);
            close("Φ", value[k], here[k], 1e-13);
            close("Φ̇", rate[k], first, 1e-7);
            close("γ", gamma[k], -second, 1e-6);
        }
    });
}

/// The reaction of a relation between bodies is in equilibrium: it does no work in a common motion of all bodies.
#[test]
fn reactions_of_relative_quantities_balance() {
    each(|model, q, v| {
        let motions = moving(model, q, v);
        for name in ["cylinder", "related", "shift", "turn"] {
            let k = model.constraint(name).unwrap();
            let mut sum = [0.0; 3];
            for body in 1..4 {
                let found = reaction(model, k, BodyId(body), Frame::Global, &motions, T, &[1.7]);
                let Some(w) = found else { continue };
                let place = model.constraints[k].bodies.iter().position(|b| b.0 == body);
                let s = model.constraints[k].element.attachment(place.unwrap()).s;
                let p = motions[body].pose.point(s);
                sum[0] += w.force.x;
                sum[1] += w.force.y;
                sum[2] += w.torque + p.x * w.force.y - p.y * w.force.x;
            }
            sum.iter().for_each(|sum| close(name, *sum, 0.0, 1e-13));
        }
    });
}

/// λ = -1 on a displacement pushes body j with 1 N along the slide, at its point, and body i with the opposite.
#[test]
fn the_effort_of_a_driver_acts_between_the_bodies_of_its_quantity() {
    each(|model, q, v| {
        let motions = moving(model, q, v);
        let on = |name: &str, body: usize| {
            let k = model.constraint(name).unwrap();
            let w = reaction(model, k, BodyId(body), Frame::Global, &motions, T, &[-1.0]).unwrap();
            [w.force.x, w.force.y, w.torque]
        };
        let (sin, cos) = (q[2] + 0.6).sin_cos();
        let expected = [cos, sin, 0.0];
        for (k, expected) in expected.into_iter().enumerate() {
            close("shift", on("shift", 2)[k], expected, 1e-13);
        }
        close("shift", on("shift", 1)[0], -cos, 1e-13);
        close("turn", on("turn", 2)[2], 1.0, 1e-13);
        close("turn", on("turn", 1)[2], -1.0, 1e-13);
    });
}
