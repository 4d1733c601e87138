//! Operations whose value is smooth only piece by piece: conditions, |x|, steps, minima.
//!
//! Each has a switch function σ and boundaries on its axis. Between two boundaries lies a *piece*, on which the operation
//! is smooth. An integrator holds the piece of each switch during a step, so that no stage of the step sees another
//! piece, and ends the step where σ reaches a boundary.

use super::operation::{Binary, Relation, Unary};
use crate::math::Real;

/// An operation with a switch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Piecewise {
    /// One of two values; σ = left - right.
    Choose(Relation),
    /// |x|, the sign, the unit step or the floor of x; σ = x.
    Unary(Unary),
    /// The smaller or larger of a and b; σ = a - b.
    Binary(Binary),
}

impl Piecewise {
    /// The operation on one number, if it has a switch.
    pub fn unary(operation: Unary) -> Option<Self> {
        use Unary::{Abs, Floor, Sign, Step};
        matches!(operation, Abs | Floor | Sign | Step).then_some(Self::Unary(operation))
    }

    /// The operation on two numbers, if it has a switch.
    pub fn binary(operation: Binary) -> Option<Self> {
        matches!(operation, Binary::Min | Binary::Max).then_some(Self::Binary(operation))
    }

    /// Its number of operands.
    pub fn operands(self) -> usize {
        match self {
            Self::Choose(_) => 3,
            Self::Unary(_) => 1,
            Self::Binary(_) => 2,
        }
    }

    /// The number of operands on which σ depends, the first ones.
    pub fn arguments(self) -> usize {
        match self {
            Self::Choose(_) => 1,
            other => other.operands(),
        }
    }

    /// σ.
    pub fn function<S: Real>(self, operands: &[S]) -> S {
        match self {
            Self::Choose(_) | Self::Unary(_) => operands[0],
            Self::Binary(_) => operands[0] - operands[1],
        }
    }

    /// The boundaries of its pieces.
    pub fn boundaries(self) -> Boundaries {
        match self {
            Self::Unary(Unary::Floor) => Boundaries::Integers,
            _ => Boundaries::Zero,
        }
    }

    /// The value by the operands alone.
    pub fn value<S: Real>(self, x: &[S]) -> S {
        match self {
            Self::Choose(relation) => relation.choose(x[0], x[1], x[2]),
            Self::Unary(operation) => operation.apply(x[0]),
            Self::Binary(operation) => operation.apply(x[0], x[1]),
        }
    }

    /// The value on a piece, which extends smoothly beyond its boundaries.
    pub fn value_on<S: Real>(self, piece: f64, x: &[S]) -> S {
        match self {
            Self::Choose(relation) => relation.choose(S::constant(piece), x[1], x[2]),
            Self::Unary(Unary::Abs) => S::constant(piece) * x[0],
            Self::Unary(operation) => operation.apply(S::constant(piece)),
            Self::Binary(operation) => {
                let first = (operation == Binary::Max) == (piece > 0.0);
                x[usize::from(!first)]
            }
        }
    }
}

/// The boundaries of the pieces of a switch, on the axis of its function σ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Boundaries {
    /// σ = 0; the pieces are -1 and +1.
    Zero,
    /// Every integer n; piece n is n < σ < n + 1.
    Integers,
}

impl Boundaries {
    /// The piece that contains σ; NaN on a boundary, which belongs to no piece.
    pub fn piece(self, sigma: f64) -> f64 {
        match self {
            Self::Zero if sigma > 0.0 => 1.0,
            Self::Zero if sigma < 0.0 => -1.0,
            Self::Integers if sigma != sigma.floor() => sigma.floor(),
            _ => f64::NAN,
        }
    }

    /// The piece on one side of a boundary: above it, or below it.
    pub fn beside(self, boundary: f64, above: bool) -> f64 {
        match (self, above) {
            (Self::Zero, true) => 1.0,
            (Self::Zero, false) => -1.0,
            (Self::Integers, true) => boundary,
            (Self::Integers, false) => boundary - 1.0,
        }
    }

    /// The boundaries below and above a piece; infinite where there is none.
    pub fn of(self, piece: f64) -> [f64; 2] {
        match self {
            Self::Zero if piece > 0.0 => [0.0, f64::INFINITY],
            Self::Zero => [f64::NEG_INFINITY, 0.0],
            Self::Integers => [piece, piece + 1.0],
        }
    }

    /// The distance of σ from the boundaries of a piece, positive within the piece. NaN if no piece is held.
    pub fn margin(self, sigma: f64, piece: f64) -> f64 {
        let [low, high] = self.of(piece);
        match piece.is_nan() {
            true => f64::NAN,
            false => (sigma - low).min(high - sigma),
        }
    }

    /// The piece that σ enters when it leaves a piece.
    pub fn next(self, sigma: f64, piece: f64) -> f64 {
        let [low, high] = self.of(piece);
        if sigma - low < high - sigma {
            self.beside(low, false)
        } else {
            self.beside(high, true)
        }
    }

    /// The boundaries from `low` to `high`: the first one and their number.
    pub(super) fn between(self, low: f64, high: f64) -> (f64, f64) {
        match self {
            Self::Zero => (0.0, if low <= 0.0 && high >= 0.0 { 1.0 } else { 0.0 }),
            Self::Integers => (low.ceil(), (high.floor() - low.ceil() + 1.0).max(0.0)),
        }
    }
}
