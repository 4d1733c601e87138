//! Steps along a branch of the motion.
//!
//! A step predicts q + h v + h²/2 a + h³/6 j, with j from the last step, and closes the mechanism by Newton's method.
//! It is accepted if the correction is small compared with the motion over the step, and if the velocity differs
//! little from a linear prediction. A position on another branch would be farther away or have a different velocity.
//! A rejected step is halved.

use super::barriers::Barriers;
use super::dead_point::Limit;
use super::failure::{self, Failure, Reason};
use super::passage;
use super::quintic::Quintic;
use super::solution::{Point, Solver};
use crate::analyses::second_order::mobility;
use crate::analyses::State;
use crate::math::Listed;
use crate::model::{Model, BEAM};
use std::sync::Arc;

/// Largest motion over a step: the root mean square over the coordinates, lengths relative to the size of the mechanism.
const LONGEST: f64 = 0.05;
/// Largest correction, as a fraction of the motion over the step.
const CORRECTION: f64 = 0.05;
/// Correction that is always accepted, even if the motion over the step is shorter.
const SMALL: f64 = 1e-4;
/// Largest deviation of the velocity from its linear prediction, as a fraction of the larger of the two velocities.
const TURN: f64 = 0.3;
/// Largest change of position, if the velocity deviates, that is accepted as a jump of the velocity of a law.
const KINK: f64 = 1e-6;
/// Step, relative to the smaller of the longest step and the time to the next output, below which the branch is
/// followed by arc length.
const BY_LENGTH: f64 = 1e-3;
/// Shortest step, relative to the same time.
const SHORTEST: f64 = 1e-6;
/// Longest step that may end at a singular position, as a fraction of the longest step.
const SHORT: f64 = 0.2;
/// Largest scaled residual at which the start, or an interpolated position, counts as closed.
const START: f64 = 1e-9;

/// Largest number of times that a step is halved to decide whether it passes a barrier. A barrier that is passed by less
/// than the error of the polynomial over the shortest part is not reached.
const MOST_HALVED: usize = 6;

/// Width to which the last position within limits is located, as a fraction of t or of 1.
const LOCATED: f64 = 1e-14;

/// Follows a motion.
pub(in crate::analyses) struct Continuation<'a> {
    solver: Solver<'a>,
    point: Arc<Point>,
    /// The previous point, if the motion since then is smooth.
    before: Option<Arc<Point>>,
    /// Upper bound of the next step, set by the last step; infinite if there is none.
    length: f64,
    /// The sign of det Φ_q at the point, if it is known.
    orientation: Option<f64>,
    rejected: usize,
    /// What the motion must not pass.
    barriers: Barriers,
}

impl<'a> Continuation<'a> {
    /// Begins at a state. Its velocities are replaced by those that the drivers prescribe.
    pub fn begin(model: &'a Model, start: &State) -> Result<Self, Box<Failure>> {
        let mut solver = Solver::new(model);
        let State { t, q, .. } = start;
        let gaps = solver.phi(*t, q);
        let open = |gap: f64| gap.is_nan() || gap.abs() > START;
        if let Some(row) = (0..gaps.len()).find(|row| open(gaps[*row])) {
            return Err(Reason::open(model, *t, row, gaps[row] * solver.rows[row]).into());
        }
        let barriers = Barriers::of(model);
        if let Some((name, gap)) = barriers.contact_beyond(model, *t, q) {
            return Err(Reason::Beyond { t: *t, name, gap }.into());
        }
        let freedom = mobility(model, *t, q);
        if freedom.degrees_of_freedom > 0 && freedom.singular.is_empty() {
            if let Some(beam) = model.bodies.iter().find(|body| body.kind == BEAM) {
                let mut drivers = model.constraints.iter();
                let driver = drivers.find(|item| item.element.drives().is_some());
                let driver = driver.map(|item| item.name.clone());
                return Err(Reason::Bends(beam.name.clone(), driver).into());
            }
            return Err(Reason::Free { degrees_of_freedom: freedom.degrees_of_freedom }.into());
        }
        match solver.point(*t, q.clone()) {
            Some(point) => Ok(Self {
                solver,
                point: point.into(),
                before: None,
                length: f64::INFINITY,
                orientation: None,
                rejected: 0,
                barriers,
            }),
            None => Err(Reason::singular_start(model, *t, q, &freedom).into()),
        }
    }

