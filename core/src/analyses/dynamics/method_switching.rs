//! The run of a method that is not named: explicit and implicit pieces, one after the other, as
//! `choice` decides.

use super::initial_stiffness::InitialStiffness;
use super::methods::Auto;
use super::motion_dae::MotionDae;
use super::motion_ode::MotionOde;
use super::options::Options;
use super::stiffness_detection::{MethodChoice, StiffnessDetector, LIMIT, TRIAL, WORTH};
use super::Outcome;
use crate::integrate::{
    Dop853, Ended, Flow, ImplicitMethod, Method, Observer, Radau, Statistics, Step, StepControl,
};
use crate::model::Model;

/// Everything a run goes on with from piece to piece.
pub(super) struct MethodSwitching<'a, 'o> {
    model: &'a Model,
    options: &'o Options,
    auto: &'o Auto,
    detector: StiffnessDetector<'a>,
    implicit: Option<MotionDae<'a>>,
    /// Last step of the method that ran last.
    step: Option<f64>,
    total: Option<Statistics>,
    /// Evaluations of the explicit pieces, of which each has its factorisation.
    pub explicitly: usize,
    pub choice: MethodChoice,
}

/// Shows the steps on, and stops where `judge` says so.
struct Judged<'o, O, F> {
    observer: &'o mut O,
    judge: F,
    judged: bool,
    last: Option<f64>,
}

