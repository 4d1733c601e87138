//! The equations of motion with multipliers (Haug 6.3.18):
//!
//! ```text
//! [ M   Φ_qᵀ ] [ q̈ ]   [ Q ]
//! [ Φ_q  0   ] [ λ ] = [ γ ]
//! ```
//!
//! For the integrator, Baumgarte's γ̂ = γ - 2α Φ̇ - β² Φ (Haug 7.3.8) may replace γ.

use super::augmented::{self, Augmented, NearSingular};
use super::constraints::{self, Stabilized};
use super::forces::{self, Acting};
use super::gains::Gains;
use super::kinematics::Motions;
use super::plan::Plan;
use super::powers::Powers;
use super::roles::{self, Roles};
use super::{load_changes, mass, reactive, refine, Compiled};
use crate::math::Real;
use crate::model::Model;
use crate::solve::Breakdown;
use std::cell::Cell;
use std::sync::Arc;

/// Memory for the equations of motion of one model, and the results of the last evaluation: motions, accelerations,
/// multipliers, powers, Φ_q and the factors of the matrix.
///
/// No evaluation depends on earlier evaluations. But projection and implicit methods use the factors and Φ_q of the
/// last evaluation, so there must be no other evaluation in between.
#[derive(Clone, Debug)]
pub struct Workspace<S = f64> {
    /// Motion of every body, ground first.
    pub motions: Motions<S>,
    /// First-order states of elements, shape (n_z).
    pub z: Vec<S>,
    /// Data derived from the model.
    pub compiled: Arc<Compiled<S>>,
    /// Joints and drivers by role.
    roles: Roles<S>,
    /// The augmented matrix.
    pub matrix: Augmented<S>,
    /// Right side, then solution (q̈, λ).
    pub(super) solution: Vec<S>,
    /// Powers of the force elements.
    powers: Powers<S>,
    /// A constant vector that is subtracted from γ; empty if there is none.
    offset: Vec<S>,
    /// Vectors for solutions with a modified matrix.
    pub(super) memory: refine::Memory<S>,
    /// Whether one elimination is not sufficient, because redundant rows are damped.
    modified: bool,
    /// Whether forces depend on reactions.
    depends: bool,
    /// Whether the solution is corrected whatever the model.
    sharp: bool,
    /// The rows of the multipliers on which forces or loads of joints depend.
    reactive: Vec<usize>,
    pub(super) n_q: usize,
    /// Number of rows of Φ_q.
    pub(super) n_rows: usize,
    /// Number of unknowns of the solver: n_q, and the padding of a last group with fewer than three unknowns.
    pub(super) n_unknowns: usize,
}

/// Damping of redundant rows, relative to the largest compliance 1/m.
const REDUNDANT: f64 = 1e-10;

/// Damping with which the multipliers of redundant constraints become the smallest that balance the loads.
fn redundant_rows<S: Real>(model: &Model<S>, compiled: &Compiled<S>) -> impl Iterator<Item = S> {
    let mu = compiled.compliance() * S::constant(REDUNDANT);
    std::iter::repeat_n(mu, model.layout.n_rows)
}

impl<S: Real> Workspace<S> {
    /// A workspace with all memory for evaluations of this model.
    pub fn new(model: &Model<S>) -> Self {
        Self::on(model, Arc::new(Plan::of_motion(model)))
    }

    /// A workspace with the plan of elimination of `other`, which belongs to the same model with other numbers. It
    /// omits the rows that `other` omits.
    pub fn like<P: Real>(model: &Model<S>, other: &Workspace<P>) -> Self {
        let mut workspace = Self::on(model, Arc::clone(other.matrix.plan()));
        if !other.matrix.omitted().is_empty() {
            workspace.omit(other.matrix.omitted());
        }
        workspace
    }

