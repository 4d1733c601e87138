//! The equations of motion with multipliers (Haug 6.3.18):
//!
//! ```text
//! [ M   Φ_qᵀ ] [ q̈ ]   [ Q ]
//! [ Φ_q  0   ] [ λ ] = [ γ ]
//! ```
//!
//! For the integrator γ may be replaced by Baumgarte's γ̂ = γ - 2α Φ̇ - β² Φ (Haug 7.3.8).

use super::augmented::{Augmented, Dependent, NearSingular};
use super::constraints::{self, Stabilized};
use super::energy::Powers;
use super::plan::Plan;
use super::{forces, kinematics, mass, pairs, refine, Compiled};
use crate::math::{Motion, Real};
use crate::model::Model;
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

/// Memory for the equations of motion of one model, and the results of the last evaluation: motions, accelerations,
/// multipliers, powers, Φ_q and the factors of the matrix.
///
/// No evaluation depends on those before it. But projection and implicit methods use the factors, and Φ_q, that the last
/// one left, on purpose: between an evaluation and such a use no other may come.
#[derive(Clone, Debug)]
pub struct Workspace<S = f64> {
    /// Motion of every body, ground first.
    pub motions: Vec<Motion<S>>,
    /// Data derived from the model.
    pub compiled: Arc<Compiled<S>>,
    /// The augmented matrix.
    pub matrix: Augmented<S>,
    /// Right side, then solution (q̈, λ).
    solution: Vec<S>,
    /// Powers of the force elements.
    powers: Powers<S>,
    /// Subtracted from γ, whatever the state; empty if nothing.
    offset: Vec<S>,
    /// Whether the matrix is never that of the equations: inertia is added, or redundant rows are damped.
    modified: bool,
    n_q: usize,
}

/// Damping of redundant rows, relative to the largest compliance 1/m.
const REDUNDANT: f64 = 1e-10;

/// Damping with which the multipliers of redundant constraints become the smallest that carry the loads.
fn redundant_rows<S: Real>(model: &Model<S>) -> impl Iterator<Item = S> {
    let compliance = |b: &crate::model::Body<S>| S::one() / b.mass;
    let largest = model.bodies[1..].iter().map(compliance).fold(S::zero(), S::max);
    let mu = largest * S::constant(REDUNDANT);
    std::iter::repeat_n(mu, model.layout.n_rows)
}

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
        let mut matrix = Augmented::on(plan);
        matrix.set_inertia(&compiled);
        if model.allow_redundancy {
            matrix.set_damping(redundant_rows(model));
        }
        Self {
            motions: Vec::with_capacity(model.bodies.len()),
            matrix,
            modified: compiled.has_added_inertia() || model.allow_redundancy,
            compiled,
            solution: vec![S::zero(); n + m],
            powers: Powers::zero(),
            offset: Vec::new(),
            n_q: n,
        }
    }

    /// From now on `term`, shape (n_rows), is subtracted from γ at every state.
    pub fn set_offset(&mut self, term: &[S]) {
        self.offset.clear();
        self.offset.extend_from_slice(term);
    }

    /// Solves the equations of motion at a state; then [`a`](Self::a), [`lam`](Self::lam).
    ///
    /// # Errors
    /// [`Singular`] where Φ_q loses rank, and where a torque turns an angle without any inertia.
    pub fn accelerate(
        &mut self,
        model: &Model<S>,
        t: S,
        q: &[S],
        v: &[S],
        gains: Gains,
    ) -> Result<(), Singular> {
        kinematics::motions(q, v, &mut self.motions);
        self.respond(model, t, gains)
    }

    /// The same at the state that the [`motions`](Self::motions) describe.
    ///
    /// # Errors
    /// As [`accelerate`](Self::accelerate).
    #[inline(always)]
    pub fn respond(&mut self, model: &Model<S>, t: S, gains: Gains) -> Result<(), Singular> {
        if !self.modified {
            match self.solve_directly(model, t, gains) {
                Err(Dependent::Row(_)) if self.matrix.near_singular() != NearSingular::Ignore => {}
                outcome => return outcome.map_err(Singular),
            }
        }
        self.solve_and_refine(model, t, gains).map_err(Singular)
    }

    /// q̈ and λ where the matrix is that of the equations: joints of two rows are put into it as they are evaluated.
    #[inline(always)]
    fn solve_directly(&mut self, model: &Model<S>, t: S, gains: Gains) -> Result<(), Dependent> {
        let Self { motions, compiled, matrix, solution, powers, offset, n_q, .. } = self;
        let (plan, pattern, saddle) = matrix.parts_mut();
        let at = pairs::At { motions, t, stabilized: Stabilized::new(gains), offset };
        for &k in pattern.coupled() {
            let k = k as usize;
            mass::turn(&compiled.inertias[k], &motions[k + 1], &mut saddle.masses[k]);
        }
        let (x, right) = solution.split_at_mut(*n_q);
        *powers = forces::generalized(model, compiled, motions, t, x);
        let others = plan.others.iter().map(|k| *k as usize);
        let entries = saddle.entries.as_flattened_mut();
        constraints::linearize_some(model, others, motions, t, at.stabilized, right, entries);
        right.iter_mut().zip(&*offset).for_each(|(right, offset)| *right -= *offset);
        pairs::condense(compiled, at, (pattern, saddle), (x, right));
        saddle.divide_by_masses(pattern, x);
        pairs::put(compiled, (&plan.pins, &plan.pin_runs), at, saddle, (x, right));
        saddle.finish(pattern, solution)
    }

    /// The same by the whole matrix, with a factor that may be that of a modified one.
    fn solve_and_refine(&mut self, model: &Model<S>, t: S, gains: Gains) -> Result<(), Dependent> {
        let Self { motions, compiled, matrix, solution, powers, offset, n_q, .. } = self;
        let (forces, right) = solution.split_at_mut(*n_q);
        constraints::linearize(model, motions, t, gains, right, matrix.jacobian_mut());
        right.iter_mut().zip(offset).for_each(|(right, offset)| *right -= *offset);
        matrix.set_mass(compiled, motions);
        *powers = forces::generalized(model, compiled, motions, t, forces);
        matrix.factor()?;
        refine::solve((model, compiled), motions, matrix, solution)
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
