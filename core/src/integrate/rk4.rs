//! The classical Runge–Kutta method of order 4 with a fixed step (Kutta, *Z. Math. Phys.* 46 (1901)
//! 435); between steps the cubic Hermite polynomial, of order 3.

use super::arguments::{check_problem, refusal};
use super::contract::{Ended, FirstOrder, Flow, Method, Observer, Statistics, Step};
use super::dense::{Dense, HERMITE};
use super::failure::{conclude, Cause, Failure};
use super::fixed_step::Grid;
use super::rate::{all_finite, Rate, Trouble};

/// Classical Runge–Kutta 4 with its options.
///
/// Steps end at t0 + k `step`, computed by multiplication; the last is shortened to end at t_end.
/// Errors are not estimated.
#[derive(Clone, Debug, PartialEq)]
pub struct Rk4 {
    /// Step, > 0, also when integrating backward.
    pub step: f64,
    /// Largest number of steps; more are refused before the first.
    pub max_steps: Option<usize>,
}

impl Rk4 {
    /// With the given step and no bound on their number.
    pub fn new(step: f64) -> Self {
        Self { step, max_steps: None }
    }
}

/// Memory of a run: derivatives at both ends, chord, then the inner stages.
struct Work {
    dense: Vec<f64>,
    inner: [Vec<f64>; 3],
    trial: Vec<f64>,
    y_new: Vec<f64>,
}

impl Work {
    fn new(n: usize) -> Self {
        let row = || vec![0.0; n];
        Self { dense: vec![0.0; 3 * n], inner: [row(), row(), row()], trial: row(), y_new: row() }
    }

    /// y at t + h, from y and the derivative there.
    fn advance<Y: FirstOrder>(
        &mut self,
        rate: &mut Rate<'_, Y>,
        t: f64,
        h: f64,
        y: &[f64],
    ) -> Result<(), Trouble<Y::Stop>> {
        let n = y.len();
        let k1 = &mut self.dense[..n];
        rate.begin(t, h, y, k1)?;
        let [k2, k3, k4] = &mut self.inner;
        along(y, 0.5 * h, k1, &mut self.trial);
        rate.at(t + 0.5 * h, &self.trial, k2)?;
        along(y, 0.5 * h, k2, &mut self.trial);
        rate.at(t + 0.5 * h, &self.trial, k3)?;
        along(y, h, k3, &mut self.trial);
        rate.at(t + h, &self.trial, k4)?;
        let (k2, k3, k4) = (&k2[..n], &k3[..n], &k4[..n]);
        let y_new = &mut self.y_new[..n];
        for i in 0..n {
            y_new[i] = y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
        }
        if all_finite(y_new) {
            Ok(())
        } else {
            Err(Trouble::NotFinite(t + h))
        }
    }
}

/// out = y + h k.
fn along(y: &[f64], h: f64, k: &[f64], out: &mut [f64]) {
    for ((out, y), k) in out.iter_mut().zip(y).zip(k) {
        *out = y + h * k;
    }
}

impl Method for Rk4 {
    fn integrate<Y: FirstOrder, O: Observer>(
        &self,
        system: &mut Y,
        t0: f64,
        t_end: f64,
        y: &mut [f64],
        observer: &mut O,
    ) -> Result<Statistics, Failure<Y::Stop>> {
        let grid = check_problem(t0, t_end, y, system.len())
            .map_err(refusal)
            .and_then(|()| Grid::new(t0, t_end, self.step, self.max_steps));
        let mut statistics = Statistics::none(t0);
        let mut rate = Rate { system, evaluations: 0 };
        let outcome = grid.and_then(|grid| go(&mut rate, t0, &grid, y, observer, &mut statistics));
        statistics.evaluations = rate.evaluations;
        conclude(outcome, statistics, y)
    }
}

fn go<Y: FirstOrder, O: Observer>(
    rate: &mut Rate<'_, Y>,
    t0: f64,
    grid: &Grid,
    y: &mut [f64],
    observer: &mut O,
    statistics: &mut Statistics,
) -> Result<Ended, Cause<Y::Stop>> {
    if grid.count == 0 {
        return Ok(Ended::Reached);
    }
    let mut work = Work::new(y.len());
    rate.at(t0, y, &mut work.dense[..y.len()]).map_err(cause)?;
    for k in 1..=grid.count {
        let t = statistics.t;
        let t_new = grid.end(k, t)?;
        work.advance(rate, t, t_new - t, y).map_err(cause)?;
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
fn finish<Y: FirstOrder, O: Observer>(
    work: &mut Work,
    rate: &mut Rate<'_, Y>,
    (t, t_new): (f64, f64),
    y: &mut [f64],
    observer: &mut O,
) -> Result<Flow, Cause<Y::Stop>> {
    let n = y.len();
    let Work { dense, y_new, .. } = work;
    if rate.system.accepted(t_new, y_new).map_err(Cause::Equations)? && !all_finite(y_new) {
        return Err(Cause::NotFinite { t: t_new });
    }
    // the next step begins with this derivative, so the Hermite polynomial costs nothing
    rate.at(t_new, y_new, &mut dense[n..2 * n]).map_err(cause)?;
    for ((chord, new), old) in dense[2 * n..].iter_mut().zip(y_new.iter()).zip(y.iter()) {
        *chord = (new - old) / (t_new - t);
    }
    let flow = observer.step(&Step {
        t_old: t,
        t: t_new,
        y_old: y,
        y: y_new,
        dy_old: &dense[..n],
        dy: &dense[n..2 * n],
        dense: Dense::new(dense, n, &HERMITE, 4),
    });
    y.copy_from_slice(y_new);
    dense.copy_within(n..2 * n, 0);
    Ok(flow)
}

fn cause<E>(trouble: Trouble<E>) -> Cause<E> {
    match trouble {
        Trouble::NotFinite(t) => Cause::NotFinite { t },
        Trouble::Stop(stop) => Cause::Equations(stop),
    }
}
