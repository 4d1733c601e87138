//! The same mechanism with other values of some parameters, or without some of its drivers.

use super::blueprint::Blueprint;
use super::model::Model;
use super::problem::Problem;
use super::{checks, parameters};
use crate::expression::Expression;
use std::sync::Arc;

impl Model {
    /// The same model with other values of some parameters; formulas in them follow.
    ///
    /// # Errors
    /// Every number that cannot be right.
    pub fn with_values(&self, changes: &[(String, f64)]) -> Result<Self, Vec<Problem>> {
        let (mut problems, mut blueprint) = (Vec::new(), Blueprint::clone(&self.blueprint));
        for (name, x) in changes {
            let known = blueprint.formulas.iter_mut().find(|(known, _)| known == name);
            if let (Some((_, formula)), Ok(number)) = (known, Expression::number(*x)) {
                *formula = number;
            }
        }
        let formulas = std::mem::take(&mut blueprint.formulas);
        let found = parameters::evaluate(formulas, &blueprint.tables, &mut problems);
        blueprint.formulas = found.formulas;
        let model = Self::new(&Arc::new(blueprint), &found.values);
        if problems.is_empty() {
            checks::numbers(&model, &mut problems);
        }
        match problems.is_empty() {
            true => Ok(model),
            false => Err(problems),
        }
    }

    /// The same model without some drivers, which other names are not.
    pub fn without(&self, drivers: &[String]) -> Self {
        let mut blueprint = Blueprint::clone(&self.blueprint);
        blueprint.constraints.retain(|(name, ..)| !drivers.contains(name));
        Self::new(&Arc::new(blueprint), &self.parameters)
    }
}
