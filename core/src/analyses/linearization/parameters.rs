//! Derivatives of the parameters of a model with respect to one parameter, through the formulas of the other
//! parameters.

use super::variation::D;
use crate::expression::parameters::Parameters;
use crate::expression::Expression;
use crate::math::Listed;
use crate::model::Model;

/// The derivatives of all parameters with respect to the parameter of index `own`, shape (n_parameters).
pub(in crate::analyses) fn slopes_by_parameter(model: &Model, own: usize) -> Vec<f64> {
    let formulas: Vec<(&str, Expression)> =
        model.blueprint.formulas.iter().map(|(name, e)| (name.as_str(), e.clone())).list();
    let Ok(parameters) = Parameters::compile(&formulas, &model.blueprint.tables) else {
        return vec![f64::NAN; model.parameters.len()];
    };
    let values: Vec<D> =
        parameters.evaluate(|k| (k == own).then(|| D::variable(model.parameters[own], 0)));
    values.iter().map(|x| x.slope[0]).list()
}
