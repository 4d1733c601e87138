//! The flagship against an independent minimal-coordinate formulation.

use crate::mechanisms::{close, every, four_bar, largest, residual, run, tolerances, worst};
use crate::{number, numbers, reference};
use kempe::analyses::dynamics::{Options, Run, Stabilization};
use kempe::analyses::State;
use kempe::equations::Gains;
use kempe::equations::{dense, kinematics};

fn row(table: &[f64], width: usize, k: usize) -> &[f64] {
    &table[k * width..][..width]
}

#[test]
fn the_assembled_start() {
    let truth = &reference("four_bar")["start"];
    let (_, start) = four_bar();
    assert!(worst(&start.q, &numbers(&truth["q"])) < 1e-12 * 25.0, "{:?}", start.q);
    assert_eq!(start.v, [0.0; 9]);
}

#[test]
fn the_jacobian_with_its_signs() {
    let (m, start) = four_bar();
    let table = reference("four_bar")["Phi_q_at_start_rounded"].clone();
    let dense = dense::jacobian(&m, &kinematics::Motions::at_rest(&m.layout, &start.q), 0.0);
    for (k, truth) in table.as_array().unwrap().iter().enumerate() {
        for (a, b) in row(&dense, 9, k).iter().zip(numbers(truth)) {
            close("Φ_q", *a, b, 0.05 + 1e-9);
        }
    }
}

#[test]
fn accelerations_and_multipliers_at_the_start() {
    let truth = &reference("four_bar")["start"];
    let (m, start) = four_bar();
    let run = run(&m, &start, &Options::classical(0.0));
    assert_eq!(run.trajectory.t, [0.0]);
    let (a, lam) = (numbers(&truth["a"]), numbers(&truth["lam"]));
    let found = run.accelerations(&m).unwrap();
    assert!(worst(&found.a, &a) < 1e-9 * largest(&a));
    assert!(worst(&found.lam, &lam) < 1e-9 * largest(&lam));
}

/// A run that stops exactly at each of the reference's states.
fn at_states(times: &[f64]) -> Vec<(State, Vec<f64>, Vec<f64>)> {
    let (m, mut state) = four_bar();
    let mut out = Vec::new();
    for &t in times {
        let run = run(&m, &state, &tolerances(t, 1e-9, 1e-12));
        let (n, rows, k) = (9, 8, run.trajectory.t.len() - 1);
        let pick = |table: &[f64], width| row(table, width, k).to_vec();
        state = State {
            t: run.trajectory.t[k],
            q: pick(&run.trajectory.q, n),
            v: pick(&run.trajectory.v, n),
            z: vec![],
        };
        assert_eq!(state.t, t);
        let found = run.accelerations(&m).unwrap();
        out.push((state.clone(), pick(&found.a, n), pick(&found.lam, rows)));
    }
    out
}

#[test]
fn the_trajectory_at_all_states() {
    let truth = reference("four_bar");
    let states = truth["states"].as_array().unwrap();
    let times: Vec<f64> = states.iter().map(|s| number(&s["t"])).collect();
    assert!(times.len() == 8 && *times.last().unwrap() == 15.0, "{times:?}");
    let peak = |key: &str| states.iter().map(|s| largest(&numbers(&s[key]))).fold(0.0, f64::max);
    let peak_a = peak("a").max(largest(&numbers(&truth["start"]["a"])));
    let peak_lam = peak("lam").max(largest(&numbers(&truth["start"]["lam"])));
    for (truth, (state, a, lam)) in states.iter().zip(at_states(&times)) {
        let (q, v) = (numbers(&truth["q"]), numbers(&truth["v"]));
        for angle in [2, 5, 8] {
            close("angle", state.q[angle], q[angle], 1e-8);
            close("omega", state.v[angle], v[angle], 1e-6);
        }
        assert!(worst(&state.q, &q) < 1e-8 * 25.0, "t = {}: q", state.t);
        assert!(worst(&state.v, &v) < 1e-6 * 25.0, "t = {}: v", state.t);
        assert!(worst(&a, &numbers(&truth["a"])) < 1e-5 * peak_a, "t = {}: a", state.t);
        assert!(worst(&lam, &numbers(&truth["lam"])) < 1e-5 * peak_lam, "t = {}: λ", state.t);
    }
}

