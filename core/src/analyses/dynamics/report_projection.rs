//! Reported states: projected onto the constraints, or checked for open joints.
//!
//! States of a grid lie between the ends of steps and are independent of each other, so several states are projected
//! at once (`lane_batch`), one in each lane. If one of them is not regular (near a singular position, with a gap that
//! does not close, or with a number that is not finite), each state is projected separately.

use super::branch_averaging;
use super::constraint_violation::ViolationCheck;
use super::options::Options;
use super::redundant_rows;
use super::stabilizations::Stabilization;
use crate::equations::{Gains, Workspace};
use crate::integrate::all_finite;
use crate::math::Real;
use crate::model::Model;
use crate::solve::Breakdown;
use crate::stabilize::Projector;

/// Projects reported states, one at a time or one in each lane.
pub(super) struct ReportProjection<'a, S = f64> {
    pub model: &'a Model<S>,
    workspace: Workspace<S>,
    projector: Option<Projector<'a, S>>,
    check: Option<ViolationCheck<S>>,
    /// Whether projection changed the last state.
    changed: bool,
    /// Whether states are projected to rounding errors.
    sharp: bool,
}

impl<'a, S: Real> ReportProjection<'a, S> {
    /// Uses the workspace of the equations of motion of this run, or a copy of it.
    pub fn new(model: &'a Model<S>, options: &Options, workspace: Workspace<S>) -> Self {
        let projector = match options.stabilization {
            Stabilization::Projection(projection) => Some(Projector::new(model, projection)),
            _ => None,
        };
        let projector = projector.map(Projector::for_reports);
        let check = ViolationCheck::new(model, options);
        Self { model, workspace, projector, check, changed: false, sharp: false }
    }

    /// The rows that are omitted.
    pub fn omitted(&self) -> &[usize] {
        self.workspace.matrix.omitted()
    }

    /// Omits exactly these rows.
    pub fn omit(&mut self, rows: &[usize]) {
        self.workspace.omit(rows);
    }

    /// Sets whether states are projected to rounding errors, as states near a singular position.
    pub fn sharpen(&mut self, sharp: bool) {
        self.sharp = sharp;
        self.projector.iter_mut().for_each(|projector| projector.sharpen(sharp, sharp));
    }

    /// Whether states are projected to rounding errors.
    pub fn is_sharp(&self) -> bool {
        self.sharp
    }

    /// The joint that is open too far at y, if any.
    pub fn violation(&mut self, t: S, y: &[S]) -> Option<Breakdown> {
        self.check.as_ref()?;
        self.set_motions(y);
        self.check.as_mut()?.largest(self.model, t, &self.workspace.motions)
    }

    fn set_motions(&mut self, y: &[S]) {
        let [q, v, z, _] = self.model.layout.split(y);
        self.workspace.place(self.model, [q, v, z]);
    }

    /// Projects y = (q, v, works) if the run uses projection; otherwise checks the joints. The works do not change,
    /// so the energy balance shows the change of energy by projection.
    ///
    /// # Errors
    /// [`Breakdown`]; over lanes, the breakdown of one lane.
    pub fn place(&mut self, t: S, y: &mut [S]) -> Result<(), Breakdown> {
        let Some(projector) = &mut self.projector else {
            return self.violation(t, y).map_or(Ok(()), Err);
        };
        let [q, v, ..] = self.model.layout.split_mut(y);
        self.changed = projector.project(&mut self.workspace, t, (q, v), false)?;
        Ok(())
    }

    /// Change of the `given` rates by projection, as a fraction of the fastest rate.
    pub fn turn(&self, given: &[S], v: &[S]) -> f64 {
        let projector = self.projector.as_ref().filter(|_| self.changed);
        projector.map_or(0.0, |projector| branch_averaging::turn(projector, given, v))
    }

    /// Number of factorisations. A factorisation over all lanes counts once.
    pub fn factorisations(&self) -> usize {
        self.projector.as_ref().map_or(0, |projector| projector.factorisations)
    }
}

impl ReportProjection<'_> {
    /// Checks that the joints are closed at y, and that the equations of motion have a solution there.
    ///
    /// # Errors
    /// [`Breakdown`].
    pub fn begin(&mut self, t: f64, y: &[f64]) -> Result<(), Breakdown> {
        if let Some(violation) = self.violation(t, y) {
            return Err(violation);
        }
        self.set_motions(y);
        self.workspace.respond(self.model, t, Gains::default())?;
        match [self.workspace.a(), self.workspace.lam()].into_iter().all(all_finite) {
            true => Ok(()),
            false => Err(Breakdown::NotFinite),
        }
    }

    /// Omits other redundant rows if the state requires it.
    pub fn exchange_rows(&mut self, t: f64, state: [&[f64]; 3]) {
        redundant_rows::exchange(self.model, &mut self.workspace, t, state);
    }

    /// Whether the matrix of the last projection belongs to a position at or near a singular one.
    fn is_near_singular(&self) -> bool {
        let matrix = &self.workspace.matrix;
        let kept = matrix.cancellation().map_or(1.0, |(_, kept)| kept);
        matrix.regularised() || kept < branch_averaging::NEAR
    }

    /// Whether two states are so close to each other that they may lie on two branches near a singular position. This
    /// does not apply to a mechanism at rest, whose rates are rounding errors.
    fn is_beside(&self, y: &[f64], other: &[f64]) -> bool {
        let [q, ..] = self.model.layout.split(y);
        let [to, ..] = self.model.layout.split(other);
        let apart = self.projector.as_ref().map(|projector| projector.largest_difference(q, to));
        apart.is_some_and(|apart| apart < branch_averaging::BESIDE)
    }

    /// Projects a reported state. If it ends on another branch near a singular position, computes the state from
    /// neighbouring states instead, provided that this changes the rates less.
    ///
    /// # Errors
    /// [`Breakdown`].
    pub fn place_on_branch(&mut self, t: f64, y: &mut [f64]) -> Result<(), Breakdown> {
        let given = y.to_vec();
        let layout = &self.model.layout;
        let turned =
            |solver: &Self, y: &[f64]| solver.turn(layout.split(&given)[1], layout.split(y)[1]);
        self.place(t, y)?;
        let turn = turned(self, y);
        // the rates of a mechanism nearly at rest also change by a large fraction, but there are no other branches
        let near = turn > branch_averaging::TURNED && self.is_near_singular();
        let Some(projector) = self.projector.as_mut().filter(|_| near) else {
            return Ok(());
        };
        let mut other = given.clone();
        let [q, v, ..] = layout.split_mut(&mut other);
        let taken = branch_averaging::take(projector, &mut self.workspace, t, (q, v));
        let placed = taken.is_ok() && self.place(t, &mut other).is_ok();
        if placed && turned(self, &other) < turn && self.is_beside(&other, y) {
            y.copy_from_slice(&other);
            return Ok(());
        }
        self.place(t, y)
    }
}
