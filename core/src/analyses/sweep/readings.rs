//! A run at its outputs and between them, each state with the model of its phase.

use crate::analyses::dynamics::{Accelerations, Prepared, Run, States};
use crate::analyses::measures::Measure;
use crate::analyses::statistics::row_norms;
use crate::integrate::Flow;
use crate::math::{Listed, ShortArray};
use crate::model::Model;
use std::cell::OnceCell;
use std::sync::Arc;

/// The reason why a statistic is missing.
#[derive(Debug)]
pub enum Missing {
    /// A number has no value, for this reason.
    Failed(String),
    /// A single run of the case is needed.
    Single,
}

/// A model that is prepared for runs.
pub type PreparedModel = Prepared<Arc<Model>>;

/// What is read at times.
#[derive(Default)]
pub struct ReadRows {
    /// The values of each requested measure.
    pub values: Vec<Vec<f64>>,
    /// The norm of all multipliers and the regularity at each time; empty if they were not computed.
    pub sizes: Vec<f64>,
    pub regularity: Vec<f64>,
}

/// A phase of a run.
struct ReadPhase {
    prepared: Arc<PreparedModel>,
    /// Its first time, s.
    begins: f64,
    /// The measures, with quantities of its model.
    measures: Vec<Measure>,
}

/// A run whose measures are evaluated.
pub struct Readings<'a> {
    phases: Vec<ReadPhase>,
    pub run: &'a Run,
    /// Whether the largest value, the least value and the integrals of each measure are required.
    pub wanted: Vec<[bool; 3]>,
    /// The first output and the time between outputs, if the run has left them out.
    grid: Option<(f64, f64)>,
    /// Whether the mechanism is at rest at each value of the quantity that replaces the time.
    rests: bool,
    /// Accelerations and multipliers at the outputs of each phase.
    solved: OnceCell<Vec<Accelerations>>,
}

impl<'a> Readings<'a> {
    /// The readings of a run of a model, `rests` if the mechanism is at rest at each value over which it runs.
    ///
    /// # Errors
    /// [`Missing::Single`] if drivers hold friction at rest in a phase, or if contacts and friction share their loads,
    /// because such forces have a mark.
    pub fn new(
        whole: &Arc<PreparedModel>,
        run: &'a Run,
        rests: bool,
        grid: Option<(f64, f64)>,
    ) -> Result<Self, Missing> {
        let mut phases = Vec::new();
        for k in 0..run.phases.len() {
            let prepared = match run.settings.get(k).filter(|setting| !setting.is_plain()) {
                None => Arc::clone(whole),
                Some(setting) if setting.modes.iter().any(|of| of.mode.depends()) => {
                    return Err(Missing::Single)
                }
                Some(setting) => {
                    let own = setting.model(whole.model()).map_err(|_| Missing::Single)?;
                    Arc::new(Prepared::new(Arc::new(own)))
                }
            };
            let begins = run.begins(k).ok_or(Missing::Single)?;
            phases.push(ReadPhase { prepared, begins, measures: Vec::new() });
        }
        Ok(Self { phases, run, wanted: Vec::new(), grid, rests, solved: OnceCell::new() })
    }

    /// The same readings with the accelerations and multipliers at the outputs, if they are known.
    pub fn solved_by(self, known: Option<Accelerations>) -> Self {
        match known.filter(|_| self.phases.len() == 1) {
            Some(known) => Self { solved: vec![known].into(), ..self },
            None => self,
        }
    }

    /// The readings of measures, and what is required of each.
    pub fn of(mut self, measures: Vec<Measure>, wanted: Vec<[bool; 3]>) -> Self {
        for phase in &mut self.phases {
            let own = phase.prepared.model();
            phase.measures = measures.iter().map(|of| of.in_phase(own)).list();
        }
        Self { wanted, ..self }
    }

    /// A measure with the quantities of the first phase.
    pub fn measure(&self, measure: usize) -> &Measure {
        &self.phases[0].measures[measure]
    }

    /// The model at the start.
    pub fn model(&self) -> &Model {
        self.phases[0].prepared.model()
    }

    /// Whether a measure needs accelerations or multipliers.
    pub fn solves(&self, measure: usize) -> bool {
        self.phases.iter().any(|of| of.measures[measure].needs_solution(of.prepared.model()))
    }

    /// The values of a measure at the outputs.
    pub fn outputs(&self, measure: usize) -> Result<Vec<f64>, Missing> {
        let solved = if self.solves(measure) { Some(self.solved()?) } else { None };
        let mut values = Vec::with_capacity(self.run.trajectory.t.len());
        for (k, phase) in self.phases.iter().enumerate() {
            let solved = solved.map(|solved| &solved[k]);
            values.extend(phase.values(measure, self.run.states_of(k), solved));
        }
        match values.iter().all(|x| x.is_finite()) && !values.is_empty() {
            true => Ok(values),
            false => Err(Missing::Single),
        }
    }

