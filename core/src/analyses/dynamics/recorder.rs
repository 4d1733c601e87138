//! Recording of the states of a run at chosen times.

use super::lane_batch::LaneBatch;
use super::methods::Scheme;
use super::motion_ode::MotionOde;
use super::options::Options;
use super::report_projection::ReportProjection;
use super::sampling::Sample;
use super::trajectory::{PiecewiseInterpolant, Trajectory};
use super::wide::Wide;
use crate::equations::Workspace;
use crate::integrate::{all_finite, Flow, Step, HIGHEST};
use crate::math::Lanes;
use crate::model::Model;
use crate::solve::Breakdown;

/// Number of reported states for which memory is reserved in each step. Tables grow beyond it.
const IN_A_STEP: usize = 4;
/// Number of steps for which memory is reserved in a run without reported states between its ends.
const UNREPORTED_STEPS: usize = 512;

/// Number of steps without a reported state after which the joints are checked, if the error control chooses the
/// steps. Joints then open over many steps, and each check costs two fifths of the instructions of an evaluation.
const UNREPORTED: usize = 4;

/// The number of these steps for a scheme. An unstable constant step opens joints within few steps.
fn unreported(scheme: &Scheme) -> usize {
    let constant = match scheme {
        Scheme::GeneralizedAlpha(_) | Scheme::Radau(_) | Scheme::Auto(_) => None,
        explicit => explicit.control().step,
    };
    constant.map_or(UNREPORTED, |_| 1)
}

/// Number of steps of a grid, which need not be an integer. Zero if the steps of the method are reported.
pub(super) fn grid_steps(options: &Options, t0: f64) -> f64 {
    options.output_step.map_or(0.0, |h| ((options.t_end - t0) / h).abs())
}

/// Empty tables for a run from `t0`, with room for the states that a grid contains.
pub(super) fn tables(
    model: &Model,
    options: &Options,
    t0: f64,
) -> (Trajectory, Option<PiecewiseInterpolant>) {
    let layout = &model.layout;
    let grid = grid_steps(options, t0);
    let states = (grid + 2.0) as usize;
    let steps = if grid > 0.0 && grid < 1.0 { UNREPORTED_STEPS } else { states / IN_A_STEP };
    // use the highest degree of the methods for all steps from the start
    let several = matches!(options.method, Scheme::Auto(_) | Scheme::Dop853(_));
    let degree = if several { HIGHEST } else { 0 };
    let dense = || PiecewiseInterpolant::with_room(layout.n_y(), degree, HIGHEST, steps, t0);
    (Trajectory::with_room(layout, states), options.dense_output.then(dense))
}

/// Collects the output while the integrator runs.
pub(super) struct Recorder<'a> {
    output_step: Option<f64>,
    t0: f64,
    /// The end of the phase.
    pub t_end: f64,
    /// 1 forward, -1 backward.
    direction: f64,
    next: usize,
    /// The next time of the grid, beyond t_end once it has been reached.
    upcoming: f64,
    /// Steps since the last check of the joints, and the number of steps between checks.
    unreported: [usize; 2],
    /// The latest requested time.
    latest: f64,
    y: Vec<f64>,
    pub trajectory: Trajectory,
    pub dense: Option<PiecewiseInterpolant>,
    /// Coefficients of the interpolant of the last step.
    coefficients: Vec<f64>,
    /// Projects reported states onto the constraints.
    one: ReportProjection<'a>,
    /// Projects the states of a grid, if there are many.
    many: Option<LaneBatch<'a>>,
    /// The sample at the end of the last step; states reported there have its values.
    pub sample: Option<Sample>,
    /// The breakdown that stops the recording, and its time.
    pub breakdown: Option<(f64, Breakdown)>,
}

