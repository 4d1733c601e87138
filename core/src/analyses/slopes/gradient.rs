//! All numbers of a request with their derivatives by all variables.

use super::motion::{AskedRun, MotionSlopes};
use super::reader::{Reader, StateSlopes, States};
use super::run_ends::{ending, refusal, state_at, steps};
use super::starts::{joined, with_interpolant, Starts};
use super::statistics::{Found, RunTimes, SlopePlan, SlopeRows};
use super::variables::replacements;
use super::variant::{equations, unread, ReadyVariant};
use crate::analyses::dynamics::{Run, Setting};
use crate::analyses::measures::Measure;
use crate::analyses::record::Record;
use crate::analyses::sweep::{
    Outcome, PreparedModel, Readings, Series, Statistic, Sweep, VariantRow,
};
use crate::analyses::AnyAnalysis;
use crate::equations::sensitivity::{Slope, ABREAST};
use crate::math::{Listed, Ordered, Real};
use crate::model::{Model, Value};

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

/// The derivatives of each number by each variable, or the reasons for which there are none.
pub(super) type NumberSlopes = Vec<Vec<Result<f64, String>>>;

/// Why a magnitude has no derivative.
const ZERO: &str = "the value is zero, where a magnitude has no derivative";
/// Part of the largest value below which a value is a rounding error.
const ROUNDED: f64 = 1e-10;
/// Part of the largest value by which a value changes at least, relative to the change of a variable, if it changes.
const STEEP: f64 = 1e-6;

/// Why a number that counts has no derivative.
pub(super) const COUNTS: &str = "it counts, or says yes or no, and does not change gradually";
/// Why a quantity of a whole run has no derivative.
pub(super) const OF_RUN: &str = "the works of drivers and forces are known along simulations only";
/// Why integrals of forces and accelerations have no derivative by a variable that ends a rest.
const CAUGHT: &str =
    "a change of it ends a rest at the start, and the forces that stop the motion again are not in the derivative";
/// Why a balance has no derivative.
pub(super) const OF_BALANCE: &str =
    "a balance is an error of the integration, which has no derivative";

impl Sweep {
    /// The numbers of one variant and their derivatives by its variables: first the parameters, then the entries of
    /// `set`.
    ///
    /// # Errors
    /// The outcomes of [`variants`](Self::variants) other than values.
    pub fn gradient(
        &self,
        row: &VariantRow,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Gradient, Outcome> {
        let ready = &self.ready(row, stop)?;
        let variant = ReadyVariant { sweep: self, ready, row, stop };
        let record = variant.run(&with_interpolant(&ready.analysis))?;
        if record.motion.is_some() || variant.is_integrated() {
            return variant.of_motion(record);
        }
        let values = variant.numbers()?;
        let found = variant.of_numbers(&record, &values);
        Ok(Gradient::of(values, found))
    }
}

impl<'a> ReadyVariant<'a> {
    /// The numbers without derivatives.
    fn numbers(&self) -> Result<Vec<f64>, Outcome> {
        match self.sweep.variants(std::slice::from_ref(self.row), self.stop).pop() {
            Some(Outcome::Values(values)) => Ok(values),
            other => Err(other.unwrap_or(Outcome::Single)),
        }
    }

    /// The derivatives of the numbers of a result that is not a motion.
    fn of_numbers(&self, record: &Record, values: &[f64]) -> NumberSlopes {
        let count = self.count();
        let none = |reason: &str| vec![vec![Err(reason.to_string()); count]; values.len()];
        match &self.ready.analysis {
            AnyAnalysis::Modes(options) => self.of_modes(options),
            AnyAnalysis::Limits(_) => self.of_limits(record),
            AnyAnalysis::Equilibrium(options) => {
                let found = self.of_equilibrium(options, record).into_iter().zip(values);
                found.map(|(found, value)| by_variable(*value, found, count)).list()
            }
            AnyAnalysis::Configurations(_) | AnyAnalysis::Mobility(_) => none(COUNTS),
            _ => none("kempe has no derivatives of this number yet"),
        }
    }

