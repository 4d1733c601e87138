//! The generalized-α method at index 3, with step control or a constant step.
//!
//! The order is 2 for q, v and λ. The cubic Hermite polynomial interpolates q and v between the steps. The method is
//! intended for stiff forces and for tolerances of about 1e-2 to 1e-4. `alpha_step` contains one step.

use super::alpha_parameters::AlphaParameters;
use super::alpha_step::{AlphaStep, PART};
use super::arguments::require;
use super::dae::Dae;
use super::error_weights::ErrorWeights;
use super::evaluation_counter::CountedDae;
use super::failure::Cause;
use super::implicit_stepper::{ImplicitScheme, ImplicitStepper};
use super::implicit_steps::ImplicitSteps;
use super::interpolant::HERMITE;
use super::step_control::StepControl;
use super::step_size::{least_step, Control, StepSize, KEEP};
use super::stepper::{BoxedStepper, ImplicitMethod};
use crate::math::Listed;

/// Order of the error estimate.
const ERROR_ORDER: i32 = 2;
/// Fraction of the first step over which the rate of the accelerations is computed.
const PROBE: f64 = 1e-3;
/// Factor on the step after a trial without convergence.
const SHORTEN: f64 = 0.25;
/// Largest growth of a step. A step damps a stiff motion by the factor ρ, and a longer step must not amplify it more
/// than that.
const GROWTH: f64 = 1.5;

/// The generalized-α method with its options.
#[derive(Clone, Debug, PartialEq)]
pub struct GeneralizedAlpha {
    /// Parameters of the method.
    pub parameters: AlphaParameters,
    /// Tolerances and steps.
    pub control: StepControl,
}

impl GeneralizedAlpha {
    /// The method with step control and no bounds on steps.
    pub fn new(parameters: AlphaParameters, rtol: f64, atol: f64) -> Self {
        Self { parameters, control: StepControl::new(rtol, atol) }
    }

    /// The method with a constant step. Newton's iteration converges to `rtol` and `atol`.
    pub fn constant(parameters: AlphaParameters, step: f64, rtol: f64, atol: f64) -> Self {
        let control = StepControl { step: Some(step), ..StepControl::new(rtol, atol) };
        Self { parameters, control }
    }

    fn check<E>(&self) -> Result<(), Cause<E>> {
        let AlphaParameters { alpha_m, alpha_f, beta, gamma } = self.parameters;
        // the method has order 2; index 3 requires damping at infinite frequency (α_m < α_f)
        let holds = alpha_m < alpha_f && alpha_f < 1.0 && beta > 0.0 && gamma > 0.0;
        require(holds, "alpha_m", alpha_m, "below alpha_f, and alpha_f below 1")
    }
}

/// State of the method between steps.
struct AlphaProgress {
    step: AlphaStep,
    /// The size of the next trial step. None before the derivative at the start was evaluated.
    size: Option<StepSize>,
    /// The rates of the powers at the beginning of the step.
    power_slopes: Vec<f64>,
}

impl AlphaProgress {
    /// The change of one quadrature in a step, by the trapezoidal rule.
    fn work(&self, k: usize, h: f64) -> f64 {
        0.5 * h * (self.step.start.powers[k] + self.step.end.powers[k])
    }

    /// Computes the powers at the end of the step. The multipliers of a step so short that its corrections are
    /// rounding errors are worthless; those of the accelerations at its end take their place.
    fn set_powers<Y: Dae + ?Sized>(
        &mut self,
        dae: &mut CountedDae<'_, Y>,
        (t, h): (f64, f64),
        scale: &mut ErrorWeights,
    ) -> Result<(), Cause<Y::Stop>> {
        self.step.evaluate(dae, t + h);
        if self.step.rounding(h, scale) > PART {
            let mut end = self.step.end.clone();
            dae.accelerate(t + h, &mut end)?;
            self.step.end.powers.copy_from_slice(&end.powers);
        }
        Ok(())
    }

    /// The error h³/12 P̈ of this rule.
    fn work_error(&self, k: usize, h: f64) -> f64 {
        let AlphaStep { start, end, h_before, .. } = &self.step;
        let slope = (end.powers[k] - start.powers[k]) / h;
        h * h * h / 12.0 * (slope - self.power_slopes[k]) / (0.5 * (h + h_before))
    }
}

impl ImplicitMethod for GeneralizedAlpha {
    fn start<Y: Dae + ?Sized>(
        &self,
        system: &Y,
        span: (f64, f64),
        y: &[f64],
    ) -> Result<BoxedStepper<Y, Y::Stop>, Cause<Y::Stop>> {
        self.check()?;
        let lengths = system.lengths();
        let state = AlphaProgress {
            step: AlphaStep::new(self.parameters, lengths),
            size: None,
            power_slopes: vec![0.0; lengths.quadratures],
        };
        ImplicitStepper::start(self.control.clone(), lengths, span, y, state)
    }
}

