//! The derivatives of an equilibrium, by the implicit function theorem.

use super::variables::parameters;
use crate::analyses::assemble::{implicit, position, StartSlopes};
use crate::analyses::equilibrium::Options;
use crate::analyses::measures::Measure;
use crate::analyses::signals::Seen;
use crate::analyses::State;
use crate::equations::reactive;
use crate::equations::sensitivity::{constants, variables_from, Sensitivity, Slope, ABREAST};
use crate::expression::{Symbol, Tape};
use crate::math::{indexed, Complex, Field, Listed, Real, ShortArray};
use crate::model::{column_scales, row_scales, Blueprint, ConstraintItem, Model};
use crate::solve::null_space;
use std::sync::Arc;

/// Smallest scaled pivot at which a fold is separate from other paths, and largest remainder at a fold.
const SEPARATE: f64 = 1e-9;
const FOLDED: f64 = 1e-4;

/// An equilibrium with derivatives by the variables of a block.
pub(super) struct AtRest {
    /// The model with drivers for the held quantities.
    pub base: Model,
    over: Sensitivity,
    t: Slope,
    q: Vec<Slope>,
    z: Vec<Slope>,
    lam: Vec<Slope>,
    /// Number of rows before those of the holders.
    own: usize,
}

/// The equations of statics at an equilibrium, with derivatives by the variables of a block.
struct StaticEquations {
    /// The model with drivers for the held quantities.
    base: Model,
    over: Sensitivity,
    t: Slope,
    q: Vec<Slope>,
    lam: Vec<Slope>,
    /// Φ_qᵀ λ - Q and Φ.
    residual: Vec<Slope>,
    /// Their derivatives by q and λ, row-major.
    matrix: Vec<f64>,
}

/// An equilibrium of a model that was found from a start. The start belongs to a model with other parameters if the
/// equilibrium lies on a path over one of them.
#[derive(Clone, Copy)]
pub(super) struct RestPoint<'a> {
    pub model: &'a Model,
    pub options: &'a Options,
    pub state: &'a State,
    pub lam: &'a [f64],
    pub before: &'a Model,
    pub start: &'a State,
}

impl StaticEquations {
    fn new(of: &RestPoint<'_>, names: &[String], start: &StartSlopes) -> Result<Self, String> {
        let RestPoint { model, options, state, .. } = of;
        if !state.z.is_empty() {
            return Err("elements have first-order states".to_string());
        }
        if reactive::depends(model) || !model.switches.is_empty() {
            return Err("forces switch or depend on reactions".to_string());
        }
        let names = names.iter().map(|name| match options.over.as_ref() == Some(name) {
            true => String::new(), // its value on the path does not depend on the value in the case
            false => name.clone(),
        });
        Self::by(of, &names.list(), start)
    }

    /// The equations with derivatives by parameters of these names.
    fn by(of: &RestPoint<'_>, names: &[String], start: &StartSlopes) -> Result<Self, String> {
        let RestPoint { model, state, lam, .. } = of;
        let numbers = parameters(model, names, &[]).ok_or("its parameters cannot be read")?;
        let (blueprint, held) = Self::held(of, &numbers, (names, start))?;
        let all = [&numbers[..], &held].concat();
        let values: Vec<f64> = all.iter().map(|x| x.value).list();
        let base = Model::new(&blueprint, &values);
        let mut over = Sensitivity::new(Model::new(&blueprint, &all));
        let t = Slope::constant(state.t);
        let (q, lam) = (constants(&state.q), constants(lam));
        if lam.len() != base.layout.n_rows {
            return Err("its multipliers are not known".to_string());
        }
        let residual = over.statics(t, &q, &lam);
        let matrix = matrix(&base, state, &lam);
        Ok(Self { base, over, t, q, lam, residual, matrix })
    }

    /// The blueprint with a driver for each held quantity, and the values of their parameters.
    fn held(
        of: &RestPoint<'_>,
        numbers: &[Slope],
        (names, slopes): (&[String], &StartSlopes),
    ) -> Result<(Arc<Blueprint>, Vec<Slope>), String> {
        let RestPoint { model, before, start, options, .. } = of;
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
        let first = parameters(before, names, &[]).ok_or("its parameters cannot be read")?;
        let open = [first, vec![Slope::constant(0.0); drivers.len()]].concat();
        let mut at_start = Sensitivity::new(Model::new(&blueprint, &open));
        let phi = at_start.open(Slope::constant(start.t), &slopes[0]);
        Ok((blueprint, phi[model.layout.n_rows..].to_vec()))
    }
}

