//! What forward dynamics reports: states at chosen times, with accelerations, multipliers, energies.

use super::apart::{Apart, Guard};
use super::options::{Options, Output, Scheme};
use super::system::{Equations, WORKS};
use crate::equations::{energy, kinematics, Gains};
use crate::integrate::{all_finite, Flow, Step};
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

/// Most numbers that room is made for beforehand; what is longer grows.
const MOST_ROOM: usize = 1 << 20;

impl Trajectory {
    /// Empty, with room for the states that a grid asks for: growing would copy them again and again.
    fn with_room(model: &Model, output: Output, span: f64) -> Self {
        let (n, m) = (model.layout.n_q, model.layout.n_rows);
        let rows = match output {
            Output::Every(h) => ((span / h).abs() + 2.0) as usize, // NaN gives none
            Output::Steps => 0,
        };
        let room = |width: usize| Vec::with_capacity(rows.min(MOST_ROOM / (3 * n + m + 6)) * width);
        Self {
            t: room(1),
            q: room(n),
            v: room(n),
            a: room(n),
            lam: room(m),
            energy: room(ENERGIES),
        }
    }
}

/// Why a state cannot be reported.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Halt {
    /// It cannot be projected, or has no unique accelerations.
    Fault(Fault),
    /// Its joints are apart.
    Apart(Apart),
    /// A number of it is not finite.
    NotFinite,
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
    output: Output,
    t0: f64,
    t_end: f64,
    next: usize,
    y: Vec<f64>,
    pub trajectory: Trajectory,
    pub dense: Option<Dense>,
    /// Projects what lies between the ends of a step, and solves the equations of motion there.
    pub reported: Equations<'a>,
    guard: Option<Guard>,
    /// Why it cannot go on, and when.
    pub halt: Option<(f64, Halt)>,
}

impl<'a> Recorder<'a> {
    pub fn new(model: &'a Model, options: &Options, t0: f64) -> Self {
        Self {
            output: options.output,
            t0,
            t_end: options.t_end,
            next: 1,
            y: vec![0.0; 2 * model.layout.n_q + WORKS],
            trajectory: Trajectory::with_room(model, options.output, options.t_end - t0),
            dense: options.dense_output.then(|| Dense::new(options, t0)),
            reported: Equations::new(model, options).for_reports(),
            guard: Guard::new(model, options),
            halt: None,
        }
    }

    /// Reports a state given as (q, v, works).
    pub fn report(&mut self, t: f64, y: &[f64]) -> Flow {
        let n = self.reported.model.layout.n_q;
        kinematics::motions(&y[..n], &y[n..2 * n], &mut self.reported.workspace.motions);
        self.report_placed(t, y)
    }

    /// Reports a state whose motions are in the workspace: accelerations and multipliers by γ, never γ̂.
    fn report_placed(&mut self, t: f64, y: &[f64]) -> Flow {
        let Equations { model, workspace, .. } = &mut self.reported;
        let guard = self.guard.as_mut();
        if let Some(apart) = guard.and_then(|guard| guard.look_at(model, t, &workspace.motions)) {
            return self.stop(t, Halt::Apart(apart));
        }
        if let Err(singular) = workspace.respond(model, t, Gains::default()) {
            return self.stop(t, Halt::Fault(Fault::Singular(singular)));
        }
        let n = model.layout.n_q;
        let kinetic = energy::kinetic(model, &workspace.motions);
        let potential = energy::potential(model, &workspace.motions, t);
        let numbers = [y, workspace.a(), workspace.lam(), &[kinetic, potential]];
        if !numbers.into_iter().all(all_finite) {
            return self.stop(t, Halt::NotFinite);
        }
        let row = &mut self.trajectory;
        row.t.push(t);
        row.q.extend_from_slice(&y[..n]);
        row.v.extend_from_slice(&y[n..2 * n]);
        row.a.extend_from_slice(workspace.a());
        row.lam.extend_from_slice(workspace.lam());
        row.energy.extend([kinetic, potential]);
        row.energy.extend_from_slice(&y[2 * n..]);
        Flow::Continue
    }

    fn stop(&mut self, t: f64, halt: Halt) -> Flow {
        self.halt = Some((t, halt));
        Flow::Stop
    }

    /// Reports whatever falls into a step; stops where `watch` says so, and where a state cannot be
    /// projected or its equations of motion cannot be solved.
    pub fn step(&mut self, step: &Step<'_>, watch: &mut impl FnMut(f64) -> Flow) -> Flow {
        if let Some(dense) = &mut self.dense {
            if !dense.add(step) {
                return self.stop(step.t, Halt::NotFinite);
            }
        }
        let Output::Every(h) = self.output else { return self.report(step.t, step.y) };
        let mut flow = self.look_apart(h, step);
        let mut y = std::mem::take(&mut self.y);
        while let (Flow::Continue, Some(t)) = (flow, self.next_time(h, step.t)) {
            step.interpolate(t, &mut y);
            flow = match self.reported.place(t, &mut y) {
                Ok(()) => self.report_placed(t, &y),
                Err((t, fault)) => self.stop(t, Halt::Fault(fault)),
            };
            if flow == Flow::Continue {
                flow = watch(t);
            }
        }
        self.y = y;
        let last = step.t == self.t_end && self.trajectory.t.last() != Some(&step.t);
        if flow == Flow::Continue && last {
            flow = self.report(step.t, step.y);
        }
        flow
    }

    /// Looks for joints apart at the end of a step without reported states.
    fn look_apart(&mut self, h: f64, step: &Step<'_>) -> Flow {
        if self.guard.is_none() || self.due(h, step.t).is_some() {
            return Flow::Continue;
        }
        let model = self.reported.model;
        match self.guard.as_mut().and_then(|guard| guard.look(model, step.t, step.y)) {
            Some(apart) => self.stop(step.t, Halt::Apart(apart)),
            None => Flow::Continue,
        }
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

    /// Whether all numbers of the step are finite; else nothing is kept of it.
    fn add(&mut self, step: &Step<'_>) -> bool {
        let (own, n) = (step.dense.degree(), step.y.len());
        let first = self.c.len();
        self.degree = self.degree.max(own);
        self.c.resize(first + self.degree * n, 0.0);
        let out = &mut self.c[first..];
        step.coefficients(&mut out[..own * n]);
        if !all_finite(&out[..own * n]) {
            self.c.truncate(first);
            return false;
        }
        if own < self.degree {
            // rows of a lesser degree are spread, from the last
            for row in (0..n).rev() {
                let to = row * self.degree;
                out.copy_within(row * own..(row + 1) * own, to);
                out[to + own..to + self.degree].fill(0.0);
            }
        }
        self.t.push(step.t);
        self.y.extend_from_slice(step.y_old);
        true
    }
}
