//! The memory of a stepper of an explicit method, and its last accepted step.

use super::hermite_birkhoff::HermiteBirkhoff;
use super::ode::Ode;
use super::runge_kutta::RungeKutta;
use super::stages::{room, width, Block};
use super::step_control::StepControl;
use super::tolerances::Tolerances;

/// Memory of a stepper.
pub(super) struct Work {
    /// Blocks in a row.
    pub width: usize,
    /// Stages, extra ones, the jump of a projection over h, the derivative after a projection if it is not
    /// the last stage.
    pub k: Vec<Block>,
    /// The state at the beginning of the step.
    pub y: Vec<Block>,
    /// The state at its end.
    pub y_new: Vec<Block>,
    /// Arguments of stages; the state before a projection.
    pub trial: Vec<Block>,
    /// Tangent parts of the stages.
    pub tangential: Vec<Block>,
    pub tolerances: Tolerances,
    /// The interpolant of systems of second order, for methods whose own takes extra stages.
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

/// How far the interpolant of a step is prepared.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum InterpolantLevel {
    /// Prepared from the ends of the step alone.
    Ends,
    /// Prepared from the stages of the step alone.
    Plain,
    /// Prepared with the extra stages of the method.
    Extended,
    /// Prepared by one evaluation inside the step.
    HermiteBirkhoff,
}
