//! The loop of every embedded Runge–Kutta pair: try, judge, accept or shorten.
//!
//! With the elementary control step for step what `scipy.integrate.solve_ivp` does, so that counts of steps
//! can be compared.

use super::embedded_pair::EmbeddedPair;
use super::failure::{conclude, Cause, Failure};
use super::fixed_step::Grid;
use super::hermite_birkhoff::HermiteBirkhoff;
use super::ode::{Ended, Flow, Observer, Ode, Statistics};
use super::right_hand_side::{RightHandSide, Trouble};
use super::stages::{combine, room, row_mut, rows_mut, width, Block};
use super::step_control::StepControl;
use super::step_placement::StepPlacement;
use super::step_size::{initial_step, least_step, probing_step, StepSize};
use super::tolerances::Tolerances;
use crate::math::Lanes;

/// Rejected steps after which a run gets nowhere, or half of max_steps if that is more.
const MANY: usize = 10_000;

/// What one accepted step needs, taken once.
pub(super) struct Work {
    /// Blocks in a row.
    pub width: usize,
    /// Stages, extra ones, the jump of a projection over h, the derivative after a projection if it is not
    /// the last stage.
    pub k: Vec<Block>,
    /// The last accepted state.
    pub y: Vec<Block>,
    pub y_new: Vec<Block>,
    /// Arguments of stages; the state before a projection.
    pub trial: Vec<Block>,
    /// The stages without what projection takes away.
    remaining: Vec<Block>,
    tolerances: Tolerances,
    /// The extension of systems of second order, for pairs whose own takes extra stages.
    pub hermite_birkhoff: Option<HermiteBirkhoff>,
}

impl Work {
    fn new<P: EmbeddedPair>(system: &impl Ode, options: &StepControl) -> Self {
        let (n, controlled, positions) = (system.len(), system.controlled(), system.positions());
        let second_order = positions > 0 && !P::DOUBLE_QUADRATURE.is_empty();
        Self {
            width: width(n),
            k: room(P::STAGES + P::EXTRA + 2, n),
            y: room(1, n),
            y_new: room(1, n),
            trial: room(1, n),
            remaining: Vec::new(),
            tolerances: Tolerances::new(options.rtol, &options.atol, controlled),
            hermite_birkhoff: second_order.then(|| HermiteBirkhoff::new(n, positions)),
        }
    }
}

/// An integration under way.
pub(super) struct Run<'a, Y, P> {
    pub rate: RightHandSide<'a, Y>,
    options: &'a StepControl,
    pub n: usize,
    pub t: f64,
    t_end: f64,
    direction: f64,
    pub steps: usize,
    rejected: usize,
    placement: StepPlacement,
    pub work: Work,
    pair: std::marker::PhantomData<P>,
}

/// Integrates with the pair `P`; the body of [`Method::integrate`](super::Method::integrate).
pub(super) fn integrate<P: EmbeddedPair, Y: Ode, O: Observer>(
    options: &StepControl,
    system: &mut Y,
    (t0, t_end): (f64, f64),
    y: &mut [f64],
    observer: &mut O,
) -> Result<Statistics, Failure<Y::Stop>> {
    let (n, controlled) = (system.len(), system.controlled());
    let checked = options.begin((t0, t_end), (y, n), controlled);
    let work = Work::new::<P>(system, options);
    let mut run = Run::<Y, P> {
        rate: RightHandSide { system, evaluations: 0 },
        options,
        n,
        t: t0,
        t_end,
        direction: (t_end - t0).signum(),
        steps: 0,
        rejected: 0,
        placement: StepPlacement::default(),
        work,
        pair: std::marker::PhantomData,
    };
    let outcome = checked.and_then(|grid| {
        run.work.y.as_flattened_mut()[..n].copy_from_slice(y);
        let outcome = run.go(grid, observer);
        y.copy_from_slice(&run.work.y.as_flattened()[..n]);
        outcome
    });
    conclude(outcome, run.statistics(), y)
}

