//! Switches during a run. The piece of each switch is constant during a step, and steps end where a piece ends.
//!
//! Switches that depend on time alone are listed in a [`Schedule`]. The functions of the other switches are scanned
//! with their bounds on the interpolant of each step (`integrate::scan`). Where a switch leaves its piece, the step is
//! taken again up to this time with the old piece, and the next step begins with the new piece.
//!
//! A switch that changes back at once holds the motion between two pieces (`sliding`). If the accelerations of both
//! pieces are equal, the switch is released: its law then selects the piece at each evaluation, until it has kept one
//! piece for [`CALM`] steps. Otherwise the motion slides along the switch, which laws cannot describe, and the run
//! ends.

mod calm;
mod curve_break;
mod forms;
mod margins;
mod sliding;

use super::contact_resolution::{self, StepChoice};
use super::law_jump::LawJump;
use super::motion_ode::MotionOde;
use super::switch_schedule::{changed_constraints, Schedule};
use crate::equations::forces::Acting;
use crate::equations::kinematics::Motions;
use crate::equations::{switches, Gains, Workspace};
use crate::integrate::{Cause, Scan, Step, TooFast};
use crate::math::Listed;
use crate::model::{Model, SwitchOwner};
use crate::solve::Breakdown;
use forms::SwitchForm;

/// Number of changes of one switch within [`SHORT`] of the run after which it counts as stuck.
const STUCK: usize = 8;
/// Fraction of a run within which changes of a switch count as immediate.
const SHORT: f64 = 1e-9;
/// Number of steps on one piece after which a released switch is held again.
const CALM: usize = 10;
/// Rounding errors of a function that does not jump, relative to its values.
const ROUNDING: f64 = 1e-12;
/// Number of times that a step is taken again for one switch while its interpolant becomes more accurate.
const AGAIN: usize = 3;

/// The state of a switch in a run.
#[derive(Clone, Copy, Debug)]
struct History {
    /// The time of its last change, and the number of immediate changes in sequence.
    last: f64,
    quick: usize,
    /// For a released switch: the piece of the last steps, and their number.
    calm: (f64, usize),
    /// Evaluations in a row whose function is a rounding error.
    noisy: usize,
}

/// Changes of pieces at a time.
#[derive(Debug)]
struct Due {
    t: f64,
    changes: Vec<(usize, f64)>,
    /// Number of times that the step to this time was taken again.
    tries: usize,
}

/// How a run continues after a step.
pub(super) enum After {
    /// The step is accepted.
    Accept,
    /// The step is taken again, up to the switch that is now due.
    Again,
    /// The step is taken again, and the changes that are now due take effect at its beginning.
    Change,
}

/// The switches of a run.
pub(super) struct Switching {
    pub schedule: Schedule,
    /// The next entry of the schedule.
    next: usize,
    t_end: f64,
    /// Length of the run, and its direction.
    length: f64,
    sign: f64,
    /// The held pieces.
    pub pieces: Vec<f64>,
    /// The switches that depend on the state.
    on_state: Vec<usize>,
    /// The form of the function of each of them.
    forms: Vec<SwitchForm>,
    history: Vec<History>,
    due: Option<Due>,
    /// The switches that have changed since the last accepted step.
    causes: Vec<usize>,
    /// Evaluates the functions of switches.
    workspace: Option<Box<Workspace>>,
    steps: StepChoice,
    /// Ends of the first steps of a contact, last step first.
    graded: Vec<f64>,
    motions: Motions,
    sigma: Vec<f64>,
    /// The largest derivative of each component so far.
    largest: Vec<f64>,
}

