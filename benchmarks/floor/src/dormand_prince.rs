//! Dormand–Prince 5(4) with the step control of kempe and of `scipy.integrate.RK45`, for 18 numbers.
//!
//! Pair: Dormand and Prince, J. Comput. Appl. Math. 6 (1980) 19; extension: Shampine, Math. Comp. 46
//! (1986) 135; control: Hairer, Nørsett and Wanner, *Solving Ordinary Differential Equations I*, II.4.

use super::linkage::{Equations, BAUMGARTE, N_Q, N_Y};
use super::recorded::Recorded;

type Y = [f64; N_Y];

/// Cost of a run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Effort {
    /// Accepted steps.
    pub steps: usize,
    /// Rejected steps.
    pub rejected: usize,
    /// Evaluations, without those of the output.
    pub evaluations: usize,
}

const A2: [f64; 1] = [1.0 / 5.0];
const A3: [f64; 2] = [3.0 / 40.0, 9.0 / 40.0];
const A4: [f64; 3] = [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0];
const A5: [f64; 4] = [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0];
const A6: [f64; 5] =
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0];
const B: [f64; 5] = [35.0 / 384.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0];
const E: [f64; 6] = [
    -71.0 / 57600.0,
    71.0 / 16695.0,
    -71.0 / 1920.0,
    17253.0 / 339200.0,
    -22.0 / 525.0,
    1.0 / 40.0,
];
/// Weights of θ … θ⁴ for the stages 1, 3, 4, 5, 6, 7.
const P: [[f64; 4]; 6] = [
    [
        1.0,
        -8048581381.0 / 2820520608.0,
        8663915743.0 / 2820520608.0,
        -12715105075.0 / 11282082432.0,
    ],
    [
        0.0,
        131558114200.0 / 32700410799.0,
        -68118460800.0 / 10900136933.0,
        87487479700.0 / 32700410799.0,
    ],
    [0.0, -1754552775.0 / 470086768.0, 14199869525.0 / 1410260304.0, -10690763975.0 / 1880347072.0],
    [
        0.0,
        127303824393.0 / 49829197408.0,
        -318862633887.0 / 49829197408.0,
        701980252875.0 / 199316789632.0,
    ],
    [0.0, -282668133.0 / 205662961.0, 2019193451.0 / 616988883.0, -1453857185.0 / 822651844.0],
    [0.0, 40617522.0 / 29380423.0, -110615467.0 / 29380423.0, 69997945.0 / 29380423.0],
];

/// y + h Σ aₛ kₛ.
#[inline(always)]
fn combine<const S: usize>(y: &Y, h: f64, a: [f64; S], k: [&Y; S]) -> Y {
    let weights = a.map(|a| h * a);
    let mut out = *y;
    for i in 0..N_Y {
        for s in 0..S {
            out[i] += weights[s] * k[s][i];
        }
    }
    out
}

/// dy/dt.
#[inline(always)]
fn rate<Q: Equations>(y: &Y) -> Y {
    let a = Q::solve(y, BAUMGARTE).a;
    let mut dy = [0.0; N_Y];
    dy[..N_Q].copy_from_slice(&y[N_Q..]);
    dy[N_Q..].copy_from_slice(&a);
    dy
}

/// The stages of one step; the last is the derivative at its end.
struct Stages {
    k: [Y; 7],
    y_new: Y,
}

#[inline(always)]
fn advance<Q: Equations>(y: &Y, h: f64, stages: &mut Stages) {
    let k = &mut stages.k;
    k[1] = rate::<Q>(&combine(y, h, A2, [&k[0]]));
    k[2] = rate::<Q>(&combine(y, h, A3, [&k[0], &k[1]]));
    k[3] = rate::<Q>(&combine(y, h, A4, [&k[0], &k[1], &k[2]]));
    k[4] = rate::<Q>(&combine(y, h, A5, [&k[0], &k[1], &k[2], &k[3]]));
    k[5] = rate::<Q>(&combine(y, h, A6, [&k[0], &k[1], &k[2], &k[3], &k[4]]));
    stages.y_new = combine(y, h, B, [&k[0], &k[2], &k[3], &k[4], &k[5]]);
    k[6] = rate::<Q>(&stages.y_new);
}

