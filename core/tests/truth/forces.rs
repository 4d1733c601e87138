//! Forces against closed forms: accelerations of free bodies, and oscillations.

use crate::mechanisms::{close, column, every, model, run, start, tolerances};
use crate::solved::{direction, same, Solved};
use kempe::math::Vec2;

/// A free body, and another one beside it.
const FREE: &str = r#"
[bodies.ground]
points = { O = [0, 0] }
[bodies.a]
mass = 4
inertia = 0.8
points = { Q = [0.2, -0.1] }
[bodies.b]
mass = 2
inertia = 0.5
points = { P = [0.3, 0.1] }
[forces.f]
"#;

const A: [f64; 3] = [-0.4, 0.7, 0.9];
const B: [f64; 3] = [1.1, 0.5, 0.4];

fn free(force: &str) -> Solved {
    let names = ["a.x", "a.y", "a.angle", "b.x", "b.y", "b.angle"];
    let values: Vec<String> = A.iter().chain(&B).map(f64::to_string).collect();
    let set: Vec<(&str, &str)> = names.into_iter().zip(values.iter().map(String::as_str)).collect();
    Solved::new(&format!("{FREE}{force}"), &set, &[])
}

fn turned(s: [f64; 2], angle: f64) -> Vec2 {
    direction(angle).scale(s[0]) + direction(angle).perp().scale(s[1])
}

/// The place of a point of a body.
fn place(body: [f64; 3], s: [f64; 2]) -> Vec2 {
    Vec2::new(body[0], body[1]) + turned(s, body[2])
}

/// Compares the accelerations of a body with those of a force at a place.
#[track_caller]
fn pushed(s: &Solved, name: &str, (mass, inertia): (f64, f64), at: Vec2, force: Vec2) {
    let arm = at - Vec2::new(s.of(name, 0)[0], s.of(name, 1)[0]);
    same("ax", s.of(name, 0)[2], force.x / mass);
    same("ay", s.of(name, 1)[2], force.y / mass);
    same("alpha", s.of(name, 2)[2], arm.cross(force) / inertia);
}

const OF_A: (f64, f64) = (4.0, 0.8);
const OF_B: (f64, f64) = (2.0, 0.5);

#[test]
fn a_force_acts_at_its_point_and_back_on_body_i_at_the_same_place() {
    for (frame, angle) in [("global", 0.0), ("i", A[2]), ("j", B[2])] {
        let s = free(&format!(
            "type = 'force'\nj = 'b.P'\ni = 'a'\nforce = [3, '-1 + b.omega']\nframe = '{frame}'"
        ));
        let (force, at) = (turned([3.0, -1.0], angle), place(B, [0.3, 0.1]));
        pushed(&s, "b", OF_B, at, force);
        pushed(&s, "a", OF_A, at, -force);
    }
    let s = free("type = 'force'\nj = 'b.P'\nforce = [3, -1]");
    pushed(&s, "b", OF_B, place(B, [0.3, 0.1]), Vec2::new(3.0, -1.0));
    pushed(&s, "a", OF_A, place(A, [0.0, 0.0]), Vec2::zero());
}

#[test]
fn an_actuator_pushes_along_its_line_as_a_generalized_force_on_its_length() {
    let (p, q) = (place(B, [0.3, 0.1]), place(A, [0.2, -0.1]));
    let force = (p - q).scale(7.0 / (p - q).norm());
    let ends = "type = 'actuator'\ni = 'a.Q'\nj = 'b.P'\n";
    let length = "force = 0\n[forces.g]\ntype = 'generalized_force'\ncoordinate = 'f.length'\n";
    for text in [format!("{ends}force = 7"), format!("{ends}{length}value = 7")] {
        let s = free(&text);
        pushed(&s, "b", OF_B, p, force);
        pushed(&s, "a", OF_A, q, -force);
    }
}

#[test]
fn a_generalized_force_acts_on_the_quantity() {
    let of = |coordinate: &str| {
        free(&format!("type = 'generalized_force'\ncoordinate = '{coordinate}'\nvalue = '5 + t'"))
    };
    pushed(&of("b.P.x"), "b", OF_B, place(B, [0.3, 0.1]), Vec2::new(5.0, 0.0));
    pushed(&of("b.y"), "b", OF_B, place(B, [0.0, 0.0]), Vec2::new(0.0, 5.0));
    let turned = of("b.angle");
    same("alpha", turned.of("b", 2)[2], 10.0);
    same("ax", turned.of("b", 0)[2], 0.0);
}

