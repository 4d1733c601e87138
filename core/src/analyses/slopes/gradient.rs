//! All numbers of a request with their derivatives by all variables.

use super::motion::{joined, MotionSlopes};
use super::reader::{Reader, StateSlopes, States};
use super::statistics::{Found, RunTimes, SlopePlan, SlopeRows};
use super::variables::parameters;
use crate::analyses::assemble::{self, set_slopes, StartSlopes};
use crate::analyses::dynamics::{Options, Run, Scheme};
use crate::analyses::measures::Measure;
use crate::analyses::record::Record;
use crate::analyses::sweep::{
    Outcome, PreparedModel, Readings, Ready, Series, Statistic, Sweep, VariantRow,
};
use crate::analyses::{chain, AnyAnalysis};
use crate::equations::sensitivity::{Sensitivity, Slope, ABREAST};
use crate::math::Listed;
use crate::model::Model;
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
    /// The numbers, in the order of the request.
    pub values: Vec<f64>,
    /// Their derivatives: a row for each number, a column for each variable. NaN where there is none.
    pub jacobian: Vec<f64>,
    /// The reasons for missing derivatives.
    pub remarks: Vec<Remark>,
}

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
            AnyAnalysis::Dynamics(options) => {
                let options = Options { dense_output: true, ..options.clone() };
                let analysis = AnyAnalysis::Dynamics(options);
                let record = self.run(&ready, &analysis, stop);
                self.of_record(&ready, record.map_err(Outcome::from)?, row, stop)
            }
            analysis => {
                let record = self.run(&ready, analysis, stop).map_err(Outcome::from)?;
                if record.motion.is_some() {
                    return self.of_record(&ready, record, row, stop);
                }
                match analysis {
                    AnyAnalysis::Equilibrium(options) if options.over.is_none() => {
                        let values = self.without(row, stop, count, "")?.values;
                        let found = self.of_equilibrium(&ready, options, &record, row, stop);
                        Ok(gathered(values, found, count))
                    }
                    _ => self.without(row, stop, count, "this analysis has no derivatives yet"),
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
        let series = (0..self.measures.len()).map(|k| Series::new(&between, k));
        let series: Vec<Series<'_>> = series.collect::<Result<_, _>>()?;
        let values: Result<Vec<f64>, _> =
            self.statistics().map(|(of, statistic)| series[of].statistic(statistic)).collect();
        let (mut values, count) = (values?, row.0.len() + row.1.len());
        let steps = run.dense.as_ref().map_or(&run.trajectory.t[..], |dense| &dense.t);
        let times = RunTimes { outputs: &run.trajectory.t, steps };
        let plans: Vec<SlopePlan> = self
            .statistics()
            .map(|(of, statistic)| SlopePlan::of(&series[of], statistic, times))
            .list();
        let measures = (0..self.measures.len()).map(|k| between.readings.measure(k).clone()).list();
        let needed = plans.iter().flat_map(|plan| plan.times(times)).list();
        let rows = self.rows((whole, &run, rests), ready, (measures, needed), row, stop);
        let found = plans.iter().zip(self.statistics()).map(|(plan, (k, one))| match &rows {
            Ok(rows) => plan.slopes(rows, (k, one == Statistic::Peak), times),
            Err(reason) => Err(reason.clone()),
        });
        let mut found = found.list();
        for (number, (k, one)) in self.statistics().enumerate() {
            if between.readings.measure(k).is_of_run() {
                let last = rows.as_ref().ok().filter(|_| one == Statistic::Final);
                (values[number], found[number]) = of_whole_run(last, k, found[number].clone());
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
        if let Some(reason) = refusal(model, run, is_driven) {
            return Err(reason);
        }
        let states = |t: f64| state_at(whole, run, t, rests);
        let blocks = self.blocks(model, row)?;
        let course = match is_driven {
            true => StateSlopes::Driven(blocks, &states as States<'_>),
            false => {
                let along = self.along((model, run), ready, blocks, row, stop)?;
                StateSlopes::Dynamics(Box::new(along))
            }
        };
        let (ends, condition) = (ending(model, run, &ready.analysis)?, measures.len());
        measures.extend(ends.iter().cloned());
        t.extend(run.trajectory.t.last());
        let count = row.0.len() + row.1.len();
        let rows = SlopeRows::read(&mut Reader::new(model, measures, course), t, count)?;
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
    fn blocks(&self, model: &Model, row: &VariantRow) -> Result<Vec<Sensitivity>, String> {
        let of = |names: &Vec<String>| {
            let numbers = parameters(model, names).ok_or("its parameters cannot be read")?;
            Ok(Sensitivity::new(Model::new(&model.blueprint, &numbers)))
        };
        Self::names(row).iter().map(of).collect()
    }

    /// The derivatives of the start of an analysis, in blocks of variables.
    pub(super) fn starts(
        &self,
        ready: &Ready,
        row: &VariantRow,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Vec<StartSlopes>, String> {
        let places = chain(&self.analyses, self.analyses.len() - 1);
        match places[..] {
            [_] => self.assembled(ready, row),
            [first, _] => {
                let analyses = vec![self.analyses[first].clone()];
                let before = Self { analyses, wanted: Vec::new(), ..self.clone() };
                let unfinished = || "the analysis before has no derivatives".to_string();
                let ready = before.ready(row, stop).map_err(|_| unfinished())?;
                let AnyAnalysis::Equilibrium(options) = &ready.analysis else {
                    return Err("its start is the end of a motion".to_string());
                };
                if options.over.is_some() || ready.prepared.model().driven {
                    return Err("its start is the end of a path, or drivers move it".to_string());
                }
                let record = before.run(&ready, &ready.analysis, stop);
                let record = record.map_err(|_| unfinished())?;
                let found = before.rests((&ready, options, &record), row, stop)?;
                Ok(found.into_iter().map(|(rest, _)| rest.start()).list())
            }
            _ => Err("its start is the end of several analyses".to_string()),
        }
    }

    /// The derivatives of an assembled start, in blocks of variables.
    fn assembled(&self, ready: &Ready, row: &VariantRow) -> Result<Vec<StartSlopes>, String> {
        let unread = || "the start cannot be read".to_string();
        let set = self.set_of(&row.1).ok_or_else(unread)?;
        let start = &ready.start.state;
        let mut request = self.request(ready.prepared.model(), &set).ok_or_else(unread)?;
        request.t = start.t;
        let of = |names: &Vec<String>| -> Result<StartSlopes, String> {
            let own = ready.prepared.model();
            let numbers = parameters(own, names).ok_or_else(unread)?;
            let values = set_slopes(own, ("set", &set), &numbers, names).ok_or_else(unread)?;
            let guess =
                set_slopes(own, ("guess", &self.guess), &numbers, &[]).ok_or_else(unread)?;
            let varies = guess.iter().position(|x| x.slope.iter().any(|slope| *slope != 0.0));
            if let Some(name) = varies.map(|k| &self.guess[k].0) {
                return Err(format!("the guess of {name} depends on it; prescribe {name} in set"));
            }
            assemble::slopes(own, &request, (&numbers, &values), start)
        };
        Self::names(row).iter().map(of).collect()
    }

    /// The derivatives along a run of forward dynamics.
    fn along<'a>(
        &self,
        (model, run): (&'a Model, &'a Run),
        ready: &Ready,
        blocks: Vec<Sensitivity>,
        row: &VariantRow,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<MotionSlopes<'a>, String> {
        let starts = self.starts(ready, row, stop)?;
        let starts: Vec<Vec<Slope>> = starts.into_iter().map(joined).list();
        let dense = run.dense.as_ref().ok_or_else(|| "the run has no interpolant".to_string())?;
        let AnyAnalysis::Dynamics(Options { method: scheme, .. }) = &ready.analysis else {
            return Err("the motion is not integrated".to_string());
        };
        if matches!(scheme, Scheme::GeneralizedAlpha(_)) {
            let text =
                "slopes do not follow steps of generalized_alpha; choose method auto or radau";
            return Err(text.to_string());
        }
        let implicit = run.statistics.jacobians > 0;
        let last = last_state(model, run);
        let values = row.0.iter().chain(&row.1).map(|(_, x)| if *x == 0.0 { 1.0 } else { x.abs() });
        let padding = std::iter::repeat(1.0);
        let sizes: Vec<f64> = values.chain(padding).take(ABREAST * blocks.len()).list();
        MotionSlopes::new(model, blocks, (dense, last), &starts, (scheme, implicit, &sizes))
    }
}

/// The last state of a run, with its works.
fn last_state(model: &Model, run: &Run) -> Vec<f64> {
    let (of, layout) = (&run.trajectory, &model.layout);
    let row = |table: &[f64], width: usize| table[table.len() - width..].to_vec();
    let parts = [
        row(&of.q, layout.n_q),
        row(&of.v, layout.n_q),
        row(&of.z, layout.n_z),
        row(&of.works, layout.n_works),
    ];
    parts.concat()
}

/// A state within a driven run.
fn state_at(whole: &PreparedModel, run: &Run, t: f64, rests: bool) -> Option<[Vec<f64>; 3]> {
    let layout = &whole.model().layout;
    if let Some(k) = run.trajectory.t.iter().position(|known| *known == t) {
        let of = &run.trajectory;
        let row = |table: &[f64], width: usize| table[k * width..(k + 1) * width].to_vec();
        return Some([row(&of.q, layout.n_q), row(&of.v, layout.n_q), row(&of.z, layout.n_z)]);
    }
    let y = run.dense.as_ref()?.at(&[t]);
    let [q, v, z, _] = layout.split(&y);
    let Some(projection) = run.projection else {
        return Some([q.to_vec(), v.to_vec(), z.to_vec()]);
    };
    let states = crate::analyses::dynamics::States { t: &[t], q, v, z };
    let [q, mut v] = whole.project(states, projection).ok()?;
    if rests {
        v.fill(0.0);
    }
    Some([q, v, z.to_vec()])
}

/// The value and the derivatives of a measure of works or losses since the start, which are known along the steps
/// only. `last` are the rows of a final value.
fn of_whole_run(last: Option<&SlopeRows>, k: usize, found: Found) -> (f64, Found) {
    match last {
        Some(rows) => (rows.last(k), found),
        None if found.is_err() => (f64::NAN, found),
        None => (f64::NAN, Err("of a whole run, only final values have derivatives".to_string())),
    }
}

/// The function of the condition that ended a run, if one did.
///
/// # Errors
/// The condition cannot be read.
fn ending(model: &Model, run: &Run, analysis: &AnyAnalysis) -> Result<Option<Measure>, String> {
    let (Some(name), AnyAnalysis::Dynamics(options)) = (&run.stopped_by, analysis) else {
        return Ok(None);
    };
    let event = options.events.iter().find(|event| event.name == *name);
    let text = event.map_or(options.stop.as_ref(), |event| Some(&event.condition));
    let read = text.and_then(|text| Measure::of_condition(model, text).ok());
    read.map(Some).ok_or_else(|| format!("the motion ends at {name}"))
}

/// Why a run has no derivatives; None if it has.
fn refusal(model: &Model, run: &Run, is_driven: bool) -> Option<String> {
    if run.phases.len() > 1 || run.settings.iter().any(|setting| !setting.is_plain()) {
        return Some("the motion has phases, between which its derivatives jump".to_string());
    }
    if let Some(passed) = run.passed.first() {
        return Some(format!("the motion passes the singular position at t = {:.6} s", passed.t));
    }
    if !is_driven && !model.switches.is_empty() {
        return Some("laws or forces switch, so that derivatives jump".to_string());
    }
    None
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
                    true => "the value is zero, where a magnitude has no derivative".to_string(),
                    false => format!("the derivative is {x}"),
                };
                remarks.push(Remark { number, variable, text });
            }
        }
        jacobian.extend(slopes.iter().map(|x| if x.is_finite() { *x } else { f64::NAN }));
    }
    Gradient { values, jacobian, remarks }
}
