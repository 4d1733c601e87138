//! Methods that cannot choose the ends of their steps are replaced by DOP853 at singular positions.
//!
//! Across a singular position, the tangent of an implicit method changes its sign, so Newton's iteration finds no
//! solution or a solution on another branch. A constant step may end where the rates are noise. DOP853, whose steps
//! avoid the position (see `singularity_passage`), therefore takes over before it, and the method continues behind
//! it. A step that has already crossed the position is taken again.

use super::implicit_motion::ImplicitMotion;
use super::motion_ode::MotionOde;
use super::singularity_forecast::SingularityForecast;
use crate::equations::Gains;
use crate::integrate::{
    Atol, BoxedStepper, Cause, Dop853, ExplicitMethod, Step, StepControl, StepCounts, Stepper,
};
use crate::math::Listed;
use crate::solve::Breakdown;

/// Largest relative tolerance of DOP853 at a singular position, whose neighbourhood amplifies errors.
const RTOL: f64 = 1e-8;
/// Samples are taken inside a step if the pivot at one of its ends is below this fraction of the largest pivot so
/// far, and the square root of the pivot can change by the fraction [`FAST`] during the step.
const LOW: f64 = 0.25;
const FAST: f64 = 0.5;
/// Positions of the samples, as fractions of a step.
const INSIDE: [f64; 3] = [0.25, 0.5, 0.75];
/// DOP853 takes over if the pivot is below this fraction of the largest pivot so far, and if its parabola falls below
/// the fraction [`DEEP`] of the pivot. The steps of an implicit method become ever shorter there, so a forecast over
/// two steps does not reach the position.
const NEAR: f64 = 1.0 / 16.0;
const DEEP: f64 = 0.5;
/// Number of steps of DOP853 after which the method continues even at a smaller pivot, if the pivot grows.
const LONG: usize = 100;
/// Largest distance of a time from the grid, as a fraction of a constant step.
const ROUNDING: f64 = 1e-6;

/// The method that is used between singular positions.
pub(super) enum Method<'a> {
    /// An explicit method with a constant step.
    Explicit(BoxedStepper<MotionOde<'a>, Breakdown>),
    Implicit(ImplicitMotion<'a>),
}

impl<'a> Method<'a> {
    fn get(&self) -> &dyn Stepper<MotionOde<'a>, Breakdown> {
        match self {
            Self::Explicit(stepper) => &**stepper,
            Self::Implicit(stepper) => stepper,
        }
    }

    fn get_mut(&mut self) -> &mut dyn Stepper<MotionOde<'a>, Breakdown> {
        match self {
            Self::Explicit(stepper) => &mut **stepper,
            Self::Implicit(stepper) => stepper,
        }
    }
}

/// The stepper that takes the next step.
#[derive(Clone, Copy, PartialEq)]
enum Turn {
    /// The method.
    Method,
    /// DOP853; the method took the last step.
    HandOver,
    Dop853,
    /// DOP853, with a step that ends at this time of the grid of a constant step.
    ToGrid(f64),
    /// The method; DOP853 took the last step.
    HandBack,
}

/// A method, and DOP853 at singular positions.
pub(super) struct SingularityHandover<'a> {
    method: Method<'a>,
    control: StepControl,
    /// The start of the grid of a constant step.
    t0: f64,
    t_end: f64,
    dop853: Option<BoxedStepper<MotionOde<'a>, Breakdown>>,
    turn: Turn,
    /// Steps since DOP853 took over.
    taken: usize,
    forecast: SingularityForecast,
    /// Whether the forecast has a sample at the start of the next step.
    begun: bool,
    /// Times and pivots at the ends of the last steps, the last step first; and the largest pivot so far.
    last: [(f64, f64); 2],
    most: f64,
    /// Steps of the method that were taken again.
    taken_again: usize,
    /// Evaluations for samples and at the starts of DOP853, each with a factorisation.
    sampled: usize,
}

