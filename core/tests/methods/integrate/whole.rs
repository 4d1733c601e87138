//! A whole integration as a loop over a stepper, with an observer of its steps.

use kempe::integrate::{
    BoxedStepper, Cause, Dae, ExplicitMethod, Flow, ImplicitMethod, Ode, Step, StepCounts,
};
use std::ops::Deref;

/// Observes every accepted step.
pub trait Observer {
    /// Called with every step.
    fn step(&mut self, step: &Step<'_>) -> Flow;

    /// Whether it will evaluate the interpolant of the step.
    fn looks_inside(&self, _t_old: f64, _t: f64) -> bool {
        true
    }
}

impl<F: FnMut(&Step<'_>) -> Flow> Observer for F {
    fn step(&mut self, step: &Step<'_>) -> Flow {
        self(step)
    }
}

/// How an integration that did not fail ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// At t_end.
    Reached,
    /// By the observer.
    Stopped,
}

/// An integration that did not fail.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Done {
    pub statistics: StepCounts,
    pub ended: Ended,
    pub t: f64,
}

impl Deref for Done {
    type Target = StepCounts;
    fn deref(&self) -> &StepCounts {
        &self.statistics
    }
}

/// A failed integration, with the time and state reached.
#[derive(Clone, Debug)]
pub struct Failure<E> {
    pub cause: Cause<E>,
    pub t: f64,
    pub y: Box<[f64]>,
    pub statistics: StepCounts,
}

/// From the beginning to the end, with the state in `y`.
fn whole<Y, E>(
    started: Result<BoxedStepper<Y, E>, Cause<E>>,
    system: &mut Y,
    t0: f64,
    y: &mut [f64],
    observer: &mut impl Observer,
) -> Result<Done, Failure<E>> {
    let failure =
        |cause, t, y: &[f64], statistics| Failure { cause, t, y: Box::from(y), statistics };
    let mut stepper = started.map_err(|cause| failure(cause, t0, y, StepCounts::default()))?;
    let mut steps = || {
        while stepper.t() != stepper.t_end() {
            let t_old = stepper.t();
            stepper.step(system)?;
            if observer.looks_inside(t_old, stepper.t()) {
                stepper.prepare_interpolant(system)?;
            }
            if observer.step(&stepper.last_step().expect("a step was taken")) == Flow::Stop {
                return Ok(Ended::Stopped);
            }
        }
        Ok(Ended::Reached)
    };
    let outcome = steps();
    let (t, statistics) = (stepper.t(), stepper.statistics());
    y.copy_from_slice(stepper.y());
    match outcome {
        Ok(ended) => Ok(Done { statistics, ended, t }),
        Err(cause) => Err(failure(cause, t, y, statistics)),
    }
}

pub trait Explicit: ExplicitMethod {
    /// Integrates from `t0` to `t_end` in place: `y` holds the state at `t0`, and afterwards the last accepted one.
    fn integrate<Y: Ode>(
        &self,
        system: &mut Y,
        t0: f64,
        t_end: f64,
        y: &mut [f64],
        observer: &mut impl Observer,
    ) -> Result<Done, Failure<Y::Stop>> {
        whole(self.start(&*system, (t0, t_end), y), system, t0, y, observer)
    }
}

impl<M: ExplicitMethod> Explicit for M {}

pub trait Implicit: ImplicitMethod {
    /// The same with an implicit method.
    fn integrate<Y: Dae>(
        &self,
        system: &mut Y,
        t0: f64,
        t_end: f64,
        y: &mut [f64],
        observer: &mut impl Observer,
    ) -> Result<Done, Failure<Y::Stop>> {
        whole(self.start(&*system, (t0, t_end), y), system, t0, y, observer)
    }
}

impl<M: ImplicitMethod> Implicit for M {}
