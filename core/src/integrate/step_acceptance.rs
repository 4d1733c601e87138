//! Completion of an accepted step: projection, the derivative at its end, and its interpolant.

use super::explicit_stepper::ExplicitStepper;
use super::explicit_work::{Accepted, InterpolantLevel, Work};
use super::failure::Cause;
use super::hermite_birkhoff::{Ends, INSIDE};
use super::interpolant::{Interpolant, HERMITE};
use super::ode::Ode;
use super::right_hand_side::{all_finite, RightHandSide};
use super::runge_kutta::RungeKutta;
use super::stages::{chord, row, row_mut};
use super::step::Step;
use super::trial::Trial;
use crate::math::{each, Lanes};
use std::mem::swap;

/// Whether projection changed the state. The inner error requires a shorter step; the outer error ends the
/// integration.
type Settled<E> = Result<Result<bool, Cause<E>>, Cause<E>>;

impl<P: RungeKutta> ExplicitStepper<P> {
    /// Projects the accepted state and evaluates its derivative, unless the derivative is known.
    pub(super) fn settle<Y: Ode>(
        &mut self,
        rhs: &mut RightHandSide<'_, Y>,
        t_new: f64,
    ) -> Settled<Y::Stop> {
        let Work { width, k, y_new, trial, .. } = &mut self.work;
        let mut projected = false;
        if let Some(manifold) = rhs.system.manifold() {
            trial.copy_from_slice(y_new);
            match manifold.project(t_new, &mut y_new.as_flattened_mut()[..self.n]) {
                Ok(changed) => projected = changed,
                Err(error) => return Ok(Err(Cause::Equations { t: t_new, error })),
            }
        }
        if projected {
            if !all_finite(y_new.as_flattened()) {
                return Err(Cause::NotFinite { t: t_new });
            }
            chord(trial, y_new, t_new - self.t, row_mut(k, *width, P::STAGES + P::EXTRA));
        }
        if projected || !P::LAST_IN_ERROR {
            let row = last_row::<P>(projected);
            match rhs.at_accepted(projected, t_new, y_new, row_mut(k, *width, row)) {
                Ok(()) => {}
                Err(cause @ Cause::NotFinite { .. }) => return Ok(Err(cause)),
                Err(stop) => return Err(stop),
            }
        }
        if let Some(avoid) = rhs.system.times_to_avoid() {
            avoid.on_accepted_end(t_new);
        }
        Ok(Ok(projected))
    }

