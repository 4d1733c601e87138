//! The balance that implicit methods bring to zero: r = M a + Φ_qᵀ λ - Q, Φ and Φ_q v + Φ_t, at any
//! (q, v, a, λ), without solving for anything.

use super::energy::Powers;
use super::{constraints, forces, kinematics, mass, Compiled};
use crate::math::Motion;
use crate::model::Model;

/// Residuals at one state, with the memory for them.
#[derive(Clone, Debug)]
pub struct Balance {
    /// Motion of every body, ground first.
    pub motions: Vec<Motion>,
    /// r = M a + Φ_qᵀ λ - Q, N and N·m, shape (n_q).
    pub forces: Vec<f64>,
    /// Φ, shape (n_rows).
    pub position: Vec<f64>,
    /// Φ_q v + Φ_t, shape (n_rows).
    pub rate: Vec<f64>,
    /// Powers of forces and drivers.
    pub powers: Powers,
    compiled: Compiled,
    gamma: Vec<f64>,
    jacobian: Vec<f64>,
    applied: Vec<f64>,
}

impl Balance {
    /// Memory for a model.
    pub fn new(model: &Model) -> Self {
        let (n, m) = (model.layout.n_q, model.layout.n_rows);
        Self {
            motions: Vec::with_capacity(model.bodies.len()),
            forces: vec![0.0; n],
            position: vec![0.0; m],
            rate: vec![0.0; m],
            powers: Powers::zero(),
            compiled: Compiled::new(model),
            gamma: vec![0.0; m],
            jacobian: vec![0.0; model.layout.n_entries],
            applied: vec![0.0; n],
        }
    }

    /// Evaluates all of it.
    pub fn evaluate(&mut self, model: &Model, t: f64, [q, v, a]: [&[f64]; 3], lam: &[f64]) {
        let Self { motions, forces: out, position, rate, gamma, jacobian, applied, .. } = self;
        kinematics::motions(q, v, motions);
        constraints::velocity_terms(model, motions, t, position, rate, gamma);
        constraints::jacobian(model, motions, t, jacobian);
        self.powers = forces::generalized(model, &self.compiled, motions, t, applied);
        let bodies = model.bodies.iter().zip(motions.iter()).skip(1);
        let columns = out.chunks_exact_mut(3).zip(a.chunks_exact(3)).zip(applied.chunks_exact(3));
        for (((out, a), applied), (body, motion)) in columns.zip(bodies) {
            let inertial = mass::block(body, motion).times([a[0], a[1], a[2]]);
            (0..3).for_each(|c| out[c] = inertial[c] - applied[c]);
        }
        constraints::add_transposed(model, jacobian, lam, out);
        let mut rows = [0.0; crate::elements::MOST_EQUATIONS];
        for (k, item) in model.constraints.iter().enumerate().filter(|(_, c)| c.driven) {
            let rows = &mut rows[..item.equations.len()];
            constraints::times(model, k, jacobian, v, rows);
            let range = model.layout.constraints[k].rows.clone();
            for (rate, lam) in rows.iter().zip(&lam[range]) {
                self.powers.drivers -= rate * lam;
            }
        }
    }
}
