//! The classical Runge–Kutta method of order 4 with a constant step (Kutta, *Z. Math. Phys.* 46 (1901) 435). The
//! cubic Hermite polynomial, of order 3, interpolates between the steps.

use super::runge_kutta::{RungeKutta, TrialStages};
use super::stages::{rows_mut, Block};
use super::step_control::StepControl;
use super::step_placement::Gap;
use super::step_size::Control;
use super::tolerances::Squares;
use crate::math::{Lanes, Real};
use std::borrow::Cow;

/// The classical Runge–Kutta method with its options.
///
/// The method requires a constant step and does not estimate errors.
#[derive(Clone, Debug, PartialEq)]
pub struct Rk4 {
    /// The step, and the largest number of steps.
    pub control: StepControl,
}

impl Rk4 {
    /// The method with this step and no bound on the number of steps.
    pub fn new(step: f64) -> Self {
        Self { control: StepControl::constant(step) }
    }
}

/// Weights of the stages.
const B: [f64; 4] = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];

/// Coefficients of θ … θ⁴ for each stage and for the jump of a projection. They combine θ (1 - θ)² for the derivative
/// at the beginning, θ² (θ - 1) for the derivative at the end, and 3θ² - 2θ³ for the chord, which is the weighted
/// mean of the stages.
#[rustfmt::skip]
const HERMITE: [f64; 24] = [
    1.0, -2.0 + 3.0 * B[0], 1.0 - 2.0 * B[0], 0.0,
    0.0, 3.0 * B[1], -2.0 * B[1], 0.0,
    0.0, 3.0 * B[2], -2.0 * B[2], 0.0,
    0.0, 3.0 * B[3], -2.0 * B[3], 0.0,
    0.0, -1.0, 1.0, 0.0,
    0.0, 3.0, -2.0, 0.0,
];

impl RungeKutta for Rk4 {
    const ERROR_ORDER: i32 = 4;
    const LAST_IN_ERROR: bool = false;
    const CONTROL: Control = Control::ELEMENTARY;
    const STAGES: usize = 5;
    const DEGREE: usize = 4;
    // between the stages at 1/2 and 1
    const GAP: Gap = Gap { middle: 0.75, half: 0.25 };
    const TABLE: &'static [f64] = &HERMITE;

    fn control(&self) -> Cow<'_, StepControl> {
        let step = Some(self.control.step.unwrap_or(f64::NAN)); // a missing step is an error
        Cow::Owned(StepControl { step, ..self.control.clone() })
    }

    fn advance<T: TrialStages>(
        trial: &mut T,
        k: &mut [Block],
        y_new: &mut [Block],
    ) -> Result<(), T::Stop> {
        let [k1, k2, k3, k4] = rows_mut(k, trial.width());
        trial.stage(0.5, [0.5], [k1], k2)?;
        trial.stage(0.5, [0.5], [k2], k3)?;
        trial.stage(1.0, [1.0], [k3], k4)?;
        // divided by 6, so that the weights are exact
        trial.end(6.0, [1.0, 2.0, 2.0, 1.0], [k1, k2, k3, k4], y_new)
    }

    /// Zero, since the step is constant.
    fn error_squares<N: Squares>(_: &[Block], states: [&[Block]; 2], norm: &N) -> [N::Sum; 2] {
        norm.squares(states, |_| [Lanes::zero(); 2])
    }

    fn error_norm(_: f64, _: [f64; 2], _: f64) -> f64 {
        0.0
    }
}
