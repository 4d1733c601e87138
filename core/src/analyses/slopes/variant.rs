//! A variant of a sweep with its variables.

use super::variables::parameters;
use crate::analyses::record::{self, Record};
use crate::analyses::sweep::{Ready, Sweep, VariantRow};
use crate::analyses::AnyAnalysis;
use crate::equations::sensitivity::{Sensitivity, Slope, ABREAST};
use crate::math::Listed;
use crate::model::Model;

/// A variant of a sweep before its run, whose numbers are differentiated.
#[derive(Clone, Copy)]
pub(super) struct ReadyVariant<'a> {
    pub sweep: &'a Sweep,
    pub ready: &'a Ready,
    /// The variables with their values.
    pub row: &'a VariantRow,
    pub stop: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> ReadyVariant<'a> {
    /// Runs an analysis.
    pub fn run(&self, analysis: &AnyAnalysis) -> Result<Record, record::Outcome> {
        self.sweep.run(self.ready, analysis, self.stop)
    }

    /// Whether the analysis is forward dynamics.
    pub fn is_integrated(&self) -> bool {
        matches!(self.ready.analysis, AnyAnalysis::Dynamics(_))
    }

    pub fn variables(&self) -> impl Iterator<Item = &'a (String, f64)> {
        self.row.0.iter().chain(&self.row.1)
    }

    /// The number of variables.
    pub fn count(&self) -> usize {
        self.variables().count()
    }

    /// The magnitudes of the variables.
    pub fn sizes(&self) -> Vec<f64> {
        self.variables().map(|(_, x)| if *x == 0.0 { 1.0 } else { x.abs() }).list()
    }

    /// The names of the variables, in blocks.
    pub fn names(&self) -> Vec<Vec<String>> {
        let names: Vec<String> = self.variables().map(|(name, _)| name.clone()).list();
        names.chunks(ABREAST).map(<[String]>::to_vec).list()
    }

    /// The equations of a model with derivatives, for blocks of variables.
    pub fn blocks(&self, model: &Model) -> Result<Vec<Sensitivity>, String> {
        self.names().iter().map(|names| equations(model, names, &[])).collect()
    }
}

/// The equations of a model with derivatives by some variables. Some parameters have other values.
pub(super) fn equations(
    model: &Model,
    names: &[String],
    replaced: &[(String, Slope)],
) -> Result<Sensitivity, String> {
    let numbers = parameters(model, names, replaced).ok_or_else(unread)?;
    Ok(Sensitivity::new(Model::new(&model.blueprint, &numbers)))
}

pub(super) fn unread() -> String {
    "its parameters cannot be read".to_string()
}
