//! The equations of motion as a first-order system y = (q, v, work).

use super::options::Options;
use super::singularity_passage::SingularityPassage;
use super::stabilizations::Stabilization;
use crate::analyses::mobility;
use crate::equations::augmented::{Dependent, NearSingular};
use crate::equations::{Gains, Plan, Singular, Workspace};
use crate::integrate::{all_finite, Ode};
use crate::math::{Lanes, Real};
use crate::model::Model;
use crate::stabilize::{Fault, Projector, StepwiseBaumgarte};
use std::sync::Arc;

/// Works that are integrated beside the motion: dissipated, of drivers, of applied forces.
pub(super) const WORKS: usize = 3;

/// The right side of forward dynamics.
pub(super) struct MotionOde<'a> {
    pub model: &'a Model,
    pub workspace: Workspace,
    pub gains: Gains,
    /// Baumgarte's term, if its gains come from the step.
    held: Option<StepwiseBaumgarte>,
    pub projector: Option<Projector<'a>>,
    /// Whether singular positions are passed.
    pub passing: bool,
    pub passage: SingularityPassage,
}

/// Splits y into q, v and the works.
pub(super) fn parts<S>(y: &mut [S], n_q: usize) -> (&mut [S], &mut [S], &mut [S]) {
    let (q, rest) = y.split_at_mut(n_q);
    let (v, works) = rest.split_at_mut(n_q);
    (q, v, works)
}

/// dy = (v, a, powers), stored in the blocks that the next stage loads: of what was stored in parts just now no
/// vector can be loaded soon.
#[inline(always)]
fn join(v: &[f64], a: &[f64], powers: [f64; WORKS], dy: &mut [f64]) {
    // each knows how many of v are left behind its last block, and with that what is left of all
    match v.len() % Lanes::WIDTH {
        0 => join_behind::<0>(v, a, powers, dy),
        1 => join_behind::<1>(v, a, powers, dy),
        2 => join_behind::<2>(v, a, powers, dy),
        _ => join_behind::<3>(v, a, powers, dy),
    }
}

#[inline(always)]
fn join_behind<const LEFT: usize>(
    v: &[f64],
    mut a: &[f64],
    [dissipated, drivers, applied]: [f64; WORKS],
    dy: &mut [f64],
) {
    // -0 changes no number, and i, j, k are 1, 2, 3; compilers that knew them would load vectors of a, which was
    // stored in parts just now, and store blocks in parts
    let (nothing, one) = std::hint::black_box((-0.0, 1));
    let (i, j, k) = (one & 1, (2 * one) & 2, (one & 1) | ((2 * one) & 2));
    let whole = |four| (Lanes::new(four) + Lanes::constant(nothing)).to_array();
    let mut blocks = dy.chunks_exact_mut(Lanes::WIDTH);
    let mut of_v = v.chunks_exact(Lanes::WIDTH);
    for (v, block) in (&mut of_v).zip(&mut blocks) {
        block.copy_from_slice(v);
    }
    // where v ends a begins
    if let (1.., Some(first)) = (LEFT, a.first_chunk::<3>()) {
        let left = of_v.remainder();
        let border = match LEFT {
            1 => [left[0], first[0], first[i], first[j]],
            2 => [left[0], left[1], first[0], first[i]],
            _ => [left[0], left[1], left[2], first[0]],
        };
        blocks.next().expect("a block").copy_from_slice(&whole(border));
        a = &a[Lanes::WIDTH - LEFT..];
    }
    let mut of_a = a.chunks_exact(Lanes::WIDTH);
    for (a, block) in (&mut of_a).zip(&mut blocks) {
        block.copy_from_slice(&whole([a[0], a[i], a[j], a[k]]));
    }
    // n is a multiple of 3, so that of 2 n numbers none or two are left
    match (of_a.remainder(), LEFT % 2) {
        (a @ [_, _], 1) => {
            let block = blocks.next().expect("a block");
            block.copy_from_slice(&whole([a[0], a[i], dissipated, drivers]));
            blocks.into_remainder().copy_from_slice(&[applied]);
        }
        _ => blocks.into_remainder().copy_from_slice(&[dissipated, drivers, applied]),
    }
}

impl<'a> MotionOde<'a> {
    /// With the plan of elimination of the model.
    pub fn new(model: &'a Model, options: &Options, plan: Arc<Plan>) -> Self {
        let projector = match options.stabilization {
            Stabilization::Projection(projection) => Some(Projector::new(model, projection)),
            _ => None,
        };
        let mut workspace = Workspace::on(model, plan);
        // without projection nothing brings a state back to its branch
        let passing = projector.is_some() && !model.allow_redundancy;
        if passing {
            workspace.matrix.set_near_singular(NearSingular::Regularise);
        }
        let passage = SingularityPassage::new(options, passing);
        let held = match options.stabilization {
            Stabilization::BaumgarteFromStep => Some(StepwiseBaumgarte::new(model)),
            _ => None,
        };
        Self { model, workspace, gains: options.gains(), held, projector, passing, passage }
    }

    /// Factorisations beside those of evaluations.
    pub fn factorisations(&self) -> usize {
        self.projector.as_ref().map_or(0, |projector| projector.factorisations)
    }

