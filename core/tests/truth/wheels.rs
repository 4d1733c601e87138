//! Gears, belts, racks and rolling wheels against closed forms: positions, velocities, accelerations and reactions.

use crate::mechanisms::{column, model, run, start, tolerances};
use crate::solved::{direction, same, same_vector, Solved, G};
use kempe::analyses::dynamics::{Options, Scheme};
use kempe::integrate::Dop853;
use kempe::math::Vec2;

/// Three wheels on ground; the second has another row of teeth in mesh with the third.
const TRAIN: &str = r#"
gravity = [0, -9.81]
[bodies.ground]
points = { A = [0, 0], B = ["0.35*cos(0.6)", "0.35*sin(0.6)"], C = ["0.35*cos(0.6)", "0.35*sin(0.6) + 0.2"] }
[bodies.one]
mass = 3
inertia = 0.02
points = { A = [0, 0] }
[bodies.two]
mass = 5
inertia = 0.16
points = { B = [0, 0] }
[bodies.three]
mass = 2
inertia = 0.03
points = { C = [0, 0] }
[joints.A]
type = "revolute"
i = "ground.A"
j = "one.A"
[joints.B]
type = "revolute"
i = "ground.B"
j = "two.B"
[joints.C]
type = "revolute"
i = "ground.C"
j = "three.C"
[joints.first]
type = "gear"
i = "one.A"
j = "two.B"
radii = [0.1, 0.25]
[joints.second]
type = "gear"
i = "two.B"
j = "three.C"
teeth = [20, 20]
module = 0.01
offset = 0.03
[forces.motor]
type = "torque"
j = "one"
torque = 2
"#;

#[test]
fn a_gear_train_has_an_equivalent_inertia_and_its_pins_carry_the_teeth() {
    let s = Solved::new(TRAIN, &[("one.angle", "0.7"), ("one.omega", "3")], &[]);
    let (theta, up) = (0.6, std::f64::consts::FRAC_PI_2);
    let two = theta - 0.1 / 0.25 * (0.7 - theta);
    // the angle of a wheel is one of those that put a tooth into a gap
    let pitch = std::f64::consts::TAU * 0.35 / 0.25;
    let turns = ((s.of("two", 2)[0] - two) / pitch).round();
    same("angle of two", s.of("two", 2)[0], two + turns * pitch);
    let three = up + 0.3 - (s.of("two", 2)[0] - up);
    let turns = ((s.of("three", 2)[0] - three) / (2.0 * std::f64::consts::TAU)).round();
    same("angle of three", s.of("three", 2)[0], three + turns * 2.0 * std::f64::consts::TAU);
    same("ω of two", s.of("two", 2)[1], -1.2);
    same("ω of three", s.of("three", 2)[1], 1.2);
    let alpha = 2.0 / (0.02 + (0.16 + 0.03) * 0.16);
    same("α of one", s.of("one", 2)[2], alpha);
    same("α of two", s.of("two", 2)[2], -0.4 * alpha);
    same("α of three", s.of("three", 2)[2], 0.4 * alpha);
    // J α of each wheel is the sum of the torques on it
    let first = (2.0 - 0.02 * alpha) / 0.1;
    let second = -0.03 * 0.4 * alpha / 0.1;
    same("first tooth force", s.lam("first", 0), first);
    same("second tooth force", s.lam("second", 0), second);
    let across = direction(theta).perp();
    let on_two = s.on("first", "two");
    same_vector("force of the teeth", on_two.force, across.scale(first));
    same("torque of the teeth", on_two.torque, -first * 0.25);
    same_vector("reaction of the teeth", s.on("first", "one").force, across.scale(-first));
    let weight = |m: f64| Vec2::new(0.0, m * G);
    same_vector("pin A", s.on("A", "one").force, weight(3.0) + across.scale(first));
    let other = direction(up).perp().scale(second);
    same_vector("pin B", s.on("B", "two").force, weight(5.0) + across.scale(-first) + other);
    same_vector("pin C", s.on("C", "three").force, weight(2.0) + -other);
}

/// Sun, one planet on a carrier, and a ring on ground.
const PLANETARY: &str = r#"
[bodies.ground]
points = { O = [0, 0] }
[bodies.sun]
mass = 2
inertia = 0.03
points = { O = [0, 0] }
[bodies.carrier]
mass = 1
inertia = 0.05
points = { O = [0, 0], P = [0.3, 0] }
[bodies.planet]
mass = 0.7
inertia = 0.004
points = { P = [0, 0] }
[joints.S]
type = "revolute"
i = "ground.O"
j = "sun.O"
[joints.C]
type = "revolute"
i = "ground.O"
j = "carrier.O"
[joints.P]
type = "revolute"
i = "carrier.P"
j = "planet.P"
[joints.inner]
type = "gear"
i = "sun.O"
j = "planet.P"
radii = [0.2, 0.1]
TEETH
[joints.outer]
type = "gear"
i = "ground.O"
j = "planet.P"
radii = [0.4, 0.1]
internal = true
TEETH
[forces.motor]
type = "torque"
j = "sun"
torque = 1.5
"#;

