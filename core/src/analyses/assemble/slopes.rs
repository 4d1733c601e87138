//! Derivatives of an assembled start with respect to parameters and prescribed values, by the implicit function
//! theorem.

use super::holding::held;
use super::rates;
use super::request::{formulas, Request};
use super::target::{of_positions, of_rates, Target};
use crate::analyses::State;
use crate::elements::Followed;
use crate::equations::kinematics::Motions;
use crate::equations::sensitivity::{constants, Sensitivity, Slope, ABREAST};
use crate::equations::{at, dense, mass, Workspace};
use crate::expression::{Symbol, Tape};
use crate::math::{Dual, Listed, Real};
use crate::model::{Blueprint, Model, Value};
use crate::solve::solve_any_rank;
use std::sync::Arc;

/// Ratio of the smallest to the largest pivot below which equations depend on each other.
const DEPENDENT: f64 = 1e-9;

/// A start with derivatives: coordinates, rates and first-order states.
pub type StartSlopes = [Vec<Slope>; 3];

/// The values of a section, `set` or `guess`, with their derivatives, in the order of the request. The variable of
/// `seeds` with this name has the derivative one.
pub fn set_slopes(
    model: &Model,
    (section, written): (&str, &[(String, Value)]),
    parameters: &[Slope],
    seeds: &[String],
) -> Option<Vec<Slope>> {
    let found = formulas(model, section, written).ok()?;
    let of = |((_, tape), (name, _)): (&(_, Tape), &(String, Value))| {
        let value = tape.evaluate(&at(parameters, &[], &[], Slope::zero()));
        match seeds.iter().position(|seed| seed == name) {
            Some(k) => Dual::variable(value.value, k),
            None => value,
        }
    };
    Some(found.iter().zip(written).map(of).list())
}

/// The derivatives of the start that was assembled for a request. `set` contains the values of the request's `set`.
///
/// # Errors
/// The reason for which the start has no derivatives.
pub fn slopes(
    model: &Model,
    request: &Request,
    (parameters, set): (&[Slope], &[Slope]),
    state: &State,
) -> Result<StartSlopes, String> {
    let rigid = model.rigid().filter(|_| request.state.is_none());
    let model = rigid.as_ref().unwrap_or(model);
    let known = StartNumbers { model, request, parameters, set, t: request.t };
    let q = known.positions(&state.q)?;
    let v = known.rates(&q, &state.v)?;
    let mut z = constants(&state.z);
    for (target, value) in request.set.iter().zip(set) {
        if let Target::State { place, .. } = target {
            z[*place] = *value;
        }
    }
    Ok([q, v, z])
}

/// The derivatives of the rates that were made consistent for a request without `set`, at positions with derivatives.
///
/// # Errors
/// The reason for which the rates have no derivatives.
pub fn rate_slopes(
    model: &Model,
    request: &Request,
    parameters: &[Slope],
    (q, v): (&[Slope], &[f64]),
) -> Result<Vec<Slope>, String> {
    StartNumbers { model, request, parameters, set: &[], t: request.t }.rates(q, v)
}

struct StartNumbers<'a> {
    model: &'a Model,
    request: &'a Request,
    parameters: &'a [Slope],
    set: &'a [Slope],
    t: f64,
}

