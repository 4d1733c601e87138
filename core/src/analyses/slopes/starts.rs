//! The derivatives of the start of an analysis: an assembled state, or the end of the analysis before.

use super::reader::{Reader, StateSlopes, States};
use super::run_ends::{ending, refusal, state_at, steps};
use super::variables::parameters;
use crate::analyses::assemble::{self, set_slopes, StartSlopes};
use crate::analyses::dynamics::Options;
use crate::analyses::record::Record;
use crate::analyses::sweep::{PreparedModel, Ready, Sweep, VariantRow};
use crate::analyses::{chain, AnyAnalysis};
use crate::equations::sensitivity::{Slope, ABREAST};
use crate::math::Listed;
use crate::model::Model;
use std::sync::Arc;

/// The state at which an analysis starts, with its derivatives.
pub(super) struct Starts {
    /// q, v and z, in blocks of variables.
    pub states: Vec<StartSlopes>,
    /// The derivatives of the time of the start, for the variables of all blocks.
    pub late: Vec<f64>,
}

impl Starts {
    /// The states, if the time of the start does not move.
    pub fn in_time(self) -> Result<Vec<StartSlopes>, String> {
        match self.late.iter().all(|late| *late == 0.0) {
            true => Ok(self.states),
            false => Err("the time of its start moves".to_string()),
        }
    }

    /// A start at a given time.
    fn at_once(states: Vec<StartSlopes>) -> Self {
        let late = vec![0.0; ABREAST * states.len()];
        Self { states, late }
    }
}

impl Sweep {
    /// The derivatives of the start of an analysis.
    ///
    /// # Errors
    /// The reason for which it has none.
    pub(super) fn starts(
        &self,
        ready: &Ready,
        row: &VariantRow,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Starts, String> {
        let places = chain(&self.analyses, self.analyses.len() - 1);
        let [.., before, _] = places[..] else {
            return Ok(Starts::at_once(self.assembled(ready, row)?));
        };
        let analyses = self.analyses[..=before].to_vec();
        let before = Self { analyses, wanted: Vec::new(), ..self.clone() };
        let unfinished = || "the analysis before has no derivatives".to_string();
        let ready = before.ready(row, stop).map_err(|_| unfinished())?;
        let record = before.run(&ready, &with_interpolant(&ready.analysis), stop);
        let record = record.map_err(|_| unfinished())?;
        match &ready.analysis {
            AnyAnalysis::Equilibrium(options) => {
                if options.over.is_some() {
                    return Err("its start is the end of a path of equilibria".to_string());
                }
                let states = before.rest_starts((&ready, options, &record), row, stop)?;
                Ok(Starts::at_once(states))
            }
            _ => before.end_of_motion(&ready, record, row, stop),
        }
    }

    /// The end of a motion with its derivatives, at its time, which may have derivatives as well.
    fn end_of_motion(
        &self,
        ready: &Ready,
        record: Record,
        row: &VariantRow,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Starts, String> {
        let unknown = || "its start is the end of an analysis without motion".to_string();
        let Record { motion: Some(run), driven, .. } = record else { return Err(unknown()) };
        let is_driven = !matches!(ready.analysis, AnyAnalysis::Dynamics(_));
        if let Some(reason) = refusal(&run, is_driven) {
            return Err(reason);
        }
        let rests = driven.as_ref().is_some_and(|driven| driven.variable.rests);
        if rests {
            return Err(unknown());
        }
        let whole = driven.map(|driven| Arc::new(PreparedModel::new(driven.model)));
        let whole: &PreparedModel = whole.as_ref().unwrap_or(&ready.prepared);
        let model: &Model = whole.model();
        let states = |t: f64| state_at(whole, &run, t, rests);
        let course = match is_driven {
            true => StateSlopes::Driven(Self::blocks(model, row)?, &states as States<'_>),
            false => {
                StateSlopes::Dynamics(Box::new(self.along((model, &run), ready, row, stop)?))
            }
        };
        let ends = ending(model, &run, &ready.analysis)?;
        let mut reader =
            Reader::new(whole.model(), ends.into_iter().collect(), course, steps(&run));
        let (blocks, late) = reader.end(*run.trajectory.t.last().ok_or_else(unknown)?)?;
        let parts = |y: Vec<Slope>| -> StartSlopes {
            let [q, v, z, _] = model.layout.split(&y);
            [q.to_vec(), v.to_vec(), z.to_vec()]
        };
        Ok(Starts { states: blocks.into_iter().map(parts).list(), late })
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
            let numbers = parameters(own, names, &[]).ok_or_else(unread)?;
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
}

/// Forward dynamics with interpolants; other analyses as they are.
pub(super) fn with_interpolant(analysis: &AnyAnalysis) -> AnyAnalysis {
    match analysis {
        AnyAnalysis::Dynamics(options) => {
            AnyAnalysis::Dynamics(Options { dense_output: true, ..options.clone() })
        }
        other => other.clone(),
    }
}
