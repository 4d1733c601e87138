//! Checks of the options that every integration needs.

use super::failure::{Failure, Reason};
use super::methods::Scheme;
use super::options::Options;
use super::stabilizations::Stabilization;
use crate::analyses::options::{not_negative, positive, Bounded};
use crate::analyses::State;
use crate::equations::Gains;
use crate::model::Model;
use crate::stabilize::Projection;

/// Largest number of reported states on a grid.
const MOST_OUTPUTS: f64 = 1e6;

impl Options {
    /// Checks the options that every integration needs. The method checks its own options.
    pub(super) fn check(&self, model: &Model, start: &State) -> Result<(), Box<Failure>> {
        if let Some(h) = self.output_step {
            bounded::<positive>("output_step", h)?;
            let interval = (self.t_end - self.t_start.unwrap_or(start.t)).abs();
            let few = h * MOST_OUTPUTS >= interval * (1.0 - 1e-9);
            require("output_step", h, few, "at least 1e-6 of the time that is simulated")?;
        }
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
        let (n_q, n_z) = (model.layout.n_q, model.layout.n_z);
        for (name, part, n) in [("q", &start.q, n_q), ("v", &start.v, n_q), ("z", &start.z, n_z)] {
            let must = format!("as long as the state of the model, {n}");
            require(name, part.len() as f64, part.len() == n, &must)?;
        }
        Ok(())
    }
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
