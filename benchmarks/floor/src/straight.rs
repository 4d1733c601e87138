//! A plain program for one linkage: S = Φ_q M⁻¹ Φ_qᵀ with four 2 × 2 blocks on the diagonal and three
//! off-diagonal blocks, eliminated from A to D, with sine and cosine of the library.

use super::linkage::{
    torque, Equations, Gains, Solution, D, GRAVITY, HALF, INERTIA, MASS, N_ROWS, N_Y,
};
use super::plane::{Sym2, Vec2};

/// Block elimination from A to D.
pub struct Straight;

/// Bars with u, w, and the centres r, ṙ.
struct Bars {
    u: [Vec2; 3],
    w: [Vec2; 3],
    r: [Vec2; 3],
    v: [Vec2; 3],
    omega: [f64; 3],
}

fn bars(y: &[f64; N_Y]) -> Bars {
    let each = |k: usize| {
        let (s, c) = y[3 * k + 2].sin_cos();
        Vec2(HALF[k] * c, HALF[k] * s)
    };
    let u = [each(0), each(1), each(2)];
    Bars {
        u,
        w: u.map(Vec2::turned),
        r: [Vec2(y[0], y[1]), Vec2(y[3], y[4]), Vec2(y[6], y[7])],
        v: [Vec2(y[9], y[10]), Vec2(y[12], y[13]), Vec2(y[15], y[16])],
        omega: [y[11], y[14], y[17]],
    }
}

/// Φ_q M⁻¹ Q - γ̂ of the joints A, B, C, D.
#[inline(always)]
fn right_side(b: &Bars, turn: f64, gains: Gains) -> [Vec2; 4] {
    let Bars { u, w, r, v, omega } = b;
    let weight = Vec2(0.0, -GRAVITY);
    let phi = [r[0] - u[0], r[1] - u[1] - r[0] - u[0], r[2] - u[2] - r[1] - u[1], r[2] + u[2]];
    let phi = [phi[0], phi[1], phi[2], phi[3] - Vec2(D, 0.0)];
    let rim = [omega[0] * w[0], omega[1] * w[1], omega[2] * w[2]];
    let rate = [
        v[0] - rim[0],
        v[1] - rim[1] - v[0] - rim[0],
        v[2] - rim[2] - v[1] - rim[1],
        v[2] + rim[2],
    ];
    let inward = [0, 1, 2].map(|k| omega[k] * omega[k] * u[k]);
    let minus_gamma = [inward[0], inward[1] + inward[0], inward[2] + inward[1], -inward[2]];
    let loads = [weight, Vec2(0.0, 0.0), -turn * w[2], weight + turn * w[2]];
    [0, 1, 2, 3]
        .map(|k| loads[k] + minus_gamma[k] + gains.damping * rate[k] + gains.stiffness * phi[k])
}

/// λ by elimination of the block tridiagonal S.
#[inline(always)]
fn multipliers(w: &[Vec2; 3], mut b: [Vec2; 4]) -> [Vec2; 4] {
    let [m1, m2, m3] = [0, 1, 2].map(|k| 1.0 / MASS[k]);
    let [j1, j2, j3] = [0, 1, 2].map(|k| 1.0 / INERTIA[k]);
    let own = [Sym2::dyad(m1, j1, w[0]), Sym2::dyad(m2, j2, w[1]), Sym2::dyad(m3, j3, w[2])];
    let diagonal = [own[0], own[0] + own[1], own[1] + own[2], own[2]];
    let beside = [Sym2::dyad(-m1, j1, w[0]), Sym2::dyad(-m2, j2, w[1]), Sym2::dyad(m3, -j3, w[2])];
    let invert = |s: Sym2| s.adjugate().scaled(1.0 / s.det());
    let mut inverse = [invert(diagonal[0]); 4];
    for k in 0..3 {
        b[k + 1] = b[k + 1] - beside[k].times(inverse[k].times(b[k]));
        inverse[k + 1] = invert(diagonal[k + 1] - inverse[k].between(beside[k]));
    }
    let mut lam = [inverse[3].times(b[3]); 4];
    for k in (0..3).rev() {
        lam[k] = inverse[k].times(b[k] - beside[k].times(lam[k + 1]));
    }
    lam
}

impl Equations for Straight {
    #[inline(always)]
    fn solve(y: &[f64; N_Y], gains: Gains) -> Solution {
        let bars = bars(y);
        let turn = torque(y) / INERTIA[2];
        let lam = multipliers(&bars.w, right_side(&bars, turn, gains));
        motion(&bars.w, turn, lam)
    }
}

/// q̈ = M⁻¹ (Q - Φ_qᵀ λ), and λ in its storage order.
#[inline(always)]
pub(crate) fn motion(w: &[Vec2; 3], turn: f64, lam: [Vec2; 4]) -> Solution {
    let [a, b, c, d] = lam;
    let push = [b - a, c - b, -(c + d)];
    let twist = [
        w[0].dot(a + b) / INERTIA[0],
        w[1].dot(b + c) / INERTIA[1],
        w[2].dot(c - d) / INERTIA[2] + turn,
    ];
    let linear = [0, 1, 2].map(|k| (1.0 / MASS[k]) * push[k] + Vec2(0.0, -GRAVITY));
    let [p, q, r] = linear;
    let lam: [f64; N_ROWS] = [a.0, a.1, b.0, b.1, c.0, c.1, d.0, d.1];
    Solution { a: [p.0, p.1, twist[0], q.0, q.1, twist[1], r.0, r.1, twist[2]], lam }
}
