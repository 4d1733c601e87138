//! Dormand–Prince 5(4): explicit adaptive method with local extrapolation and a continuous extension of order 4.
//!
//! The pair is that of Dormand and Prince, *A family of embedded Runge–Kutta formulae*, J. Comput. Appl. Math. 6
//! (1980) 19. The extension is that of Shampine, *Some practical Runge–Kutta formulas*, Math. Comp. 46 (1986) 135,
//! with the optimal c₆. The step control is that of `scipy.integrate.RK45`.

use super::runge_kutta::{RungeKutta, TrialStages};
use super::stages::{rows, rows_mut, sum_at, Block};
use super::step_control::StepControl;
use super::step_placement::Gap;
use super::step_size::Control;
use super::tolerances::Squares;
use std::borrow::Cow;

/// The Dormand–Prince method 5(4) with its options.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rk45 {
    /// Tolerances and steps.
    pub control: StepControl,
}

impl Rk45 {
    /// The method with these tolerances and no bounds on steps.
    pub fn new(rtol: f64, atol: f64) -> Self {
        Self { control: StepControl::new(rtol, atol) }
    }
}

const C: [f64; 5] = [1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0];
const A2: [f64; 1] = [1.0 / 5.0];
const A3: [f64; 2] = [3.0 / 40.0, 9.0 / 40.0];
const A4: [f64; 3] = [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0];
const A5: [f64; 4] = [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0];
const A6: [f64; 5] =
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0];
/// Weights of the solution of order 5, without the second weight, which is zero.
const B: [f64; 5] = [35.0 / 384.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0];
/// The solution of order 4 minus that of order 5, without the second weight, which is zero.
const E: [f64; 6] = [
    -71.0 / 57600.0,
    71.0 / 16695.0,
    -71.0 / 1920.0,
    17253.0 / 339200.0,
    -22.0 / 525.0,
    1.0 / 40.0,
];
/// Coefficients of θ … θ⁴ for each stage and for the jump of a projection.
#[rustfmt::skip]
const P: [f64; 32] = [
    1.0, -8048581381.0 / 2820520608.0, 8663915743.0 / 2820520608.0, -12715105075.0 / 11282082432.0,
    0.0, 0.0, 0.0, 0.0,
    0.0, 131558114200.0 / 32700410799.0, -68118460800.0 / 10900136933.0, 87487479700.0 / 32700410799.0,
    0.0, -1754552775.0 / 470086768.0, 14199869525.0 / 1410260304.0, -10690763975.0 / 1880347072.0,
    0.0, 127303824393.0 / 49829197408.0, -318862633887.0 / 49829197408.0, 701980252875.0 / 199316789632.0,
    0.0, -282668133.0 / 205662961.0, 2019193451.0 / 616988883.0, -1453857185.0 / 822651844.0,
    0.0, 40617522.0 / 29380423.0, -110615467.0 / 29380423.0, 69997945.0 / 29380423.0,
    0.0, 3.0, -2.0, 0.0,
];

impl RungeKutta for Rk45 {
    const ERROR_ORDER: i32 = 4;
    const LAST_IN_ERROR: bool = true;
    const CONTROL: Control = Control::ELEMENTARY;
    const STAGES: usize = 7;
    const DEGREE: usize = 4;
    // between the stages at 3/10 and 4/5
    const GAP: Gap = Gap { middle: 0.55, half: 0.25 };
    const TABLE: &'static [f64] = &P;

    fn control(&self) -> Cow<'_, StepControl> {
        Cow::Borrowed(&self.control)
    }

    fn advance<T: TrialStages>(
        trial: &mut T,
        k: &mut [Block],
        y_new: &mut [Block],
    ) -> Result<(), T::Stop> {
        let [k1, k2, k3, k4, k5, k6, k7] = rows_mut(k, trial.width());
        trial.stage(C[0], A2, [k1], k2)?;
        trial.stage(C[1], A3, [k1, k2], k3)?;
        trial.stage(C[2], A4, [k1, k2, k3], k4)?;
        trial.stage(C[3], A5, [k1, k2, k3, k4], k5)?;
        trial.stage(C[4], A6, [k1, k2, k3, k4, k5], k6)?;
        trial.end(1.0, B, [k1, k3, k4, k5, k6], y_new)?;
        trial.rate_at_end(y_new, k7)
    }

    fn error_squares<N: Squares>(k: &[Block], states: [&[Block]; 2], norm: &N) -> [N::Sum; 2] {
        let [k1, _, k3, k4, k5, k6, k7] = rows(k, states[0].len());
        let k = [k1, k3, k4, k5, k6, k7];
        let [sum] = norm.squares(states, |i| [sum_at(i, E, k)]);
        [sum, sum]
    }

    fn error_norm(h: f64, [sum, _]: [f64; 2], components: f64) -> f64 {
        h.abs() * (sum / components).sqrt()
    }
}
