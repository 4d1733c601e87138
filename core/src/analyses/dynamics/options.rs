//! Options of forward dynamics.

use crate::equations::Gains;
use crate::integrate::{Atol, Rk4, Rk45};

/// The scheme of integration.
#[derive(Clone, Debug, PartialEq)]
pub enum Scheme {
    /// Dormand–Prince 5(4).
    Rk45(Rk45),
    /// Classical, fixed step.
    Rk4(Rk4),
}

/// What keeps the constraints from drifting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stabilization {
    /// Nothing.
    None,
    /// Baumgarte's, with gains α and β.
    Baumgarte(Gains),
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
    /// The scheme.
    pub scheme: Scheme,
    /// What keeps the constraints from drifting.
    pub stabilization: Stabilization,
    /// Whether the continuous extension of every step is kept.
    pub dense_output: bool,
}

impl Options {
    /// Dormand–Prince at rtol 1e-6, atol 1e-9 with Baumgarte's α = 10, β = 200.
    pub fn new(t_end: f64) -> Self {
        Self {
            t_end,
            t_start: None,
            output: Output::Steps,
            scheme: Scheme::Rk45(Rk45 { rtol: 1e-6, atol: Atol::Scalar(1e-9), ..Rk45::default() }),
            stabilization: Stabilization::Baumgarte(Gains { alpha: 10.0, beta: 200.0 }),
            dense_output: true,
        }
    }

    /// The gains that the right side uses.
    pub fn gains(&self) -> Gains {
        match self.stabilization {
            Stabilization::None => Gains::default(),
            Stabilization::Baumgarte(gains) => gains,
        }
    }
}
