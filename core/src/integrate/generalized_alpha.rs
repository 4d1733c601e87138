//! The generalized-α method at index 3, with step control or a constant step.
//!
//! Order 2 for q, v and λ. Between steps the cubic Hermite polynomial of q and v. For stiff forces and
//! for tolerances of about 1e-2 to 1e-4; see `alpha_step` for the method itself.

use super::alpha_parameters::AlphaParameters;
use super::alpha_step::AlphaStep;
use super::arguments::{refusal, Refused};
use super::dae::{Dae, ImplicitMethod};
use super::error_weights::ErrorWeights;
use super::evaluation_counter::CountedDae;
use super::failure::{conclude, Cause, Failure};
use super::fixed_step::Grid;
use super::interpolant::{Interpolant, HERMITE};
use super::ode::{Ended, Flow, Observer, Statistics, Step};
use super::step_control::StepControl;
use super::step_size::{least_step, Control, StepSize};

/// Order of the error estimate.
const ERROR_ORDER: i32 = 2;
/// Part of the first step over which the rate of the accelerations is taken.
const PROBE: f64 = 1e-3;
/// Part of a step that is tried after one without convergence.
const SHORTEN: f64 = 0.25;
/// Most by which a step grows: what is damped of a stiff motion, by ρ in a step, must not be outrun by
/// what a longer step makes of it.
const GROWTH: f64 = 1.5;
/// A step that might grow by less is kept, and the matrix with it.
const KEEP: f64 = 1.2;

/// Generalized-α with its options.
#[derive(Clone, Debug, PartialEq)]
pub struct GeneralizedAlpha {
    /// Which member of the family.
    pub parameters: AlphaParameters,
    /// Tolerances and steps.
    pub control: StepControl,
}

impl GeneralizedAlpha {
    /// With step control and no bounds on steps.
    pub fn new(parameters: AlphaParameters, rtol: f64, atol: f64) -> Self {
        Self { parameters, control: StepControl::new(rtol, atol) }
    }

    /// With a constant step, and Newton's iteration to `rtol` and `atol`.
    pub fn constant(parameters: AlphaParameters, step: f64, rtol: f64, atol: f64) -> Self {
        let control = StepControl { step: Some(step), ..StepControl::new(rtol, atol) };
        Self { parameters, control }
    }

    fn check(&self) -> Result<(), Refused> {
        let AlphaParameters { alpha_m, alpha_f, beta, gamma } = self.parameters;
        // of order 2, and with damping at infinite frequency (α_m < α_f), which index 3 needs
        if !(alpha_m < alpha_f && alpha_f < 1.0 && beta > 0.0 && gamma > 0.0) {
            return Err(("alpha_m", alpha_m, "below alpha_f, and alpha_f below 1"));
        }
        Ok(())
    }
}

/// An integration under way.
struct Run<'a, 'b, Y: Dae> {
    system: CountedDae<'a, Y>,
    options: &'b StepControl,
    step: AlphaStep,
    scale: ErrorWeights,
    t: f64,
    t_end: f64,
    /// y at the end of a step; the rows of its continuous extension.
    y_new: Vec<f64>,
    rows: Vec<f64>,
    singular: bool,
}

impl ImplicitMethod for GeneralizedAlpha {
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
        let checked = self
            .check()
            .map_err(refusal)
            .and_then(|()| self.control.begin((t0, t_end), (y, len), 2 * n));
        let mut run = Run {
            system: CountedDae::new(system, t0),
            options: &self.control,
            step: AlphaStep::new(self.parameters, n, m, works),
            scale: ErrorWeights::new(&self.control, n),
            t: t0,
            t_end,
            y_new: vec![0.0; len],
            rows: vec![0.0; 3 * len],
            singular: false,
        };
        let outcome = checked.and_then(|grid| run.go(grid, y, observer));
        conclude(outcome, Statistics { t: run.t, ..run.system.counts }, y)
    }
}

