//! Counts the evaluations of a DAE.

use super::dae::{ConstraintLevel, Dae, DaeResidual, DaeState, Iterate, NewtonCoefficients};
use super::error_weights::ErrorWeights;
use super::failure::Cause;
use super::implicit_state::ImplicitState;
use super::implicit_steps::ImplicitSteps;
use super::right_hand_side::all_finite;
use super::statistics::StepCounts;
use super::step_control::StepControl;
use super::step_size::{initial_step, probing_step};
use crate::math::{Complex, Listed, ShortArray};

/// A DAE with the counts of its evaluations.
pub(super) struct CountedDae<'a, Y: ?Sized> {
    pub system: &'a mut Y,
    pub counts: StepCounts,
}

impl<Y: Dae + ?Sized> CountedDae<'_, Y> {
    /// Computes the derivative of a state.
    pub fn accelerate(&mut self, t: f64, state: &mut ImplicitState) -> Result<(), Cause<Y::Stop>> {
        self.counts.evaluations += 1;
        let (at, out) = state.rates();
        self.system.accelerate(t, at, out).map_err(|error| Cause::Equations { t, error })
    }

    /// Computes the derivative of a state and checks that it is finite.
    pub fn begin(&mut self, t: f64, state: &mut ImplicitState) -> Result<(), Cause<Y::Stop>> {
        self.accelerate(t, state)?;
        match [&state.a, &state.lam, &state.dz].into_iter().all(|x| all_finite(x)) {
            true => Ok(()),
            false => Err(Cause::NotFinite { t }),
        }
    }

    /// Projects a state, as [`Dae::project`] does. Returns whether it changed.
    pub fn project(
        &mut self,
        t: f64,
        state: DaeState<'_>,
        velocities: bool,
    ) -> Result<bool, Cause<Y::Stop>> {
        let changed = self.system.project(t, state, velocities);
        changed.map_err(|error| Cause::Equations { t, error })
    }

    /// Sets the state at the start of an integration, and returns the magnitude of the first step.
    pub fn start(
        &mut self,
        control: &StepControl,
        steps: &ImplicitSteps,
        (start, probe): (&mut ImplicitState, &mut ImplicitState),
        weights: &mut ErrorWeights,
        error_order: i32,
    ) -> Result<f64, Cause<Y::Stop>> {
        start.set(&steps.y);
        self.begin(steps.t, start)?;
        if let Some(h) = control.step.or(control.first_step) {
            return Ok(h);
        }
        let first =
            self.first_step((steps.t, steps.t_end), (start, probe), weights, error_order)?;
        Ok(first.min(control.max_step))
    }

    /// Returns an error if the allowed number of steps was taken.
    pub fn check_count(&self, control: &StepControl) -> Result<(), Cause<Y::Stop>> {
        let steps = self.counts.steps;
        match control.max_steps.is_some_and(|most| steps >= most) {
            true => Err(Cause::MaxSteps { steps }),
            false => Ok(()),
        }
    }

    /// The reason why no step from a state was found: the error of the system if the matrix was singular, otherwise
    /// `other`.
    pub fn unsolved(
        &mut self,
        singular: bool,
        t: f64,
        start: &ImplicitState,
        other: Cause<Y::Stop>,
    ) -> Cause<Y::Stop> {
        let state = [&start.q[..], &start.v, &start.z];
        let error = if singular { self.system.singular(t, state) } else { None };
        error.map_or(other, |error| Cause::Equations { t, error })
    }

    /// Hairer's choice of the magnitude of the first step from `start`. It takes one evaluation.
    fn first_step(
        &mut self,
        (t, t_end): (f64, f64),
        (start, probe): (&ImplicitState, &mut ImplicitState),
        weights: &mut ErrorWeights,
        error_order: i32,
    ) -> Result<f64, Cause<Y::Stop>> {
        let interval = (t_end - t).abs();
        weights.set(start, start);
        let d0 = weights.norm(&start.q, &start.v, &start.z);
        let d1 = weights.norm(&start.v, &start.a, &start.dz);
        let h0 = probing_step(d0, d1, interval);
        let h = h0.copysign(t_end - t);
        for (to, from, rate) in [
            (&mut probe.q, &start.q, &start.v),
            (&mut probe.v, &start.v, &start.a),
            (&mut probe.z, &start.z, &start.dz),
        ] {
            let moved = from.iter().zip(rate).map(|(y, dy)| y + h * dy);
            to.iter_mut().zip(moved).for_each(|(to, y)| *to = y);
        }
        self.accelerate(t + h, probe)?;
        let change = |new: &[f64], old: &[f64]| -> Vec<f64> {
            new.iter().zip(old).map(|(new, old)| (new - old) / h0).list()
        };
        let [dv, da] = [(&probe.v, &start.v), (&probe.a, &start.a)].each(|(x, y)| change(x, y));
        let d2 = weights.norm(&dv, &da, &change(&probe.dz, &start.dz));
        if !d2.is_finite() {
            return Ok(h0);
        }
        Ok(initial_step(h0, d1, d2, error_order).min(interval))
    }

    pub fn residual(
        &mut self,
        t: f64,
        at: Iterate<'_>,
        level: ConstraintLevel,
        out: DaeResidual<'_>,
    ) {
        self.counts.evaluations += 1;
        self.system.residual(t, at, level, out);
    }

    pub fn linearize(&mut self, t: f64, at: Iterate<'_>) {
        self.counts.jacobians += 1;
        self.system.linearize(t, at);
    }

    /// Factorises the matrix. Returns false if it is singular.
    pub fn factor(&mut self, coefficients: NewtonCoefficients) -> bool {
        self.counts.factorisations += 1;
        self.system.factor(coefficients)
    }

    pub fn factor_complex(&mut self, coefficients: NewtonCoefficients<Complex>) -> bool {
        self.counts.factorisations += 1;
        self.system.factor_complex(coefficients)
    }
}
