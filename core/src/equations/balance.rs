//! The residuals that implicit methods reduce to zero: r = M a + Φ_qᵀ λ - Q, Φ, Φ_q v + Φ_t, and the rates ż of
//! first-order states, at any (q, v, a, λ, z). Evaluating them requires no solution of equations.
//!
//! Q contains the loads of joints only if forces depend on reactions; otherwise the loads do not change the motion.

use super::forces::{self, Acting};
use super::kinematics::Motions;
use super::powers::Powers;
use super::{constraints, mass, reactions, reactive, Compiled};
use crate::model::Model;

/// Residuals at one state, and the memory for their evaluation.
#[derive(Clone, Debug)]
pub struct Balance {
    /// Motion of every body, ground first.
    pub motions: Motions,
    /// r = M a + Φ_qᵀ λ - Q, N and N·m, shape (n_q).
    pub forces: Vec<f64>,
    /// Φ, shape (n_rows).
    pub position: Vec<f64>,
    /// Φ_q v + Φ_t, shape (n_rows).
    pub rate: Vec<f64>,
    /// ż, shape (n_z).
    pub state_rates: Vec<f64>,
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
            motions: Motions::new(&model.layout),
            forces: vec![0.0; n],
            position: vec![0.0; m],
            rate: vec![0.0; m],
            state_rates: vec![0.0; model.layout.n_z],
            powers: Powers::zero(),
            compiled: Compiled::new(model),
            gamma: vec![0.0; m],
            jacobian: vec![0.0; model.layout.n_entries],
            applied: vec![0.0; n],
        }
    }

    /// Evaluates all residuals and powers.
    pub fn evaluate(&mut self, model: &Model, t: f64, [q, v, a, z]: [&[f64]; 4], lam: &[f64]) {
        let Self { motions, forces: out, position, rate, gamma, jacobian, applied, .. } = self;
        motions.place(&model.layout, q, v);
        constraints::velocity_terms(model, motions, t, position, rate, gamma);
        constraints::jacobian(model, motions, t, jacobian);
        let acting = Acting { z, lam: Some(lam), t };
        forces::generalized(model, &self.compiled, motions, acting, applied, &mut self.powers);
        if reactive::depends(model) {
            reactions::add_loads(model, motions, t, lam, applied);
        }
        forces::state_rates(model, motions, acting, &mut self.state_rates);
        out.iter_mut().zip(&*applied).for_each(|(out, applied)| *out = -applied);
        mass::add_times(model, motions, a, out);
        constraints::add_transposed(model, jacobian, lam, out);
        let driven = model.constraints.iter().zip(&model.layout.constraints).enumerate();
        for (k, (_, slots)) in driven.filter(|(_, (item, _))| item.driven) {
            let mut rows = vec![0.0; slots.rows.len()];
            constraints::times(model, k, jacobian, v, &mut rows);
            let lam = &lam[slots.rows.clone()];
            self.powers.drivers -= rows.iter().zip(lam).map(|(rate, lam)| rate * lam).sum::<f64>();
        }
    }
}
