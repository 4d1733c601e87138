//! The classical Runge–Kutta method of order 4 with a constant step (Kutta, *Z. Math. Phys.* 46 (1901)
//! 435); between steps the cubic Hermite polynomial, of order 3.

use super::explicit_stepper::start;
use super::failure::Cause;
use super::ode::Ode;
use super::right_hand_side::RightHandSide;
use super::runge_kutta::RungeKutta;
use super::stages::{combine, rows_mut, Block};
use super::step_control::StepControl;
use super::step_placement::Gap;
use super::step_size::Control;
use super::stepper::{BoxedStepper, ExplicitMethod};
use super::tolerances::Tolerances;
use super::trial::Trial;

/// Classical Runge–Kutta 4 with its options.
///
/// It needs a constant step; errors are not estimated.
#[derive(Clone, Debug, PartialEq)]
pub struct Rk4 {
    /// The step, and the largest number of steps.
    pub control: StepControl,
}

impl Rk4 {
    /// With the given step and no bound on their number.
    pub fn new(step: f64) -> Self {
        Self { control: StepControl::constant(step) }
    }
}

impl ExplicitMethod for Rk4 {
    fn start<Y: Ode>(
        &self,
        system: &Y,
        span: (f64, f64),
        y: &[f64],
    ) -> Result<BoxedStepper<Y, Y::Stop>, Cause<Y::Stop>> {
        let step = Some(self.control.step.unwrap_or(f64::NAN)); // no step is refused
        start::<Classical, Y>(&StepControl { step, ..self.control.clone() }, system, span, y)
    }
}

struct Classical;

/// Weights of the stages.
const B: [f64; 4] = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];

/// Coefficients of θ … θ⁴ of each stage, and of the jump of a projection: θ (1 - θ)² of the derivative at the
/// beginning, θ² (θ - 1) of that at the end, and 3θ² - 2θ³ of the chord, which is the weighted mean of the stages.
#[rustfmt::skip]
const HERMITE: [f64; 24] = [
    1.0, -2.0 + 3.0 * B[0], 1.0 - 2.0 * B[0], 0.0,
    0.0, 3.0 * B[1], -2.0 * B[1], 0.0,
    0.0, 3.0 * B[2], -2.0 * B[2], 0.0,
    0.0, 3.0 * B[3], -2.0 * B[3], 0.0,
    0.0, -1.0, 1.0, 0.0,
    0.0, 3.0, -2.0, 0.0,
];

impl RungeKutta for Classical {
    const ERROR_ORDER: i32 = 4;
    const LAST_IN_ERROR: bool = false;
    const CONTROL: Control = Control::ELEMENTARY;
    const STAGES: usize = 5;
    const DEGREE: usize = 4;
    // between the stages at 1/2 and 1
    const GAP: Gap = Gap { middle: 0.75, half: 0.25 };
    const TABLE: &'static [f64] = &HERMITE;

    fn advance<Y: Ode>(
        rhs: &mut RightHandSide<'_, Y>,
        (t, t_new): (f64, f64),
        y: &[Block],
        k: &mut [Block],
        work: &mut [Block],
        y_new: &mut [Block],
    ) -> Result<(), Cause<Y::Stop>> {
        let [k1, k2, k3, k4] = rows_mut(k, y.len());
        let mut trial = Trial::new(rhs, (t, t_new - t), y, work);
        trial.stage(0.5, [0.5], [k1], k2)?;
        trial.stage(0.5, [0.5], [k2], k3)?;
        trial.stage(1.0, [1.0], [k3], k4)?;
        // by sixths, which are exact
        match combine(y, (t_new - t) / 6.0, [1.0, 2.0, 2.0, 1.0], [k1, k2, k3, k4], y_new) {
            true => Ok(()),
            false => Err(Cause::NotFinite { t: t_new }),
        }
    }

    /// There is none: the step is constant.
    fn error_norm(_: f64, _: &[Block], _: (&[Block], &[Block]), _: &Tolerances) -> f64 {
        0.0
    }
}
