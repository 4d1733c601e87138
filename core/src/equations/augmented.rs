//! The augmented matrix [W Φ_qᵀ; Φ_q -μ I] of a model, on a precomputed pattern.
//!
//! With W = M and μ = 0 it is the matrix of the equations of motion (Haug 6.3.18). With W = I it gives the smallest
//! step of Newton's method, and with μ > 0 a damped step.

use super::downdates::Downdate;
use super::lending::Lent;
use super::loans::{self, Addition};
use super::plan::Plan;
use super::{mass, Compiled};
use crate::math::{Motion, Real};
use crate::model::Model;
use crate::solve::{Breakdown, InverseMass, Saddle};
use std::sync::Arc;

/// The ridge ε² near singular positions. A small ε amplifies the rounding errors of positions by 1/ε. A large ε
/// disturbs the motion for a time proportional to ε. `docs/performance.md` lists the errors for other values.
pub const RIDGE: f64 = 1e-10;

/// Damping of an omitted row. All other terms of the row are then below rounding, and its multiplier is zero.
const OMITTED: f64 = 1e100;

/// The policy of a factorisation near a singular position, where a row of Φ_q is nearly dependent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NearSingular {
    /// Factorises as usual. Only dependent rows are an error.
    #[default]
    Ignore,
    /// Factorises with the ridge ε² = [`RIDGE`], which keeps the multipliers bounded.
    Regularise,
    /// Returns an error.
    Refuse,
}

/// The matrix and its factors, on a shared plan.
#[derive(Clone, Debug)]
pub struct Augmented<S = f64> {
    plan: Arc<Plan>,
    saddle: Saddle<S>,
    /// The inertia that is lent or added to light bodies in W.
    lent: Option<Arc<Lent<S>>>,
    /// Whether the rows of the downdates remove all additions.
    downdated: bool,
    near_singular: NearSingular,
    /// Whether the current factors contain the ridge.
    regularised: bool,
    /// The omitted rows.
    omitted: Vec<usize>,
}

impl<S: Real> Augmented<S> {
    /// A matrix with the elimination order of [`Plan::free`].
    #[inline]
    pub fn new<P: Real>(model: &Model<P>) -> Self {
        Self::on(Arc::new(Plan::free(model)))
    }

    /// A matrix on a given plan of the model.
    #[inline]
    pub fn on(plan: Arc<Plan>) -> Self {
        let saddle = Saddle::new(&plan.pattern);
        let near_singular = NearSingular::Ignore;
        let (lent, omitted) = (None, Vec::new());
        Self { saddle, plan, lent, downdated: false, near_singular, regularised: false, omitted }
    }

    /// The plan, which other matrices of the same model can share.
    #[inline]
    pub fn plan(&self) -> &Arc<Plan> {
        &self.plan
    }

    /// Plan and numbers, for an evaluation that writes its rows into the matrix one by one. The state-independent
    /// inertia must have been set. The factors then contain no ridge, and the additions are removed if there are
    /// [rows](Self::removes_additions) for this.
    #[inline(always)]
    pub(super) fn parts_mut(&mut self) -> (&Plan, &mut Saddle<S>) {
        self.regularised = false;
        if !self.downdated && !self.plan.downdates.is_empty() {
            self.set_downdates(true);
        }
        (&self.plan, &mut self.saddle)
    }

    /// Sets W = M at the given motions, including the inertia lent and added to light bodies.
    pub fn set_mass(&mut self, compiled: &Compiled<S>, motions: &[Motion<S>]) {
        self.set_inertia(compiled);
        let Self { plan, saddle, .. } = self;
        let inertias = &compiled.lent(plan.condenses).inertias;
        mass::turn_all(plan.pattern.coupled(), inertias, motions, &mut saddle.masses);
        for (grounded, group) in compiled.grounded.iter().zip(&mut saddle.condensed) {
            grounded.turn(inertias, motions, group);
        }
    }

    /// Whether an evaluation removes all additions.
    #[inline(always)]
    pub(super) fn removes_additions(&self) -> bool {
        let additions = self.lent.as_ref().map_or(&[][..], |lent| &lent.additions);
        additions.len() == self.plan.downdates.len()
    }

