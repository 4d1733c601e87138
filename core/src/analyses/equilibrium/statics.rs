//! The equations at rest: Φ(q, t) = 0, Φ_qᵀ λ = Q(q, 0, z, t) and ż = 0, with v = 0.

use super::failure::Reason;
use crate::analyses::assemble::Closing;
use crate::analyses::linearization::{Freedoms, LeastNorm, StatePoint, Variation};
use crate::elements::Nature;
use crate::equations::balance::Balance;
use crate::equations::energy;
use crate::equations::forces::{self, Acting};
use crate::equations::kinematics::Motions;
use crate::equations::tangent::Tangent;
use crate::equations::{reactions, reactive};
use crate::math::{each, Listed, Vec2};
use crate::model::{column_scales, row_scales, size, Model};
use crate::solve::solve_dense;

/// Largest number of iterations for the states of elements.
const ITERATIONS: usize = 30;

/// Remaining fraction of a pivot below which a position counts as nearly singular.
const SINGULAR: f64 = 1e-6;

/// A closed position with its forces at rest.
#[derive(Clone, Debug)]
pub(super) struct StaticState {
    /// Coordinates, shape (n_q).
    pub q: Vec<f64>,
    /// States of elements with ż = 0, shape (n_z).
    pub z: Vec<f64>,
    /// Multipliers that balance the forces as far as the constraints can, shape (n_rows).
    pub lam: Vec<f64>,
    /// Φ_qᵀ λ - Q, shape (n_q): the forces that are missing for equilibrium.
    pub missing: Vec<f64>,
    /// The largest single force times its arm, J; zero without forces.
    pub scale: f64,
}

/// The forces and the stiffness along the degrees of freedom at a position.
pub(super) struct LocalForces {
    /// The degrees of freedom, with a basis that is orthonormal in the scaled coordinates.
    pub basis: Freedoms,
    /// The forces missing along the basis, J.
    pub gradient: Vec<f64>,
    /// Their derivative along the basis, J, shape (f, f).
    pub stiffness: Vec<f64>,
}

/// Evaluates a model at rest.
pub(super) struct Statics<'a> {
    pub model: &'a Model,
    pub t: f64,
    closing: Closing<'a>,
    balance: Balance,
    rest: Vec<f64>,
    none: Vec<f64>,
    /// Scales of the coordinates and of the rows of Φ.
    pub columns: Vec<f64>,
    rows: Vec<f64>,
    /// Indices in z of the states that have a rate ż. The states of sampled laws keep their values, and so do the
    /// speeds with which contacts began.
    states: Vec<usize>,
    /// Whether rows of Φ may be linearly dependent.
    redundant: bool,
    /// Whether all forces have a potential at rest.
    conservative: bool,
}

const NEVER: &dyn Fn() -> bool = &|| false;

impl<'a> Statics<'a> {
    pub fn new(model: &'a Model, t: f64) -> Self {
        let layout = &model.layout;
        Self {
            closing: Closing::new(model, t, NEVER),
            balance: Balance::new(model),
            rest: vec![0.0; layout.n_q],
            none: vec![0.0; layout.n_rows],
            columns: column_scales(model),
            rows: row_scales(model),
            states: model.changing_states(),
            redundant: model.allow_redundancy,
            conservative: is_conservative(model),
            model,
            t,
        }
    }

    /// The position near `q` where the constraints are closed and the states of elements are at rest.
    ///
    /// # Errors
    /// The [`Reason`] concerns this position only; the search may continue at another position.
    pub fn place(&mut self, q: &[f64], z: &[f64]) -> Result<StaticState, Reason> {
        let mut q = q.to_vec();
        if !self.closing.close(&mut q).1 || q.iter().any(|x| !x.is_finite()) {
            return Err(Reason::Open);
        }
        let factors = LeastNorm::new(self.model, self.t, &q, self.redundant)
            .map_err(|_| Reason::singular(self.model, self.t, &q))?;
        let z = self.settled(&q, z)?;
        self.evaluate(&q, &z, &self.none.clone());
        let applied: Vec<f64> = self.balance.forces.iter().map(|x| -x).list();
        let mut lam = factors.multipliers(&applied);
        if self.model.forces.iter().any(|item| item.reaction.is_some()) {
            self.evaluate(&q, &z, &lam);
            let applied = self.applied(&factors, &lam);
            lam = factors.multipliers(&applied);
        }
        self.evaluate(&q, &z, &lam);
        let missing = self.balance.forces.clone();
        if missing.iter().chain(&lam).any(|x| !x.is_finite()) {
            return Err(Reason::NotFinite);
        }
        let scale = self.force_scale(&z, &lam);
        Ok(StaticState { q, z, lam, missing, scale })
    }

    /// Q, including the forces that depend on the reactions λ.
    fn applied(&self, factors: &LeastNorm<'_>, lam: &[f64]) -> Vec<f64> {
        let internal = factors.transposed(lam);
        internal.iter().zip(&self.balance.forces).map(|(all, missing)| all - missing).list()
    }

