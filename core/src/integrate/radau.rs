//! Radau IIA of order 5 with step control, for constrained mechanical systems that may be stiff.
//!
//! At index 2: the velocities meet their constraints at every stage, the positions by projection at the
//! end of a step; see `radau_step`. Steps by the predictive control of Gustafsson; the tangent is kept
//! while Newton's iteration converges fast, the factors while the step stays (Hairer and Wanner,
//! *Solving Ordinary Differential Equations II*, IV.8). Between steps the polynomials of collocation.

use super::dae::{Dae, ImplicitMethod};
use super::error_weights::ErrorWeights;
use super::evaluation_counter::CountedDae;
use super::failure::{conclude, Cause, Failure};
use super::fixed_step::Grid;
use super::interpolant::Interpolant;
use super::ode::{Ended, Flow, Observer, Statistics, Step};
use super::radau_coefficients::{DEGREE, EXTENSION};
use super::radau_step::{NewtonLimits, NewtonOutcome, RadauStep, ROWS};
use super::right_hand_side::all_finite;
use super::step_control::StepControl;
use super::step_size::least_step;

/// Order of the error estimate.
const ERROR_ORDER: i32 = 3;
/// Part of the step that the error would allow.
const SAFETY: f64 = 0.9;
/// Bounds on the change of the step.
const MIN_FACTOR: f64 = 0.2;
const MAX_FACTOR: f64 = 8.0;
/// A step that might grow by less is kept, and the factors with it.
const KEEP: f64 = 1.2;
/// A tangent is kept while Newton's iteration converges at this rate.
const FAST: f64 = 1e-3;
/// Part of a step that is tried after one without convergence.
const SHORTEN: f64 = 0.5;
/// Most iterations for a step of controlled length.
const MOST: usize = 7;
/// What is asked of Newton's iteration with a constant step.
const CONSTANT: NewtonLimits = NewtonLimits { tolerance: 1e-2, most: 25 };
/// An error below counts as this in the prediction from it.
const LEAST_NORM: f64 = 1e-2;

/// Radau IIA of order 5 with its options.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Radau {
    /// Tolerances and steps.
    pub control: StepControl,
}

impl Radau {
    /// With the given tolerances and no bounds on steps.
    pub fn new(rtol: f64, atol: f64) -> Self {
        Self { control: StepControl::new(rtol, atol) }
    }

    /// With a constant step, and Newton's iteration to `rtol` and `atol`.
    pub fn constant(step: f64, rtol: f64, atol: f64) -> Self {
        Self { control: StepControl { step: Some(step), ..StepControl::new(rtol, atol) } }
    }
}

/// An integration under way.
struct Run<'a, Y: Dae> {
    system: CountedDae<'a, Y>,
    options: StepControl,
    step: RadauStep,
    scale: ErrorWeights,
    t: f64,
    t_end: f64,
    direction: f64,
    /// Magnitude of the step to try.
    size: f64,
    /// Whether the tangent of an earlier step is still good.
    keep_tangent: bool,
    /// Length and error of the step before.
    before: Option<(f64, f64)>,
    y_new: Vec<f64>,
    /// Derivatives at both ends of a step; rows of its continuous extension.
    dy: Vec<f64>,
    rows: Vec<f64>,
}

impl ImplicitMethod for Radau {
    fn integrate<Y: Dae, O: Observer>(
        &self,
        system: &mut Y,
        t0: f64,
        t_end: f64,
        y: &mut [f64],
        observer: &mut O,
    ) -> Result<Statistics, Failure<Y::Stop>> {
        let (n, m, works) = (system.coordinates(), system.multipliers(), system.quadratures());
        let len = 2 * n + works;
        let options = self.control.usable();
        let checked = options.begin((t0, t_end), (y, len), 2 * n);
        let mut run = Run {
            system: CountedDae::new(system, t0),
            step: RadauStep::new(n, m, works),
            scale: ErrorWeights::new(&options, n),
            options,
            t: t0,
            t_end,
            direction: (t_end - t0).signum(),
            size: 0.0,
            keep_tangent: false,
            before: None,
            y_new: vec![0.0; len],
            dy: vec![0.0; 2 * len],
            rows: vec![0.0; ROWS * len],
        };
        let outcome = checked.and_then(|grid| run.go(grid, y, observer));
        conclude(outcome, Statistics { t: run.t, ..run.system.counts }, y)
    }
}

