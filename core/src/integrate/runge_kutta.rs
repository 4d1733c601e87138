//! The definition of an explicit Runge–Kutta method.

use super::stages::Block;
use super::step_control::StepControl;
use super::step_placement::Gap;
use super::step_size::Control;
use super::tolerances::Squares;
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
    fn advance<T: TrialStages>(
        trial: &mut T,
        k: &mut [Block],
        y_new: &mut [Block],
    ) -> Result<(), T::Stop>;

    /// The extra stages of an accepted step, in the rows of `k` after the others.
    fn extend<T: TrialStages>(_: &mut T, _k: &mut [Block]) -> Result<(), T::Stop> {
        Ok(())
    }

    /// The sums of squares of which [`error_norm`](Self::error_norm) is made; `states` are y and y_new.
    fn error_squares<N: Squares>(k: &[Block], states: [&[Block]; 2], norm: &N) -> [N::Sum; 2];

    /// √(mean (errorᵢ / scaleᵢ)²) over the components that count, from the sums of their squares.
    fn error_norm(h: f64, squares: [f64; 2], components: f64) -> f64;
}

/// The evaluations of a trial step, of one state or of one in each lane.
pub(super) trait TrialStages {
    /// The reason for which a trial ends early.
    type Stop;

    /// Blocks in a row.
    fn width(&self) -> usize;

    /// out = f(t + c h, y + h Σₛ aₛ kₛ). The result is checked to be finite only in the sums that use it: the last of
    /// the stages k must be the one before, with a weight that is not zero.
    ///
    /// # Errors
    /// Those of f, and a sum that is not finite.
    fn stage<const S: usize>(
        &mut self,
        c: f64,
        a: [f64; S],
        k: [&[Block]; S],
        out: &mut [Block],
    ) -> Result<(), Self::Stop>;

    /// out = y + (h / divisor) Σₛ aₛ kₛ, all finite; with k as there.
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
    /// Those of f, and a derivative that is not finite.
    fn rate_at_end(&mut self, y_new: &[Block], dy: &mut [Block]) -> Result<(), Self::Stop>;

    /// Refuses the last stage if it is not finite.
    ///
    /// # Errors
    /// A stage that is not finite.
    fn finite(&self, stage: &[Block]) -> Result<(), Self::Stop>;
}
