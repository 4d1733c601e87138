//! Counts the evaluations of a DAE by an implicit method.

use super::dae::{ConstraintLevel, Dae, DaeResidual, Iterate, NewtonCoefficients};
use super::error_weights::ErrorWeights;
use super::failure::Cause;
use super::implicit_state::ImplicitState;
use super::ode::{Ended, Statistics};
use super::right_hand_side::all_finite;
use super::step_size::{initial_step, probing_step};
use crate::math::Complex;

/// A DAE with the counts of its evaluations.
pub(super) struct CountedDae<'a, Y> {
    pub system: &'a mut Y,
    pub counts: Statistics,
}

impl<'a, Y: Dae> CountedDae<'a, Y> {
    pub fn new(system: &'a mut Y, t: f64) -> Self {
        Self { system, counts: Statistics { ended: Ended::Stopped, ..Statistics::none(t) } }
    }

    /// Accelerations, multipliers and powers of a knot from its q and v.
    pub fn accelerate(&mut self, t: f64, state: &mut ImplicitState) -> Result<(), Y::Stop> {
        self.counts.evaluations += 1;
        let ImplicitState { q, v, a, lam, powers } = state;
        self.system.accelerate(t, [q, v], a, lam, powers)
    }

    /// The same where it has to be finite.
    pub fn begin(&mut self, t: f64, state: &mut ImplicitState) -> Result<(), Cause<Y::Stop>> {
        self.accelerate(t, state).map_err(Cause::Equations)?;
        if all_finite(&state.a) && all_finite(&state.lam) {
            Ok(())
        } else {
            Err(Cause::NotFinite { t })
        }
    }

    /// Hairer's choice of the magnitude of the first step from `start`, at the cost of one evaluation.
    pub fn first_step(
        &mut self,
        (t, t_end): (f64, f64),
        (start, probe): (&ImplicitState, &mut ImplicitState),
        scale: &mut ErrorWeights,
        error_order: i32,
    ) -> Result<f64, Y::Stop> {
        let interval = (t_end - t).abs();
        scale.set(start, start);
        let d0 = scale.norm(&start.q, &start.v);
        let d1 = scale.norm(&start.v, &start.a);
        let h0 = probing_step(d0, d1, interval);
        let h = h0.copysign(t_end - t);
        for i in 0..start.q.len() {
            probe.q[i] = start.q[i] + h * start.v[i];
            probe.v[i] = start.v[i] + h * start.a[i];
        }
        self.accelerate(t + h, probe)?;
        let change = |new: &[f64], old: &[f64]| -> Vec<f64> {
            new.iter().zip(old).map(|(new, old)| (new - old) / h0).collect()
        };
        let d2 = scale.norm(&change(&probe.v, &start.v), &change(&probe.a, &start.a));
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

    /// Whether the matrix has a factorisation.
    pub fn factor(&mut self, coefficients: NewtonCoefficients) -> bool {
        self.counts.factorisations += 1;
        self.system.factor(coefficients).is_ok()
    }

    pub fn factor_complex(&mut self, coefficients: NewtonCoefficients<Complex>) -> bool {
        self.counts.factorisations += 1;
        self.system.factor_complex(coefficients).is_ok()
    }
}
