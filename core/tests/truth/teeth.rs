//! The radial force of gear teeth with a pressure angle, against closed forms.

use crate::mechanisms::{faults, model, run, start};
use crate::solved::{direction, same, same_vector, Solved};
use crate::wheels::planetary;
use kempe::analyses::dynamics::{Options, Scheme};
use kempe::integrate::{AlphaParameters, GeneralizedAlpha, Radau};
use kempe::math::Vec2;

const ALPHA: f64 = 0.35;

/// Two wheels on ground. The moments of inertia are 0.02 and 0.16 kg·m², the centres are in the direction 0.6.
fn pair(torque: f64, radii: [f64; 2], rest: &str) -> String {
    let [r_i, r_j] = radii;
    let apart = if rest.contains("internal") { (r_i - r_j).abs() } else { r_i + r_j };
    format!(
        r#"
[bodies.ground]
points = {{ A = [0.1, 0.2], B = ["0.1 + {apart}*cos(0.6)", "0.2 + {apart}*sin(0.6)"] }}
[bodies.one]
mass = 3
inertia = 0.02
points = {{ A = [0, 0] }}
[bodies.two]
mass = 5
inertia = 0.16
points = {{ B = [0, 0] }}
[joints.A]
type = "revolute"
i = "ground.A"
j = "one.A"
[joints.B]
type = "revolute"
i = "ground.B"
j = "two.B"
[joints.teeth]
type = "gear"
i = "one.A"
j = "two.B"
radii = [{r_i}, {r_j}]
{rest}
[forces.motor]
type = "torque"
j = "one"
torque = {torque}
"#
    )
}

/// Pin forces by hand: with T - J₁ α₁ = F r₁ the teeth press F across the line of centres and |F| tan α along it.
fn check(torque: f64, radii: [f64; 2], internal: bool) {
    let rest =
        format!("pressure_angle = {ALPHA}\n{}", if internal { "internal = true" } else { "" });
    let s = Solved::new(&pair(torque, radii, &rest), &[("one.omega", "4")], &[]);
    let sigma = if internal { -1.0 } else { 1.0 };
    let ratio = radii[0] / radii[1];
    let alpha = torque / (0.02 + 0.16 * ratio * ratio);
    same("α of one", s.of("one", 2)[2], alpha);
    let force = (torque - 0.02 * alpha) / radii[0];
    same("tangential", s.lam("teeth", 0), force);
    // pᵢ - p_j points from wheel j to wheel i only for external teeth: a ring and its wheel are pushed together
    let (along, across) = (direction(0.6), direction(0.6).perp());
    let sign = if internal { (radii[0] - radii[1]).signum() } else { 1.0 };
    let tangential = across.scale(sign * force);
    let on_two = tangential + along.scale(sigma * force.abs() * ALPHA.tan());
    same_vector("teeth on two", s.on("teeth", "two").force, on_two);
    same_vector("teeth on one", s.on("teeth", "one").force, -on_two);
    same("torque on two", s.on("teeth", "two").torque, -sigma * force * radii[1]);
    same("torque on one", s.on("teeth", "one").torque, -force * radii[0]);
    same("normal force", s.on("teeth", "two").force.norm(), force.abs() / ALPHA.cos());
    same_vector("pin A", s.on("A", "one").force, on_two);
    same_vector("pin B", s.on("B", "two").force, -on_two);
    same_vector("pin B on ground", s.on("B", "ground").force, on_two);
}

#[test]
fn external_teeth_push_their_wheels_apart_for_both_signs_of_the_torque() {
    for torque in [2.0, -2.0] {
        check(torque, [0.1, 0.25], false);
    }
}

#[test]
fn a_ring_and_its_wheel_are_pushed_together_whichever_is_named_first() {
    for torque in [2.0, -2.0] {
        check(torque, [0.1, 0.25], true);
        check(torque, [0.25, 0.1], true);
    }
}

const PRESSURE: &str = "pressure_angle = 0.35";

