//! The stepper of the explicit Runge–Kutta methods. It tries a step, tests the error, and accepts or shortens the
//! step.
//!
//! With the elementary controller it takes the same steps as `scipy.integrate.solve_ivp`, so that step counts can be
//! compared.

use super::explicit_work::{Accepted, InterpolantLevel, Work};
use super::failure::Cause;
use super::fixed_step::Grid;
use super::hermite_birkhoff::HermiteBirkhoff;
#[cfg(not(target_arch = "wasm32"))]
use super::lane_steps::SideBySide;
use super::ode::Ode;
use super::right_hand_side::RightHandSide;
use super::runge_kutta::RungeKutta;
use super::stages::{combine, row_mut, rows_mut};
use super::statistics::StepCounts;
use super::step::Step;
use super::step_control::StepControl;
use super::step_placement::StepPlacement;
use super::step_size::{initial_step, least_step, probing_step, StepSize};
use super::stepper::{BoxedStepper, ExplicitMethod, Stepper};
use super::trial::Trial;
use crate::math::{Lanes, Real};
use std::marker::PhantomData;

/// Number of rejected steps that ends an integration with `max_steps`, or half of `max_steps` if that is larger.
const MANY: usize = 10_000;

/// Relative error of a step above which projection cannot be relied on to remove the normal part.
const FAR: f64 = 1e-1;

/// The end of a trial step, and whether the end of the integration shortened the step.
#[derive(Clone, Copy)]
pub(super) struct Proposal {
    pub t_new: f64,
    pub shortened: bool,
}

/// The state of an integration by the method `P`.
pub(super) struct ExplicitStepper<P> {
    pub(super) control: StepControl,
    /// The ends of constant steps.
    pub(super) grid: Option<Grid>,
    pub(super) n: usize,
    /// The beginning of the step.
    pub(super) t: f64,
    pub(super) t_end: f64,
    /// The size of the next trial step. None before the first derivative was evaluated.
    pub(super) size: Option<StepSize>,
    pub(super) accepted: Option<Accepted>,
    pub(super) counts: StepCounts,
    pub(super) placement: StepPlacement,
    /// Whether the last trial was rejected, so that the next trial belongs to the same step.
    pub(super) rejected_before: bool,
    pub(super) work: Work,
    method: PhantomData<P>,
}

impl<P: RungeKutta> ExplicitMethod for P {
    fn start<Y: Ode>(
        &self,
        system: &Y,
        (t0, t_end): (f64, f64),
        y: &[f64],
    ) -> Result<BoxedStepper<Y, Y::Stop>, Cause<Y::Stop>> {
        let control = self.control().usable();
        let n = system.len();
        Ok(Box::new(ExplicitStepper::<P> {
            grid: control.begin((t0, t_end), (y, n), system.structure().controlled())?,
            work: Work::new::<P>(system, &control, y),
            control,
            n,
            t: t0,
            t_end,
            size: None,
            accepted: None,
            counts: StepCounts::default(),
            placement: StepPlacement::default(),
            rejected_before: false,
            method: PhantomData,
        }))
    }
}

impl<P: RungeKutta, Y: Ode> Stepper<Y, Y::Stop> for ExplicitStepper<P> {
    fn step(&mut self, system: &mut Y) -> Result<(), Cause<Y::Stop>> {
        self.move_on();
        assert!(self.t != self.t_end, "a step beyond t_end");
        let mut rhs = RightHandSide { system, evaluations: self.counts.evaluations };
        let outcome = self.next(&mut rhs);
        self.counts.evaluations = rhs.evaluations;
        outcome
    }

    #[inline]
    fn prepare_interpolant(&mut self, system: &mut Y) -> Result<(), Cause<Y::Stop>> {
        let mut rhs = RightHandSide { system, evaluations: self.counts.evaluations };
        let outcome = self.extend(&mut rhs);
        self.counts.evaluations = rhs.evaluations;
        outcome
    }