impl<Y: Dae> Run<'_, '_, Y> {
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
        self.accelerate()?;
        let first = match (self.options.step, self.options.first_step) {
            (Some(h), _) | (None, Some(h)) => h,
            (None, None) => {
                let Self { system, step, scale, .. } = self;
                let state = (&step.start, &mut step.end);
                let first = system.first_step((self.t, self.t_end), state, scale, ERROR_ORDER);
                first.map_err(Cause::Equations)?.min(self.options.max_step)
            }
        };
        self.begin(first.copysign(self.t_end - self.t))?;
        let mut size = StepSize::new(first, ERROR_ORDER, Control::ELEMENTARY);
        while self.t != self.t_end {
            if self.options.max_steps.is_some_and(|most| self.system.counts.steps >= most) {
                return Err(Cause::MaxSteps { steps: self.system.counts.steps });
            }
            let t_new = match &grid {
                Some(grid) => self.constant_step(grid)?,
                None => self.accepted_step(&mut size)?,
            };
            if self.finish(t_new, y, observer)? == Flow::Stop {
                return Ok(Ended::Stopped);
            }
        }
        Ok(Ended::Reached)
    }

    /// Accelerations at the beginning of a step.
    fn accelerate(&mut self) -> Result<(), Cause<Y::Stop>> {
        self.system.begin(self.t, &mut self.step.start)
    }

    /// What makes order 2 hold from the first step: a for t + Δ h, and velocities off the constraints by
    /// h² C_q v̈; v̈ by a difference of accelerations, filtered where it is tangential, so that stiff
    /// forces do not make it large.
    fn begin(&mut self, h: f64) -> Result<(), Cause<Y::Stop>> {
        let delta = PROBE * h;
        let Self { step, .. } = self;
        let n = step.start.q.len();
        for i in 0..n {
            let (v, a) = (step.start.v[i], step.start.a[i]);
            step.end.q[i] = step.start.q[i] + delta * (v + 0.5 * delta * a);
            step.end.v[i] = v + delta * a;
        }
        self.system.accelerate(self.t + delta, &mut step.end).map_err(Cause::Equations)?;
        let mut normal: Vec<f64> =
            (0..n).map(|i| (step.end.a[i] - step.start.a[i]) / delta).collect();
        if normal.iter().any(|x| !x.is_finite()) {
            return Ok(()); // a rough start costs the order of the first steps, no more
        }
        let mut along = normal.clone();
        self.accelerate()?;
        self.system.system.normal(&mut normal);
        along.iter_mut().zip(&normal).for_each(|(along, normal)| *along -= normal);
        if !self.step.factor_at_start(&mut self.system, self.t, h) {
            return Ok(());
        }
        self.step.filter(&mut self.system, &mut along);
        let p = self.step.parameters;
        for i in 0..n {
            let rate = along[i] + normal[i];
            self.step.slope[i] = rate;
            self.step.shift[i] = p.shift() * rate;
            self.step.normal[i] = p.position_error() * normal[i];
        }
        Ok(())
    }

    /// The next step of constant length, of which the last may be shorter. Returns its time.
    fn constant_step(&mut self, grid: &Grid) -> Result<f64, Cause<Y::Stop>> {
        let t_new = grid.end(self.system.counts.steps + 1, self.t)?;
        let h = t_new - self.t;
        if self.attempt(h) {
            return Ok(t_new);
        }
        Err(self.gave_up(h.abs()))
    }

    /// Tries steps until one is accepted. Returns its time.
    fn accepted_step(&mut self, size: &mut StepSize) -> Result<f64, Cause<Y::Stop>> {
        let t = self.t;
        let direction = (self.t_end - self.t).signum();
        let least = least_step(t, direction);
        size.begin(least, self.options.max_step);
        let mut unsolved = false;
        loop {
            if size.size < least {
                let h = size.size;
                let cause = Cause::StepTooSmall { t, h };
                return Err(if unsolved { self.gave_up(h) } else { cause });
            }
            let mut t_new = t + size.size * direction;
            if direction * (t_new - self.t_end) >= 0.0 {
                t_new = self.t_end;
            }
            let h = t_new - t;
            unsolved = !self.attempt(h);
            if unsolved {
                size.size = SHORTEN * h.abs();
            } else {
                let norm = self.step.error(&mut self.system, h, &self.scale);
                if norm < 1.0 {
                    let at_hand = size.size;
                    size.accept(h.abs(), norm);
                    size.size = size.size.min(GROWTH * h.abs());
                    if t_new != self.t_end && (at_hand..KEEP * at_hand).contains(&size.size) {
                        size.size = at_hand;
                    }
                    return Ok(t_new);
                }
                size.reject(h.abs(), norm);
            }
            self.system.counts.rejected += 1;
        }
    }

    /// One step; whether its equations could be solved.
    fn attempt(&mut self, h: f64) -> bool {
        let converged = self.step.advance(&mut self.system, (self.t, h), &mut self.scale);
        self.singular = self.step.singular;
        converged && self.step.finite()
    }

    /// Why no step could be had.
    fn gave_up(&mut self, h: f64) -> Cause<Y::Stop> {
        let Self { system, step, t, singular, .. } = self;
        if *singular {
            if let Some(stop) = system.system.singular(*t, &step.start.q, &step.start.v) {
                return Cause::Equations(stop);
            }
        }
        Cause::Newton { t: *t, h }
    }

    /// Puts the accepted state onto the constraints, shows the step to the observer, and moves on.
    fn finish<O: Observer>(
        &mut self,
        t_new: f64,
        y: &mut [f64],
        observer: &mut O,
    ) -> Result<Flow, Cause<Y::Stop>> {
        let h = t_new - self.t;
        self.step.project(&mut self.system, (self.t, h)).map_err(Cause::Equations)?;
        let Self { step, y_new, rows, .. } = self;
        if !step.finite() {
            return Err(Cause::NotFinite { t: t_new });
        }
        let (n, len) = (step.end.q.len(), y.len());
        y_new[..n].copy_from_slice(&step.end.q);
        y_new[n..2 * n].copy_from_slice(&step.end.v);
        for (k, w) in (2 * n..len).enumerate() {
            y_new[w] = y[w] + 0.5 * h * (step.start.powers[k] + step.end.powers[k]);
        }
        step.start.derivative(&mut rows[..len]);
        step.end.derivative(&mut rows[len..2 * len]);
        for ((chord, new), old) in rows[2 * len..].iter_mut().zip(y_new.iter()).zip(y.iter()) {
            *chord = (new - old) / h;
        }
        let flow = observer.step(&Step {
            t_old: self.t,
            t: t_new,
            y_old: y,
            y: y_new,
            dy_old: &rows[..len],
            dy: &rows[len..2 * len],
            interpolant: Interpolant::new(rows, len, &HERMITE, 4),
        });
        y.copy_from_slice(y_new);
        step.move_on(h);
        self.t = t_new;
        self.system.counts.steps += 1;
        Ok(flow)
    }
}
