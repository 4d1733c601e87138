//! Piecewise smooth operations: conditions, |x|, steps, minima, motion laws, tables.
//!
//! Each has a switch function σ and boundaries on its axis. Between two boundaries lies a *piece*, on which the
//! operation is smooth. An integrator holds the piece of each switch during a step, so that all stages of the step
//! use the same piece, and ends the step where σ reaches a boundary.

use super::knots::Knots;
use super::motion_law::MotionLaw;
use super::operation::{Binary, Relation, Unary};
use crate::math::Real;
use std::sync::Arc;

/// An operation with a switch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Piecewise {
    /// One of two values; σ = left - right.
    Choose(Relation),
    /// |x|, the sign, the unit step, the floor or a motion law of x; σ = x.
    Unary(Unary),
    /// A rise from (t0, y0) to (t1, y1); σ = (t - t0) / (t1 - t0).
    Step5,
    /// The smaller or larger of a and b; σ = a - b.
    Binary(Binary),
}

impl Piecewise {
    /// The operation on one number, if it has a switch.
    pub fn unary(operation: Unary) -> Option<Self> {
        use Unary::{Abs, Floor, Motion, Sign, Step};
        let switches = matches!(operation, Abs | Floor | Sign | Step | Motion(_));
        switches.then_some(Self::Unary(operation))
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
            Self::Step5 => 5,
            Self::Binary(_) => 2,
        }
    }

    /// The number of leading operands on which σ depends.
    pub fn arguments(self) -> usize {
        match self {
            Self::Choose(_) => 1,
            Self::Step5 => 4,
            other => other.operands(),
        }
    }

    /// Whether the value is C² where the piece changes. The error estimate of a step then accounts for the change,
    /// but may miss a short pulse.
    pub fn is_smooth(self) -> bool {
        match self {
            Self::Unary(Unary::Motion(law)) => law != MotionLaw::Harmonic,
            Self::Step5 => true,
            _ => false,
        }
    }

    /// σ.
    pub fn function<S: Real>(self, operands: &[S]) -> S {
        match self {
            Self::Choose(_) | Self::Unary(_) => operands[0],
            Self::Binary(_) => operands[0] - operands[1],
            Self::Step5 => (operands[0] - operands[1]) / (operands[3] - operands[1]),
        }
    }

    /// The boundaries of its pieces.
    pub fn boundaries(self) -> Boundaries {
        match self {
            Self::Unary(Unary::Floor) => Boundaries::Integers,
            Self::Unary(Unary::Motion(_)) | Self::Step5 => {
                Boundaries::Knots(Arc::new(Knots::new(vec![0.0, 1.0], None)))
            }
            _ => Boundaries::Zero,
        }
    }

    /// The value, with the piece determined by the operands.
    pub fn value<S: Real>(self, x: &[S]) -> S {
        match self {
            Self::Choose(relation) => relation.choose(x[0], x[1], x[2]),
            Self::Unary(operation) => operation.apply(x[0]),
            Self::Binary(operation) => operation.apply(x[0], x[1]),
            Self::Step5 => {
                let rise = Unary::Motion(MotionLaw::Poly345).apply(self.function(x));
                x[2] + (x[4] - x[2]) * rise
            }
        }
    }

    /// The value on a piece, which extends smoothly beyond its boundaries.
    pub fn value_on<S: Real>(self, piece: f64, x: &[S]) -> S {
        match self {
            Self::Choose(relation) => relation.choose(S::constant(piece), x[1], x[2]),
            Self::Unary(Unary::Abs) => S::constant(piece) * x[0],
            Self::Unary(Unary::Motion(law)) if piece == 0.0 => law.rise(x[0]),
            Self::Unary(operation) => operation.apply(S::constant(piece)),
            Self::Step5 if piece == 0.0 => {
                x[2] + (x[4] - x[2]) * MotionLaw::Poly345.rise(self.function(x))
            }
            Self::Step5 => x[if piece < 0.0 { 2 } else { 4 }],
            Self::Binary(operation) => {
                let first = (operation == Binary::Max) == (piece > 0.0);
                x[usize::from(!first)]
            }
        }
    }
}

/// The boundaries of the pieces of a switch, on the axis of its function σ.
#[derive(Clone, Debug, PartialEq)]
pub enum Boundaries {
    /// σ = 0; the pieces are -1 and +1.
    Zero,
    /// Every integer n; piece n is n < σ < n + 1.
    Integers,
    /// Knots; piece n lies between the knots n and n + 1.
    Knots(Arc<Knots>),
}

impl Boundaries {
    /// The piece that contains σ. NaN on a boundary, because a boundary belongs to no piece.
    pub fn piece(&self, sigma: f64) -> f64 {
        match self {
            Self::Zero if sigma > 0.0 => 1.0,
            Self::Zero if sigma < 0.0 => -1.0,
            Self::Integers if sigma != sigma.floor() => sigma.floor(),
            Self::Knots(knots) if !sigma.is_nan() => {
                let n = knots.last(sigma);
                if knots.at(n) == sigma {
                    f64::NAN
                } else {
                    n
                }
            }
            _ => f64::NAN,
        }
    }

    /// The piece above or below a boundary.
    pub fn beside(&self, boundary: f64, above: bool) -> f64 {
        let below = if above { 0.0 } else { 1.0 };
        match self {
            Self::Zero => 1.0 - 2.0 * below,
            Self::Integers => boundary - below,
            Self::Knots(knots) => knots.nearest(boundary) - below,
        }
    }

    /// The boundaries below and above a piece; infinite where there is none.
    pub fn of(&self, piece: f64) -> [f64; 2] {
        match self {
            Self::Zero if piece > 0.0 => [0.0, f64::INFINITY],
            Self::Zero => [f64::NEG_INFINITY, 0.0],
            Self::Integers => [piece, piece + 1.0],
            Self::Knots(knots) => [knots.at(piece), knots.at(piece + 1.0)],
        }
    }

    /// The distance of σ from the boundaries of a piece, positive within the piece. NaN if no piece is held.
    pub fn margin(&self, sigma: f64, piece: f64) -> f64 {
        if piece.is_nan() {
            return f64::NAN;
        }
        let [low, high] = self.of(piece);
        (sigma - low).min(high - sigma)
    }

    /// The piece that σ enters when it leaves a piece.
    pub fn next(&self, sigma: f64, piece: f64) -> f64 {
        let [low, high] = self.of(piece);
        let above = sigma - low >= high - sigma;
        self.beside(if above { high } else { low }, above)
    }

    /// The boundaries from `low` to `high`: the number of the first boundary, and their count.
    pub(super) fn between(&self, low: f64, high: f64) -> (f64, f64) {
        let [first, last] = match self {
            Self::Zero if low <= 0.0 && high >= 0.0 => [0.0, 0.0],
            Self::Zero => [0.0, -1.0],
            Self::Integers => [low.ceil(), high.floor()],
            Self::Knots(knots) => {
                let n = knots.last(low);
                [if knots.at(n) == low { n } else { n + 1.0 }, knots.last(high)]
            }
        };
        (first, (last - first + 1.0).max(0.0))
    }

    /// The boundary with number `n`.
    pub(super) fn at(&self, n: f64) -> f64 {
        match self {
            Self::Zero => 0.0,
            Self::Integers => n,
            Self::Knots(knots) => knots.at(n),
        }
    }
}
