//! The definition of an explicit Runge–Kutta method.

use super::failure::Cause;
use super::ode::Ode;
use super::stages::Block;
use super::step_control::StepControl;
use super::step_placement::Gap;
use super::step_size::Control;
use super::tolerances::Tolerances;
use super::trial::Trial;
use std::borrow::Cow;

/// An explicit Runge–Kutta method that has the derivative at the end of a step as its last stage.
pub(super) trait RungeKutta: 'static {
    /// Order of the error estimate.
    const ERROR_ORDER: i32;
    /// Whether the error estimate uses the last stage. If not, the stage is evaluated for accepted steps only.
    const LAST_IN_ERROR: bool;
    /// The choice of its steps.
    const CONTROL: Control;
    /// Number of stages, the derivative at the end included.
    const STAGES: usize;
    /// Number of stages that only the continuous extension needs.
    const EXTRA: usize = 0;
    /// Degree of the continuous extension.
    const DEGREE: usize;
    /// The widest gap between stages, where a time to avoid is passed.
    const GAP: Gap;
    /// STAGES + EXTRA + 1 rows of its table; the last row, 3θ² - 2θ³, moves its end to a projected state.
    const TABLE: &'static [f64];
    /// Weights wᵢ of the stages by which ∫ y dt = h y_old + h² Σ wᵢ kᵢ over a step, to its order: where
    /// there are extra stages, for systems that can do without them.
    const DOUBLE_QUADRATURE: &'static [f64] = &[];
    /// The table of a lesser extension, with zeros for the extra stages.
    const WITHOUT_EXTRA: &'static [f64] = Self::TABLE;

    /// Tolerances and steps.
    fn control(&self) -> Cow<'_, StepControl>;

    /// The stages after the first, which is given, in rows of `k`, the last one only if it is
    /// [`LAST_IN_ERROR`](Self::LAST_IN_ERROR); the state at the end into `y_new`.
    fn advance<Y: Ode>(
        trial: &mut Trial<'_, '_, Y>,
        k: &mut [Block],
        y_new: &mut [Block],
    ) -> Result<(), Cause<Y::Stop>>;

    /// The extra stages of an accepted step, in the rows of `k` after the others.
    fn extend<Y: Ode>(_: &mut Trial<'_, '_, Y>, _k: &mut [Block]) -> Result<(), Cause<Y::Stop>> {
        Ok(())
    }

    /// √(mean (errorᵢ / scaleᵢ)²) over the components that count; `states` are y and y_new.
    fn error_norm(
        h: f64,
        k: &[Block],
        states: (&[Block], &[Block]),
        tolerances: &Tolerances,
    ) -> f64;
}