    #[inline]
    fn last_step(&self) -> Option<Step<'_>> {
        self.accepted.map(|accepted| self.view(accepted))
    }

    #[inline]
    fn t(&self) -> f64 {
        self.accepted.map_or(self.t, |accepted| accepted.t)
    }

    #[inline]
    fn t_end(&self) -> f64 {
        self.t_end
    }

    #[inline]
    fn y(&self) -> &[f64] {
        let Work { y, y_new, .. } = &self.work;
        &(if self.accepted.is_some() { y_new } else { y }).as_flattened()[..self.n]
    }

    fn next_size(&self) -> Option<f64> {
        self.size.as_ref().map(|size| size.size)
    }

    fn restart_until(&mut self, t: f64, y: &[f64], t_end: f64) -> Result<(), Cause<Y::Stop>> {
        let controlled = self.work.tolerances.controlled;
        self.grid = self.control.restart((t, t_end), (y, self.n), controlled)?;
        self.t_end = t_end;
        if let Some(size) = &self.size {
            self.control.first_step = Some(size.size);
        }
        (self.t, self.size, self.accepted) = (t, None, None);
        self.placement = StepPlacement::default();
        self.rejected_before = false;
        self.work.y.as_flattened_mut()[..self.n].copy_from_slice(y);
        self.work.hermite_birkhoff.iter_mut().for_each(HermiteBirkhoff::forget);
        Ok(())
    }

    #[inline]
    fn statistics(&self) -> StepCounts {
        self.counts
    }

    #[cfg(not(target_arch = "wasm32"))]
    fn side_by_side(&mut self) -> Option<&mut dyn SideBySide> {
        Some(self)
    }
}

impl<P: RungeKutta> ExplicitStepper<P> {
    #[inline]
    fn direction(&self) -> f64 {
        (self.t_end - self.t).signum()
    }

    /// Takes the next accepted step.
    fn next<Y: Ode>(&mut self, rhs: &mut RightHandSide<'_, Y>) -> Result<(), Cause<Y::Stop>> {
        let mut size = match self.size.take() {
            Some(size) => size,
            None => self.begin(rhs)?,
        };
        let taken = match self.grid {
            Some(_) => self.constant_step(rhs),
            None => self.check_counts(&size).and_then(|()| self.accepted_step(rhs, &mut size)),
        };
        self.size = Some(size);
        let (t, projected) = taken?;
        self.counts.steps += 1;
        let accepted = Accepted { t, projected, interpolant: InterpolantLevel::Plain };
        self.measure(accepted);
        self.accepted = Some(accepted);
        Ok(())
    }

    /// Evaluates the derivative at the start and chooses the first step.
    fn begin<Y: Ode>(
        &mut self,
        rhs: &mut RightHandSide<'_, Y>,
    ) -> Result<StepSize, Cause<Y::Stop>> {
        let Work { k, y, width, .. } = &mut self.work;
        rhs.at(self.t, y, row_mut(k, *width, 0))?;
        let first = match (&self.grid, self.control.first_step) {
            (Some(_), _) => 0.0,
            (None, Some(h)) => h,
            (None, None) => self.first_step(rhs)?,
        };
        Ok(StepSize::new(first, P::ERROR_ORDER, P::CONTROL))
    }

    pub(super) fn check_counts<E>(&self, size: &StepSize) -> Result<(), Cause<E>> {
        let Some(most) = self.control.max_steps else { return Ok(()) };
        let StepCounts { steps, rejected, .. } = self.counts;
        if steps >= most {
            return Err(Cause::MaxSteps { steps });
        }
        if rejected >= (most / 2).max(MANY) {
            return Err(Cause::StepTooSmall { t: self.t, h: size.size });
        }
        Ok(())
    }

    /// Takes a step of constant length, whatever its error.
    #[inline]
    fn constant_step<Y: Ode>(
        &mut self,
        rhs: &mut RightHandSide<'_, Y>,
    ) -> Result<(f64, bool), Cause<Y::Stop>> {
        let Some(grid) = &mut self.grid else { unreachable!("a constant step") };
        let t_new = grid.next(self.t)?;
        self.advance(rhs, t_new)?;
        let projected = self.settle(rhs, t_new)??;
        Ok((t_new, projected))
    }

