//! The symbols of all elements of a model.

use super::beam_names::beam_of;
use super::model::Model;
use crate::elements::SceneSymbol;
use crate::expression::{Symbol, Tape, Values};

/// Values of the parameters. A formula that uses other variables is not evaluated.
struct ParameterValues<'a>(&'a [f64]);

impl Values<f64> for ParameterValues<'_> {
    fn parameter(&self, k: usize) -> f64 {
        self.0[k]
    }
    fn time(&self) -> f64 {
        f64::NAN
    }
    fn variable(&self, _: usize) -> f64 {
        f64::NAN
    }
}

impl Model {
    /// The symbols of each joint, driver and force with its name, in the order of the model.
    pub fn symbols(&self) -> Vec<(&str, Vec<SceneSymbol>)> {
        let known = |symbol: &Symbol| matches!(symbol, Symbol::Parameter(_));
        let value = &mut |tape: &Tape| match tape.symbols().iter().all(known) {
            true => tape.evaluate(&ParameterValues(&self.parameters)),
            false => f64::NAN,
        };
        let blueprint = &self.blueprint;
        let mut found = Vec::new();
        for (name, _, formula) in blueprint.constraints.iter() {
            found.push((name.as_str(), formula.map(value).symbols()));
        }
        for (name, _, formula) in &blueprint.forces[..self.listed_forces().len()] {
            // the pieces of a beam are drawn as one
            let name = if formula.in_files() { name.as_str() } else { beam_of(name) };
            found.push((name, formula.map(value).symbols()));
        }
        found
    }
}