#[inline(always)]
fn error_norm(y: &Y, h: f64, Stages { k, y_new }: &Stages, (rtol, atol): (f64, f64)) -> f64 {
    let mut terms = [0.0; N_Y];
    for i in 0..N_Y {
        let slope = E[0] * k[0][i]
            + E[1] * k[2][i]
            + E[2] * k[3][i]
            + E[3] * k[4][i]
            + E[4] * k[5][i]
            + E[5] * k[6][i];
        let scaled = h * slope / (atol + rtol * y[i].abs().max(y_new[i].abs()));
        terms[i] = scaled * scaled;
    }
    (terms.iter().sum::<f64>() / N_Y as f64).sqrt()
}

fn scaled_norm(x: &Y, y: &Y, (rtol, atol): (f64, f64)) -> f64 {
    let terms = x.iter().zip(y).map(|(x, y)| (x / (atol + rtol * y.abs())).powi(2));
    (terms.sum::<f64>() / N_Y as f64).sqrt()
}

/// Hairer's first step.
fn first_step<Q: Equations>(y: &Y, f0: &Y, t_end: f64, tolerances: (f64, f64)) -> f64 {
    let norm = |x: &Y| scaled_norm(x, y, tolerances);
    let (d0, d1) = (norm(y), norm(f0));
    let h0 = if d0 < 1e-5 || d1 < 1e-5 { 1e-6 } else { 0.01 * d0 / d1 };
    let f1 = rate::<Q>(&combine(y, h0, [1.0], [f0]));
    let d2 = norm(&std::array::from_fn(|i| f1[i] - f0[i])) / h0;
    let h1 = if d1 <= 1e-15 && d2 <= 1e-15 {
        (h0 * 1e-3).max(1e-6)
    } else {
        (0.01 / d1.max(d2)).powf(0.2)
    };
    (100.0 * h0).min(h1).min(t_end)
}

/// Stores the grid states between `t` and `t_new`.
#[inline(always)]
fn keep<Q: Equations>(
    kept: &mut Recorded,
    (t, t_new, t_end, grid): (f64, f64, f64, f64),
    y: &Y,
    Stages { k, .. }: &Stages,
) {
    let h = t_new - t;
    loop {
        let mut at = kept.t.len() as f64 * grid;
        if (at - t_end).abs() <= 1e-9 * grid {
            at = t_end;
        }
        if at > t_new {
            return;
        }
        let theta = (at - t) / h;
        let weights = P.map(|p| theta * (p[0] + theta * (p[1] + theta * (p[2] + theta * p[3]))));
        let k = [&k[0], &k[2], &k[3], &k[4], &k[5], &k[6]];
        kept.keep::<Q>(at, &combine(y, h, weights, k));
    }
}

/// Integrates from y at t = 0 and stores a state every `grid` seconds.
pub fn integrate<Q: Equations>(
    start: &Y,
    t_end: f64,
    grid: f64,
    tolerances: (f64, f64),
) -> (Recorded, Effort) {
    let mut kept = Recorded::with_capacity((t_end / grid) as usize + 2);
    let mut effort = Effort { evaluations: 2, ..Effort::default() };
    let mut y = *start;
    kept.keep::<Q>(0.0, &y);
    let mut stages = Stages { k: [rate::<Q>(&y); 7], y_new: y };
    let (mut t, mut size) = (0.0, first_step::<Q>(&y, &stages.k[0], t_end, tolerances));
    let mut rejected = false;
    while t < t_end {
        let t_new = f64::min(t + size, t_end);
        let h = t_new - t;
        advance::<Q>(&y, h, &mut stages);
        effort.evaluations += 6;
        let norm = error_norm(&y, h, &stages, tolerances);
        let wanted = if norm == 0.0 { 10.0 } else { 0.9 * norm.powf(-0.2) };
        if norm < 1.0 {
            size = h * wanted.min(if rejected { 1.0 } else { 10.0 });
            keep::<Q>(&mut kept, (t, t_new, t_end, grid), &y, &stages);
            (t, y, stages.k[0]) = (t_new, stages.y_new, stages.k[6]);
            effort.steps += 1;
            rejected = false;
        } else {
            // a norm that is not a number gives the largest reduction
            size = h * wanted.max(0.2);
            effort.rejected += 1;
            rejected = true;
        }
        assert!(size > 1e-14, "the step has become too small at {t} s");
    }
    (kept, effort)
}
