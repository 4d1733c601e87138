//! All numbers of a request with their derivatives by all variables.

use super::motion::{joined, AskedRun, MotionSlopes};
use super::numbers::listed;
use super::reader::{Reader, StateSlopes, States};
use super::run_ends::{ending, refusal, state_at, steps};
use super::starts::{with_interpolant, Starts};
use super::statistics::{Found, RunTimes, SlopePlan, SlopeRows};
use super::variables::{parameters, replacements};
use crate::analyses::dynamics::{Run, Setting};
use crate::analyses::measures::Measure;
use crate::analyses::record::Record;
use crate::analyses::sweep::{
    Outcome, PreparedModel, Readings, Ready, Series, Statistic, Sweep, VariantRow,
};
use crate::analyses::AnyAnalysis;
use crate::equations::sensitivity::{Sensitivity, Slope, ABREAST};
use crate::math::{Listed, Ordered};
use crate::model::{Model, Value};
use std::sync::Arc;

/// Why a number has no derivative by a variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Remark {
    /// The index of the number.
    pub number: usize,
    /// The index of the variable.
    pub variable: usize,
    /// The reason.
    pub text: String,
}

/// Numbers with derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct Gradient {
    /// The numbers, in the order of the request; NaN for those of quantities of a whole run.
    pub values: Vec<f64>,
    /// Their derivatives: a row for each number, a column for each variable. NaN where there is none.
    pub jacobian: Vec<f64>,
    /// The reasons for missing derivatives.
    pub remarks: Vec<Remark>,
}

/// Why a magnitude has no derivative.
const ZERO: &str = "the value is zero, where a magnitude has no derivative";
/// Part of the largest value below which a value is a rounding error.
const ROUNDED: f64 = 1e-10;
/// Part of the largest value by which a value changes at least, relative to the change of a variable, if it changes.
const STEEP: f64 = 1e-6;

/// Why a quantity of a whole run has no derivative.
pub(super) const OF_RUN: &str = "the works of drivers and forces are known along simulations only";
/// Why a balance has no derivative.
pub(super) const OF_BALANCE: &str =
    "a balance is an error of the integration, which has no derivative";

/// The outcome of a gradient.
type Outcomes = Result<Gradient, Outcome>;

impl Sweep {
    /// The numbers of one variant and their derivatives by its variables: first the parameters, then the entries of
    /// `set`.
    ///
    /// # Errors
    /// The outcomes of [`variants`](Self::variants) other than values.
    pub fn gradient(&self, row: &VariantRow, stop: &(dyn Fn() -> bool + Sync)) -> Outcomes {
        let ready = self.ready(row, stop)?;
        let count = row.0.len() + row.1.len();
        match &ready.analysis {
            AnyAnalysis::Dynamics(_) => {
                let record = self.run(&ready, &with_interpolant(&ready.analysis), stop);
                self.of_record(&ready, record.map_err(Outcome::from)?, row, stop)
            }
            analysis => {
                let record = self.run(&ready, analysis, stop).map_err(Outcome::from)?;
                if record.motion.is_some() {
                    return self.of_record(&ready, record, row, stop);
                }
                match analysis {
                    AnyAnalysis::Equilibrium(options) => {
                        let values = self.without(row, stop, count, "")?.values;
                        let found = self.of_equilibrium(&ready, options, &record, row, stop);
                        Ok(gathered(values, found, count))
                    }
                    analysis => {
                        let values = self.without(row, stop, count, "")?.values;
                        let found = self.of_numbers(&ready, analysis, &record, row, stop);
                        let (jacobian, reasons) = listed(found);
                        let remark = |([number, variable], text): ([usize; 2], String)| Remark {
                            number,
                            variable,
                            text,
                        };
                        let remarks = reasons.into_iter().map(remark).list();
                        Ok(Gradient { values, jacobian, remarks })
                    }
                }
            }
        }
    }

    /// The numbers without derivatives, for a reason.
    fn without(
        &self,
        row: &VariantRow,
        stop: &(dyn Fn() -> bool + Sync),
        count: usize,
        reason: &str,
    ) -> Outcomes {
        match self.variants(std::slice::from_ref(row), stop).pop() {
            Some(Outcome::Values(values)) => {
                let found = vec![Err(reason.to_string()); values.len()];
                Ok(gathered(values, found, count))
            }
            other => Err(other.unwrap_or(Outcome::Single)),
        }
    }

