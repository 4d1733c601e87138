//! The work memory of an explicit stepper, and its last accepted step.

use super::hermite_birkhoff::HermiteBirkhoff;
use super::ode::Ode;
use super::runge_kutta::RungeKutta;
use super::stages::{room, width, Block};
use super::step_control::StepControl;
use super::tolerances::Tolerances;

/// Work memory of a stepper.
pub(super) struct Work {
    /// Number of blocks in a row.
    pub width: usize,
    /// Rows: the stages, the extra stages, the jump of a projection divided by h, and the derivative after a
    /// projection if it is not the last stage.
    pub k: Vec<Block>,
    /// The state at the beginning of the step.
    pub y: Vec<Block>,
    /// The state at the end of the step.
    pub y_new: Vec<Block>,
    /// Arguments of the stages, later the state before a projection.
    pub trial: Vec<Block>,
    /// Tangential components of the stages.
    pub tangential: Vec<Block>,
    pub tolerances: Tolerances,
    /// Tolerances of the quadratures alone, relative to their scale.
    pub quadratures: Tolerances,
    /// The interpolant of a system of second order, for methods whose own interpolant needs extra stages.
    pub hermite_birkhoff: Option<HermiteBirkhoff>,
}

impl Work {
    pub fn new<P: RungeKutta>(system: &impl Ode, control: &StepControl, initial: &[f64]) -> Self {
        let (n, structure) = (system.len(), system.structure());
        assert_eq!(structure.total(), n, "the structure of all components");
        let second_order = structure.positions > 0 && !P::DOUBLE_QUADRATURE.is_empty();
        let mut y = room(1, n);
        y.as_flattened_mut()[..n].copy_from_slice(initial);
        Self {
            width: width(n),
            k: room(P::STAGES + P::EXTRA + 2, n),
            y,
            y_new: room(1, n),
            trial: room(1, n),
            tangential: Vec::new(),
            tolerances: Tolerances::new(control.rtol, &control.atol, structure.controlled()),
            quadratures: Tolerances::of_quadratures(control.rtol, structure),
            hermite_birkhoff: second_order.then(|| HermiteBirkhoff::new(structure)),
        }
    }
}

/// The last accepted step.
#[derive(Clone, Copy)]
pub(super) struct Accepted {
    pub t: f64,
    pub projected: bool,
    pub interpolant: InterpolantLevel,
}

/// The data from which the interpolant of a step is prepared.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum InterpolantLevel {
    /// The ends of the step.
    Ends,
    /// The stages of the step.
    Plain,
    /// The stages of the step and the extra stages of the method.
    Extended,
    /// The ends and one evaluation inside the step.
    HermiteBirkhoff,
}
