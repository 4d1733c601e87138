//! A hanging chain against the recursion of statics.

use super::rest;
use crate::mechanisms::{column, model, start};
use std::fmt::Write;

/// A chain of equal bars between two pins.
fn chain(n: usize, length: f64, span: f64) -> String {
    let mut text = format!(
        "gravity = [0, -9.81]\n[bodies.ground]\npoints = {{ A = [0, 0], B = [{span}, 0] }}\n"
    );
    for k in 0..n {
        let _ = write!(
            text,
            "[bodies.l{k}]\ntype = 'bar'\nmass = 0.2\nlength = {length}\nends = ['P', 'Q']\n"
        );
    }
    for k in 0..=n {
        let i = if k == 0 { "ground.A".to_string() } else { format!("l{}.Q", k - 1) };
        let j = if k == n { "ground.B".to_string() } else { format!("l{k}.P") };
        let _ = write!(text, "[joints.j{k}]\ntype = 'revolute'\ni = '{i}'\nj = '{j}'\n");
    }
    text
}

/// In a hanging chain of bars of weight w, link k has the slope (T + w (k - (n - 1)/2)) / H, by the balance of moments of
/// each bar, and H follows from the span.
fn angles(n: usize, length: f64, span: f64, weight: f64) -> Vec<f64> {
    let at = |h: f64| -> Vec<f64> {
        (0..n).map(|k| (weight * (k as f64 - (n as f64 - 1.0) / 2.0) / h).atan()).collect()
    };
    let reach = |h: f64| at(h).iter().map(|a| length * a.cos()).sum::<f64>();
    let (mut low, mut high) = (1e-9, 1e9);
    for _ in 0..300 {
        let middle: f64 = 0.5 * (low + high);
        if reach(middle) < span {
            low = middle;
        } else {
            high = middle;
        }
    }
    at(0.5 * (low + high))
}

#[test]
fn a_hanging_chain() {
    for n in [5, 30] {
        let (length, span) = (1.0 / n as f64, 0.7);
        let m = model(&chain(n, length, span));
        let guess: Vec<(String, String)> = (0..n)
            .map(|k| (format!("l{k}.angle"), format!("{}", if k < n / 2 { 0.9 } else { -0.8 })))
            .collect();
        let guess: Vec<(&str, &str)> =
            guess.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
        let (state, _) = start(&m, &[], &guess);
        let found = rest(&m, &state);
        let exact = angles(n, length, span, 0.2 * 9.81);
        for (k, exact) in exact.iter().enumerate() {
            let angle = found.state.q[column(&m, &format!("l{k}"), 2)];
            let turned = (angle - exact) / std::f64::consts::TAU;
            let error = (turned - turned.round()) * std::f64::consts::TAU;
            assert!(
                error.abs() < 1e-10,
                "{n}: link {k} at {angle}, not {exact}; {} steps",
                found.steps
            );
        }
        assert!(found.stable, "{:?}", found.eigenvalues);
        println!("{n}: {} steps, residual {:.1e}", found.steps, found.residual);
    }
}
