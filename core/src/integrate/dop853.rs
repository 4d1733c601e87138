//! DOP853: explicit adaptive method of order 8 with error estimators of orders 5 and 3, and a continuous extension of
//! order 7.
//!
//! The coefficients of Dormand and Prince are those of Hairer, Nørsett and Wanner, *Solving Ordinary Differential
//! Equations I*, II.5 and II.6. The error estimate is h e₅² / √(e₅² + 0.01 e₃²). It has order 7 and remains reliable
//! where e₅ happens to vanish (II.10). All this is as in `scipy.integrate.DOP853`. The step control is that of II.4,
//! but with a safety factor of 0.8 instead of 0.9, and a step grows only if it is too short by more than 10 %. On 46
//! mechanisms this saves 4 % of the evaluations for the same error (`docs/performance.md`).
//!
//! The extension needs three more stages than the step. For a system of second order it needs one evaluation
//! (`hermite_birkhoff`). They are evaluated only if an observer needs states between the ends of a step; otherwise
//! the interpolant is the cubic Hermite polynomial. The derivative at the end is evaluated only for accepted steps,
//! since the error estimate does not use it. This saves one evaluation over scipy for each rejected step.

use super::dop853_coefficients::*;
use super::runge_kutta::{RungeKutta, TrialStages};
use super::stages::{rows, rows_mut, sum_at, Block};
use super::step_control::StepControl;
use super::step_placement::Gap;
use super::step_size::Control;
use super::tolerances::Squares;
use std::borrow::Cow;

/// DOP853 with its options.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dop853 {
    /// Tolerances and steps.
    pub control: StepControl,
}

impl Dop853 {
    /// The method with these tolerances and no bounds on steps.
    pub fn new(rtol: f64, atol: f64) -> Self {
        Self { control: StepControl::new(rtol, atol) }
    }
}

/// Number of stages of a step, including the derivative at its end.
const STAGES: usize = 13;
/// Number of stages of the step and its extension.
const ALL: usize = STAGES + C_EXTRA.len();
const DEGREE: usize = 7;

/// Coefficients of θ … θ⁷ for each stage and for the jump of a projection.
const TABLE: [f64; (ALL + 1) * DEGREE] = table(true);
/// The first three of the seven terms of the interpolant: the cubic Hermite polynomial.
const HERMITE: [f64; (ALL + 1) * DEGREE] = table(false);

/// The basis polynomials of the extension, θ, θ (1-θ), θ² (1-θ), θ² (1-θ)² …, in powers of θ.
#[rustfmt::skip]
const PARTS: [[f64; DEGREE]; 7] = [
    [1.0,  0.0,  0.0,  0.0,  0.0,  0.0,  0.0],
    [1.0, -1.0,  0.0,  0.0,  0.0,  0.0,  0.0],
    [0.0,  1.0, -1.0,  0.0,  0.0,  0.0,  0.0],
    [0.0,  1.0, -2.0,  1.0,  0.0,  0.0,  0.0],
    [0.0,  0.0,  1.0, -2.0,  1.0,  0.0,  0.0],
    [0.0,  0.0,  1.0, -3.0,  3.0, -1.0,  0.0],
    [0.0,  0.0,  0.0,  1.0, -3.0,  3.0, -1.0],
];

/// The factors of the basis polynomials, divided by h: Δ = Σ b k, k₁ - Δ, 2Δ - k₁ - k₁₃, and the four rows of [`D`].
const fn table(whole: bool) -> [f64; (ALL + 1) * DEGREE] {
    let mut out = [0.0; (ALL + 1) * DEGREE];
    let mut stage = 0;
    while stage < ALL {
        let first = if stage == 0 { 1.0 } else { 0.0 };
        let last = if stage == STAGES - 1 { 1.0 } else { 0.0 };
        let b = weight(&B, stage);
        let mut factors = [b, first - b, 2.0 * b - first - last, 0.0, 0.0, 0.0, 0.0];
        let mut part = 0;
        while whole && part < 4 {
            factors[3 + part] = weight(&D[part], stage);
            part += 1;
        }
        let mut at = 0;
        while at < 7 * DEGREE {
            let (part, power) = (at / DEGREE, at % DEGREE);
            out[stage * DEGREE + power] += factors[part] * PARTS[part][power];
            at += 1;
        }
        stage += 1;
    }
    out[ALL * DEGREE + 1] = 3.0;
    out[ALL * DEGREE + 2] = -2.0;
    out
}

