//! The tangent against differences of the balance, for every element, with laws of time and state.

use crate::mechanisms::{model, Random};
use kempe::equations::balance::Balance;
use kempe::equations::kinematics;
use kempe::equations::tangent::Tangent;
use kempe::model::Model;

/// All joints, all forces, frames off the mass centres, laws that name other bodies.
const EVERYTHING: &str = r#"
gravity = [0.3, -9.81]
[bodies.ground]
points = { O = [0.1, 0.2], P = [2, 0.4] }
[bodies.a]
mass = 1.5
inertia = 0.2
center = [0.3, -0.2]
points = { A = [0.1, 0], B = [1, 0.3] }
[bodies.b]
mass = 2
inertia = 0.4
center = [-0.1, 0.25]
points = { B = [-0.5, 0.1], C = [0.7, 0.2] }
[bodies.c]
mass = 0.7
inertia = 0.1
points = { C = [0, 0], D = [0.4, -0.3] }
[joints.pin]
type = "revolute"
i = "ground.O"
j = "a.A"
[joints.slide]
type = "translational"
i = "a.B"
j = "b.B"
[joints.rod]
type = "distance"
i = "b.C"
j = "c.C"
length = 0.9
[drivers.wave]
type = "coordinate_driver"
coordinate = "c.angle"
value = "0.3*sin(5*t) + 0.2*a.x*b.angle^2"
[forces.turn]
type = "torsion_spring"
i = "a"
j = "c"
stiffness = 3
damping = "0.2 + 0.1*sin(t)*b.omega^2"
free_angle = 0.4
[forces.pull]
type = "spring_damper"
i = "ground.P"
j = "c.D"
stiffness = 20
damping = 1.5
free_length = "0.5 + 0.1*b.vx"
[forces.between]
type = "spring_damper"
i = "a.B"
j = "c.C"
stiffness = 7
damping = 0.3
free_length = 0.2
[forces.motor]
type = "torque"
i = "b"
j = "a"
torque = "2*cos(3*t) - 0.5*c.x*a.omega"
"#;

struct At {
    q: Vec<f64>,
    v: Vec<f64>,
    a: Vec<f64>,
    lam: Vec<f64>,
}

impl At {
    fn random(m: &Model, seed: u64) -> Self {
        let (n, rows) = (m.layout.n_q, m.layout.n_rows);
        let mut random = Random::new(seed);
        Self { q: random.many(n), v: random.many(n), a: random.many(n), lam: random.many(rows) }
    }

    /// (r, Φ̇).
    fn residual(&self, m: &Model) -> (Vec<f64>, Vec<f64>) {
        let mut balance = Balance::new(m);
        balance.evaluate(m, 0.7, [&self.q, &self.v, &self.a, &[]], &self.lam);
        (balance.forces, balance.rate)
    }
}

/// A full matrix, row by row, from blocks (body, body).
fn full(n: usize, pairs: &[(usize, usize)], blocks: &[[[f64; 3]; 3]]) -> Vec<Vec<f64>> {
    let mut out = vec![vec![0.0; n]; n];
    for ((row, column), block) in pairs.iter().zip(blocks) {
        // the last owner may have fewer coordinates
        for r in 0..(n - 3 * row).min(3) {
            for c in 0..(n - 3 * column).min(3) {
                out[3 * row + r][3 * column + c] += block[r][c];
            }
        }
    }
    out
}

/// Central difference of fourth order of a function at 0.
fn derivative(mut f: impl FnMut(f64) -> Vec<f64>) -> Vec<f64> {
    let h = 1e-3;
    let [near, far] = [h, 2.0 * h].map(|h| {
        let (above, below) = (f(h), f(-h));
        above.iter().zip(below).map(|(a, b)| (a - b) / (2.0 * h)).collect::<Vec<f64>>()
    });
    near.iter().zip(far).map(|(near, far)| (4.0 * near - far) / 3.0).collect()
}

#[test]
fn the_tangent_is_the_derivative_of_the_balance() {
    agrees(EVERYTHING);
}

/// Two wheels on a carrier; friction in the pin of one depends on the radial force of the teeth.
const TEETH: &str = r#"
[bodies.carrier]
mass = 1
inertia = 0.4
points = { A = [0.1, 0.3], B = [0.5, 0.2] }
[bodies.one]
mass = 1.5
inertia = 0.2
points = { A = [0.02, 0] }
[bodies.two]
mass = 2
inertia = 0.4
points = { B = [0, 0.03] }
[joints.A]
type = "revolute"
i = "carrier.A"
j = "one.A"
[joints.B]
type = "revolute"
i = "carrier.B"
j = "two.B"
[joints.teeth]
type = "gear"
i = "one.A"
j = "two.B"
radii = [0.2, "sqrt(0.17) - 0.2"]
pressure_angle = 0.35
[forces.rubs]
type = "friction"
joint = "B"
kinetic = 0.3
radius = 0.05
velocity = 0.2
"#;