impl AtRest {
    /// The derivatives of an equilibrium.
    ///
    /// # Errors
    /// The reason for which there are no derivatives.
    pub fn find(of: &RestPoint<'_>, names: &[String], start: &StartSlopes) -> Result<Self, String> {
        let StaticEquations { base, over, t, q, lam, residual, matrix } =
            StaticEquations::new(of, names, start)?;
        let unknowns: Vec<f64> = q.iter().chain(&lam).map(|x| x.value).list();
        let found = implicit(matrix, &unknowns, &residual);
        let mut q = found
            .map_err(|_| "it has no bound: the position is a fold, or can move without force")?;
        let lam = q.split_off(of.state.q.len());
        Ok(Self { base, over, t, q, z: Vec::new(), lam, own: of.model.layout.n_rows })
    }

    /// The derivatives of the value of a parameter at which a path of equilibria over it turns back. There, the
    /// equations R(x, value) = 0 have a matrix with yᵀ R_x = 0, so that yᵀ dR = 0.
    ///
    /// # Errors
    /// The reason for which there are no derivatives.
    pub fn fold(
        of: &RestPoint<'_>,
        (over, names): (&String, &[String]),
        start: &StartSlopes,
    ) -> Result<[f64; ABREAST], String> {
        let found = StaticEquations::new(of, names, start)?;
        let fixed = start.each_ref().each(|x| x.iter().map(|x| Slope::constant(x.value)).list());
        let by_value = StaticEquations::by(of, std::slice::from_ref(over), &fixed)?.residual;
        let (n, columns, rows) =
            (of.state.q.len(), column_scales(&found.base), row_scales(&found.base));
        // the energy of the load over its range is the unit of stiffness
        let span = of.options.range.map_or(0.0, |[first, last]| last - first);
        let by_load = by_value.iter().zip(&columns).map(|(r, scale)| r.slope[0] * span * scale);
        let by_joints = of.lam.iter().zip(&rows).map(|(lam, scale)| lam * scale);
        let energy = by_load.chain(by_joints).fold(0.0, |most: f64, x| most.max(x.abs()));
        let factors: Vec<f64> = columns
            .iter()
            .map(|scale| scale / energy)
            .chain(rows.iter().map(|scale| 1.0 / scale))
            .list();
        let size = factors.len();
        let unknown = |k: usize| if k < n { columns[k] } else { energy * factors[k] };
        let entry = |k: usize| {
            let (column, row) = (k / size, k % size);
            Complex::from_real(found.matrix[row * size + column] * factors[row] * unknown(column))
        };
        let space = null_space(&(0..size * size).map(entry).list(), size, 1);
        let left = |row: usize| space.vectors[0][row].re * factors[row];
        let product = |of: &[Slope], k: usize| -> f64 {
            of.iter().enumerate().map(|(row, r)| left(row) * r.slope[k]).sum()
        };
        let by_value = product(&by_value, 0);
        let slopes: [f64; ABREAST] = indexed(|k| -product(&found.residual, k) / by_value);
        let [least, rest] = space.pivots;
        match least > SEPARATE && rest <= FOLDED && slopes.iter().all(|x| x.is_finite()) {
            true => Ok(slopes),
            false => Err("it has no bound: several paths meet there".to_string()),
        }
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

    /// The effort of the driver of a name.
    pub fn effort_of(&self, name: &str) -> Option<Slope> {
        let Model { constraints, layout, .. } = &self.over.model;
        let drives =
            |item: &ConstraintItem<Slope>| item.name == name && item.element.drives().is_some();
        let driver = constraints.iter().position(drives)?;
        Some(-self.lam[layout.constraints[driver].rows.start])
    }
}

/// The derivatives of Φ_qᵀ λ - Q and Φ by q and λ, row-major.
fn matrix(model: &Model, state: &State, lam: &[Slope]) -> Vec<f64> {
    let (n, m) = (state.q.len(), lam.len());
    let mut matrix = vec![0.0; (n + m) * (n + m)];
    let mut over = Sensitivity::new(model.lift());
    let t = Slope::constant(state.t);
    let mut fill = |first: usize, end: usize, all: &[Slope]| {
        for (row, r) in all.iter().enumerate() {
            for (place, slope) in r.slope.iter().enumerate().take(end - first) {
                matrix[row * (n + m) + first + place] = *slope;
            }
        }
    };
    for first in (0..n).step_by(ABREAST) {
        fill(first, n, &over.statics(t, &variables_from(first, &state.q), lam));
    }
    // beside -Φ_qᵀ λ, gear teeth have a load that depends on λ
    let (q, known) = (constants(&state.q), lam.iter().map(|x| x.value).list());
    for first in (0..m).step_by(ABREAST) {
        fill(n + first, n + m, &over.statics(t, &q, &variables_from(first, &known)));
    }
    matrix
}
