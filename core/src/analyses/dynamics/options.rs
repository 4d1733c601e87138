//! Options of forward dynamics.

use super::{Reason, Singularity};
use crate::analyses::State;
use crate::equations::Gains;
use crate::integrate::{Dop853, GeneralizedAlpha, Radau, Rk4, Rk45, StepControl};
use crate::model::Model;
use crate::stabilize::Projection;

/// Steps times moving bodies of a run that does not bound its steps: some seconds, and half a gigabyte
/// if everything is kept.
const MOST_WORK: usize = 1_000_000;
/// Steps that large models may take in any case.
const LEAST_BOUND: usize = 50_000;
/// Most reported states on a grid.
const MOST_OUTPUTS: f64 = 1e6;

/// The scheme of integration.
#[derive(Clone, Debug, PartialEq)]
pub enum Scheme {
    /// Dormand–Prince 5(4).
    Rk45(Rk45),
    /// Dormand–Prince 8(5,3).
    Dop853(Dop853),
    /// Classical, fixed step.
    Rk4(Rk4),
    /// Implicit, of order 2, at index 3; HHT is one of them.
    GeneralizedAlpha(GeneralizedAlpha),
    /// Implicit, of order 5, at index 2.
    Radau(Radau),
    /// DOP853, and Radau where the equations prove stiff.
    Auto(Auto),
}

/// Options of the automatic choice of the method.
#[derive(Clone, Debug, PartialEq)]
pub struct Auto {
    /// Tolerances and steps; a constant step is refused.
    pub control: StepControl,
}

impl Scheme {
    /// Whether it is explicit whatever the equations are, so that Baumgarte's stabilization serves.
    pub fn is_explicit(&self) -> bool {
        matches!(self, Self::Rk45(_) | Self::Dop853(_) | Self::Rk4(_))
    }
}

/// Most steps of a run that does not bound them: 1 000 000 over the number of moving bodies, and at
/// least 50 000.
pub fn most_steps(model: &Model) -> usize {
    (MOST_WORK / (model.bodies.len() - 1).max(1)).max(LEAST_BOUND)
}

impl Scheme {
    /// Tolerances and steps.
    pub fn control(&self) -> &StepControl {
        match self {
            Self::Rk45(method) => &method.control,
            Self::Dop853(method) => &method.control,
            Self::Rk4(method) => &method.control,
            Self::GeneralizedAlpha(method) => &method.control,
            Self::Radau(method) => &method.control,
            Self::Auto(method) => &method.control,
        }
    }

    /// Tolerances and steps, to be changed.
    pub fn control_mut(&mut self) -> &mut StepControl {
        match self {
            Self::Rk45(method) => &mut method.control,
            Self::Dop853(method) => &mut method.control,
            Self::Rk4(method) => &mut method.control,
            Self::GeneralizedAlpha(method) => &mut method.control,
            Self::Radau(method) => &mut method.control,
            Self::Auto(method) => &mut method.control,
        }
    }

    /// The scheme with a bound on its steps: its own, or [`most_steps`].
    pub(super) fn bounded(&self, model: &Model) -> Self {
        let mut bounded = self.clone();
        bounded.control_mut().max_steps.get_or_insert(most_steps(model));
        bounded
    }
}

/// What keeps the constraints from drifting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stabilization {
    /// Nothing.
    None,
    /// Baumgarte's, with gains α and β.
    Baumgarte(Gains),
    /// Baumgarte's, with gains from the step, and the term held over it ([`StepwiseBaumgarte`](crate::stabilize::StepwiseBaumgarte)).
    BaumgarteFromStep,
    /// Projection of the start, of every accepted and of every reported state.
    Projection(Projection),
}

/// Which states are reported.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Output {
    /// At t₀ + k h up to t_end, and at t_end; h in s.
    Every(f64),
    /// The solver's own steps.
    Steps,
}