impl<'a> Recorder<'a> {
    /// Makes the recorder of a phase that begins at `t`, in a run that began at `t0`. The tables contain the records
    /// of the earlier phases. The model over lanes is used if many states are reported.
    pub fn new(
        system: &MotionOde<'a>,
        wide: Option<Wide<'a>>,
        options: &Options,
        (t0, t): (f64, f64),
        (trajectory, dense): (Trajectory, Option<PiecewiseInterpolant>),
    ) -> Self {
        let model = system.model;
        let mut recorder = Self {
            output_step: options.output_step,
            t0,
            t_end: options.t_end,
            direction: (options.t_end - t0).signum(),
            next: 0,
            upcoming: t0,
            unreported: [0, unreported(&options.method)],
            latest: t,
            y: vec![0.0; model.layout.n_y()],
            trajectory,
            dense,
            coefficients: Vec::new(),
            one: ReportProjection::new(model, options, system.workspace.clone()),
            many: wide.map(|wide| LaneBatch::new(wide, options, &system.workspace)),
            sample: None,
            breakdown: None,
        };
        recorder.go_on_beyond(t);
        recorder
    }

    /// Number of factorisations. A factorisation over all lanes counts once per lane.
    pub fn factorisations(&self) -> usize {
        let many = self.many.as_ref().map_or(0, |batch| batch.placer.factorisations());
        self.one.factorisations() + Lanes::WIDTH * many
    }

    /// Projects states as sharply as the equations of motion are solved, and omits the rows that they omit. Returns
    /// whether the run may continue.
    pub fn follow(&mut self, workspace: &Workspace) -> Flow {
        self.one.sharpen(workspace.is_sharp());
        let omitted = workspace.matrix.omitted();
        if self.one.omitted() == omitted {
            return Flow::Continue;
        }
        let flow = self.flush();
        self.one.omit(omitted);
        if let Some(batch) = &mut self.many {
            batch.placer.omit(omitted);
        }
        flow
    }

    /// Reports the start. The run stops here if the equations of motion have no solution at the start.
    pub fn begin(&mut self, t: f64, y: &[f64]) -> Flow {
        let solved = self.one.begin(t, y);
        self.keep(t, y, solved)
    }

    /// Reports a state given as (q, v, works), unchanged.
    pub fn report(&mut self, t: f64, y: &[f64]) -> Flow {
        if self.flush() == Flow::Stop {
            return Flow::Stop;
        }
        let violation = self.one.violation(t, y);
        self.keep(t, y, violation.map_or(Ok(()), Err))
    }

    /// Reports the state of a step at a time of the grid. The end of a step meets the constraints already; a failure
    /// between the ends may appear later, when the state is projected.
    fn report_in(&mut self, step: &Step<'_>, t: f64) -> Flow {
        if t == step.t {
            return self.report(t, step.y);
        }
        if self.one.is_sharp() || self.sample.as_ref().is_some_and(|sample| sample.reaches(t)) {
            let flow = self.flush();
            step.interpolate(t, &mut self.y);
            return if flow == Flow::Continue { self.report_alone(t) } else { flow };
        }
        let Some(batch) = &mut self.many else {
            step.interpolate(t, &mut self.y);
            return self.report_alone(t);
        };
        batch.add(step, t);
        match batch.is_full() {
            true => self.flush(),
            false => Flow::Continue,
        }
    }

    /// Projects and reports the state in `y`.
    fn report_alone(&mut self, t: f64) -> Flow {
        let mut y = std::mem::take(&mut self.y);
        let placed = self.one.place_on_branch(t, &mut y);
        let flow = self.keep(t, &y, placed);
        self.y = y;
        flow
    }

    /// Reports the states of an incomplete batch.
    pub fn flush(&mut self) -> Flow {
        let Some(batch) = self.many.as_mut().filter(|batch| !batch.is_empty()) else {
            return Flow::Continue;
        };
        if batch.place() {
            batch.keep(&mut self.trajectory);
            return Flow::Continue;
        }
        let Some(mut batch) = self.many.take() else { return Flow::Continue };
        let mut flow = Flow::Continue;
        for (lane, t) in batch.take() {
            if flow == Flow::Continue {
                batch.given(lane, &mut self.y);
                flow = self.report_alone(t);
            }
        }
        self.many = Some(batch);
        flow
    }

