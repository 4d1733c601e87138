//! The switches that depend on the time alone, found before a run, and the jumps of drivers and joint laws at them.

use super::failure::{Failure, Reason};
use crate::equations::kinematics::Motions;
use crate::equations::switches::law_values;
use crate::expression::{pieces_at, switch_times, Tape};
use crate::math::Jet;
use crate::model::{row_scales, Model, Owner};

/// Distance below which two switches count as one, relative to the largest time of a run.
const TOGETHER: f64 = 1e-14;
/// Largest jump of the law of a joint or driver, and of its rate: relative to the size of the mechanism, or in rad, and to
/// the value or rate.
const CONTINUOUS: f64 = 1e-8;

/// The switches of a run that depend on the time alone.
#[derive(Debug, Default)]
pub(super) struct Schedule {
    /// The pieces at the start; NaN for switches that depend on the state.
    pub start: Vec<f64>,
    /// The times in the order of the run, each with the switches that change and their new pieces.
    pub times: Vec<(f64, Vec<(usize, f64)>)>,
}

impl Schedule {
    /// Finds all switches between `t0` and `t_end`.
    ///
    /// # Errors
    /// More switches than a run can step to; a joint or driver with a law that jumps at one.
    pub fn new(model: &Model, (t0, t_end): (f64, f64)) -> Result<Self, Box<Failure>> {
        if model.switches.is_empty() {
            return Ok(Self::default());
        }
        let mut tapes: Vec<Tape> = Vec::new();
        let mut keep = |tape: &Tape| {
            if !tape.switch_range().is_empty() {
                tapes.push(tape.clone());
            }
        };
        model.constraints.iter().filter_map(|item| item.law.as_ref()).for_each(|law| {
            law.map(&mut keep);
        });
        model.forces.iter().filter_map(|item| item.law.as_ref()).for_each(|law| {
            law.map(&mut keep);
        });
        let ends = [t0.min(t_end), t0.max(t_end)];
        let mut times = Vec::new();
        for tape in &tapes {
            let found = switch_times(tape, &model.parameters, ends, &mut times);
            found.map_err(|_| too_many(model, tape, t0))?;
        }
        times.sort_by(f64::total_cmp);
        let apart = TOGETHER * ends[0].abs().max(ends[1].abs());
        times.dedup_by(|b, a| *b - *a <= apart);
        times.retain(|t| t - ends[0] > apart && ends[1] - t > apart);
        if t_end < t0 {
            times.reverse();
        }
        let schedule = Self::of(model, &tapes, &times, [t0, t_end]);
        schedule.check(model)?;
        Ok(schedule)
    }

    /// The changes of pieces at the times.
    fn of(model: &Model, tapes: &[Tape], times: &[f64], [t0, t_end]: [f64; 2]) -> Self {
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
        let mut schedule = Self { start: start.clone(), times: Vec::new() };
        let mut now = start;
        for (k, t) in times.iter().enumerate() {
            let next = pieces_between(*t, end_of(k + 1));
            let changes = (0..now.len()).filter(|s| now[*s].to_bits() != next[*s].to_bits());
            let changes: Vec<_> = changes.map(|s| (s, next[s])).collect();
            if !changes.is_empty() {
                schedule.times.push((*t, changes));
            }
            now = next;
        }
        schedule
    }

    /// Refuses a law of a joint or driver that jumps; a law that depends on the state too is checked in the run.
    fn check(&self, model: &Model) -> Result<(), Box<Failure>> {
        let mut motions = Motions::new(&model.layout);
        motions.pieces = self.start.clone();
        for (t, changes) in &self.times {
            let before = motions.pieces.clone();
            changes.iter().for_each(|(switch, piece)| motions.pieces[*switch] = *piece);
            for k in changed_constraints(model, changes) {
                let stateless = |tape: &Tape| !tape.uses_state();
                if let Some(jump) = Jump::of(model, k, &mut motions, *t, &before, &stateless) {
                    return Err(jump.refused(model, *t));
                }
            }
        }
        Ok(())
    }
}

/// The joints and drivers to which switches belong, each once.
pub(super) fn changed_constraints(model: &Model, changes: &[(usize, f64)]) -> Vec<usize> {
    let owners = changes.iter().filter_map(|(switch, _)| match model.switches[*switch].owner {
        Owner::Constraint(k) => Some(k),
        Owner::Force(_) => None,
    });
    let mut all: Vec<usize> = owners.collect();
    all.dedup();
    all
}

/// A jump of the law of a joint or driver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Jump {
    pub constraint: usize,
    /// Whether the value jumps, not the rate.
    pub position: bool,
    /// The value or rate before and after.
    pub values: [f64; 2],
}

impl Jump {
    /// The jump of a law of constraint `k` from the pieces `before` to those of `motions`, if it is not continuous with
    /// its rate. `which` selects formulas.
    pub fn of(
        model: &Model,
        k: usize,
        motions: &mut Motions,
        t: f64,
        before: &[f64],
        which: &dyn Fn(&Tape) -> bool,
    ) -> Option<Self> {
        let new = law_values(model, k, motions, t);
        let after = std::mem::replace(&mut motions.pieces, before.to_vec());
        let old = law_values(model, k, motions, t);
        motions.pieces = after;
        let mut selected = Vec::new();
        model.constraints[k].law.as_ref()?.map(&mut |tape| selected.push(which(tape)));
        let scale = row_scales(model)[model.layout.constraints[k].rows.start];
        let pairs = old.into_iter().zip(new).zip(selected);
        pairs.filter(|(_, selected)| *selected).find_map(|((old, new), _)| {
            let Jet { value: a, rate: va, .. } = old;
            let Jet { value: b, rate: vb, .. } = new;
            let differ =
                |a: f64, b: f64| (b - a).abs() > CONTINUOUS * a.abs().max(b.abs()).max(scale);
            let (position, velocity) = (differ(a, b), differ(va, vb));
            let values = if position { [a, b] } else { [va, vb] };
            (position || velocity).then_some(Self { constraint: k, position, values })
        })
    }

    /// In the words of a message.
    pub fn describe(self, model: &Model, t: f64) -> String {
        let item = &model.constraints[self.constraint];
        let what = item.group.singular();
        let (of, per) = if self.position { ("", "") } else { ("rate of the ", "/s") };
        let unit = item.equations[0].unit;
        let [before, after] = self.values;
        format!(
            "the {of}law of {what} {} jumps from {before:.6} to {after:.6} {unit}{per} at t = {t:.6} s; a body with \
             mass cannot follow",
            item.name
        )
    }

    fn refused(self, model: &Model, t: f64) -> Box<Failure> {
        let name = model.constraints[self.constraint].name.clone();
        Reason::Law { t, name, message: self.describe(model, t), hint: SMOOTH }.into()
    }
}

/// The remedy for a law that jumps.
pub(super) const SMOOTH: &str =
    "join the pieces with equal values and equal rates, for instance by step5 or another \
                                 motion law";

fn too_many(model: &Model, tape: &Tape, t0: f64) -> Box<Failure> {
    let owner = model.switches[tape.switch_range().start].owner;
    let name = owner_name(model, owner).to_string();
    let message = format!("a law of {name} has more than a million switches in time");
    let hint = "the run would step to each of them: use a slower law, or a smooth mean value";
    Reason::Law { t: t0, name, message, hint }.into()
}

/// The name of the element to which a switch belongs.
pub(super) fn owner_name(model: &Model, owner: Owner) -> &str {
    match owner {
        Owner::Constraint(k) => &model.constraints[k].name,
        Owner::Force(k) => &model.forces[k].name,
    }
}