    fn solved(&self) -> Result<&[Accelerations], Missing> {
        if let Some(known) = self.solved.get() {
            return Ok(known);
        }
        let of = |(k, phase): (usize, &ReadPhase)| {
            let states = self.run.states_of(k);
            phase.prepared.accelerations(states, self.run.passing, |_| Flow::Continue)
        };
        let found = self.phases.iter().enumerate().map(of).collect::<Result<Vec<_>, _>>();
        let found = found.map_err(|failure| Missing::Failed(failure.reason.to_string()))?;
        Ok(self.solved.get_or_init(|| found))
    }

    /// The motion at times between the outputs, with the values of some measures. At the time of a change, the phase
    /// after it counts. None if the run has no interpolant or a value cannot be computed.
    pub fn at(&self, times: &[f64], solve: bool, measures: &[usize]) -> Option<ReadRows> {
        let phase_of = |t: f64| {
            let after = self.phases.partition_point(|phase| phase.begins <= t);
            after.saturating_sub(1)
        };
        let of_row: Vec<usize> = times.iter().map(|t| phase_of(*t)).list();
        let first = of_row.first().copied().unwrap_or(0);
        if of_row.iter().all(|k| *k == first) {
            return self.in_phase(first, times, solve, measures);
        }
        let mut found = ReadRows {
            values: measures.iter().map(|_| vec![0.0; times.len()]).list(),
            sizes: vec![0.0; times.len()],
            regularity: vec![0.0; times.len()],
        };
        for k in 0..self.phases.len() {
            let rows: Vec<usize> = (0..times.len()).filter(|row| of_row[*row] == k).list();
            let own: Vec<f64> = rows.iter().map(|row| times[*row]).list();
            let part = self.in_phase(k, &own, solve, measures)?;
            let spread = |to: &mut Vec<f64>, from: &[f64]| {
                rows.iter().zip(from).for_each(|(row, x)| to[*row] = *x);
            };
            found.values.iter_mut().zip(&part.values).for_each(|(to, from)| spread(to, from));
            spread(&mut found.sizes, &part.sizes);
            spread(&mut found.regularity, &part.regularity);
        }
        Some(found)
    }

    fn in_phase(
        &self,
        phase: usize,
        times: &[f64],
        solve: bool,
        measures: &[usize],
    ) -> Option<ReadRows> {
        let phase = &self.phases[phase];
        let (layout, dense) = (&phase.prepared.model().layout, self.run.dense.as_ref()?);
        let (y, width, n, n_z) = (dense.at(times), layout.n_y(), layout.n_q, layout.n_z);
        let room = |width: usize| Vec::with_capacity(width * times.len());
        let (mut q, mut v, mut z) = (room(n), room(n), room(n_z));
        for row in y.chunks_exact(width) {
            q.extend_from_slice(&row[..n]);
            v.extend_from_slice(&row[n..2 * n]);
            z.extend_from_slice(&row[2 * n..2 * n + n_z]);
        }
        if let Some(projection) = self.run.projection {
            let states = States { t: times, q: &q, v: &v, z: &z };
            [q, v] = phase.prepared.project(states, projection).ok()?;
            if self.rests {
                v.fill(0.0);
            }
        }
        let (states, mut rows) = (States { t: times, q: &q, v: &v, z: &z }, ReadRows::default());
        let passing = self.run.projection.is_some();
        let solved =
            solve.then(|| phase.prepared.accelerations(states, passing, |_| Flow::Continue));
        let solved = solved.transpose().ok()?;
        rows.values = measures.iter().map(|k| phase.values(*k, states, solved.as_ref())).list();
        if let Some(Accelerations { lam, regularity, .. }) = solved {
            rows.sizes = row_norms(&lam, lam.len() / times.len().max(1), times.len());
            rows.regularity = regularity;
        }
        rows.values.iter().flatten().all(|x| x.is_finite()).then_some(rows)
    }

    /// The outputs beside a time that the run has left out.
    pub fn left_out(&self, t: f64) -> Vec<f64> {
        let (Some((first, step)), Some(last)) = (self.grid, self.run.trajectory.t.last()) else {
            return Vec::new();
        };
        let way = (last - first).signum() * step;
        let before = ((t - first) / way).floor();
        let beside = [before, before + 1.0].each(|k| first + k * way);
        beside.into_iter().filter(|t| (first - t) * (last - t) < 0.0).list()
    }

    /// Whether the run has one phase, so that its motion is smooth.
    pub fn is_smooth(&self) -> bool {
        self.phases.len() == 1
    }

    /// Whether there are at least as many instants as ends of steps.
    pub fn resolved(&self, instants: &[f64]) -> bool {
        self.run.dense.as_ref().is_some_and(|dense| instants.len() >= dense.t.len())
    }
}

impl ReadPhase {
    fn values(
        &self,
        measure: usize,
        states: States<'_>,
        solved: Option<&Accelerations>,
    ) -> Vec<f64> {
        let (model, of) = (&**self.prepared.model(), &self.measures[measure]);
        let solved = solved.map(|found| [&found.a[..], &found.lam[..]]);
        match self.prepared.wide_for(states.t.len()) {
            Some(wide) => of.values_over_lanes((model, wide), states, solved),
            None => of.values(model, states, solved),
        }
    }
}