    /// Fills the rows that remove the additions, or omits these rows.
    #[inline(never)] // rare
    fn set_downdates(&mut self, active: bool) {
        let Self { plan, saddle, lent, .. } = self;
        let all = lent.as_ref().map_or(&[][..], |lent| &lent.additions);
        for (mu, downdate) in saddle.downdates.iter_mut().zip(&plan.downdates) {
            let Downdate { column, entry: [row, place] } = downdate;
            saddle.entries[*row][*place] = S::one();
            let own = all.iter().find(|addition| addition.column == *column && active);
            *mu = S::constant(own.map_or(OMITTED, |Addition { weight, .. }| -1.0 / weight));
        }
        self.downdated = active;
    }

    /// Sets the part of W = M that does not depend on the state. The matrix then contains the additions.
    pub(super) fn set_inertia(&mut self, compiled: &Compiled<S>) {
        let lent = compiled.lent(self.plan.condenses);
        let (bodies, own) = self.saddle.masses.split_at_mut(lent.inertias.len());
        for (mass, inertia) in bodies.iter_mut().zip(&lent.inertias) {
            let [m, j] = inertia.inverse;
            *mass = InverseMass::diagonal([m, m, j]);
        }
        let inverse = S::constant(1.0 / compiled.own_mass);
        let owners = &self.plan.owners[lent.inertias.len()..];
        for (mass, columns) in own.iter_mut().zip(owners) {
            *mass = InverseMass::first(columns.count, inverse);
        }
        let condensed = 0..self.saddle.condensed.len();
        for (k, grounded) in condensed.zip(&compiled.grounded) {
            grounded.set(k, &mut self.saddle);
        }
        self.lent = Some(Arc::clone(lent));
        if !self.plan.downdates.is_empty() {
            self.set_downdates(false);
        }
    }

    /// Sets a diagonal W, shape (n_q).
    ///
    /// # Panics
    /// If grounded bodies are condensed.
    pub fn set_weights(&mut self, weights: &[S]) {
        assert!(!self.plan.condenses, "condensed bodies have their own mass");
        for (mass, columns) in self.saddle.masses.iter_mut().zip(&self.plan.owners) {
            let mut inverse = [S::one(); 3];
            let d = &weights[columns.range()];
            inverse.iter_mut().zip(d).for_each(|(inverse, d)| *inverse = S::one() / *d);
            *mass = InverseMass::diagonal(inverse);
        }
        self.lent = None;
    }

    /// The entries of Φ_q, for writing.
    #[inline]
    pub fn jacobian_mut(&mut self) -> &mut [S] {
        self.saddle.entries.as_flattened_mut()
    }

    /// The entries of Φ_q.
    #[inline]
    pub fn jacobian(&self) -> &[S] {
        self.saddle.entries.as_flattened()
    }

    /// Sets the damping μ, one for each row.
    ///
    /// # Panics
    /// If grounded bodies are condensed.
    #[inline]
    pub fn set_damping(&mut self, mu: impl IntoIterator<Item = S>) {
        assert!(!self.plan.condenses, "condensed rows are not damped");
        self.saddle.damping.clear();
        self.saddle.damping.extend(mu);
    }

    /// Omits these rows and no others. Their multipliers vanish, and no other result depends on them.
    ///
    /// # Panics
    /// If grounded bodies are condensed.
    #[inline]
    pub fn omit(&mut self, rows: &[usize]) {
        let mut mu = vec![S::zero(); self.plan.pattern.n_rows()];
        rows.iter().for_each(|row| mu[*row] = S::constant(OMITTED));
        self.set_damping(mu);
        self.omitted.clear();
        self.omitted.extend_from_slice(rows);
    }

    /// Whether redundant rows are damped, so that no row is omitted.
    #[inline]
    pub fn damps(&self) -> bool {
        !self.saddle.damping.is_empty() && self.omitted.is_empty()
    }

    /// The omitted rows.
    #[inline]
    pub fn omitted(&self) -> &[usize] {
        &self.omitted
    }

    /// Sets the policy near singular positions.
    ///
    /// # Panics
    /// If a policy other than [`NearSingular::Ignore`] was set before.
    #[inline]
    pub fn set_near_singular(&mut self, policy: NearSingular) {
        match policy {
            NearSingular::Ignore => assert_eq!(self.near_singular, policy, "it stays"),
            NearSingular::Regularise | NearSingular::Refuse => self.saddle.refuse_near(),
        }
        self.near_singular = policy;
    }