impl Switching {
    /// The switches of a run that begins with `y` at `t`. None if no piece is held: a run may begin at a switch, from which its
    /// steps hold the piece that the law itself may not select there.
    pub fn new(
        ode: &mut MotionOde<'_>,
        (schedule, steps): (Schedule, StepChoice),
        t: f64,
        t_end: f64,
        y: &[f64],
    ) -> Option<Self> {
        let model = ode.model;
        let n = model.switches.len();
        let on_state = |k: &usize| model.switches[*k].state && !model.switches[*k].smooth;
        let on_state: Vec<usize> = (0..n).filter(on_state).list();
        let holds = !on_state.is_empty() || schedule.start.iter().any(|piece| !piece.is_nan());
        if !holds && schedule.times.is_empty() {
            return None;
        }
        let reactive = on_state.iter().any(|k| match model.switches[*k].owner {
            SwitchOwner::Force(f) => model.forces[f].reaction.is_some(),
            SwitchOwner::Constraint(_) => false,
        });
        let calm = (f64::NAN, 0);
        let mut switching = Self {
            pieces: schedule.start.clone(),
            schedule,
            next: 0,
            t_end,
            length: (t_end - t).abs(),
            sign: (t_end - t).signum(),
            history: vec![History { last: f64::NAN, quick: 0, calm, noisy: usize::MAX }; n],
            forms: on_state.iter().map(|k| SwitchForm::of(model, *k)).list(),
            on_state,
            due: None,
            causes: Vec::new(),
            workspace: reactive.then(|| Box::new(ode.workspace.clone())),
            steps,
            graded: Vec::new(),
            motions: Motions::new(&model.layout),
            sigma: vec![0.0; n],
            largest: vec![0.0; y.len()],
        };
        switching.begin(ode, t, y);
        Some(switching)
    }

    /// Sets the pieces at the start. On a boundary, the direction of the motion selects the piece.
    fn begin(&mut self, ode: &mut MotionOde<'_>, t: f64, y: &[f64]) {
        self.evaluate(ode.model, t, y);
        for k in &self.on_state {
            self.pieces[*k] = ode.model.switches[*k].boundaries.piece(self.sigma[*k]);
        }
        if self.on_state.iter().any(|k| self.pieces[*k].is_nan()) {
            self.decide_by_motion(ode, t, y);
        }
    }

    fn decide_by_motion(&mut self, ode: &mut MotionOde<'_>, t: f64, y: &[f64]) {
        let model = ode.model;
        let [q, v, z, _] = model.layout.split(y);
        if ode.workspace.accelerate(model, t, [q, v, z], Gains::default()).is_err() {
            return;
        }
        let mut dz = vec![0.0; z.len()];
        ode.workspace.state_rates(model, t, &mut dz);
        let moving = switches::functions_in_time(model, t, [q, v, z], [ode.workspace.a(), &dz]);
        for k in &self.on_state {
            let (boundaries, sigma) = (&model.switches[*k].boundaries, moving[*k]);
            let grows = if sigma.rate == 0.0 { sigma.second } else { sigma.rate };
            if self.pieces[*k].is_nan() && grows != 0.0 && grows.is_finite() {
                self.pieces[*k] = boundaries.beside(sigma.value, grows * self.sign > 0.0);
            }
        }
    }

    /// Evaluates the functions of all switches. Switches within these functions keep their pieces.
    fn evaluate(&mut self, model: &Model, t: f64, y: &[f64]) {
        let [q, v, z, _] = model.layout.split(y);
        let Self { workspace, motions, sigma, pieces, .. } = self;
        let mut lam = None;
        if let Some(workspace) = workspace {
            workspace.motions.pieces.clone_from(pieces);
            let solved = workspace.accelerate(model, t, [q, v, z], Gains::default());
            lam = solved.is_ok().then(|| workspace.lam());
        }
        motions.place(&model.layout, q, v);
        motions.pieces.clone_from(pieces);
        switches::functions(model, motions, Acting { z, lam, t }, sigma);
        self.keep_through_noise(model);
    }

    /// The end of the next steps: a switch, or the end of the run.
    pub fn end(&self) -> f64 {
        let due = self.due.as_ref().map(|due| due.t);
        let next = self.schedule.times.get(self.next).map(|(t, _)| *t);
        let first = due.or(next).unwrap_or(self.t_end);
        let graded = self.graded.last().filter(|t| self.sign * (first - **t) > 0.0);
        graded.copied().unwrap_or(first)
    }

    /// Whether a switch is at `t`.
    pub fn is_due(&self, t: f64) -> bool {
        t != self.t_end && t == self.end()
    }

