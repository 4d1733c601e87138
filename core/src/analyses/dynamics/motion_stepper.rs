//! The stepper of any method on the equations of motion of a model.

use super::failure::{Failure, Reason};
use super::method_switching::MethodSwitching;
use super::methods::Scheme;
use super::motion_dae::MotionDae;
use super::motion_ode::MotionOde;
use super::options::Options;
use super::stiffness_detection::MethodChoice;
use crate::integrate::{
    BoxedStepper, Cause, Direction, ExplicitMethod, ImplicitMethod, Statistics, Step, Stepper,
};
use crate::solve::Breakdown;

/// A method with its own form of the equations of motion, in addition to the ODE.
enum Kind<'a> {
    Explicit(BoxedStepper<MotionOde<'a>, Breakdown>),
    Implicit(BoxedStepper<MotionDae<'a>, Breakdown>, Box<MotionDae<'a>>),
    Auto(Box<MethodSwitching<'a>>),
}

/// The stepper of a model.
pub(super) struct MotionStepper<'a> {
    pub ode: MotionOde<'a>,
    kind: Kind<'a>,
}

impl<'a> MotionStepper<'a> {
    /// Begins with `y` at `t` and ends at `options.t_end`.
    ///
    /// # Errors
    /// [`Cause`] of invalid options.
    pub fn new(
        ode: MotionOde<'a>,
        options: &Options,
        t: f64,
        y: &[f64],
    ) -> Result<Self, Cause<Breakdown>> {
        let (model, span) = (ode.model, (t, options.t_end));
        let dae = || Box::new(MotionDae::new(model, options));
        let kind = match &options.bounded_method(model) {
            Scheme::Rk45(method) => Kind::Explicit(method.start(&ode, span, y)?),
            Scheme::Dop853(method) => Kind::Explicit(method.start(&ode, span, y)?),
            Scheme::Rk4(method) => Kind::Explicit(method.start(&ode, span, y)?),
            Scheme::GeneralizedAlpha(method) => {
                let dae = dae();
                Kind::Implicit(method.start(&*dae, span, y)?, dae)
            }
            Scheme::Radau(method) => {
                let dae = dae();
                Kind::Implicit(method.start(&*dae, span, y)?, dae)
            }
            Scheme::Auto(auto) => {
                Kind::Auto(Box::new(MethodSwitching::new(&ode, options, auto, t, y)?))
            }
        };
        Ok(Self { ode, kind })
    }

    /// Takes the next accepted step.
    pub fn step(&mut self) -> Result<(), Cause<Breakdown>> {
        match &mut self.kind {
            Kind::Explicit(stepper) => stepper.step(&mut self.ode),
            Kind::Implicit(stepper, dae) => stepper.step(dae),
            Kind::Auto(stepper) => stepper.step(&mut self.ode),
        }
    }

    /// Computes the data that only the interpolant needs.
    pub fn prepare_interpolant(&mut self) -> Result<(), Cause<Breakdown>> {
        match &mut self.kind {
            Kind::Explicit(stepper) => stepper.prepare_interpolant(&mut self.ode),
            Kind::Implicit(stepper, dae) => stepper.prepare_interpolant(dae),
            Kind::Auto(stepper) => stepper.prepare_interpolant(&mut self.ode),
        }
    }

    pub fn last_step(&self) -> Option<Step<'_>> {
        match &self.kind {
            Kind::Explicit(stepper) => stepper.last_step(),
            Kind::Implicit(stepper, _) => stepper.last_step(),
            Kind::Auto(stepper) => stepper.last_step(),
        }
    }

    pub fn t(&self) -> f64 {
        match &self.kind {
            Kind::Explicit(stepper) => stepper.t(),
            Kind::Implicit(stepper, _) => stepper.t(),
            Kind::Auto(stepper) => stepper.t(),
        }
    }

    pub fn y(&self) -> &[f64] {
        match &self.kind {
            Kind::Explicit(stepper) => stepper.y(),
            Kind::Implicit(stepper, _) => stepper.y(),
            Kind::Auto(stepper) => stepper.y(),
        }
    }

    pub fn restart(&mut self, t: f64, y: &[f64]) -> Result<(), Cause<Breakdown>> {
        match &mut self.kind {
            Kind::Explicit(stepper) => stepper.restart(t, y),
            Kind::Implicit(stepper, _) => stepper.restart(t, y),
            Kind::Auto(stepper) => stepper.restart(t, y),
        }
    }

    pub fn statistics(&self) -> Statistics {
        match &self.kind {
            Kind::Explicit(stepper) => stepper.statistics(),
            Kind::Implicit(stepper, _) => stepper.statistics(),
            Kind::Auto(stepper) => stepper.statistics(),
        }
    }

    /// Time within the last step at which g(t, [q, v, z]) changes sign, with the state there.
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
        match &mut self.kind {
            Kind::Explicit(stepper) => stepper.locate(&mut self.ode, &mut of_y, direction, 0.0),
            Kind::Implicit(stepper, dae) => stepper.locate(dae, &mut of_y, direction, 0.0),
            Kind::Auto(stepper) => stepper.locate(&mut self.ode, &mut of_y, direction, 0.0),
        }
    }

    /// Works at a time within the last step.
    pub fn works_at(&self, t: f64) -> Vec<f64> {
        let mut y = self.y().to_vec();
        if let Some(step) = self.last_step().filter(|step| step.t != t) {
            step.interpolate(t, &mut y);
        }
        self.ode.model.layout.split(&y)[3].to_vec()
    }

    /// A stepper from the beginning of the last step to another end.
    pub fn again(self, options: &Options) -> Result<Self, Cause<Breakdown>> {
        let (t, y) = match self.last_step() {
            Some(step) => (step.t_old, step.y_old.to_vec()),
            None => (self.t(), self.y().to_vec()),
        };
        let mut options = options.clone();
        options.method.control_mut().first_step = None;
        Self::new(self.ode, &options, t, &y)
    }

    /// A failure in terms of the mechanism.
    pub fn failure(&self, cause: Cause<Breakdown>) -> Box<Failure> {
        let (model, y) = (self.ode.model, self.y());
        match (&cause, self.ode.passage.undecided) {
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

    /// All factorisations.
    pub fn factorisations(&self) -> usize {
        let counted = self.statistics().factorisations as usize;
        let others = match &self.kind {
            Kind::Explicit(stepper) => stepper.statistics().evaluations,
            Kind::Implicit(_, dae) => dae.factorisations(),
            Kind::Auto(stepper) => stepper.factorisations(),
        };
        counted + others + self.ode.factorisations()
    }

    /// The method of the automatic choice.
    pub fn choice(&self) -> Option<MethodChoice> {
        match &self.kind {
            Kind::Auto(stepper) => Some(stepper.choice()),
            _ => None,
        }
    }
}