#[test]
fn a_planet_carries_the_difference_of_both_radial_forces() {
    let s = Solved::new(&planetary(PRESSURE), &[("sun.omega", "6"), ("carrier.angle", "0.8")], &[]);
    let (carrier, planet) = (0.2 / 0.6, -0.4 / 0.6 * 1.5);
    let swung = 0.05 + 0.7 * 0.3 * 0.3;
    let alpha = 1.5 / (0.03 + swung * carrier * carrier + 0.004 * planet * planet);
    let inner = (1.5 - 0.03 * alpha) / 0.2;
    let outer = inner + 0.004 * alpha * planet / 0.1;
    same("inner", s.lam("inner", 0), inner);
    same("outer", s.lam("outer", 0), outer);
    // the sun pushes the planet outwards, the ring inwards
    let (along, across) = (direction(0.8), direction(0.8).perp());
    let radial = (inner.abs() - outer.abs()) * ALPHA.tan();
    let teeth = along.scale(radial) + across.scale(inner + outer);
    let on_planet = s.on("inner", "planet").force + s.on("outer", "planet").force;
    same_vector("teeth", on_planet, teeth);
    let speed = 6.0 * carrier;
    let a = across.scale(0.3 * alpha * carrier) - along.scale(0.3 * speed * speed);
    same_vector("a", Vec2::new(s.of("planet", 0)[2], s.of("planet", 1)[2]), a);
    same_vector("pin P", s.on("P", "planet").force, a.scale(0.7) - teeth);
    let on_sun = across.scale(inner) + along.scale(inner.abs() * ALPHA.tan());
    same_vector("pin S", s.on("S", "sun").force, on_sun);
}

#[test]
fn the_motion_does_not_depend_on_the_pressure_angle() {
    let with = model(&planetary(PRESSURE));
    let without = model(&planetary(""));
    for method in [Options::new(1.0).method, Scheme::Radau(Radau::default())] {
        let end = |m| {
            let (state, _) = start(m, &[("sun.omega", "6")], &[]);
            run(m, &state, &Options { method: method.clone(), ..Options::new(1.0) }).trajectory.q
        };
        assert_eq!(end(&with), end(&without));
    }
}

#[test]
fn a_pressure_angle_of_a_right_angle_or_below_zero_is_refused() {
    for angle in ["90 deg", "-0.1"] {
        let text = pair(1.0, [0.1, 0.2], &format!("pressure_angle = \"{angle}\""));
        let message = faults(&text);
        assert!(message.contains("pressure_angle"), "{message}");
    }
}

/// Friction in pin B, which carries the radial force of the teeth too: F/cos α. The acceleration α₁ follows from
/// (J₁ + k² J₂) α₁ = T - k μ ρ |F|/cos α with k = r₁/r₂ and F = (T - J₁ α₁)/r₁.
#[test]
fn friction_in_a_pin_feels_the_radial_force_by_every_method() {
    let (k, mu, radius) = (0.1 / 0.25, 0.3, 0.05);
    let friction = format!(
        "pressure_angle = {ALPHA}\n[forces.rubs]\ntype = \"friction\"\njoint = \"B\"\nkinetic = {mu}\nradius = {radius}\nvelocity = 1e-4\n"
    );
    for torque in [2.0_f64, -2.0] {
        let m = model(&pair(torque, [0.1, 0.25], &friction));
        let part = torque.signum() * k * mu * radius / (0.1 * ALPHA.cos());
        let alpha = torque * (1.0 - part) / (0.02 + 0.16 * k * k - part * 0.02);
        let exact = 4.0 + 0.02 * alpha;
        let (state, _) = start(&m, &[("one.omega", "4")], &[]);
        let mut alpha_steps =
            GeneralizedAlpha::new(AlphaParameters::chung_hulbert(0.8), 1e-11, 1e-13);
        alpha_steps.control.step = Some(1e-3);
        for method in [
            Options::new(1.0).method,
            Scheme::Radau(Radau::default()),
            Scheme::GeneralizedAlpha(alpha_steps),
        ] {
            let found = run(&m, &state, &Options { method: method.clone(), ..Options::new(0.02) });
            let n = m.layout.n_q;
            let omega = found.trajectory.v.rchunks(n).next().expect("a row")[2];
            assert!((omega - exact).abs() < 1e-10 * exact, "{method:?}: {omega} {exact}");
            let energies = found.energies(&m).expect("finite");
            let total = |row: &[f64]| row[0] + row[1] + row[2] - row[3] - row[4];
            let (first, last) = (&energies[..5], energies.rchunks(5).next().expect("a row"));
            let change = total(last) - total(first);
            assert!(change.abs() < 1e-9 * first[0], "{method:?}: {change} J of {} J", first[0]);
        }
    }
}