    /// Hairer's choice of the first step. It takes one evaluation.
    fn first_step<Y: Ode>(
        &mut self,
        rhs: &mut RightHandSide<'_, Y>,
    ) -> Result<f64, Cause<Y::Stop>> {
        let (interval, direction) = ((self.t_end - self.t).abs(), self.direction());
        let most = interval.min(self.control.max_step);
        let Work { width, k, y, trial, tolerances, .. } = &mut self.work;
        if tolerances.controlled == 0 {
            return Ok(most);
        }
        let [f0, f1] = rows_mut(k, *width);
        let d0 = tolerances.norm(y, |i| Lanes::new(y[i]));
        let d1 = tolerances.norm(y, |i| Lanes::new(f0[i]));
        let h0 = probing_step(d0, d1, interval);
        combine(y, Lanes::constant(h0 * direction), [1.0], [f0], trial);
        match rhs.at(self.t + h0 * direction, trial, f1) {
            Ok(()) => {}
            // the probe left the domain; it becomes the first trial step, which is then rejected and shortened
            Err(Cause::NotFinite { .. }) => return Ok(h0.min(most)),
            Err(stop) => return Err(stop),
        }
        let d2 = tolerances.norm(y, |i| Lanes::new(f1[i]) - Lanes::new(f0[i])) / h0;
        Ok(initial_step(h0, d1, d2, P::ERROR_ORDER).min(most))
    }

    /// Tries steps until the error test and the system accept one. Returns its end time and whether projection
    /// changed the state.
    fn accepted_step<Y: Ode>(
        &mut self,
        rhs: &mut RightHandSide<'_, Y>,
        size: &mut StepSize,
    ) -> Result<(f64, bool), Cause<Y::Stop>> {
        self.begin_trials(size);
        let mut refusal = None;
        loop {
            let Some(Proposal { t_new, shortened }) = self.proposal(size) else {
                return Err(refusal.unwrap_or(Cause::StepTooSmall { t: self.t, h: size.size }));
            };
            let h = t_new - self.t;
            let trial = self.attempt(rhs, t_new).map(|norm| self.tangential(rhs, norm, h));
            let norm = trial.as_ref().map_or(f64::NAN, |norm| *norm);
            let at_best = self.placement.at_best(norm, self.control.rtol);
            let placed = self.placed(rhs, t_new).filter(|_| !at_best);
            match trial {
                Err(stop @ Cause::Equations { .. }) => return Err(stop),
                _ if placed.is_some() => size.size = placed.unwrap_or(size.size),
                Ok(norm) if norm < 1.0 || at_best => match self.settle(rhs, t_new)? {
                    Ok(projected) => {
                        self.resize(size, Proposal { t_new, shortened }, norm);
                        return Ok((t_new, projected));
                    }
                    Err(cause) => {
                        match cause {
                            Cause::NotFinite { .. } => size.reject(h.abs(), f64::NAN),
                            _ => size.refuse(h.abs()),
                        }
                        refusal = Some(cause);
                    }
                },
                Ok(norm) => {
                    refusal = None;
                    size.reject(h.abs(), norm);
                }
                Err(cause) => {
                    refusal = Some(cause);
                    size.reject(h.abs(), f64::NAN);
                }
            }
            self.counts.rejected += 1;
        }
    }

    /// Prepares the step size for the first trial of a step.
    #[inline]
    pub(super) fn begin_trials(&mut self, size: &mut StepSize) {
        if !std::mem::take(&mut self.rejected_before) {
            size.begin(least_step(self.t, self.direction()), self.control.max_step);
            self.placement.begin();
            size.control = self.placement.control(P::CONTROL);
        }
    }

    /// The trial step of the present size. None if the size is too small.
    pub(super) fn proposal(&self, size: &StepSize) -> Option<Proposal> {
        let direction = self.direction();
        if size.size < least_step(self.t, direction) {
            return None;
        }
        let t_new = self.t + size.size * direction;
        let shortened = direction * (t_new - self.t_end) > 0.0;
        Some(Proposal { t_new: if shortened { self.t_end } else { t_new }, shortened })
    }