/// A block on a slide: the effort on the displacement is a force along the axis, opposite on the bar with the rail.
#[test]
fn a_generalized_force_on_a_slide_is_a_force_along_it() {
    let block = |force: &str| {
        Solved::new(
            &format!(
                "[bodies.ground]\npoints = {{ O = [0, 0] }}\n[bodies.a]\nmass = 4\ninertia = 0.8\n\
                 points = {{ Q = [0.2, -0.1], O = [0, 0] }}\n[bodies.b]\nmass = 2\ninertia = 0.5\n\
                 points = {{ P = [0.3, 0.1] }}\n[joints.pin]\ntype = 'revolute'\ni = 'ground.O'\n\
                 j = 'a.O'\n[joints.slide]\ntype = 'translational'\ni = 'a.Q'\nj = 'b.P'\n\
                 axes = [0.3, 0.1]\n[forces.f]\n{force}"
            ),
            &[("a.angle", "0.6"), ("b.x", "0.52")],
            &[],
        )
    };
    let s = block("type = 'generalized_force'\ncoordinate = 'slide.displacement'\nvalue = 5");
    let pushes = block("type = 'actuator'\ni = 'a.Q'\nj = 'b.P'\nforce = 5");
    for body in ["a", "b"] {
        for k in 0..3 {
            same(body, s.of(body, k)[2], pushes.of(body, k)[2]);
        }
    }
    assert!(s.of("b", 0)[2].abs() > 0.1);
}

#[test]
fn a_preload_adds_to_a_spring() {
    let s = free(
        "type = 'spring_damper'\ni = 'a.Q'\nj = 'b.P'\nstiffness = 3\nfree_length = 0.4\npreload = 2",
    );
    let (p, q) = (place(B, [0.3, 0.1]), place(A, [0.2, -0.1]));
    let length = (p - q).norm();
    let force = (p - q).scale(-(3.0 * (length - 0.4) + 2.0) / length);
    pushed(&s, "b", OF_B, p, force);
    pushed(&s, "a", OF_A, q, -force);
    let s = free(
        "type = 'torsion_spring'\ni = 'a'\nj = 'b'\nstiffness = 3\nfree_angle = 0.2\npreload = 2",
    );
    let torque = -(3.0 * (B[2] - A[2] - 0.2) + 2.0);
    same("alpha of j", s.of("b", 2)[2], torque / 0.5);
    same("alpha of i", s.of("a", 2)[2], -torque / 0.8);
}

/// A mass of 2 kg at a distance from ground, with a speed along the line.
fn tied(only: &str, x: f64, vx: f64) -> Solved {
    Solved::new(
        &format!(
            "[bodies.ground]\npoints = {{ O = [0, 0] }}\n[bodies.m]\nmass = 2\ninertia = 1\n\
             points = {{ P = [0, 0] }}\n[forces.tie]\ntype = 'spring_damper'\ni = 'ground.O'\nj = 'm.P'\n\
             stiffness = 50\ndamping = 3\nfree_length = 1\npreload = 4\nonly = '{only}'\n"
        ),
        &[("m.x", &x.to_string()), ("m.y", "0"), ("m.vx", &vx.to_string())],
        &[],
    )
}

#[test]
fn a_cord_only_pulls_and_a_buffer_only_pushes() {
    for (only, x, vx, force) in [
        ("tension", 1.2, 0.5, -(10.0 + 1.5 + 4.0)),
        ("tension", 0.9, 9.0, 0.0),
        ("tension", 1.2, -9.0, 0.0),
        ("compression", 0.8, -0.5, 10.0 + 1.5 - 4.0),
        ("compression", 1.1, -9.0, 0.0),
        ("compression", 0.8, 9.0, 0.0),
    ] {
        same(&format!("{only} {x} {vx}"), tied(only, x, vx).of("m", 0)[2], force / 2.0);
    }
}

