//! Pins in slots and welds against closed forms: positions, velocities, accelerations and reactions.

use crate::solved::{direction, same, same_vector, Solved, G};
use kempe::math::Vec2;

/// A yoke on a slide with an upright slot, and a crank that turns evenly.
const YOKE: &str = r#"
[bodies.ground]
points = { O = [0, 0] }
[bodies.crank]
mass = 1
inertia = 0.01
points = { O = [0, 0], P = [0.2, 0] }
[bodies.yoke]
mass = 3
inertia = 0.1
points = { S = [0, 0] }
[joints.O]
type = "revolute"
i = "ground.O"
j = "crank.O"
[joints.guide]
type = "translational"
i = "ground.O"
j = "yoke.S"
[joints.slot]
type = "pin_in_slot"
i = "yoke.S"
j = "crank.P"
axis = "90*deg"
[drivers.motor]
type = "coordinate_driver"
coordinate = "crank.angle"
value = "0.3 + 7*t"
"#;

#[test]
fn a_scotch_yoke_moves_harmonically() {
    let s = Solved::new(YOKE, &[], &[]);
    let (sin, cos) = (0.3_f64.sin(), 0.3_f64.cos());
    same("x", s.of("yoke", 0)[0], 0.2 * cos);
    same("v", s.of("yoke", 0)[1], -0.2 * 7.0 * sin);
    let a = -0.2 * 49.0 * cos;
    same("a", s.of("yoke", 0)[2], a);
    same_vector("pin on the yoke", s.on("slot", "yoke").force, Vec2::new(3.0 * a, 0.0));
    same_vector("pin on the crank", s.on("slot", "crank").force, Vec2::new(-3.0 * a, 0.0));
    // the torque on the yoke about its point, where the pin is above it
    same("torque on the yoke", s.on("slot", "yoke").torque, -3.0 * a * 0.2 * sin);
    same("guide", s.on("guide", "yoke").torque, 3.0 * a * 0.2 * sin);
    same("effort", -s.lam("motor", 0), 3.0 * a * -0.2 * sin);
}

/// One slot of a Geneva wheel with four slots, and the driver that turns it.
fn geneva(angle: f64) -> String {
    let line = r#"
[parameters]
r = 0.1
c = "r*sqrt(2)"
[bodies.ground]
points = { A = [0, 0], B = ["c", 0] }
[bodies.driver]
mass = 1
inertia = 0.01
points = { A = [0, 0], P = ["r", 0] }
[bodies.wheel]
mass = 2
inertia = 0.04
points = { B = [0, 0] }
[joints.A]
type = "revolute"
i = "ground.A"
j = "driver.A"
[joints.B]
type = "revolute"
i = "ground.B"
j = "wheel.B"
[joints.slot]
type = "pin_in_slot"
i = "wheel.B"
j = "driver.P"
[drivers.motor]
type = "coordinate_driver"
coordinate = "driver.angle"
"#;
    format!("{line}value = \"{angle} + 3*t\"\n")
}

#[test]
fn one_engagement_of_a_geneva_drive() {
    for degrees in [-45.0_f64, -40.0, -20.0, 0.0, 5.0, 33.0, 45.0] {
        let alpha = degrees.to_radians();
        let s = Solved::new(&geneva(alpha), &[], &[("wheel.angle", "180*deg")]);
        let m = 1.0 / 2.0_f64.sqrt();
        let (sin, cos) = alpha.sin_cos();
        let square = 1.0 - 2.0 * m * cos + m * m;
        let angle = std::f64::consts::PI - (m * sin).atan2(1.0 - m * cos);
        same("angle", s.of("wheel", 2)[0], angle);
        same("ω", s.of("wheel", 2)[1], -3.0 * m * (cos - m) / square);
        let acceleration = 9.0 * m * (1.0 - m * m) * sin / (square * square);
        same("α", s.of("wheel", 2)[2], acceleration);
        let reach = 0.1 * 2.0_f64.sqrt() * square.sqrt();
        let force = direction(angle).perp().scale(0.04 * acceleration / reach);
        same_vector("pin", s.on("slot", "wheel").force, force);
        same("torque", s.on("slot", "wheel").torque, 0.04 * acceleration);
    }
}

/// A bar of 1 m and 2 kg in two welded halves, the second turned by 30° against the first.
const HALVES: &str = r#"
gravity = [0, -9.81]
[bodies.ground]
points = { O = [0, 0] }
[bodies.a]
type = "bar"
mass = 1
length = 0.5
ends = ["O", "M"]
[bodies.b]
mass = 1
inertia = "0.5^2/12"
points = { M = ["-0.25*cos(30*deg)", "0.25*sin(30*deg)"] }
[joints.O]
type = "revolute"
i = "ground.O"
j = "a.O"
[joints.weld]
type = "weld"
i = "a.M"
j = "b.M"
angle = "30*deg"
"#;

#[test]
fn two_welded_halves_are_one_bar() {
    let s = Solved::new(HALVES, &[("a.angle", "-0.4"), ("a.omega", "2")], &[]);
    let phi = -0.4_f64;
    let alpha = -1.5 * G * phi.cos();
    same("α of a", s.of("a", 2)[2], alpha);
    same("α of b", s.of("b", 2)[2], alpha);
    same("angle of b", s.of("b", 2)[0], phi + 30.0_f64.to_radians());
    let (u, n) = (direction(phi), direction(phi).perp());
    let centre = u.scale(0.75);
    same_vector("centre", Vec2::new(s.of("b", 0)[0], s.of("b", 1)[0]), centre);
    let a = n.scale(0.75 * alpha) + u.scale(-0.75 * 4.0);
    same_vector("acceleration", Vec2::new(s.of("b", 0)[2], s.of("b", 1)[2]), a);
    let force = a + Vec2::new(0.0, G);
    let on = s.on("weld", "b");
    same_vector("force of the weld", on.force, force);
    // about the centre of b: J α = torque + (M - centre) × force
    same("torque of the weld", on.torque, alpha / 48.0 - u.scale(-0.25).cross(force));
    same("reaction", s.on("weld", "a").torque, -on.torque);
}
