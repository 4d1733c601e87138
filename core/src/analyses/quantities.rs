//! The names that formulas of conditions and measures may use: parameters, t and quantities of a motion.

use super::signal_names::{names, signal};
use super::signals::Signal;
use crate::expression::{Names, Symbol, Table, Values};
use crate::math::{Listed, Real};
use crate::model::Model;
use std::cell::RefCell;
use std::sync::Arc;

/// The names in a formula. Each quantity becomes a variable.
pub(super) struct QuantityNames<'a> {
    model: &'a Model,
    released: &'a [String],
    /// The quantities that occur in the formula, with their names, in the order of their variables.
    pub found: RefCell<Vec<(String, Signal)>>,
    /// The last unknown name.
    missed: RefCell<String>,
}

impl<'a> QuantityNames<'a> {
    /// The names of a model from which the drivers `released` were removed.
    pub fn of(model: &'a Model, released: &'a [String]) -> Self {
        Self { model, released, found: RefCell::default(), missed: RefCell::default() }
    }

    /// The effort of a released driver, which is zero.
    fn of_released(&self, name: &str) -> Option<Signal> {
        let (owner, _) = name.rsplit_once('.')?;
        self.released.iter().any(|known| known == owner).then_some(Signal::Constant(0.0))
    }
}

impl Names for QuantityNames<'_> {
    fn resolve(&self, name: &str) -> Option<Symbol> {
        let blueprint = &self.model.blueprint;
        if let Some(k) = blueprint.parameters.iter().position(|known| known == name) {
            return Some(Symbol::Parameter(k));
        }
        if name == "t" {
            return Some(Symbol::Time);
        }
        let signal = signal(self.model, name).or_else(|| self.of_released(name));
        let Some(signal) = signal else {
            self.missed.replace(name.to_string());
            return None;
        };
        let mut found = self.found.borrow_mut();
        let known = found.iter().position(|(_, known)| *known == signal);
        Some(Symbol::Variable(known.unwrap_or_else(|| {
            found.push((name.to_string(), signal));
            found.len() - 1
        })))
    }

    fn known(&self) -> Vec<String> {
        let own = self.model.blueprint.parameters.iter().cloned().chain(["t".to_string()]);
        own.chain(names(self.model, &self.missed.borrow())).list()
    }

    fn tables(&self) -> &[Arc<Table>] {
        &self.model.blueprint.tables
    }
}

/// The values of the names of a formula.
pub(super) struct QuantityValues<'a, S = f64> {
    pub model: &'a Model<S>,
    pub t: S,
    /// The values of the quantities, in the order of their variables.
    pub quantities: &'a [S],
}

impl<S: Real> Values<S> for QuantityValues<'_, S> {
    fn parameter(&self, k: usize) -> S {
        self.model.parameters[k]
    }
    fn time(&self) -> S {
        self.t
    }
    fn variable(&self, k: usize) -> S {
        self.quantities[k]
    }
}