    /// A workspace on the plan of the model's [equations of motion](Plan::of_motion).
    pub fn on(model: &Model<S>, plan: Arc<Plan>) -> Self {
        let (n_unknowns, plan_rows) = (plan.n_unknowns(), plan.pattern.n_rows());
        let compiled = Arc::new(Compiled::new(model));
        let roles = Roles::new(model, &compiled, &plan);
        let reactive = reactive::rows(model);
        let depends = reactive::depends(model);
        let redundant = plan.accepts_redundancy(model);
        let mut matrix = Augmented::on(plan);
        matrix.set_inertia(&compiled);
        if redundant {
            matrix.set_damping(redundant_rows(model, &compiled));
        }
        Self {
            motions: Motions::new(&model.layout),
            z: vec![S::zero(); model.layout.n_z],
            roles,
            matrix,
            modified: redundant,
            depends,
            sharp: false,
            reactive,
            compiled,
            solution: vec![S::zero(); n_unknowns + plan_rows],
            powers: Powers::zero(),
            offset: Vec::new(),
            memory: refine::Memory::default(),
            n_q: model.layout.n_q,
            n_rows: model.layout.n_rows,
            n_unknowns,
        }
    }

    /// Whether one elimination solves the equations at almost all states, with corrections if bodies are light.
    #[inline(always)]
    pub fn solves_directly(&self) -> bool {
        !self.modified && !self.depends
    }

    /// Whether the equations of another variant of the model, over any scalar, have the same structure.
    pub fn is_like<P: Real>(&self, other: &Workspace<P>) -> bool {
        let (plan, of_other) = (self.matrix.plan(), other.matrix.plan());
        Arc::ptr_eq(plan, of_other) || plan.is_like(of_other)
    }

    /// Declares that no rows are damped, so that one elimination solves the equations unless forces depend on
    /// reactions.
    pub(super) fn set_direct(&mut self) {
        self.modified = false;
    }

    /// Sets whether the solution is corrected whatever the model. Near singular positions multipliers are large, and
    /// without a correction the accelerations contain their rounding errors.
    #[inline(always)]
    pub fn sharpen(&mut self, sharp: bool) {
        self.sharp = sharp;
    }

    /// Whether the solution is corrected whatever the model.
    pub fn is_sharp(&self) -> bool {
        self.sharp
    }

    /// Whether the solution of one elimination is corrected.
    #[inline(always)]
    fn corrects(&self) -> bool {
        self.matrix.is_light() || self.depends || self.sharp
    }

    /// Sets a constant `term`, shape (n_rows), which is subtracted from γ at every state.
    pub fn set_offset(&mut self, term: &[S]) {
        self.offset.clear();
        self.offset.extend_from_slice(term);
    }

    /// Solves the equations of motion at a state. The results are [`a`](Self::a) and [`lam`](Self::lam).
    ///
    /// # Errors
    /// [`Breakdown`] if Φ_q loses rank, or if a load acts on a coordinate without mass or inertia.
    #[inline]
    pub fn accelerate(
        &mut self,
        model: &Model<S>,
        t: S,
        [q, v, z]: [&[S]; 3],
        gains: Gains,
    ) -> Result<(), Breakdown> {
        self.place(model, [q, v, z]);
        self.respond(model, t, gains)
    }

    /// Solves the equations of motion including the [loads](crate::elements::Joint::load) of joints, which change
    /// only multipliers.
    ///
    /// # Errors
    /// As [`accelerate`](Self::accelerate).
    #[inline]
    pub fn react(&mut self, model: &Model<S>, t: S, state: [&[S]; 3]) -> Result<(), Breakdown> {
        self.place(model, state);
        self.respond_without(model, t, Gains::default())?;
        self.add_reactive(model, t)
    }

    /// Sets coordinates, rates and first-order states, shapes (n_q), (n_q) and (n_z).
    #[inline(always)]
    pub fn place(&mut self, model: &Model<S>, [q, v, z]: [&[S]; 3]) {
        self.motions.place(&model.layout, q, v);
        self.place_states(z);
    }

    /// Sets the first-order states, shape (n_z).
    #[inline(always)]
    pub fn place_states(&mut self, z: &[S]) {
        if !z.is_empty() {
            self.z.copy_from_slice(z);
        }
    }

