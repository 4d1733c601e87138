//! Six-bars, slider and chains: assembled with little help.

use crate::mechanisms::{close, largest, model, residual, start};
use kempe::analyses::mobility;
use kempe::model::Model;
use std::fmt::Write;

fn pins(list: &[(&str, &str, &str)]) -> String {
    list.iter().fold(String::new(), |mut text, (name, i, j)| {
        writeln!(text, "[joints.{name}]\ntype = \"revolute\"\ni = \"{i}\"\nj = \"{j}\"").unwrap();
        text
    })
}

fn bar(name: &str, length: f64, ends: [&str; 2]) -> String {
    format!("[bodies.{name}]\ntype = \"bar\"\nmass = 1\nlength = {length}\nends = {ends:?}\n")
}

fn stands(m: &Model, set: &[(&str, &str)], guess: &[(&str, &str)]) {
    let (state, report) = start(m, set, guess);
    assert!(largest(&residual(m, &state)) < 1e-11);
    assert_eq!(report.degrees_of_freedom, 1);
    for (key, value) in set {
        let (body, _) = key.split_once('.').unwrap();
        let column = crate::mechanisms::column(m, body, 2);
        close(key, state.q[column], value.parse().unwrap(), 1e-14);
    }
    let found = mobility(m, 0.0, &state.q);
    assert!(found.redundant.is_empty() && found.rank == m.layout.n_rows);
}

/// Watt: a dyad on the ternary coupler side of a four-bar.
fn watt() -> Model {
    let ternary = "[bodies.rocker]\nmass = 1\ninertia = 1\npoints = { C = [3, 0], D = [0, 0], E = [2, 1.5] }\n";
    model(
        &[
            "[bodies.ground]\npoints = { A = [0, 0], D = [4, 0], G = [8, 0] }\n",
            &bar("crank", 1.2, ["A", "B"]),
            &bar("coupler", 3.8, ["B", "C"]),
            ternary,
            &bar("link", 3.5, ["E", "F"]),
            &bar("output", 2.8, ["F", "G"]),
            &pins(&[
                ("A", "ground.A", "crank.A"),
                ("B", "crank.B", "coupler.B"),
                ("C", "coupler.C", "rocker.C"),
                ("D", "ground.D", "rocker.D"),
                ("E", "rocker.E", "link.E"),
                ("F", "link.F", "output.F"),
                ("G", "ground.G", "output.G"),
            ]),
        ]
        .concat(),
    )
}

/// Stephenson III, driven on the side of the five-bar loop: not made of dyads from its input.
fn stephenson() -> Model {
    let coupler = "[bodies.coupler]\nmass = 1\ninertia = 1\npoints = { B = [0, 0], C = [3, 0], E = [1.5, 1.2] }\n";
    model(
        &[
            "[bodies.ground]\npoints = { A = [0, 0], D = [3.5, 0], G = [-1, 3] }\n",
            &bar("left", 1.4, ["A", "B"]),
            coupler,
            &bar("right", 2.2, ["C", "D"]),
            &bar("link", 2.6, ["E", "F"]),
            &bar("input", 0.8, ["F", "G"]),
            &pins(&[
                ("A", "ground.A", "left.A"),
                ("B", "left.B", "coupler.B"),
                ("C", "coupler.C", "right.C"),
                ("D", "ground.D", "right.D"),
                ("E", "coupler.E", "link.E"),
                ("F", "link.F", "input.F"),
                ("G", "ground.G", "input.G"),
            ]),
        ]
        .concat(),
    )
}

#[test]
fn watts_six_bar_without_a_guess() {
    for angle in ["0", "0.9", "2", "3.5", "5"] {
        stands(&watt(), &[("crank.angle", angle)], &[]);
    }
}

#[test]
fn stephensons_six_bar_driven_at_its_four_bar() {
    stands(&stephenson(), &[("left.angle", "1.2")], &[]);
}

#[test]
fn stephensons_six_bar_driven_at_its_five_bar() {
    for angle in ["-1.2", "0.3", "-2"] {
        stands(&stephenson(), &[("input.angle", angle)], &[]);
    }
}

#[test]
fn a_slider_made_of_coordinate_drivers() {
    let m = model(&[
        "[bodies.ground]\npoints = { O = [0, 0] }\n",
        &bar("crank", 0.1, ["O", "P"]),
        &bar("rod", 0.3, ["P", "S"]),
        "[bodies.slider]\nmass = 1\ninertia = 1\npoints = { S = [0, 0] }\n",
        &pins(&[("O", "ground.O", "crank.O"), ("P", "crank.P", "rod.P"), ("S", "rod.S", "slider.S")]),
        "[drivers.line]\ntype = \"coordinate_driver\"\ncoordinate = \"slider.y\"\nvalue = 0\n",
        "[drivers.level]\ntype = \"coordinate_driver\"\ncoordinate = \"slider.angle\"\nvalue = 0\n",
    ]
    .concat());
    for degrees in [0, 30, 60, 90, 120, 270] {
        let th = f64::from(degrees).to_radians();
        let ask = [("crank.angle", format!("{degrees}*deg")), ("crank.omega", "1".to_string())];
        let ask = ask.each_ref().map(|(k, x)| (*k, x.as_str()));
        let (state, report) = start(&m, &ask, &[("slider.x", "0.35")]);
        assert_eq!(report.degrees_of_freedom, 1);
        let root = (0.09 - (0.1 * th.sin()).powi(2)).sqrt();
        close("x", state.q[6], 0.1 * th.cos() + root, 1e-12);
        let dx = -0.1 * th.sin() - 0.01 * th.sin() * th.cos() / root;
        close("vx", state.v[6], dx, 1e-12);
    }
}

#[test]
fn a_hanging_chain() {
    let n = 25;
    let mut text = "[bodies.ground]\npoints = { O = [0, 0] }\n".to_string();
    let mut last = "ground.O".to_string();
    let mut joints = String::new();
    for k in 0..n {
        text.push_str(&bar(&format!("link{k}"), 1.0, ["A", "B"]));
        joints.push_str(&pins(&[(&format!("J{k}"), &last, &format!("link{k}.A"))]));
        last = format!("link{k}.B");
    }
    let m = model(&(text + &joints));
    let guess: Vec<(String, String)> =
        (0..n).map(|k| (format!("link{k}.angle"), format!("{}", 0.1 * f64::from(k)))).collect();
    let guess: Vec<(&str, &str)> = guess.iter().map(|(k, x)| (k.as_str(), x.as_str())).collect();
    let (state, report) = start(&m, &[("link3.angle", "-1.25")], &guess);
    assert_eq!(report.degrees_of_freedom, n as usize);
    assert!(largest(&residual(&m, &state)) < 1e-12);
    for k in 0..n as usize {
        let angle = if k == 3 { -1.25 } else { 0.1 * k as f64 };
        close("a chain takes its guesses as they are", state.q[3 * k + 2], angle, 1e-12);
    }
}