    /// The policy near singular positions.
    #[inline]
    pub fn near_singular(&self) -> NearSingular {
        self.near_singular
    }

    /// Whether the current factors contain the ridge of a near singular position.
    #[inline]
    pub fn regularised(&self) -> bool {
        self.regularised
    }

    /// Factorises the matrix.
    ///
    /// # Errors
    /// The row of Φ_q that depends on other rows, or a coordinate without mass.
    pub fn factor(&mut self) -> Result<(), Breakdown> {
        self.regularised = false;
        let refused = match self.saddle.factor(&self.plan.pattern) {
            Err(Breakdown::Row(row)) if self.near_singular != NearSingular::Ignore => row,
            outcome => return outcome,
        };
        self.regularised = self.saddle.factor_regularised(&self.plan.pattern, RIDGE)?;
        match self.regularised && self.near_singular == NearSingular::Refuse {
            true => Err(Breakdown::Row(refused)),
            false => Ok(()),
        }
    }

    /// Whether inertia is added to light bodies, so that the matrix differs from that of the equations.
    #[inline]
    pub fn adds_inertia(&self) -> bool {
        !self.additions().is_empty()
    }

    /// The additions to W, by which the matrix differs from that of the equations. None if they are removed.
    #[inline(always)]
    pub(super) fn additions(&self) -> &[Addition] {
        self.lent.as_ref().filter(|_| !self.downdated).map_or(&[], |lent| &lent.additions)
    }

    /// Solves in place. x has the parts (q, multipliers), shape (n_q + n_rows).
    pub fn solve(&self, x: &mut [S]) {
        let (n, all) = (self.plan.pattern.n_unknowns(), self.plan.pattern.n_rows());
        let m = all - self.plan.downdates.len();
        if x.len() == n + all {
            return self.solve_padded(x);
        }
        let (q, rows) = x.split_at_mut(x.len() - m);
        let mut padded = vec![S::zero(); n + all];
        padded[..q.len()].copy_from_slice(q);
        padded[n..n + m].copy_from_slice(rows);
        self.solve_padded(&mut padded);
        q.copy_from_slice(&padded[..q.len()]);
        rows.copy_from_slice(&padded[n..n + m]);
    }

    /// Solves in place with the unknowns that pad the last group and the rows of the downdates. Applies the loans.
    fn solve_padded(&self, x: &mut [S]) {
        let Plan { pattern, .. } = &*self.plan;
        let loans = self.lent.as_ref().map_or(&[][..], |lent| &lent.loans);
        let (f, gamma) = x.split_at_mut(pattern.n_unknowns());
        loans::take(loans, &self.saddle.entries, gamma, f);
        self.saddle.solve(pattern, x);
        let (a, lam) = x.split_at_mut(pattern.n_unknowns());
        loans::give_back(loans, &self.saddle.entries, a, lam);
    }

    /// Solves for a load at a single coordinate into `x`, shape (n_unknowns + n_rows), without rows of downdates.
    #[inline]
    pub(super) fn put_response(&self, column: usize, load: S, x: &mut Vec<S>) {
        x.clear();
        x.resize(self.plan.pattern.n_unknowns() + self.plan.pattern.n_rows(), S::zero());
        x[column] = load;
        self.solve_padded(x);
        x.truncate(x.len() - self.plan.downdates.len());
    }

    /// Whether solutions need [corrections](super::refine::correct), because the removal of additions lost digits.
    #[inline(always)]
    pub(super) fn is_inexact(&self) -> bool {
        !self.plan.downdates.is_empty() && self.saddle.is_inexact(&self.plan.pattern)
    }

    /// The pivot that has lost most digits: its constraint row, and the ratio of the pivot to the largest number from
    /// which it was computed by subtraction.
    #[inline]
    pub fn cancellation(&self) -> Option<(usize, f64)> {
        self.saddle.cancellation(&self.plan.pattern)
    }

    /// The ratio of [`cancellation`](Self::cancellation), in each lane.
    #[inline]
    pub fn cancellations(&self) -> S {
        self.saddle.cancellations(&self.plan.pattern)
    }
}