/// The set with a torque on the sun and further fields of both gears.
pub fn planetary(teeth: &str) -> String {
    PLANETARY.replace("TEETH", teeth)
}

#[test]
fn a_planetary_set_follows_willis_with_its_inertias() {
    let s = Solved::new(&planetary(""), &[("sun.omega", "6")], &[]);
    let (carrier, planet) = (0.2 / 0.6, 0.2 / 0.6 * (1.0 - 4.0));
    same("ω of the carrier", s.of("carrier", 2)[1], 6.0 * carrier);
    same("ω of the planet", s.of("planet", 2)[1], 6.0 * planet);
    let swung = 0.05 + 0.7 * 0.3 * 0.3;
    let equivalent = 0.03 + swung * carrier * carrier + 0.004 * planet * planet;
    let alpha = 1.5 / equivalent;
    same("α of the sun", s.of("sun", 2)[2], alpha);
    same("α of the carrier", s.of("carrier", 2)[2], alpha * carrier);
    same("α of the planet", s.of("planet", 2)[2], alpha * planet);
    let inner = (1.5 - 0.03 * alpha) / 0.2;
    same("inner teeth", s.lam("inner", 0), inner);
    let outer = inner + 0.004 * alpha * planet / 0.1;
    same("outer teeth", s.lam("outer", 0), outer);
    // the carrier turns by the force of the planet's pin
    let arm = direction(s.of("carrier", 2)[0]).scale(0.3);
    same("pin P", arm.cross(s.on("P", "carrier").force), 0.05 * alpha * carrier);
    // the sum of the reactions on the planet is m a
    let teeth = s.on("inner", "planet").force + s.on("outer", "planet").force;
    let sum = teeth + s.on("P", "planet").force;
    same_vector("m a", sum, Vec2::new(s.of("planet", 0)[2], s.of("planet", 1)[2]).scale(0.7));
}

#[test]
fn a_planetary_set_stays_in_mesh_for_many_turns_of_its_carrier() {
    let model = model(&planetary(""));
    let (state, _) = start(&model, &[], &[]);
    let method = Scheme::Dop853(Dop853::new(1e-12, 1e-14));
    let run = run(&model, &state, &Options { method, ..Options::new(5.0) });
    let n = model.layout.n_q;
    let end = &run.trajectory.q[run.trajectory.q.len() - n..];
    let carrier = 0.2 / 0.6;
    let equivalent = 0.03 + 0.113 * carrier * carrier + 0.004;
    let turned = 0.5 * 1.5 / equivalent * 25.0;
    let by = |body: &str| {
        let k = column(&model, body, 2);
        end[k] - state.q[k]
    };
    assert!(turned * carrier > 20.0 * std::f64::consts::TAU);
    same("sun", by("sun") / turned, 1.0);
    same("carrier", by("carrier") / turned, carrier);
    same("planet", by("planet") / turned, -1.0);
}

/// A rack on a slope of ground and a pinion with the given radius.
fn rack(radius: f64) -> String {
    let line = r#"
gravity = [0, -9.81]
[bodies.ground]
points = { O = [0, 0], P = ["-R*sin(0.4)", "R*cos(0.4)"] }
[bodies.rack]
mass = 3
inertia = 0.1
points = { S = [0, 0] }
[bodies.pinion]
mass = 1
inertia = 0.02
points = { P = [0, 0] }
[joints.slide]
type = "translational"
i = "ground.O"
j = "rack.S"
axes = [0.4, 0]
[joints.P]
type = "revolute"
i = "ground.P"
j = "pinion.P"
[joints.teeth]
type = "rack"
i = "rack.S"
j = "pinion.P"
radius = "R"
"#;
    format!("{line}[parameters]\nR = {radius}\n")
}

#[test]
fn a_rack_turns_its_pinion() {
    for radius in [0.15, -0.15] {
        let s = Solved::new(&rack(radius), &[("rack.x", "0.2"), ("pinion.omega", "2")], &[]);
        let along = |k: usize| {
            let [x, y] = [0, 1].map(|c| s.of("rack", c)[k]);
            x * 0.4_f64.cos() + y * 0.4_f64.sin()
        };
        same("position", along(0), 0.2 / 0.4_f64.cos());
        same("angle", s.of("pinion", 2)[0], 0.4 + along(0) / radius);
        same("speed", along(1), 2.0 * radius);
        let a = -3.0 * G * 0.4_f64.sin() / (3.0 + 0.02 / (radius * radius));
        same("acceleration", along(2), a);
        same("α", s.of("pinion", 2)[2], a / radius);
        let force = -0.02 * a / (radius * radius);
        same("tooth force", s.lam("teeth", 0), force);
        same_vector("on the rack", s.on("teeth", "rack").force, direction(0.4).scale(force));
        same("on the pinion", s.on("teeth", "pinion").torque, -force * radius);
        let pin = s.on("P", "pinion").force;
        same_vector("pin", pin, Vec2::new(0.0, G) + direction(0.4).scale(force));
    }
}