    fn evaluate(&mut self, q: &[f64], z: &[f64], lam: &[f64]) {
        self.balance.evaluate(self.model, self.t, [q, &self.rest, &self.rest, z], lam);
    }

    /// The states of elements with ż = 0 at a position, by Newton's method.
    fn settled(&mut self, q: &[f64], z: &[f64]) -> Result<Vec<f64>, Reason> {
        let (mut z, n) = (z.to_vec(), self.states.len());
        if n == 0 {
            return Ok(z);
        }
        let mut last = f64::INFINITY;
        for _ in 0..ITERATIONS {
            self.evaluate(q, &z, &self.none.clone());
            let mut step: Vec<f64> =
                self.states.iter().map(|at| -self.balance.state_rates[*at]).list();
            let at = StatePoint { q, v: &self.rest, z: &z, a: &self.rest, lam: &self.none };
            let variation = Variation::new(self.model, self.t, at, false);
            let mut matrix = self.by_states(&variation, z.len()).rates;
            if !solve_dense(&mut matrix, &mut step) {
                return Err(Reason::state(self.model, self.states[0]));
            }
            self.states.iter().zip(&step).for_each(|(at, dz)| z[*at] += dz);
            let size =
                self.states.iter().zip(&step).map(|(at, dz)| dz.abs() / z[*at].abs().max(1.0));
            let size = size.fold(0.0, f64::max);
            if size < 1e-14 || (size < 1e-9 && size >= last) {
                return Ok(z);
            }
            last = size;
        }
        Err(Reason::state(self.model, self.states[0]))
    }

    /// The multipliers, including the effect of the [loads](crate::elements::Joint::load) of joints, which do no
    /// work. The loads depend only on multipliers that they do not change.
    pub fn with_loads(&self, place: &StaticState) -> Result<Vec<f64>, Reason> {
        let motions = Motions::at_rest(&self.model.layout, &place.q);
        let mut loads = vec![0.0; place.q.len()];
        reactions::add_loads(self.model, &motions, self.t, &place.lam, &mut loads);
        if loads.iter().all(|x| *x == 0.0) {
            return Ok(place.lam.clone());
        }
        let factors = LeastNorm::new(self.model, self.t, &place.q, self.redundant)
            .map_err(|_| Reason::singular(self.model, self.t, &place.q))?;
        let more = factors.multipliers(&loads);
        Ok(place.lam.iter().zip(more).map(|(lam, more)| lam + more).list())
    }

    /// The joint or driver whose equations are nearly dependent at a position, if there is one.
    pub fn near_singular(&self, place: &StaticState) -> Option<String> {
        let factors = LeastNorm::new(self.model, self.t, &place.q, self.redundant).ok()?;
        let (row, _) = factors.cancellation().filter(|(_, kept)| *kept < SINGULAR)?;
        Some(self.model.constraints[self.model.layout.owner(row).0].name.clone())
    }

    /// The degrees of freedom at a position.
    pub fn freedoms(&self, place: &StaticState) -> Result<Freedoms, Reason> {
        Freedoms::at(self.model, self.t, &place.q)
            .map_err(|_| Reason::singular(self.model, self.t, &place.q))
    }

    /// Forces and stiffness along the degrees of freedom at a position.
    pub fn local(&self, place: &StaticState) -> Result<LocalForces, Reason> {
        let mut basis = self.freedoms(place)?;
        basis.orthonormalize(&self.columns);
        let gradient = basis.reduce(&place.missing);
        let stiffness = self.stiffness(place, &basis)?;
        Ok(LocalForces { basis, gradient, stiffness })
    }

    /// The reduced stiffness on a basis, shape (f, f). The states of elements change so that ż = 0.
    pub fn stiffness(&self, place: &StaticState, basis: &Freedoms) -> Result<Vec<f64>, Reason> {
        let directions: Vec<&[f64]> = basis.basis.iter().map(Vec::as_slice).list();
        let slopes = self.slopes(place, &directions)?;
        let f = basis.basis.len();
        let mut stiffness = vec![0.0; f * f];
        for (column, slope) in slopes.iter().enumerate() {
            for (row, entry) in basis.reduce(slope).into_iter().enumerate() {
                stiffness[row * f + column] = entry;
            }
        }
        match stiffness.iter().all(|x| x.is_finite()) {
            true => Ok(stiffness),
            false => Err(Reason::NotFinite),
        }
    }