impl ImplicitScheme for AlphaProgress {
    const ROWS: usize = 3;
    const DEGREE: usize = 4;

    fn table() -> &'static [f64] {
        &HERMITE
    }

    fn next<Y: Dae + ?Sized>(
        stepper: &mut AlphaStepper,
        dae: &mut CountedDae<'_, Y>,
    ) -> Result<(), Cause<Y::Stop>> {
        let mut size = match stepper.method.size.take() {
            Some(size) => size,
            None => stepper.begin(dae)?,
        };
        let taken = dae.check_count(&stepper.control).and_then(|()| match stepper.grid {
            Some(_) => stepper.constant_step(dae),
            None => stepper.accepted_step(dae, &mut size),
        });
        stepper.method.size = Some(size);
        stepper.finish(dae, taken?)
    }

    fn size(&self) -> Option<f64> {
        self.size.as_ref().map(|size| size.size)
    }

    fn forget(&mut self) -> Option<f64> {
        self.step.forget();
        self.power_slopes.fill(0.0);
        self.size.take().map(|size| size.size)
    }
}

type AlphaStepper = ImplicitStepper<AlphaProgress>;

impl AlphaStepper {
    /// Evaluates the derivative at the start, chooses the first step, and sets the initial deviations that order 2
    /// requires.
    fn begin<Y: Dae + ?Sized>(
        &mut self,
        dae: &mut CountedDae<'_, Y>,
    ) -> Result<StepSize, Cause<Y::Stop>> {
        let Self { method, control, scale, steps, .. } = self;
        let AlphaStep { start, end, .. } = &mut method.step;
        let first = dae.start(control, steps, (start, end), scale, ERROR_ORDER)?;
        self.begin_rates(dae, first.copysign(self.steps.direction()))?;
        Ok(StepSize::new(first, ERROR_ORDER, Control::ELEMENTARY))
    }

    /// Sets a for t + Δ h and velocities that deviate from the constraints by h² C_q v̈. A difference of
    /// accelerations gives v̈. Its tangential part is filtered, so that stiff forces do not make it large. The states
    /// z are treated in the same way.
    fn begin_rates<Y: Dae + ?Sized>(
        &mut self,
        dae: &mut CountedDae<'_, Y>,
        h: f64,
    ) -> Result<(), Cause<Y::Stop>> {
        let delta = PROBE * h;
        let AlphaProgress { step, power_slopes, .. } = &mut self.method;
        let t = self.steps.t;
        let (start, end) = (&mut step.start, &mut step.end);
        for i in 0..start.q.len() {
            end.q[i] = start.q[i] + delta * (start.v[i] + 0.5 * delta * start.a[i]);
            end.v[i] = start.v[i] + delta * start.a[i];
        }
        for i in 0..start.z.len() {
            end.z[i] = start.z[i] + delta * start.dz[i];
        }
        dae.accelerate(t + delta, end)?;
        let difference = |new: &[f64], old: &[f64]| -> Vec<f64> {
            new.iter().zip(old).map(|(new, old)| (new - old) / delta).list()
        };
        let mut normal = difference(&end.a, &start.a);
        let mut of_z = difference(&end.dz, &start.dz);
        let of_powers = difference(&end.powers, &start.powers);
        if normal.iter().chain(&of_z).any(|x| !x.is_finite()) {
            return Ok(()); // the first steps then only have a lower order
        }
        let mut along = normal.clone();
        dae.begin(t, start)?;
        dae.system.normal(&mut normal);
        along.iter_mut().zip(&normal).for_each(|(along, normal)| *along -= normal);
        if !step.factor_at_start(dae, t, h) {
            return Ok(());
        }
        step.filter(dae, &mut along, &mut of_z);
        let (p, p_z) = (step.parameters, step.of_states);
        for i in 0..along.len() {
            let rate = along[i] + normal[i];
            step.carried[0].slope[i] = rate;
            step.carried[0].shift[i] = p.shift() * rate;
            step.normal[i] = p.position_error() * normal[i];
        }
        for (i, rate) in of_z.into_iter().enumerate() {
            step.carried[1].slope[i] = rate;
            step.carried[1].shift[i] = p_z.shift() * rate;
        }
        *power_slopes = of_powers;
        Ok(())
    }

    /// Takes the next step of constant length; the last step may be shorter. Returns its end time.
    fn constant_step<Y: Dae + ?Sized>(
        &mut self,
        dae: &mut CountedDae<'_, Y>,
    ) -> Result<f64, Cause<Y::Stop>> {
        let t = self.steps.t;
        let Some(grid) = &mut self.grid else { unreachable!("a constant step") };
        let t_new = grid.next(t)?;
        let h = t_new - t;
        if self.attempt(dae, h) {
            return Ok(t_new);
        }
        Err(self.gave_up(dae, h.abs()))
    }