impl StartNumbers<'_> {
    /// The model with a driver for each of some targets. The value of a target is a further parameter.
    fn holding<'t>(
        &self,
        targets: impl Iterator<Item = &'t Target>,
        law: impl Fn(Symbol) -> Tape,
    ) -> (Model, Sensitivity) {
        let first = self.parameters.len();
        let place = |target: &Target| {
            let own = self.request.set.iter().position(|one| std::ptr::eq(one, target));
            Symbol::Parameter(first + own.unwrap_or(0))
        };
        let driver = |target: &Target| {
            let law = |_: &Followed<Tape>, _: f64| law(place(target));
            held(self.model, target, law)
        };
        let drivers: Vec<_> = targets.filter_map(driver).list();
        let blueprint: Arc<Blueprint> = Arc::new(self.model.blueprint.holding(&drivers));
        let numbers = [self.parameters, self.set].concat();
        let values: Vec<f64> = numbers.iter().map(|x| x.value).list();
        let model = Model::new(&blueprint, &values);
        (model, Sensitivity::new(Model::new(&blueprint, &numbers)))
    }

    fn positions(&self, q: &[f64]) -> Result<Vec<Slope>, String> {
        let (model, mut over) = self.holding(of_positions(&self.request.set), Tape::of);
        let phi = over.open(Slope::constant(self.t), &constants(q));
        let mut workspace = Workspace::new(&model);
        if determines(&mut workspace, &model, self.t, q) {
            if let Some(found) = determined(&mut workspace, &model, q, &phi) {
                return Ok(found);
            }
        }
        let motions = Motions::at_rest(&model.layout, q);
        let jacobian = dense::jacobian(&model, &motions, self.t);
        implicit(jacobian, q, &phi)
    }

    /// The rates that are approached. Those of bodies in `set` have the derivatives of their values.
    fn set_rates(&self, wanted: &[f64]) -> Vec<Slope> {
        let mut wanted = constants(wanted);
        for (target, value) in self.request.set.iter().zip(self.set) {
            if let (true, Target::Coordinate(target)) = (target.is_rate(), target) {
                wanted[target.place(self.model)] = *value;
            }
        }
        wanted
    }

    fn rates(&self, q: &[Slope], v: &[f64]) -> Result<Vec<Slope>, String> {
        let t0 = self.t;
        let law = |of: Symbol| Tape::growing_by(of, t0);
        let (model, mut over) = self.holding(of_rates(&self.request.set), law);
        let constant = constants(v);
        let open = over.opening(Slope::constant(t0), q, &constant);
        let values: Vec<f64> = q.iter().map(|q| q.value).list();
        let motions = Motions::at(&model.layout, &values, v);
        let mut workspace = Workspace::new(&model);
        if determines(&mut workspace, &model, t0, &values) {
            if let Some(found) = determined(&mut workspace, &model, v, &open) {
                return Ok(found);
            }
        }
        let jacobian = dense::jacobian(&model, &motions, t0);
        let (n, m) = (v.len(), model.layout.n_rows);
        // Mᵢ (v - w) + Φ_qᵀ σ = 0, where w are the rates that are approached
        let (wanted, met) = rates::wanted(self.model, self.request, &values);
        if let Some(guessed) = met.first() {
            let name = guessed.name(self.model);
            return Err(format!("the start follows the guess of {name}; prescribe {name} in set"));
        }
        let wanted = self.set_rates(&wanted);
        let off: Vec<f64> = v.iter().zip(&wanted).map(|(v, w)| v - w.value).list();
        let mut balance = vec![0.0; n];
        mass::add_times(&model, &motions, &off, &mut balance);
        let mut transposed = vec![0.0; n * m];
        for row in 0..m {
            (0..n).for_each(|column| transposed[column * m + row] = jacobian[row * n + column]);
        }
        let mut sigma = vec![balance.iter().map(|x| -x).list()];
        solve_any_rank(&mut transposed, m, &mut sigma, DEPENDENT);
        let sigma = constants(&sigma[0]);
        let off = constant.iter().zip(&wanted).map(|(v, w)| *v - *w).list();
        let mut residual = over.balance_of((Slope::constant(t0), q, &constant), &off, &sigma);
        residual.extend(open);
        let mut matrix = vec![0.0; (n + m) * (n + m)];
        let mut unit = vec![0.0; n];
        for column in 0..n {
            let mut product = vec![0.0; n];
            unit[column] = 1.0;
            mass::add_times(&model, &motions, &unit, &mut product);
            unit[column] = 0.0;
            for row in 0..n {
                matrix[row * (n + m) + column] = product[row];
            }
            for row in 0..m {
                let x = jacobian[row * n + column];
                matrix[(n + row) * (n + m) + column] = x;
                matrix[column * (n + m) + n + row] = x;
            }
        }
        let unknowns: Vec<f64> = v.iter().copied().chain(sigma.iter().map(|x| x.value)).list();
        let mut found = implicit_in(matrix, (&unknowns, n), &residual)?;
        found.truncate(n);
        Ok(found)
    }
}

/// Factors the equations of motion of a model at a position, if its constraints clearly determine all coordinates.
/// Otherwise the general elimination finds out why not.
pub fn determines(workspace: &mut Workspace, model: &Model, t: f64, q: &[f64]) -> bool {
    let still = vec![0.0; model.layout.n_rows];
    if still.len() != q.len() || workspace.jump(model, t, q, &still).is_err() {
        return false;
    }
    let lost = workspace.matrix.cancellation().is_some_and(|(_, ratio)| ratio < DEPENDENT);
    !lost && !workspace.matrix.regularised()
}

/// The derivatives of coordinates or rates `x` which the factors [determine](determines), from the derivatives of the
/// constraints at constant x. None if they are not finite.
pub fn determined(
    workspace: &mut Workspace,
    model: &Model,
    x: &[f64],
    residual: &[Slope],
) -> Option<Vec<Slope>> {
    let mut found = constants(x);
    for k in 0..ABREAST {
        let mut change = vec![0.0; x.len()];
        change.extend(residual.iter().map(|r| -r.slope[k]));
        workspace.solve(model, &mut change).ok()?;
        found.iter_mut().zip(&change).for_each(|(to, x)| to.slope[k] = *x);
    }
    let finite = |x: &Slope| x.slope.iter().all(|slope| slope.is_finite());
    found.iter().all(finite).then_some(found)
}

/// The derivatives of the solution `x` of r(x, p) = 0, from ∂r/∂x and the derivatives of r at constant x.
///
/// # Errors
/// The equations do not determine the derivatives.
pub fn implicit(matrix: Vec<f64>, x: &[f64], residual: &[Slope]) -> Result<Vec<Slope>, String> {
    implicit_in(matrix, (x, x.len()), residual)
}

/// [`implicit`], where only the first unknowns must be determined.
fn implicit_in(
    mut matrix: Vec<f64>,
    (x, needed): (&[f64], usize),
    residual: &[Slope],
) -> Result<Vec<Slope>, String> {
    let mut right: Vec<Vec<f64>> =
        (0..ABREAST).map(|k| residual.iter().map(|r| -r.slope[k]).list()).list();
    let zero = right.iter().all(|b| b.iter().all(|x| *x == 0.0));
    let found = solve_any_rank(&mut matrix, x.len(), &mut right, DEPENDENT);
    // a coordinate that is in no equation stays where it is
    if !zero && found.coupled.iter().any(|column| *column < needed) {
        return Err("the equations do not determine it: the start is a singular position, or more of it must be prescribed".to_string());
    }
    if !found.consistent.iter().all(|agree| *agree) {
        return Err("constraints that depend on each other would no longer agree".to_string());
    }
    let with_slope = |(at, x): (usize, &f64)| {
        let mut slope = [0.0; ABREAST];
        slope.iter_mut().zip(&right).for_each(|(to, of)| *to = of[at]);
        Dual { value: *x, slope }
    };
    Ok(x.iter().enumerate().map(with_slope).list())
}
