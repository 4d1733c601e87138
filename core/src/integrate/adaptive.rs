//! The loop of every embedded Runge–Kutta pair: try, judge, accept or shorten.
//!
//! Step for step the control of `scipy.integrate.solve_ivp`, so that counts of steps can be compared.

use super::adaptive_options::{Atol, Options};
use super::clearance::Clearance;
use super::contract::{Ended, FirstOrder, Flow, Observer, Statistics, Step};
use super::dense::Dense;
use super::embedded_pair::EmbeddedPair;
use super::failure::{conclude, Cause, Failure};
use super::fixed_step::Grid;
use super::rate::{all_finite, Rate, Trouble};
use super::step_size::{initial_step, least_step, probing_step, scaled_norm, StepSize};

/// Rejected steps after which a run gets nowhere, or half of max_steps if that is more.
const MANY: usize = 10_000;

/// What one accepted step needs, taken once.
struct Work {
    /// Stages, extra ones, the jump of a projection over h, the derivative after a projection.
    k: Vec<f64>,
    y_new: Vec<f64>,
    /// Arguments of stages; the state before a projection.
    trial: Vec<f64>,
    /// The stages without what projection takes away.
    remaining: Vec<f64>,
    atol: Vec<f64>,
}

impl Work {
    fn new<P: EmbeddedPair>(n: usize, controlled: usize, atol: &Atol) -> Self {
        let atol = match atol {
            Atol::Scalar(atol) => vec![*atol; controlled],
            Atol::Each(atol) => atol.clone(),
        };
        Self {
            k: vec![0.0; (P::STAGES + P::EXTRA + 2) * n],
            y_new: vec![0.0; n],
            trial: vec![0.0; n],
            remaining: Vec::new(),
            atol,
        }
    }
}

/// An integration under way.
struct Run<'a, Y, P> {
    rate: Rate<'a, Y>,
    options: &'a Options<'a>,
    n: usize,
    t: f64,
    t_end: f64,
    direction: f64,
    steps: usize,
    rejected: usize,
    clearance: Clearance,
    work: Work,
    pair: std::marker::PhantomData<P>,
}

/// Integrates with the pair `P`; the body of [`Method::integrate`](super::Method::integrate).
pub(super) fn integrate<P: EmbeddedPair, Y: FirstOrder, O: Observer>(
    options: &Options<'_>,
    system: &mut Y,
    (t0, t_end): (f64, f64),
    y: &mut [f64],
    observer: &mut O,
) -> Result<Statistics, Failure<Y::Stop>> {
    let (n, controlled) = (system.len(), system.controlled());
    let checked = options.begin((t0, t_end), (y, n), controlled);
    let mut run = Run::<Y, P> {
        rate: Rate { system, evaluations: 0 },
        options,
        n,
        t: t0,
        t_end,
        direction: (t_end - t0).signum(),
        steps: 0,
        rejected: 0,
        clearance: Clearance::default(),
        work: Work::new::<P>(n, controlled, options.atol),
        pair: std::marker::PhantomData,
    };
    let outcome = checked.and_then(|grid| run.go(grid, y, observer));
    conclude(outcome, run.statistics(), y)
}

