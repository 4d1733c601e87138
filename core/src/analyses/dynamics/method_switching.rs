//! The automatic choice of the method: changes between DOP853 and Radau, as `stiffness_detection` determines.

use super::continued::Continued;
use super::implicit_motion::ImplicitMotion;
use super::initial_stiffness::InitialStiffness;
use super::methods::Auto;
use super::motion_ode::MotionOde;
use super::options::Options;
use super::singularity_handover::{Method, SingularityHandover};
use super::stiffness_detection::{MethodChoice, StiffnessDetector, LIMIT, TRIAL, WORTH};
use crate::integrate::{
    BoxedStepper, Cause, Dop853, ExplicitMethod, Radau, SideBySide, Step, StepControl, StepCounts,
    Stepper,
};
use crate::solve::Breakdown;

/// Why the implicit method begins a part of a run.
const CONTINUED: &str = "stiff before a pause of the run";

/// The stepper of one method.
enum SwitchedStepper<'a> {
    Explicit(BoxedStepper<MotionOde<'a>, Breakdown>),
    Implicit(Box<SingularityHandover<'a>>),
}

impl<'a> SwitchedStepper<'a> {
    fn get(&self) -> &dyn Stepper<MotionOde<'a>, Breakdown> {
        match self {
            Self::Explicit(stepper) => &**stepper,
            Self::Implicit(stepper) => &**stepper,
        }
    }

    fn get_mut(&mut self) -> &mut dyn Stepper<MotionOde<'a>, Breakdown> {
        match self {
            Self::Explicit(stepper) => &mut **stepper,
            Self::Implicit(stepper) => &mut **stepper,
        }
    }

    /// Number of factorisations that the statistics do not contain.
    fn factorisations(&self) -> usize {
        match self {
            Self::Explicit(stepper) => stepper.statistics().evaluations,
            Self::Implicit(stepper) => stepper.factorisations(),
        }
    }
}

/// A stepper that changes between an explicit and an implicit method.
pub(super) struct MethodSwitching<'a> {
    options: Options,
    /// The end of the steps. The end of the run is in the options.
    t_end: f64,
    /// Tolerances and steps of both methods.
    control: StepControl,
    detector: StiffnessDetector<'a>,
    initial: InitialStiffness,
    piece: SwitchedStepper<'a>,
    /// Whether the other method takes the next step.
    due: bool,
    /// Length of the last step of the previous method.
    step: Option<f64>,
    /// Counts of the earlier steppers.
    total: StepCounts,
    /// Factorisations of the earlier steppers that `total` does not contain.
    factorisations: usize,
    /// Time at which Radau began, its number of steps since then, and the time of the last comparison.
    tried: (f64, usize, f64),
    choice: MethodChoice,
}

impl<'a> MethodSwitching<'a> {
    /// Begins with `y` at `t`; `ode` are the equations of motion for explicit methods. Steps that are continued keep
    /// their method.
    pub fn new(
        ode: &MotionOde<'a>,
        (options, continued): (&Options, Option<Continued>),
        auto: &Auto,
        t: f64,
        y: &[f64],
    ) -> Result<Self, Cause<Breakdown>> {
        let span = (t, options.t_end);
        // invalid options are an error before the first evaluation
        let piece = SwitchedStepper::Explicit(
            Dop853 { control: auto.control.clone() }.start(ode, span, y)?,
        );
        let mut detector = StiffnessDetector::new(ode.model, &ode.workspace, t);
        let initial = match continued {
            Some(_) => InitialStiffness::unknown(),
            None => InitialStiffness::new(ode.model, &mut detector, auto, span, y),
        };
        let mut switching = Self {
            options: options.clone(),
            t_end: options.t_end,
            control: auto.control.clone(),
            detector,
            initial,
            piece,
            due: false,
            step: None,
            total: StepCounts::default(),
            factorisations: 0,
            tried: (t, 0, t),
            choice: MethodChoice { method: "dop853", why: String::new() },
        };
        switching.judge_start();
        if continued.is_some_and(|of| of.implicit) {
            switching.choice = MethodChoice { method: "radau", why: CONTINUED.to_string() };
            (switching.step, switching.due) = (switching.control.first_step, true);
        }
        Ok(switching)
    }

    /// Selects the first method from the stiffness of the model at the start.
    fn judge_start(&mut self) {
        let Some(fastest) = self.initial.stiff() else { return };
        if self.initial.implicit() {
            self.detector.seen = Some((fastest, LIMIT / fastest.rate));
            let why = self.initial.why_implicit();
            self.choice = MethodChoice { method: "radau", why };
            self.step = self.control.first_step;
            self.due = true;
        } else {
            self.detector.predicted = Some(fastest.rate);
        }
    }

    /// Tolerances and steps of a stepper that begins at `t`.
    fn control_from(&self, t: f64) -> StepControl {
        let max_steps = self.control.max_steps.map(|most| most - self.total.steps.min(most));
        let first_step = self.step.map(|h| h.min((self.t_end - t).abs()));
        StepControl { first_step, max_steps, ..self.control.clone() }
    }

    /// Changes to the other method.
    fn switch(&mut self, ode: &mut MotionOde<'a>) -> Result<(), Cause<Breakdown>> {
        self.due = false;
        let (t, y) = (self.t(), self.y().to_vec());
        self.total = self.statistics();
        self.factorisations = self.factorisations();
        let (control, span) = (self.control_from(t), (t, self.t_end));
        self.piece = match &self.piece {
            SwitchedStepper::Explicit(_) => {
                self.tried = (t, 0, t);
                let method = Radau { control };
                let stepper = ImplicitMotion::new(&method, ode, &self.options, span, &y)?;
                let method = (Method::Implicit(stepper), &self.control);
                SwitchedStepper::Implicit(Box::new(SingularityHandover::new(
                    method.0, method.1, span,
                )))
            }
            SwitchedStepper::Implicit(_) => {
                self.detector.resume(t);
                self.detector.wait(4.0);
                SwitchedStepper::Explicit(Dop853 { control }.start(ode, span, &y)?)
            }
        };
        Ok(())
    }

