//! The classical Runge–Kutta method of order 4 with a fixed step (Kutta, *Z. Math. Phys.* 46 (1901)
//! 435); between steps the cubic Hermite polynomial, of order 3.

use super::arguments::{check_problem, refusal};
use super::failure::{conclude, Cause, Failure};
use super::fixed_step::Grid;
use super::interpolant::{Interpolant, HERMITE};
use super::ode::{Ended, Flow, Method, Observer, Ode, Statistics, Step};
use super::right_hand_side::{all_finite, RightHandSide, Trouble};
use super::stages::{chord, combine, room, row, row_mut, rows_mut, Block, Trial};
use super::step_control::StepControl;
use crate::math::Lanes;

/// Classical Runge–Kutta 4 with its options.
///
/// It needs a constant step; errors are not estimated.
#[derive(Clone, Debug, PartialEq)]
pub struct Rk4 {
    /// The step, and the largest number of steps.
    pub control: StepControl,
}

impl Rk4 {
    /// With the given step and no bound on their number.
    pub fn new(step: f64) -> Self {
        Self { control: StepControl::constant(step) }
    }
}

/// Weights of the stages, in sixths.
const B: [f64; 4] = [1.0, 2.0, 2.0, 1.0];

/// Memory of a run.
struct Work {
    /// Derivatives at both ends, chord; then the inner stages.
    k: Vec<Block>,
    y: Vec<Block>,
    trial: Vec<Block>,
    y_new: Vec<Block>,
}

impl Work {
    fn new(y: &[f64]) -> Self {
        let row = || room(1, y.len());
        let mut work = Self { k: room(6, y.len()), y: row(), trial: row(), y_new: row() };
        work.y.as_flattened_mut()[..y.len()].copy_from_slice(y);
        work
    }

    /// y at t + h, from y and the derivative there.
    fn advance<Y: Ode>(
        &mut self,
        rate: &mut RightHandSide<'_, Y>,
        t: f64,
        h: f64,
    ) -> Result<(), Trouble<Y::Stop>> {
        let Self { k, y, trial, y_new } = self;
        let [k1, _, _, k2, k3, k4] = rows_mut(k, y.len());
        rate.begin(t, h, y, k1)?;
        let mut trial = Trial::new(rate, (t, h), y, trial);
        trial.stage(0.5, [0.5], [k1], k2)?;
        trial.stage(0.5, [0.5], [k2], k3)?;
        trial.stage(1.0, [1.0], [k3], k4)?;
        match combine(y, h / 6.0, B, [k1, k2, k3, k4], y_new) {
            true => Ok(()),
            false => Err(Trouble::NotFinite(t + h)),
        }
    }
}

impl Method for Rk4 {
    fn integrate<Y: Ode, O: Observer>(
        &self,
        system: &mut Y,
        t0: f64,
        t_end: f64,
        y: &mut [f64],
        observer: &mut O,
    ) -> Result<Statistics, Failure<Y::Stop>> {
        let grid = check_problem(t0, t_end, y, system.len()).map_err(refusal).and_then(|()| {
            let StepControl { step, max_steps, .. } = self.control;
            Grid::new(t0, t_end, step.unwrap_or(f64::NAN), max_steps)
        });
        let mut statistics = Statistics::none(t0);
        let mut rate = RightHandSide { system, evaluations: 0 };
        let outcome = grid.and_then(|grid| go(&mut rate, t0, &grid, y, observer, &mut statistics));
        statistics.evaluations = rate.evaluations;
        conclude(outcome, statistics, y)
    }
}

fn go<Y: Ode, O: Observer>(
    rate: &mut RightHandSide<'_, Y>,
    t0: f64,
    grid: &Grid,
    y: &mut [f64],
    observer: &mut O,
    statistics: &mut Statistics,
) -> Result<Ended, Cause<Y::Stop>> {
    if grid.count == 0 {
        return Ok(Ended::Reached);
    }
    let mut work = Work::new(y);
    let width = work.y.len();
    rate.at(t0, &work.y, row_mut(&mut work.k, width, 0)).map_err(cause)?;
    for k in 1..=grid.count {
        let t = statistics.t;
        let t_new = grid.end(k, t)?;
        work.advance(rate, t, t_new - t).map_err(cause)?;
        let flow = finish(&mut work, rate, (t, t_new), y, observer)?;
        statistics.steps += 1;
        statistics.t = t_new;
        if flow == Flow::Stop {
            return Ok(Ended::Stopped);
        }
    }
    Ok(Ended::Reached)
}

/// Offers the new state to the system and the step to the observer, and moves on.
fn finish<Y: Ode, O: Observer>(
    work: &mut Work,
    rate: &mut RightHandSide<'_, Y>,
    (t, t_new): (f64, f64),
    y: &mut [f64],
    observer: &mut O,
) -> Result<Flow, Cause<Y::Stop>> {
    let n = y.len();
    let Work { k, y: y_old, y_new, .. } = work;
    let width = y_old.len();
    let y_settled = &mut y_new.as_flattened_mut()[..n];
    let changed = rate.system.project_accepted(t_new, y_settled).map_err(Cause::Equations)?;
    if changed && !all_finite(y_settled) {
        return Err(Cause::NotFinite { t: t_new });
    }
    // the next step begins with this derivative, so the Hermite polynomial costs nothing
    rate.at_accepted(changed, t_new, y_new, row_mut(k, width, 1)).map_err(cause)?;
    chord(y_old, y_new, t_new - t, row_mut(k, width, 2));
    let [of_old, of_new] = [0, 1].map(|s| &row(k, width, s).as_flattened()[..n]);
    let end = &y_new.as_flattened()[..n];
    let interpolant = k[..3 * width].as_flattened();
    let flow = observer.step(&Step {
        t_old: t,
        t: t_new,
        y_old: y,
        y: end,
        dy_old: of_old,
        dy: of_new,
        interpolant: Interpolant::new(interpolant, Lanes::WIDTH * width, &HERMITE, 4),
    });
    y.copy_from_slice(end);
    std::mem::swap(y_old, y_new);
    k.copy_within(width..2 * width, 0);
    Ok(flow)
}

fn cause<E>(trouble: Trouble<E>) -> Cause<E> {
    match trouble {
        Trouble::NotFinite(t) => Cause::NotFinite { t },
        Trouble::Stop(stop) => Cause::Equations(stop),
    }
}
