//! What becomes of a step whose error is accepted: the system settles its end, the continuous extension gets
//! what it needs, and the observer sees it.

use super::adaptive::{Run, Work};
use super::birkhoff::{Ends, INSIDE};
use super::contract::{FirstOrder, Flow, Observer, Step};
use super::dense::Dense;
use super::embedded_pair::EmbeddedPair;
use super::failure::Cause;
use super::rate::{all_finite, Trouble};

/// Whether the system changed the state; inside, why a shorter step is to be tried.
type Settled<E> = Result<Result<bool, Cause<E>>, Cause<E>>;

impl<Y: FirstOrder, P: EmbeddedPair> Run<'_, Y, P> {
    /// Lets the system change the accepted state and evaluates the derivative there, where that is not
    /// known.
    pub(super) fn settle(&mut self, t_new: f64) -> Settled<Y::Stop> {
        let Work { k, y_new, trial, .. } = &mut self.work;
        trial.copy_from_slice(y_new);
        let projected = match self.rate.system.accepted(t_new, y_new) {
            Ok(projected) => projected,
            Err(stop) => return Ok(Err(Cause::Equations(stop))),
        };
        if projected {
            if !all_finite(y_new) {
                return Err(Cause::NotFinite { t: t_new });
            }
            let h = t_new - self.t;
            let jump = &mut k[(P::STAGES + P::EXTRA) * self.n..][..self.n];
            for ((jump, new), old) in jump.iter_mut().zip(y_new.iter()).zip(trial.iter()) {
                *jump = (new - old) / h;
            }
        }
        if projected || !P::LAST_IN_ERROR {
            let row = last_row::<P>(projected);
            match self.rate.at(t_new, y_new, &mut k[row * self.n..][..self.n]) {
                Ok(()) => {}
                Err(Trouble::NotFinite(t)) => return Ok(Err(Cause::NotFinite { t })),
                Err(Trouble::Stop(stop)) => return Err(Cause::Equations(stop)),
            }
        }
        self.rate.system.stands(t_new);
        Ok(Ok(projected))
    }

    /// Shows an accepted step to the observer, and moves on.
    pub(super) fn finish<O: Observer>(
        &mut self,
        t_new: f64,
        projected: bool,
        y: &mut [f64],
        observer: &mut O,
    ) -> Result<Flow, Cause<Y::Stop>> {
        let (n, last) = (self.n, last_row::<P>(projected));
        let extension = self.extend(t_new, last, y, observer)?;
        let Work { k, y_new, birkhoff, .. } = &mut self.work;
        let dense = match (extension, &birkhoff) {
            (None, Some(birkhoff)) => birkhoff.dense(),
            (table, _) => {
                let rows = P::STAGES + P::EXTRA + usize::from(projected);
                Dense::new(&k[..rows * n], n, table.unwrap_or(P::WITHOUT_EXTRA), P::DEGREE)
            }
        };
        let (dy_old, dy) = (&k[..n], &k[last * n..][..n]);
        let step = Step { t_old: self.t, t: t_new, y_old: y, y: y_new, dy_old, dy, dense };
        let flow = observer.step(&step);
        if let Some(birkhoff) = birkhoff {
            birkhoff.remember(Ends { h: t_new - self.t, y_old: y, y: y_new, dy_old, dy });
        }
        y.copy_from_slice(y_new);
        k.copy_within(last * n..(last + 1) * n, 0);
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
        y: &[f64],
        observer: &O,
    ) -> Result<Option<&'static [f64]>, Cause<Y::Stop>> {
        let Work { k, y_new, trial, birkhoff, .. } = &mut self.work;
        let (n, h) = (self.n, t_new - self.t);
        let (stages, extra) = k.split_at_mut(P::STAGES * n);
        let ends = || Ends { h, y_old: y, y: y_new, dy_old: &stages[..n], dy: &stages[last * n..] };
        if let Some(birkhoff) = birkhoff {
            birkhoff.measure(ends(), P::MEAN, stages);
        }
        if P::EXTRA == 0 || !observer.looks_inside(self.t, t_new) {
            return Ok(Some(P::WITHOUT_EXTRA));
        }
        let outcome = match birkhoff.as_mut().filter(|birkhoff| birkhoff.serves(h)) {
            Some(birkhoff) => {
                birkhoff.predict(ends(), trial);
                let inside = &mut extra[..n];
                let outcome = self.rate.at(self.t + INSIDE * h, trial, inside);
                outcome.map(|()| birkhoff.complete(ends(), inside)).map(|()| None)
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
                k[P::STAGES * n..(P::STAGES + P::EXTRA) * n].fill(0.0);
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