#[test]
fn the_first_second_on_a_grid() {
    let truth = &reference("four_bar")["first_second"];
    let (m, start) = four_bar();
    let run = run(&m, &start, &every(0.01, tolerances(1.0, 1e-9, 1e-12)));
    let times = numbers(&truth["t"]);
    assert!(worst(&run.trajectory.t, &times) < 1e-15);
    for (name, angle) in [("crank_angle", 2), ("rocker_angle", 8)] {
        let got: Vec<f64> = run.trajectory.q.chunks(9).map(|q| q[angle]).collect();
        let error = worst(&got, &numbers(&truth[name]));
        assert!(error < 1e-8, "{name}: {error:.2e}");
    }
}

/// Classical tolerances, all steps reported; with the largest |Φ| of the joints and its time.
fn classical(alpha: f64, beta: f64) -> (Run, f64, f64) {
    let (m, start) = four_bar();
    let options = Options {
        stabilization: Stabilization::Baumgarte(Gains { alpha, beta }),
        output_step: None,
        ..tolerances(15.0, 1e-3, 1e-6)
    };
    let run = run(&m, &start, &options);
    let (mut peak, mut at) = (0.0, 0.0);
    for (k, &t) in run.trajectory.t.iter().enumerate() {
        let state = State { t, q: row(&run.trajectory.q, 9, k).to_vec(), v: vec![], z: vec![] };
        let phi = residual(&m, &state);
        let gap = phi.chunks(2).map(|p| p[0].hypot(p[1])).fold(0.0, f64::max);
        if gap > peak {
            (peak, at) = (gap, t);
        }
    }
    (run, peak, at)
}

#[test]
fn the_classical_gains_leave_a_millimetre() {
    let (run, peak, at) = classical(10.0, 200.0);
    let steps = run.statistics.steps;
    assert!((1250..=1400).contains(&steps), "{steps} steps");
    close("peak of |Φ|, m", peak, 1.5e-3, 0.3e-3);
    close("its time, s", at, 0.22, 0.02);
}

#[test]
fn weak_gains_open_the_joints() {
    let (run, peak, _) = classical(1.0, 20.0);
    let steps = run.statistics.steps;
    assert!((210..=260).contains(&steps), "{steps} steps");
    close("peak of |Φ|, m", peak, 8e-3, 2e-3);
}

#[test]
fn without_gains_the_joints_drift_apart() {
    let (run, peak, at) = classical(0.0, 0.0);
    assert!(run.reached && peak > 1.0 && at > 10.0, "{peak} m at {at} s");
}

#[test]
fn tighter_tolerances_shrink_the_residual() {
    let (m, start) = four_bar();
    let peak = |rtol: f64| {
        let run = run(&m, &start, &tolerances(1.0, rtol, 1e-3 * rtol));
        let gap = |q: &[f64]| {
            largest(&residual(&m, &State { t: 0.0, q: q.to_vec(), v: vec![], z: vec![] }))
        };
        run.trajectory.q.chunks(9).map(gap).fold(0.0, f64::max)
    };
    let (loose, tight) = (peak(1e-4), peak(1e-8));
    assert!(tight < 1e-2 * loose, "{loose:.2e} {tight:.2e}");
}

#[test]
fn energy_balances() {
    let (m, start) = four_bar();
    let run = run(&m, &start, &every(0.05, tolerances(15.0, 1e-9, 1e-12)));
    let energies = run.energies(&m).unwrap();
    let balance: Vec<f64> = energies.chunks(5).map(|e| e[0] + e[1] + e[2] - e[3] - e[4]).collect();
    let kinetic = energies.chunks(5).map(|e| e[0]).fold(0.0, f64::max);
    let off = balance.iter().map(|b| (b - balance[0]).abs()).fold(0.0, f64::max);
    assert!(off < 1e-7 * kinetic, "{:.2e}", off / kinetic);
    let dissipated: Vec<f64> = energies.chunks(5).map(|e| e[2]).collect();
    assert!(dissipated.windows(2).all(|w| w[1] >= w[0] - 1e-9 * kinetic));
}
