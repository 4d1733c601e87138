//! A run at its outputs and on its interpolant, with accelerations and multipliers as far as they are needed.

use crate::analyses::dynamics::{Accelerations, Prepared, Reason, Run, States};
use crate::analyses::measures::Measure;
use crate::analyses::statistics::{changes, instants, row_norms, Maxima};
use crate::integrate::Flow;
use crate::model::Model;
use std::cell::OnceCell;

/// The reason why a statistic is missing.
#[derive(Debug)]
pub enum Missing {
    /// A reported state has no accelerations.
    Failed(Reason),
    /// A single run decides.
    Single,
}

/// Rows of states at times, with accelerations and multipliers.
pub struct Rows {
    pub t: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    z: Vec<f64>,
    solved: Option<Accelerations>,
}

impl Rows {
    fn states(&self) -> States<'_> {
        States { t: &self.t, q: &self.q, v: &self.v, z: &self.z }
    }
}

/// The motion of a run at close instants, and the singular positions in it.
pub struct Fine {
    pub rows: Rows,
    /// The maxima of all multipliers together, beside which values mean nothing.
    pub near: Maxima,
}

/// A run that is read.
pub struct Readings<'a> {
    prepared: &'a Prepared<&'a Model>,
    pub run: &'a Run,
    /// Accelerations and multipliers at the outputs.
    solved: OnceCell<Accelerations>,
    /// None without an interpolant.
    fine: OnceCell<Option<Fine>>,
}

impl<'a> Readings<'a> {
    pub fn new(prepared: &'a Prepared<&'a Model>, run: &'a Run) -> Self {
        Self { prepared, run, solved: OnceCell::new(), fine: OnceCell::new() }
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
        let values = of.values(self.model(), states, solved.map(|s| [&s.a[..], &s.lam[..]]));
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

    /// The motion at times between the outputs; None where it has none.
    pub fn at(&self, times: &[f64], solve: bool) -> Option<Rows> {
        let (layout, dense) = (&self.model().layout, self.run.dense.as_ref()?);
        let (y, width, n, n_z) = (dense.at(times), layout.n_y(), layout.n_q, layout.n_z);
        let part = |from: usize, count: usize| -> Vec<f64> {
            y.chunks_exact(width).flat_map(|row| &row[from..from + count]).copied().collect()
        };
        let (t, q, v, z) = (times.to_vec(), part(0, n), part(n, n), part(2 * n, n_z));
        let mut rows = Rows { t, q, v, z, solved: None };
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

    /// The motion at close instants.
    pub fn fine(&self) -> Result<Option<&Fine>, Missing> {
        if let Some(known) = self.fine.get() {
            return Ok(known.as_ref());
        }
        let t = &self.run.trajectory.t;
        let found = match &self.run.dense {
            Some(dense) if t.len() > 1 => {
                let layout = &self.model().layout;
                let numbers = 4 * layout.n_q + layout.n_rows + 1;
                let times = instants(&dense.t, t, numbers);
                // without multipliers somewhere a single run uses its outputs
                let rows = self.at(&times, true).ok_or(Missing::Single)?;
                let near = self.singular(&rows);
                Some(Fine { rows, near })
            }
            _ => None,
        };
        Ok(self.fine.get_or_init(|| found).as_ref())
    }

    /// The maxima of all multipliers together, which find the singular positions of a run.
    fn singular(&self, fine: &Rows) -> Maxima {
        let norms = |rows: &Rows| {
            let count = rows.t.len();
            let lam = rows.solved.as_ref().map_or(&[][..], |solved| &solved.lam);
            row_norms(lam, lam.len() / count.max(1), count)
        };
        let size = norms(fine);
        if !changes(&size) {
            return Maxima::default();
        }
        let mut read = |t: &[f64]| self.at(t, true).map(|rows| norms(&rows));
        Maxima::search((&fine.t, &size), (&[], &[]), self.resolved(fine), &mut read)
    }

    /// Whether each step has an instant.
    pub fn resolved(&self, fine: &Rows) -> bool {
        self.run.dense.as_ref().is_some_and(|dense| fine.t.len() >= dense.t.len())
    }

    pub fn values(&self, of: &Measure, rows: &Rows) -> Option<Vec<f64>> {
        let solved = rows.solved.as_ref().map(|s| [&s.a[..], &s.lam[..]]);
        let values = of.values(self.model(), rows.states(), solved);
        values.iter().all(|x| x.is_finite()).then_some(values)
    }
}