    /// The last accepted step.
    pub(super) fn view(&self, accepted: Accepted) -> Step<'_> {
        let Work { width, k, y, y_new, hermite_birkhoff, .. } = &self.work;
        let table = |table| {
            let rows = P::STAGES + P::EXTRA + usize::from(accepted.projected);
            let stages = k[..rows * *width].as_flattened();
            Interpolant::new(stages, Lanes::WIDTH * *width, table, P::DEGREE)
        };
        let interpolant = match (accepted.interpolant, hermite_birkhoff) {
            (InterpolantLevel::HermiteBirkhoff, Some(it)) => it.interpolant(),
            (InterpolantLevel::Extended, _) => table(P::TABLE),
            (InterpolantLevel::Ends, _) => {
                let rows = k[..3 * *width].as_flattened();
                Interpolant::new(rows, Lanes::WIDTH * *width, &HERMITE, 4)
            }
            _ => table(P::WITHOUT_EXTRA),
        };
        let derivatives = each([0, last_row::<P>(accepted.projected)], |s| row(k, *width, s));
        let ends = Ends::new(accepted.t - self.t, [y, y_new], derivatives, self.n);
        let Ends { y_old, y, dy_old, dy, .. } = ends;
        Step { t_old: self.t, t: accepted.t, y_old, y, dy_old, dy, interpolant }
    }

    /// Computes the integrals of the rates over the step, for the Hermite–Birkhoff interpolants of this step and the
    /// next.
    #[inline]
    pub(super) fn measure(&mut self, accepted: Accepted) {
        let Work { width, k, y, y_new, hermite_birkhoff, .. } = &mut self.work;
        let Some(hermite_birkhoff) = hermite_birkhoff else { return };
        let derivatives = each([0, last_row::<P>(accepted.projected)], |s| row(k, *width, s));
        let ends = Ends::new(accepted.t - self.t, [y, y_new], derivatives, self.n);
        hermite_birkhoff.measure(ends, P::DOUBLE_QUADRATURE, k);
    }

    /// Evaluates the extra stages of the interpolant, if there are any. If they are not finite, the interpolant has a
    /// lower order.
    pub(super) fn extend<Y: Ode>(
        &mut self,
        rhs: &mut RightHandSide<'_, Y>,
    ) -> Result<(), Cause<Y::Stop>> {
        let (true, Some(accepted)) = (P::EXTRA > 0, &mut self.accepted) else { return Ok(()) };
        if accepted.interpolant != InterpolantLevel::Plain {
            return Ok(());
        }
        let Work { width, k, y, y_new, trial, hermite_birkhoff, .. } = &mut self.work;
        let (n, h) = (self.n, accepted.t - self.t);
        let outcome = match hermite_birkhoff.as_mut().filter(|it| it.serves(h)) {
            Some(hermite_birkhoff) => {
                let (stages, extra) = k.split_at_mut(P::STAGES * *width);
                let derivatives = each([0, P::STAGES - 1], |s| row(stages, *width, s));
                let ends = Ends::new(h, [y, y_new], derivatives, n);
                hermite_birkhoff.predict(ends, &mut trial.as_flattened_mut()[..n]);
                let inside = row_mut(extra, *width, 0);
                let outcome = rhs.at(self.t + INSIDE * h, trial, inside);
                outcome.map(|()| {
                    hermite_birkhoff.complete(ends, &inside.as_flattened()[..n]);
                    InterpolantLevel::HermiteBirkhoff
                })
            }
            None => {
                let trial = &mut Trial::new(rhs, (self.t, accepted.t), y, trial);
                P::extend(trial, k).map(|()| InterpolantLevel::Extended)
            }
        };
        match outcome {
            Ok(prepared) => accepted.interpolant = prepared,
            Err(Cause::NotFinite { .. }) => {
                // zero instead of NaN, since zero times NaN is NaN
                k[P::STAGES * *width..(P::STAGES + P::EXTRA) * *width].fill([0.0; Lanes::WIDTH]);
            }
            Err(stop) => return Err(stop),
        }
        Ok(())
    }

    /// Advances to the beginning of the next step.
    pub(super) fn move_on(&mut self) {
        let Some(accepted) = self.accepted.take() else { return };
        let Work { width, k, y, y_new, hermite_birkhoff, .. } = &mut self.work;
        let last = last_row::<P>(accepted.projected);
        if let Some(hermite_birkhoff) = hermite_birkhoff {
            let derivatives = each([0, last], |s| row(k, *width, s));
            let ends = Ends::new(accepted.t - self.t, [y, y_new], derivatives, self.n);
            hermite_birkhoff.remember(ends);
        }
        swap(y, y_new);
        // block by block: a copy of whole vectors would wait for recently stored blocks
        let (begin, others) = k.split_at_mut(*width);
        begin.iter_mut().zip(row_mut(others, *width, last - 1)).for_each(|(a, b)| swap(a, b));
        self.t = accepted.t;
    }
}

/// The row of the derivative at the end of a step. It is the last stage, or the row after the jump if the last stage
/// belongs to the state before a projection.
#[inline]
pub(super) fn last_row<P: RungeKutta>(projected: bool) -> usize {
    match projected && P::LAST_IN_ERROR {
        false => P::STAGES - 1,
        true => P::STAGES + P::EXTRA + 1,
    }
}
