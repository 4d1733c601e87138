//! The derivatives of an equilibrium, by the implicit function theorem.

use super::variables::parameters;
use crate::analyses::assemble::{implicit, position, StartSlopes};
use crate::analyses::equilibrium::Options;
use crate::analyses::measures::Measure;
use crate::analyses::signals::Seen;
use crate::analyses::State;
use crate::equations::kinematics::Motions;
use crate::equations::sensitivity::{Sensitivity, Slope, ABREAST};
use crate::equations::{dense, reactive};
use crate::expression::{Symbol, Tape};
use crate::math::{Dual, Listed, Real};
use crate::model::{Blueprint, Model};
use std::sync::Arc;

/// An equilibrium with derivatives by the variables of a block.
pub(super) struct AtRest {
    over: Sensitivity,
    t: Slope,
    q: Vec<Slope>,
    z: Vec<Slope>,
    lam: Vec<Slope>,
    /// Number of rows before those of the holders.
    own: usize,
}

impl AtRest {
    /// The derivatives of the equilibrium at `state` that was found from `start`.
    ///
    /// # Errors
    /// The reason for which there are no derivatives.
    pub fn find(
        (model, options): (&Model, &Options),
        names: &[String],
        start: (&State, &StartSlopes),
        (state, lam): (&State, &[f64]),
    ) -> Result<Self, String> {
        if !state.z.is_empty() {
            return Err("elements have first-order states".to_string());
        }
        if reactive::depends(model) || !model.switches.is_empty() {
            return Err("forces switch or depend on reactions".to_string());
        }
        let numbers = parameters(model, names, &[]).ok_or("its parameters cannot be read")?;
        let (blueprint, held) = Self::held(model, options, &numbers, start)?;
        let all = [&numbers[..], &held].concat();
        let values: Vec<f64> = all.iter().map(|x| x.value).list();
        let base = Model::new(&blueprint, &values);
        let mut over = Sensitivity::new(Model::new(&blueprint, &all));
        let t = Slope::constant(state.t);
        let constant = |x: &[f64]| -> Vec<Slope> { x.iter().map(|x| Slope::constant(*x)).list() };
        let (q, lam) = (constant(&state.q), constant(lam));
        if lam.len() != base.layout.n_rows {
            return Err("its multipliers are not known".to_string());
        }
        let residual = over.statics(t, &q, &lam);
        let matrix = matrix(&base, state, &lam);
        let unknowns: Vec<f64> = q.iter().chain(&lam).map(|x| x.value).list();
        let found = implicit(matrix, &unknowns, &residual);
        let mut q = found
            .map_err(|_| "it has no bound: the position is a fold, or can move without force")?;
        let lam = q.split_off(state.q.len());
        Ok(Self { over, t, q, z: Vec::new(), lam, own: model.layout.n_rows })
    }

    /// The blueprint with a driver for each held quantity, and the values of their parameters.
    fn held(
        model: &Model,
        options: &Options,
        numbers: &[Slope],
        (start, slopes): (&State, &StartSlopes),
    ) -> Result<(Arc<Blueprint>, Vec<Slope>), String> {
        let mut drivers = Vec::new();
        for name in &options.hold {
            let of = position(model, name).map_err(|problem| problem.message)?;
            drivers.push((
                name.clone(),
                of,
                Tape::of(Symbol::Parameter(numbers.len() + drivers.len())),
            ));
        }
        let blueprint = Arc::new(model.blueprint.holding(&drivers));
        let open = [numbers, &vec![Slope::constant(0.0); drivers.len()]].concat();
        let mut at_start = Sensitivity::new(Model::new(&blueprint, &open));
        let phi = at_start.open(Slope::constant(start.t), &slopes[0]);
        Ok((blueprint, phi[model.layout.n_rows..].to_vec()))
    }

    /// A quantity with its derivatives.
    pub fn read(&mut self, measure: &Measure) -> Slope {
        let rest = vec![Slope::constant(0.0); self.q.len()];
        self.over.place(&self.q, &rest, &[]);
        let motions = &self.over.motions;
        let (state, solved) = ([&self.q[..], &rest, &self.z], [&rest[..], &self.lam]);
        let seen = Seen { t: self.t, state, works: &[], motions, solved, so_far: None };
        measure.value_at(&self.over.model, &seen)
    }

    /// The equilibrium as the start of a motion.
    pub fn start(self) -> StartSlopes {
        let rest = vec![Slope::constant(0.0); self.q.len()];
        [self.q, rest, self.z]
    }

    /// The effort of a holder.
    pub fn effort(&self, holder: usize) -> Slope {
        -self.lam[self.own + holder]
    }
}

/// The derivatives of Φ_qᵀ λ - Q and Φ by q and λ, row-major.
fn matrix(model: &Model, state: &State, lam: &[Slope]) -> Vec<f64> {
    let (n, m) = (state.q.len(), lam.len());
    let mut matrix = vec![0.0; (n + m) * (n + m)];
    let mut over = Sensitivity::new(model.lift());
    let t = Slope::constant(state.t);
    for first in (0..n).step_by(ABREAST) {
        let seed = |(k, q): (usize, &f64)| match k.checked_sub(first) {
            Some(place) if place < ABREAST => Dual::variable(*q, place),
            _ => Slope::constant(*q),
        };
        let q: Vec<Slope> = state.q.iter().enumerate().map(seed).list();
        for (row, r) in over.statics(t, &q, lam).iter().enumerate() {
            for (place, slope) in r.slope.iter().enumerate().take(n - first) {
                matrix[row * (n + m) + first + place] = *slope;
            }
        }
    }
    let motions = Motions::at_rest(&model.layout, &state.q);
    let jacobian = dense::jacobian(model, &motions, state.t);
    for row in 0..m {
        for column in 0..n {
            matrix[column * (n + m) + n + row] = jacobian[row * n + column];
        }
    }
    matrix
}