    /// Solves the equations of motion at the state that was [placed](Self::place).
    ///
    /// # Errors
    /// As [`accelerate`](Self::accelerate).
    #[inline(always)]
    pub fn respond(&mut self, model: &Model<S>, t: S, gains: Gains) -> Result<(), Breakdown> {
        self.respond_without(model, t, gains)?;
        match self.depends {
            true => self.add_reactive(model, t),
            false => Ok(()),
        }
    }

    /// As [`respond`](Self::respond), without forces and loads that depend on reactions.
    #[inline(always)]
    fn respond_without(&mut self, model: &Model<S>, t: S, gains: Gains) -> Result<(), Breakdown> {
        if !self.modified {
            match self.solve_directly(model, t, gains) {
                // friction that sticks keeps bodies at rest for long, where rounding errors would add up
                Ok(()) if self.corrects() => return self.correct(model),
                Err(Breakdown::Row(_)) if self.matrix.near_singular() != NearSingular::Ignore => {}
                outcome => return outcome,
            }
        }
        self.solve_and_refine(model, t, gains)
    }

    /// As [`respond`](Self::respond), if one elimination solves the equations. Otherwise, or if one of several lanes
    /// needs more, returns false.
    #[inline]
    pub fn respond_directly(&mut self, model: &Model<S>, t: S, gains: Gains) -> bool {
        let solved = self.solves_directly() && self.solve_directly(model, t, gains).is_ok();
        solved && (!self.matrix.is_light() || self.correct(model).is_ok())
    }

    /// Computes q̈ and λ if the matrix is that of the equations, or differs from it by what corrections remove. Each
    /// joint is added to the matrix when it is evaluated.
    #[inline(always)]
    fn solve_directly(&mut self, model: &Model<S>, t: S, gains: Gains) -> Result<(), Breakdown> {
        let corrects = self.corrects();
        let Self { motions, z, compiled, roles, matrix, solution, powers, offset, memory, .. } =
            self;
        let light = matrix.is_light();
        let (plan, saddle) = matrix.parts_mut();
        let stabilized = Stabilized::new(gains);
        let inertias = &compiled.light.inertias[..];
        let [f, kept] = memory.right_side(if corrects { [self.n_q, self.n_rows] } else { [0; 2] });
        let kept = Cell::from_mut(kept).as_slice_of_cells();
        let at =
            roles::At { model, compiled, plan, inertias, motions, t, stabilized, offset, kept };
        mass::turn_all(plan.pattern.coupled(), inertias, motions, &mut saddle.masses);
        let (x, right) = solution.split_at_mut(self.n_unknowns);
        let acting = Acting { z, lam: None, t };
        forces::generalized(model, compiled, motions, acting, x, powers);
        roles::put_others(roles, at, saddle, right);
        if corrects {
            f.copy_from_slice(&x[..self.n_q]);
            kept.iter().zip(&*right).for_each(|(kept, right)| kept.set(*right));
        }
        if light {
            augmented::weigh_internals(&compiled.light.internals, saddle);
        }
        roles::condense(roles, at, saddle, (x, right));
        saddle.divide_by_masses(&plan.pattern, x);
        roles::put(roles, at, saddle, (x, right));
        saddle.finish(&plan.pattern, solution)
    }

    /// Corrects the direct solution for light bodies and coordinates, and for friction.
    #[inline(never)] // rare
    fn correct(&mut self, model: &Model<S>) -> Result<(), Breakdown> {
        let Self { motions, matrix, solution, memory, .. } = self;
        refine::correct_direct((model, motions, matrix), solution, memory)
    }

