//! What forward dynamics reports: states at chosen times, with accelerations, multipliers, energies.

use super::options::{Options, Output, Scheme};
use super::system::{Equations, WORKS};
use crate::equations::{energy, kinematics, Gains, Singular, Workspace};
use crate::integrate::{Flow, Step};
use crate::math::Motion;
use crate::model::Model;
use crate::stabilize::Fault;

/// Number of columns of [`Trajectory::energy`].
pub const ENERGIES: usize = 5;

/// Reported states, time first; row k of each table belongs to `t[k]`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trajectory {
    /// Times, s.
    pub t: Vec<f64>,
    /// Coordinates, rows of n_q.
    pub q: Vec<f64>,
    /// Velocities, rows of n_q.
    pub v: Vec<f64>,
    /// Accelerations at the reported state, without stabilization, rows of n_q.
    pub a: Vec<f64>,
    /// Multipliers at the reported state, without stabilization, rows of n_rows.
    pub lam: Vec<f64>,
    /// Kinetic, potential, dissipated energy, work of drivers, work of applied forces, J.
    pub energy: Vec<f64>,
}

/// The continuous extension of every step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dense {
    /// Step boundaries, one more than steps.
    pub t: Vec<f64>,
    /// y at the start of each step, rows of n_y.
    pub y: Vec<f64>,
    /// Coefficients of θ … θᵈ, for each step n_y rows of d.
    pub c: Vec<f64>,
    /// d.
    pub degree: usize,
}

/// Collects the output while the integrator runs.
pub(super) struct Recorder<'a> {
    model: &'a Model,
    output: Output,
    t0: f64,
    t_end: f64,
    next: usize,
    y: Vec<f64>,
    motions: Vec<Motion>,
    pub trajectory: Trajectory,
    pub dense: Option<Dense>,
    /// Projects what lies between the ends of a step.
    pub between: Equations<'a>,
    /// Why that was not possible, and when.
    pub fault: Option<(f64, Fault)>,
}

impl<'a> Recorder<'a> {
    pub fn new(model: &'a Model, options: &Options, t0: f64) -> Self {
        Self {
            model,
            output: options.output,
            t0,
            t_end: options.t_end,
            next: 1,
            y: vec![0.0; 2 * model.layout.n_q + WORKS],
            motions: Vec::new(),
            trajectory: Trajectory::default(),
            dense: options.dense_output.then(|| Dense::new(options, t0)),
            between: Equations::new(model, options),
            fault: None,
        }
    }

    /// Reports a state given as (q, v, works).
    pub fn report(&mut self, t: f64, y: &[f64]) {
        let n = self.model.layout.n_q;
        let (q, v, works) = (&y[..n], &y[n..2 * n], &y[2 * n..]);
        kinematics::motions(q, v, &mut self.motions);
        let kinetic = energy::kinetic(self.model, &self.motions);
        let potential = energy::potential(self.model, &self.motions, t);
        self.trajectory.t.push(t);
        self.trajectory.q.extend_from_slice(q);
        self.trajectory.v.extend_from_slice(v);
        self.trajectory.energy.extend([kinetic, potential]);
        self.trajectory.energy.extend_from_slice(works);
    }

    /// Reports whatever falls into a step; stops where a state between its ends cannot be projected.
    pub fn step(&mut self, step: &Step<'_>) -> Flow {
        if let Some(dense) = &mut self.dense {
            dense.add(step);
        }
        let Output::Every(h) = self.output else {
            self.report(step.t, step.y);
            return Flow::Continue;
        };
        let mut y = std::mem::take(&mut self.y);
        while let Some(t) = self.next_time(h, step.t) {
            step.interpolate(t, &mut y);
            if let Err(fault) = self.between.project(t, &mut y, false) {
                self.fault = Some(fault);
                return Flow::Stop;
            }
            self.report(t, &y);
        }
        self.y = y;
        if step.t == self.t_end && self.trajectory.t.last() != Some(&step.t) {
            self.report(step.t, step.y);
        }
        Flow::Continue
    }

    /// Whether a step that ends at `t` is needed between its ends.
    pub fn looks_inside(&self, t: f64) -> bool {
        match self.output {
            Output::Every(h) => self.dense.is_some() || self.due(h, t).is_some(),
            Output::Steps => self.dense.is_some(),
        }
    }

    /// Takes the next time of the grid if it has been reached.
    fn next_time(&mut self, h: f64, reached: f64) -> Option<f64> {
        let t = self.due(h, reached)?;
        self.next += 1;
        Some(t)
    }

    /// The next time of the grid if it has been reached: t₀ + k h by multiplication, without drift.
    fn due(&self, h: f64, reached: f64) -> Option<f64> {
        let direction = (self.t_end - self.t0).signum();
        let mut t = self.t0 + direction * self.next as f64 * h;
        // a grid point that misses t_end by rounding only is t_end
        if (t - self.t_end).abs() <= 1e-9 * h {
            t = self.t_end;
        }
        let past = |a: f64, b: f64| direction * (a - b) > 0.0;
        if past(t, reached) || past(t, self.t_end) {
            return None;
        }
        Some(t)
    }
}

impl Dense {
    /// Degree of a run that may change its method: the largest of those it chooses from.
    const HIGHEST: usize = 7;

    fn new(options: &Options, t0: f64) -> Self {
        let degree = if matches!(options.scheme, Scheme::Auto(_)) { Self::HIGHEST } else { 0 };
        Self { t: vec![t0], degree, ..Self::default() }
    }

    fn add(&mut self, step: &Step<'_>) {
        let (own, n) = (step.dense.degree(), step.y.len());
        let first = self.c.len();
        self.degree = self.degree.max(own);
        self.t.push(step.t);
        self.y.extend_from_slice(step.y_old);
        self.c.resize(first + self.degree * n, 0.0);
        let out = &mut self.c[first..];
        step.coefficients(&mut out[..own * n]);
        if own < self.degree {
            // rows of a lesser degree are spread, from the last
            for row in (0..n).rev() {
                let to = row * self.degree;
                out.copy_within(row * own..(row + 1) * own, to);
                out[to + own..to + self.degree].fill(0.0);
            }
        }
    }
}

impl Trajectory {
    /// Fills accelerations and multipliers at every reported state, by γ, never γ̂, and gives the
    /// number of rows filled: fewer than all if `watch` ended it.
    ///
    /// # Errors
    /// The first row, and its time, at which the equations of motion are singular; the rows before
    /// are filled.
    pub fn evaluate(
        &mut self,
        model: &Model,
        workspace: &mut Workspace,
        mut watch: impl FnMut(f64) -> Flow,
    ) -> Result<usize, (usize, f64, Singular)> {
        let n = model.layout.n_q;
        for (k, &t) in self.t.iter().enumerate() {
            if watch(t) == Flow::Stop {
                return Ok(k);
            }
            let row = k * n..(k + 1) * n;
            let (q, v) = (&self.q[row.clone()], &self.v[row]);
            let gains = Gains::default();
            workspace.accelerate(model, t, q, v, gains).map_err(|singular| (k, t, singular))?;
            self.a.extend_from_slice(workspace.a());
            self.lam.extend_from_slice(workspace.lam());
        }
        Ok(self.t.len())
    }

    /// Keeps the first `count` rows.
    pub fn truncate(&mut self, count: usize, n_q: usize, n_rows: usize) {
        self.t.truncate(count);
        self.q.truncate(count * n_q);
        self.v.truncate(count * n_q);
        self.a.truncate(count * n_q);
        self.lam.truncate(count * n_rows);
        self.energy.truncate(count * ENERGIES);
    }
}
