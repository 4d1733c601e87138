//! The augmented matrix [W Φ_qᵀ; Φ_q -μ I] of a model, on a precomputed pattern.
//!
//! With W = M and μ = 0 it is the matrix of the equations of motion (Haug 6.3.18). With W = I it gives the smallest
//! step of Newton's method, and with μ > 0 a damped step.

use super::light::{self, Internal, Light};
use super::plan::Plan;
use super::{mass, Compiled};
use crate::math::{indexed, Listed, Motion, Real, ShortArray};
use crate::model::Model;
use crate::solve::{Breakdown, InverseMass, LightGroup, Saddle};
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

/// Sets W of internal coordinates to their E.
#[inline]
pub(super) fn weigh_internals<S: Real>(internals: &[Internal], saddle: &mut Saddle<S>) {
    for own in internals {
        let added = own.inertia(|row| saddle.entries[row]);
        // 1 beyond the unknowns of the group
        let inverse = |k: usize| if k < own.size { S::one() / added[k] } else { S::one() };
        saddle.masses[own.owner] = InverseMass::diagonal(indexed(inverse));
    }
}

/// The matrix and its factors, on a shared plan.
#[derive(Clone, Debug)]
pub struct Augmented<S = f64> {
    plan: Arc<Plan>,
    saddle: Saddle<S>,
    /// The light bodies and coordinates, if W = M.
    light: Option<Arc<Light<S>>>,
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
        let (light, omitted) = (None, Vec::new());
        Self { saddle, plan, light, near_singular, regularised: false, omitted }
    }

    /// The plan, which other matrices of the same model can share.
    #[inline]
    pub fn plan(&self) -> &Arc<Plan> {
        &self.plan
    }

    /// Plan and numbers, for an evaluation that writes its rows into the matrix one by one. The state-independent
    /// inertia must have been set. The factors then contain no ridge.
    #[inline(always)]
    pub(super) fn parts_mut(&mut self) -> (&Plan, &mut Saddle<S>) {
        self.regularised = false;
        (&self.plan, &mut self.saddle)
    }

    /// Sets W = M at the given motions, including what is added to massless bodies.
    pub fn set_mass(&mut self, compiled: &Compiled<S>, motions: &[Motion<S>]) {
        self.set_inertia(compiled);
        let Self { plan, saddle, .. } = self;
        let inertias = &compiled.light.inertias;
        mass::turn_all(plan.pattern.coupled(), inertias, motions, &mut saddle.masses);
        for (grounded, group) in compiled.grounded.iter().zip(&mut saddle.condensed) {
            grounded.turn(inertias, motions, group);
        }
    }

    /// Sets the part of W = M that does not depend on the state.
    pub(super) fn set_inertia(&mut self, compiled: &Compiled<S>) {
        let light = &compiled.light;
        for (mass, inertia) in self.saddle.masses.iter_mut().zip(&light.inertias) {
            let [m, j] = inertia.inverse;
            *mass = InverseMass::diagonal([m, m, j]);
        }
        let condensed = 0..self.saddle.condensed.len();
        for (k, grounded) in condensed.zip(&compiled.grounded) {
            grounded.set(k, &mut self.saddle);
        }
        if self.light.as_ref().is_none_or(|known| !Arc::ptr_eq(known, light)) {
            self.set_light(compiled);
        }
    }

    /// Sets the light groups.
    fn set_light(&mut self, compiled: &Compiled<S>) {
        let Light { ratios, internals, .. } = &*compiled.light;
        let mut groups: Vec<LightGroup> = ratios
            .iter()
            .enumerate()
            .filter(|(_, ratios)| **ratios != [1.0; 2])
            .map(|(group, ratios)| LightGroup { group, ratios: *ratios })
            .list();
        for grounded in compiled.grounded.iter().filter(|_| self.plan.condenses) {
            // the freedom of a pin is a rotation; that of other joints counts as a translation
            let own = groups.iter_mut().find(|light| light.group == grounded.body.0 - 1);
            own.into_iter().for_each(|light| light.ratios[1] = grounded.ratio(light.ratios));
        }
        let ratios = [light::FLOOR / light::COUNTED; 2];
        internals.iter().map(|own| LightGroup { group: own.owner, ratios }).append_to(&mut groups);
        self.saddle.set_light(&self.plan.pattern, &groups);
        self.light = Some(Arc::clone(&compiled.light));
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
        self.light = None;
        self.saddle.set_light(&self.plan.pattern, &[]);
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
        if let Some(light) = &self.light {
            weigh_internals(&light.internals, &mut self.saddle);
        }
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

    /// Whether solutions need [corrections](super::refine), because of light bodies or coordinates.
    #[inline(always)]
    pub fn is_light(&self) -> bool {
        self.light.as_ref().is_some_and(|light| light.any)
    }

    /// The kinetic energy of the inertia that light bodies have in the matrix only. Rounding errors of works are small
    /// fractions of it.
    pub fn added_energy(&self, motions: &[Motion<S>]) -> f64 {
        let added = self.light.iter().flat_map(|light| &light.added);
        let of_body = |(motion, [mass, inertia]): (&Motion<S>, &[f64; 2])| {
            let [speed, omega] = [motion.twist.velocity.norm(), motion.twist.omega];
            let [speed, omega] = [speed, omega].each(|x| x.largest_magnitude());
            0.5 * (mass * speed * speed + inertia * omega * omega)
        };
        motions.iter().skip(1).zip(added).map(of_body).sum()
    }

    /// Solves in place. x has the parts (q, multipliers), with or without the unknowns that pad the last group.
    pub fn solve(&self, x: &mut [S]) {
        let (n, m) = (self.plan.pattern.n_unknowns(), self.plan.pattern.n_rows());
        if x.len() == n + m {
            return self.saddle.solve(&self.plan.pattern, x);
        }
        let (q, rows) = x.split_at_mut(x.len() - m);
        let mut padded = vec![S::zero(); n + m];
        padded[..q.len()].copy_from_slice(q);
        padded[n..].copy_from_slice(rows);
        self.saddle.solve(&self.plan.pattern, &mut padded);
        q.copy_from_slice(&padded[..q.len()]);
        rows.copy_from_slice(&padded[n..]);
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

    /// The logarithm of the determinant of Φ_q W⁻¹ Φ_qᵀ.
    #[inline]
    pub fn log_determinant(&self) -> S {
        self.saddle.log_determinant(&self.plan.pattern)
    }
}
