//! Derivatives of the equations of motion along a direction of the state, by dual numbers:
//!
//! ```text
//! M a + Φ_qᵀ λ - Q - loads     Φ_q v + Φ_t     Φ_q a - γ     ż
//! ```
//!
//! The code of the equations themselves is evaluated. All terms are therefore included: curvature of the constraints,
//! centrifugal and gyroscopic terms, laws, and forces that depend on reactions.

use crate::elements::derive::ByThree;
use crate::equations::forces::{self, Acting};
use crate::equations::kinematics::Motions;
use crate::equations::{constraints, mass, reactions, Compiled, Powers};
use crate::math::{Lift, Listed, Real, ShortArray};
use crate::model::Model;

/// A number with its derivative along the direction, the first slope. The others are zero: the scalar is that of the
/// tangent, because one more scalar would be one more copy of the equations.
pub(in crate::analyses) type D = ByThree<f64>;

/// A state with accelerations and multipliers, or a direction in their space; an empty slice is zero.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::analyses) struct StatePoint<'a> {
    pub q: &'a [f64],
    pub v: &'a [f64],
    pub z: &'a [f64],
    pub a: &'a [f64],
    pub lam: &'a [f64],
}

impl StatePoint<'_> {
    /// q, v, z, a and λ with the derivatives `along`.
    pub fn seeded(self, along: StatePoint<'_>) -> [Vec<D>; 5] {
        let Self { q, v, z, a, lam } = self;
        let pairs = [(q, along.q), (v, along.v), (z, along.z), (a, along.a), (lam, along.lam)];
        pairs.each(|(point, along)| seeded(point, along))
    }
}

/// The derivatives along a direction.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::analyses) struct Slopes {
    /// Derivative of M a + Φ_qᵀ λ - Q and of the loads, shape (n_q).
    pub forces: Vec<f64>,
    /// Derivative of Φ_q v + Φ_t, shape (n_rows).
    pub rates: Vec<f64>,
    /// Derivative of Φ_q a - γ, shape (n_rows).
    pub accelerations: Vec<f64>,
    /// Derivative of ż, shape (n_z).
    pub states: Vec<f64>,
}

/// `point` with the derivatives `along`.
fn seeded(point: &[f64], along: &[f64]) -> Vec<D> {
    let slopes = along.iter().copied().chain(std::iter::repeat(0.0));
    point
        .iter()
        .zip(slopes)
        .map(|(value, slope)| D { value: *value, slope: [slope, 0.0, 0.0] })
        .list()
}

fn slopes(x: &[D]) -> Vec<f64> {
    x.iter().map(|x| x.slope[0]).list()
}

/// The equations of motion at one state, over dual numbers.
#[derive(Clone, Debug)]
pub(in crate::analyses) struct Variation<'a> {
    model: Model<D>,
    compiled: Compiled<D>,
    t: f64,
    at: StatePoint<'a>,
    /// Whether loads of joints belong to the forces.
    loads: bool,
}

impl<'a> Variation<'a> {
    pub fn new(model: &Model, t: f64, at: StatePoint<'a>, loads: bool) -> Self {
        let model: Model<D> = model.lift();
        Self { compiled: Compiled::new(&model), model, t, at, loads }
    }

    /// The same equations with derivatives with respect to a variable on which the parameters depend; `slopes` are
    /// the derivatives of the parameters.
    pub fn by_parameters(&self, slopes: &[f64]) -> Self {
        let mut parameters = self.model.parameters.clone();
        parameters.iter_mut().zip(slopes).for_each(|(p, slope)| p.slope[0] = *slope);
        let model = Model::new(&self.model.blueprint, &parameters);
        Self { compiled: Compiled::new(&model), model, ..*self }
    }

    /// The model over dual numbers.
    pub fn model(&self) -> &Model<D> {
        &self.model
    }

    /// Whether the constraints at the state depend on the variable of [`by_parameters`](Self::by_parameters).
    pub fn moves_constraints(&self) -> bool {
        let Self { model, at, .. } = self;
        let [q, v] = [at.q, at.v].each(|x| seeded(x, &[]));
        let motions = Motions::at(&model.layout, &q, &v);
        let t = D::lift(self.t);
        let [phi, rates, gamma] = constraints::terms_at(model, &motions, t);
        let mut jacobian = vec![D::zero(); model.layout.n_entries];
        constraints::jacobian(model, &motions, t, &mut jacobian);
        [phi, rates, gamma, jacobian].into_iter().flatten().any(|x| x.slope[0] != 0.0)
    }

    /// The derivatives along a direction.
    pub fn along(&self, direction: StatePoint<'_>) -> Slopes {
        let Self { model, compiled, at, .. } = self;
        let layout = &model.layout;
        let t = D::lift(self.t);
        let [q, v, z, a, lam] = at.seeded(direction);
        let motions = Motions::at(layout, &q, &v);
        let zeros = |count: usize| vec![D::zero(); count];
        let [_, rates, gamma] = constraints::terms_at(model, &motions, t);
        let mut jacobian = zeros(layout.n_entries);
        constraints::jacobian(model, &motions, t, &mut jacobian);
        let acting = Acting { z: &z, lam: Some(&lam), t };
        let mut forces = zeros(layout.n_q);
        let powers = &mut Powers::zero();
        forces::generalized(model, compiled, &motions, acting, &mut forces, powers);
        if self.loads {
            reactions::add_loads(model, &motions, t, &lam, &mut forces);
        }
        forces.iter_mut().for_each(|x| *x = -*x);
        mass::add_times(model, &motions, &a, &mut forces);
        constraints::add_transposed(model, &jacobian, &lam, &mut forces);
        let mut accelerations = zeros(layout.n_rows);
        constraints::times_all(model, &jacobian, &a, &mut accelerations);
        accelerations.iter_mut().zip(&gamma).for_each(|(x, gamma)| *x -= *gamma);
        let mut states = zeros(layout.n_z);
        forces::state_rates(model, &motions, acting, &mut states);
        Slopes {
            forces: slopes(&forces),
            rates: slopes(&rates),
            accelerations: slopes(&accelerations),
            states: slopes(&states),
        }
    }
}
