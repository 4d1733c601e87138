//! Eigenvalues of the linear equations M ü + C u̇ + K u = 0 and ẋ = A x.

use super::linearize::Linearization;
use crate::math::{Complex, Listed, Ordered};
use crate::solve::{dot, eigenvalues as of_matrix, Eigen};

/// Largest relative part of a matrix that counts as a rounding error.
const ROUNDING: f64 = 1e-12;

/// The eigenvalues, 1/s, by ascending magnitude. Of two conjugate ones, only that with the positive imaginary part.
///
/// Without damping and first-order states, and with a symmetric stiffness, the squares s² are eigenvalues of a symmetric
/// matrix, which is more accurate.
pub fn eigenvalues(of: &Linearization) -> Vec<Complex> {
    let f = of.coordinates.len();
    let undamped = of.states.is_empty() && of.damping.iter().all(|c| *c == 0.0);
    let mut found = match undamped && is_symmetric(of, f) {
        true => of_squares(of, f),
        false => of_matrix(&of.a, 2 * f + of.states.len()),
    };
    found.retain(|s| s.im >= 0.0);
    found
        .order_by(|a, b| a.re.hypot(a.im).total_cmp(&b.re.hypot(b.im)).then(a.re.total_cmp(&b.re)));
    found
}

/// Whether K is symmetric up to rounding, in units in which the diagonal of M is 1.
fn is_symmetric(of: &Linearization, f: usize) -> bool {
    let unit = |k: usize| of.mass[k * f + k].sqrt();
    let scaled = |i: usize, j: usize| of.stiffness[i * f + j] / (unit(i) * unit(j));
    let entries = || (0..f * f).map(|k| (k / f, k % f));
    let largest = entries().map(|(i, j)| scaled(i, j).abs()).fold(0.0, f64::max);
    entries().all(|(i, j)| (scaled(i, j) - scaled(j, i)).abs() <= ROUNDING * largest)
}

/// The roots of M s² + K = 0: a positive ω² gives one of the pair ±iω, another two real eigenvalues.
fn of_squares(of: &Linearization, f: usize) -> Vec<Complex> {
    // with M = V D Vᵀ, the matrix D^(-1/2) Vᵀ K V D^(-1/2) has the eigenvalues ω²
    let Eigen { values, vectors } = Eigen::of(&of.mass, f);
    let times = |x: &Vec<f64>| of.stiffness.chunks_exact(f).map(|row| dot(row, x)).list();
    let products: Vec<Vec<f64>> = vectors.iter().map(times).list();
    let entry = |k: usize| {
        let (i, j) = (k / f, k % f);
        dot(&vectors[i], &products[j]) / (values[i] * values[j]).sqrt()
    };
    let reduced: Vec<f64> = (0..f * f).map(entry).list();
    let squares = Eigen::of(&reduced, f).values;
    let largest = squares.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let zero = if f == 1 { 0.0 } else { 4.0 * f as f64 * f64::EPSILON * largest };
    let roots = |square: f64| {
        let root = if square.abs() <= zero { 0.0 } else { square.abs().sqrt() };
        match root > 0.0 && square > 0.0 {
            true => vec![Complex::new(0.0, root)],
            false => vec![Complex::new(0.0 - root, 0.0), Complex::new(root, 0.0)],
        }
    };
    squares.into_iter().flat_map(roots).list()
}