    /// Refuses a start whose constraints are dependent for good, not in passing.
    pub fn begin(&mut self, t: f64, y: &[f64]) -> Result<(), Singular> {
        let n = self.model.layout.n_q;
        let (q, v) = (&y[..n], &y[n..2 * n]);
        if self.workspace.accelerate(self.model, t, [q, v, &[]], self.gains).is_err() {
            return Ok(()); // the first step tells
        }
        self.passage.begin(t, &self.workspace);
        let near = self.workspace.matrix.regularised();
        match self.workspace.matrix.cancellation().filter(|_| near) {
            Some((row, _)) if !mobility(self.model, t, q).redundant.is_empty() => {
                Err(Singular(Dependent::Row(row)))
            }
            _ => Ok(()),
        }
    }

    /// dy at y, where the bodies may be `placed` already: one function, since two copies of it are more than the
    /// nearest cache holds.
    #[inline(never)]
    fn evaluate(
        &mut self,
        t: f64,
        y: &[f64],
        dy: &mut [f64],
        placed: bool,
    ) -> Result<(), (f64, Fault)> {
        let n = self.model.layout.n_q;
        let (q, v) = (&y[..n], &y[n..2 * n]);
        if !placed {
            self.workspace.place(self.model, [q, v, &[]]);
        }
        if let Err(singular) = self.workspace.respond(self.model, t, self.gains) {
            dy.fill(f64::NAN);
            return stop_if_finite(singular, t, y);
        }
        if !self.passage.watch(self.model, &self.workspace, t, v) {
            dy.fill(f64::NAN); // a shorter step may avoid it
            return Ok(());
        }
        let powers = self.workspace.powers(self.model, v);
        let works = [powers.dissipated, powers.drivers, powers.applied];
        join(v, self.workspace.a(), works, dy);
        Ok(())
    }

    /// Projects y if that was asked for; whether it changed. The works stay: what projection does to
    /// the energy shows in the balance.
    pub fn project(&mut self, t: f64, y: &mut [f64], factored: bool) -> Result<bool, (f64, Fault)> {
        let Some(projector) = &mut self.projector else { return Ok(false) };
        let (q, v, _) = parts(y, self.model.layout.n_q);
        projector.project(&mut self.workspace, t, (q, v), factored).map_err(|fault| (t, fault))
    }
}

/// Stops where no unique accelerations are; a trial state that is not finite is off itself, and a shorter step
/// may do.
#[cold]
fn stop_if_finite(singular: Singular, t: f64, y: &[f64]) -> Result<(), (f64, Fault)> {
    match all_finite(y) {
        true => Err((t, Fault::Singular(singular))),
        false => Ok(()),
    }
}

impl Ode for MotionOde<'_> {
    type Stop = (f64, Fault);

    fn len(&self) -> usize {
        2 * self.model.layout.n_q + WORKS
    }

    fn positions(&self) -> usize {
        self.model.layout.n_q
    }

    /// Steps are judged by the motion alone.
    fn controlled(&self) -> usize {
        2 * self.model.layout.n_q
    }

    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Self::Stop> {
        self.evaluate(t, y, dy, false)
    }

    /// Projection leaves the bodies where y says.
    fn rate_projected(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Self::Stop> {
        self.evaluate(t, y, dy, true)
    }

    /// Gains may come from the step.
    fn before_trial(&mut self, t: f64, y: &[f64], h: f64) -> bool {
        let Some(held) = &mut self.held else { return false };
        let n = self.model.layout.n_q;
        held.hold(self.model, &mut self.workspace, t, (&y[..n], &y[n..2 * n]), h);
        true
    }

    /// Near a singular position noise along the direction that is lost there would refuse every step.
    fn project_error(&mut self, dy: &mut [f64]) -> bool {
        let (true, Some(projector)) = (self.passage.near, &mut self.projector) else {
            return false;
        };
        let (dq, dv, _) = parts(dy, self.model.layout.n_q);
        projector.tangent(&self.workspace, dq);
        projector.tangent(&self.workspace, dv);
        true
    }

    fn near_time_to_avoid(&self) -> bool {
        self.passage.near || self.passage.in_reach()
    }

    /// A singular position ahead.
    fn time_to_avoid(&mut self, t: f64) -> Option<f64> {
        self.passage.foresee(t, &self.workspace)
    }

    /// The last evaluation was near the end of the step: its factor serves.
    fn project_accepted(&mut self, t: f64, y: &mut [f64]) -> Result<bool, Self::Stop> {
        if let Some(projector) = &mut self.projector {
            projector.sharpen(self.passage.in_reach());
        }
        self.project(t, y, true)
    }

    /// From here the way to a singular position is seen on.
    fn on_accepted_end(&mut self, t: f64) {
        self.passage.accept(t, &self.workspace);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_accelerations_and_powers_follow_each_other() {
        for bodies in 0..12 {
            let n = 3 * bodies;
            let all: Vec<f64> = (0..2 * n + WORKS).map(|k| k as f64 - 0.5).collect();
            let (v, rest) = all.split_at(n);
            let (a, powers) = rest.split_at(n);
            let mut dy = vec![f64::NAN; all.len()];
            join(v, a, [powers[0], powers[1], powers[2]], &mut dy);
            assert_eq!(dy, all);
        }
    }
}
