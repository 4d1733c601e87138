//! Parameters and start values as numbers with derivatives.

use crate::equations::sensitivity::Slope;
use crate::expression::parameters::Parameters;
use crate::expression::Expression;
use crate::math::{Dual, Listed};
use crate::model::Model;

/// The values of all parameters of a model, with derivatives with respect to those in `seeds`. None if a formula
/// cannot be read, which a model excludes.
pub(super) fn parameters(model: &Model, seeds: &[String]) -> Option<Vec<Slope>> {
    let blueprint = &model.blueprint;
    let written: Vec<(&str, Expression)> =
        blueprint.formulas.iter().map(|(name, of)| (name.as_str(), of.clone())).list();
    let compiled = Parameters::compile(&written, &blueprint.tables).ok()?;
    let given = |k: usize| {
        let place = seeds.iter().position(|seed| seed == written[k].0)?;
        Some(Dual::variable(model.parameters[k], place))
    };
    Some(compiled.evaluate(given))
}
