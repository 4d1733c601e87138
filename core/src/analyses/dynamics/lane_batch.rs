//! Reported states of a grid, projected and stored four at once.

use super::branch_averaging;
use super::options::Options;
use super::report_projection::ReportProjection;
use super::trajectory::Trajectory;
use super::wide::Wide;
use crate::equations::augmented::NearSingular;
use crate::equations::Workspace;
use crate::integrate::Step;
use crate::math::{each, Lanes, Real};

/// States of a grid, collected until there is one for each lane.
pub(super) struct LaneBatch<'a> {
    wide: Wide<'a>,
    pub placer: ReportProjection<'a, Lanes>,
    t: [f64; Lanes::WIDTH],
    count: usize,
    /// The states as added, a row for each lane.
    given: Vec<f64>,
    /// Their rates.
    rates: Vec<Lanes>,
    /// The projected states.
    y: Vec<Lanes>,
}

impl<'a> LaneBatch<'a> {
    /// Uses the elimination plan of the equations of motion of this run.
    pub fn new(wide: Wide<'a>, options: &Options, one: &Workspace) -> Self {
        let model = wide.model();
        let (n, len) = (model.layout.n_q, model.layout.n_y());
        let mut workspace = Workspace::like(model, one);
        workspace.matrix.set_near_singular(NearSingular::Refuse);
        Self {
            wide,
            placer: ReportProjection::new(model, options, workspace),
            t: [0.0; Lanes::WIDTH],
            count: 0,
            given: vec![0.0; Lanes::WIDTH * len],
            rates: vec![Lanes::zero(); n],
            y: vec![Lanes::zero(); len],
        }
    }

    /// Adds the state of a step at a time; there must be a free lane.
    pub fn add(&mut self, step: &Step<'_>, t: f64) {
        let (lane, len) = (self.count, self.y.len());
        self.t[lane] = t;
        step.interpolate(t, &mut self.given[lane * len..(lane + 1) * len]);
        self.count += 1;
    }

    /// Whether it contains no state.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Whether there is a state for each lane.
    pub fn is_full(&self) -> bool {
        self.count == Lanes::WIDTH
    }

    /// Returns the times of the states and empties the batch.
    pub fn take(&mut self) -> impl Iterator<Item = (usize, f64)> {
        self.t.into_iter().enumerate().take(std::mem::take(&mut self.count))
    }

    /// Projects all states. Returns whether all of them are regular; if not, the lanes are invalid.
    pub fn place(&mut self) -> bool {
        self.fill_up();
        Lanes::from_rows(&self.given, &mut self.y);
        let layout = &self.wide.model().layout;
        self.rates.copy_from_slice(layout.split(&self.y)[1]);
        self.placer.place(Lanes::new(self.t), &mut self.y).is_ok()
            && are_finite([&self.y])
            && self.placer.turn(&self.rates, layout.split(&self.y)[1]) <= branch_averaging::TURNED
    }

    /// Fills free lanes with the last state.
    fn fill_up(&mut self) {
        let (last, len) = (self.count.max(1) - 1, self.y.len());
        for lane in last + 1..Lanes::WIDTH {
            self.t[lane] = self.t[last];
            self.given.copy_within(last * len..(last + 1) * len, lane * len);
        }
    }

    /// Stores the projected states and empties the batch.
    pub fn keep(&mut self, trajectory: &mut Trajectory) {
        let count = std::mem::take(&mut self.count);
        let parts = self.wide.model().layout.split(&self.y);
        let Trajectory { t, q, v, z, works } = trajectory;
        t.extend_from_slice(&self.t[..count]);
        for (to, lanes) in [q, v, z, works].into_iter().zip(parts) {
            let (start, width) = (to.len(), lanes.len());
            to.resize(start + Lanes::WIDTH * width, 0.0);
            Lanes::rows(lanes, &mut to[start..]);
            to.truncate(start + count * width);
        }
    }

    /// A state as added.
    pub fn given(&self, lane: usize, y: &mut [f64]) {
        y.copy_from_slice(&self.given[lane * y.len()..][..y.len()]);
    }
}

/// Whether every number is finite, in every lane.
#[inline]
pub(super) fn are_finite<const N: usize>(parts: [&[Lanes]; N]) -> bool {
    // 0 x is zero for finite x and NaN otherwise; the sums are independent of each other
    let nothing = |sum: Lanes, x: &Lanes| sum.plus_product(Lanes::zero(), *x);
    let sums = each(parts, |part| part.iter().fold(Lanes::zero(), nothing));
    sums.into_iter().fold(Lanes::zero(), |all, sum| all + sum).is_finite()
}
