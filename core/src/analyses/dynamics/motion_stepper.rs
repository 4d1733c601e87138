//! The stepper of any method on the equations of motion of a model.

use super::contact_resolution::StepChoice;
use super::continued::Continued;
use super::failure::{Failure, Reason};
use super::implicit_motion::ImplicitMotion;
use super::massless;
use super::method_switching::MethodSwitching;
use super::methods::Scheme;
use super::motion_ode::MotionOde;
use super::options::Options;
use super::passages::HeldPieces;
use super::run_results::Passed;
use super::sampling::Sample;
use super::singularity_handover::{Method, SingularityHandover};
use super::stiffness_detection::MethodChoice;
use super::switch_schedule::Schedule;
use super::switching::{After, Switching};
use crate::analyses::mobility::dependent;
use crate::integrate::{
    BoxedStepper, Cause, Direction, ExplicitMethod, SideBySide, Step, StepControl, StepCounts,
    Stepper, TooFast,
};
use crate::math::Listed;
use crate::solve::Breakdown;
use crate::stabilize::Projector;

/// The stepper of a method.
enum MethodStepper<'a> {
    Explicit(BoxedStepper<MotionOde<'a>, Breakdown>),
    /// An implicit method, or a method with a constant step.
    HandingOver(Box<SingularityHandover<'a>>),
    Auto(Box<MethodSwitching<'a>>),
}

impl<'a> MethodStepper<'a> {
    fn get(&self) -> &dyn Stepper<MotionOde<'a>, Breakdown> {
        match self {
            Self::Explicit(stepper) => &**stepper,
            Self::HandingOver(stepper) => &**stepper,
            Self::Auto(stepper) => &**stepper,
        }
    }

    fn get_mut(&mut self) -> &mut dyn Stepper<MotionOde<'a>, Breakdown> {
        match self {
            Self::Explicit(stepper) => &mut **stepper,
            Self::HandingOver(stepper) => &mut **stepper,
            Self::Auto(stepper) => &mut **stepper,
        }
    }

    /// Wraps the stepper of an explicit method that was started.
    fn explicit(
        stepper: BoxedStepper<MotionOde<'a>, Breakdown>,
        (ode, control, span): (&MotionOde<'a>, &StepControl, (f64, f64)),
    ) -> Self {
        match ode.passing && control.step.is_some() {
            true => Self::HandingOver(Box::new(SingularityHandover::new(
                Method::Explicit(stepper),
                control,
                span,
            ))),
            false => Self::Explicit(stepper),
        }
    }
}

/// The stepper of a model.
pub(super) struct MotionStepper<'a> {
    pub ode: MotionOde<'a>,
    kind: MethodStepper<'a>,
    /// None for a model without switches.
    switching: Option<Box<Switching>>,
    /// The last sample of sampled laws.
    sample: Option<Sample>,
    /// Accepted steps that were taken again.
    taken_again: usize,
    /// The singular positions that were passed.
    pub passed: Vec<Passed>,
}