impl<Y: Ode, P: EmbeddedPair> Run<'_, Y, P> {
    fn statistics(&self) -> Statistics {
        Statistics {
            steps: self.steps,
            rejected: self.rejected,
            evaluations: self.rate.evaluations,
            ..Statistics::none(self.t)
        }
    }

    fn go<O: Observer>(
        &mut self,
        grid: Option<Grid>,
        observer: &mut O,
    ) -> Result<Ended, Cause<Y::Stop>> {
        if self.t == self.t_end {
            return Ok(Ended::Reached);
        }
        let Work { k, y, width, .. } = &mut self.work;
        self.rate.at(self.t, y, row_mut(k, *width, 0)).map_err(hard)?;
        if let Some(grid) = grid {
            return self.go_along(&grid, observer);
        }
        let first = match self.options.first_step {
            Some(h) => h,
            None => self.first_step()?,
        };
        let mut size = StepSize::new(first, P::ERROR_ORDER, P::CONTROL);
        while self.t != self.t_end {
            if let Some(most) = self.options.max_steps {
                if self.steps >= most {
                    return Err(Cause::MaxSteps { steps: self.steps });
                }
                if self.rejected >= (most / 2).max(MANY) {
                    return Err(Cause::StepTooSmall { t: self.t, h: size.size });
                }
            }
            let (t_new, projected) = self.accepted_step(&mut size)?;
            if self.finish(t_new, projected, observer)? == Flow::Stop {
                return Ok(Ended::Stopped);
            }
        }
        Ok(Ended::Reached)
    }

    /// Steps of constant length, whatever their error.
    fn go_along<O: Observer>(
        &mut self,
        grid: &Grid,
        observer: &mut O,
    ) -> Result<Ended, Cause<Y::Stop>> {
        for k in 1..=grid.count {
            let t_new = grid.end(k, self.t)?;
            self.advance(t_new).map_err(hard)?;
            let projected = self.settle(t_new)??;
            if self.finish(t_new, projected, observer)? == Flow::Stop {
                return Ok(Ended::Stopped);
            }
        }
        Ok(Ended::Reached)
    }

    /// Hairer's choice of the first step, at the cost of one evaluation.
    fn first_step(&mut self) -> Result<f64, Cause<Y::Stop>> {
        let interval = (self.t_end - self.t).abs();
        let most = interval.min(self.options.max_step);
        let Work { width, k, y, trial, tolerances, .. } = &mut self.work;
        if tolerances.controlled == 0 {
            return Ok(most);
        }
        let [f0, f1] = rows_mut(k, *width);
        let d0 = tolerances.norm(y, |i| Lanes::new(y[i]));
        let d1 = tolerances.norm(y, |i| Lanes::new(f0[i]));
        let h0 = probing_step(d0, d1, interval);
        combine(y, h0 * self.direction, [1.0], [f0], trial);
        match self.rate.at(self.t + h0 * self.direction, trial, f1) {
            Ok(()) => {}
            // the probe left the domain: begin with it as a step, which rejection shortens
            Err(Trouble::NotFinite(_)) => return Ok(h0.min(most)),
            Err(Trouble::Stop(stop)) => return Err(Cause::Equations(stop)),
        }
        let d2 = tolerances.norm(y, |i| Lanes::new(f1[i]) - Lanes::new(f0[i])) / h0;
        Ok(initial_step(h0, d1, d2, P::ERROR_ORDER).min(most))
    }

    /// Tries steps until error and system accept one. Its time, and whether the system changed it.
    fn accepted_step(&mut self, size: &mut StepSize) -> Result<(f64, bool), Cause<Y::Stop>> {
        let t = self.t;
        let least = least_step(t, self.direction);
        size.begin(least, self.options.max_step);
        self.placement.begin();
        size.control = self.placement.control(P::CONTROL);
        let mut refusal = None;
        loop {
            if size.size < least {
                return Err(refusal.unwrap_or(Cause::StepTooSmall { t, h: size.size }));
            }
            let mut t_new = t + size.size * self.direction;
            if self.direction * (t_new - self.t_end) > 0.0 {
                t_new = self.t_end;
            }
            let h = t_new - t;
            let trial = self.attempt(t_new).map(|norm| self.judged(norm, h));
            let norm = trial.as_ref().map_or(f64::NAN, |norm| *norm);
            let at_best = self.placement.at_best(norm, self.options.rtol);
            let placed = self.placed(t_new).filter(|_| !at_best);
            match trial {
                Err(Trouble::Stop(stop)) => return Err(Cause::Equations(stop)),
                _ if placed.is_some() => size.size = placed.unwrap_or(size.size),
                Ok(norm) if norm < 1.0 || at_best => match self.settle(t_new)? {
                    Ok(projected) => {
                        size.accept(h.abs(), norm);
                        size.size = self.placement.resume(size.size);
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
                Err(Trouble::NotFinite(t)) => {
                    refusal = Some(Cause::NotFinite { t });
                    size.reject(h.abs(), f64::NAN);
                }
            }
            self.rejected += 1;
        }
    }

    /// The step to try instead of that to `t_new`, so as to keep clear of an obstacle.
    fn placed(&mut self, t_new: f64) -> Option<f64> {
        let obstacle = self.rate.system.time_to_avoid(t_new)?;
        let [h, left] = [t_new, self.t_end].map(|end| (end - self.t).abs());
        let left = left.min(self.options.max_step);
        self.placement.instead(P::GAP, h, self.direction * (obstacle - self.t), left)
    }

    /// The error norm of a step to `t_new`.
    fn attempt(&mut self, t_new: f64) -> Result<f64, Trouble<Y::Stop>> {
        self.advance(t_new)?;
        let Work { k, y, y_new, tolerances, .. } = &self.work;
        let norm = P::error_norm(t_new - self.t, k, (y, y_new), tolerances);
        Ok(self.placement.strictness() * norm)
    }

    /// The stages of a step to `t_new`, and the state there.
    fn advance(&mut self, t_new: f64) -> Result<(), Trouble<Y::Stop>> {
        let Work { width, k, y, y_new, trial, hermite_birkhoff, .. } = &mut self.work;
        if self.rate.begin(self.t, t_new - self.t, y, row_mut(k, *width, 0))? {
            hermite_birkhoff.iter_mut().for_each(HermiteBirkhoff::forget);
        }
        P::advance(&mut self.rate, (self.t, t_new), y, k, trial, y_new)?;
        if !P::LAST_IN_ERROR && self.rate.system.near_time_to_avoid() {
            self.rate.at(t_new, y_new, row_mut(k, *width, P::STAGES - 1))?;
        }
        Ok(())
    }

    /// The error norm of a refused step without what projection takes away.
    fn judged(&mut self, norm: f64, h: f64) -> f64 {
        if norm < 1.0 || !norm.is_finite() {
            return norm;
        }
        let Work { width, k, y, y_new, remaining, tolerances, .. } = &mut self.work;
        remaining.clear();
        remaining.extend_from_slice(&k[..P::STAGES * *width]);
        let mut rows = remaining.chunks_exact_mut(*width);
        if !rows.all(|dy| self.rate.system.project_error(&mut dy.as_flattened_mut()[..self.n])) {
            return norm;
        }
        let left = P::error_norm(h, remaining, (y, y_new), tolerances);
        norm.min(self.placement.strictness() * left)
    }
}

/// Trouble at a state that no shorter step can avoid.
fn hard<E>(trouble: Trouble<E>) -> Cause<E> {
    match trouble {
        Trouble::NotFinite(t) => Cause::NotFinite { t },
        Trouble::Stop(stop) => Cause::Equations(stop),
    }
}