fn belt(radii: [f64; 2], crossed: bool) -> String {
    let line = r#"
[bodies.ground]
points = { A = [0, 0], B = ["0.6*cos(2.8)", "0.6*sin(2.8)"] }
[bodies.one]
mass = 3
inertia = 0.02
points = { A = [0, 0] }
[bodies.two]
mass = 5
inertia = 0.16
points = { B = [0, 0] }
[joints.A]
type = "revolute"
i = "ground.A"
j = "one.A"
[joints.B]
type = "revolute"
i = "ground.B"
j = "two.B"
[forces.motor]
type = "torque"
j = "one"
torque = 2
[joints.belt]
type = "belt"
i = "one.A"
j = "two.B"
"#;
    format!("{line}radii = {radii:?}\ncrossed = {crossed}\n")
}

#[test]
fn a_belt_open_and_crossed() {
    for (radii, crossed) in [([0.1, 0.25], false), ([0.1, 0.25], true), ([0.2, 0.2], false)] {
        let s = Solved::new(&belt(radii, crossed), &[("one.omega", "5")], &[]);
        let sigma = if crossed { 1.0 } else { -1.0 };
        let ratio = -sigma * radii[0] / radii[1];
        same("ω", s.of("two", 2)[1], 5.0 * ratio);
        let alpha = 2.0 / (0.02 + 0.16 * ratio * ratio);
        same("α of one", s.of("one", 2)[2], alpha);
        same("α of two", s.of("two", 2)[2], ratio * alpha);
        let force = (2.0 - 0.02 * alpha) / radii[0];
        same("strands", s.lam("belt", 0), force);
        let across = direction(2.8).perp().scale((radii[0] + sigma * radii[1]) / 0.6 * force);
        same_vector("pin A", s.on("A", "one").force, across);
        same_vector("pin B", s.on("B", "two").force, -across);
        same("torque on two", s.on("belt", "two").torque, -sigma * force * radii[1]);
    }
}

fn incline(radius: f64) -> String {
    let line = r#"
gravity = [0, -9.81]
[bodies.ground]
points = { O = [0.3, 2] }
[bodies.disc]
mass = 4
inertia = 0.05
points = { P = [0, 0] }
[joints.floor]
type = "rolling"
i = "ground.O"
j = "disc.P"
axis = -0.5
"#;
    format!("{line}radius = {radius}\n")
}

#[test]
fn a_disc_rolls_down_an_incline_on_it_and_below_it() {
    for radius in [0.2, -0.2] {
        let s = Solved::new(&incline(radius), &[], &[]);
        let (u, n) = (direction(-0.5), direction(-0.5).perp());
        let centre = Vec2::new(0.3, 2.0) + n.scale(radius);
        same_vector("centre", Vec2::new(s.of("disc", 0)[0], s.of("disc", 1)[0]), centre);
        let share = 0.05 / (4.0 * radius * radius);
        let a = G * 0.5_f64.sin() / (1.0 + share);
        let is = Vec2::new(s.of("disc", 0)[2], s.of("disc", 1)[2]);
        same_vector("acceleration", is, u.scale(a));
        same("α", s.of("disc", 2)[2], -a / radius);
        same("normal force", -s.lam("floor", 0), 4.0 * G * 0.5_f64.cos());
        same("friction", s.lam("floor", 1), 4.0 * a * share);
        let on = s.on("floor", "disc");
        let normal = n.scale(4.0 * G * 0.5_f64.cos());
        same_vector("force", on.force, normal + u.scale(-4.0 * a * share));
        same("torque", on.torque, -4.0 * a * share * radius);
        // the force acts at the point of contact: none of its moment about that point is left
        same("moment at the contact", on.torque + n.scale(radius).cross(on.force), 0.0);
        let run = run(&s.model, &s.state, &tolerances(2.0, 1e-12, 1e-14));
        let end = &run.trajectory.q[run.trajectory.q.len() - 3..];
        let travelled = u.scale(2.0 * a);
        same_vector("end", Vec2::new(end[0], end[1]), centre + travelled);
        same("angle at the end", end[2] - s.state.q[2], -2.0 * a / radius);
    }
}