    /// The current point of the motion.
    pub fn point(&self) -> &Arc<Point> {
        &self.point
    }

    /// Number of rejected steps.
    pub fn rejected(&self) -> usize {
        self.rejected
    }

    /// Takes a step, at most to `goal`. The motion ends at a limit, which is then the current point unless it is a dead
    /// point.
    pub fn step(&mut self, goal: f64) -> Result<(), Reason> {
        let from = Arc::clone(&self.point);
        let advanced = self.advance(goal);
        let outside = match &advanced {
            Ok(()) => self.outside(&from, Arc::clone(&self.point), MOST_HALVED),
            Err(Reason::Limit(limit)) => {
                let Limit { t, q, .. } = &**limit;
                self.is_beyond(*t, q)
                    .then(|| Point { t: *t, q: q.clone(), ..(*from).clone() }.into())
            }
            Err(_) => None,
        };
        let Some(outside) = outside else { return advanced };
        let model = self.solver.model;
        let reached = self.barriers.beyond(model, outside.t, &outside.q).unwrap_or_default();
        let barriers = self.barriers.clone();
        self.point = outside;
        self.back(from, |t, q: &[f64]| barriers.allow(model, t, q));
        Err(Reason::Limit(Box::new(Limit::of_barrier(model, &self.point, reached))))
    }

    fn is_beyond(&self, t: f64, q: &[f64]) -> bool {
        self.barriers.beyond(self.solver.model, t, q).is_some()
    }

