//! The fastest known program for the equations: the pinned bars are eliminated in closed form.
//!
//! With t and n the unit vectors along and across a bar, its mobility S = Φ_q M⁻¹ Φ_qᵀ at its ends is
//! (t tᵀ + 4 n nᵀ)/m at one end and (∓t tᵀ ± 2 n nᵀ)/m between the ends. Eigenvectors and eigenvalues are
//! known, so A and D need no division. A 4 × 4 system for B and C remains, with two divisions.

use super::angles::cosines_and_sines;
use super::linkage::{torque, Equations, Gains, Solution, D, GRAVITY, HALF, INERTIA, MASS, N_Y};
use super::plane::{Sym2, Vec2};
use super::straight::motion;

/// Closed forms for the pinned bars, then two blocks.
pub struct Chain;

const WEIGHT: Vec2 = Vec2(0.0, -GRAVITY);

impl Equations for Chain {
    #[inline(always)]
    fn solve(y: &[f64; N_Y], gains: Gains) -> Solution {
        let (c, s) = cosines_and_sines([y[2], y[5], y[8]]);
        let t = [Vec2(c[0], s[0]), Vec2(c[1], s[1]), Vec2(c[2], s[2])];
        let n = t.map(Vec2::turned);
        let turn = torque(y) / INERTIA[2];
        // contributions of body k to -γ̂: of its centre, and of its ends
        let centre = |k: usize| {
            let (r, v) = (Vec2(y[3 * k], y[3 * k + 1]), Vec2(y[3 * k + 9], y[3 * k + 10]));
            gains.stiffness * r + gains.damping * v
        };
        let end = |k: usize, turn: f64| {
            let omega = y[3 * k + 11];
            let along = HALF[k] * (omega * omega - gains.stiffness);
            let across = -HALF[k] * (gains.damping * omega + turn);
            along * t[k] + across * n[k]
        };
        let (first, coupler, last) = (end(0, 0.0), end(1, 0.0), end(2, turn));
        let (e1, e2) = (centre(0), centre(1));
        let a = WEIGHT + e1 + first;
        let d = WEIGHT + centre(2) - last - Vec2(gains.stiffness * D, 0.0);
        let (a_across, d_across) = (n[0].dot(a), n[2].dot(d));
        let b = a - e1 + e2 + first + coupler - (1.5 * a_across) * n[0];
        let c = last - WEIGHT - e2
            + coupler
            + last
            + Vec2(gains.stiffness * D, 0.0)
            + (1.5 * d_across) * n[2];
        let (lam_b, lam_c) = at_the_coupler(&n, b, c);
        let lam_a =
            MASS[0] * (a - (0.75 * a_across) * n[0]) + lam_b - (1.5 * n[0].dot(lam_b)) * n[0];
        let lam_d =
            MASS[2] * (d - (0.75 * d_across) * n[2]) - lam_c + (1.5 * n[2].dot(lam_c)) * n[2];
        let w = [HALF[0] * n[0], HALF[1] * n[1], HALF[2] * n[2]];
        motion(&w, turn, [lam_a, lam_b, lam_c, lam_d])
    }
}

/// λ of B and C; crank and rocker contribute (3/m) n nᵀ each after their elimination.
#[inline(always)]
fn at_the_coupler(n: &[Vec2; 3], b: Vec2, c: Vec2) -> (Vec2, Vec2) {
    const M: f64 = 1.0 / MASS[1];
    let own = Sym2::dyad(M, 3.0 * M, n[1]);
    let beside = Sym2::dyad(-M, 3.0 * M, n[1]);
    let at_b = own + Sym2::dyad(0.0, 3.0 / MASS[0], n[0]);
    let at_c = own + Sym2::dyad(0.0, 3.0 / MASS[2], n[2]);
    // the block of C multiplied by det, so that the two divisions are independent
    let (adjugate, det) = (at_b.adjugate(), at_b.det());
    let left = at_c.scaled(det) - adjugate.between(beside);
    let right = det * c - beside.times(adjugate.times(b));
    let lam_c = (1.0 / left.det()) * left.adjugate().times(right);
    let lam_b = (1.0 / det) * adjugate.times(b - beside.times(lam_c));
    (lam_b, lam_c)
}
