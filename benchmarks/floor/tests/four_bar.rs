//! Results of the floor program, compared with the independent reference of the flagship.

use kempe_floor::chain::Chain;
use kempe_floor::dormand_prince::integrate;
use kempe_floor::linkage::{Equations, NONE, N_Y};
use kempe_floor::straight::Straight;
use serde_json::Value;

fn reference() -> Value {
    serde_json::from_str(include_str!("../../../tests/reference/four_bar.json"))
        .expect("sound JSON")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|x| x.as_f64().expect("a number")).collect()
}

fn state(row: &Value) -> [f64; N_Y] {
    let y = [numbers(&row["q"]), numbers(&row["v"])].concat();
    y.try_into().expect("18 numbers")
}

/// Largest difference over the largest number at the start.
fn difference(found: &[f64], name: &str, row: &Value, reference: &Value) -> f64 {
    let scale = numbers(&reference["start"][name]).iter().fold(0.0_f64, |s, x| s.max(x.abs()));
    let expected = numbers(&row[name]);
    found.iter().zip(expected).map(|(a, b)| (a - b).abs() / scale).fold(0.0, f64::max)
}

fn solves<E: Equations>() {
    let reference = reference();
    let states = reference["states"].as_array().expect("states");
    for row in states.iter().chain([&reference["start"]]) {
        let found = E::solve(&state(row), NONE);
        assert!(difference(&found.a, "a", row, &reference) < 1e-10, "a at {}", row["t"]);
        assert!(difference(&found.lam, "lam", row, &reference) < 1e-10, "λ at {}", row["t"]);
    }
}

#[test]
fn both_ways_solve_the_equations_of_motion() {
    solves::<Straight>();
    solves::<Chain>();
}

fn runs<E: Equations>(rtol: f64, error: f64) -> usize {
    let reference = reference();
    let start = state(&reference["start"]);
    let (kept, effort) = integrate::<E>(&start, 15.0, 0.01, (rtol, 1e-3 * rtol));
    assert_eq!(kept.t.len(), 1501);
    let angles = numbers(&reference["first_second"]["rocker_angle"]);
    let worst = angles.iter().zip(&kept.y).map(|(a, y)| (a - y[8]).abs()).fold(0.0, f64::max);
    assert!(worst < error, "rtol {rtol}: {worst}");
    effort.steps
}

#[test]
fn runs_meet_the_reference_with_the_steps_of_kempe() {
    assert_eq!(runs::<Chain>(1e-6, 5e-8), 2191);
    assert_eq!(runs::<Straight>(1e-6, 5e-8), 2191);
    runs::<Chain>(1e-3, 1e-3);
    runs::<Chain>(1e-9, 1e-10);
}