    fn of_record(
        &self,
        ready: &Ready,
        record: Record,
        row: &VariantRow,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Outcomes {
        let Record { motion: Some(run), driven, responses, .. } = record else {
            return Err(Outcome::Single);
        };
        let rests = driven.as_ref().is_some_and(|driven| driven.variable.rests);
        let whole = driven.map(|driven| Arc::new(PreparedModel::new(driven.model)));
        let whole = whole.as_ref().unwrap_or(&ready.prepared);
        let readings = Readings::new(whole, &run, rests, None)?.solved_by(responses);
        let between = self.between(readings)?;
        let measures: Vec<Measure> =
            (0..self.measures.len()).map(|k| between.readings.measure(k).clone()).list();
        let series = measures.iter().enumerate().map(|(k, measure)| {
            (!measure.is_at_outputs()).then(|| Series::new(&between, k)).transpose()
        });
        let series: Vec<Option<Series<'_>>> = series.collect::<Result<_, _>>()?;
        let of_run = measures.iter().map(Measure::is_of_run).list();
        let of = |(k, statistic): (usize, Statistic)| match &series[k] {
            Some(series) if !of_run[k] => series.statistic(statistic),
            _ => Ok(f64::NAN),
        };
        let values: Result<Vec<f64>, _> = self.statistics().map(of).collect();
        let (values, count) = (values?, row.0.len() + row.1.len());
        let steps = steps(&run);
        let changes = changes(&run, steps);
        let times = RunTimes { outputs: &run.trajectory.t, steps, changes: &changes };
        let plan = |(k, statistic): (usize, Statistic)| match &series[k] {
            _ if measures[k].is_of_balance() => SlopePlan::None(OF_BALANCE.to_string()),
            Some(series) if !of_run[k] => SlopePlan::of(series, statistic, times),
            series => SlopePlan::of_run(series.as_ref(), statistic, times),
        };
        let plans: Vec<SlopePlan> = self.statistics().map(plan).list();
        let needed = plans.iter().flat_map(|plan| plan.times(times)).list();
        let rows = self.rows((whole, &run, rests), ready, (measures, needed), row, stop);
        let found = plans.iter().zip(self.statistics()).map(|(plan, (k, one))| match &rows {
            Ok(rows) => plan.slopes(rows, (k, one == Statistic::Peak), times),
            Err(reason) => Err(reason.clone()),
        });
        let mut found = found.list();
        for (number, (k, _)) in self.statistics().enumerate() {
            let reason = match (&found[number], &series[k]) {
                (Ok(slopes), Some(series)) if !of_run[k] => {
                    is_cusp(series.outputs(), values[number], slopes, row).then_some(ZERO)
                }
                (Ok(slopes), _) => slopes.iter().any(|x| x.is_nan()).then_some(OF_RUN),
                _ => None,
            };
            if let Some(reason) = reason {
                found[number] = Err(reason.to_string());
            }
        }
        Ok(gathered(values, found, count))
    }

    /// Measures with their derivatives at some times of a run and at its end.
    pub(super) fn rows(
        &self,
        (whole, run, rests): (&PreparedModel, &Run, bool),
        ready: &Ready,
        (mut measures, mut t): (Vec<Measure>, Vec<f64>),
        row: &VariantRow,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<SlopeRows, String> {
        let (model, is_driven): (&Model, _) =
            (whole.model(), !matches!(ready.analysis, AnyAnalysis::Dynamics(_)));
        if let Some(reason) = refusal(run, is_driven) {
            return Err(reason);
        }
        let states = |t: f64| state_at(whole, run, t, rests);
        let course = match is_driven {
            true => StateSlopes::Driven(Self::blocks(model, row)?, &states as States<'_>),
            false => {
                let along = self.along((model, run), ready, row, stop)?;
                StateSlopes::Dynamics(Box::new(along))
            }
        };
        let (ends, condition) = (ending(model, run, &ready.analysis)?, measures.len());
        measures.extend(ends.iter().cloned());
        t.extend(run.trajectory.t.last());
        let count = row.0.len() + row.1.len();
        let rows = SlopeRows::read(
            &mut Reader::new(whole.model(), measures, course, steps(run)),
            t,
            count,
        )?;
        match ends {
            None => Ok(rows),
            Some(_) => rows.ending_at_zero_of(condition),
        }
    }

    /// The names of the variables, in blocks.
    pub(super) fn names(row: &VariantRow) -> Vec<Vec<String>> {
        let names: Vec<String> = row.0.iter().chain(&row.1).map(|(name, _)| name.clone()).list();
        names.chunks(ABREAST).map(<[String]>::to_vec).list()
    }

    /// The equations of a model with derivatives, for blocks of variables.
    pub(super) fn blocks(model: &Model, row: &VariantRow) -> Result<Vec<Sensitivity>, String> {
        let of = |names: &Vec<String>| equations(model, names, &[]);
        Self::names(row).iter().map(of).collect()
    }

    /// The derivatives along a run of forward dynamics.
    pub(super) fn along<'a>(
        &'a self,
        (model, run): (&'a Model, &'a Run),
        ready: &'a Ready,
        row: &'a VariantRow,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<MotionSlopes<'a>, String> {
        let AnyAnalysis::Dynamics(options) = &ready.analysis else {
            return Err("the motion is not integrated".to_string());
        };
        let Starts { states, late } = self.starts(ready, row, stop)?;
        let late = if options.t_start.is_some() { vec![0.0; late.len()] } else { late };
        let starts: Vec<Vec<Slope>> = states.into_iter().map(joined).list();
        let values = row.0.iter().chain(&row.1).map(|(_, x)| if *x == 0.0 { 1.0 } else { x.abs() });
        let padding = std::iter::repeat(1.0);
        let sizes: Vec<f64> = values.chain(padding).take(ABREAST * starts.len()).list();
        let written = match self.analyses.last().and_then(|entry| entry.get("parameters")) {
            Some(Value::Table(written)) => &written[..],
            _ => &[],
        };
        let equations = Box::new(move |phase: &Model, setting: &Setting| {
            let of = |names: &Vec<String>| {
                let replaced = replacements(model, names, written, &setting.parameters);
                equations(phase, names, &replaced.ok_or_else(unread)?)
            };
            Self::names(row).iter().map(of).collect()
        });
        let starts = (starts, late);
        MotionSlopes::new(AskedRun { model, run, options, starts, sizes, equations })
    }
}

/// The equations of a model with derivatives by some variables. Some parameters have other values.
fn equations(
    model: &Model,
    names: &[String],
    replaced: &[(String, Slope)],
) -> Result<Sensitivity, String> {
    let numbers = parameters(model, names, replaced).ok_or_else(unread)?;
    Ok(Sensitivity::new(Model::new(&model.blueprint, &numbers)))
}

fn unread() -> String {
    "its parameters cannot be read".to_string()
}

/// The times at which a motion changes: phases begin, or other pieces of switches hold.
fn changes(run: &Run, steps: &[f64]) -> Vec<f64> {
    let phases = run.phases.iter().skip(1).filter_map(|row| run.trajectory.t.get(*row));
    let pieces = run.held.iter().skip(1).filter_map(|held| steps.get(held.step));
    let mut all: Vec<f64> = phases.chain(pieces).copied().list();
    all.order_by(f64::total_cmp);
    all
}

/// Whether a value is the zero of a magnitude, up to rounding errors, which has no derivative there. A quantity without
/// negative values that is zero in all its derivatives has one.
fn is_cusp(outputs: &[f64], value: f64, slopes: &[f64], row: &VariantRow) -> bool {
    let most = outputs.iter().fold(0.0_f64, |most, x| most.max(*x));
    let sizes = row.0.iter().chain(&row.1).map(|(_, x)| x.abs());
    let steep = slopes.iter().zip(sizes).any(|(slope, size)| slope.abs() * size > STEEP * most);
    steep && value <= ROUNDED * most && outputs.iter().all(|x| *x >= 0.0)
}

fn gathered(values: Vec<f64>, found: Vec<Found>, count: usize) -> Gradient {
    let (mut jacobian, mut remarks) = (Vec::new(), Vec::new());
    for (number, slopes) in found.into_iter().enumerate() {
        let slopes = match slopes {
            Ok(slopes) => slopes,
            Err(text) => {
                let of = |variable| Remark { number, variable, text: text.clone() };
                remarks.extend((0..count).map(of));
                vec![f64::NAN; count]
            }
        };
        for (variable, x) in slopes.iter().enumerate().filter(|(_, x)| !x.is_finite()) {
            if !remarks.iter().any(|one| (one.number, one.variable) == (number, variable)) {
                let text = match values[number] == 0.0 {
                    true => ZERO.to_string(),
                    false => format!("the derivative is {x}"),
                };
                remarks.push(Remark { number, variable, text });
            }
        }
        jacobian.extend(slopes.iter().map(|x| if x.is_finite() { *x } else { f64::NAN }));
    }
    Gradient { values, jacobian, remarks }
}
