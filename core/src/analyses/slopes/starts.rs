//! The derivatives of the start of an analysis: an assembled state, or the end of the analysis before.

use super::reader::Reader;
use super::run_ends::{ending, state_at, steps};
use super::variables::parameters;
use super::variant::ReadyVariant;
use crate::analyses::assemble::{self, set_slopes, StartSlopes};
use crate::analyses::dynamics::Options;
use crate::analyses::record::Record;
use crate::analyses::sweep::Sweep;
use crate::analyses::{chain, AnyAnalysis};
use crate::equations::sensitivity::{Slope, ABREAST};
use crate::math::Listed;

/// The state at which an analysis starts, with its derivatives.
pub(super) struct Starts {
    /// q, v and z, in blocks of variables.
    pub states: Vec<StartSlopes>,
    /// The derivatives of the time of the start, for the variables of all blocks.
    pub late: Vec<f64>,
}

impl Starts {
    /// The states, if the time of the start does not move with one of `count` variables.
    pub fn in_time(self, count: usize) -> Result<Vec<StartSlopes>, String> {
        match self.late.iter().take(count).all(|late| *late == 0.0) {
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

impl ReadyVariant<'_> {
    /// The derivatives of the start of the analysis.
    ///
    /// # Errors
    /// The reason for which it has none.
    pub fn starts(&self) -> Result<Starts, String> {
        let analyses = &self.sweep.analyses;
        let places = chain(analyses, analyses.len() - 1);
        let [.., before, _] = places[..] else {
            return Ok(Starts::at_once(self.assembled()?));
        };
        let analyses = analyses[..=before].to_vec();
        let sweep = Sweep { analyses, wanted: Vec::new(), ..self.sweep.clone() };
        let unfinished = || "the analysis before has no derivatives".to_string();
        let ready = sweep.ready(self.row, self.stop).map_err(|_| unfinished())?;
        let before = ReadyVariant { sweep: &sweep, ready: &ready, ..*self };
        let record = before.run(&with_interpolant(&ready.analysis)).map_err(|_| unfinished())?;
        match &ready.analysis {
            AnyAnalysis::Equilibrium(options) => {
                if options.over.is_some() {
                    return Err("its start is the end of a path of equilibria".to_string());
                }
                Ok(Starts::at_once(before.rest_starts(options, &record)?))
            }
            _ => before.end_of_motion(record),
        }
    }

    /// The end of a motion with its derivatives, at its time, which may have derivatives as well.
    fn end_of_motion(&self, record: Record) -> Result<Starts, String> {
        let unknown = || "its start is the end of an analysis without motion".to_string();
        let Record { motion: Some(run), driven, .. } = record else { return Err(unknown()) };
        let (whole, rests) = &self.ready.whole(driven);
        let model = whole.model();
        let states = |t: f64| state_at(whole, &run, t, *rests);
        let course = self.course((model, &run), &states)?;
        if *rests {
            return Err(unknown());
        }
        let ends = ending(model, &run, &self.ready.analysis)?;
        let mut reader = Reader::new(model, ends.into_iter().collect(), course, steps(&run));
        let (blocks, late) = reader.end(*run.trajectory.t.last().ok_or_else(unknown)?)?;
        let parts = |y: Vec<Slope>| -> StartSlopes {
            let [q, v, z, _] = model.layout.split(&y);
            [q.to_vec(), v.to_vec(), z.to_vec()]
        };
        Ok(Starts { states: blocks.into_iter().map(parts).list(), late })
    }

    /// The derivatives of an assembled start, in blocks of variables.
    fn assembled(&self) -> Result<Vec<StartSlopes>, String> {
        let unread = || "the start cannot be read".to_string();
        let Self { sweep, ready, row, .. } = self;
        let (model, start) = (ready.prepared.model(), &ready.start.state);
        let set = sweep.set_of(&row.1).ok_or_else(unread)?;
        let mut request = sweep.request(model, &set).ok_or_else(unread)?;
        request.t = start.t;
        let of = |names: &Vec<String>| -> Result<StartSlopes, String> {
            let numbers = parameters(model, names, &[]).ok_or_else(unread)?;
            let values = set_slopes(model, ("set", &set), &numbers, names).ok_or_else(unread)?;
            let guess = set_slopes(model, ("guess", &sweep.guess), &numbers, &[]);
            let guess = guess.ok_or_else(unread)?;
            let varies = guess.iter().position(|x| x.slope.iter().any(|slope| *slope != 0.0));
            if let Some(name) = varies.map(|k| &sweep.guess[k].0) {
                return Err(format!("the guess of {name} depends on it; prescribe {name} in set"));
            }
            assemble::slopes(model, &request, (&numbers, &values), start)
        };
        self.names().iter().map(of).collect()
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

/// A start as one row: q, v and z.
pub(super) fn joined(start: StartSlopes) -> Vec<Slope> {
    let [q, v, z] = start;
    q.into_iter().chain(v).chain(z).list()
}