    /// Tries steps until one is accepted. Returns its end time.
    fn accepted_step<Y: Dae + ?Sized>(
        &mut self,
        dae: &mut CountedDae<'_, Y>,
        size: &mut StepSize,
    ) -> Result<f64, Cause<Y::Stop>> {
        let (t, t_end, direction) = (self.steps.t, self.steps.t_end, self.steps.direction());
        let least = least_step(t, direction);
        size.begin(least, self.control.max_step);
        let mut unsolved = false;
        loop {
            if size.size < least {
                let h = size.size;
                let cause = Cause::StepTooSmall { t, h };
                return Err(if unsolved { self.gave_up(dae, h) } else { cause });
            }
            let mut t_new = t + size.size * direction;
            if direction * (t_new - t_end) >= 0.0 {
                t_new = t_end;
            }
            let h = t_new - t;
            unsolved = !self.attempt(dae, h);
            if unsolved {
                size.size = SHORTEN * h.abs();
            } else {
                let norm = self.method.step.error(dae, h, &self.scale);
                let norm = norm.max(self.quadrature_norm(dae, (t, h))?);
                if norm < 1.0 {
                    let current = size.size;
                    let wanted = if t_new == t_end { size.size } else { 0.0 };
                    size.accept(h.abs(), norm);
                    size.size = size.size.min(GROWTH * h.abs()).max(wanted);
                    if t_new != t_end && (current..KEEP * current).contains(&size.size) {
                        size.size = current;
                    }
                    return Ok(t_new);
                }
                size.reject(h.abs(), norm);
            }
            dae.counts.rejected += 1;
        }
    }

    /// The error norm of the quadratures; 0 if they need no test of their own.
    fn quadrature_norm<Y: Dae + ?Sized>(
        &mut self,
        dae: &mut CountedDae<'_, Y>,
        (t, h): (f64, f64),
    ) -> Result<f64, Cause<Y::Stop>> {
        let Self { method, steps, lengths, scale, .. } = self;
        let old = steps.y[lengths.controlled()..].iter().enumerate();
        let works: Vec<f64> = old.map(|(k, work)| work + method.work(k, h)).collect();
        let Some(size) = dae.system.quadrature_scale(&works) else { return Ok(0.0) };
        method.set_powers(dae, (t, h), scale)?;
        Ok(scale.of_quadratures(size, (0..works.len()).map(|k| method.work_error(k, h))))
    }

    /// Tries one step. Returns whether its equations were solved.
    fn attempt<Y: Dae + ?Sized>(&mut self, dae: &mut CountedDae<'_, Y>, h: f64) -> bool {
        let step = &mut self.method.step;
        step.advance(dae, (self.steps.t, h), &mut self.scale) && step.finite()
    }

    /// The reason why no step of length `h` was found.
    fn gave_up<Y: Dae + ?Sized>(&self, dae: &mut CountedDae<'_, Y>, h: f64) -> Cause<Y::Stop> {
        let (t, step) = (self.steps.t, &self.method.step);
        dae.unsolved(step.singular, t, &step.start, Cause::Newton { t, h })
    }

    /// Projects the accepted state onto the constraints.
    fn finish<Y: Dae + ?Sized>(
        &mut self,
        dae: &mut CountedDae<'_, Y>,
        t_new: f64,
    ) -> Result<(), Cause<Y::Stop>> {
        let h = t_new - self.steps.t;
        self.method.step.project(dae, (self.steps.t, h))?;
        let Self { method, steps, lengths, scale, .. } = self;
        method.set_powers(dae, (steps.t, h), scale)?;
        let ImplicitSteps { y, y_new, dy, rows, .. } = steps;
        if !method.step.finite() {
            return Err(Cause::NotFinite { t: t_new });
        }
        let len = lengths.total();
        method.step.end.write(y_new);
        for (k, w) in (lengths.controlled()..len).enumerate() {
            y_new[w] = y[w] + method.work(k, h);
        }
        let AlphaProgress { step, power_slopes, .. } = method;
        for (slope, (new, old)) in
            power_slopes.iter_mut().zip(step.end.powers.iter().zip(&step.start.powers))
        {
            *slope = (new - old) / h;
        }
        let (dy_old, dy_new) = dy.split_at_mut(len);
        step.start.derivative(dy_old);
        step.end.derivative(dy_new);
        rows[..2 * len].copy_from_slice(dy);
        for ((chord, new), old) in rows[2 * len..].iter_mut().zip(y_new.iter()).zip(y.iter()) {
            *chord = (new - old) / h;
        }
        step.move_on(h);
        steps.accept(t_new);
        dae.counts.steps += 1;
        Ok(())
    }
}