    /// A point of the motion between two points that is beyond a barrier. Where the polynomial between them passes one
    /// but the motion does not, the step is halved, because the error of the polynomial is then 64 times smaller.
    fn outside(&mut self, from: &Point, to: Arc<Point>, halvings: usize) -> Option<Arc<Point>> {
        let passed = self.barriers.passed(self.solver.model, from, &to);
        let end = self.is_beyond(to.t, &to.q).then(|| Arc::clone(&to));
        let Some(t) = passed.filter(|t| *t != to.t || end.is_none()) else { return end };
        let closed = |solver: &mut Solver<'a>, t: f64| {
            let quintic = Quintic::new(from, &to);
            let guess = quintic.at((t - from.t) / quintic.h).q;
            solver.point(t, guess).map(Arc::new)
        };
        if let Some(there) = closed(&mut self.solver, t).filter(|at| self.is_beyond(at.t, &at.q)) {
            return Some(there);
        }
        let middle = (halvings > 0).then(|| closed(&mut self.solver, 0.5 * (from.t + to.t)));
        let Some(middle) = middle.flatten() else { return end };
        let first = self.outside(from, Arc::clone(&middle), halvings - 1);
        first.or_else(|| self.outside(&middle, to, halvings - 1))
    }

    /// Goes back, within the last step from a point, to the last position that is `inside`, by bisection.
    fn back(&mut self, from: Arc<Point>, inside: impl Fn(f64, &[f64]) -> bool) {
        let mut outside = std::mem::replace(&mut self.point, from);
        (self.before, self.orientation, self.length) = (None, None, f64::INFINITY);
        loop {
            let Point { t, q, .. } = &*self.point;
            let middle = 0.5 * (t + outside.t);
            let width = LOCATED * t.abs().max(1.0);
            if (outside.t - t).abs() <= width || middle == *t || middle == outside.t {
                return;
            }
            let guess = q.iter().zip(&outside.q).map(|(a, b)| 0.5 * (a + b)).list();
            let Some(between) = self.solver.point(middle, guess) else { return };
            match inside(middle, &between.q) {
                true => self.point = between.into(),
                false => outside = between.into(),
            }
        }
    }

    fn advance(&mut self, goal: f64) -> Result<(), Reason> {
        let left = goal - self.point.t;
        let pace = self.solver.norm(&self.point.v);
        let most = if pace > 0.0 { LONGEST / pace } else { f64::INFINITY };
        let scale = most.min(left.abs());
        // the last step may have been as short as a rounding error, because it ended at an output
        let mut h = left.signum() * self.length.max(BY_LENGTH * scale).min(scale);
        let mut lost = None;
        while h.abs() >= SHORTEST * scale {
            // the last step ends at the goal exactly
            let t = if h == left { goal } else { self.point.t + h };
            let predicted = self.point.predicted(h, self.before.as_deref());
            if let Some(next) = self.solver.point(t, predicted) {
                if self.is_near(&next) && self.keeps_orientation(&next) {
                    self.length = 2.0 * h.abs();
                    self.before = Some(std::mem::replace(&mut self.point, next.into()));
                    return Ok(());
                }
            }
            self.before = None;
            self.rejected += 1;
            if h == left && h.abs() <= SHORT * most {
                if let Some(next) = self.across(goal) {
                    self.point = next.into();
                    (self.before, self.orientation) = (None, None);
                    return Ok(());
                }
            }
            h *= 0.5;
            if h.abs() < BY_LENGTH * scale && lost.is_none() {
                match passage::around(&mut self.solver, &self.point, goal) {
                    Ok(next) => {
                        self.length = f64::INFINITY;
                        self.point = next.into();
                        (self.before, self.orientation) = (None, None);
                        return Ok(());
                    }
                    Err(limit @ Reason::Limit(_)) => return Err(limit),
                    Err(reason) => lost = Some(reason),
                }
            }
        }
        Err(lost.unwrap_or_else(|| failure::lost(self.solver.model, self.point.t, &self.point.q)))
    }

    /// The motion at a singular position `goal`, interpolated between this point and a point equally far beyond
    /// `goal`. None if the motion cannot be continued beyond it.
    fn across(&mut self, goal: f64) -> Option<Point> {
        let h = 2.0 * (goal - self.point.t);
        let predicted = self.point.predicted(h, None);
        let beyond = self.solver.point(self.point.t + h, predicted)?;
        if !self.is_near(&beyond) {
            return None;
        }
        let middle = Point { t: goal, ..Quintic::new(&self.point, &beyond).at(0.5) };
        let gaps = self.solver.phi(goal, &middle.q);
        gaps.iter().all(|gap| gap.abs() <= START).then_some(middle)
    }

    /// Whether det Φ_q keeps its sign. The sign changes only across a singular position, and between branches that
    /// nearly meet there. The test rejects a step that would jump between two such branches, or that ends so near to a
    /// singular position that rounding errors determine the sign.
    fn keeps_orientation(&mut self, next: &Point) -> bool {
        let before = self.orientation.or_else(|| self.solver.orientation(&self.point));
        let Some((before, after)) = before.zip(self.solver.orientation(next)) else { return true };
        let keeps = after != 0.0 && before * after >= 0.0;
        self.orientation = Some(if keeps { after } else { before });
        keeps
    }

    /// Whether the point that was solved last continues the branch of the current point.
    fn is_near(&self, next: &Point) -> bool {
        let h = next.t - self.point.t;
        let moved = self.solver.apart(&next.q, &self.point.q);
        let turned = self.solver.turned(&self.point, next);
        let fastest = self.solver.norm(&next.v).max(self.solver.norm(&self.point.v));
        moved <= 2.0 * LONGEST
            && self.solver.corrected <= SMALL.max(CORRECTION * moved)
            && (turned <= TURN * fastest || turned * h.abs() <= KINK)
    }
}