    /// Stores a projected state.
    fn keep(&mut self, t: f64, y: &[f64], placed: Result<(), Breakdown>) -> Flow {
        if let Err(breakdown) = placed {
            return self.stop(t, breakdown);
        }
        if !all_finite(y) {
            return self.stop(t, Breakdown::NotFinite);
        }
        let layout = &self.one.model.layout;
        match self.sample.as_ref().filter(|sample| sample.reaches(t)) {
            Some(sample) => {
                let mut after = y.to_vec();
                sample.put(self.one.model, &mut after);
                self.trajectory.add(layout, t, &after);
            }
            None => self.trajectory.add(layout, t, y),
        }
        Flow::Continue
    }

    fn stop(&mut self, t: f64, breakdown: Breakdown) -> Flow {
        self.breakdown = Some((t, breakdown));
        Flow::Stop
    }

    /// Reports all states in a step. Stops if `watch` requests it or a state cannot be projected.
    pub fn step(&mut self, step: &Step<'_>, watch: &mut impl FnMut(f64) -> Flow) -> Flow {
        if let Some(dense) = &mut self.dense {
            if !dense.add(step, &mut self.coefficients) {
                return self.stop(step.t, Breakdown::NotFinite);
            }
        }
        if self.output_step.is_none() {
            return self.report(step.t, step.y);
        }
        let mut flow = self.check_joints(step);
        while let (Flow::Continue, Some(t)) = (flow, self.due(step.t)) {
            self.latest = t;
            self.go_on();
            flow = self.report_in(step, t);
            flow = if flow == Flow::Continue { watch(t) } else { flow };
        }
        if flow == Flow::Continue && step.t == self.t_end && self.latest != step.t {
            flow = self.report(step.t, step.y);
        }
        flow
    }

    /// The state of a step at a time, as it would be reported.
    pub fn state_in(&mut self, step: &Step<'_>, t: f64) -> Vec<f64> {
        let mut y = step.y.to_vec();
        if t != step.t {
            step.interpolate(t, &mut y);
            let given = y.clone();
            if self.one.place_on_branch(t, &mut y).is_err() {
                return given;
            }
        }
        y
    }

    /// Checks the joints at the end of a step if enough steps have passed without reported states.
    fn check_joints(&mut self, step: &Step<'_>) -> Flow {
        let due = self.due(step.t).is_some();
        let [since, most] = &mut self.unreported;
        *since = if due { 0 } else { *since + 1 };
        if *since < *most {
            return Flow::Continue;
        }
        *since = 0;
        match self.one.violation(step.t, step.y) {
            Some(violation) => self.stop(step.t, violation),
            None => Flow::Continue,
        }
    }

    /// Whether states inside a step that ends at `t` are needed.
    pub fn looks_inside(&self, t: f64) -> bool {
        self.dense.is_some() || self.output_step.is_some() && self.due(t).is_some()
    }

    /// The next time of the grid, if the run has reached it.
    fn due(&self, reached: f64) -> Option<f64> {
        let past = |a: f64, b: f64| self.direction * (a - b) > 0.0;
        let t = self.upcoming;
        (!past(t, reached) && !past(t, self.t_end)).then_some(t)
    }

    /// Goes to the first time of the grid after `t`.
    fn go_on_beyond(&mut self, t: f64) {
        let Some(h) = self.output_step else { return };
        // a grid point that differs from t only by rounding is t
        self.next = ((t - self.t0).abs() / h + 1e-9) as usize;
        self.go_on();
    }

    /// Goes to the next time of the grid: t₀ + k h by multiplication, without drift.
    fn go_on(&mut self) {
        let Some(h) = self.output_step else { return };
        self.next += 1;
        self.upcoming = self.t0 + self.direction * self.next as f64 * h;
        // a grid point that differs from t_end only by rounding is t_end
        if (self.upcoming - self.t_end).abs() <= 1e-9 * h {
            self.upcoming = self.t_end;
        }
    }
}
