//! Steps along a branch of the motion.
//!
//! A step predicts q + h v + h²/2 a + h³/6 j, with j from the last step, and closes the mechanism by Newton's method. It
//! is accepted if the correction and the change of the velocity that the prediction leaves out are small against the
//! motion over the step. Another branch would be farther away, or have another velocity. Otherwise half the step is
//! tried.

use super::failure::{Failure, Reason};
use super::passage;
use super::quintic::Quintic;
use super::solution::{Point, Solver};
use crate::analyses::mobility::mobility;
use crate::analyses::State;
use crate::model::Model;
use std::sync::Arc;

/// Largest motion over a step: the root mean square over the coordinates, lengths relative to the size of the mechanism.
const LONGEST: f64 = 0.05;
/// Largest correction, as a part of the motion over the step.
const CORRECTION: f64 = 0.05;
/// Correction that is accepted however short the motion is.
const SMALL: f64 = 1e-4;
/// Largest change of the velocity that the prediction leaves out, as a part of the larger velocity.
const TURN: f64 = 0.3;
/// Shortest step, relative to the time to the next output: then the branch is followed by its length.
const SHORTEST: f64 = 1e-5;
/// Longest step, as a part of the longest one, over half of a singular position.
const SHORT: f64 = 0.2;
/// Gap of a start, or of an interpolated position, that counts as closed.
const START: f64 = 1e-9;

/// Follows a motion.
pub(in crate::analyses) struct Continuation<'a> {
    solver: Solver<'a>,
    point: Arc<Point>,
    /// The point before, if the motion between is smooth.
    before: Option<Arc<Point>>,
    /// The next step, if the last one limits it.
    length: f64,
    /// The sign of det Φ_q at the point, if it is known.
    orientation: Option<f64>,
    rejected: usize,
}

impl<'a> Continuation<'a> {
    /// Begins at a state, whose velocities are replaced by those of the drivers.
    pub fn begin(model: &'a Model, start: &State) -> Result<Self, Box<Failure>> {
        let mut solver = Solver::new(model);
        let State { t, q, .. } = start;
        let gaps = solver.phi(*t, q);
        let open = |gap: f64| gap.is_nan() || gap.abs() > START;
        if let Some(row) = (0..gaps.len()).find(|row| open(gaps[*row])) {
            return Err(Reason::open(model, *t, row, gaps[row] * solver.rows[row]).into());
        }
        let freedom = mobility(model, *t, q);
        if freedom.degrees_of_freedom > 0 && freedom.singular.is_empty() {
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
            }),
            None => Err(Reason::singular_start(model, *t, q, &freedom).into()),
        }
    }

    /// The motion now.
    pub fn point(&self) -> &Arc<Point> {
        &self.point
    }

    /// Steps that were taken again.
    pub fn rejected(&self) -> usize {
        self.rejected
    }

    /// The position at `t` that is closed from one nearby.
    pub fn closed(&mut self, t: f64, q: Vec<f64>) -> Option<Vec<f64>> {
        self.solver.point(t, q).map(|point| point.q)
    }

    /// Takes a step, at most to `goal`.
    pub fn step(&mut self, goal: f64) -> Result<(), Reason> {
        let left = goal - self.point.t;
        let pace = self.solver.norm(&self.point.v);
        let most = if pace > 0.0 { LONGEST / pace } else { f64::INFINITY };
        let mut h = left.signum() * self.length.min(most).min(left.abs());
        let shortest = SHORTEST * most.min(left.abs());
        while h.abs() >= shortest {
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
        }
        self.length = f64::INFINITY;
        self.point = passage::around(&mut self.solver, &self.point, goal)?.into();
        (self.before, self.orientation) = (None, None);
        Ok(())
    }

    /// The motion at a singular position, by the polynomials between this point and one as far behind the goal. None if
    /// the motion does not pass it.
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

    /// Whether det Φ_q keeps its sign. It changes only across a singular position, and between branches that nearly meet
    /// at one: a step beside a change point could jump from one to the other.
    fn keeps_orientation(&mut self, next: &Point) -> bool {
        if self.solver.is_clear() {
            return true;
        }
        let before = self.orientation.unwrap_or_else(|| self.solver.orientation(&self.point));
        let after = self.solver.orientation(next);
        let keeps = before * after >= 0.0;
        self.orientation = Some(if keeps { after } else { before });
        keeps
    }

    /// Whether a point that was just solved for lies where the last one leads.
    fn is_near(&self, next: &Point) -> bool {
        let h = next.t - self.point.t;
        let moved = self.solver.apart(&next.q, &self.point.q);
        let turned = self.solver.turned(&self.point, next);
        let fastest = self.solver.norm(&next.v).max(self.solver.norm(&self.point.v));
        moved <= 2.0 * LONGEST
            && self.solver.corrected <= SMALL.max(CORRECTION * moved)
            && (turned <= TURN * fastest || turned * h.abs() <= SMALL)
    }
}