impl<'a> SingularityHandover<'a> {
    /// Wraps a method that begins a span, with its tolerances and steps.
    pub fn new(method: Method<'a>, control: &StepControl, (t, t_end): (f64, f64)) -> Self {
        Self {
            method,
            control: control.clone(),
            t0: t,
            t_end,
            dop853: None,
            turn: Turn::Method,
            taken: 0,
            forecast: SingularityForecast::default(),
            begun: false,
            last: [(f64::NAN, 0.0); 2],
            most: 0.0,
            taken_again: 0,
            sampled: 0,
        }
    }

    /// Whether DOP853 took the last step.
    pub fn crossing(&self) -> bool {
        !matches!(self.turn, Turn::Method | Turn::HandOver)
    }

    /// Whether an implicit method took the last step.
    pub fn was_implicit(&self) -> bool {
        matches!(self.method, Method::Implicit(_)) && !self.crossing()
    }

    /// The stepper of the last step.
    fn current(&self) -> &dyn Stepper<MotionOde<'a>, Breakdown> {
        match &self.dop853 {
            Some(dop853) if self.crossing() => &**dop853,
            _ => self.method.get(),
        }
    }

    /// Number of factorisations that [`statistics`](Stepper::statistics) does not count.
    pub fn factorisations(&self) -> usize {
        let of_method = match &self.method {
            Method::Explicit(stepper) => stepper.statistics().evaluations,
            Method::Implicit(stepper) => stepper.factorisations(),
        };
        let of_dop853 = self.dop853.as_ref().map_or(0, |dop853| dop853.statistics().evaluations);
        of_method + of_dop853 + self.sampled
    }

    /// Takes the sample at the start of the next step of the method. Returns whether the state is near a singular
    /// position.
    fn begin(&mut self, ode: &mut MotionOde<'a>) -> bool {
        let (t, y) = (self.method.get().t(), self.method.get().y().to_vec());
        let sample = sample(ode, t, &y);
        self.sampled += 1;
        self.forecast.begin(sample.map(|pivot| (t, pivot)));
        self.begun = true;
        self.last = [(t, sample.unwrap_or(0.0)), (f64::NAN, 0.0)];
        self.most = self.most.max(self.last[0].1);
        sample.is_some() && ode.workspace.matrix.regularised()
    }

    /// The singular position ahead of the start of the last step, which the method took: a position within two steps,
    /// or a position nearby.
    fn foresee(&mut self, ode: &mut MotionOde<'a>) -> Option<f64> {
        let pivot = match &self.method {
            Method::Explicit(_) => pivot(ode),
            Method::Implicit(stepper) => stepper.pivot(),
        }?;
        let step = self.method.get().last_step()?;
        let [start, before] = self.last;
        let end = (step.t, pivot);
        self.last = [end, start];
        self.most = self.most.max(pivot);
        let lower = pivot.min(start.1);
        let slope = (start.1.sqrt() - before.1.sqrt()) / (start.0 - before.0);
        // (there is no slope in the first step)
        let slow = (slope * (end.0 - start.0)).abs() < FAST * lower.sqrt();
        if lower < LOW * self.most && !slow {
            let mut y = step.y.to_vec();
            self.sampled += INSIDE.len();
            for part in INSIDE {
                let t = step.t_old + part * (step.t - step.t_old);
                step.interpolate(t, &mut y);
                if let Some(pivot) = sample(ode, t, &y) {
                    self.forecast.pass((t, pivot));
                }
            }
        }
        let found = self.forecast.foresee(end);
        self.forecast.accept(None);
        found.or_else(|| {
            let (at, least) = vertex([before, start, end]);
            let deep = pivot < NEAR * self.most && least < DEEP * pivot;
            (deep && (at - end.0) * (end.0 - start.0) > 0.0).then_some(at)
        })
    }

    /// Takes a step of the method. At a singular position DOP853 takes a step instead.
    fn ordinary_step(&mut self, ode: &mut MotionOde<'a>) -> Result<(), Cause<Breakdown>> {
        if !self.begun && self.begin(ode) {
            return self.hand_over(ode);
        }
        ode.passage.near = false;
        let outcome = self.method.get_mut().step(ode);
        let near = std::mem::take(&mut ode.passage.near);
        match outcome {
            Ok(()) => {}
            Err(cause @ Cause::MaxSteps { .. }) => return Err(cause),
            Err(_) if near || self.last[0].1 < LOW * self.most => return self.hand_over(ode),
            Err(cause) => return Err(cause),
        }
        let found = self.foresee(ode);
        let step = self.method.get().last_step().expect("a step was taken");
        let (t, t_old) = (step.t, step.t_old);
        if near || found.is_some_and(|at| (at - t_old) * (at - t) <= 0.0) {
            let y_old = step.y_old.to_vec();
            self.taken_again += 1;
            self.method.get_mut().restart(t_old, &y_old)?;
            return self.hand_over(ode);
        }
        if found.is_some() {
            self.turn = Turn::HandOver;
        }
        Ok(())
    }

    /// Starts DOP853 from the state of the method, and takes a step.
    fn hand_over(&mut self, ode: &mut MotionOde<'a>) -> Result<(), Cause<Breakdown>> {
        let (t, y) = (self.method.get().t(), self.method.get().y().to_vec());
        self.sampled += 1;
        ode.begin(t, &y).map_err(|error| Cause::Equations { t, error })?;
        self.last[0] = (t, pivot(ode).unwrap_or(0.0));
        match &mut self.dop853 {
            Some(dop853) => dop853.restart_until(t, &y, self.t_end)?,
            None => {
                let method = Dop853 { control: strict(&self.control) };
                self.dop853 = Some(method.start(ode, (t, self.t_end), &y)?);
            }
        }
        (self.turn, self.taken) = (Turn::Dop853, 0);
        self.cross(ode)
    }

    /// Takes a step of DOP853.
    fn cross(&mut self, ode: &mut MotionOde<'a>) -> Result<(), Cause<Breakdown>> {
        let Some(dop853) = &mut self.dop853 else { unreachable!("DOP853 took over") };
        if let Turn::ToGrid(end) = self.turn {
            let (t, y) = (dop853.t(), dop853.y().to_vec());
            if dop853.t_end() != end {
                dop853.restart_until(t, &y, end)?;
            }
        }
        dop853.step(ode)?;
        let t = dop853.t();
        self.taken += 1;
        let behind = self.behind(ode);
        self.turn = match self.turn {
            Turn::ToGrid(end) if t == end => Turn::HandBack,
            Turn::ToGrid(end) => Turn::ToGrid(end),
            _ if !behind => Turn::Dop853,
            _ => self.grid_time(t).map_or(Turn::HandBack, Turn::ToGrid),
        };
        Ok(())
    }

    /// Whether the last step of DOP853 ended behind the singular position.
    fn behind(&mut self, ode: &MotionOde<'a>) -> bool {
        let Some(now) = pivot(ode) else { return true };
        let grows = now >= std::mem::replace(&mut self.last[0].1, now);
        self.most = self.most.max(now);
        if !grows || ode.passage.in_reach() || ode.workspace.matrix.regularised() {
            return false;
        }
        if self.taken >= LONG {
            self.most = now;
        }
        now >= NEAR * self.most
    }

    /// The next time of the grid of a constant step. None for other steps, and if `t` is on the grid.
    fn grid_time(&self, t: f64) -> Option<f64> {
        let step = self.control.step?.copysign(self.t_end - self.t0);
        let count = (t - self.t0) / step;
        if (count - count.round()).abs() < ROUNDING {
            return None;
        }
        let time = self.t0 + count.ceil() * step;
        Some(if (self.t_end - time) * step > ROUNDING * step * step { time } else { self.t_end })
    }
}

