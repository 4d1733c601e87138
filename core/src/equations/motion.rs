//! The equations of motion with multipliers (Haug 6.3.18):
//!
//! ```text
//! [ M   Φ_qᵀ ] [ q̈ ]   [ Q ]
//! [ Φ_q  0   ] [ λ ] = [ γ ]
//! ```
//!
//! For the integrator γ may be replaced by Baumgarte's γ̂ = γ - 2α Φ̇ - β² Φ (Haug 7.3.8).

use super::augmented::{Augmented, Dependent, Parts};
use super::constraints::{self, Stabilized};
use super::energy::Powers;
use super::forces::Acting;
use super::kinematics::Motions;
use super::plan::Plan;
use super::{anchors, forces, mass, pins, refine, Compiled};
use crate::math::{Motion, Real};
use crate::model::Model;
use crate::solve::Bytes;
use std::sync::Arc;

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
    pub motions: Motions<S>,
    /// First-order states of elements.
    pub z: Vec<S>,
    /// Data derived from the model.
    pub compiled: Arc<Compiled<S>>,
    /// The augmented matrix.
    pub matrix: Augmented<S>,
    /// Right side, then solution (q̈, λ).
    solution: Vec<S>,
    /// Powers of the force elements.
    powers: Powers<S>,
    /// What γ is lessened by, whatever the state; empty if nothing.
    held: Vec<S>,
    /// Correction of the solution where the matrix is not that of the equations.
    correction: Option<Vec<S>>,
    /// Whether near singular positions are looked at twice.
    passing: bool,
    n_q: usize,
}

/// Damping of redundant rows, relative to the largest compliance 1/m.
const REDUNDANT: f64 = 1e-10;

impl<S: Real> Workspace<S> {
    /// All memory that evaluations of this model need.
    pub fn new(model: &Model<S>) -> Self {
        Self::on(model, Arc::new(Plan::of_motion(model)))
    }

    /// The same for a model whose plan of elimination `other` has, of the same model over other numbers.
    pub fn like<P: Real>(model: &Model<S>, other: &Workspace<P>) -> Self {
        Self::on(model, Arc::clone(other.matrix.plan()))
    }

    /// The same on the plan of the model's [equations of motion](Plan::of_motion).
    pub fn on(model: &Model<S>, plan: Arc<Plan>) -> Self {
        let (n, m) = (model.layout.n_q, model.layout.n_rows);
        let compiled = Arc::new(Compiled::new(model));
        let mut workspace = Self {
            motions: Motions::new(&model.layout),
            z: vec![S::zero(); model.layout.n_z],
            matrix: Augmented::on(plan),
            correction: compiled.has_added_inertia().then(|| vec![S::zero(); n + m]),
            solution: vec![S::zero(); n + m],
            powers: Powers::zero(),
            held: Vec::new(),
            passing: false,
            n_q: n,
            compiled,
        };
        workspace.matrix.set_inertia(&workspace.compiled);
        if model.allow_redundancy {
            workspace.allow_redundancy(model);
        }
        workspace
    }

    /// From now on near singular positions are passed, with the ridge of [`Augmented`].
    pub fn pass_singular(&mut self) {
        self.passing = true;
        self.matrix.pass_singular();
    }

    /// From now on positions near singular ones are refused.
    pub fn refuse_singular(&mut self) {
        self.passing = true;
        self.matrix.refuse_singular();
    }

    /// From now on γ is lessened by `term`, shape (n_rows), at every state.
    pub fn hold(&mut self, term: &[S]) {
        self.held.clear();
        self.held.extend_from_slice(term);
    }

    /// Accepts redundant constraints: the multipliers become the smallest that carry the loads.
    fn allow_redundancy(&mut self, model: &Model<S>) {
        let compliance = |b: &crate::model::Body<S>| S::one() / b.mass;
        let largest = model.bodies[1..].iter().map(compliance).fold(S::zero(), S::max);
        let mu = largest * S::constant(REDUNDANT);
        self.matrix.set_damping((0..model.layout.n_rows).map(|_| mu));
        self.correction = Some(vec![S::zero(); self.solution.len()]);
    }

    /// Solves the equations of motion at a state; then [`a`](Self::a), [`lam`](Self::lam).
    ///
    /// # Errors
    /// [`Singular`] where Φ_q loses rank, and where a torque turns an angle without any inertia.
    pub fn accelerate(
        &mut self,
        model: &Model<S>,
        t: S,
        [q, v, z]: [&[S]; 3],
        gains: Gains,
    ) -> Result<(), Singular> {
        self.place(model, [q, v, z]);
        self.respond(model, t, gains)
    }

    /// Sets coordinates, rates and first-order states, shapes (n_q), (n_q) and (n_z).
    #[inline(always)]
    pub fn place(&mut self, model: &Model<S>, [q, v, z]: [&[S]; 3]) {
        self.motions.place(&model.layout, q, v);
        self.z.copy_from_slice(z);
    }

