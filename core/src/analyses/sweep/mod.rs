//! Sweeps: an analysis of one mechanism with many values of its parameters and start, and the numbers of each result.
//!
//! A variant is equivalent to a single run of the changed case: its model is built from the linked blueprint, assembled
//! from the start of the case, and run through the analyses that lead to the swept one. The numbers of a motion are
//! statistics of measures; those of any other result are stated by its analysis. Variants share no state. Their numbers
//! therefore do not depend on the order, and the caller may compute variants on any number of threads.

mod faults;
mod fine;
mod kept;
mod readings;
mod series;
mod statistic;
mod variant;

pub use faults::{measure_fault, variable_fault};
pub use statistic::Statistic;

use super::analysis_table::{declarations, kind_of, AnyAnalysis};
use super::dynamics::{self, can_stick, side_by_side, Variant};
use super::measures::Measure;
use super::record::{self, parts, ErrorClass, Record};
use crate::integrate::Flow;
use crate::math::{each, Listed};
use crate::model::{Definition, Entry, Model, Value};
use fine::Between;
use readings::{Missing, PreparedModel, Readings};
use series::Series;
use std::sync::Arc;
use variant::Ready;

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
    /// Whether this module can compute variants of a model. The model must not have functions of the caller, or
    /// redundant joints if quantities are read.
    pub fn serves(model: &Model, reads_quantities: bool) -> bool {
        !(model.allow_redundancy && reads_quantities) && model.blueprint.functions.is_none()
    }

    /// Whether a quantity is read, and not only numbers that the analysis declares.
    fn reads_quantities(&self) -> bool {
        let kind = self.analyses.last().map_or("", |entry| kind_of(&entry.fields));
        let declared = declarations().iter().find(|declared| declared.table.name == kind);
        let known = |text: &str| {
            let name = parts(text).0;
            declared.is_some_and(|declared| declared.numbers.iter().any(|(one, _)| *one == name))
        };
        self.wanted.iter().any(|one| !matches!(one, Wanted::Number(text) if known(text)))
    }

    /// The statistics in a result row.
    fn statistics(&self) -> impl Iterator<Item = (usize, Statistic)> + '_ {
        self.wanted.iter().filter_map(|one| match one {
            Wanted::Statistic(of, statistic) => Some((*of, *statistic)),
            Wanted::Number(_) => None,
        })
    }

    /// Runs variants, each with its own values of some parameters and of some entries of `set`. Where it is faster,
    /// several runs are integrated side by side, with the same results.
    ///
    /// `stop` is called from time to time and stops the work if it returns true.
    pub fn variants(&self, rows: &[VariantRow], stop: &(dyn Fn() -> bool + Sync)) -> Vec<Outcome> {
        let ready: Vec<_> = rows.iter().map(|row| self.ready(row, stop)).list();
        let mut outcomes: Vec<_> = ready.iter().map(|ready| ready.as_ref().err().cloned()).list();
        let (places, variants): (Vec<_>, Vec<_>) =
            ready.iter().enumerate().filter_map(beside).unzip();
        let watch = || if stop() { Flow::Stop } else { Flow::Continue };
        side_by_side(&variants, &watch, &mut |k, run| {
            let of = ready[places[k]].as_ref().ok();
            outcomes[places[k]] = of.map(|ready| self.outcome(ready, Some(run), stop));
        });
        let left =
            outcomes.into_iter().zip(&ready).map(|(outcome, ready)| match (outcome, ready) {
                (None, Ok(ready)) => self.outcome(ready, None, stop),
                (outcome, _) => outcome.unwrap_or(Outcome::Single),
            });
        left.list()
    }

    /// The outcome of a variant. The variant is run here if `run` is None.
    fn outcome(
        &self,
        ready: &Ready,
        run: Option<dynamics::RunOutcome>,
        stop: &dyn Fn() -> bool,
    ) -> Outcome {
        let found = match run {
            Some(Ok(run)) => Ok(Record::of_motion(run, &ready.start, String::new())),
            Some(Err(failure)) => Err(failure.reason.into()),
            None => self.run(ready, &ready.kept, stop),
        };
        let found = match found {
            // the run is repeated with all outputs, because its failure may occur at one of them
            Err(_) if ready.kept != ready.analysis => self.run(ready, &ready.analysis, stop),
            found => found,
        };
        match found {
            _ if stop() => Outcome::Stopped,
            Ok(record) => self.numbers(ready, record).map_or_else(Outcome::from, Outcome::Values),
            Err(reason) => reason.into(),
        }
    }

    /// The numbers of a result.
    fn numbers(&self, ready: &Ready, record: Record) -> Result<Vec<f64>, Missing> {
        let is_dynamics = matches!(ready.analysis, AnyAnalysis::Dynamics(_));
        if !is_dynamics && self.reads_quantities() && can_stick(ready.prepared.model()) {
            return Err(Missing::Single);
        }
        let Record { motion: Some(run), driven, responses, .. } = record else {
            let subject = self.subject(ready);
            let number = |one: &Wanted| match one {
                Wanted::Number(text) => ready.analysis.number(&subject, &record, text),
                Wanted::Statistic(..) => Ok(f64::NAN),
            };
            let found: Result<_, record::Outcome> = self.wanted.iter().map(number).collect();
            return found.map_err(|reason| Missing::Failed(reason.message));
        };
        // with all outputs, the run needs no others
        let grid = ready.grid.filter(|_| run.trajectory.t.len() == 2);
        let rests = driven.as_ref().is_some_and(|driven| driven.variable.rests);
        let whole = driven.map(|driven| Arc::new(PreparedModel::new(driven.model)));
        let whole = whole.as_ref().unwrap_or(&ready.prepared);
        self.of_motion(Readings::new(whole, &run, rests, grid)?.solved_by(responses))
    }

    /// The statistics of a motion.
    fn of_motion(&self, readings: Readings<'_>) -> Result<Vec<f64>, Missing> {
        let measures = self.measures.iter().enumerate().map(|(k, text)| {
            // measures are read for each variant, because the position of a point may depend on a parameter
            let measure = Measure::read(readings.model(), text).map_err(|_| Missing::Single)?;
            let own = self.statistics().filter(|(of, _)| *of == k).map(|(_, one)| one.extremes());
            Ok((measure, own.fold([false; 2], |all, own| each([0, 1], |k| all[k] || own[k]))))
        });
        let (measures, wanted) = measures.collect::<Result<Vec<_>, _>>()?.into_iter().unzip();
        let between = Between::new(readings.of(measures, wanted));
        let series = (0..self.measures.len()).map(|k| Series::new(&between, k));
        let series = series.collect::<Result<Vec<_>, _>>()?;
        self.statistics().map(|(of, statistic)| series[of].statistic(statistic)).collect()
    }
}

/// A run that can be integrated beside others, with the index of its variant.
fn beside((place, ready): (usize, &Result<Ready, Outcome>)) -> Option<(usize, Variant<'_>)> {
    let Ready { prepared, start, kept: AnyAnalysis::Dynamics(options), after, .. } =
        ready.as_ref().ok()?
    else {
        return None;
    };
    let variant = Variant { prepared, start: &start.state, options };
    (!after && variant.serves()).then_some((place, variant))
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
