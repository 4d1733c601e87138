//! The flagship with projection: on its constraints at rounding level, in few steps, and true.

use crate::mechanisms::{close, every, four_bar, largest, rate, residual, run, tolerances, worst};
use crate::{number, numbers, reference};
use kempe::analyses::dynamics::{Accelerations, Options, Run, Scheme, Stabilization};
use kempe::analyses::State;
use kempe::integrate::Dop853;
use kempe::model::Model;
use kempe::stabilize::Projection;

fn projected(options: Options) -> Options {
    Options { stabilization: Stabilization::Projection(Projection::default()), ..options }
}

/// Largest |Φ| and |Φ_q q̇ + Φ_t| of all reported states.
fn open(m: &Model, run: &Run) -> (f64, f64) {
    let rows = run.trajectory.q.chunks_exact(9).zip(run.trajectory.v.chunks_exact(9));
    run.trajectory.t.iter().zip(rows).fold((0.0, 0.0), |(phi, dphi), (&t, (q, v))| {
        let state = State { t, q: q.to_vec(), v: v.to_vec(), z: vec![] };
        (f64::max(phi, largest(&residual(m, &state))), f64::max(dphi, largest(&rate(m, &state))))
    })
}

/// Error of the energy balance, relative to the largest kinetic energy.
fn imbalance(m: &Model, run: &Run) -> f64 {
    let energies = run.energies(m).unwrap();
    let energy = energies.chunks_exact(5);
    let kinetic = energy.clone().map(|e| e[0]).fold(0.0, f64::max);
    let balance: Vec<f64> = energy.map(|e| e[0] + e[1] + e[2] - e[3] - e[4]).collect();
    balance.iter().map(|b| (b - balance[0]).abs()).fold(0.0, f64::max) / kinetic
}

/// Baumgarte's β = 200 takes 1326 and 2192 steps.
#[test]
fn few_steps_and_closed_joints_on_all_output() {
    let (m, start) = four_bar();
    for (rtol, expected) in [(1e-3, 202), (1e-6, 612)] {
        let to_end = tolerances(15.0, rtol, 1e-3 * rtol);
        for options in [every(0.01, to_end.clone()), to_end] {
            let run = run(&m, &start, &projected(options));
            let steps = run.statistics.steps as f64;
            close("steps", steps, f64::from(expected), 0.03 * steps);
            let (phi, dphi) = open(&m, &run);
            assert!(phi <= 1e-12 * 20.0 && dphi <= 1e-9, "{phi:.2e} m, {dphi:.2e} m/s");
        }
    }
}

#[test]
fn the_trajectory_at_all_states() {
    let (m, start) = four_bar();
    let options = projected(every(0.01, tolerances(15.0, 1e-9, 1e-12)));
    compare(&m, &run(&m, &start, &options));
}

#[test]
fn the_trajectory_at_all_states_by_dop853() {
    let (m, start) = four_bar();
    let scheme = Scheme::Dop853(Dop853::new(1e-9, 1e-12));
    let options = Options { method: scheme, ..projected(every(0.01, Options::classical(15.0))) };
    let run = run(&m, &start, &options);
    compare(&m, &run);
    // Runge–Kutta 4(5) needs 2303 steps and twice the evaluations
    let took = run.statistics;
    assert!(took.steps < 550 && took.evaluations < 8500, "{took:?}");
    let (phi, dphi) = open(&m, &run);
    assert!(phi <= 1e-12 * 20.0 && dphi <= 1e-9, "{phi:.2e} m, {dphi:.2e} m/s");
}

fn compare(m: &Model, run: &Run) {
    let truth = reference("four_bar");
    let peak = |table: &[f64]| largest(table);
    let Accelerations { a, lam, .. } = run.accelerations(m).unwrap();
    let (peak_a, peak_lam) = (peak(&a), peak(&lam));
    for truth in truth["states"].as_array().unwrap() {
        let t = number(&truth["t"]);
        let k = run.trajectory.t.iter().position(|found| (found - t).abs() < 1e-12).unwrap();
        let error = |table: &[f64], width, key: &str| {
            worst(&table[k * width..][..width], &numbers(&truth[key]))
        };
        assert!(error(&run.trajectory.q, 9, "q") < 1e-8, "t = {t}");
        assert!(error(&run.trajectory.v, 9, "v") < 3e-7, "t = {t}");
        assert!(error(&a, 9, "a") < 1e-7 * peak_a, "t = {t}");
        assert!(error(&lam, 8, "lam") < 1e-7 * peak_lam, "t = {t}");
    }
}

/// The change of energy by projection is not a work, so the balance shows it.
#[test]
fn the_energy_balance_tells_the_tolerance() {
    let (m, start) = four_bar();
    let off = [1e-3, 1e-6, 1e-9].map(|rtol| {
        imbalance(&m, &run(&m, &start, &projected(tolerances(15.0, rtol, 1e-3 * rtol))))
    });
    assert!(off[0] > 1e-4 && off[0] < 1e-2 && off[1] < 1e-5 && off[2] < 1e-8, "{off:?}");
}