impl<'a> MotionStepper<'a> {
    /// Begins with `y` at `t` and ends at `options.t_end`, or continues the steps of another stepper. The schedule
    /// contains the switches up to the end.
    ///
    /// # Errors
    /// [`Cause`] of invalid options.
    pub fn new(
        mut ode: MotionOde<'a>,
        (options, continued): (&Options, Option<Continued>),
        schedule: Schedule,
        t: f64,
        y: &[f64],
    ) -> Result<Self, Cause<Breakdown>> {
        let (model, span) = (ode.model, (t, options.t_end));
        let mut method = options.bounded_method(model);
        let control = method.control_mut();
        if let Some(size) = continued.and_then(|of| of.size).filter(|_| control.step.is_none()) {
            let first = (options.t_end - t).abs().min(size);
            control.first_step = Some(first).filter(|first| *first > 0.0);
        }
        let control = method.control();
        let implicit = |stepper| {
            let method = Method::Implicit(stepper);
            MethodStepper::HandingOver(Box::new(SingularityHandover::new(method, control, span)))
        };
        let kind = match &method {
            Scheme::Rk45(method) => {
                MethodStepper::explicit(method.start(&ode, span, y)?, (&ode, control, span))
            }
            Scheme::Dop853(method) => {
                MethodStepper::explicit(method.start(&ode, span, y)?, (&ode, control, span))
            }
            Scheme::Rk4(method) => {
                MethodStepper::explicit(method.start(&ode, span, y)?, (&ode, control, span))
            }
            Scheme::GeneralizedAlpha(method) => {
                implicit(ImplicitMotion::new(method, &ode, options, span, y)?)
            }
            Scheme::Radau(method) => implicit(ImplicitMotion::new(method, &ode, options, span, y)?),
            Scheme::Auto(auto) => {
                let stepper = MethodSwitching::new(&ode, (options, continued), auto, t, y)?;
                MethodStepper::Auto(Box::new(stepper))
            }
        };
        let steps = match (&method, control.step) {
            (_, None) => StepChoice::Chosen,
            (Scheme::Radau(_) | Scheme::GeneralizedAlpha(_), _) => StepChoice::Implicit,
            (_, Some(step)) => StepChoice::Constant(step),
        };
        let switching = Switching::new(&mut ode, (schedule, steps), t, options.t_end, y);
        let switching = switching.map(Box::new);
        let mut stepper =
            Self { ode, kind, switching, sample: None, taken_again: 0, passed: Vec::new() };
        if stepper.switching.is_some() {
            stepper.go_on_from(t, y)?;
        }
        Ok(stepper)
    }

    /// The pieces of switches that the last step held, from the given step on, which `ends` a phase at its beginning. None
    /// for a model without switches.
    #[inline(never)]
    pub fn held(&mut self, step: usize, ends: bool) -> Option<HeldPieces> {
        let t = self.t();
        let causes = self.switching.as_mut()?.take_causes(t, ends);
        Some(HeldPieces { step, pieces: self.ode.workspace.motions.pieces.clone(), causes })
    }

    /// Takes the next accepted step. Where the model has switches, steps end at them.
    pub fn step(&mut self) -> Result<(), Cause<Breakdown>> {
        let Some(mut switching) = self.switching.take() else { return self.advance() };
        let outcome = self.step_to_switch(&mut switching);
        self.switching = Some(switching);
        outcome
    }

    fn step_to_switch(&mut self, switching: &mut Switching) -> Result<(), Cause<Breakdown>> {
        let t = self.t();
        if switching.is_due(t) {
            let mut y = self.y().to_vec();
            self.take_sample(switching);
            if let Some(sample) = &self.sample {
                sample.put(self.ode.model, &mut y);
            }
            switching.pass(&mut self.ode, t, &y)?;
            self.hold(switching, t, &y)?;
        } else if t == self.kind.get().t_end() {
            // a switch was released at the end of the last step
            let y = self.y().to_vec();
            self.hold(switching, t, &y)?;
        }
        self.sample = None;
        loop {
            self.advance()?;
            if !switching.scans() {
                return Ok(());
            }
            self.prepare_interpolant()?;
            let step = self.last_step().expect("a step was taken");
            let (t_old, y_old) = (step.t_old, step.y_old.to_vec());
            let after = switching.look(self.ode.model, &step);
            let error = |TooFast(k)| Cause::Equations { t: t_old, error: Breakdown::TooFast(k) };
            match after.map_err(error)? {
                After::Accept => return Ok(()),
                After::Again => {}
                After::Change => switching.pass(&mut self.ode, t_old, &y_old)?,
            }
            self.taken_again += 1;
            self.hold(switching, t_old, &y_old)?;
        }
    }

    /// The sample at the end of the last step, from which the next step begins.
    pub fn sample(&mut self) -> Option<&Sample> {
        let switching = self.switching.take()?;
        self.take_sample(&switching);
        self.switching = Some(switching);
        self.sample.as_ref()
    }

