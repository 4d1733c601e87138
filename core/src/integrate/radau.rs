//! Radau IIA of order 5 with step control, for constrained mechanical systems that may be stiff.
//!
//! The equations are solved at index 2: the velocities satisfy their constraints at every stage, and projection
//! corrects the positions at the end of a step (see `radau_step`). The predictive controller of Gustafsson chooses
//! the steps. The tangent is kept while Newton's iteration converges fast, and the factors are kept while the step is
//! unchanged (Hairer and Wanner, *Solving Ordinary Differential Equations II*, IV.8). The collocation polynomials
//! interpolate between the steps.

use super::dae::{Dae, DaeState};
use super::evaluation_counter::CountedDae;
use super::failure::Cause;
use super::implicit_stepper::{ImplicitScheme, ImplicitStepper};
use super::implicit_steps::ImplicitSteps;
use super::radau_coefficients::{dot, A, DEGREE, ERROR, EXTENSION, REAL};
use super::radau_step::{NewtonLimits, NewtonOutcome, RadauStep, ROWS};
use super::right_hand_side::all_finite;
use super::step_control::StepControl;
use super::step_size::{least_step, KEEP};
use super::stepper::{BoxedStepper, ImplicitMethod};

/// Order of the error estimate.
const ERROR_ORDER: i32 = 3;
/// Safety factor on the step that the error estimate allows.
const SAFETY: f64 = 0.9;
/// Bounds of the factor from one step to the next.
const MIN_FACTOR: f64 = 0.2;
const MAX_FACTOR: f64 = 8.0;
/// A tangent is kept while Newton's iteration converges at this rate or faster.
const FAST: f64 = 1e-3;
/// Factor on the step after a trial without convergence.
const SHORTEN: f64 = 0.5;
/// Largest number of Newton iterations in a step of controlled length.
const MOST: usize = 7;
/// Limits of Newton's iteration with a constant step.
const CONSTANT: NewtonLimits = NewtonLimits { tolerance: 1e-2, most: 25 };
/// Smallest error norm that the prediction of the next step uses.
const LEAST_NORM: f64 = 1e-2;

/// Radau IIA of order 5 with its options.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Radau {
    /// Tolerances and steps.
    pub control: StepControl,
}

impl Radau {
    /// The method with these tolerances and no bounds on steps.
    pub fn new(rtol: f64, atol: f64) -> Self {
        Self { control: StepControl::new(rtol, atol) }
    }

    /// The method with a constant step. Newton's iteration converges to `rtol` and `atol`.
    pub fn constant(step: f64, rtol: f64, atol: f64) -> Self {
        Self { control: StepControl { step: Some(step), ..StepControl::new(rtol, atol) } }
    }
}

/// State of the method between steps.
struct RadauProgress {
    step: RadauStep,
    /// Magnitude of the next trial step. None before the derivative at the start was evaluated.
    size: Option<f64>,
    /// Whether the tangent of an earlier step can be used again.
    keep_tangent: bool,
    /// Length and error norm of the step before.
    before: Option<(f64, f64)>,
}

impl ImplicitMethod for Radau {
    fn start<Y: Dae + ?Sized>(
        &self,
        system: &Y,
        span: (f64, f64),
        y: &[f64],
    ) -> Result<BoxedStepper<Y, Y::Stop>, Cause<Y::Stop>> {
        let lengths = system.lengths();
        let step = RadauStep::new(lengths);
        let state = RadauProgress { step, size: None, keep_tangent: false, before: None };
        ImplicitStepper::start(self.control.usable(), lengths, span, y, state)
    }
}

impl ImplicitScheme for RadauProgress {
    const ROWS: usize = ROWS;
    const DEGREE: usize = DEGREE;

    fn table() -> &'static [f64] {
        &*EXTENSION
    }

    fn next<Y: Dae + ?Sized>(
        stepper: &mut RadauStepper,
        dae: &mut CountedDae<'_, Y>,
    ) -> Result<(), Cause<Y::Stop>> {
        let size = match stepper.method.size {
            Some(size) => size,
            None => stepper.begin(dae)?,
        };
        dae.check_count(&stepper.control)?;
        let t_new = match stepper.grid {
            Some(_) => stepper.constant_step(dae)?,
            None => stepper.accepted_step(dae, size)?,
        };
        stepper.finish(dae, t_new)
    }

    fn size(&self) -> Option<f64> {
        self.size
    }

    fn forget(&mut self) -> Option<f64> {
        (self.keep_tangent, self.before) = (false, None);
        self.step.forget();
        self.size.take()
    }
}

type RadauStepper = ImplicitStepper<RadauProgress>;

