//! Steps of explicit steppers in lanes (`lane_steps`).

use super::explicit_stepper::ExplicitStepper;
use super::explicit_work::{Accepted, InterpolantLevel, Work};
use super::hermite_birkhoff::HermiteBirkhoff;
use super::lane_steps::{LaneEnd, LaneMethod, LaneStart, OverLanes, SideBySide};
use super::runge_kutta::RungeKutta;
use super::stages::{chord, row, row_mut, Block};
use super::step_acceptance::last_row;
use std::marker::PhantomData;

impl<P: RungeKutta> SideBySide for ExplicitStepper<P> {
    #[inline]
    fn method(&self) -> &'static dyn LaneMethod {
        &OverLanes::<P>(PhantomData)
    }

    fn propose(
        &mut self,
        LaneStart { lane, y, dy, tolerances }: LaneStart<'_>,
    ) -> Option<[f64; 2]> {
        self.move_on();
        let ordinary = self.grid.is_none() && self.placement.is_idle() && self.t != self.t_end;
        if !ordinary || self.size.as_ref().is_none_or(|size| self.check_counts::<()>(size).is_err())
        {
            return None;
        }
        let mut size = self.size.take()?;
        self.begin_trials(&mut size);
        self.rejected_before = true; // the bounds of this step have been applied
        let proposal = self.proposal(&size);
        self.size = Some(size);
        let Work { width, k, y: own, tolerances: of, .. } = &self.work;
        put(own, lane, y);
        put(&k[..*width], lane, dy);
        tolerances.set(lane, of);
        proposal.map(|proposal| [self.t, proposal.t_new])
    }

    fn judge(&mut self, norm: f64, evaluations: usize) -> bool {
        if norm < 1.0 {
            return true;
        }
        let proposal = self.size.as_ref().and_then(|size| self.proposal(size));
        if let (Some(proposal), Some(size)) = (proposal, &mut self.size) {
            size.reject((proposal.t_new - self.t).abs(), norm);
        }
        self.counts.rejected += 1;
        self.counts.evaluations += evaluations;
        false
    }

    fn accept(
        &mut self,
        norm: f64,
        LaneEnd { lane, y, dy, projected, evaluations, stages }: LaneEnd<'_>,
    ) {
        let Some(mut size) = self.size.take() else { return };
        let Some(proposal) = self.proposal(&size) else { return };
        self.resize(&mut size, proposal, norm);
        self.size = Some(size);
        self.rejected_before = false;
        self.counts.steps += 1;
        self.counts.evaluations += evaluations;
        let t = proposal.t_new;
        let Work { width, k, y: begin, y_new, trial, hermite_birkhoff, .. } = &mut self.work;
        take(y, lane, y_new);
        if let Some([stages, before]) = stages {
            let count = P::STAGES - usize::from(!P::LAST_IN_ERROR);
            for stage in 1..count {
                take(row(stages, y.len(), stage), lane, row_mut(k, *width, stage));
            }
            take(before, lane, trial);
            if projected {
                chord(trial, y_new, t - self.t, row_mut(k, *width, P::STAGES + P::EXTRA));
            }
            take(dy, lane, row_mut(k, *width, last_row::<P>(projected)));
            let accepted = Accepted { t, projected, interpolant: InterpolantLevel::Plain };
            self.measure(accepted);
            self.accepted = Some(accepted);
            return;
        }
        take(dy, lane, row_mut(k, *width, last_row::<P>(projected)));
        // the interpolant has no stages; it uses these rows
        take(dy, lane, row_mut(k, *width, 1));
        chord(begin, y_new, t - self.t, row_mut(k, *width, 2));
        hermite_birkhoff.iter_mut().for_each(HermiteBirkhoff::forget);
        self.accepted = Some(Accepted { t, projected, interpolant: InterpolantLevel::Ends });
    }
}

/// Copies numbers into a lane.
#[inline]
fn put(from: &[Block], lane: usize, to: &mut [Block]) {
    to.iter_mut().zip(from.as_flattened()).for_each(|(to, x)| to[lane] = *x);
}

/// Copies numbers from a lane.
#[inline]
fn take(from: &[Block], lane: usize, to: &mut [Block]) {
    to.as_flattened_mut().iter_mut().zip(from).for_each(|(to, x)| *to = x[lane]);
}