    /// Computes the sampled laws, once, where the last step ended at a sample.
    fn take_sample(&mut self, switching: &Switching) {
        let t = self.t();
        if switching.schedule.samples_at(t) && self.sample.is_none() {
            self.sample = Sample::take(self.ode.model, t, self.y());
        }
    }

    /// Continues from a state with the held pieces, up to the next switch.
    fn hold(&mut self, switching: &Switching, t: f64, y: &[f64]) -> Result<(), Cause<Breakdown>> {
        self.ode.workspace.motions.pieces.clone_from(&switching.pieces);
        self.kind.get_mut().restart_until(t, y, switching.end())
    }

    /// Continues from a state with the switches of this stepper, if it has any.
    fn go_on_from(&mut self, t: f64, y: &[f64]) -> Result<(), Cause<Breakdown>> {
        let Some(switching) = self.switching.take() else { return Ok(()) };
        let outcome = self.hold(&switching, t, y);
        self.switching = Some(switching);
        outcome
    }

    /// Takes the next accepted step of the method.
    fn advance(&mut self) -> Result<(), Cause<Breakdown>> {
        self.kind.get_mut().step(&mut self.ode)?;
        if let Some(found) = self.ode.passage.passed.take() {
            self.note_passed(found);
        }
        if !self.ode.workspace.matrix.omitted().is_empty() {
            let (t, y) = (self.t(), self.y().to_vec());
            self.ode.exchange_rows(t, &y);
        }
        Ok(())
    }

    /// Records a singular position that the last step passed.
    fn note_passed(&mut self, (at, slope, row): (f64, f64, usize)) {
        let Some(step) = self.kind.get().last_step() else { return };
        let (model, ahead) = (self.ode.model, at - step.t);
        let [q, v, ..] = model.layout.split(step.y);
        let there: Vec<f64> = q.iter().zip(v).map(|(q, v)| q + ahead * v).list();
        // positions of a step that is taken again are found again
        let direction = step.t - step.t_old;
        self.passed.retain(|before| (before.t - step.t_old) * direction <= 0.0);
        let group = dependent(model, at, &there, row);
        let names = group.into_iter().map(|k| model.constraints[k].name.clone()).list();
        let residual = self.ode.projector.as_ref().map_or(0.0, Projector::gap);
        self.passed.push(Passed { t: at, names, slope, residual });
    }

    /// The stepper for steps side by side with others, with the equations of motion. None if the next step must be
    /// taken alone.
    pub fn side_by_side(&mut self) -> Option<(&mut MotionOde<'a>, &mut dyn SideBySide)> {
        let ordinary = self.switching.is_none()
            && self.ode.passage.is_clear()
            && self.ode.workspace.matrix.omitted().is_empty();
        let stepper = self.kind.get_mut().side_by_side().filter(|_| ordinary)?;
        Some((&mut self.ode, stepper))
    }

    /// Must be called after a step that was taken side by side with others.
    pub fn after_step_beside_others(&mut self) {
        if let MethodStepper::Auto(stepper) = &mut self.kind {
            stepper.judge_explicit(&self.ode);
        }
    }

    /// Computes the data that only the interpolant needs.
    pub fn prepare_interpolant(&mut self) -> Result<(), Cause<Breakdown>> {
        self.kind.get_mut().prepare_interpolant(&mut self.ode)
    }

