//! What becomes of a step whose error is accepted: the system settles its end, the continuous extension gets
//! what it needs, and the observer sees it.

use super::adaptive::{Run, Work};
use super::embedded_pair::EmbeddedPair;
use super::failure::Cause;
use super::hermite_birkhoff::{Ends, INSIDE};
use super::interpolant::Interpolant;
use super::ode::{Flow, Observer, Ode, Step};
use super::right_hand_side::{all_finite, Trouble};
use super::stages::{chord, row, row_mut};
use crate::math::Lanes;
use std::mem::swap;

/// Whether the system changed the state; inside, why a shorter step is to be tried.
type Settled<E> = Result<Result<bool, Cause<E>>, Cause<E>>;

impl<Y: Ode, P: EmbeddedPair> Run<'_, Y, P> {
    /// Lets the system change the accepted state and evaluates the derivative there, where that is not
    /// known.
    pub(super) fn settle(&mut self, t_new: f64) -> Settled<Y::Stop> {
        let Work { width, k, y_new, trial, .. } = &mut self.work;
        trial.copy_from_slice(y_new);
        let y_projected = &mut y_new.as_flattened_mut()[..self.n];
        let projected = match self.rate.system.project_accepted(t_new, y_projected) {
            Ok(projected) => projected,
            Err(stop) => return Ok(Err(Cause::Equations(stop))),
        };
        if projected {
            if !all_finite(y_new.as_flattened()) {
                return Err(Cause::NotFinite { t: t_new });
            }
            chord(trial, y_new, t_new - self.t, row_mut(k, *width, P::STAGES + P::EXTRA));
        }
        if projected || !P::LAST_IN_ERROR {
            let row = last_row::<P>(projected);
            match self.rate.at_accepted(projected, t_new, y_new, row_mut(k, *width, row)) {
                Ok(()) => {}
                Err(Trouble::NotFinite(t)) => return Ok(Err(Cause::NotFinite { t })),
                Err(Trouble::Stop(stop)) => return Err(Cause::Equations(stop)),
            }
        }
        self.rate.system.on_accepted_end(t_new);
        Ok(Ok(projected))
    }

    /// Shows an accepted step to the observer, and moves on.
    pub(super) fn finish<O: Observer>(
        &mut self,
        t_new: f64,
        projected: bool,
        observer: &mut O,
    ) -> Result<Flow, Cause<Y::Stop>> {
        let last = last_row::<P>(projected);
        let extension = self.extend(t_new, last, observer)?;
        let Work { width, k, y, y_new, hermite_birkhoff, .. } = &mut self.work;
        let interpolant = match (extension, &hermite_birkhoff) {
            (None, Some(hermite_birkhoff)) => hermite_birkhoff.interpolant(),
            (table, _) => {
                let rows = P::STAGES + P::EXTRA + usize::from(projected);
                let (stages, table) = (&k[..rows * *width], table.unwrap_or(P::WITHOUT_EXTRA));
                Interpolant::new(stages.as_flattened(), Lanes::WIDTH * *width, table, P::DEGREE)
            }
        };
        let ends =
            Ends::new(t_new - self.t, [y, y_new], [0, last].map(|s| row(k, *width, s)), self.n);
        let Ends { y_old, y: y_end, dy_old, dy, .. } = ends;
        let step = Step { t_old: self.t, t: t_new, y_old, y: y_end, dy_old, dy, interpolant };
        let flow = observer.step(&step);
        if let Some(hermite_birkhoff) = hermite_birkhoff {
            hermite_birkhoff.remember(ends);
        }
        swap(y, y_new);
        // block by block: what a copy of all loads at once waits for blocks that were stored just now
        let (begin, others) = k.split_at_mut(*width);
        begin.iter_mut().zip(row_mut(others, *width, last - 1)).for_each(|(a, b)| swap(a, b));
        self.t = t_new;
        self.steps += 1;
        Ok(flow)
    }

    /// Evaluates what the extension needs, where the observer wants it and it can be had. The table that
    /// fits; none where there are polynomials. `last` is the row of the derivative at the end.
    fn extend<O: Observer>(
        &mut self,
        t_new: f64,
        last: usize,
        observer: &O,
    ) -> Result<Option<&'static [f64]>, Cause<Y::Stop>> {
        let Work { width, k, y, y_new, trial, hermite_birkhoff, .. } = &mut self.work;
        let (n, h) = (self.n, t_new - self.t);
        let (stages, extra) = k.split_at_mut(P::STAGES * *width);
        let ends = || Ends::new(h, [y, y_new], [0, last].map(|s| row(stages, *width, s)), n);
        if let Some(hermite_birkhoff) = hermite_birkhoff {
            hermite_birkhoff.measure(ends(), P::DOUBLE_QUADRATURE, stages);
        }
        if P::EXTRA == 0 || !observer.looks_inside(self.t, t_new) {
            return Ok(Some(P::WITHOUT_EXTRA));
        }
        let outcome =
            match hermite_birkhoff.as_mut().filter(|hermite_birkhoff| hermite_birkhoff.serves(h)) {
                Some(hermite_birkhoff) => {
                    hermite_birkhoff.predict(ends(), &mut trial.as_flattened_mut()[..n]);
                    let inside = row_mut(extra, *width, 0);
                    let outcome = self.rate.at(self.t + INSIDE * h, trial, inside);
                    let inside = &inside.as_flattened()[..n];
                    outcome.map(|()| hermite_birkhoff.complete(ends(), inside)).map(|()| None)
                }
                None => {
                    P::extend(&mut self.rate, (self.t, t_new), y, k, trial).map(|()| Some(P::TABLE))
                }
            };
        match outcome {
            Ok(table) => Ok(table),
            Err(Trouble::Stop(stop)) => Err(Cause::Equations(stop)),
            Err(Trouble::NotFinite(_)) => {
                // NaN times zero is NaN
                k[P::STAGES * *width..(P::STAGES + P::EXTRA) * *width].fill([0.0; Lanes::WIDTH]);
                Ok(Some(P::WITHOUT_EXTRA))
            }
        }
    }
}

/// The row of the derivative at the end of a step: the last stage, or behind the jump where that belongs to
/// the state before a projection.
fn last_row<P: EmbeddedPair>(projected: bool) -> usize {
    match projected && P::LAST_IN_ERROR {
        false => P::STAGES - 1,
        true => P::STAGES + P::EXTRA + 1,
    }
}
