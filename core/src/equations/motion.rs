//! The equations of motion with multipliers (Haug 6.3.18):
//!
//!     [ M   Φ_qᵀ ] [ q̈ ]   [ Q ]
//!     [ Φ_q  0   ] [ λ ] = [ γ ]
//!
//! For the integrator γ may be replaced by Baumgarte's γ̂ = γ - 2α Φ̇ - β² Φ (Haug 7.3.8).

use super::augmented::{Augmented, Dependent};
use super::energy::Powers;
use super::{constraints, energy, forces, kinematics};
use crate::math::{Motion, Real};
use crate::model::Model;

/// Baumgarte's gains; zeros leave γ as it is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gains {
    /// α, 1/s.
    pub alpha: f64,
    /// β, 1/s.
    pub beta: f64,
}

/// The equations of motion have no unique solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Singular(pub Dependent);

/// Scratch for one model; carries no truth from one call to the next.
#[derive(Clone, Debug)]
pub struct Workspace<S = f64> {
    /// Motion of every body, ground first.
    pub motions: Vec<Motion<S>>,
    /// Φ.
    pub residual: Vec<S>,
    /// Φ_q q̇ + Φ_t.
    pub rate: Vec<S>,
    /// γ.
    pub gamma: Vec<S>,
    /// The augmented matrix.
    pub matrix: Augmented<S>,
    /// Right side, then solution (q̈, λ).
    solution: Vec<S>,
    n_q: usize,
}

impl<S: Real> Workspace<S> {
    /// All memory that evaluations of this model need.
    pub fn new(model: &Model<S>) -> Self {
        let (n, m) = (model.layout.n_q, model.layout.n_rows);
        Self {
            motions: Vec::with_capacity(model.bodies.len()),
            residual: vec![S::zero(); m],
            rate: vec![S::zero(); m],
            gamma: vec![S::zero(); m],
            matrix: Augmented::new(model),
            solution: vec![S::zero(); n + m],
            n_q: n,
        }
    }

    /// Solves the equations of motion at a state; then [`a`](Self::a), [`lam`](Self::lam).
    ///
    /// # Errors
    /// [`Singular`] where Φ_q loses rank.
    pub fn accelerate(
        &mut self,
        model: &Model<S>,
        t: S,
        q: &[S],
        v: &[S],
        gains: Gains,
    ) -> Result<(), Singular> {
        kinematics::motions(q, v, &mut self.motions);
        let (residual, rate, gamma) = (&mut self.residual, &mut self.rate, &mut self.gamma);
        constraints::velocity_terms(model, &self.motions, t, residual, rate, gamma);
        constraints::jacobian(model, &self.motions, t, self.matrix.jacobian_mut());
        self.matrix.set_mass(model, &self.motions);
        self.matrix.factor().map_err(Singular)?;
        let (forces, lower) = self.solution.split_at_mut(self.n_q);
        forces::generalized(model, &self.motions, t, forces);
        let (damping, stiffness) =
            (S::constant(2.0 * gains.alpha), S::constant(gains.beta * gains.beta));
        for (k, right) in lower.iter_mut().enumerate() {
            *right = self.gamma[k] - damping * self.rate[k] - stiffness * self.residual[k];
        }
        self.matrix.solve(&mut self.solution);
        Ok(())
    }

    /// q̈, shape (n_q).
    pub fn a(&self) -> &[S] {
        &self.solution[..self.n_q]
    }

    /// λ, shape (n_rows).
    pub fn lam(&self) -> &[S] {
        &self.solution[self.n_q..]
    }

    /// Powers at the state of the last [`accelerate`](Self::accelerate), drivers included.
    pub fn powers(&self, model: &Model<S>, t: S, v: &[S]) -> Powers<S> {
        let mut powers = energy::powers(model, &self.motions, t);
        let mut rows = [S::zero(); crate::elements::MOST_EQUATIONS];
        for (k, item) in model.constraints.iter().enumerate().filter(|(_, c)| c.driven) {
            let range = model.layout.constraints[k].rows.clone();
            let rows = &mut rows[..item.equations.len()];
            constraints::times(model, k, self.matrix.jacobian(), v, rows);
            for (rate, lam) in rows.iter().zip(&self.lam()[range]) {
                powers.drivers -= *rate * *lam;
            }
        }
        powers
    }
}