    fn of_motion(&self, record: Record) -> Result<Gradient, Outcome> {
        let Record { motion: Some(run), driven, responses, .. } = record else {
            return Err(Outcome::Single);
        };
        let (whole, rests) = self.ready.whole(driven);
        let readings = Readings::new(&whole, &run, rests, None)?.solved_by(responses);
        let between = self.sweep.between(readings)?;
        let count = self.sweep.measures.len();
        let measures: Vec<Measure> = (0..count).map(|k| between.readings.measure(k).clone()).list();
        let series = measures.iter().enumerate().map(|(k, measure)| {
            (!measure.is_at_outputs()).then(|| Series::new(&between, k)).transpose()
        });
        let series: Vec<Option<Series<'_>>> = series.collect::<Result<_, _>>()?;
        let of_run = measures.iter().map(Measure::is_of_run).list();
        let statistics: Vec<(usize, Statistic)> = self.sweep.statistics().list();
        let of_forces = |k: usize| measures[k].needs_solution(whole.model());
        let sums = statistics.iter().map(|(k, one)| one.is_integral() && of_forces(*k)).list();
        let of = |(k, statistic): &(usize, Statistic)| match &series[*k] {
            Some(series) if !of_run[*k] => series.statistic(*statistic),
            _ => Ok(f64::NAN),
        };
        let values = statistics.iter().map(of).collect::<Result<Vec<f64>, _>>()?;
        let steps = steps(&run);
        let changes = changes(&run, steps);
        let times = RunTimes { outputs: &run.trajectory.t, steps, changes: &changes };
        let plan = |(k, statistic): &(usize, Statistic)| match &series[*k] {
            _ if measures[*k].is_of_balance() => SlopePlan::None(OF_BALANCE.to_string()),
            Some(series) if !of_run[*k] => SlopePlan::of(series, *statistic, times),
            series => SlopePlan::of_run(series.as_ref(), *statistic, times),
        };
        let plans: Vec<SlopePlan> = statistics.iter().map(plan).list();
        let needed = plans.iter().flat_map(|plan| plan.times(times)).list();
        let rows = self.rows((&whole, &run, rests), (measures, needed));
        let slopes = |(number, (k, one)): (usize, &(usize, Statistic))| -> Found {
            let rows = rows.as_ref().map_err(Clone::clone)?;
            let found = plans[number].slopes(rows, (*k, *one == Statistic::Peak), times)?;
            let reason = match &series[*k] {
                Some(series) if !of_run[*k] => {
                    is_cusp(series.outputs(), values[number], &found, self).then_some(ZERO)
                }
                _ => found.iter().any(|x| x.is_nan()).then_some(OF_RUN),
            };
            reason.map_or(Ok(found), |reason| Err(reason.to_string()))
        };
        let found = statistics.iter().enumerate().map(slopes).zip(&values);
        let found = found.map(|(found, value)| by_variable(*value, found, self.count())).list();
        let caught = rows.as_ref().map_or(&[][..], |rows| &rows.caught);
        let mut found = Gradient::of(values, without(found, (&sums, caught)));
        let doubt = |plan: &SlopePlan| {
            let last = plan.times(times).into_iter().reduce(f64::max)?;
            rows.as_ref().ok()?.doubt(last)
        };
        found.add_doubts(&plans.iter().map(doubt).list());
        Ok(found)
    }

    /// Measures with their derivatives at some times of a run and at its end.
    pub fn rows(
        &self,
        (whole, run, rests): (&PreparedModel, &Run, bool),
        (mut measures, mut t): (Vec<Measure>, Vec<f64>),
    ) -> Result<SlopeRows, String> {
        let states = |t: f64| state_at(whole, run, t, rests);
        let course = self.course((whole.model(), run), &states)?;
        let ends = ending(whole.model(), run, &self.ready.analysis)?;
        let condition = measures.len();
        measures.extend(ends.iter().cloned());
        t.extend(run.trajectory.t.last());
        let mut reader = Reader::new(whole.model(), measures, course, steps(run));
        let rows = SlopeRows::read(&mut reader, t, self.count())?;
        match ends {
            None => Ok(rows),
            Some(_) => rows.ending_at_zero_of(condition),
        }
    }