impl<Y: Dae> Run<'_, Y> {
    fn go<O: Observer>(
        &mut self,
        grid: Option<Grid>,
        y: &mut [f64],
        observer: &mut O,
    ) -> Result<Ended, Cause<Y::Stop>> {
        if self.t == self.t_end {
            return Ok(Ended::Reached);
        }
        let n = self.step.start.q.len();
        self.step.start.q.copy_from_slice(&y[..n]);
        self.step.start.v.copy_from_slice(&y[n..2 * n]);
        self.system.begin(self.t, &mut self.step.start)?;
        self.size = match (self.options.step, self.options.first_step) {
            (Some(h), _) | (None, Some(h)) => h,
            (None, None) => {
                let Self { system, step, scale, .. } = self;
                let state = (&step.start, &mut step.stages[0]);
                let first = system.first_step((self.t, self.t_end), state, scale, ERROR_ORDER);
                first.map_err(Cause::Equations)?
            }
        };
        while self.t != self.t_end {
            if self.options.max_steps.is_some_and(|most| self.system.counts.steps >= most) {
                return Err(Cause::MaxSteps { steps: self.system.counts.steps });
            }
            let t_new = match &grid {
                Some(grid) => self.constant_step(grid)?,
                None => self.accepted_step()?,
            };
            if self.finish(t_new, y, observer)? == Flow::Stop {
                return Ok(Ended::Stopped);
            }
        }
        Ok(Ended::Reached)
    }

    /// The next step of constant length, of which the last may be shorter. Returns its time.
    fn constant_step(&mut self, grid: &Grid) -> Result<f64, Cause<Y::Stop>> {
        let t = self.t;
        let t_new = grid.end(self.system.counts.steps + 1, t)?;
        let mut singular = false;
        for fresh in [false, true] {
            if fresh || !self.keep_tangent {
                self.step.linearize(&mut self.system, t, t_new - t);
            }
            let span = (t, t_new - t);
            let solved = self.step.advance(&mut self.system, span, &mut self.scale, CONSTANT);
            if let NewtonOutcome::Converged(_, rate) = solved {
                self.keep_tangent = rate <= FAST;
                return Ok(t_new);
            }
            singular = matches!(solved, NewtonOutcome::Singular);
        }
        Err(self.gave_up(true, singular))
    }

    /// Tries steps until one is accepted. Returns its time.
    fn accepted_step(&mut self) -> Result<f64, Cause<Y::Stop>> {
        let t = self.t;
        let least = least_step(t, self.direction);
        self.size = self.size.min(self.options.max_step).max(least);
        let mut rejected = false;
        let (mut unsolved, mut singular) = (false, false);
        loop {
            if self.size < least {
                return Err(self.gave_up(unsolved, singular));
            }
            let mut t_new = t + self.size * self.direction;
            if self.direction * (t_new - self.t_end) >= 0.0 {
                t_new = self.t_end;
            }
            let h = t_new - t;
            if !self.step.fresh && !self.keep_tangent {
                self.step.linearize(&mut self.system, t, h);
            }
            let enough =
                NewtonLimits { tolerance: newton_tolerance(self.options.rtol), most: MOST };
            let solved = self.step.advance(&mut self.system, (t, h), &mut self.scale, enough);
            let NewtonOutcome::Converged(iterations, rate) = solved else {
                singular = matches!(solved, NewtonOutcome::Singular);
                unsolved = true;
                // an old tangent gets another chance before the step is blamed
                if self.step.fresh {
                    self.size = SHORTEN * h.abs();
                    self.system.counts.rejected += 1;
                    rejected = true;
                }
                self.keep_tangent = false;
                continue;
            };
            unsolved = false;
            let norm = self.error((t, h), rejected)?;
            let safety = SAFETY * (2 * MOST + 1) as f64 / (2 * MOST + iterations) as f64;
            let wanted = factor(norm, safety);
            if norm < 1.0 {
                self.keep_tangent = rate <= FAST;
                self.accept((h.abs(), norm), wanted, safety, rejected);
                return Ok(t_new);
            }
            self.size = h.abs() * wanted.min(SAFETY);
            self.system.counts.rejected += 1;
            rejected = true;
        }
    }

    /// The error of the step, estimated once more at the start and after rejections, where stiff
    /// components are not yet at rest.
    fn error(&mut self, (t, h): (f64, f64), rejected: bool) -> Result<f64, Cause<Y::Stop>> {
        let Self { step, system, scale, .. } = self;
        let mut norm = step.error(system, (t, h), scale, false).map_err(Cause::Equations)?;
        if norm >= 1.0 && (rejected || self.before.is_none()) {
            norm = step.error(system, (t, h), scale, true).map_err(Cause::Equations)?;
        }
        // the state may have left the domain: as bad as can be
        Ok(if norm.is_finite() { norm } else { f64::MAX })
    }

    /// The next step, by the error of this one and that before (Gustafsson, *Control-theoretic
    /// techniques for stepsize selection in implicit Runge–Kutta methods*, ACM Trans. Math. Softw. 20
    /// (1994) 496).
    fn accept(&mut self, (h, norm): (f64, f64), wanted: f64, safety: f64, rejected: bool) {
        let mut by = wanted;
        if let Some((h_before, norm_before)) = self.before {
            let ratio = norm.max(f64::MIN_POSITIVE) * norm.max(f64::MIN_POSITIVE) / norm_before;
            let predicted = safety * h / h_before * ratio.powf(-1.0 / f64::from(ERROR_ORDER + 1));
            by = by.min(predicted.clamp(MIN_FACTOR, MAX_FACTOR));
        }
        if rejected {
            by = by.min(1.0);
        }
        self.before = Some((h, norm.max(LEAST_NORM)));
        let short = h < 0.99 * self.size; // the last step ends at t_end
        if short || !(self.keep_tangent && (1.0..KEEP).contains(&by)) {
            self.size = h * by;
        }
    }

    /// Why no step could be had.
    fn gave_up(&mut self, unsolved: bool, singular: bool) -> Cause<Y::Stop> {
        let (t, h) = (self.t, self.size);
        let start = &self.step.start;
        if singular {
            if let Some(stop) = self.system.system.singular(t, &start.q, &start.v) {
                return Cause::Equations(stop);
            }
        }
        if unsolved {
            Cause::Newton { t, h }
        } else {
            Cause::StepTooSmall { t, h }
        }
    }

    /// Puts the accepted state onto the constraints, shows the step to the observer, and moves on.
    fn finish<O: Observer>(
        &mut self,
        t_new: f64,
        y: &mut [f64],
        observer: &mut O,
    ) -> Result<Flow, Cause<Y::Stop>> {
        let (t, h) = (self.t, t_new - self.t);
        let Self { system, step, y_new, dy, rows, .. } = self;
        let (n, len) = (step.start.q.len(), y.len());
        step.evaluate(system, (t, h)); // for the powers
        step.extension(rows);
        y_new[..n].copy_from_slice(&step.stages[2].q);
        y_new[n..2 * n].copy_from_slice(&step.stages[2].v);
        for (k, w) in (2 * n..len).enumerate() {
            y_new[w] = y[w] + step.work(k, h);
        }
        let (dy_old, dy_new) = dy.split_at_mut(len);
        step.start.derivative(dy_old);
        let (q, rest) = y_new.split_at_mut(n);
        let changed = system.system.project(t_new, q, &mut rest[..n]).map_err(Cause::Equations)?;
        if !all_finite(y_new) {
            return Err(Cause::NotFinite { t: t_new });
        }
        if changed {
            let jump = &mut rows[(ROWS - 1) * len..];
            for (k, jump) in jump[..2 * n].iter_mut().enumerate() {
                let old = if k < n { step.stages[2].q[k] } else { step.stages[2].v[k - n] };
                *jump = (y_new[k] - old) / h;
            }
        }
        step.start.q.copy_from_slice(&y_new[..n]);
        step.start.v.copy_from_slice(&y_new[n..2 * n]);
        system.begin(t_new, &mut step.start)?;
        step.start.derivative(dy_new);
        let flow = observer.step(&Step {
            t_old: t,
            t: t_new,
            y_old: y,
            y: y_new,
            dy_old,
            dy: dy_new,
            interpolant: Interpolant::new(rows, len, &*EXTENSION, DEGREE),
        });
        y.copy_from_slice(y_new);
        step.move_on(h);
        self.t = t_new;
        self.system.counts.steps += 1;
        Ok(flow)
    }
}

/// By which the step may change for an error norm.
fn factor(norm: f64, safety: f64) -> f64 {
    let wanted = safety * norm.max(f64::MIN_POSITIVE).powf(-1.0 / f64::from(ERROR_ORDER + 1));
    wanted.clamp(MIN_FACTOR, MAX_FACTOR)
}

/// What Newton's iteration may leave: the smaller the tolerance, the smaller a part of it need not be.
fn newton_tolerance(rtol: f64) -> f64 {
    (10.0 * f64::EPSILON / rtol).max(rtol.sqrt().min(0.03))
}
