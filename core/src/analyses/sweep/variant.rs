//! A variant before the run of the swept analysis: its model, and the end of the analyses before.

use super::kept::kept;
use super::readings::PreparedModel;
use super::request::{Outcome, Sweep, VariantRow};
use super::statistic::Statistic;
use crate::analyses::assemble::{self, state_until, Request};
use crate::analyses::dynamics::Variant;
use crate::analyses::record::{self, Driven, Observer, Record, StartState, Subject};
use crate::analyses::{chain, fields_of, run_after, AnyAnalysis};
use crate::integrate::Flow;
use crate::math::Listed;
use crate::model::{Model, Value};
use std::sync::Arc;

/// A variant before its run.
pub struct Ready {
    pub prepared: Arc<PreparedModel>,
    pub start: StartState,
    /// Whether it starts at the end of another analysis.
    pub after: bool,
    pub analysis: AnyAnalysis,
    /// The analysis without output that no statistic needs.
    pub kept: AnyAnalysis,
    /// The first output and the time between outputs, if the outputs are left out.
    pub grid: Option<(f64, f64)>,
}

impl Ready {
    /// The model of a motion that `driven` determines, or else of the variant, and whether it rests at each value.
    pub fn whole(&self, driven: Option<Driven>) -> (Arc<PreparedModel>, bool) {
        let of =
            |driven: Driven| (Arc::new(PreparedModel::new(driven.model)), driven.variable.rests);
        driven.map_or_else(|| (Arc::clone(&self.prepared), false), of)
    }
}

impl Sweep {
    /// A variant before its run.
    pub fn ready(
        &self,
        (parameters, start): &VariantRow,
        stop: &dyn Fn() -> bool,
    ) -> Result<Ready, Outcome> {
        if stop() {
            return Err(Outcome::Stopped);
        }
        if self.analyses.is_empty() || !Self::serves(&self.model, self.reads_quantities()) {
            return Err(Outcome::Single);
        }
        if self.excludes(parameters) {
            return Err(Outcome::Single);
        }
        let model = self.model.with_values(parameters).map_err(|_| Outcome::Single)?;
        let set = self.set_of(start).ok_or(Outcome::Single)?;
        let request = self.request(&model, &set).ok_or(Outcome::Single)?;
        let state = match state_until(&model, &request, stop) {
            Ok(state) => state,
            Err(_) if stop() => return Err(Outcome::Stopped),
            Err(failure) => return Err(Outcome::Failed(failure.message)),
        };
        let start = StartState::new(state);
        let prepared = Arc::new(PreparedModel::new(Arc::new(model)));
        self.at_end_of_earlier(prepared, start, (&set, stop))
    }

    /// A variant after the analyses that lead to the swept one.
    fn at_end_of_earlier(
        &self,
        prepared: Arc<PreparedModel>,
        start: StartState,
        (set, stop): (&[(String, Value)], &dyn Fn() -> bool),
    ) -> Result<Ready, Outcome> {
        let model = Arc::clone(prepared.model());
        let read = |place: usize| {
            let fields = fields_of(&self.analyses[place], set);
            AnyAnalysis::read(&model, &fields, &[]).map_err(|_| Outcome::Single)
        };
        let places = chain(&self.analyses, self.analyses.len() - 1);
        let first = read(places[0])?;
        let mut ready = Ready {
            prepared,
            start,
            after: false,
            kept: first.clone(),
            analysis: first,
            grid: None,
        };
        for place in &places[1..] {
            let found = self.run(&ready, &ready.analysis, stop);
            if stop() {
                return Err(Outcome::Stopped);
            }
            let analysis = read(*place)?;
            let kept = analysis.clone();
            ready = Ready { start: found?.end, after: true, kept, analysis, ..ready };
        }
        if let AnyAnalysis::Dynamics(options) = &ready.analysis {
            if options.backward(ready.start.state.t, &["t_end"]).is_some() {
                return Err(Outcome::Single);
            }
            let wanted: Vec<Statistic> = self.statistics().map(|(_, statistic)| statistic).list();
            let begin = options.t_start.unwrap_or(ready.start.state.t);
            let last = kept(options, &wanted, begin, true);
            let (prepared, start) = (&ready.prepared, &ready.start.state);
            let steady = !ready.after && Variant { prepared, start, options: &last }.serves();
            // without phases and events, each output lies on the interpolant
            ready.grid = options.output_step.filter(|_| steady).map(|step| (begin, step));
            let last = if steady { last } else { kept(options, &wanted, begin, false) };
            ready.kept = AnyAnalysis::Dynamics(last);
        }
        Ok(ready)
    }

    /// The mechanism of a variant.
    pub fn subject<'a>(&'a self, ready: &'a Ready) -> Subject<'a> {
        Subject { definition: &self.definition, prepared: &ready.prepared }
    }

    /// Runs an analysis of a variant.
    pub fn run(
        &self,
        ready: &Ready,
        analysis: &AnyAnalysis,
        stop: &dyn Fn() -> bool,
    ) -> Result<Record, record::Outcome> {
        let (subject, start) = (self.subject(ready), &ready.start);
        let mut look = |_| if stop() { Flow::Stop } else { Flow::Continue };
        let observer = Observer { stop, ..Observer::new(&mut look) };
        let found = match ready.after {
            true => run_after(analysis, &subject, start, observer),
            false => analysis.run(&subject, start, observer),
        };
        found.map_err(|failed| failed.outcome)
    }

    /// The prescribed coordinates and rates of a variant; None if a variable is none of them.
    pub fn set_of(&self, start: &[(String, f64)]) -> Option<Vec<(String, Value)>> {
        let mut set = self.set.clone();
        for (name, x) in start {
            let (_, value) = set.iter_mut().find(|(known, _)| known == name)?;
            *value = Value::Number(*x);
        }
        Some(set)
    }

    /// The request for the assembly; None if an entry is faulty.
    pub fn request(&self, model: &Model, set: &[(String, Value)]) -> Option<Request> {
        let set = assemble::targets(model, "set", set).ok()?;
        let guess = assemble::targets(model, "guess", &self.guess).ok()?;
        Some(Request { set, guess, ..Request::default() })
    }
}
