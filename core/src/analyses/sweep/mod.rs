//! Sweeps: runs of one mechanism with many values of its parameters and start, and the statistics of measures of each
//! run.
//!
//! A variant is equivalent to a single run of the changed case: its model is built from the linked blueprint,
//! assembled from the start of the case, run, and measured. Variants share no state. Their numbers therefore do not
//! depend on the order, and the caller may compute variants on any number of threads.

mod faults;
mod fine;
mod kept;
mod readings;
mod series;
mod statistic;

pub use faults::{measure_fault, variable_fault};
pub use statistic::Statistic;

use super::assemble::{self, state_until, Request};
use super::dynamics::{self, side_by_side, Options, Prepared, Reason, Run, Variant};
use super::measures::Measure;
use super::State;
use crate::integrate::Flow;
use crate::math::Listed;
use crate::model::{Model, Value};
use fine::Between;
use readings::{Missing, PreparedModel, Readings};
use series::Series;
use std::sync::Arc;

/// A case whose variants are run.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The model.
    pub model: Arc<Model>,
    /// Coordinates and rates that are prescribed at the start, as written in the case.
    pub set: Vec<(String, Value)>,
    /// Guesses of coordinates and rates at the start, as written in the case.
    pub guess: Vec<(String, Value)>,
    /// The fields of the analysis `dynamics`, as written.
    pub analysis: Vec<(String, Value)>,
    /// Expressions of quantities, such as `C.force`. They must not use energies or checks of a run.
    pub measures: Vec<String>,
    /// The numbers of a result row: statistics, each with the index of its measure.
    pub wanted: Vec<(usize, Statistic)>,
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

/// A variant before its run.
struct Ready {
    model: Arc<Model>,
    state: State,
    options: Options,
    /// The options without output that no statistic needs.
    kept: Options,
}

impl Sweep {
    /// Whether this module can compute variants of a model. The model must not have redundant joints or functions of
    /// the caller.
    pub fn serves(model: &Model) -> bool {
        !model.allow_redundancy && model.blueprint.functions.is_none()
    }

    /// Runs variants, each with its own values of some parameters and of some entries of `set`. Where it is faster,
    /// several runs are integrated side by side, with the same results.
    ///
    /// `stop` is called from time to time and stops the work if it returns true.
    pub fn variants(&self, rows: &[VariantRow], stop: &(dyn Fn() -> bool + Sync)) -> Vec<Outcome> {
        let ready: Vec<_> = rows.iter().map(|row| self.ready(row, stop)).list();
        let prepared = ready.iter().map(|ready| ready.as_ref().ok());
        let prepared: Vec<_> = prepared
            .map(|ready| ready.map(|of| Arc::new(Prepared::new(Arc::clone(&of.model)))))
            .list();
        let together = self.together(&ready, &prepared, stop);
        let runs = ready.iter().zip(&prepared).zip(together);
        let outcomes = runs.map(|((ready, prepared), run)| match (ready, prepared) {
            (Ok(ready), Some(prepared)) => self.outcome(ready, prepared, run, stop),
            (Err(outcome), _) => outcome.clone(),
            (Ok(_), None) => Outcome::Single,
        });
        outcomes.list()
    }

    /// A variant before its run.
    fn ready(
        &self,
        (parameters, start): &VariantRow,
        stop: &dyn Fn() -> bool,
    ) -> Result<Ready, Outcome> {
        if stop() {
            return Err(Outcome::Stopped);
        }
        if !Self::serves(&self.model) {
            return Err(Outcome::Single);
        }
        let model = self.model.with_values(parameters).map_err(|_| Outcome::Single)?;
        let request = self.request(&model, start).ok_or(Outcome::Single)?;
        let state = match state_until(&model, &request, stop) {
            Ok(state) => state,
            Err(_) if stop() => return Err(Outcome::Stopped),
            Err(failure) => return Err(Outcome::Failed(failure.message)),
        };
        let options = dynamics::read(&model, &self.analysis, &[]).map_err(|_| Outcome::Single)?;
        if options.backward(state.t, &["t_end"]).is_some() {
            return Err(Outcome::Single);
        }
        let wanted: Vec<Statistic> = self.wanted.iter().map(|(_, statistic)| *statistic).list();
        let kept = kept::kept(&options, &wanted, options.t_start.unwrap_or(state.t));
        Ok(Ready { model: Arc::new(model), state, options, kept })
    }

