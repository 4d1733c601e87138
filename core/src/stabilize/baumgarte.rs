//! Baumgarte's stabilization with gains from the step.
//!
//! Gains that are worth their name bring an error of Φ back within few steps, so that they are of the order of
//! 1/h (a Taylor series of Φ over a step gives α = 1/h, β = √2/h: Flores, Machado, Seabra and Silva, *A
//! parametric study on the Baumgarte stabilization method*, J. Comput. Nonlinear Dyn. 6 (2011) 011019).
//! Evaluated at every stage, such gains make the equations stiff for the very step: stages are off the
//! constraints by h², times 1/h², and the order of the method falls to 2. Here the term is taken at the
//! beginning of a step and held over it,
//!
//! ```text
//! Φ̈ = -c ,   c = 2α Φ̇ₙ + β² Φₙ ,   2α = (1 + b/2) / h ,   β² = b / h²
//! ```
//!
//! so that stages see a smooth motion, the order is kept, and no step is limited. Then s = Φ + h Φ̇/2
//! is all that is carried from step to step, whatever their lengths (the other eigenvalue is 0):
//!
//! ```text
//! s' = (1 - b (1 + h'/h) / 2) s
//! ```
//!
//! which falls for every h'/h < 4/b - 1. No step control lets a step grow by more than 10.

use crate::equations::{constraints, Workspace};
use crate::model::Model;

/// b: an error falls by a third in a step, and does not grow while steps grow tenfold.
const B: f64 = 1.0 / 3.0;

/// Baumgarte's term, from the step and held over it.
#[derive(Clone, Debug)]
pub struct StepwiseBaumgarte {
    /// Φ, Φ̇ and γ at the beginning of the step; the first becomes the term.
    terms: [Vec<f64>; 3],
}

impl StepwiseBaumgarte {
    /// For a model.
    pub fn new(model: &Model) -> Self {
        Self { terms: std::array::from_fn(|_| vec![0.0; model.layout.n_rows]) }
    }

    /// Takes the term at (q, v) for a step of length `h`, negative backward in time, and has the
    /// workspace hold it.
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
