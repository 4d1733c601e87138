//! The definition of an explicit Runge–Kutta method.

use super::stages::Block;
use super::step_control::StepControl;
use super::step_placement::Gap;
use super::step_size::Control;
use super::tolerances::Squares;
use std::borrow::Cow;

/// An explicit Runge–Kutta method whose last stage is the derivative at the end of a step.
pub(super) trait RungeKutta: 'static {
    /// Order of the error estimate.
    const ERROR_ORDER: i32;
    /// Whether the error estimate uses the last stage. If not, the last stage is evaluated for accepted steps only.
    const LAST_IN_ERROR: bool;
    /// Constants of the step-size controller.
    const CONTROL: Control;
    /// Number of stages, including the derivative at the end.
    const STAGES: usize;
    /// Number of stages that only the continuous extension needs.
    const EXTRA: usize = 0;
    /// Degree of the continuous extension.
    const DEGREE: usize;
    /// The widest gap between stages. A time to avoid is passed within it.
    const GAP: Gap;
    /// Table of the interpolant with STAGES + EXTRA + 1 rows. The last row, 3θ² - 2θ³, moves the end to a projected
    /// state.
    const TABLE: &'static [f64];
    /// Weights wᵢ of the stages with ∫ y dt = h y_old + h² Σ wᵢ kᵢ over a step, to the order of the method. Methods
    /// with extra stages define them, for systems that do not need these stages.
    const DOUBLE_QUADRATURE: &'static [f64] = &[];
    /// Table of an interpolant of lower order, with zeros for the extra stages.
    const WITHOUT_EXTRA: &'static [f64] = Self::TABLE;

    /// Tolerances and steps.
    fn control(&self) -> Cow<'_, StepControl>;

    /// Computes the stages after the first, which is given, into rows of `k`, and the state at the end into `y_new`.
    /// The last stage is computed only if [`LAST_IN_ERROR`](Self::LAST_IN_ERROR) is true.
    fn advance<T: TrialStages>(
        trial: &mut T,
        k: &mut [Block],
        y_new: &mut [Block],
    ) -> Result<(), T::Stop>;

    /// Computes the extra stages of an accepted step, in the rows of `k` after the other stages.
    fn extend<T: TrialStages>(_: &mut T, _k: &mut [Block]) -> Result<(), T::Stop> {
        Ok(())
    }

    /// The sums of squares from which [`error_norm`](Self::error_norm) is computed. `states` are y and y_new.
    fn error_squares<N: Squares>(k: &[Block], states: [&[Block]; 2], norm: &N) -> [N::Sum; 2];

    /// √(mean (errorᵢ / scaleᵢ)²) over the controlled components, from the sums of their squares.
    fn error_norm(h: f64, squares: [f64; 2], components: f64) -> f64;
}

/// The evaluations of a trial step, of one state or of one state in each lane.
pub(super) trait TrialStages {
    /// The reason for which a trial ends early.
    type Stop;

    /// Number of blocks in a row.
    fn width(&self) -> usize;

    /// out = f(t + c h, y + h Σₛ aₛ kₛ). Whether `out` is finite is checked only in the sums that use it. The last of
    /// the stages k must therefore be the stage before, with a nonzero weight.
    ///
    /// # Errors
    /// Errors of f, and a sum that is not finite.
    fn stage<const S: usize>(
        &mut self,
        c: f64,
        a: [f64; S],
        k: [&[Block]; S],
        out: &mut [Block],
    ) -> Result<(), Self::Stop>;

    /// out = y + (h / divisor) Σₛ aₛ kₛ, checked to be finite. k is as for [`stage`](Self::stage).
    ///
    /// # Errors
    /// A sum that is not finite.
    fn end<const S: usize>(
        &mut self,
        divisor: f64,
        a: [f64; S],
        k: [&[Block]; S],
        out: &mut [Block],
    ) -> Result<(), Self::Stop>;

    /// dy = f at the end of the step.
    ///
    /// # Errors
    /// Errors of f, and a derivative that is not finite.
    fn rate_at_end(&mut self, y_new: &[Block], dy: &mut [Block]) -> Result<(), Self::Stop>;

    /// Returns an error if the last stage is not finite.
    ///
    /// # Errors
    /// A stage that is not finite.
    fn finite(&self, stage: &[Block]) -> Result<(), Self::Stop>;
}
