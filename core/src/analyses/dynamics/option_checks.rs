//! Checks of the options that every integration needs.

use super::failure::{Failure, Reason};
use super::methods::Scheme;
use super::options::Options;
use super::stabilizations::Stabilization;
use super::switch_schedule::Schedule;
use crate::analyses::options::{not_negative, positive, Bounded};
use crate::analyses::State;
use crate::equations::Gains;
use crate::model::{Model, Problem};
use crate::stabilize::Projection;

/// Largest number of reported states on a grid.
const MOST_OUTPUTS: f64 = 1e6;

impl Options {
    /// Checks the options that every integration needs. The method checks its own options.
    pub(super) fn check(&self, model: &Model, start: &State) -> Result<(), Box<Failure>> {
        self.check_combination()?;
        self.check_output(self.t_start.unwrap_or(start.t))?;
        check_lengths(model, start)
    }

    /// The first option that no run of the model can have: its path and its fault. Only faults that can be found
    /// without a run are reported. `t0` is the start of the run, if it is known.
    pub(in crate::analyses) fn fault(&self, model: &Model, t0: Option<f64>) -> Option<Problem> {
        let t0 = self.t_start.or(t0);
        let found = self.check_combination().and_then(|()| match t0 {
            Some(t0) => self.check_output(t0).and_then(|()| {
                self.check_steps(model, t0)?;
                Schedule::new(model, (t0, self.t_end)).map(|_| ())
            }),
            None => Ok(()),
        });
        let step = if self.method.control().step.is_some() { "step" } else { "max_step" };
        found.err().map(|failure| option_problem(failure.reason, step))
    }

    /// Makes the checks that the integrator makes before its first step.
    fn check_steps(&self, model: &Model, t0: f64) -> Result<(), Box<Failure>> {
        let checked = self.bounded_method(model).control().check_times(t0, self.t_end);
        let nowhere = || vec![0.0; model.layout.n_y()];
        checked.map_err(|cause| Failure::of_integrator(model, cause, t0, &nowhere()))
    }

    fn check_output(&self, t0: f64) -> Result<(), Box<Failure>> {
        let Some(h) = self.output_step else { return Ok(()) };
        bounded::<positive>("output_step", h)?;
        let interval = (self.t_end - t0).abs();
        let few = h * MOST_OUTPUTS >= interval * (1.0 - 1e-9);
        require("output_step", h, few, "at least 1e-6 of the time that is simulated")
    }

    fn check_combination(&self) -> Result<(), Box<Failure>> {
        if let Stabilization::Baumgarte(Gains { alpha, beta }) = self.stabilization {
            bounded::<not_negative>("alpha", alpha)?;
            bounded::<not_negative>("beta", beta)?;
        }
        if let Stabilization::Projection(Projection { tolerance }) = self.stabilization {
            bounded::<positive>("tolerance", tolerance)?;
        }
        let baumgarte = matches!(
            self.stabilization,
            Stabilization::Baumgarte(_) | Stabilization::BaumgarteFromStep
        );
        if !self.method.is_explicit() && baumgarte {
            let message = "stabilization: Baumgarte's changes the right side of explicit methods; an \
                           implicit one has the constraints among its equations: use projection or none, \
                           or method rk45, dop853 or rk4";
            let (name, message) = ("stabilization", message.to_string());
            return Err(Reason::Option { name, message }.into());
        }
        if let (Scheme::Auto(_), Some(step)) = (&self.method, self.method.control().step) {
            require(
                "step",
                step,
                false,
                "absent: the automatic choice of the method controls its steps",
            )?;
        }
        Ok(())
    }
}

/// The problem of an option, with its path in the analysis. `step` is the option that sets the number of steps.
fn option_problem(reason: Reason, step: &'static str) -> Problem {
    match reason {
        Reason::Option { name, message } => {
            let path = match name {
                "alpha" | "beta" | "tolerance" => vec!["stabilization", name],
                "output_step" | "stabilization" | "t_end" => vec![name],
                "t0" | "t_end - t0" => vec!["t_end"],
                _ => vec!["method", name],
            };
            let prefix = format!("{name}: ");
            Problem::at(&path, message.strip_prefix(&prefix).unwrap_or(&message))
        }
        Reason::Integration { message, hint, .. } => {
            Problem::at(&["method", step], message).hint(hint)
        }
        Reason::Law { message, hint, .. } => Problem::new(message).hint(hint),
        other => Problem::new(other.to_string()),
    }
}

/// Checks that a state has the lengths of the model.
pub(super) fn check_lengths(model: &Model, state: &State) -> Result<(), Box<Failure>> {
    let (n_q, n_z) = (model.layout.n_q, model.layout.n_z);
    for (name, part, n) in [("q", &state.q, n_q), ("v", &state.v, n_q), ("z", &state.z, n_z)] {
        let must = format!("as long as the state of the model, {n}");
        require(name, part.len() as f64, part.len() == n, &must)?;
    }
    Ok(())
}

/// Checks that a number is finite and within the bounds of its kind.
fn bounded<B: Bounded>(name: &'static str, value: f64) -> Result<(), Box<Failure>> {
    require(name, value, value.is_finite() && B::holds(value), &format!("{} and finite", B::MUST))
}

fn require(name: &'static str, value: f64, holds: bool, must: &str) -> Result<(), Box<Failure>> {
    if holds {
        return Ok(());
    }
    Err(Reason::Option { name, message: format!("{name}: {value}; must be {must}") }.into())
}
