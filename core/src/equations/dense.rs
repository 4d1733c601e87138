//! The full matrices of the equations, for printing.

use super::forces::Acting;
use super::kinematics::Motions;
use super::powers::Powers;
use super::{constraints, forces, mass, Compiled};
use crate::model::Model;

/// Row-major matrices and right sides at one state.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrices {
    /// M, (n_q, n_q).
    pub mass: Vec<f64>,
    /// Φ, (n_rows).
    pub phi: Vec<f64>,
    /// Φ_q, (n_rows, n_q).
    pub jacobian: Vec<f64>,
    /// ν = -Φ_t, (n_rows).
    pub nu: Vec<f64>,
    /// γ, (n_rows).
    pub gamma: Vec<f64>,
    /// Q, (n_q).
    pub forces: Vec<f64>,
    /// The augmented matrix of (6.3.18), (n_q + n_rows, n_q + n_rows).
    pub kkt: Vec<f64>,
}

/// All matrices at a state.
pub fn matrices(model: &Model, t: f64, [q, v, z]: [&[f64]; 3]) -> Matrices {
    let (n, m) = (model.layout.n_q, model.layout.n_rows);
    let motions = Motions::at(&model.layout, q, v);
    let [phi, _, gamma] = constraints::terms_at(model, &motions, t);
    let mut q_forces = vec![0.0; n];
    let acting = Acting { z, lam: None, t };
    let powers = &mut Powers::zero();
    forces::generalized(model, &Compiled::new(model), &motions, acting, &mut q_forces, powers);
    let mass = mass_matrix(model, &motions);
    let jacobian = jacobian(model, &motions, t);
    let kkt = augmented(&mass, &jacobian, n, m);
    let nu = constraints::nu(model, q, t);
    Matrices { mass, phi, jacobian, nu, gamma, forces: q_forces, kkt }
}

/// Φ_q, row-major, shape (n_rows, n_q).
pub fn jacobian(model: &Model, motions: &Motions, t: f64) -> Vec<f64> {
    let n = model.layout.n_q;
    let mut entries = vec![0.0; model.layout.n_entries];
    constraints::jacobian(model, motions, t, &mut entries);
    let mut full = vec![0.0; model.layout.n_rows * n];
    for (row, column, at) in model.layout.positions() {
        full[row * n + column] = entries[at];
    }
    full
}

fn mass_matrix(model: &Model, motions: &Motions) -> Vec<f64> {
    let n = model.layout.n_q;
    let mut full = vec![0.0; n * n];
    let (mut unit, mut product) = (vec![0.0; n], vec![0.0; n]);
    for column in 0..n {
        unit[column] = 1.0;
        product.fill(0.0);
        mass::add_times(model, motions, &unit, &mut product);
        (0..n).for_each(|row| full[row * n + column] = product[row]);
        unit[column] = 0.0;
    }
    full
}

fn augmented(mass: &[f64], jacobian: &[f64], n: usize, m: usize) -> Vec<f64> {
    let size = n + m;
    let mut full = vec![0.0; size * size];
    for row in 0..n {
        full[row * size..row * size + n].copy_from_slice(&mass[row * n..(row + 1) * n]);
    }
    for row in 0..m {
        for column in 0..n {
            let entry = jacobian[row * n + column];
            full[(n + row) * size + column] = entry;
            full[column * size + n + row] = entry;
        }
    }
    full
}
