//! The list of configurations as an analysis.

use super::options::Options;
use super::{configurations, Failure};
use crate::analyses::assemble::Request;
use crate::analyses::record::{
    Analysis, ErrorClass, Fact, NamedNumber, NumberList, Observer, Outcome, Record, RunResult,
    StartState, Subject,
};
use crate::analyses::State;
use crate::math::Listed;
use serde_json::{json, Value};

impl Analysis for Options {
    const NUMBERS: &'static [NamedNumber] = &[
        NamedNumber::new("count", "", |of, _| NumberList::found(&of.findings["reports"])),
        NamedNumber::finding("complete", ""),
    ];

    fn run(&self, subject: &Subject<'_>, start: &StartState, observer: Observer<'_>) -> RunResult {
        let (model, t) = (subject.released(start), start.state.t);
        let request = Request { set: self.set.clone(), t, ..Request::default() };
        let found = configurations(&model, &request, self.limit, observer.stop)?;
        let rows = |part: fn(&State) -> &Vec<f64>| -> Vec<f64> {
            found.states.iter().flat_map(|(state, _)| part(state).iter().copied()).list()
        };
        let reports: Vec<_> = found.states.iter().map(|(_, report)| report.as_json()).list();
        let findings = json!({
            "complete": found.complete, "left_out": found.left_out, "reports": reports,
        });
        let count = found.states.len();
        let (n_q, n_z) = (model.layout.n_q, model.layout.n_z);
        let complete = match found.complete {
            true => "yes",
            false => "not proven: there may be others",
        };
        let mut facts = vec![Fact::new("configurations", count), Fact::new("complete", complete)];
        if found.left_out > 0 {
            facts.push(Fact::new("left out, because a freedom is left there", found.left_out));
        }
        let named = |(k, (state, _)): (usize, &(State, _))| {
            (Fact::new(format!("configuration {}", k + 1), Value::Null), state.clone())
        };
        let positions: Vec<_> = found.states.iter().enumerate().map(named).list();
        Ok(Record::new(findings, start.clone())
            .facts(facts)
            .positions(positions)
            .with("q", [count, n_q], rows(|state| &state.q))
            .with("v", [count, n_q], rows(|state| &state.v))
            .with("z", [count, n_z], rows(|state| &state.z)))
    }
}

impl From<Failure> for Outcome {
    fn from(failure: Failure) -> Self {
        match failure {
            Failure::Assembly(failure) => (*failure).into(),
            Failure::Free { degrees_of_freedom: n } => {
                let (plural, verb) = if n == 1 { ("", "is") } else { ("s", "are") };
                let message = format!(
                    "{n} degree{plural} of freedom {verb} left, so that there are infinitely many \
                     configurations"
                );
                Self::new(ErrorClass::Model, message).hint(
                    "set a coordinate for each, as set = { \"crank.angle\": 1 }, or add drivers",
                )
            }
        }
    }
}