    /// The derivatives of Φ_qᵀ λ - Q along directions of q at constant λ, each of shape (n_q). The states of elements
    /// change so that ż = 0.
    pub fn slopes(
        &self,
        place: &StaticState,
        directions: &[&[f64]],
    ) -> Result<Vec<Vec<f64>>, Reason> {
        let at =
            StatePoint { q: &place.q, v: &self.rest, z: &place.z, a: &self.rest, lam: &place.lam };
        let variation = Variation::new(self.model, self.t, at, false);
        let by_states = self.by_states(&variation, place.z.len());
        if reactive::depends(self.model) {
            let along = |direction: &&[f64]| {
                let slopes = variation.along(StatePoint { q: direction, ..StatePoint::default() });
                self.followed(&by_states, slopes.forces, &slopes.states)
            };
            return directions.iter().map(along).collect();
        }
        let motions = Motions::at_rest(&self.model.layout, &place.q);
        let mut tangent = Tangent::new(self.model);
        tangent.linearize(self.model, &motions, self.t, [&self.rest, &place.lam, &place.z]);
        let (n, n_z) = (place.q.len(), place.z.len());
        let mut product = vec![0.0; n + n_z + place.lam.len()];
        let along = |direction: &&[f64]| {
            tangent.times(self.model, [&self.rest, &vec![0.0; n_z], direction], &mut product);
            let forces = product[..n].iter().map(|x| -x).list();
            self.followed(&by_states, forces, &product[n..n + n_z])
        };
        directions.iter().map(along).collect()
    }

    /// The change of Φ_qᵀ λ - Q if the states of elements change so that ż = 0. `forces` and `change` are the changes
    /// of Φ_qᵀ λ - Q and ż at constant states.
    pub fn followed(
        &self,
        SlopesByStates { rates, forces: columns }: &SlopesByStates,
        mut forces: Vec<f64>,
        change: &[f64],
    ) -> Result<Vec<f64>, Reason> {
        let mut dz: Vec<f64> = self.states.iter().map(|at| -change[*at]).list();
        if !solve_dense(&mut rates.clone(), &mut dz) {
            return Err(Reason::state(self.model, self.states[0]));
        }
        for (column, dz) in columns.iter().zip(&dz) {
            forces.iter_mut().zip(column).for_each(|(f, slope)| *f += slope * dz);
        }
        Ok(forces)
    }

    /// Derivatives with respect to the states of elements.
    pub fn by_states(&self, variation: &Variation<'_>, n_z: usize) -> SlopesByStates {
        let n = self.states.len();
        let mut found = SlopesByStates { rates: vec![0.0; n * n], forces: Vec::new() };
        for (column, at) in self.states.iter().enumerate() {
            let mut unit = vec![0.0; n_z];
            unit[*at] = 1.0;
            let slopes = variation.along(StatePoint { z: &unit, ..StatePoint::default() });
            for (row, at) in self.states.iter().enumerate() {
                found.rates[row * n + column] = slopes.states[*at];
            }
            found.forces.push(slopes.forces);
        }
        found
    }

    /// The energy of `to` minus that of `from`. It is the difference of the potentials if all forces have a potential
    /// and the difference exceeds rounding errors. Otherwise it is computed from the forces by the trapezoidal rule.
    pub fn energy_change(&self, from: &StaticState, to: &StaticState) -> f64 {
        let both = from.missing.iter().zip(&to.missing);
        let way = to.q.iter().zip(&from.q).map(|(b, a)| b - a);
        let work: f64 = both.zip(way).map(|((a, b), dq)| 0.5 * (a + b) * dq).sum();
        if !self.conservative {
            return work;
        }
        let [before, after] = each([from, to], |place| {
            let motions = Motions::at_rest(&self.model.layout, &place.q);
            energy::potential(self.model, &motions, &place.z, self.t)
        });
        let change = after - before;
        let certain = 1e-7 * (before.abs() + after.abs() + from.scale);
        if change.abs() > certain {
            change
        } else {
            work
        }
    }

    /// Largest scaled component of a motion.
    pub fn largest(&self, dq: &[f64]) -> f64 {
        dq.iter().zip(&self.columns).fold(0.0, |most: f64, (x, scale)| most.max((x / scale).abs()))
    }

    /// The largest weight, force, torque or multiplier times its arm, J.
    fn force_scale(&self, z: &[f64], lam: &[f64]) -> f64 {
        let (model, motions, arm) = (self.model, &self.balance.motions, size(self.model));
        let weight = |m: f64| m * model.gravity.norm() * arm;
        let mut most = model.bodies[1..].iter().map(|body| weight(body.mass)).fold(0.0, f64::max);
        let acting = Acting { z, lam: Some(lam), t: self.t };
        for k in 0..model.forces.len() {
            forces::each_wrench(model, k, motions, acting, |_, _, w| {
                let force: Vec2 = w.force;
                most = most.max(force.norm() * arm).max(w.torque.abs());
            });
        }
        lam.iter().zip(&self.rows).fold(most, |most, (lam, scale)| most.max((lam * scale).abs()))
    }
}

/// Derivatives with respect to the states of elements.
pub(super) struct SlopesByStates {
    /// Derivatives of ż, shape (n, n).
    rates: Vec<f64>,
    /// Derivatives of Φ_qᵀ λ - Q, one column for each state.
    forces: Vec<Vec<f64>>,
}

fn is_conservative(model: &Model) -> bool {
    model.forces.iter().all(|item| {
        let natures = item.element.parts().iter().map(|part| part.nature);
        let potential = |nature| matches!(nature, Nature::Conservative | Nature::Dissipative);
        item.law.is_none() && item.states.is_empty() && natures.into_iter().all(potential)
    })
}
