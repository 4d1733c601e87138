//! An implicit method on the equations of motion, with the interface of explicit methods.

use super::motion_dae::MotionDae;
use super::motion_ode::MotionOde;
use super::options::Options;
use crate::integrate::{BoxedStepper, Cause, Dae, ImplicitMethod, Step, StepCounts, Stepper};
use crate::solve::Breakdown;

/// The stepper of an implicit method, with its form of the equations.
pub(super) struct ImplicitMotion<'a> {
    stepper: BoxedStepper<dyn Dae<Stop = Breakdown> + 'a, Breakdown>,
    dae: Box<MotionDae<'a>>,
}

impl<'a> ImplicitMotion<'a> {
    /// Begins with `y` at the beginning of the span.
    pub fn new(
        method: &impl ImplicitMethod,
        ode: &MotionOde<'a>,
        options: &Options,
        span: (f64, f64),
        y: &[f64],
    ) -> Result<Self, Cause<Breakdown>> {
        let dae = Box::new(MotionDae::new(ode.model, options, &ode.workspace));
        let system: &(dyn Dae<Stop = Breakdown> + 'a) = &*dae;
        Ok(Self { stepper: method.start(system, span, y)?, dae })
    }

    /// The least ratio of a pivot to its largest summand at the end of the last step.
    pub fn pivot(&self) -> Option<f64> {
        self.dae.pivot()
    }

    /// Number of factorisations that the method does not count.
    pub fn factorisations(&self) -> usize {
        self.dae.factorisations()
    }
}

impl<'a> Stepper<MotionOde<'a>, Breakdown> for ImplicitMotion<'a> {
    fn step(&mut self, ode: &mut MotionOde<'a>) -> Result<(), Cause<Breakdown>> {
        self.dae.hold(&ode.workspace);
        self.stepper.step(&mut *self.dae)
    }

    fn prepare_interpolant(&mut self, _: &mut MotionOde<'a>) -> Result<(), Cause<Breakdown>> {
        self.stepper.prepare_interpolant(&mut *self.dae)
    }

    fn last_step(&self) -> Option<Step<'_>> {
        self.stepper.last_step()
    }

    fn t(&self) -> f64 {
        self.stepper.t()
    }

    fn t_end(&self) -> f64 {
        self.stepper.t_end()
    }

    fn y(&self) -> &[f64] {
        self.stepper.y()
    }

    fn next_size(&self) -> Option<f64> {
        self.stepper.next_size()
    }

    fn restart_until(&mut self, t: f64, y: &[f64], t_end: f64) -> Result<(), Cause<Breakdown>> {
        self.stepper.restart_until(t, y, t_end)
    }

    fn statistics(&self) -> StepCounts {
        self.stepper.statistics()
    }
}