#[test]
fn the_tangent_contains_the_loads_of_joints() {
    agrees(TEETH);
    let m = model(TEETH);
    let (n, t) = (m.layout.n_q, 0.7);
    let at = At::random(&m, 8);
    let motions = kinematics::Motions::at(&m.layout, &at.q, &at.v);
    let mut tangent = Tangent::new(&m);
    tangent.linearize(&m, &motions, t, [&at.a, &at.lam, &[]]);
    for row in 0..m.layout.n_rows {
        let mut column = vec![0.0; n];
        for (_, column_of, place) in m.layout.positions().filter(|(r, ..)| *r == row) {
            column[column_of] += tangent.jacobian[place];
        }
        for entry in tangent.states.reactions.iter().filter(|entry| entry.at == row) {
            m.layout.owners[entry.owner].add(entry.values, &mut column);
        }
        let by_lam = |x: f64| {
            let mut lam = at.lam.clone();
            lam[row] += x;
            At { q: at.q.clone(), v: at.v.clone(), a: at.a.clone(), lam }.residual(&m).0
        };
        for (found, exact) in column.iter().zip(derivative(by_lam)) {
            assert!((found - exact).abs() < 1e-8, "row {row}: {found} {exact}");
        }
    }
}

/// A body on a curve, and laws of forces on it and on another body that use the parameter of the curve.
const ON_A_CURVE: &str = r#"
[bodies.rail]
mass = 3
inertia = 0.5
points = { O = [0.1, 0] }
curves = { hill = { x = "u", y = "0.3*u^2 - 0.1*u^3", range = [-5, 5] } }
[bodies.cart]
mass = 1.2
inertia = 0.3
center = [0.05, 0.1]
points = { P = [0.2, -0.1] }
[joints.contact]
type = "point_on_curve"
i = "cart.P"
curve = "rail.hill"
[forces.twist]
type = "torque"
i = "rail"
j = "cart"
torque = "0.7*sin(2*contact.u) - 0.3*contact.u*contact.u_rate + rail.omega*contact.u"
[forces.push]
type = "force"
j = "rail.O"
force = ["contact.u^2", "-contact.u_rate*cart.x"]
"#;

#[test]
fn the_tangent_contains_internal_coordinates_in_laws() {
    agrees(ON_A_CURVE);
}

/// K, D and B against differences at random states.
fn agrees(text: &str) {
    let m = model(text);
    let n = m.layout.n_q;
    let mut tangent = Tangent::new(&m);
    for seed in 1..6 {
        let at = At::random(&m, seed);
        let motions = kinematics::Motions::at(&m.layout, &at.q, &at.v);
        tangent.linearize(&m, &motions, 0.7, [&at.a, &at.lam, &[]]);
        let stiffness = full(n, tangent.pairs(), &tangent.stiffness);
        let damping = full(n, tangent.pairs(), &tangent.damping);
        let mut rate = vec![vec![0.0; n]; m.layout.n_rows];
        for (row, column, at) in m.layout.positions() {
            rate[row][column] = tangent.rate[at];
        }
        for c in 0..n {
            let by_q = |x: f64| {
                let mut q = at.q.clone();
                q[c] += x;
                let moved = At { q, v: at.v.clone(), a: at.a.clone(), lam: at.lam.clone() };
                let (mut r, phi) = moved.residual(&m);
                r.extend(phi);
                r
            };
            let by_v = |x: f64| {
                let mut v = at.v.clone();
                v[c] += x;
                let moved = At { q: at.q.clone(), v, a: at.a.clone(), lam: at.lam.clone() };
                moved.residual(&m).0
            };
            let (dq, dv) = (derivative(by_q), derivative(by_v));
            for r in 0..n {
                assert!(
                    (stiffness[r][c] - dq[r]).abs() < 1e-8,
                    "K {r} {c} {} {}",
                    stiffness[r][c],
                    dq[r]
                );
                assert!(
                    (damping[r][c] - dv[r]).abs() < 1e-8,
                    "D {r} {c} {} {}",
                    damping[r][c],
                    dv[r]
                );
            }
            for (r, row) in rate.iter().enumerate() {
                assert!((row[c] - dq[n + r]).abs() < 1e-8, "B {r} {c} {} {}", row[c], dq[n + r]);
            }
        }
    }
}

#[test]
fn products_with_the_tangent() {
    let m = model(EVERYTHING);
    let (n, rows) = (m.layout.n_q, m.layout.n_rows);
    let at = At::random(&m, 9);
    let motions = kinematics::Motions::at(&m.layout, &at.q, &at.v);
    let mut tangent = Tangent::new(&m);
    tangent.linearize(&m, &motions, 0.7, [&at.a, &at.lam, &[]]);
    let (x, s) = (Random::new(3).many(n), Random::new(4).many(n));
    let mut out = vec![0.0; n + rows];
    tangent.times(&m, [&x, &[], &s], &mut out);
    let along = |h: f64| {
        let q = at.q.iter().zip(&s).map(|(q, s)| q - h * s).collect();
        let a = at.a.iter().zip(&x).map(|(a, x)| a + h * x).collect();
        let (mut r, phi) = At { q, v: at.v.clone(), a, lam: at.lam.clone() }.residual(&m);
        r.extend(phi);
        r
    };
    for (found, expected) in out.iter().zip(derivative(along)) {
        assert!((found - expected).abs() < 1e-8, "{found} {expected}");
    }
}

/// Revolute joints do not couple bodies in K; blocks for them would waste time.
#[test]
fn only_what_an_element_couples_has_a_block() {
    let m = model(EVERYTHING);
    let tangent = Tangent::new(&m);
    let column = |name: &str| m.body(name).expect("a body").0 - 1;
    let has = |a: &str, b: &str| tangent.pairs().contains(&(column(a), column(b)));
    assert!(has("a", "b") && has("b", "c") && has("a", "c") && has("c", "a"));
    let four_bar = model(crate::mechanisms::FOUR_BAR);
    assert_eq!(Tangent::new(&four_bar).pairs(), [(0, 0), (1, 1), (2, 2)]);
}