    /// Solves with the whole matrix. Its factors may be those of a modified matrix.
    #[inline(never)] // rare; inlined, it would take registers from the common path
    fn solve_and_refine(&mut self, model: &Model<S>, t: S, gains: Gains) -> Result<(), Breakdown> {
        let Self { motions, z, compiled, matrix, solution, powers, offset, memory, .. } = self;
        let n = self.n_q;
        let mut x = vec![S::zero(); n + model.layout.n_rows];
        let (q, right) = x.split_at_mut(n);
        constraints::linearize(model, motions, t, gains, right, matrix.jacobian_mut());
        right.iter_mut().zip(offset).for_each(|(right, offset)| *right -= *offset);
        matrix.set_mass(compiled, motions);
        matrix.factor()?;
        forces::generalized(model, compiled, motions, Acting { z, lam: None, t }, q, powers);
        let outcome = refine::solve(model, motions, matrix, &mut x, memory);
        solution[..n].copy_from_slice(&x[..n]);
        solution[self.n_unknowns..][..self.n_rows].copy_from_slice(&x[n..]);
        outcome
    }

    /// Adds the forces and loads that depend on reactions to the solution without them.
    #[inline(never)] // as above
    fn add_reactive(&mut self, model: &Model<S>, t: S) -> Result<(), Breakdown> {
        if self.reactive.is_empty() {
            return Ok(());
        }
        let Self { motions, z, matrix, solution, powers, reactive, memory, .. } = self;
        let (n, padded) = (self.n_q, self.n_unknowns);
        let modified = self.modified || matrix.is_light() || matrix.regularised();
        let acting = Acting { z, lam: None, t };
        let sources = reactive::Sources::new(model, motions, acting, |direction| {
            let mut response = vec![S::zero(); solution.len()];
            if modified {
                let mut x = [direction, &vec![S::zero(); model.layout.n_rows]].concat();
                refine::solve(model, motions, matrix, &mut x, memory)?;
                response[..n].copy_from_slice(&x[..n]);
                response[padded..][..x.len() - n].copy_from_slice(&x[n..]);
            } else {
                response[..n].copy_from_slice(direction);
                matrix.solve(&mut response);
            }
            Ok(response)
        })?;
        let mut inertial = vec![S::zero(); n];
        mass::add_times(model, motions, &solution[..n], &mut inertial);
        let force = load_changes::largest(inertial.iter().copied());
        sources.add((reactive, padded, force), solution, powers).map_err(Breakdown::Reaction)
    }

    /// Solves K x = b with the factors of the last evaluation. `x` contains b before and the solution afterwards, shape
    /// (n_q + n_rows).
    ///
    /// # Errors
    /// A load on a coordinate without mass or inertia that no joint supports.
    pub fn solve(&mut self, model: &Model<S>, x: &mut [S]) -> Result<(), Breakdown> {
        let direct = self.solves_directly() && !self.corrects() && !self.matrix.regularised();
        let Self { motions, matrix, memory, .. } = self;
        match direct && x.len() == matrix.plan().n_unknowns() + matrix.plan().pattern.n_rows() {
            true => {
                matrix.solve(x);
                Ok(())
            }
            false => refine::solve(model, motions, matrix, x, memory),
        }
    }

    /// Computes ż at the state that was [placed](Self::place) into `out`, shape (n_z).
    #[inline(always)]
    pub fn state_rates(&self, model: &Model<S>, t: S, out: &mut [S]) {
        if !out.is_empty() {
            let acting = Acting { z: &self.z, lam: None, t };
            forces::state_rates(model, &self.motions, acting, out);
        }
    }

    /// q̈, shape (n_q).
    #[inline]
    pub fn a(&self) -> &[S] {
        &self.solution[..self.n_q]
    }

    /// λ, shape (n_rows).
    #[inline]
    pub fn lam(&self) -> &[S] {
        &self.solution[self.n_unknowns..self.n_unknowns + self.n_rows]
    }

    /// Powers at the state of the last [`accelerate`](Self::accelerate), including those of drivers.
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
            constraints::times(model, k, self.matrix.jacobian(), v, &mut rows);
            for (rate, lam) in rows.iter().zip(&self.lam()[range]) {
                powers.drivers -= *rate * *lam;
            }
        }
        powers
    }
}
