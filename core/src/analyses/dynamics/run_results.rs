//! The outcome of a run.

use super::passages::{HeldPieces, Passage};
use super::setting::Setting;
use super::stiffness_detection::MethodChoice;
use super::trajectory::{PiecewiseInterpolant, States, Trajectory};
use crate::integrate;
use crate::model::StateLayout;
use crate::stabilize::Projection;

/// Counts of an integration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Accepted steps.
    pub steps: usize,
    /// Rejected steps.
    pub rejected: usize,
    /// Evaluations of the equations of motion, without evaluations for the output.
    pub evaluations: usize,
    /// Tangents of the equations of motion; zero for explicit methods.
    pub jacobians: usize,
    /// Steps of Newton's iteration; zero for explicit methods.
    pub iterations: usize,
    /// Factorisations of the augmented matrix, including factorisations for the output, and of the matrices of
    /// Newton's iteration.
    pub factorisations: usize,
    /// Wall time, s.
    pub seconds: f64,
}

impl Statistics {
    /// Adds the counts of a stepper and its factorisations.
    pub(super) fn add(&mut self, counts: integrate::StepCounts, factorisations: usize) {
        self.steps += counts.steps;
        self.rejected += counts.rejected;
        self.evaluations += counts.evaluations;
        self.jacobians += counts.jacobians as usize;
        self.iterations += counts.iterations as usize;
        self.factorisations += factorisations;
    }
}

/// The times of an event, and the states there.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EventStates {
    /// The name of the event.
    pub name: String,
    /// A row for each time.
    pub states: Trajectory,
    /// Impulses of all multipliers, N·s or N·m·s; impulses of forces with modes follow the rows of the model. One row
    /// per time if a contact hits, otherwise empty.
    pub impulses: Vec<f64>,
}

/// A singular position that a run passed. Let σ be the smallest singular value of Φ_q relative to its rows. Near the
/// position, an error e of the constraints causes an error of about e/σ² in accelerations and multipliers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Passed {
    /// Time, s, accurate to a small fraction of the step across the position.
    pub t: f64,
    /// Names of the joints and drivers whose equations depend on each other there.
    pub names: Vec<String>,
    /// σ divided by the distance in time from the position, 1/s.
    pub slope: f64,
    /// Largest Φ after the step across the position, with lengths relative to the size of the mechanism.
    pub residual: f64,
}

/// Rounding errors of the time of a switch, relative to the times of a run.
pub(super) const ROUNDING: f64 = 1e-12;

/// The outcome of forward dynamics.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Run {
    /// Reported states.
    pub trajectory: Trajectory,
    /// The first row of each phase. The state at the end of a phase and the state at the start of the next phase have
    /// a row each, at the same time.
    pub phases: Vec<usize>,
    /// The parameters and drivers of each phase that differ from those of the model; empty without events.
    pub settings: Vec<Setting>,
    /// The states at which events occurred, in order for each event.
    pub events: Vec<EventStates>,
    /// Name of the event that stopped the run.
    pub stopped_by: Option<String>,
    /// Interpolants of all steps, if the options request them.
    pub dense: Option<PiecewiseInterpolant>,
    /// What happened where each phase begins; empty without interpolants or events.
    pub passages: Vec<Passage>,
    /// The pieces of switches along the steps; empty without interpolants or switches.
    pub held: Vec<HeldPieces>,
    /// Whether an implicit method took each step; empty without interpolants.
    pub implicit: Vec<bool>,
    /// Counts.
    pub statistics: Statistics,
    /// The largest kinetic energy and work at the ends of the steps, J.
    pub largest_energy: f64,
    /// The method that was chosen automatically.
    pub choice: Option<MethodChoice>,
    /// Whether t_end was reached; otherwise an event or the observer stopped the run.
    pub reached: bool,
    /// Whether the run passes singular positions, as runs with projection do.
    pub passing: bool,
    /// The singular positions that the run passed, in order.
    pub passed: Vec<Passed>,
    /// Balances beyond the limits of the run that belong to the chosen method: drift and loss of energy.
    pub doubts: Vec<String>,
    /// What was not examined.
    pub notes: Vec<String>,
    /// Projection of the states; None with another stabilization. See
    /// [`Prepared::project`](super::Prepared::project).
    pub projection: Option<Projection>,
}

impl Run {
    /// The index at which an event is listed: that of the first event with its name, because the parts of a contact have
    /// one name.
    pub(super) fn listed(&self, index: usize) -> usize {
        let Some(wanted) = self.events.get(index) else { return index };
        self.events.iter().position(|event| event.name == wanted.name).unwrap_or(index)
    }

    /// Adds a time of an event.
    pub(super) fn add_event(&mut self, layout: &StateLayout, index: usize, t: f64, y: &[f64]) {
        let index = self.listed(index);
        if let Some(event) = self.events.get_mut(index) {
            event.states.add(layout, t, y);
        }
    }

    /// Notes what happened where the next phase begins, if the run keeps interpolants.
    pub(super) fn note(&mut self, passage: Passage) {
        if self.dense.is_some() {
            self.passages.push(passage);
        }
    }

    /// The time from which a phase has the states between the outputs, s. Where a law jumps at its beginning, the phase
    /// before has no row at this time, and the rounding errors of this time belong to the new phase.
    pub fn begins(&self, phase: usize) -> Option<f64> {
        let (first, t) = (*self.phases.get(phase)?, &self.trajectory.t);
        let begins = *t.get(first)?;
        let jumps = first > 0 && t[first - 1] != begins;
        let rounding = ROUNDING * t[0].abs().max((t[t.len() - 1] - t[0]).abs());
        Some(if jumps { begins - rounding } else { begins })
    }

    /// The reported states of a phase.
    pub fn states_of(&self, phase: usize) -> States<'_> {
        let end = |k: usize| self.phases.get(k).copied().unwrap_or(self.trajectory.t.len());
        let (rows, count) = (end(phase)..end(phase + 1), self.trajectory.t.len().max(1));
        let part = |table: &[f64]| -> std::ops::Range<usize> {
            let width = table.len() / count;
            rows.start * width..rows.end * width
        };
        let Trajectory { t, q, v, z, .. } = &self.trajectory;
        States { t: &t[rows.clone()], q: &q[part(q)], v: &v[part(v)], z: &z[part(z)] }
    }
}