/// The coefficient of a stage, counted from 0, in a row with the coefficients of k₁, k₆, k₇, ….
const fn weight(row: &[f64], stage: usize) -> f64 {
    match stage {
        0 => row[0],
        1..=4 => 0.0,
        _ if stage - 4 < row.len() => row[stage - 4],
        _ => 0.0,
    }
}

impl RungeKutta for Dop853 {
    const ERROR_ORDER: i32 = 7;
    const LAST_IN_ERROR: bool = false;
    const CONTROL: Control = Control { safety: 0.8, hold: 1.1 };
    const STAGES: usize = STAGES;
    const EXTRA: usize = C_EXTRA.len();
    const DEGREE: usize = DEGREE;
    // between the stages at 1/3 and 3/5
    const GAP: Gap = Gap { middle: 7.0 / 15.0, half: 2.0 / 15.0 };
    const TABLE: &'static [f64] = &TABLE;
    const DOUBLE_QUADRATURE: &'static [f64] = &DOUBLE_QUADRATURE;
    const WITHOUT_EXTRA: &'static [f64] = &HERMITE;

    fn control(&self) -> Cow<'_, StepControl> {
        Cow::Borrowed(&self.control)
    }

    fn advance<T: TrialStages>(
        trial: &mut T,
        k: &mut [Block],
        y_new: &mut [Block],
    ) -> Result<(), T::Stop> {
        let [k1, k2, k3, k4, k5, k6, k7, k8, k9, k10, k11, k12] = rows_mut(k, trial.width());
        trial.stage(C[0], A2, [k1], k2)?;
        trial.stage(C[1], A3, [k1, k2], k3)?;
        trial.stage(C[2], A4, [k1, k3], k4)?;
        trial.stage(C[3], A5, [k1, k3, k4], k5)?;
        trial.stage(C[4], A6, [k1, k4, k5], k6)?;
        trial.stage(C[5], A7, [k1, k4, k5, k6], k7)?;
        trial.stage(C[6], A8, [k1, k4, k5, k6, k7], k8)?;
        trial.stage(C[7], A9, [k1, k4, k5, k6, k7, k8], k9)?;
        trial.stage(C[8], A10, [k1, k4, k5, k6, k7, k8, k9], k10)?;
        trial.stage(C[9], A11, [k1, k4, k5, k6, k7, k8, k9, k10], k11)?;
        trial.stage(C[10], A12, [k1, k4, k5, k6, k7, k8, k9, k10, k11], k12)?;
        trial.end(1.0, B, [k1, k6, k7, k8, k9, k10, k11, k12], y_new)
    }

    fn extend<T: TrialStages>(trial: &mut T, k: &mut [Block]) -> Result<(), T::Stop> {
        let rows = rows_mut(k, trial.width());
        let [k1, _, _, _, _, k6, k7, k8, k9, k10, k11, k12, k13, k14, k15, k16] = rows;
        trial.stage(C_EXTRA[0], A14, [k1, k7, k8, k9, k10, k11, k12, k13], k14)?;
        trial.stage(C_EXTRA[1], A15, [k1, k6, k7, k8, k11, k12, k13, k14], k15)?;
        trial.stage(C_EXTRA[2], A16, [k1, k6, k7, k8, k9, k13, k14, k15], k16)?;
        trial.finite(k16)
    }

    fn error_squares<N: Squares>(k: &[Block], states: [&[Block]; 2], norm: &N) -> [N::Sum; 2] {
        let [k1, _, _, _, _, k6, k7, k8, k9, k10, k11, k12] = rows(k, states[0].len());
        let k = [k1, k6, k7, k8, k9, k10, k11, k12];
        norm.squares(states, |i| [sum_at(i, E5, k), sum_at(i, E3, k)])
    }

    fn error_norm(h: f64, [fifth, third]: [f64; 2], components: f64) -> f64 {
        if fifth == 0.0 && third == 0.0 {
            return 0.0;
        }
        h.abs() * fifth / ((fifth + 0.01 * third) * components).sqrt()
    }
}
