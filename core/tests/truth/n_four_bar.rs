//! N windows of parallelograms: up to the first singular position, and past ten of them.

use crate::mechanisms::{close, largest, model, rate, residual, run, start, tolerances};
use crate::{number, reference};
use kempe::analyses::dynamics::{dynamics, Options, Reason, Scheme, Singularity, Stabilization};
use kempe::analyses::State;
use kempe::integrate::{AlphaParameters, Dop853, Flow, GeneralizedAlpha, Radau};
use kempe::model::Model;
use kempe::stabilize::Projection;
use std::fmt::Write;

pub fn windows(n: usize) -> Model {
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
            let energies = run.energies(&m).unwrap();
            let energy = energies[0] + energies[1];
            close("energy", energy, number(&truth["initial_energy_J(V=0 at ground line)"]), 1e-9);
            // the joint force on ground is λ, so on the crank -λ: end cranks carry 13.715 N
            let lam = &run.accelerations(&m).unwrap().lam[..m.layout.n_rows];
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
            let options = Options { method: scheme, stabilization, ..Options::classical(0.5) };
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

pub fn upright(n: usize) -> (Model, State) {
    let m = windows(n);
    let guess: Vec<(String, &str)> = (0..n).map(|k| (format!("coupler{k}.angle"), "0")).collect();
    let guess: Vec<(&str, &str)> = guess.iter().map(|(key, x)| (key.as_str(), *x)).collect();
    let (state, _) = start(&m, &[("crank0.angle", "pi/2"), ("crank0.omega", "-1")], &guess);
    (m, state)
}

fn passing(t_end: f64, rtol: f64) -> Options {
    let scheme = Scheme::Dop853(Dop853::new(rtol, 1e-3 * rtol));
    let stabilization = Stabilization::Projection(Projection::default());
    Options { method: scheme, stabilization, dense_output: false, ..Options::classical(t_end) }
}

/// Every bar lies on one line about twice a turn, of which there are five in 10 s.
fn passes(n: usize) {
    let (m, state) = upright(n);
    let truth = &reference("n_four_bar")["N"][n.to_string()]["B0"];
    for t in ["1", "2", "3", "4", "5", "10"] {
        let run = run(&m, &state, &passing(t.parse().unwrap(), 1e-9));
        assert!(run.statistics.steps < 400, "{:?}", run.statistics);
        let last = run.trajectory.q.len() - m.layout.n_q;
        let q = &run.trajectory.q[last..];
        close("x", 2.0 * q[0], number(&truth[t]["x"]), 1e-7);
        close("y", 2.0 * q[1], number(&truth[t]["y"]), 1e-7);
        // no window left its branch: couplers stay level
        for k in 0..n {
            close("coupler", q[3 * (n + 1 + k) + 2], 0.0, 1e-6);
        }
    }
}

#[test]
fn one_window_passes_singular_positions() {
    passes(1);
}

#[test]
fn two_windows_pass_singular_positions() {
    passes(2);
}

#[test]
fn forty_windows_pass_singular_positions() {
    passes(40);
}

/// One window with all bars on one line, the cranks turning at the given rates.
fn flat(rates: [f64; 2]) -> (Model, State) {
    let m = windows(1);
    let q = vec![0.5, 0.0, 0.0, 1.5, 0.0, 0.0, 1.5, 0.0, 0.0];
    let [a, b] = rates;
    let v = vec![0.0, a / 2.0, a, 0.0, b / 2.0, b, 0.0, (a + b) / 2.0, b - a];
    (m, State { t: 0.0, q, v, z: vec![] })
}

#[test]
fn at_rest_on_one_line_the_motion_is_undecided() {
    let (m, state) = flat([0.0; 2]);
    let options = passing(0.2, 1e-9);
    let failure = dynamics(&m, &state, &options, |_| Flow::Continue).unwrap_err();
    let Reason::Singular { t, message, .. } = &failure.reason else { panic!("{}", failure.reason) };
    assert_eq!(*t, 0.0);
    for part in ["t = 0.000000 s", "at rest", "joints A0, A1, B0, C0", "crank1 x = 1.500000"] {
        assert!(message.contains(part), "{part}: {message}");
    }
    let told = Options { singularity: Singularity::Pass, ..options };
    let run = run(&m, &state, &told);
    assert!(run.reached);
}

#[test]
fn a_rate_along_no_branch_is_refused() {
    let (m, state) = flat([-1.0, -0.5]);
    let failure = dynamics(&m, &state, &passing(0.2, 1e-9), |_| Flow::Continue).unwrap_err();
    assert!(matches!(failure.reason, Reason::Singular { t: 0.0, .. }), "{}", failure.reason);
}

#[test]
fn at_speed_the_rate_decides_the_branch() {
    let (m, state) = flat([-3.0, -3.0]);
    let run = run(&m, &state, &passing(0.1, 1e-9));
    let q = &run.trajectory.q[run.trajectory.q.len() - 9..];
    close("a parallelogram it stays", q[8], 0.0, 1e-8);
    assert!(q[2] < -0.3);
}

#[test]
fn the_automatic_choice_is_explicit() {
    for n in [1, 3, 40] {
        let (m, state) = upright(n);
        let choice = run(&m, &state, &Options::new(10.0)).choice.expect("a choice was made");
        assert_eq!(choice.method, "dop853", "{n} windows: {}", choice.why);
    }
}