    /// Ends the run, or the phase, at another time.
    pub fn set_end(&mut self, t_end: f64) {
        (self.t_end, self.due) = (t_end, None);
        self.schedule.keep(|t| self.sign * (t_end - t) > 0.0);
    }

    /// Continues from another state: switches that depend on the state take their pieces at `y`.
    pub fn restart(&mut self, ode: &mut MotionOde<'_>, t: f64, y: &[f64]) {
        (self.due, self.graded) = (None, Vec::new());
        ode.workspace.motions.pieces.clear();
        self.begin(ode, t, y);
    }

    /// Changes the pieces of the switches at `t`, where the motion has the state `y`.
    ///
    /// # Errors
    /// A joint or driver with a law that jumps; a motion that slides along a switch.
    pub fn pass(
        &mut self,
        ode: &mut MotionOde<'_>,
        t: f64,
        y: &[f64],
    ) -> Result<(), Cause<Breakdown>> {
        let changes = self.due_at(t);
        self.graded.retain(|end| self.sign * (end - t) > 0.0);
        self.due.take_if(|due| due.t == t);
        self.next += usize::from(self.planned_at(t).is_some());
        self.change(ode, t, y, &changes)
    }

    fn planned_at(&self, t: f64) -> Option<&[(usize, f64)]> {
        let planned = self.schedule.times.get(self.next).filter(|(at, _)| *at == t);
        planned.map(|(_, changes)| &changes[..])
    }

    /// The switches that change at `t`, with their new pieces.
    #[inline(never)]
    fn due_at(&self, t: f64) -> Vec<(usize, f64)> {
        let due = self.due.iter().filter(|due| due.t == t).flat_map(|due| &due.changes);
        due.chain(self.planned_at(t).into_iter().flatten()).copied().list()
    }

    /// Takes the switches that have changed since the last accepted step; where a phase ends at `t`, also those that change there.
    pub fn take_causes(&mut self, t: f64, ends: bool) -> Vec<usize> {
        let due = if ends { self.due_at(t) } else { Vec::new() };
        self.causes.extend(due.iter().map(|(switch, _)| switch));
        std::mem::take(&mut self.causes)
    }

    fn change(
        &mut self,
        ode: &mut MotionOde<'_>,
        t: f64,
        y: &[f64],
        changes: &[(usize, f64)],
    ) -> Result<(), Cause<Breakdown>> {
        let model = ode.model;
        let before = self.pieces.clone();
        self.causes.extend(changes.iter().map(|(switch, _)| switch));
        changes.iter().for_each(|(switch, piece)| self.pieces[*switch] = *piece);
        self.follow_jumps(model, (t, y), &before, changes);
        let [q, v, ..] = model.layout.split(y);
        self.motions.place(&model.layout, q, v);
        self.motions.pieces.clone_from(&self.pieces);
        for k in changed_constraints(model, changes) {
            let jump = LawJump::of(model, k, &mut self.motions, t, &before, &|_| true);
            if let Some(LawJump { constraint, position, values }) = jump {
                let error = Breakdown::Jump { constraint, position, values };
                return Err(Cause::Equations { t, error });
            }
        }
        for (switch, _) in changes.iter().filter(|(switch, _)| model.switches[*switch].state) {
            let short = SHORT * self.length;
            let history = &mut self.history[*switch];
            history.quick = if (t - history.last).abs() <= short { history.quick + 1 } else { 0 };
            history.last = t;
            if history.quick > STUCK || self.returns(ode, (t, y), *switch, &before) {
                self.release(ode, t, y, *switch)?;
            }
        }
        let ends = contact_resolution::ends(ode, (t, y), changes, (self.steps, self.sign));
        if let Some(ends) = ends.map_err(|error| Cause::Equations { t, error })? {
            self.graded = ends;
        }
        if self.workspace.is_some() {
            self.follow_reactions(model, t, y);
        }
        Ok(())
    }

