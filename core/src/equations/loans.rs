//! Loans of inertia to light bodies, with which M can be inverted block by block without loss of digits.
//!
//! If a joint makes points of two bodies coincide, Φ_L a_L + Φ_H a_H = γ, a point mass w at these points may belong
//! to either body:
//!
//! ```text
//! [ M_L + w Φ_Lᵀ Φ_L                       Φ_Lᵀ ] [ a_L ]   [ Q_L            ]
//! [                   M_H - w Φ_Hᵀ Φ_H     Φ_Hᵀ ] [ a_H ] = [ Q_H - w Φ_Hᵀ γ ],   λ = λ′ + w Φ_L a_L
//! [ Φ_L               Φ_H                   0   ] [ λ′  ]   [ γ              ]
//! ```
//!
//! This is exact for every w, and M remains block diagonal. In the same way, a joint that fixes the relative angle of
//! two bodies can lend a moment of inertia. `equations/lending.rs` chooses the loans of a model.

use crate::math::Real;
use crate::model::Columns;
use std::ops::Range;

/// Inertia that one body lends to another at their common joint.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Loan {
    /// Index of the joint among the constraints.
    pub constraint: usize,
    /// The rows: two for a point, or one for an angle.
    pub rows: Range<usize>,
    /// w, kg or kg·m².
    pub weight: f64,
    /// The light body.
    pub borrower: End,
    /// The other body; None for ground.
    pub lender: Option<End>,
}

/// Mass or moment of inertia added at one coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Addition {
    /// Index of the coordinate.
    pub column: usize,
    /// κ, kg or kg·m².
    pub weight: f64,
}

/// One of the two bodies of a loan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct End {
    /// Index of the body.
    pub body: usize,
    /// The coordinates of the body.
    pub columns: Columns,
    /// The first of the rows, as an index into the rows of three entries of Φ_q.
    pub entry: usize,
}

/// Subtracts w Φ_Hᵀ γ of all loans from the generalized forces `f`.
#[inline]
pub(super) fn take<S: Real>(loans: &[Loan], entries: &[[S; 3]], gamma: &[S], f: &mut [S]) {
    for Loan { rows, weight, lender, .. } in loans {
        let Some(lender) = lender else { continue };
        for (row, gamma) in entries[lender.entry..].iter().zip(&gamma[rows.clone()]) {
            let scaled = S::constant(-*weight) * *gamma;
            lender.columns.add(row.map(|entry| entry * scaled), f);
        }
    }
}

/// Adds w Φ_L a_L of all loans to the multipliers.
#[inline]
pub(super) fn give_back<S: Real>(loans: &[Loan], entries: &[[S; 3]], a: &[S], lam: &mut [S]) {
    for Loan { rows, weight, borrower, .. } in loans {
        let moved = borrower.columns.of(a);
        for (row, lam) in entries[borrower.entry..].iter().zip(&mut lam[rows.clone()]) {
            let along = (row[0] * moved[0]).plus_product(row[1], moved[1]);
            *lam = lam.plus_product(S::constant(*weight), along.plus_product(row[2], moved[2]));
        }
    }
}