/// All options of forward dynamics.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Time at which it ends, s.
    pub t_end: f64,
    /// Time at which it starts, s; that of the start if none.
    pub t_start: Option<f64>,
    /// Which states are reported.
    pub output: Output,
    /// The scheme; without a bound on its steps it is bounded by [`most_steps`].
    pub scheme: Scheme,
    /// What keeps the constraints from drifting.
    pub stabilization: Stabilization,
    /// What to do at a singular position where the motion does not decide the branch.
    pub singularity: Singularity,
    /// Whether the continuous extension of every step is kept.
    pub dense_output: bool,
}

impl Options {
    /// What a user gets who says nothing: the automatic choice of the method, and projection.
    pub fn new(t_end: f64) -> Self {
        Self {
            t_end,
            t_start: None,
            output: Output::Steps,
            scheme: Scheme::Auto(Auto::default()),
            stabilization: Stabilization::Projection(Projection::default()),
            singularity: Singularity::Stop,
            dense_output: true,
        }
    }

    /// The classical way: Dormand–Prince at rtol 1e-6, atol 1e-9 with Baumgarte's α = 10, β = 200.
    pub fn classical(t_end: f64) -> Self {
        Self {
            scheme: Scheme::Rk45(Rk45::new(1e-6, 1e-9)),
            stabilization: Stabilization::Baumgarte(Gains { alpha: 10.0, beta: 200.0 }),
            ..Self::new(t_end)
        }
    }

    /// The gains that the right side uses.
    pub fn gains(&self) -> Gains {
        match self.stabilization {
            Stabilization::Baumgarte(gains) => gains,
            _ => Gains::default(),
        }
    }

    /// Refuses what no integration can begin with. The method checks its own options.
    pub(super) fn check(&self, model: &Model, start: &State) -> Result<(), Reason> {
        if let Output::Every(h) = self.output {
            require("output_step", h, h > 0.0 && h.is_finite(), "> 0 and finite")?;
            let interval = (self.t_end - self.t_start.unwrap_or(start.t)).abs();
            let few = h * MOST_OUTPUTS >= interval * (1.0 - 1e-9);
            require("output_step", h, few, "at least 1e-6 of the time that is simulated")?;
        }
        if let Stabilization::Baumgarte(Gains { alpha, beta }) = self.stabilization {
            require("alpha", alpha, alpha >= 0.0 && alpha.is_finite(), ">= 0 and finite")?;
            require("beta", beta, beta >= 0.0 && beta.is_finite(), ">= 0 and finite")?;
        }
        if let Stabilization::Projection(Projection { tolerance }) = self.stabilization {
            let holds = tolerance > 0.0 && tolerance.is_finite();
            require("tolerance", tolerance, holds, "> 0 and finite")?;
        }
        let baumgarte = matches!(
            self.stabilization,
            Stabilization::Baumgarte(_) | Stabilization::BaumgarteFromStep
        );
        if !self.scheme.is_explicit() && baumgarte {
            let message = "stabilization: Baumgarte's changes the right side of explicit methods; an \
                           implicit one has the constraints among its equations: use projection or none, \
                           or method rk45, dop853 or rk4";
            return Err(Reason::Option { name: "stabilization", message: message.to_string() });
        }
        if let (Scheme::Auto(_), Some(step)) = (&self.scheme, self.scheme.control().step) {
            require(
                "step",
                step,
                false,
                "absent: the automatic choice of the method controls its steps",
            )?;
        }
        let n = model.layout.n_q;
        let must = format!("as long as the coordinates of the model, {n}");
        for (name, length) in [("q", start.q.len()), ("v", start.v.len())] {
            require(name, length as f64, length == n, &must)?;
        }
        Ok(())
    }
}

fn require(name: &'static str, value: f64, holds: bool, must: &str) -> Result<(), Reason> {
    if holds {
        return Ok(());
    }
    Err(Reason::Option { name, message: format!("{name}: {value}; must be {must}") })
}