    /// Updates the switches whose functions jump because other switches within them have changed.
    fn follow_jumps(
        &mut self,
        model: &Model,
        (t, y): (f64, &[f64]),
        before: &[f64],
        changes: &[(usize, f64)],
    ) {
        if self.on_state.iter().all(|k| !model.switches[*k].law) {
            return;
        }
        let now = std::mem::replace(&mut self.pieces, before.to_vec());
        self.evaluate(model, t, y);
        let old = self.sigma.clone();
        self.pieces = now;
        self.evaluate(model, t, y);
        // a function contains others whose switches have lower numbers
        for place in 0..self.on_state.len() {
            let k = self.on_state[place];
            let by = (self.sigma[k] - old[k]).abs();
            let jumps = by > ROUNDING * (self.sigma[k].abs() + old[k].abs());
            let piece = model.switches[k].boundaries.piece(self.sigma[k]);
            if jumps && !piece.is_nan() && changes.iter().all(|(switch, _)| *switch != k) {
                self.pieces[k] = piece;
                self.evaluate(model, t, y);
            }
        }
    }

    /// Updates the switches that depend on reactions, because reactions jump at a switch.
    fn follow_reactions(&mut self, model: &Model, t: f64, y: &[f64]) {
        self.evaluate(model, t, y);
        for k in &self.on_state {
            let SwitchOwner::Force(f) = model.switches[*k].owner else { continue };
            let piece = model.switches[*k].boundaries.piece(self.sigma[*k]);
            if model.forces[f].reaction.is_some() && !self.pieces[*k].is_nan() && !piece.is_nan() {
                self.pieces[*k] = piece;
            }
        }
    }

    /// Whether steps have to be scanned.
    pub fn scans(&self) -> bool {
        !self.on_state.is_empty()
    }

    /// Scans a step, with its interpolant prepared.
    ///
    /// # Errors
    /// [`TooFast`] with the index of a switch.
    pub fn look(&mut self, model: &Model, step: &Step<'_>) -> Result<After, TooFast> {
        if let Some(after) = self.approach(model, step) {
            return Ok(after);
        }
        let spacing = 4.0 * f64::EPSILON * step.t.abs().max(step.t_old.abs());
        let scanned = self.scan(model, step, spacing)?;
        let Some(first) = scanned.first.first().map(|crossing| crossing.t) else {
            return Ok(self.after_smooth_step(model, step, &scanned));
        };
        let tries = self.due.as_ref().map_or(0, |due| due.tries);
        let together = scanned.first.iter().map(|crossing| self.on_state[crossing.index]);
        let together: Vec<usize> = together.list();
        self.evaluate_at(model, step, first);
        let next = |k: usize| (k, model.switches[k].boundaries.next(self.sigma[k], self.pieces[k]));
        let changes: Vec<_> = together.into_iter().map(next).list();
        if self.due.is_none() && first != step.t {
            let within = (step.t_old, first);
            self.graded = contact_resolution::before_release(model, &changes, within, self.steps);
        }
        self.due = Some(Due { t: first, changes, tries: tries + 1 });
        Ok(match first == step.t {
            true => After::Accept,
            false => After::Again,
        })
    }

    /// Accepts a step without a crossing. Switches that were never in their held piece change at its beginning.
    fn after_smooth_step(&mut self, model: &Model, step: &Step<'_>, scanned: &Scan) -> After {
        if !scanned.negative.is_empty() {
            self.evaluate_at(model, step, step.t_old);
            let of = |k: usize| {
                let k = self.on_state[k];
                let boundaries = &model.switches[k].boundaries;
                match boundaries.piece(self.sigma[k]) {
                    piece if piece.is_nan() || piece == self.pieces[k] => {
                        (k, boundaries.next(self.sigma[k], self.pieces[k]))
                    }
                    piece => (k, piece),
                }
            };
            let changes: Vec<_> = scanned.negative.iter().map(|k| of(*k)).list();
            self.due = Some(Due { t: step.t_old, changes, tries: 0 });
            return After::Change;
        }
        for (largest, rate) in self.largest.iter_mut().zip(step.dy) {
            *largest = largest.max(rate.abs());
        }
        self.hold_calm(model, step);
        After::Accept
    }
}