    /// The same at the state that was [placed](Self::place).
    ///
    /// # Errors
    /// As [`accelerate`](Self::accelerate).
    #[inline(always)]
    pub fn respond(&mut self, model: &Model<S>, t: S, gains: Gains) -> Result<(), Singular> {
        if self.correction.is_none() {
            match self.solve_armed(model, t, gains) {
                Err(Dependent::Row(_)) if self.passing => {}
                outcome => return outcome.map_err(Singular),
            }
        }
        self.set_up(model, t, gains);
        self.factor_and_refine(model).map_err(Singular)
    }

    /// q̈ and λ with pins by their arms: one pass over them before elimination, and one after.
    #[inline(always)]
    fn solve_armed(&mut self, model: &Model<S>, t: S, gains: Gains) -> Result<(), Dependent> {
        let Self { motions, z, compiled, matrix, solution, powers, held, n_q, .. } = self;
        let (stabilized, n) = (Stabilized::new(gains), *n_q);
        let Parts { pattern, saddle, armed, others } = matrix.parts_mut();
        for &k in pattern.coupled() {
            let k = k as usize;
            mass::turn(&compiled.inertias[k], &motions[k + 1], &mut saddle.weights[k]);
        }
        let (forces, right) = solution.split_at_mut(n);
        *powers = forces::generalized(model, compiled, motions, Acting { z, lam: None, t }, forces);
        let (others, entries) =
            (others.iter().map(|k| *k as usize), saddle.entries.as_flattened_mut());
        constraints::linearize_some(model, others, motions, t, stabilized, right, entries);
        right.iter_mut().zip(&*held).for_each(|(right, held)| *right -= *held);
        anchors::begin(&compiled.anchors, motions, stabilized, held, saddle, (forces, right));
        saddle.weigh_others(pattern, solution);
        let (x, right) = solution.split_at_mut(n);
        pins::begin(&compiled.pins, armed, motions, stabilized, saddle, (x, right));
        pins::hold(&compiled.pins, armed, held, right);
        saddle.finish_begun(pattern, solution)?;
        let (x, lam) = solution.split_at_mut(n);
        pins::spread(&compiled.pins, armed, saddle, (x, lam));
        saddle.unbend(pattern, solution);
        Ok(())
    }

    /// The matrix and the right side (Q, γ̂), with all entries.
    fn set_up(&mut self, model: &Model<S>, t: S, gains: Gains) {
        let (forces, right) = self.solution.split_at_mut(self.n_q);
        let entries = self.matrix.jacobian_mut();
        constraints::linearize(model, &self.motions, t, gains, right, entries);
        // none but where a stabilization holds its term over a step
        right.iter_mut().zip(&self.held).for_each(|(right, held)| *right -= *held);
        self.matrix.set_mass(&self.compiled, &self.motions);
        let acting = Acting { z: &self.z, lam: None, t };
        self.powers = forces::generalized(model, &self.compiled, &self.motions, acting, forces);
    }

    /// Where the factor is not that of the equations.
    fn factor_and_refine(&mut self, model: &Model<S>) -> Result<(), Dependent> {
        self.matrix.factor()?;
        let mut correction = match self.correction.take() {
            Some(correction) => correction,
            None => vec![S::zero(); self.solution.len()],
        };
        let x = &mut self.solution;
        let solved =
            refine::solve((model, &self.compiled), &self.motions, &self.matrix, x, &mut correction);
        if self.compiled.has_added_inertia() || model.allow_redundancy {
            self.correction = Some(correction);
        }
        solved
    }

    /// Bytes that evaluations hold and touch: of this, and of the model what they read of bodies and pins;
    /// other constraints and forces are not counted.
    pub fn bytes(&self, model: &Model<S>) -> Bytes {
        let compiled = &*self.compiled;
        // no motion is there before the first evaluation
        let motions = std::mem::size_of::<Motion<S>>() * model.bodies.len();
        let own = Bytes { held: motions, touched: motions } + Bytes::touched(&self.solution);
        let aside = self.correction.as_deref().map_or(Bytes::default(), Bytes::aside);
        let of_model = Bytes::touched(&compiled.pins)
            + Bytes::touched(&compiled.inertias)
            + Bytes::touched(&compiled.anchors);
        self.matrix.bytes() + own + aside + of_model
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
    #[inline]
    pub fn powers(&self, model: &Model<S>, v: &[S]) -> Powers<S> {
        match model.driven {
            true => self.powers_driven(model, v),
            false => self.powers,
        }
    }

    #[inline(never)]
    fn powers_driven(&self, model: &Model<S>, v: &[S]) -> Powers<S> {
        let mut powers = self.powers;
        for (k, item) in model.constraints.iter().enumerate().filter(|(_, c)| c.driven) {
            let range = model.layout.constraints[k].rows.clone();
            let mut rows = vec![S::zero(); item.equations.len()];
            constraints::times(model, k, self.matrix.jacobian_of_others(), v, &mut rows);
            for (rate, lam) in rows.iter().zip(&self.lam()[range]) {
                powers.drivers -= *rate * *lam;
            }
        }
        powers
    }
}
