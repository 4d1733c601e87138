//! A case whose variants are run, and what is read of each.

use super::readings::Missing;
use super::statistic::Statistic;
use crate::analyses::record::{self, parts, ErrorClass};
use crate::analyses::{declarations, kind_of};
use crate::model::{Definition, Entry, Functions, Model, Value};
use std::sync::Arc;

/// A case whose variants are run.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The model.
    pub model: Arc<Model>,
    /// Its definition, in which analyses drive other quantities.
    pub definition: Arc<Definition>,
    /// Coordinates and rates that are prescribed at the start, as written in the case.
    pub set: Vec<(String, Value)>,
    /// Guesses of coordinates and rates at the start, as written in the case.
    pub guess: Vec<(String, Value)>,
    /// The analyses of the case. The last one is swept.
    pub analyses: Vec<Entry>,
    /// Expressions of quantities, such as `C.force`. They must not use energies or checks of a run.
    pub measures: Vec<String>,
    /// The numbers of a result row.
    pub wanted: Vec<Wanted>,
}

/// A number of a result row.
#[derive(Clone, Debug, PartialEq)]
pub enum Wanted {
    /// A statistic of the measure with this index.
    Statistic(usize, Statistic),
    /// A number of a result that is not a motion, such as `lower`, `frequency[0]` or `rocker.angle`.
    Number(String),
}

/// The result of a variant.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The requested numbers. The settling time of a motion that does not settle is NaN.
    Values(Vec<f64>),
    /// The run failed, with the reason in terms of the mechanism.
    Failed(String),
    /// This module does not compute the variant, so that a single run of the case is needed. Reasons are redundant
    /// joints, friction at rest that drivers hold, positions near which multipliers are meaningless, and invalid numbers.
    Single,
    /// The run was stopped.
    Stopped,
}

/// The parameters and the entries of `set` that a variant changes.
pub type VariantRow = (Vec<(String, f64)>, Vec<(String, f64)>);

impl Sweep {
    /// Whether this module can compute variants of a model. The model must not have functions of the caller without
    /// derivatives, or redundant joints if quantities are read.
    pub fn serves(model: &Model, reads_quantities: bool) -> bool {
        let functions = model.blueprint.functions.as_ref();
        !(model.allow_redundancy && reads_quantities)
            && functions.is_none_or(Functions::have_slopes)
    }

    /// Whether functions of the caller, which see the parameters of the model, exclude other values.
    pub(super) fn excludes(&self, parameters: &[(String, f64)]) -> bool {
        let names = &self.model.blueprint.parameters;
        let kept = |(name, x): &(String, f64)| {
            let place = names.iter().position(|known| known == name);
            place.is_some_and(|k| self.model.parameters[k] == *x)
        };
        self.model.blueprint.functions.is_some() && !parameters.iter().all(kept)
    }

    /// Whether a quantity is read, and not only numbers that the analysis declares.
    pub(super) fn reads_quantities(&self) -> bool {
        let kind = self.analyses.last().map_or("", |entry| kind_of(&entry.fields));
        let declared = declarations().iter().find(|declared| declared.table.name == kind);
        let known = |text: &str| {
            let name = parts(text).0;
            declared.is_some_and(|declared| declared.numbers.iter().any(|(one, _)| *one == name))
        };
        self.wanted.iter().any(|one| !matches!(one, Wanted::Number(text) if known(text)))
    }

    /// The statistics in a result row.
    pub fn statistics(&self) -> impl Iterator<Item = (usize, Statistic)> + '_ {
        self.wanted.iter().filter_map(|one| match one {
            Wanted::Statistic(of, statistic) => Some((*of, *statistic)),
            Wanted::Number(_) => None,
        })
    }
}

impl From<record::Outcome> for Outcome {
    fn from(reason: record::Outcome) -> Self {
        match reason.class {
            // which a single run raises
            ErrorClass::Internal => Self::Single,
            _ => Self::Failed(reason.message),
        }
    }
}

impl From<Missing> for Outcome {
    fn from(missing: Missing) -> Self {
        match missing {
            Missing::Failed(reason) => Self::Failed(reason),
            Missing::Single => Self::Single,
        }
    }
}