    pub fn last_step(&self) -> Option<Step<'_>> {
        self.kind.get().last_step()
    }

    pub fn t(&self) -> f64 {
        self.kind.get().t()
    }

    pub fn y(&self) -> &[f64] {
        self.kind.get().y()
    }

    /// Continues from a state `y` at a time `t` within the last step.
    pub fn restart(&mut self, t: f64, y: &[f64]) -> Result<(), Cause<Breakdown>> {
        self.sample = None;
        if let Some(switching) = &mut self.switching {
            switching.restart(&mut self.ode, t, y);
            return self.go_on_from(t, y);
        }
        self.kind.get_mut().restart(t, y)
    }

    /// Takes the last step again, to end the run at a time `t_end` within it.
    pub fn end_within_step(&mut self, t_end: f64) -> Result<(), Cause<Breakdown>> {
        let (t, y) = match self.last_step() {
            Some(step) => (step.t_old, step.y_old.to_vec()),
            None => return Ok(()),
        };
        self.taken_again += 1;
        self.sample = None;
        if let Some(switching) = &mut self.switching {
            switching.set_end(t_end);
            return self.go_on_from(t, &y);
        }
        self.kind.get_mut().restart_until(t, &y, t_end)
    }

    /// Counts of all steps so far. Steps that were taken again count as rejected.
    pub fn statistics(&self) -> StepCounts {
        let mut counts = self.kind.get().statistics();
        counts.steps -= self.taken_again;
        counts.rejected += self.taken_again;
        counts
    }

    /// The time within the last step at which g(t, [q, v, z]) changes sign, and the state there.
    pub fn locate(
        &mut self,
        g: &dyn Fn(f64, [&[f64]; 3]) -> f64,
        direction: Direction,
    ) -> Result<Option<(f64, Vec<f64>)>, Cause<Breakdown>> {
        let layout = &self.ode.model.layout;
        let mut of_y = |t: f64, y: &[f64]| {
            let [q, v, z, _] = layout.split(y);
            g(t, [q, v, z])
        };
        self.kind.get_mut().locate(&mut self.ode, &mut of_y, direction, 0.0)
    }

    /// Works at a time within the last step.
    pub fn works_at(&self, t: f64) -> Vec<f64> {
        let mut y = self.y().to_vec();
        if let Some(step) = self.last_step().filter(|step| step.t != t) {
            step.interpolate(t, &mut y);
        }
        self.ode.model.layout.split(&y)[3].to_vec()
    }

    /// Converts a cause to a failure in terms of the mechanism.
    pub fn failure(&self, cause: Cause<Breakdown>) -> Box<Failure> {
        let (model, y) = (self.ode.model, self.y());
        let short = matches!(cause, Cause::StepTooSmall { .. });
        let freedom = || massless::near(model, self.t(), model.layout.split(y)[0]);
        if let Some(failure) = short.then(freedom).flatten() {
            return failure;
        }
        match (&cause, self.ode.passage.undecided.or(self.ode.paradox)) {
            (Cause::NotFinite { .. }, Some((t, breakdown))) => {
                Failure::at_state(model, t, model.layout.split(y)[0], breakdown)
            }
            (Cause::StepTooSmall { .. }, _) if self.ode.projector.is_none() && !model.driven => {
                let mut failure = Failure::of_integrator(model, cause, self.t(), y);
                if let Reason::Integration { hint, .. } = &mut failure.reason {
                    *hint = "a singular position or a discontinuity lies here; a run with stabilization projection \
                             passes singular positions; look at the solution so far";
                }
                failure
            }
            _ => Failure::of_integrator(model, cause, self.t(), y),
        }
    }

    /// How another stepper continues the steps.
    pub fn continued(&self) -> Continued {
        let implicit = matches!(&self.kind, MethodStepper::Auto(stepper) if stepper.is_implicit());
        Continued { size: self.kind.get().next_size(), implicit }
    }

    /// Whether an implicit method took the last step.
    pub fn was_implicit(&self) -> bool {
        match &self.kind {
            MethodStepper::Explicit(_) => false,
            MethodStepper::HandingOver(stepper) => stepper.was_implicit(),
            MethodStepper::Auto(stepper) => stepper.was_implicit(),
        }
    }

    /// Number of all factorisations.
    pub fn factorisations(&self) -> usize {
        let counted = self.statistics().factorisations as usize;
        let others = match &self.kind {
            MethodStepper::Explicit(stepper) => stepper.statistics().evaluations,
            MethodStepper::HandingOver(stepper) => stepper.factorisations(),
            MethodStepper::Auto(stepper) => stepper.factorisations(),
        };
        counted + others + self.ode.factorisations()
    }

    /// The method that was chosen automatically.
    pub fn choice(&self) -> Option<MethodChoice> {
        match &self.kind {
            MethodStepper::Auto(stepper) => Some(stepper.choice()),
            _ => None,
        }
    }
}
