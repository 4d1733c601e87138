//! The augmented matrix [W Φ_qᵀ; Φ_q -μ I] of a model, on a pattern found once.
//!
//! With W = M and μ = 0 it is the matrix of the equations of motion (Haug 6.3.18); with W = I it
//! gives the smallest step of Newton's method, with μ > 0 a damped one.

use super::mass;
use crate::math::{Motion, Real};
use crate::model::{Block, Layout, Model, Slots};
pub use crate::solve::Dependent;
use crate::solve::{Pattern, RowBlock, Saddle, Weight};

/// ε² of near singular positions: between the noise of positions over ε and the load over a time in
/// proportion to ε; `docs/performance.md` has the errors for others.
pub const RIDGE: f64 = 1e-10;

/// Matrix, factors and pattern.
#[derive(Clone, Debug)]
pub struct Augmented<S = f64> {
    pattern: Pattern,
    saddle: Saddle<S>,
    /// Whether near singular positions are to be passed.
    passing: bool,
    /// Whether they are refused instead.
    refusing: bool,
    /// Whether the factor at hand has it.
    ridged: bool,
}

impl<S: Real> Augmented<S> {
    /// Memory and elimination order for a model: bodies first, then the constraints by minimum
    /// degree, so that every pivot is safe while Φ_q has full rank.
    pub fn new<P>(model: &Model<P>) -> Self {
        let coupled = model.inertias.iter().map(|inertia| inertia.coupled);
        let pattern = Pattern::new(coupled.collect(), &row_blocks(&model.layout));
        Self {
            saddle: Saddle::new(&pattern),
            pattern,
            passing: false,
            refusing: false,
            ridged: false,
        }
    }

    /// W = M at the given motions, with the inertia that the model adds to bodies without their own.
    pub fn set_mass(&mut self, model: &Model<S>, motions: &[Motion<S>]) {
        let bodies = model.inertias.iter().zip(&motions[1..]);
        for (weight, (inertia, motion)) in self.saddle.weights.iter_mut().zip(bodies) {
            mass::inverse(inertia, motion, weight);
        }
    }

    /// W diagonal, shape (n_q).
    pub fn set_weights(&mut self, weights: &[S]) {
        for (weight, d) in self.saddle.weights.iter_mut().zip(weights.chunks_exact(3)) {
            let inverse = [d[0], d[1], d[2]].map(|d| S::one() / d);
            *weight = Weight { inverse, shift: [S::zero(); 2] };
        }
    }

    /// The entries of Φ_q, to be filled.
    pub fn jacobian_mut(&mut self) -> &mut [S] {
        self.saddle.entries.as_flattened_mut()
    }

    /// The entries of Φ_q.
    pub fn jacobian(&self) -> &[S] {
        self.saddle.entries.as_flattened()
    }

    /// Sets the damping μ, one for each row.
    pub fn set_damping(&mut self, mu: impl IntoIterator<Item = S>) {
        for (value, mu) in self.saddle.damping.iter_mut().zip(mu) {
            *value = mu;
        }
    }

    /// From now on near singular positions are factorised with the ridge ε² = [`RIDGE`].
    pub fn pass_singular(&mut self) {
        self.saddle.refuse_near();
        self.passing = true;
    }

    /// From now on near singular positions are refused.
    pub fn refuse_singular(&mut self) {
        self.pass_singular();
        self.refusing = true;
    }

    /// Whether the factor at hand is that of a near singular position, with the ridge.
    pub fn ridged(&self) -> bool {
        self.ridged
    }

    /// Factorises.
    ///
    /// # Errors
    /// The row of Φ_q that depends on the others, or a coordinate without mass.
    pub fn factor(&mut self) -> Result<(), Dependent> {
        self.ridged = false;
        match self.saddle.factor(&self.pattern) {
            Err(Dependent::Row(row)) if self.passing => {
                self.ridged = self.saddle.factor_near(&self.pattern, RIDGE)?;
                match self.ridged && self.refusing {
                    true => Err(Dependent::Row(row)),
                    false => Ok(()),
                }
            }
            outcome => outcome,
        }
    }

    /// Factorises and solves in place, as [`solve`](Self::solve): faster than one after the other.
    ///
    /// # Errors
    /// As [`factor`](Self::factor); `x` is then lost. Near singular positions are refused too.
    pub fn factor_and_solve(&mut self, x: &mut [S]) -> Result<(), Dependent> {
        self.ridged = false;
        self.saddle.factor_and_solve(&self.pattern, x)
    }

    /// Solves in place; (q part, multiplier part), shape (n_q + n_rows).
    pub fn solve(&self, x: &mut [S]) {
        self.saddle.solve(&self.pattern, x);
    }

    /// How many digits the worst pivot lost: the constraint row and the pivot over what it was
    /// cancelled from.
    pub fn cancellation(&self) -> Option<(usize, f64)> {
        self.saddle.cancellation()
    }
}

/// The constraints as blocks of rows.
fn row_blocks(layout: &Layout) -> Vec<RowBlock> {
    let touches =
        |blocks: &[Block]| blocks.iter().map(|block| (block.body.0 - 1, block.first)).collect();
    let block = |slots: &Slots| RowBlock {
        size: slots.rows.len(),
        touches: touches(&slots.blocks),
        signs: slots.blocks.iter().map(|block| block.sign).filter(|sign| *sign != 0.0).collect(),
    };
    layout.constraints.iter().map(block).collect()
}
