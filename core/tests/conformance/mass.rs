//! The mass matrix and the φ̇² term against their definition: a frame off the mass centre must give
//! the motion of the same body with its frame at the centre.

use crate::mechanisms::{close, model, run, start, tolerances, worst, Random};
use kempe::elements::BodyId;
use kempe::equations::{energy, kinematics, mass, Compiled};
use kempe::math::{Dual, Lift};
use kempe::model::Model;

/// A double pendulum whose frames are off the mass centres by `c1` and `c2`; the mechanism is the
/// same for all of them.
fn pendulum([x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) -> Model {
    let points = |name: &str, list: &[(&str, f64, f64)], [cx, cy]: [f64; 2]| {
        let points: Vec<String> =
            list.iter().map(|(n, x, y)| format!("{n} = [{}, {}]", x + cx, y + cy)).collect();
        format!(
            "[bodies.{name}]\nmass = 1.5\ninertia = 0.4\ncenter = [{cx}, {cy}]\npoints = {{ {} }}\n",
            points.join(", ")
        )
    };
    model(&format!(
        r#"
gravity = [0.5, -9.81]
[bodies.ground]
points = {{ O = [0, 0] }}
{}{}
[joints.A]
type = "revolute"
i = "ground.O"
j = "upper.A"
[joints.B]
type = "revolute"
i = "upper.B"
j = "lower.B"
[forces.spring]
type = "torsion_spring"
i = "upper"
j = "lower"
stiffness = 6
damping = 0.1
"#,
        points("upper", &[("A", -0.5, 0.1), ("B", 0.6, -0.2)], [x1, y1]),
        points("lower", &[("B", -0.3, 0.3)], [x2, y2]),
    ))
}

#[test]
fn a_frame_off_the_centre_moves_as_the_centred_one() {
    let ask = [
        ("upper.angle", "0.3"),
        ("lower.angle", "-0.9"),
        ("upper.omega", "2"),
        ("lower.omega", "-3"),
    ];
    let (centred, off) = (pendulum([0.0; 2], [0.0; 2]), pendulum([0.4, -0.7], [-1.1, 0.25]));
    let runs = [&centred, &off].map(|m| {
        let (state, _) = start(m, &ask, &[]);
        let run = run(m, &state, &tolerances(2.0, 1e-11, 1e-13));
        let (found, energies) = (run.accelerations(m).unwrap(), run.energies(m).unwrap());
        let last = |table: &[f64], n: usize| table[table.len() - n..].to_vec();
        let (q, v) = (last(&run.trajectory.q, 6), last(&run.trajectory.v, 6));
        (q, v, last(&found.a, 6), last(&found.lam, 4), last(&energies, 5))
    });
    let q = runs.each_ref().map(|r| &r.0);
    let v = runs.each_ref().map(|r| &r.1);
    let a = runs.each_ref().map(|r| &r.2);
    let lam = runs.each_ref().map(|r| &r.3);
    for angle in [2, 5] {
        close("angle", q[1][angle], q[0][angle], 1e-8);
        close("omega", v[1][angle], v[0][angle], 1e-8);
        close("alpha", a[1][angle], a[0][angle], 1e-6);
    }
    assert!(worst(lam[1], lam[0]) < 1e-6);
    let motions = kinematics::Motions::at(&off.layout, q[1], v[1]);
    for body in [1, 2] {
        let centre = motions[body].pose.point(off.bodies[body].center);
        close("x of the centre", centre.x, q[0][3 * body - 3], 1e-8);
        close("y of the centre", centre.y, q[0][3 * body - 2], 1e-8);
    }
    assert!(worst(&runs[1].4, &runs[0].4) < 1e-7);
}

#[test]
fn m_is_the_second_derivative_of_the_kinetic_energy() {
    type D = Dual<3, Dual<3>>;
    let m = pendulum([0.4, -0.7], [-1.1, 0.25]);
    let wide: Model<D> = m.lift::<Dual<3>>().lift::<D>();
    let mut numbers = Random::new(5);
    let (q, v) = (numbers.many(6), numbers.many(6));
    let lifted: Vec<D> = q.iter().map(|q| D::lift(Dual::lift(*q))).collect();
    let plain = kinematics::Motions::at(&m.layout, &q, &v);
    for (outer, inner) in [(1, 1), (1, 2), (2, 1), (2, 2)] {
        // derivatives by the rates of one body, of derivatives by those of another or the same
        let seeded = |(k, v): (usize, &f64)| {
            let (body, c) = (k / 3 + 1, k % 3);
            let value = if body == inner { Dual::variable(*v, c) } else { Dual::lift(*v) };
            if body == outer {
                D::variable(value, c)
            } else {
                D::lift(value)
            }
        };
        let seeded: Vec<D> = v.iter().enumerate().map(seeded).collect();
        let motions = kinematics::Motions::at(&wide.layout, &lifted, &seeded);
        let kinetic = energy::kinetic(&wide, &motions);
        let block = mass::block(&m.bodies[outer], &plain[outer]);
        for column in 0..3 {
            let unit = std::array::from_fn(|k| f64::from(u8::from(k == column)));
            for (row, entry) in block.times(unit).into_iter().enumerate() {
                let found = kinetic.slope[row].slope[column];
                match outer == inner {
                    true => close("M", found, entry, 1e-13),
                    false => close("coupling of bodies", found, 0.0, 0.0),
                }
            }
        }
    }
    assert_eq!(m.body("lower"), Some(BodyId(2)));
}

/// Lagrange: Q of the frame's φ̇² term is ∂T/∂q - Ṁ q̇.
#[test]
fn the_quadratic_term_is_that_of_lagrange() {
    let mut m = pendulum([0.4, -0.7], [-1.1, 0.25]);
    m.gravity = kempe::math::Vec2::zero();
    m.forces.clear();
    let mut numbers = Random::new(6);
    let (q, v) = (numbers.many(6), numbers.many(6));
    let at = |q: &[f64]| kinematics::Motions::at(&m.layout, q, &v);
    let momentum = |q: &[f64]| -> Vec<f64> {
        let motions = at(q);
        (1..3)
            .flat_map(|b| {
                let v: [f64; 3] = std::array::from_fn(|c| v[3 * (b - 1) + c]);
                mass::block(&m.bodies[b], &motions[b]).times(v)
            })
            .collect()
    };
    let h = 1e-5;
    let moved = |h: f64| q.iter().zip(&v).map(|(q, v)| q + h * v).collect::<Vec<_>>();
    let (after, before) = (momentum(&moved(h)), momentum(&moved(-h)));
    let mut force = vec![0.0; 6];
    let acting = kempe::equations::forces::Acting { z: &[], lam: None, t: 0.0 };
    let powers = &mut kempe::equations::Powers::zero();
    kempe::equations::forces::generalized(
        &m,
        &Compiled::new(&m),
        &at(&q),
        acting,
        &mut force,
        powers,
    );
    for k in 0..6 {
        let shifted = |h: f64| {
            let mut q = q.clone();
            q[k] += h;
            energy::kinetic(&m, &at(&q))
        };
        let slope = (shifted(h) - shifted(-h)) / (2.0 * h);
        close("Q", force[k], slope - (after[k] - before[k]) / (2.0 * h), 1e-8);
    }
}