impl RadauStepper {
    /// Evaluates the derivative at the start and chooses the first step.
    fn begin<Y: Dae + ?Sized>(
        &mut self,
        dae: &mut CountedDae<'_, Y>,
    ) -> Result<f64, Cause<Y::Stop>> {
        let Self { method, control, scale, steps, .. } = self;
        let RadauStep { start, stages, .. } = &mut method.step;
        let first = dae.start(control, steps, (start, &mut stages[0]), scale, ERROR_ORDER)?;
        self.method.size = Some(first);
        Ok(first)
    }

    /// Takes the next step of constant length; the last step may be shorter. Returns its end time.
    fn constant_step<Y: Dae + ?Sized>(
        &mut self,
        dae: &mut CountedDae<'_, Y>,
    ) -> Result<f64, Cause<Y::Stop>> {
        let t = self.steps.t;
        let Some(grid) = &mut self.grid else { unreachable!("a constant step") };
        let t_new = grid.next(t)?;
        let mut singular = false;
        for fresh in [false, true] {
            if fresh || !self.method.keep_tangent {
                self.method.step.linearize(dae, t, t_new - t);
            }
            let solved = self.method.step.advance(dae, (t, t_new - t), &mut self.scale, CONSTANT);
            if let NewtonOutcome::Converged(_, rate) = solved {
                self.method.keep_tangent = rate <= FAST;
                self.method.step.evaluate(dae, (t, t_new - t)); // computes the powers
                return Ok(t_new);
            }
            singular = matches!(solved, NewtonOutcome::Singular);
        }
        let other = Cause::Newton { t, h: (t_new - t).abs() };
        Err(dae.unsolved(singular, t, &self.method.step.start, other))
    }

    /// Tries steps until one is accepted. Returns its end time.
    fn accepted_step<Y: Dae + ?Sized>(
        &mut self,
        dae: &mut CountedDae<'_, Y>,
        size: f64,
    ) -> Result<f64, Cause<Y::Stop>> {
        let (t, t_end, direction) = (self.steps.t, self.steps.t_end, self.steps.direction());
        let least = least_step(t, direction);
        let mut size = size.min(self.control.max_step).max(least);
        let mut rejected = false;
        let (mut unsolved, mut singular) = (false, false);
        loop {
            if size < least {
                let h = size;
                let other =
                    if unsolved { Cause::Newton { t, h } } else { Cause::StepTooSmall { t, h } };
                return Err(dae.unsolved(singular, t, &self.method.step.start, other));
            }
            let mut t_new = t + size * direction;
            if direction * (t_new - t_end) >= 0.0 {
                t_new = t_end;
            }
            let h = t_new - t;
            if !self.method.step.fresh && !self.method.keep_tangent {
                self.method.step.linearize(dae, t, h);
            }
            let tolerance = newton_tolerance(self.control.rtol);
            let limits = NewtonLimits { tolerance, most: MOST };
            let solved = self.method.step.advance(dae, (t, h), &mut self.scale, limits);
            let NewtonOutcome::Converged(iterations, rate) = solved else {
                singular = matches!(solved, NewtonOutcome::Singular);
                unsolved = true;
                // an old tangent is renewed before the step is shortened
                if self.method.step.fresh {
                    size = SHORTEN * h.abs();
                    dae.counts.rejected += 1;
                    rejected = true;
                    // the shorter step has another midpoint, where the matrix may be regular
                    self.method.step.fresh = false;
                }
                self.method.keep_tangent = false;
                continue;
            };
            unsolved = false;
            let norm = self.error(dae, (t, h), rejected)?;
            let safety = SAFETY * (2 * MOST + 1) as f64 / (2 * MOST + iterations) as f64;
            let factor = factor(norm, safety);
            if norm < 1.0 {
                self.method.keep_tangent = rate <= FAST;
                self.method.size = Some(size);
                self.accept((h.abs(), norm), factor, safety, rejected);
                return Ok(t_new);
            }
            size = h.abs() * factor.min(SAFETY);
            dae.counts.rejected += 1;
            rejected = true;
        }
    }

    /// The error norm of the step. The error is estimated a second time at the start and after rejections, where
    /// stiff components may not have decayed.
    fn error<Y: Dae + ?Sized>(
        &mut self,
        dae: &mut CountedDae<'_, Y>,
        span: (f64, f64),
        rejected: bool,
    ) -> Result<f64, Cause<Y::Stop>> {
        let Self { method: RadauProgress { step, .. }, scale, .. } = self;
        step.evaluate(dae, span); // computes the powers
        let mut norm = step.error(dae, span, scale, false)?;
        if norm >= 1.0 && (rejected || self.method.before.is_none()) {
            norm = step.error(dae, span, scale, true)?;
        }
        let norm = norm.max(self.quadrature_norm(dae, span.1));
        // the state may have left the domain; reject the step
        Ok(if norm.is_finite() { norm } else { f64::MAX })
    }