    /// The runs that are integrated side by side; None for the other variants.
    fn together<'r>(
        &self,
        ready: &'r [Result<Ready, Outcome>],
        prepared: &'r [Option<Arc<PreparedModel>>],
        stop: &dyn Fn() -> bool,
    ) -> Vec<Option<dynamics::RunOutcome>> {
        let mut runs: Vec<_> = ready.iter().map(|_| None).list();
        let all = ready.iter().zip(prepared).enumerate();
        let (places, variants): (Vec<_>, Vec<_>) = all
            .filter_map(|(place, (ready, prepared))| {
                let (Ok(ready), Some(prepared)) = (ready, prepared) else { return None };
                let variant = Variant { prepared, start: &ready.state, options: &ready.kept };
                variant.serves().then_some((place, variant))
            })
            .unzip();
        let watch = || if stop() { Flow::Stop } else { Flow::Continue };
        let (outcomes, _) = side_by_side(&variants, &watch);
        for (place, run) in places.into_iter().zip(outcomes) {
            runs[place] = Some(run);
        }
        runs
    }

    /// The outcome of a variant. The variant is run here if `run` is None.
    fn outcome(
        &self,
        ready: &Ready,
        prepared: &Arc<PreparedModel>,
        run: Option<dynamics::RunOutcome>,
        stop: &dyn Fn() -> bool,
    ) -> Outcome {
        let watch = |_| if stop() { Flow::Stop } else { Flow::Continue };
        let Ready { state, options, kept, .. } = ready;
        let run = match run.unwrap_or_else(|| prepared.dynamics(state, kept, watch)) {
            // the run is repeated with all outputs, because its failure may occur at one of them
            Err(_) if kept != options => prepared.dynamics(state, options, watch),
            run => run,
        };
        let run = match run {
            _ if stop() => return Outcome::Stopped,
            Ok(run) => run,
            Err(failure) => return failed(&failure.reason),
        };
        match self.numbers(prepared, &run) {
            Ok(values) => Outcome::Values(values),
            Err(Missing::Failed(reason)) => failed(&reason),
            Err(Missing::Single) => Outcome::Single,
        }
    }

    fn numbers(&self, prepared: &Arc<PreparedModel>, run: &Run) -> Result<Vec<f64>, Missing> {
        let measures = self.measures.iter().enumerate().map(|(k, text)| {
            // measures are read for each variant, because the position of a point may depend on a parameter
            let measure = Measure::read(prepared.model(), text).map_err(|_| Missing::Single)?;
            let is_extreme = |(of, one): &(usize, Statistic)| *of == k && one.is_extreme();
            Ok((measure, self.wanted.iter().any(is_extreme)))
        });
        let measures = measures.collect::<Result<Vec<_>, _>>()?.into_iter().unzip();
        let readings = Readings::new(prepared, run, measures)?;
        let between = Between::new(readings);
        let series = (0..self.measures.len()).map(|k| Series::new(&between, k));
        let series = series.collect::<Result<Vec<_>, _>>()?;
        self.wanted.iter().map(|(of, statistic)| series[*of].statistic(*statistic)).collect()
    }

    /// The request for the assembly; None if an entry is faulty.
    fn request(&self, model: &Model, start: &[(String, f64)]) -> Option<Request> {
        let mut set = self.set.clone();
        for (name, x) in start {
            let (_, value) = set.iter_mut().find(|(known, _)| known == name)?;
            *value = Value::Number(*x);
        }
        let set = assemble::targets(model, "set", &set).ok()?;
        let guess = assemble::targets(model, "guess", &self.guess).ok()?;
        Some(Request { set, guess, ..Request::default() })
    }
}

fn failed(reason: &Reason) -> Outcome {
    match reason {
        // a fault of the options, which a single run reports
        Reason::Option { .. } => Outcome::Single,
        _ => Outcome::Failed(reason.to_string()),
    }
}