    /// Chooses the size of the next step after an accepted step.
    #[inline]
    pub(super) fn resize(
        &self,
        size: &mut StepSize,
        Proposal { t_new, shortened }: Proposal,
        norm: f64,
    ) {
        let wanted = if shortened { size.size } else { 0.0 };
        size.accept((t_new - self.t).abs(), norm);
        size.size = self.placement.resume(size.size).max(wanted);
    }

    /// The step to try instead of the step to `t_new`, so that no stage is near a time to avoid.
    #[inline]
    fn placed<Y: Ode>(&mut self, rhs: &mut RightHandSide<'_, Y>, t_new: f64) -> Option<f64> {
        let avoid = rhs.system.times_to_avoid()?.next(t_new)?;
        let [h, left] = [(t_new - self.t).abs(), (self.t_end - self.t).abs()];
        let left = left.min(self.control.max_step);
        self.placement.instead(P::GAP, h, self.direction() * (avoid - self.t), left)
    }

    /// Takes a trial step to `t_new` and returns its error norm.
    #[inline]
    fn attempt<Y: Ode>(
        &mut self,
        rhs: &mut RightHandSide<'_, Y>,
        t_new: f64,
    ) -> Result<f64, Cause<Y::Stop>> {
        self.advance(rhs, t_new)?;
        let Work { k, y, y_new, tolerances, .. } = &self.work;
        let squares = P::error_squares(k, [y, y_new], tolerances);
        let norm = P::error_norm(t_new - self.t, squares, tolerances.components());
        let norm = norm.max(self.quadrature_norm(rhs, t_new - self.t));
        Ok(self.placement.strictness() * norm)
    }

    /// The error norm of the quadratures; 0 if they need no test of their own.
    #[inline]
    fn quadrature_norm<Y: Ode>(&self, rhs: &mut RightHandSide<'_, Y>, h: f64) -> f64 {
        let Work { k, y, y_new, quadratures, .. } = &self.work;
        let end = &y_new.as_flattened()[..self.n];
        let Some(scale) = rhs.system.quadrature_scale(end) else { return 0.0 };
        let squares = P::error_squares(k, [y, y_new], quadratures);
        P::error_norm(h, squares, quadratures.components()) / scale
    }

    /// Computes the stages of a step to `t_new` and the state at `t_new`.
    fn advance<Y: Ode>(
        &mut self,
        rhs: &mut RightHandSide<'_, Y>,
        t_new: f64,
    ) -> Result<(), Cause<Y::Stop>> {
        let Work { width, k, y, y_new, trial, hermite_birkhoff, .. } = &mut self.work;
        if rhs.before_trial(self.t, t_new - self.t, y, row_mut(k, *width, 0))? {
            hermite_birkhoff.iter_mut().for_each(HermiteBirkhoff::forget);
        }
        P::advance(&mut Trial::new(rhs, (self.t, t_new), y, trial), k, y_new)?;
        if !P::LAST_IN_ERROR && rhs.system.times_to_avoid().is_some_and(|avoid| avoid.may_be_near())
        {
            rhs.at(t_new, y_new, row_mut(k, *width, P::STAGES - 1))?;
        }
        Ok(())
    }

    /// The error norm of a rejected step, computed from its tangential error alone if that is smaller.
    ///
    /// Because the manifold is curved, projection may end on another branch where the relative error exceeds [`FAR`].
    /// The whole error counts there.
    fn tangential<Y: Ode>(&mut self, rhs: &mut RightHandSide<'_, Y>, norm: f64, h: f64) -> f64 {
        let farthest = self.placement.strictness() * FAR / self.control.rtol;
        if norm < 1.0 || !norm.is_finite() || norm > farthest {
            return norm;
        }
        let Some(manifold) = rhs.system.manifold() else { return norm };
        let Work { width, k, y, y_new, tangential, tolerances, .. } = &mut self.work;
        tangential.clear();
        tangential.extend_from_slice(&k[..P::STAGES * *width]);
        let mut rows = tangential.chunks_exact_mut(*width);
        if !rows.all(|dy| manifold.project_error(&mut dy.as_flattened_mut()[..self.n])) {
            return norm;
        }
        let squares = P::error_squares(tangential, [y, y_new], tolerances);
        let left = P::error_norm(h, squares, tolerances.components());
        norm.min(self.placement.strictness() * left)
    }
}
