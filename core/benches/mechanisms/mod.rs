//! The measured mechanisms: the flagship, a four-bar linkage not used for tuning, and chains; not every
//! benchmark uses all of it.
#![allow(dead_code)]

use kempe::analyses::{assemble, State};
use kempe::case;
use kempe::model::{build, Model};
use std::fmt::Write;

/// The flagship.
pub const FLAGSHIP: &str = include_str!("../../../examples/four_bar.toml");

/// A crank-rocker with general bodies, frames at their ends, and joints from the rocker backward.
pub const OTHER: &str = r#"
kempe = 1
gravity = [0, -9.81]

[bodies.ground]
points = { A = [0, 0], D = [1.5, 0.2] }
[bodies.rocker]
mass = 2
inertia = 0.3
center = [0.55, 0.1]
points = { C = [1.2, 0], D = [0, 0] }
[bodies.crank]
mass = 1
inertia = 0.02
center = [0.15, -0.05]
points = { A = [0, 0], B = [0.5, 0] }
[bodies.coupler]
mass = 3
inertia = 0.6
center = [0.8, 0.3]
points = { B = [0, 0], C = [1.6, 0] }

[joints.C]
type = "revolute"
i = "rocker.C"
j = "coupler.C"
[joints.A]
type = "revolute"
i = "crank.A"
j = "ground.A"
[joints.D]
type = "revolute"
i = "rocker.D"
j = "ground.D"
[joints.B]
type = "revolute"
i = "coupler.B"
j = "crank.B"

[forces.spring]
type = "torsion_spring"
i = "crank"
j = "coupler"
stiffness = 8
damping = 0.4
free_angle = "-40*deg"

[start]
set = { "crank.angle" = "100*deg" }
guess = { "coupler.angle" = "20*deg", "rocker.angle" = "80*deg" }
"#;

/// The same with every frame in its mass centre: rotation and translation are not coupled, as in the flagship.
pub fn centred() -> String {
    let lines: Vec<&str> = OTHER.lines().filter(|line| !line.starts_with("center")).collect();
    lines.join("\n")
}

/// Model and assembled start of a case.
pub fn assembled(text: &str) -> (Model, State) {
    let (case, _) = case::read(text, case::Format::Toml).expect("the case is sound");
    let model = build(&case.definition, &[]).expect("the model is sound");
    let set = assemble::targets(&model, "set", &case.start.set).expect("sound targets");
    let guess = assemble::targets(&model, "guess", &case.start.guess).expect("sound guesses");
    let request = assemble::Request { set, guess, ..Default::default() };
    let (state, _) = assemble::assemble(&model, &request).expect("the linkage closes");
    (model, state)
}

/// N parallelograms side by side: N + 1 upright bars on ground joined by N bars at their tops, each
/// 1 m and 1 kg. The uprights lean by 60° and fall from rest.
pub fn chain(windows: usize) -> (Model, State) {
    let mut text = String::from("kempe = 1\ngravity = [0, -9.81]\n[bodies.ground]\npoints = {");
    for k in 0..=windows {
        let comma = if k == 0 { "" } else { "," };
        write!(text, "{comma} G{k} = [{k}, 0]").expect("text grows");
    }
    text.push_str(" }\n");
    let bar = "type = \"bar\"\nmass = 1\nlength = 1\nends = [\"A\", \"B\"]";
    for k in 0..=windows {
        write!(text, "[bodies.u{k}]\n{bar}\n").expect("text grows");
    }
    for k in 0..windows {
        write!(text, "[bodies.c{k}]\n{bar}\n").expect("text grows");
    }
    let mut joint = |name: &str, i: String, j: String| {
        write!(text, "[joints.{name}]\ntype = \"revolute\"\ni = \"{i}\"\nj = \"{j}\"\n")
            .expect("text grows");
    };
    for k in 0..=windows {
        joint(&format!("G{k}"), format!("ground.G{k}"), format!("u{k}.A"));
    }
    for k in 0..windows {
        joint(&format!("L{k}"), format!("u{k}.B"), format!("c{k}.A"));
        joint(&format!("R{k}"), format!("u{}.B", k + 1), format!("c{k}.B"));
    }
    let (case, _) = case::read(&text, case::Format::Toml).expect("the case is sound");
    let model = build(&case.definition, &[]).expect("the model is sound");
    let angle = 60_f64.to_radians();
    let (x, y) = (angle.cos(), angle.sin());
    let mut q = Vec::new();
    for k in 0..=windows {
        q.extend([k as f64 + x / 2.0, y / 2.0, angle]);
    }
    for k in 0..windows {
        q.extend([k as f64 + x + 0.5, y, 0.0]);
    }
    let v = vec![0.0; q.len()];
    (model, State { t: 0.0, q, v, z: Vec::new() })
}
