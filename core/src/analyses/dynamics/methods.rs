//! Methods of integration.

use crate::integrate::{Dop853, GeneralizedAlpha, Radau, Rk4, Rk45, StepControl};

/// The method of integration.
#[derive(Clone, Debug, PartialEq)]
pub enum Scheme {
    /// Dormand–Prince 5(4).
    Rk45(Rk45),
    /// Dormand–Prince 8(5,3).
    Dop853(Dop853),
    /// The classical method with a constant step.
    Rk4(Rk4),
    /// Implicit, of order 2, at index 3; HHT is a special case.
    GeneralizedAlpha(GeneralizedAlpha),
    /// Implicit, of order 5, at index 2.
    Radau(Radau),
    /// DOP853, and Radau if the equations are stiff.
    Auto(Auto),
}

/// The automatic choice of the method.
#[derive(Clone, Debug, PartialEq)]
pub struct Auto {
    /// Tolerances and steps; a constant step is not allowed.
    pub control: StepControl,
}

impl Default for Auto {
    fn default() -> Self {
        Self { control: StepControl::with(StepControl::AUTO) }
    }
}

impl Scheme {
    /// Whether it is explicit for every model, as Baumgarte's stabilization requires.
    pub fn is_explicit(&self) -> bool {
        matches!(self, Self::Rk45(_) | Self::Dop853(_) | Self::Rk4(_))
    }

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

    /// Tolerances and steps, mutable.
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
}
