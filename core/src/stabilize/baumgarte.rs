//! Baumgarte's stabilization with gains that depend on the step size.
//!
//! Effective gains reduce an error of Φ within a few steps. They are therefore of the order of 1/h (a Taylor series
//! of Φ over a step gives α = 1/h, β = √2/h: Flores, Machado, Seabra and Silva, *A parametric study on the Baumgarte
//! stabilization method*, J. Comput. Nonlinear Dyn. 6 (2011) 011019). If the term is evaluated at every stage with
//! such gains, the equations become stiff for this step. Stages violate the constraints by h², the term multiplies
//! this violation by 1/h², and the order of the method falls to 2. Here the term is computed at the beginning of a
//! step and held constant over it,
//!
//! ```text
//! Φ̈ = -c ,   c = 2α Φ̇ₙ + β² Φₙ ,   2α = (1 + b/2) / h ,   β² = b / h²
//! ```
//!
//! The right side is then smooth over the step, the order is kept, and the step size is not limited. Only s = Φ + h
//! Φ̇/2 propagates from step to step, for any step size (the other eigenvalue is 0):
//!
//! ```text
//! s' = (1 - b (1 + h'/h) / 2) s
//! ```
//!
//! This error decreases for every h'/h < 4/b - 1. No step control increases a step by more than a factor of 10.

use crate::equations::{constraints, Workspace};
use crate::model::Model;

/// The constant b. An error decreases by a third in a step, and does not grow if the step grows tenfold.
const B: f64 = 1.0 / 3.0;

/// Baumgarte's term, computed from the step size and held constant over the step.
#[derive(Clone, Debug)]
pub struct StepwiseBaumgarte {
    /// Φ, Φ̇ and γ at the beginning of the step. Φ is overwritten by the term.
    terms: [Vec<f64>; 3],
}

impl StepwiseBaumgarte {
    /// Memory for a model.
    pub fn new(model: &Model) -> Self {
        Self { terms: std::array::from_fn(|_| vec![0.0; model.layout.n_rows]) }
    }

    /// Computes the term at (q, v) for a step of length `h` and sets it in the workspace. `h` is negative backward in
    /// time.
    pub fn hold(
        &mut self,
        model: &Model,
        workspace: &mut Workspace,
        t: f64,
        (q, v): (&[f64], &[f64]),
        h: f64,
    ) {
        let [term, rate, gamma] = &mut self.terms;
        workspace.motions.place(&model.layout, q, v);
        constraints::velocity_terms(model, &workspace.motions, t, term, rate, gamma);
        let (damping, stiffness) = ((1.0 + 0.5 * B) / h, B / (h * h));
        let pairs = term.iter_mut().zip(rate);
        pairs.for_each(|(phi, rate)| *phi = damping * *rate + stiffness * *phi);
        workspace.set_offset(term);
    }
}
