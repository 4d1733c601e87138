//! Forward dynamics as an analysis.

use super::analysis::{Analysis, EventActions, Observer, Subject};
use super::outcome::{ErrorClass, Outcome};
use super::result::{Record, RunResult, Unfinished};
use super::start_state::StartState;
use crate::analyses::dynamics::{Options, Reason, Run};
use crate::math::Listed;
use crate::model::{Model, Problem};

/// Advice where a motion ended and no reason has an own one.
const LOOK: &str =
    "look at the solution so far; change the start, or add what decides the motion here";

impl Analysis for Options {
    const MOTION: bool = true;

    fn ends(&self, model: &Model, begin: Option<f64>) -> Result<Option<f64>, Vec<Problem>> {
        let fault = self.fault(model, begin);
        let backward = begin.and_then(|begin| self.backward(begin, &["t_end"]));
        let problems: Vec<Problem> = fault.into_iter().chain(backward).list();
        if problems.is_empty() {
            Ok(Some(self.t_end))
        } else {
            Err(problems)
        }
    }

    fn changes_parameters(&self) -> bool {
        !self.parameters.is_empty()
    }

    fn run(&self, subject: &Subject<'_>, start: &StartState, observer: Observer<'_>) -> RunResult {
        if let Some(problem) = self.backward(start.state.t, &["t_end"]) {
            return Err(vec![problem].into());
        }
        let Observer { look, acting, .. } = observer;
        let acts = acting.as_ref().map_or(&[][..], |acting| acting.events);
        let options = with_start(self, &start.released, acts);
        let options = options.as_ref().unwrap_or(self);
        let prepared = subject.prepared;
        let outcome = match acting {
            Some(EventActions { act, .. }) => {
                prepared.dynamics_with(&start.state, options, look, act)
            }
            None => prepared.dynamics(&start.state, options, look),
        };
        match outcome {
            Ok(run) => {
                let message = ended(&run);
                Ok(Record::of_motion(run, start, message))
            }
            Err(failure) => {
                let message = failure.reason.to_string();
                let record = Record::of_motion(failure.run, start, message);
                Err(Box::new(Unfinished { outcome: failure.reason.into(), record: Some(record) }))
            }
        }
    }
}

/// The options with the drivers that were released before, and with the events that act; None without any.
pub fn with_start(options: &Options, released: &[String], acts: &[String]) -> Option<Options> {
    if released.is_empty() && acts.is_empty() {
        return None;
    }
    let mut options = options.clone();
    let before = released.iter().filter(|name| !options.release.contains(name));
    options.release = before.chain(&options.release).cloned().list();
    for event in &mut options.events {
        event.acts = acts.contains(&event.name);
    }
    Some(options)
}

/// The reason that a run ended.
fn ended(run: &Run) -> String {
    match (&run.stopped_by, run.trajectory.t.last()) {
        (Some(name), Some(t)) => format!("the event {name} stopped the run at t = {t:.6} s"),
        _ => "t_end was reached".to_string(),
    }
}

impl From<Reason> for Outcome {
    fn from(reason: Reason) -> Self {
        let message = reason.to_string();
        match reason {
            Reason::Option { .. } => Self::new(ErrorClass::Model, message),
            Reason::Start { t, name, hint, .. } => {
                Self::new(ErrorClass::Assembly, message).name(name).at(t).hint(hint)
            }
            Reason::Redundant { t, name, hint, .. } => {
                Self::new(ErrorClass::Redundancy, message).name(name).at(t).hint(hint)
            }
            Reason::Law { t, name, hint, .. } => {
                Self::new(ErrorClass::Model, message).name(name).at(t).hint(hint)
            }
            Reason::Singular { t, name, .. } => {
                Self::new(ErrorClass::Singularity, message).name(name).at(t).hint(LOOK)
            }
            Reason::Integration { t, hint, .. } => {
                Self::new(ErrorClass::Integration, message).at(t).hint(hint)
            }
        }
    }
}

/// The reason that a result cannot be computed at a state.
pub fn missing(reason: Reason) -> Outcome {
    let hint = match reason {
        Reason::Redundant { hint, .. } | Reason::Start { hint, .. } => hint,
        Reason::Integration { .. } => "check forces and laws at this state",
        _ => "positions and velocities are there; look at times beside it, or change the mechanism",
    };
    Outcome::from(reason).hint(hint)
}