impl<Y: FirstOrder, P: EmbeddedPair> Run<'_, Y, P> {
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
        y: &mut [f64],
        observer: &mut O,
    ) -> Result<Ended, Cause<Y::Stop>> {
        if self.t == self.t_end {
            return Ok(Ended::Reached);
        }
        self.rate.at(self.t, y, &mut self.work.k[..self.n]).map_err(hard)?;
        if let Some(grid) = grid {
            return self.go_along(&grid, y, observer);
        }
        let first = match self.options.first_step {
            Some(h) => h,
            None => self.first_step(y)?,
        };
        let mut size = StepSize::new(first, P::ERROR_ORDER);
        while self.t != self.t_end {
            if let Some(most) = self.options.max_steps {
                if self.steps >= most {
                    return Err(Cause::MaxSteps { steps: self.steps });
                }
                if self.rejected >= (most / 2).max(MANY) {
                    return Err(Cause::StepTooSmall { t: self.t, h: size.size });
                }
            }
            let (t_new, projected) = self.accepted_step(y, &mut size)?;
            if self.finish(t_new, projected, y, observer)? == Flow::Stop {
                return Ok(Ended::Stopped);
            }
        }
        Ok(Ended::Reached)
    }

    /// Steps of constant length, whatever their error.
    fn go_along<O: Observer>(
        &mut self,
        grid: &Grid,
        y: &mut [f64],
        observer: &mut O,
    ) -> Result<Ended, Cause<Y::Stop>> {
        for k in 1..=grid.count {
            let t_new = grid.end(k, self.t)?;
            self.advance(t_new, y).map_err(hard)?;
            let projected = self.project(t_new)?.map_err(Cause::Equations)?;
            if self.finish(t_new, projected, y, observer)? == Flow::Stop {
                return Ok(Ended::Stopped);
            }
        }
        Ok(Ended::Reached)
    }

    /// Hairer's choice of the first step, at the cost of one evaluation.
    fn first_step(&mut self, y: &[f64]) -> Result<f64, Cause<Y::Stop>> {
        let interval = (self.t_end - self.t).abs();
        let most = interval.min(self.options.max_step);
        let Work { k, trial, atol, .. } = &mut self.work;
        if atol.is_empty() {
            return Ok(most);
        }
        let (f0, rest) = k.split_at_mut(self.n);
        let f1 = &mut rest[..self.n];
        let rtol = self.options.rtol;
        let scale = |i: usize| atol[i] + rtol * y[i].abs();
        let controlled = 0..atol.len();
        let d0 = scaled_norm(controlled.clone().map(|i| (y[i], scale(i))));
        let d1 = scaled_norm(controlled.clone().map(|i| (f0[i], scale(i))));
        let h0 = probing_step(d0, d1, interval);
        for ((trial, y), f) in trial.iter_mut().zip(y).zip(f0.iter()) {
            *trial = y + h0 * self.direction * f;
        }
        match self.rate.at(self.t + h0 * self.direction, trial, f1) {
            Ok(()) => {}
            // the probe left the domain: begin with it as a step, which rejection shortens
            Err(Trouble::NotFinite(_)) => return Ok(h0.min(most)),
            Err(Trouble::Stop(stop)) => return Err(Cause::Equations(stop)),
        }
        let d2 = scaled_norm(controlled.map(|i| (f1[i] - f0[i], scale(i)))) / h0;
        Ok(initial_step(h0, d1, d2, P::ERROR_ORDER).min(most))
    }

    /// Tries steps until error and system accept one. Its time, and whether the system changed it.
    fn accepted_step(
        &mut self,
        y: &[f64],
        size: &mut StepSize,
    ) -> Result<(f64, bool), Cause<Y::Stop>> {
        let t = self.t;
        let least = least_step(t, self.direction);
        size.begin(least, self.options.max_step);
        self.clearance.begin();
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
            let trial = self.attempt(t_new, y).map(|norm| self.judged(norm, h, y));
            let placed = self.placed(t_new);
            match trial {
                Err(Trouble::Stop(stop)) => return Err(Cause::Equations(stop)),
                _ if placed.is_some() => size.size = placed.unwrap_or(size.size),
                Ok(norm) if norm < 1.0 => match self.project(t_new)? {
                    Ok(projected) => {
                        size.accept(h.abs(), norm);
                        size.size = self.clearance.resume(size.size);
                        return Ok((t_new, projected));
                    }
                    Err(stop) => {
                        refusal = Some(Cause::Equations(stop));
                        size.refuse(h.abs());
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
        let obstacle = self.rate.system.obstacle(t_new)?;
        let [h, left] = [t_new, self.t_end].map(|end| (end - self.t).abs());
        let left = left.min(self.options.max_step);
        self.clearance.instead(P::GAP, h, self.direction * (obstacle - self.t), left)
    }

    /// The error norm of a step to `t_new`.
    fn attempt(&mut self, t_new: f64, y: &[f64]) -> Result<f64, Trouble<Y::Stop>> {
        self.advance(t_new, y)?;
        let Work { k, y_new, trial, atol, .. } = &mut self.work;
        let stages = &k[..P::STAGES * self.n];
        let tolerances = (self.options.rtol, atol.as_slice());
        let norm = P::error_norm(t_new - self.t, stages, (y, y_new), tolerances, trial);
        Ok(self.clearance.strictness() * norm)
    }

    /// The stages of a step to `t_new`, and the state there.
    fn advance(&mut self, t_new: f64, y: &[f64]) -> Result<(), Trouble<Y::Stop>> {
        let Work { k, y_new, trial, .. } = &mut self.work;
        let stages = &mut k[..P::STAGES * self.n];
        self.rate.begin(self.t, t_new - self.t, y, &mut stages[..self.n])?;
        P::advance(&mut self.rate, (self.t, t_new), y, stages, trial, y_new)?;
        if all_finite(y_new) {
            Ok(())
        } else {
            Err(Trouble::NotFinite(t_new))
        }
    }

    /// The error norm of a refused step without what projection takes away.
    fn judged(&mut self, norm: f64, h: f64, y: &[f64]) -> f64 {
        if norm < 1.0 || !norm.is_finite() {
            return norm;
        }
        let Work { k, y_new, trial, remaining, atol } = &mut self.work;
        remaining.clear();
        remaining.extend_from_slice(&k[..P::STAGES * self.n]);
        if !remaining.chunks_exact_mut(self.n).all(|dy| self.rate.system.remaining(dy)) {
            return norm;
        }
        let tolerances = (self.options.rtol, atol.as_slice());
        let left = P::error_norm(h, remaining, (y, y_new), tolerances, trial);
        norm.min(self.clearance.strictness() * left)
    }

    /// Offers the accepted state to the system and the step to the observer, and moves on.
    fn finish<O: Observer>(
        &mut self,
        t_new: f64,
        projected: bool,
        y: &mut [f64],
        observer: &mut O,
    ) -> Result<Flow, Cause<Y::Stop>> {
        let table = self.extend(t_new, y, observer)?;
        let n = self.n;
        let Work { k, y_new, .. } = &self.work;
        let (rows, last) = match projected {
            false => (P::STAGES + P::EXTRA, P::STAGES - 1),
            true => (P::STAGES + P::EXTRA + 1, P::STAGES + P::EXTRA + 1),
        };
        let step = Step {
            t_old: self.t,
            t: t_new,
            y_old: y,
            y: y_new,
            dy_old: &k[..n],
            dy: &k[last * n..][..n],
            dense: Dense::new(&k[..rows * n], n, table, P::DEGREE),
        };
        let flow = observer.step(&step);
        y.copy_from_slice(y_new);
        self.work.k.copy_within(last * n..(last + 1) * n, 0);
        self.t = t_new;
        self.steps += 1;
        Ok(flow)
    }

    /// The extra stages, where the observer wants them and they can be had; the table that fits.
    fn extend<O: Observer>(
        &mut self,
        t_new: f64,
        y: &[f64],
        observer: &O,
    ) -> Result<&'static [f64], Cause<Y::Stop>> {
        if P::EXTRA == 0 || !observer.looks_inside(self.t, t_new) {
            return Ok(P::WITHOUT_EXTRA);
        }
        let Work { k, trial, .. } = &mut self.work;
        match P::extend(&mut self.rate, (self.t, t_new), y, k, trial) {
            Ok(()) => Ok(P::TABLE),
            Err(Trouble::Stop(stop)) => Err(Cause::Equations(stop)),
            Err(Trouble::NotFinite(_)) => {
                // NaN times zero is NaN
                k[P::STAGES * self.n..(P::STAGES + P::EXTRA) * self.n].fill(0.0);
                Ok(P::WITHOUT_EXTRA)
            }
        }
    }

    /// Lets the system change the accepted state; if it does, the jump and the new derivative go into
    /// the rows after the stages. Inside, why it refuses the state.
    fn project(&mut self, t_new: f64) -> Result<Result<bool, Y::Stop>, Cause<Y::Stop>> {
        let Work { k, y_new, trial, .. } = &mut self.work;
        trial.copy_from_slice(y_new);
        match self.rate.system.accepted(t_new, y_new) {
            Ok(true) => {}
            other => return Ok(other),
        }
        if !all_finite(y_new) {
            return Err(Cause::NotFinite { t: t_new });
        }
        let h = t_new - self.t;
        let (jump, dy) = k[(P::STAGES + P::EXTRA) * self.n..].split_at_mut(self.n);
        for ((jump, new), old) in jump.iter_mut().zip(y_new.iter()).zip(trial.iter()) {
            *jump = (new - old) / h;
        }
        self.rate.at(t_new, y_new, dy).map_err(hard)?;
        Ok(Ok(true))
    }
}

/// Trouble at a state that no shorter step can avoid.
fn hard<E>(trouble: Trouble<E>) -> Cause<E> {
    match trouble {
        Trouble::NotFinite(t) => Cause::NotFinite { t },
        Trouble::Stop(stop) => Cause::Equations(stop),
    }
}