impl<O: Observer, F: FnMut(&Step<'_>) -> bool> Observer for Judged<'_, O, F> {
    fn step(&mut self, step: &Step<'_>) -> Flow {
        self.last = Some((step.t - step.t_old).abs());
        match self.observer.step(step) {
            Flow::Stop => Flow::Stop,
            Flow::Continue => {
                self.judged = (self.judge)(step);
                if self.judged {
                    Flow::Stop
                } else {
                    Flow::Continue
                }
            }
        }
    }

    fn looks_inside(&self, t_old: f64, t: f64) -> bool {
        self.observer.looks_inside(t_old, t)
    }
}

impl<'a, 'o> MethodSwitching<'a, 'o> {
    /// Where the equations of motion are `system` to explicit methods.
    pub fn new(system: &MotionOde<'a>, options: &'o Options, auto: &'o Auto, t0: f64) -> Self {
        let model = system.model;
        let choice = MethodChoice { method: "dop853", why: String::new() };
        Self {
            model,
            options,
            auto,
            detector: StiffnessDetector::new(model, &system.workspace, t0),
            implicit: None,
            step: auto.control.first_step,
            total: None,
            explicitly: 0,
            choice,
        }
    }

    /// Integrates to the end, by one method or the other.
    pub fn run<O: Observer>(
        &mut self,
        system: &mut MotionOde<'a>,
        t0: f64,
        y: &mut [f64],
        observer: &mut O,
    ) -> Outcome {
        let mut t = t0;
        let forecast = self.judge_start(t0, y);
        let mut skipped = forecast.implicit();
        let outcome = loop {
            if !std::mem::take(&mut skipped) {
                match self.explicit(system, t, y, observer) {
                    (Ok(took), true) => t = took.t,
                    (outcome, _) => break outcome,
                }
            }
            match self.implicit(t, y, observer) {
                (Ok(took), true) => t = took.t,
                (outcome, _) => break outcome,
            }
            self.detector.resume(t);
        };
        if self.choice.why.is_empty() {
            self.choice.why = self.not_stiff(&forecast);
        }
        outcome
    }

    /// Judges the model at the start, and has the detector know.
    fn judge_start(&mut self, t: f64, y: &[f64]) -> InitialStiffness {
        let Self { model, options, auto, detector, choice, .. } = self;
        let forecast = InitialStiffness::new(model, detector, auto, (t, options.t_end), y);
        let Some(fastest) = forecast.stiff() else { return forecast };
        if forecast.implicit() {
            detector.seen = Some((fastest, LIMIT / fastest.rate));
            *choice = MethodChoice { method: "radau", why: forecast.why_implicit() };
        } else {
            detector.foretold = Some(fastest.rate);
        }
        forecast
    }

    /// Factorisations beside those that the integrators count.
    pub fn factorisations(&self) -> usize {
        self.explicitly + self.implicit.as_ref().map_or(0, MotionDae::factorisations)
    }

    /// A piece by DOP853; whether it ended for stiffness.
    fn explicit<O: Observer>(
        &mut self,
        system: &mut MotionOde<'a>,
        t: f64,
        y: &mut [f64],
        observer: &mut O,
    ) -> (Outcome, bool) {
        let t_end = self.options.t_end;
        let method = Dop853 { control: self.control(t) };
        let detector = &mut self.detector;
        let foretold = detector.foretold.is_some();
        let judge = |step: &Step<'_>| detector.stiff(step, t_end);
        let mut judged = Judged { observer, judge, judged: false, last: None };
        let outcome = method.integrate(system, t, t_end, y, &mut judged).map_err(Box::new);
        let (stiff, last) = (judged.judged, judged.last);
        let outcome = self.add(outcome, last, true);
        if stiff {
            let (fastest, h) = self.detector.seen.expect("stiffness was seen");
            self.choice = MethodChoice {
                method: "radau",
                why: format!(
                    "stiff: from t = {:.4} s on, since a damped motion with a rate of {:.2e} 1/s held the steps \
                     of dop853 to {h:.1e} s{}",
                    outcome.as_ref().map_or(t, |took| took.t),
                    fastest.rate,
                    if foretold && self.detector.foretold.is_none() {
                        ", as the model told at the start"
                    } else {
                        ""
                    }
                ),
            };
        }
        (outcome, stiff)
    }

    /// A piece by Radau; whether it ended because it does not pay.
    fn implicit<O: Observer>(
        &mut self,
        t: f64,
        y: &mut [f64],
        observer: &mut O,
    ) -> (Outcome, bool) {
        let t_end = self.options.t_end;
        let method = Radau { control: self.control(t) };
        let explicit_step = self.detector.seen.map_or(0.0, |(_, h)| h);
        let (mut taken, mut since) = (0, t);
        let judge = |step: &Step<'_>| {
            taken += 1;
            if taken % TRIAL > 0 {
                return false;
            }
            let h = (step.t - std::mem::replace(&mut since, step.t)).abs() / TRIAL as f64;
            let to_go = (t_end - step.t).abs();
            h < WORTH * explicit_step && to_go > TRIAL as f64 * explicit_step
        };
        let mut judged = Judged { observer, judge, judged: false, last: None };
        let implicit =
            self.implicit.get_or_insert_with(|| MotionDae::new(self.model, self.options));
        let outcome = method.integrate(implicit, t, t_end, y, &mut judged).map_err(Box::new);
        let (back, last) = (judged.judged, judged.last);
        let outcome = self.add(outcome, last, false);
        if back {
            self.choice = MethodChoice {
                method: "dop853",
                why: format!(
                    "hardly stiff: radau was tried at t = {t:.4} s, and its steps became no longer than {WORTH} of \
                     {explicit_step:.1e} s"
                ),
            };
        }
        (outcome, back)
    }

    /// Tolerances and steps of a piece that begins at `t`.
    fn control(&self, t: f64) -> StepControl {
        let taken = self.total.map_or(0, |total| total.steps);
        let StepControl { max_steps, .. } = self.auto.control;
        StepControl {
            first_step: self.step.map(|h| h.min((self.options.t_end - t).abs())),
            max_steps: max_steps.map(|most| most - taken.min(most)),
            ..self.auto.control.clone()
        }
    }

    /// Counts a piece to those before; the outcome then tells of all.
    fn add(&mut self, outcome: Outcome, last: Option<f64>, explicit: bool) -> Outcome {
        self.step = last.or(self.step);
        let took = outcome.as_ref().map_or_else(|failure| failure.statistics, |took| *took);
        if explicit {
            self.explicitly += took.evaluations;
        }
        let total = self.total.get_or_insert(Statistics {
            steps: 0,
            rejected: 0,
            evaluations: 0,
            jacobians: 0,
            factorisations: 0,
            iterations: 0,
            ended: Ended::Stopped,
            t: took.t,
        });
        total.steps += took.steps;
        total.rejected += took.rejected;
        total.evaluations += took.evaluations;
        total.jacobians += took.jacobians;
        total.factorisations += took.factorisations;
        total.iterations += took.iterations;
        (total.ended, total.t) = (took.ended, took.t);
        let total = *total;
        outcome.map(|_| total).map_err(|mut failure| {
            failure.statistics = total;
            failure
        })
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