    /// Checks for stiffness after a step of the explicit method. If the model is stiff, the implicit method takes the
    /// next step.
    pub fn judge_explicit(&mut self, ode: &MotionOde<'a>) {
        let SwitchedStepper::Explicit(stepper) = &self.piece else { return };
        if ode.passage.in_reach() {
            return; // the singular position limits the steps
        }
        let Some(step) = stepper.last_step() else { return };
        self.step = Some((step.t - step.t_old).abs());
        self.detector.follow(&ode.workspace);
        let predicted = self.detector.predicted.is_some();
        if !self.detector.stiff(&step, self.options.t_end) {
            return;
        }
        let (fastest, h) = self.detector.seen.expect("stiffness was seen");
        let origin = match predicted && self.detector.predicted.is_none() {
            true => " (predicted at the start)",
            false => "",
        };
        let why = format!(
            "stiff from t = {:.4} s on: a damped motion with a rate of {:.2e} 1/s limited the steps of \
            dop853 to {h:.1e} s{origin}",
            step.t, fastest.rate,
        );
        self.choice = MethodChoice { method: "radau", why };
        self.due = true;
    }

    /// Checks after a step of the implicit method whether its steps are long enough. If not, the explicit method
    /// takes the next step.
    fn judge_implicit(&mut self) {
        let SwitchedStepper::Implicit(stepper) = &self.piece else { return };
        if stepper.crossing() {
            return;
        }
        let Some(Step { t, t_old, .. }) = stepper.last_step() else { return };
        self.step = Some((t - t_old).abs());
        let (began, taken, since) = &mut self.tried;
        *taken += 1;
        if *taken % TRIAL > 0 {
            return;
        }
        let h = (t - std::mem::replace(since, t)).abs() / TRIAL as f64;
        let explicit_step = self.detector.seen.map_or(0.0, |(_, h)| h);
        let to_go = (self.options.t_end - t).abs();
        if h < WORTH * explicit_step && to_go > TRIAL as f64 * explicit_step {
            let why = format!(
                "hardly stiff: radau was tried at t = {began:.4} s, but its steps were less than {WORTH} times as long \
                as those of dop853 ({explicit_step:.1e} s)"
            );
            self.choice = MethodChoice { method: "dop853", why };
            self.due = true;
        }
    }

    /// Whether the implicit method takes the next step.
    pub fn is_implicit(&self) -> bool {
        matches!(self.piece, SwitchedStepper::Implicit(_)) != self.due
    }

    /// Whether the implicit method took the last step.
    pub fn was_implicit(&self) -> bool {
        matches!(&self.piece, SwitchedStepper::Implicit(stepper) if stepper.was_implicit())
    }

    /// Number of factorisations that the methods do not count.
    pub fn factorisations(&self) -> usize {
        self.factorisations + self.piece.factorisations()
    }

    /// The current method, and the reason for its choice.
    pub fn choice(&self) -> MethodChoice {
        match self.choice.why.is_empty() {
            true => MethodChoice { why: self.not_stiff(&self.initial), ..self.choice.clone() },
            false => self.choice.clone(),
        }
    }

    fn not_stiff(&self, forecast: &InitialStiffness) -> String {
        match self.detector.seen {
            None => forecast.why_explicit(),
            Some((fastest, h)) => format!(
                "not stiff: |lambda| h = {:.2} for {} motion with a rate of {:.2e} 1/s and steps of {h:.1e} s",
                fastest.rate * h,
                if fastest.damped { "a damped" } else { "an undamped" },
                fastest.rate
            ),
        }
    }
}

impl<'a> Stepper<MotionOde<'a>, Breakdown> for MethodSwitching<'a> {
    fn step(&mut self, ode: &mut MotionOde<'a>) -> Result<(), Cause<Breakdown>> {
        if self.due {
            self.switch(ode)?;
        }
        self.piece.get_mut().step(ode)?;
        self.judge_explicit(ode);
        self.judge_implicit();
        Ok(())
    }

    fn prepare_interpolant(&mut self, ode: &mut MotionOde<'a>) -> Result<(), Cause<Breakdown>> {
        self.piece.get_mut().prepare_interpolant(ode)
    }

    fn last_step(&self) -> Option<Step<'_>> {
        self.piece.get().last_step()
    }

    fn t(&self) -> f64 {
        self.piece.get().t()
    }

    fn t_end(&self) -> f64 {
        self.t_end
    }

    fn y(&self) -> &[f64] {
        self.piece.get().y()
    }

    fn restart_until(&mut self, t: f64, y: &[f64], t_end: f64) -> Result<(), Cause<Breakdown>> {
        self.piece.get_mut().restart_until(t, y, t_end)?;
        self.t_end = t_end;
        self.detector.resume(t);
        self.tried.2 = t;
        Ok(())
    }

    fn next_size(&self) -> Option<f64> {
        self.piece.get().next_size()
    }

    fn statistics(&self) -> StepCounts {
        self.total.plus(self.piece.get().statistics())
    }
    /// The explicit stepper, while it takes the steps.
    fn side_by_side(&mut self) -> Option<&mut dyn SideBySide> {
        match &mut self.piece {
            SwitchedStepper::Explicit(stepper) if !self.due => stepper.side_by_side(),
            _ => None,
        }
    }
}