    /// The error norm of the quadratures; 0 if they need no test of their own.
    fn quadrature_norm<Y: Dae + ?Sized>(&self, dae: &CountedDae<'_, Y>, h: f64) -> f64 {
        let Self { method: RadauProgress { step, .. }, steps, lengths, scale, .. } = self;
        let old = steps.y[lengths.controlled()..].iter().enumerate();
        let works: Vec<f64> = old.map(|(k, work)| work + step.work(k, h)).collect();
        // the difference from the embedded method, as for v
        let error = |k: usize| {
            let powers = step.powers(k);
            let risen: f64 = A.iter().zip(ERROR).map(|(row, by)| by * dot(row, &powers)).sum();
            h * (step.start.powers[k] / REAL + risen)
        };
        let errors = (0..works.len()).map(error);
        dae.system.quadrature_scale(&works).map_or(0.0, |of| scale.of_quadratures(of, errors))
    }

    /// Chooses the next step from the errors of this step and the one before (Gustafsson, *Control-theoretic
    /// techniques for stepsize selection in implicit Runge–Kutta methods*, ACM Trans. Math. Softw. 20 (1994) 496).
    fn accept(&mut self, (h, norm): (f64, f64), factor: f64, safety: f64, rejected: bool) {
        let mut by = factor;
        if let Some((h_before, norm_before)) = self.method.before {
            let ratio = norm.max(f64::MIN_POSITIVE) * norm.max(f64::MIN_POSITIVE) / norm_before;
            let predicted = safety * h / h_before * ratio.powf(-1.0 / f64::from(ERROR_ORDER + 1));
            by = by.min(predicted.clamp(MIN_FACTOR, MAX_FACTOR));
        }
        if rejected {
            by = by.min(1.0);
        }
        self.method.before = Some((h, norm.max(LEAST_NORM)));
        let wanted = self.method.size.filter(|size| h < 0.99 * size); // the last step is shortened to t_end
        let short = wanted.is_some();
        if short || !(self.method.keep_tangent && (1.0..KEEP).contains(&by)) {
            self.method.size = Some((h * by).max(wanted.unwrap_or(0.0)));
        }
    }

    /// Projects the accepted state onto the constraints and evaluates its derivative.
    fn finish<Y: Dae + ?Sized>(
        &mut self,
        dae: &mut CountedDae<'_, Y>,
        t_new: f64,
    ) -> Result<(), Cause<Y::Stop>> {
        let Self { method: RadauProgress { step, .. }, steps, lengths, .. } = self;
        let ImplicitSteps { t, y, y_new, dy, rows, .. } = steps;
        let (h, n, len) = (t_new - *t, lengths.coordinates, lengths.total());
        step.interpolant_rows(rows);
        step.stages[2].write(y_new);
        let works = lengths.controlled();
        for (k, w) in (works..len).enumerate() {
            y_new[w] = y[w] + step.work(k, h);
        }
        let (dy_old, dy_new) = dy.split_at_mut(len);
        step.start.derivative(dy_old);
        let (q, rest) = y_new.split_at_mut(n);
        let (v, rest) = rest.split_at_mut(n);
        let state = DaeState { q, v, z: &rest[..lengths.states] };
        let changed = dae.project(t_new, state, false)?;
        if !all_finite(y_new) {
            return Err(Cause::NotFinite { t: t_new });
        }
        if changed {
            let jump = &mut rows[(ROWS - 1) * len..];
            let before = step.stages[2].q.iter().chain(&step.stages[2].v);
            let both = before.zip(y_new.iter());
            jump.iter_mut().zip(both).for_each(|(jump, (old, new))| *jump = (new - old) / h);
        }
        step.start.set(y_new);
        dae.begin(t_new, &mut step.start)?;
        step.start.derivative(dy_new);
        step.move_on(h);
        steps.accept(t_new);
        dae.counts.steps += 1;
        Ok(())
    }
}

/// The factor on the step that an error norm allows.
fn factor(norm: f64, safety: f64) -> f64 {
    let factor = safety * norm.max(f64::MIN_POSITIVE).powf(-1.0 / f64::from(ERROR_ORDER + 1));
    factor.clamp(MIN_FACTOR, MAX_FACTOR)
}

/// Error that Newton's iteration may leave, as a fraction of the tolerance. The fraction is larger for small
/// tolerances.
fn newton_tolerance(rtol: f64) -> f64 {
    (10.0 * f64::EPSILON / rtol).max(rtol.sqrt().min(0.03))
}
