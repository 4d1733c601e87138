//! Options of forward dynamics.

use super::failure::Reason;
use super::methods::Scheme;
use super::singularity_passage::Singularity;
use super::stabilizations::Stabilization;
use crate::analyses::options::{
    count, flag, name, not_negative, number, options, positive, words, Bounded, Declared, Reader,
};
use crate::analyses::State;
use crate::equations::Gains;
use crate::model::{Model, Problem, Value};
use crate::stabilize::Projection;

/// Default of max_steps, times the moving bodies: some seconds, and half a gigabyte if everything is kept.
const MOST_WORK: usize = 1_000_000;
/// Smallest default of max_steps, for large models.
const LEAST_BOUND: usize = 50_000;
/// Largest number of reported states on a grid.
const MOST_OUTPUTS: f64 = 1e6;

/// The states that are reported without `output_step`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Output {
    /// The solver's own steps.
    Steps,
}

words!(Output { "steps" => Self::Steps });
words!(Singularity { "stop" => Self::Stop, "pass" => Self::Pass });

options! {
    /// Motion under forces, by integration of the equations of motion.
    Options, "dynamics", "Dynamics" (
        /// Time at which the simulation ends.
        t_end: number [s]
    ) {
        /// Time between the reported states; if absent, the steps of the solver are reported.
        output_step: Option<positive> [s] = None,
        /// Method of integration.
        method: Scheme = Scheme::default(),
        /// Stabilization of the constraints against drift.
        stabilization: Stabilization = Stabilization::default(),
        /// Largest number of steps. The run fails when it needs more, or at once if so many steps of the largest
        /// allowed length cannot reach t_end. If absent, 1 000 000 over the number of moving bodies, at least 50 000.
        /// Half as many rejected steps, if over 10 000, end the run too.
        max_steps: Option<count> = None,
        /// Whether the solution can be evaluated at any time.
        dense_output: flag = true,
        /// Time at which the simulation starts; if absent, the time of the first state.
        t_start: Option<number> [s] = None,
        /// At a singular position where the motion does not decide its branch: "stop" with an error, or "pass".
        singularity: Singularity = Singularity::Stop,
        /// "steps" reports the steps of the solver, as without this option.
        output: Option<Output> = None,
        /// State at which it starts: "start", or the name of an earlier analysis for the end of that analysis. If
        /// absent, the end of the analysis before it.
        from: Option<name> = None,
    }
    excludes { output_step: output; }
}

/// Reads the fields of an analysis of type `dynamics`; `path` is its path in the file.
///
/// # Errors
/// Every faulty value, with its path.
pub fn read(
    model: &Model,
    fields: &[(String, Value)],
    path: &[String],
) -> Result<Options, Vec<Problem>> {
    Reader::read(model, fields, path, Options::read)
}

/// Default of max_steps: 1 000 000 over the number of moving bodies, and at least 50 000.
pub fn most_steps(model: &Model) -> usize {
    (MOST_WORK / (model.bodies.len() - 1).max(1)).max(LEAST_BOUND)
}

impl Options {
    /// The classical options: Dormand–Prince with Baumgarte's α = 10, β = 200.
    pub fn classical(t_end: f64) -> Self {
        Self {
            method: Scheme::Rk45(Default::default()),
            stabilization: Stabilization::classical(),
            ..Self::new(t_end)
        }
    }

    /// The method with a bound on its steps: its own, that of the run, or [`most_steps`].
    pub(super) fn bounded_method(&self, model: &Model) -> Scheme {
        let mut bounded = self.method.clone();
        let most = self.max_steps.unwrap_or_else(|| most_steps(model));
        bounded.control_mut().max_steps.get_or_insert(most);
        bounded
    }

    /// The gains that the right side uses.
    pub fn gains(&self) -> Gains {
        match self.stabilization {
            Stabilization::Baumgarte(gains) => gains,
            _ => Gains::default(),
        }
    }

    /// Checks the options that every integration needs. The method checks its own options.
    pub(super) fn check(&self, model: &Model, start: &State) -> Result<(), Reason> {
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
            return Err(Reason::Option { name: "stabilization", message: message.to_string() });
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
fn bounded<B: Bounded>(name: &'static str, value: f64) -> Result<(), Reason> {
    require(name, value, value.is_finite() && B::holds(value), &format!("{} and finite", B::MUST))
}

fn require(name: &'static str, value: f64, holds: bool, must: &str) -> Result<(), Reason> {
    if holds {
        return Ok(());
    }
    Err(Reason::Option { name, message: format!("{name}: {value}; must be {must}") })
}