/// Place and value of the vertex of the parabola through three points.
fn vertex([(t0, r0), (t1, r1), (t2, r2)]: [(f64, f64); 3]) -> (f64, f64) {
    let (early, late) = ((r1 - r0) / (t1 - t0), (r2 - r1) / (t2 - t1));
    let curvature = (late - early) / (t2 - t0);
    let slope = late + curvature * (t2 - t1);
    (t2 - 0.5 * slope / curvature, r2 - 0.25 * slope * slope / curvature)
}

/// The least pivot at a state; None without constraints.
fn sample(ode: &mut MotionOde<'_>, t: f64, y: &[f64]) -> Option<f64> {
    let [q, v, z, _] = ode.model.layout.split(y);
    ode.workspace.accelerate(ode.model, t, [q, v, z], Gains::default()).ok()?;
    pivot(ode)
}

/// The least pivot at the last evaluation, relative to its largest summand.
fn pivot(ode: &MotionOde<'_>) -> Option<f64> {
    ode.workspace.matrix.cancellation().map(|(_, pivot)| pivot)
}

/// Tolerances and steps of DOP853 at singular positions.
fn strict(control: &StepControl) -> StepControl {
    let part = (RTOL / control.rtol).min(1.0);
    let atol = match &control.atol {
        Atol::Scalar(atol) => Atol::Scalar(part * atol),
        Atol::Each(atol) => Atol::Each(atol.iter().map(|atol| part * atol).list()),
        Atol::Scaled(atol) => Atol::Scaled(part * atol),
    };
    let rtol = control.rtol.min(RTOL);
    StepControl { rtol, atol, step: None, first_step: None, ..control.clone() }
}

