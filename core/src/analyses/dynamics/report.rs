//! Reported states: brought onto the constraints, and the equations of motion solved there.
//!
//! States of a grid lie between the ends of steps and do not wait for each other, so several are solved
//! at once (`batch`): the same formulas over lanes. Where one of them is not regular (a position near a singular
//! one, a gap that does not close, a number that is not finite), each is solved by itself.

use super::apart::{Apart, Guard};
use super::around;
use super::options::{Options, Stabilization};
use super::system::parts;
use crate::equations::{energy, kinematics, Gains, Workspace};
use crate::math::Real;
use crate::model::Model;
use crate::stabilize::{Fault, Projector};

/// Why a state cannot be reported.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Halt {
    /// It cannot be projected, or has no unique accelerations.
    Fault(Fault),
    /// Its joints are apart.
    Apart(Apart),
    /// A number of it is not finite.
    NotFinite,
}

/// Solves reported states, one at a time or one in each lane.
pub(super) struct Solver<'a, S = f64> {
    pub model: &'a Model<S>,
    workspace: Workspace<S>,
    projector: Option<Projector<'a, S>>,
    guard: Option<Guard<S>>,
    /// Whether projection changed the last state.
    changed: bool,
    /// Kinetic and potential energy, J.
    energies: [S; 2],
    /// States whose projection went through.
    solved: usize,
}

impl<'a, S: Real> Solver<'a, S> {
    /// With the workspace of the equations of motion of this run, or a copy of it.
    pub fn new(model: &'a Model<S>, options: &Options, workspace: Workspace<S>) -> Self {
        let projector = match options.stabilization {
            Stabilization::Projection(projection) => Some(Projector::new(model, projection)),
            _ => None,
        };
        let projector = projector.map(Projector::for_reports);
        let guard = Guard::new(model, options);
        let energies = [S::zero(); 2];
        Self { model, workspace, projector, guard, changed: false, energies, solved: 0 }
    }

    /// Solves at y = (q, v, works) as it is.
    ///
    /// # Errors
    /// [`Halt`] where the equations of motion have no unique solution, or joints are apart.
    pub fn solve(&mut self, t: S, y: &[S]) -> Result<(), Halt> {
        self.set_motions(y);
        self.respond(t)
    }

    /// The joint that is apart at y, if one is.
    pub fn apart(&mut self, t: S, y: &[S]) -> Option<Apart> {
        self.guard.as_ref()?;
        self.set_motions(y);
        self.guard.as_mut()?.look(self.model, t, &self.workspace.motions)
    }

    fn set_motions(&mut self, y: &[S]) {
        let n = self.model.layout.n_q;
        kinematics::motions(&y[..n], &y[n..2 * n], &mut self.workspace.motions);
    }

    /// Solves at y, which is projected first if that was asked for. The works stay: what projection does
    /// to the energy shows in the balance.
    ///
    /// # Errors
    /// [`Halt`]; of lanes, that of one of them.
    pub fn place_and_solve(&mut self, t: S, y: &mut [S]) -> Result<(), Halt> {
        let Some(projector) = &mut self.projector else { return self.solve(t, y) };
        let (q, v, _) = parts(y, self.model.layout.n_q);
        let place = (&mut *q, &mut *v);
        let changed = projector.project(&mut self.workspace, t, place, false);
        self.changed = changed.map_err(Halt::Fault)?;
        self.respond(t)
    }

    /// By what part of the fastest rate projection has changed the rates that were `given`.
    pub fn turn(&self, given: &[S], v: &[S]) -> f64 {
        let projector = self.projector.as_ref().filter(|_| self.changed);
        projector.map_or(0.0, |projector| around::turn(projector, given, v))
    }

    /// Accelerations and multipliers at the motions of the workspace: by γ, never γ̂.
    fn respond(&mut self, t: S) -> Result<(), Halt> {
        let Self { model, workspace, guard, .. } = self;
        let motions = &workspace.motions;
        if let Some(apart) = guard.as_mut().and_then(|guard| guard.look(model, t, motions)) {
            return Err(Halt::Apart(apart));
        }
        let solved = workspace.respond(model, t, Gains::default());
        solved.map_err(|singular| Halt::Fault(Fault::Singular(singular)))?;
        let kinetic = energy::kinetic(model, &workspace.motions);
        self.energies = [kinetic, energy::potential(model, &workspace.motions, t)];
        self.solved += 1;
        Ok(())
    }

    /// q̈, λ and the energies.
    pub fn found(&self) -> (&[S], &[S], &[S; 2]) {
        (self.workspace.a(), self.workspace.lam(), &self.energies)
    }

    /// Factorisations, of all lanes one.
    pub fn factorisations(&self) -> usize {
        self.solved + self.projector.as_ref().map_or(0, |projector| projector.factorisations)
    }
}

impl Solver<'_> {
    /// The same; where that ends on another branch, from states around if that changes rates less.
    ///
    /// # Errors
    /// [`Halt`].
    pub fn place_on_branch_and_solve(&mut self, t: f64, y: &mut [f64]) -> Result<(), Halt> {
        let given = y.to_vec();
        let n = self.model.layout.n_q;
        let turned = |solver: &Self, y: &[f64]| solver.turn(&given[n..2 * n], &y[n..2 * n]);
        self.place_and_solve(t, y)?;
        let turn = turned(self, y);
        let Some(projector) = self.projector.as_mut().filter(|_| turn > around::TURNED) else {
            return Ok(());
        };
        let mut other = given.clone();
        let (q, v, _) = parts(&mut other, n);
        let taken = around::take(projector, &mut self.workspace, t, (q, v));
        let placed = taken.is_ok() && self.place_and_solve(t, &mut other).is_ok();
        if placed && turned(self, &other) < turn {
            y.copy_from_slice(&other);
            return Ok(());
        }
        self.place_and_solve(t, y)
    }
}
