//! The switches that depend on time alone, found before a run, and the jumps of drivers and joint laws at these
//! switches.

use super::failure::{Failure, Reason};
use super::law_jump::{LawJump, SMOOTH};
use super::sampling;
use crate::equations::kinematics::Motions;
use crate::expression::{pieces_at, switch_times, Tape};
use crate::math::Listed;
use crate::model::{Model, SwitchOwner};

/// Switches closer than this distance count as one switch, relative to the largest time of a run.
const TOGETHER: f64 = 1e-14;
/// The switches of a run that depend on time alone.
#[derive(Debug, Default)]
pub(super) struct Schedule {
    /// The pieces at the start; NaN for switches that depend on the state.
    pub start: Vec<f64>,
    /// The times in the order of the run, each with the switches that change and their new pieces.
    pub times: Vec<(f64, Vec<(usize, f64)>)>,
    /// The times at which sampled laws are computed.
    pub samples: Vec<f64>,
}

impl Schedule {
    /// Finds all switches between `t0` and `t_end`.
    ///
    /// # Errors
    /// More switches than a run can step to; a joint or driver with a law that jumps at a switch.
    pub fn new(model: &Model, (t0, t_end): (f64, f64)) -> Result<Self, Box<Failure>> {
        let samples = sampling::times(model, (t0, t_end))?;
        if model.switches.is_empty() {
            let times = samples.iter().map(|t| (*t, Vec::new())).list();
            return Ok(Self { times, samples, ..Self::default() });
        }
        let mut tapes: Vec<Tape> = Vec::new();
        let mut keep = |tape: &Tape| {
            if !tape.switch_range().is_empty() {
                tapes.push(tape.clone());
            }
        };
        model.constraints.iter().filter_map(|item| item.law.as_ref()).for_each(|law| {
            law.visit(&mut keep);
        });
        model.forces.iter().filter_map(|item| item.law.as_ref()).for_each(|law| {
            law.visit(&mut keep);
        });
        let ends = [t0.min(t_end), t0.max(t_end)];
        let mut times = Vec::new();
        for tape in &tapes {
            let found = switch_times(tape, &model.parameters, ends, &mut times);
            found.map_err(|_| too_many(model, tape, t0))?;
        }
        let apart = TOGETHER * ends[0].abs().max(ends[1].abs());
        times.retain(|t| samples.iter().all(|sample| (t - sample).abs() > apart));
        times.sort_by(f64::total_cmp);
        times.dedup_by(|b, a| *b - *a <= apart);
        times.retain(|t| t - ends[0] > apart && ends[1] - t > apart);
        times.extend(&samples);
        times.sort_by(f64::total_cmp);
        if t_end < t0 {
            times.reverse();
        }
        let schedule = Self::of(model, &tapes, (&times, samples), [t0, t_end]);
        schedule.check(model)?;
        Ok(schedule)
    }

    /// The changes of pieces at the times.
    fn of(
        model: &Model,
        tapes: &[Tape],
        (times, samples): (&[f64], Vec<f64>),
        [t0, t_end]: [f64; 2],
    ) -> Self {
        let pieces_between = |a: f64, b: f64| {
            let mut pieces = vec![f64::NAN; model.switches.len()];
            for tape in tapes {
                let own = pieces_at(tape, &model.parameters, a + 0.5 * (b - a));
                pieces[tape.switch_range()].copy_from_slice(&own);
            }
            pieces
        };
        let end_of = |k: usize| times.get(k).copied().unwrap_or(t_end);
        let start = pieces_between(t0, end_of(0));
        let mut schedule = Self { start: start.clone(), times: Vec::new(), samples };
        let mut now = start;
        for (k, t) in times.iter().enumerate() {
            let next = pieces_between(*t, end_of(k + 1));
            let changes = (0..now.len()).filter(|s| now[*s].to_bits() != next[*s].to_bits());
            let changes: Vec<_> = changes.map(|s| (s, next[s])).list();
            if !changes.is_empty() || schedule.samples_at(*t) {
                schedule.times.push((*t, changes));
            }
            now = next;
        }
        schedule
    }

    /// Keeps only the times for which `keeps` is true.
    pub fn keep(&mut self, keeps: impl Fn(f64) -> bool) {
        self.times.retain(|(t, _)| keeps(*t));
        self.samples.retain(|t| keeps(*t));
    }

    /// Whether sampled laws are computed at `t`.
    pub fn samples_at(&self, t: f64) -> bool {
        self.samples.binary_search_by(|sample| sample.total_cmp(&t)).is_ok()
    }

    /// Refuses a law of a joint or driver that jumps. A law that also depends on the state is checked during the run.
    fn check(&self, model: &Model) -> Result<(), Box<Failure>> {
        let mut motions = Motions::new(&model.layout);
        motions.pieces = self.start.clone();
        for (t, changes) in &self.times {
            let before = motions.pieces.clone();
            changes.iter().for_each(|(switch, piece)| motions.pieces[*switch] = *piece);
            for k in changed_constraints(model, changes) {
                let stateless = |tape: &Tape| !tape.uses_state();
                if let Some(jump) = LawJump::of(model, k, &mut motions, *t, &before, &stateless) {
                    let name = model.constraints[jump.constraint].name.clone();
                    let message = jump.describe(model, *t);
                    return Err(Reason::Law { t: *t, name, message, hint: SMOOTH }.into());
                }
            }
        }
        Ok(())
    }
}

/// The joints and drivers to which switches belong, each once.
pub(super) fn changed_constraints(model: &Model, changes: &[(usize, f64)]) -> Vec<usize> {
    let owners = changes.iter().filter_map(|(switch, _)| match model.switches[*switch].owner {
        SwitchOwner::Constraint(k) => Some(k),
        SwitchOwner::Force(_) => None,
    });
    let mut all: Vec<usize> = owners.list();
    all.dedup();
    all
}

fn too_many(model: &Model, tape: &Tape, t0: f64) -> Box<Failure> {
    let owner = model.switches[tape.switch_range().start].owner;
    let name = model.owner_name(owner).to_string();
    let message = format!("a law of {name} has more than a million switches in time");
    let hint = "the run would step to each of them: use a slower law, or a smooth mean value";
    Reason::Law { t: t0, name, message, hint }.into()
}