impl<'a> Stepper<MotionOde<'a>, Breakdown> for SingularityHandover<'a> {
    fn step(&mut self, ode: &mut MotionOde<'a>) -> Result<(), Cause<Breakdown>> {
        match self.turn {
            Turn::Method if !ode.passing => self.method.get_mut().step(ode),
            Turn::Method => self.ordinary_step(ode),
            Turn::HandOver => self.hand_over(ode),
            Turn::Dop853 | Turn::ToGrid(_) => self.cross(ode),
            Turn::HandBack => {
                let (t, y) = (self.t(), self.y().to_vec());
                self.method.get_mut().restart_until(t, &y, self.t_end)?;
                (self.turn, self.begun) = (Turn::Method, false);
                self.ordinary_step(ode)
            }
        }
    }

    fn prepare_interpolant(&mut self, ode: &mut MotionOde<'a>) -> Result<(), Cause<Breakdown>> {
        match &mut self.dop853 {
            Some(dop853) if !matches!(self.turn, Turn::Method | Turn::HandOver) => {
                dop853.prepare_interpolant(ode)
            }
            _ => self.method.get_mut().prepare_interpolant(ode),
        }
    }

    fn last_step(&self) -> Option<Step<'_>> {
        self.current().last_step()
    }

    fn t(&self) -> f64 {
        self.current().t()
    }

    fn next_size(&self) -> Option<f64> {
        self.method.get().next_size()
    }

    fn t_end(&self) -> f64 {
        self.t_end
    }

    fn y(&self) -> &[f64] {
        self.current().y()
    }

    fn restart_until(&mut self, t: f64, y: &[f64], t_end: f64) -> Result<(), Cause<Breakdown>> {
        self.method.get_mut().restart_until(t, y, t_end)?;
        (self.t0, self.t_end, self.turn, self.begun) = (t, t_end, Turn::Method, false);
        Ok(())
    }

    fn statistics(&self) -> StepCounts {
        let mut counts = self.method.get().statistics();
        counts.steps -= self.taken_again;
        counts.rejected += self.taken_again;
        if let Some(dop853) = &self.dop853 {
            counts = counts.plus(dop853.statistics());
        }
        counts
    }
}
