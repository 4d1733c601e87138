//! The model at a value of a parameter, and the derivatives of the equilibrium equations with respect to it.

use super::failure::Reason;
use super::statics::{StaticState, Statics};
use crate::analyses::linearization::{slopes_by_parameter, LeastNorm, StatePoint, Variation, D};
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::math::{Lift, Listed};
use crate::model::Model;

/// The model at a value of a parameter. Parameters whose formulas depend on it are computed anew.
pub(super) fn at(model: &Model, over: &str, value: f64) -> Result<Model, Reason> {
    model.with_values(&[(over.to_string(), value)]).map_err(Reason::Option)
}

/// The motion of an equilibrium with the parameter, as far as the constraints determine it, and the unbalanced forces
/// that this motion causes.
pub(super) struct ByParameter {
    /// The dq/dp of least norm that keeps the constraints closed, shape (n_q).
    pub motion: Vec<f64>,
    /// The derivative of Φ_qᵀ λ - Q with this motion, shape (n_q).
    pub missing: Vec<f64>,
}

impl ByParameter {
    pub fn new(statics: &Statics<'_>, place: &StaticState, over: &str) -> Result<Self, Reason> {
        let (model, t) = (statics.model, statics.t);
        let rest = vec![0.0; place.q.len()];
        let at = StatePoint { q: &place.q, v: &rest, z: &place.z, a: &rest, lam: &place.lam };
        let plain = Variation::new(model, t, at, false);
        let own = model.blueprint.parameters.iter().position(|name| name == over);
        let slopes = own.map_or_else(Vec::new, |own| slopes_by_parameter(model, own));
        let by = plain.by_parameters(&slopes);
        let opens = opening(by.model(), &place.q, t);
        let singular = |_| Reason::singular(model, t, &place.q);
        let factors =
            LeastNorm::new(model, t, &place.q, model.allow_redundancy).map_err(singular)?;
        let motion = factors.least(&opens.iter().map(|x| -x).list());
        let direct = by.along(StatePoint::default());
        let moved = plain.along(StatePoint { q: &motion, ..StatePoint::default() });
        let sum = |a: &[f64], b: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| a + b).list() };
        let (forces, rates) =
            (sum(&direct.forces, &moved.forces), sum(&direct.states, &moved.states));
        let by_states = statics.by_states(&plain, place.z.len());
        let missing = statics.followed(&by_states, forces, &rates)?;
        Ok(Self { motion, missing })
    }
}

/// ∂Φ/∂p.
fn opening(model: &Model<D>, q: &[f64], t: f64) -> Vec<f64> {
    let q: Vec<D> = q.iter().map(|q| D::lift(*q)).list();
    let mut phi = vec![D::lift(0.0); model.layout.n_rows];
    constraints::residual(model, &Motions::at_rest(&model.layout, &q), D::lift(t), &mut phi);
    phi.iter().map(|x| x.slope[0]).list()
}
