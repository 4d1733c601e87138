//! Reported states of a grid side by side: interpolated, solved and kept four at once.

use super::around;
use super::options::Options;
use super::output::Trajectory;
use super::report::Solver;
use super::system::WORKS;
use crate::equations::Workspace;
use crate::integrate::Step;
use crate::math::{Lanes, Real};
use crate::model::Model;

/// As many times as there are lanes.
pub(super) type Times = [f64; Lanes::WIDTH];

/// States of a grid that wait until there is one for each lane.
pub(super) struct Batch<'a> {
    pub solver: Solver<'a, Lanes>,
    t: Times,
    /// What the last step was interpolated to.
    between: Vec<Lanes>,
    /// As they were put in.
    given: Vec<Lanes>,
    /// Projected; before that, scratch.
    y: Vec<Lanes>,
    waiting: usize,
    /// Rows of one table, to be kept.
    rows: Vec<f64>,
}

impl<'a> Batch<'a> {
    pub fn new(model: &'a Model<Lanes>, options: &Options) -> Self {
        let none = vec![Lanes::zero(); 2 * model.layout.n_q + WORKS];
        let mut workspace = Workspace::new(model);
        workspace.refuse_singular();
        let solver = Solver::new(model, options, workspace);
        let t = [0.0; Lanes::WIDTH];
        Self {
            solver,
            t,
            between: none.clone(),
            given: none.clone(),
            y: none,
            waiting: 0,
            rows: Vec::new(),
        }
    }

    /// Interpolates a step at several times at once, each in the lane that it will be put into.
    pub fn interpolate(&mut self, step: &Step<'_>, mut times: Times) {
        times.rotate_right(self.waiting);
        step.interpolate(Lanes::new(times), &mut self.between);
    }

    /// Puts in the first of the `times` that were interpolated, as many as there are lanes left; how many.
    pub fn add(&mut self, times: &[f64]) -> usize {
        let first = self.waiting;
        let count = times.len().min(Lanes::WIDTH - first);
        self.waiting += count;
        self.t[first..self.waiting].copy_from_slice(&times[..count]);
        if count == Lanes::WIDTH {
            std::mem::swap(&mut self.given, &mut self.between);
            return count;
        }
        let mut new = [0.0; Lanes::WIDTH];
        new[first..self.waiting].fill(1.0);
        let new = Lanes::new(new);
        // not in place: of that compilers make masked stores, which some processors take twenty cycles for
        for ((y, given), between) in self.y.iter_mut().zip(&self.given).zip(&self.between) {
            *y = Lanes::select(new, *between, *given);
        }
        std::mem::swap(&mut self.given, &mut self.y);
        count
    }

    /// Whether no state waits.
    pub fn is_empty(&self) -> bool {
        self.waiting == 0
    }

    /// Whether there is a state for each lane.
    pub fn is_full(&self) -> bool {
        self.waiting == Lanes::WIDTH
    }

    /// The times of the states that wait; then nothing waits.
    pub fn take(&mut self) -> impl Iterator<Item = (usize, f64)> {
        self.t.into_iter().enumerate().take(std::mem::take(&mut self.waiting))
    }

    /// Solves all; whether every one is regular. Else the lanes are of no use.
    pub fn solve(&mut self) -> bool {
        self.fill_up();
        self.y.copy_from_slice(&self.given);
        let solved = self.solver.place_and_solve(Lanes::new(self.t), &mut self.y);
        let (a, lam, energies) = self.solver.found();
        solved.is_ok()
            && [&self.y, a, lam, energies].into_iter().all(are_finite)
            && self.solver.turn(&self.given, &self.y) <= around::TURNED
    }

    /// Lanes without a state of their own repeat the last.
    fn fill_up(&mut self) {
        let last = self.waiting.max(1) - 1;
        if last + 1 == Lanes::WIDTH {
            return;
        }
        let t = self.t[last];
        self.t[last..].fill(t);
        for given in &mut self.given {
            let lanes = given.as_array_mut();
            let y = lanes[last];
            lanes[last..].fill(y);
        }
    }

    /// Keeps the states that wait, as they were solved; then nothing waits.
    pub fn keep(&mut self, trajectory: &mut Trajectory) {
        let count = std::mem::take(&mut self.waiting);
        let (a, lam, energies) = self.solver.found();
        let (q, rest) = self.y.split_at(a.len());
        let (v, works) = rest.split_at(a.len());
        let [kinetic, potential] = *energies;
        let Trajectory { t, q: to_q, v: to_v, a: to_a, lam: to_lam, energy } = trajectory;
        t.extend_from_slice(&self.t[..count]);
        let energies = [kinetic, potential, works[0], works[1], works[2]];
        for (to, lanes) in [(to_q, q), (to_v, v), (to_a, a), (to_lam, lam), (energy, &energies)] {
            self.rows.resize(Lanes::WIDTH * lanes.len(), 0.0);
            Lanes::rows(lanes, &mut self.rows);
            to.extend_from_slice(&self.rows[..count * lanes.len()]);
        }
    }

    /// A state as it was put in.
    pub fn given(&self, lane: usize, y: &mut [f64]) {
        y.iter_mut().zip(&self.given).for_each(|(y, given)| *y = given.to_array()[lane]);
    }
}

/// Whether every number is finite, in every lane.
fn are_finite(x: &[Lanes]) -> bool {
    // 0 x is zero for finite x and NaN otherwise; two sums, of which neither waits for the other
    let mut sums = [Lanes::zero(); 2];
    let pairs = x.chunks_exact(2);
    pairs.remainder().iter().for_each(|x| sums[0] += Lanes::zero() * *x);
    for pair in pairs {
        sums[0] += Lanes::zero() * pair[0];
        sums[1] += Lanes::zero() * pair[1];
    }
    (sums[0] + sums[1]).is_finite()
}
