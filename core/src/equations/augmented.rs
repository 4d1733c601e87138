//! The augmented matrix [W Φ_qᵀ; Φ_q -μ I] of a model, on a pattern found once.
//!
//! With W = M and μ = 0 it is the matrix of the equations of motion (Haug 6.3.18); with W = I it
//! gives the smallest step of Newton's method, with μ > 0 a damped one.

use super::plan::{ArmedPin, Plan};
use super::{anchors, mass, Compiled};
use crate::math::{Motion, Real};
use crate::model::Model;
pub use crate::solve::Dependent;
use crate::solve::{Bytes, Pattern, Saddle, Weight};
use std::sync::Arc;

/// ε² of near singular positions: between the noise of positions over ε and the load over a time in
/// proportion to ε; `docs/performance.md` has the errors for others.
pub const RIDGE: f64 = 1e-10;

/// Matrix and factors, on a shared plan.
#[derive(Clone, Debug)]
pub struct Augmented<S = f64> {
    plan: Arc<Plan>,
    saddle: Saddle<S>,
    /// Whether near singular positions are to be passed.
    passing: bool,
    /// Whether they are refused instead.
    refusing: bool,
    /// Whether the factor at hand has it.
    ridged: bool,
    /// Whether the entries of Φ_q are those of all constraints.
    whole: bool,
}

/// What an evaluation puts into the matrix piece by piece.
pub(super) struct Parts<'a, S> {
    pub pattern: &'a Pattern,
    pub saddle: &'a mut Saddle<S>,
    /// The pins given by arms, in the order of elimination.
    pub armed: &'a [ArmedPin],
    /// The constraints given by entries.
    pub others: &'a [u32],
}

impl<S: Real> Augmented<S> {
    /// Memory and elimination order for a model, see [`Plan::free`].
    pub fn new<P: Real>(model: &Model<P>) -> Self {
        Self::on(Arc::new(Plan::free(model)))
    }

    /// Memory for a plan that was made for the model.
    pub fn on(plan: Arc<Plan>) -> Self {
        Self {
            saddle: Saddle::new(&plan.pattern),
            plan,
            passing: false,
            refusing: false,
            ridged: false,
            whole: true,
        }
    }

    /// The plan, for others of the same model.
    pub fn plan(&self) -> &Arc<Plan> {
        &self.plan
    }

    /// The pieces; inertia, which no state changes, must stand there already. The factor is then without ridge.
    #[inline(always)]
    pub(super) fn parts_mut(&mut self) -> Parts<'_, S> {
        self.ridged = false;
        let Plan { pattern, armed, others, .. } = &*self.plan;
        self.whole = armed.is_empty() && pattern.anchors().is_empty();
        Parts { pattern, saddle: &mut self.saddle, armed, others }
    }

    /// W = M at the given motions, with the inertia that is added to bodies without their own.
    pub fn set_mass(&mut self, compiled: &Compiled<S>, motions: &[Motion<S>]) {
        self.set_inertia(compiled);
        let bodies = compiled.inertias.iter().zip(&motions[1..]);
        for (weight, (inertia, motion)) in self.saddle.weights.iter_mut().zip(bodies) {
            mass::turn(inertia, motion, weight);
        }
        for (anchor, held) in compiled.anchors.iter().zip(&mut self.saddle.anchors) {
            let body = anchor.body as usize;
            anchors::turn(anchor, &motions[body + 1], &mut self.saddle.weights[body], held);
        }
    }

    /// What no state changes of W = M.
    pub(super) fn set_inertia(&mut self, compiled: &Compiled<S>) {
        for (weight, inertia) in self.saddle.weights.iter_mut().zip(&compiled.inertias) {
            let [m, j] = inertia.inverse;
            weight.inverse = [m, m, j];
        }
        for (anchor, held) in compiled.anchors.iter().zip(&mut self.saddle.anchors) {
            let weight = &mut self.saddle.weights[anchor.body as usize];
            weight.inverse = [S::zero(), S::zero(), anchor.inverse];
            weight.held = S::one() / anchor.mass;
            (held.mass, held.inverse) = (anchor.mass, anchor.inverse);
        }
    }

    /// W diagonal, shape (n_q).
    ///
    /// # Panics
    /// If bodies are anchored.
    pub fn set_weights(&mut self, weights: &[S]) {
        assert!(!self.plan.anchored, "anchored bodies weigh what they do");
        for (weight, d) in self.saddle.weights.iter_mut().zip(weights.chunks_exact(3)) {
            let inverse = [d[0], d[1], d[2]].map(|d| S::one() / d);
            *weight = Weight { inverse, shift: [S::zero(); 2], held: S::zero() };
        }
    }

    /// The entries of Φ_q, to be filled.
    pub fn jacobian_mut(&mut self) -> &mut [S] {
        self.whole = true;
        self.saddle.entries.as_flattened_mut()
    }

    /// The entries of Φ_q.
    ///
    /// # Panics
    /// After an evaluation, before [`restore_jacobian`](Self::restore_jacobian): that gives pins by their arms.
    pub fn jacobian(&self) -> &[S] {
        assert!(self.whole, "entries of Φ_q that an evaluation left out: restore_jacobian()");
        self.saddle.entries.as_flattened()
    }

    /// The entries of Φ_q, of which those of pins may be of an earlier state.
    pub(super) fn jacobian_of_others(&self) -> &[S] {
        self.saddle.entries.as_flattened()
    }

    /// Fills in the entries of Φ_q that the last evaluation left out.
    pub fn restore_jacobian(&mut self) {
        if !self.whole {
            self.saddle.restore_entries(&self.plan.pattern);
            self.whole = true;
        }
    }

    /// Sets the damping μ, one for each row.
    ///
    /// # Panics
    /// If bodies are anchored.
    pub fn set_damping(&mut self, mu: impl IntoIterator<Item = S>) {
        assert!(!self.plan.anchored, "anchors are not damped");
        self.saddle.damping.clear();
        self.saddle.damping.extend(mu);
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
        match self.saddle.factor(&self.plan.pattern) {
            Err(Dependent::Row(row)) if self.passing => {
                self.ridged = self.saddle.factor_near(&self.plan.pattern, RIDGE)?;
                match self.ridged && self.refusing {
                    true => Err(Dependent::Row(row)),
                    false => Ok(()),
                }
            }
            outcome => outcome,
        }
    }

    /// Solves in place; (q part, multiplier part), shape (n_q + n_rows).
    pub fn solve(&self, x: &mut [S]) {
        self.saddle.solve(&self.plan.pattern, x);
    }

    /// Bytes of the plan and of the numbers.
    pub fn bytes(&self) -> Bytes {
        self.plan.bytes() + self.saddle.bytes(&self.plan.pattern)
    }

    /// The work of finding the elimination order and the plan, see [`Pattern::effort`].
    pub fn effort(&self) -> usize {
        self.plan.pattern.effort()
    }

    /// How many digits the worst pivot lost: the constraint row and the pivot over what it was
    /// cancelled from.
    pub fn cancellation(&self) -> Option<(usize, f64)> {
        self.saddle.cancellation(&self.plan.pattern)
    }
}