    /// How the derivatives of the states of a run are found.
    ///
    /// # Errors
    /// The reason for which there are none.
    pub fn course(
        self,
        (model, run): (&'a Model, &'a Run),
        states: States<'a>,
    ) -> Result<StateSlopes<'a>, String> {
        let AnyAnalysis::Dynamics(options) = &self.ready.analysis else {
            refusal(model, run, true).map_or(Ok(()), Err)?;
            return Ok(StateSlopes::Driven(self.blocks(model)?, states));
        };
        refusal(model, run, false).map_or(Ok(()), Err)?;
        let Starts { states, mut late } = self.starts()?;
        if options.t_start.is_some() {
            late.fill(0.0);
        }
        let mut starts: Vec<Vec<Slope>> = states.into_iter().map(joined).list();
        let (mut names, mut sizes) = (self.names(), self.sizes());
        let count = sizes.len();
        // the place after the variables is that of the error of the run
        let blocks = count / ABREAST + 1;
        names.resize(blocks, Vec::new());
        if starts.len() < blocks {
            starts.push(starts[0].iter().map(|x| Slope::constant(x.value)).list());
        }
        sizes.resize(ABREAST * blocks, 1.0);
        late.resize(ABREAST * blocks, 0.0);
        // the parameters of the analysis have the last values in its table
        let written = match self.sweep.analyses.last().and_then(|entry| entry.get("parameters")) {
            Some(Value::Table(written)) => &written[..],
            _ => &[],
        };
        let equations = Box::new(move |phase: &Model, setting: &Setting| {
            let of = |names: &Vec<String>| {
                let replaced = replacements(model, names, written, &setting.parameters);
                equations(phase, names, &replaced.ok_or_else(unread)?)
            };
            names.iter().map(of).collect()
        });
        let starts = (starts, late);
        let asked = AskedRun { model, run, options, starts, sizes, count, equations };
        Ok(StateSlopes::Dynamics(Box::new(MotionSlopes::new(asked)?)))
    }
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
fn is_cusp(outputs: &[f64], value: f64, slopes: &[f64], variant: &ReadyVariant) -> bool {
    let most = outputs.iter().fold(0.0_f64, |most, x| most.max(*x));
    let sizes = variant.variables().map(|(_, x)| x.abs());
    let steep = slopes.iter().zip(sizes).any(|(slope, size)| slope.abs() * size > STEEP * most);
    steep && value <= ROUNDED * most && outputs.iter().all(|x| *x >= 0.0)
}

/// The derivatives of numbers without those of `sums` by the variables `caught`.
fn without(mut found: NumberSlopes, (sums, caught): (&[bool], &[bool])) -> NumberSlopes {
    for (slopes, _) in found.iter_mut().zip(sums).filter(|(_, sum)| **sum) {
        let caught = slopes.iter_mut().zip(caught).filter(|(_, caught)| **caught);
        caught.for_each(|(slope, _)| *slope = Err(CAUGHT.to_string()));
    }
    found
}

impl Gradient {
    fn of(values: Vec<f64>, found: NumberSlopes) -> Self {
        let (mut jacobian, mut remarks) = (Vec::new(), Vec::new());
        for (number, slopes) in found.into_iter().enumerate() {
            for (variable, slope) in slopes.into_iter().enumerate() {
                let slope = slope.and_then(finite);
                jacobian.push(*slope.as_ref().unwrap_or(&f64::NAN));
                remarks.extend(slope.err().map(|text| Remark { number, variable, text }));
            }
        }
        Self { values, jacobian, remarks }
    }
}

impl Gradient {
    /// Adds remarks on inaccurate derivatives of each number.
    fn add_doubts(&mut self, doubts: &[Option<String>]) {
        let count = self.jacobian.len() / self.values.len().max(1);
        for (place, slope) in self.jacobian.iter().enumerate() {
            let (number, variable) = (place / count, place % count);
            if let Some(text) = doubts[number].as_ref().filter(|_| slope.abs() > 0.0) {
                self.remarks.push(Remark { number, variable, text: text.clone() });
            }
        }
    }
}

fn finite(slope: f64) -> Result<f64, String> {
    match slope.is_finite() {
        true => Ok(slope),
        false => Err(format!("the derivative is {slope}")),
    }
}

/// The derivatives of a number with this value, or the reasons for which there are none, for each variable.
pub(super) fn by_variable(value: f64, found: Found, count: usize) -> Vec<Result<f64, String>> {
    let one = |slope: f64| match value == 0.0 && !slope.is_finite() {
        true => Err(ZERO.to_string()),
        false => Ok(slope),
    };
    found
        .map_or_else(|reason| vec![Err(reason); count], |slopes| slopes.into_iter().map(one).list())
}