/// Free flight to the end of the cord, half an oscillation on it, and free flight back.
#[test]
fn a_mass_bounces_on_a_cord() {
    let text = "[bodies.ground]\npoints = { O = [0, 0] }\n[bodies.m]\nmass = 2\ninertia = 1\n\
                points = { P = [0, 0] }\n[forces.cord]\ntype = 'spring_damper'\ni = 'ground.O'\nj = 'm.P'\n\
                stiffness = 50\nfree_length = 1\nonly = 'tension'\n";
    let m = model(text);
    let (state, _) = start(&m, &[("m.x", "0.5"), ("m.y", "0")], &[("m.vx", "2")]);
    let run = run(&m, &state, &every(0.05, tolerances(1.2, 1e-10, 1e-12)));
    let contact = std::f64::consts::PI / 5.0;
    let energies = run.energies(&m).unwrap();
    for (k, t) in run.trajectory.t.iter().enumerate() {
        let on = t - 0.25;
        let x = match on {
            on if on < 0.0 => 1.0 + 2.0 * on,
            on if on < contact => 1.0 + 0.4 * (5.0 * on).sin(),
            on => 1.0 - 2.0 * (on - contact),
        };
        close("x", run.trajectory.q[3 * k], x, 1e-8);
        close("T + V", energies[5 * k] + energies[5 * k + 1], 4.0, 1e-8);
    }
}

#[test]
fn a_bushing_swings_with_three_frequencies() {
    let text = "[bodies.ground]\npoints = { O = [0.5, 0.2] }\n[bodies.m]\nmass = 2\ninertia = 0.5\n\
                points = { P = [0, 0] }\n[forces.mount]\ntype = 'bushing'\ni = 'ground.O'\nj = 'm.P'\n\
                stiffness = [8, 18, 8]\ndamping = [0, 0, 1]\n";
    let m = model(text);
    let set = [("m.x", "0.8"), ("m.y", "0.1"), ("m.angle", "0.3")];
    let (state, _) = start(&m, &set, &[]);
    let run = run(&m, &state, &every(0.1, tolerances(3.0, 1e-11, 1e-13)));
    let at = |k: usize, c: usize| run.trajectory.q[3 * k + column(&m, "m", c)];
    let damped = 15.0_f64.sqrt();
    for (k, t) in run.trajectory.t.iter().enumerate() {
        close("x", at(k, 0), 0.5 + 0.3 * (2.0 * t).cos(), 1e-9);
        close("y", at(k, 1), 0.2 - 0.1 * (3.0 * t).cos(), 1e-9);
        let wave = (damped * t).cos() + (damped * t).sin() / damped;
        close("angle", at(k, 2), 0.3 * (-t).exp() * wave, 1e-9);
    }
    let energies = run.energies(&m).unwrap();
    let balance = |k: usize| energies[5 * k] + energies[5 * k + 1] + energies[5 * k + 2];
    close("balance", balance(energies.len() / 5 - 1), balance(0), 1e-8);
}

/// T = T₀ (c - ω/ω₀) on a rotor with J: ω = c ω₀ (1 - exp(-T₀ t/(J ω₀))).
#[test]
fn a_motor_approaches_its_free_speed() {
    let text = "[bodies.ground]\npoints = { O = [0, 0] }\n[bodies.r]\nmass = 1\ninertia = 0.1\n\
                points = { O = [0, 0] }\n[joints.O]\ntype = 'revolute'\ni = 'ground.O'\nj = 'r.O'\n\
                [forces.motor]\ntype = 'motor'\nj = 'r'\nstall_torque = 2\nfree_speed = 10\ncommand = 0.6\n";
    let m = model(text);
    let (state, _) = start(&m, &[("r.angle", "0")], &[]);
    let run = run(&m, &state, &every(0.1, tolerances(2.0, 1e-11, 1e-13)));
    let energies = run.energies(&m).unwrap();
    for (k, t) in run.trajectory.t.iter().enumerate() {
        let omega = 6.0 * (1.0 - (-2.0 * t).exp());
        close("omega", run.trajectory.v[3 * k + 2], omega, 1e-9);
        close("work", energies[5 * k + 4], 0.05 * omega * omega, 1e-8);
    }
}
