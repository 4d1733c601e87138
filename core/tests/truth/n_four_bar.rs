//! N windows of parallelograms, up to the first singular position.

use crate::mechanisms::{close, largest, model, rate, residual, run, start, tolerances};
use crate::{number, reference};
use kempe::analyses::dynamics::{Options, Scheme, Stabilization};
use kempe::integrate::{AlphaParameters, GeneralizedAlpha, Radau};
use kempe::model::Model;
use kempe::stabilize::Projection;
use std::fmt::Write;

fn windows(n: usize) -> Model {
    let mut text = String::from("gravity = [0, -9.81]\n[bodies.ground]\npoints = { ");
    for k in 0..=n {
        write!(text, "P{k} = [{k}, 0], ").unwrap();
    }
    text.truncate(text.len() - 2);
    text.push_str(" }\n");
    let mut bar = |name: &str, ends: [&str; 2]| {
        writeln!(text, "[bodies.{name}]\ntype = \"bar\"\nmass = 1\nlength = 1\nends = {ends:?}")
            .unwrap();
    };
    (0..=n).for_each(|k| bar(&format!("crank{k}"), ["A", "B"]));
    (0..n).for_each(|k| bar(&format!("coupler{k}"), ["B", "C"]));
    let mut pin = |name: String, i: String, j: String| {
        writeln!(text, "[joints.{name}]\ntype = \"revolute\"\ni = \"{i}\"\nj = \"{j}\"").unwrap();
    };
    for k in 0..=n {
        pin(format!("A{k}"), format!("ground.P{k}"), format!("crank{k}.A"));
    }
    for k in 0..n {
        pin(format!("B{k}"), format!("crank{k}.B"), format!("coupler{k}.B"));
        pin(format!("C{k}"), format!("coupler{k}.C"), format!("crank{}.B", k + 1));
    }
    model(&text)
}

fn compare(n: usize) {
    let m = windows(n);
    let guess: Vec<(String, &str)> = (0..n).map(|k| (format!("coupler{k}.angle"), "0")).collect();
    let guess: Vec<(&str, &str)> = guess.iter().map(|(key, x)| (key.as_str(), *x)).collect();
    let (mut state, report) =
        start(&m, &[("crank0.angle", "pi/2"), ("crank0.omega", "-1")], &guess);
    assert_eq!(report.degrees_of_freedom, 1);
    assert!(largest(&residual(&m, &state)) < 1e-12 && largest(&rate(&m, &state)) < 1e-12);
    let bodies = m.bodies.len() - 1;
    for b in 0..bodies {
        let [vx, vy, omega] = [0, 1, 2].map(|c| state.v[3 * b + c]);
        let crank = b <= n;
        close("vx", vx, if crank { 0.5 } else { 1.0 }, 1e-12);
        close("vy", vy, 0.0, 1e-12);
        close("omega", omega, if crank { -1.0 } else { 0.0 }, 1e-12);
    }
    let truth = &reference("n_four_bar")["N"][n.to_string()];
    for t in ["0.05", "0.5"] {
        let run = run(&m, &state, &tolerances(t.parse().unwrap(), 1e-9, 1e-12));
        let rows = run.trajectory.t.len();
        if t == "0.05" {
            let energy = run.trajectory.energy[0] + run.trajectory.energy[1];
            close("energy", energy, number(&truth["initial_energy_J(V=0 at ground line)"]), 1e-9);
            // the joint force on ground is λ, so on the crank -λ: end cranks carry 13.715 N
            let lam = &run.trajectory.lam[..m.layout.n_rows];
            close("end pin", -lam[1], 13.715, 1e-9);
            close("end pin", lam[0], 0.0, 1e-9);
            if n > 1 {
                close("middle pin", -lam[3], 18.12, 1e-9);
            }
        }
        let last = (rows - 1) * m.layout.n_q;
        state.t = t.parse().unwrap();
        state.q = run.trajectory.q[last..][..m.layout.n_q].to_vec();
        state.v = run.trajectory.v[last..][..m.layout.n_q].to_vec();
        // B0 is twice as far from the pin as the centre of the first crank
        let (q, v, truth) = (&state.q, &state.v, &truth["B0"][t]);
        close("x", 2.0 * q[0], number(&truth["x"]), 1e-7);
        close("y", 2.0 * q[1], number(&truth["y"]), 1e-7);
        close("vx", 2.0 * v[0], number(&truth["vx"]), 1e-6);
        close("vy", 2.0 * v[1], number(&truth["vy"]), 1e-6);
    }
}

/// Implicit methods up to the first singular position, of one window and of forty.
#[test]
fn by_implicit_methods() {
    for n in [1, 40] {
        let m = windows(n);
        let level: Vec<(String, &str)> =
            (0..n).map(|k| (format!("coupler{k}.angle"), "0")).collect();
        let level: Vec<(&str, &str)> = level.iter().map(|(key, x)| (key.as_str(), *x)).collect();
        let (state, _) = start(&m, &[("crank0.angle", "pi/2"), ("crank0.omega", "-1")], &level);
        let truth = &reference("n_four_bar")["N"][n.to_string()]["B0"]["0.5"];
        let parameters = AlphaParameters::chung_hulbert(0.8);
        for (scheme, bound) in [
            (Scheme::Radau(Radau::new(1e-9, 1e-12)), 1e-8),
            (Scheme::GeneralizedAlpha(GeneralizedAlpha::new(parameters, 1e-6, 1e-9)), 1e-4),
        ] {
            let stabilization = Stabilization::Projection(Projection::default());
            let options = Options { scheme, stabilization, ..Options::new(0.5) };
            let run = run(&m, &state, &options);
            let last = (run.trajectory.t.len() - 1) * m.layout.n_q;
            let (q, v) = (&run.trajectory.q[last..], &run.trajectory.v[last..]);
            close("x", 2.0 * q[0], number(&truth["x"]), bound);
            close("y", 2.0 * q[1], number(&truth["y"]), bound);
            close("vx", 2.0 * v[0], number(&truth["vx"]), 10.0 * bound);
            close("vy", 2.0 * v[1], number(&truth["vy"]), 10.0 * bound);
        }
    }
}

#[test]
fn one_window() {
    compare(1);
}

#[test]
fn two_windows() {
    compare(2);
}

#[test]
fn forty_windows() {
    compare(40);
}
