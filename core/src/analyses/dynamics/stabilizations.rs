//! Stabilizations with their options.

use crate::analyses::options::{family, not_negative, options, positive, words};
use crate::equations::Gains;
use crate::stabilize;

/// Stabilization of the constraints against drift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stabilization {
    /// No stabilization.
    None,
    /// Baumgarte's stabilization, with gains α and β.
    Baumgarte(Gains),
    /// Baumgarte's stabilization, with gains from the step and a term that is constant over the step
    /// ([`StepwiseBaumgarte`](crate::stabilize::StepwiseBaumgarte)).
    BaumgarteFromStep,
    /// Projection of every accepted and of every reported state.
    Projection(stabilize::Projection),
}

family!(Stabilization, "stabilization", [Projection, Baumgarte, NoStabilization]);

/// Default gains.
const CLASSICAL: Gains = Gains { alpha: 10.0, beta: 200.0 };

/// Gains without numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AutomaticGains {
    /// Gains from the step.
    Step,
}

words!(AutomaticGains { "step" => Self::Step });

options! {
    /// Stabilization of Baumgarte (1972; Haug 7.3.8) for explicit methods: gamma is replaced by
    /// gamma - 2 alpha (Phi_q v + Phi_t) - beta^2 Phi.
    Baumgarte, "baumgarte", "Baumgarte" () {
        /// Gain of the rate of the constraints, which is multiplied by 2 alpha; 10 if absent.
        alpha: Option<not_negative> [1/s] = None,
        /// Gain of the constraints, which are multiplied by beta^2; 200 if absent. Stability limits
        /// the step to about 3/beta.
        beta: Option<not_negative> [1/s] = None,
        /// "step" computes both gains from each trial step h: alpha = 7/(12 h) and beta =
        /// 1/(sqrt(3) h). The stabilizing term is constant over the step. This choice neither
        /// limits the step nor lowers the order of the method.
        gains: Option<AutomaticGains> = None,
    }
    excludes { gains: alpha, beta; }
}

impl From<Baumgarte> for Stabilization {
    fn from(given: Baumgarte) -> Self {
        match given.gains {
            Some(AutomaticGains::Step) => Self::BaumgarteFromStep,
            None => Self::Baumgarte(Gains {
                alpha: given.alpha.unwrap_or(CLASSICAL.alpha),
                beta: given.beta.unwrap_or(CLASSICAL.beta),
            }),
        }
    }
}

options! {
    /// Projection of accepted and of reported states onto Phi = 0 and Phi_q v + Phi_t = 0 (Eich
    /// 1993). The result is the nearest state in the metric of the mass matrix. Between the steps,
    /// the interpolant deviates from the constraints by the error of integration. The energy
    /// balance shows the change of energy by projection.
    Projection, "projection", "Projection" () {
        /// Largest remaining residual, relative to the size of the mechanism, or in rad for angles.
        tolerance: positive = stabilize::Projection::default().tolerance,
    }
}

impl From<Projection> for Stabilization {
    fn from(Projection { tolerance }: Projection) -> Self {
        Self::Projection(stabilize::Projection { tolerance })
    }
}

options! {
    /// No stabilization: the constraints drift with the error of integration.
    NoStabilization, "none", "NoStabilization" () {}
}

impl From<NoStabilization> for Stabilization {
    fn from(_: NoStabilization) -> Self {
        Self::None
    }
}

impl Stabilization {
    /// Baumgarte's stabilization with the gains of the classical literature, α = 10 and β = 200.
    pub fn classical() -> Self {
        Baumgarte::new().into()
    }
}
