//! A run at its outputs and between them, with accelerations and multipliers if they are needed.

use crate::analyses::dynamics::{Accelerations, Prepared, Reason, Run, States};
use crate::analyses::measures::Measure;
use crate::integrate::Flow;
use crate::model::Model;
use std::cell::OnceCell;

/// The reason why a statistic is missing.
#[derive(Debug)]
pub enum Missing {
    /// A reported state has no accelerations.
    Failed(Reason),
    /// A single run of the case is needed.
    Single,
}

/// Rows of states at times, with accelerations and multipliers.
pub struct ReadRows {
    pub t: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    z: Vec<f64>,
    solved: Option<Accelerations>,
}

impl ReadRows {
    fn states(&self) -> States<'_> {
        States { t: &self.t, q: &self.q, v: &self.v, z: &self.z }
    }

    /// Rows of multipliers; empty if they were not computed.
    pub fn multipliers(&self) -> &[f64] {
        self.solved.as_ref().map_or(&[], |solved| &solved.lam)
    }

    /// Regularity of each position; empty if it was not computed.
    pub fn regularity(&self) -> &[f64] {
        self.solved.as_ref().map_or(&[], |solved| &solved.regularity)
    }
}

/// A run whose measures are evaluated.
pub struct Readings<'a> {
    prepared: &'a Prepared<&'a Model>,
    pub run: &'a Run,
    /// The measures, and whether the extreme values of each are required.
    pub measures: Vec<(Measure, bool)>,
    /// Accelerations and multipliers at the outputs.
    solved: OnceCell<Accelerations>,
}

impl<'a> Readings<'a> {
    pub fn new(
        prepared: &'a Prepared<&'a Model>,
        run: &'a Run,
        measures: Vec<(Measure, bool)>,
    ) -> Self {
        Self { prepared, run, measures, solved: OnceCell::new() }
    }

    pub fn model(&self) -> &'a Model {
        self.prepared.model()
    }

    /// The values at the outputs.
    pub fn outputs(&self, of: &Measure) -> Result<Vec<f64>, Missing> {
        let states = self.run.trajectory.states();
        let solved = match of.needs_solution(self.model()) {
            true => Some(self.solved()?),
            false => None,
        };
        let values = self.values_of(of, states, solved);
        match values.iter().all(|x| x.is_finite()) && !values.is_empty() {
            true => Ok(values),
            false => Err(Missing::Single),
        }
    }

    fn solved(&self) -> Result<&Accelerations, Missing> {
        if let Some(known) = self.solved.get() {
            return Ok(known);
        }
        let states = self.run.trajectory.states();
        let found = self.prepared.accelerations(states, self.run.passing, |_| Flow::Continue);
        let found = found.map_err(|failure| Missing::Failed(failure.reason))?;
        Ok(self.solved.get_or_init(|| found))
    }

    /// The motion at times between the outputs. None if the run has no interpolant or accelerations cannot be
    /// computed.
    pub fn at(&self, times: &[f64], solve: bool) -> Option<ReadRows> {
        let (layout, dense) = (&self.model().layout, self.run.dense.as_ref()?);
        let (y, width, n, n_z) = (dense.at(times), layout.n_y(), layout.n_q, layout.n_z);
        let room = |width: usize| Vec::with_capacity(width * times.len());
        let (t, mut q, mut v, mut z) = (times.to_vec(), room(n), room(n), room(n_z));
        for row in y.chunks_exact(width) {
            q.extend_from_slice(&row[..n]);
            v.extend_from_slice(&row[n..2 * n]);
            z.extend_from_slice(&row[2 * n..2 * n + n_z]);
        }
        let mut rows = ReadRows { t, q, v, z, solved: None };
        if let Some(projection) = self.run.projection {
            let [q, v] = self.prepared.project(rows.states(), projection).ok()?;
            (rows.q, rows.v) = (q, v);
        }
        if solve {
            let passing = self.run.projection.is_some();
            let found = self.prepared.accelerations(rows.states(), passing, |_| Flow::Continue);
            rows.solved = Some(found.ok()?);
        }
        Some(rows)
    }

    /// Whether there are at least as many instants as ends of steps.
    pub fn resolved(&self, instants: &[f64]) -> bool {
        self.run.dense.as_ref().is_some_and(|dense| instants.len() >= dense.t.len())
    }

    /// The values at states between the outputs. None if a value is not finite.
    pub fn values(&self, of: &Measure, rows: &ReadRows) -> Option<Vec<f64>> {
        let values = self.values_of(of, rows.states(), rows.solved.as_ref());
        values.iter().all(|x| x.is_finite()).then_some(values)
    }

    fn values_of(
        &self,
        of: &Measure,
        states: States<'_>,
        solved: Option<&Accelerations>,
    ) -> Vec<f64> {
        let (model, solved) = (self.model(), solved.map(|s| [&s.a[..], &s.lam[..]]));
        match self.prepared.wide_for(states.t.len()) {
            Some(wide) => of.values_over_lanes((model, wide), states, solved),
            None => of.values(model, states, solved),
        }
    }
}
