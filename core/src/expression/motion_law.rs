//! Motion laws of cams: they rise from 0 at s = 0 to 1 at s = 1 and are constant outside this interval.
//!
//! The laws follow R. L. Norton, Cam Design and Manufacturing Handbook (2nd edition 2009, chapters 2 and 3), with the
//! rise 1 over the interval 1. The end points belong to the rise, so that the derivatives there are those of the
//! rise. All are symmetric: y(1 - s) = 1 - y(s). All are C² except at the ends of `harmonic`, where the acceleration
//! jumps.

use crate::math::Real;
use std::f64::consts::PI;

/// A motion law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MotionLaw {
    /// The acceleration is one period of a sine.
    Cycloidal,
    /// The acceleration is half a period of a cosine, with jumps at both ends.
    Harmonic,
    /// The polynomial of degree 5 without velocity and acceleration at the ends.
    Poly345,
    /// The polynomial of degree 7 without velocity, acceleration and jerk at the ends.
    Poly4567,
    /// The acceleration is a fast sine up to s = 1/8, a slow sine up to 7/8, and a fast sine up to 1.
    ModifiedSine,
    /// The acceleration consists of a quarter of a sine, a constant, half a sine, a constant, and a quarter of a
    /// sine.
    ModifiedTrapezoid,
}

impl MotionLaw {
    /// The value at s.
    pub fn apply<S: Real>(self, s: S) -> S {
        // 0 before the rise, 1 after it; NaN is preserved
        let behind = S::select(s - c(1.0), c(1.0), self.rise(s));
        S::select(-s, S::zero(), behind)
    }

    /// The rise, which extends smoothly beyond its ends.
    pub fn rise<S: Real>(self, s: S) -> S {
        match self {
            Self::Cycloidal => s - (c::<S>(2.0 * PI) * s).sin() / c(2.0 * PI),
            Self::Harmonic => c::<S>(0.5) - c::<S>(0.5) * (c::<S>(PI) * s).cos(),
            Self::Poly345 => s.powc(3.0) * (c::<S>(10.0) + s * (c::<S>(6.0) * s - c(15.0))),
            Self::Poly4567 => {
                let inner = c::<S>(70.0) * s - c::<S>(20.0) * s * s - c(84.0);
                s.powc(4.0) * (c::<S>(35.0) + s * inner)
            }
            Self::ModifiedSine => modified_sine(s),
            Self::ModifiedTrapezoid => modified_trapezoid(s),
        }
    }
}

fn c<S: Real>(x: f64) -> S {
    S::constant(x)
}

/// The value of the last piece that begins before s.
fn pieces<S: Real, const N: usize>(s: S, first: S, later: [(f64, S); N]) -> S {
    later.into_iter().fold(first, |value, (start, piece)| S::select(s - c(start), piece, value))
}

/// y″ = A sin 4πs, A sin(4πs/3 + π/3), A sin 4πs with A = 4π²/(4 + π), which follows from y(1) = 1. The greatest
/// velocity is 4π/(4 + π).
fn modified_sine<S: Real>(s: S) -> S {
    let quick = |s: S| (c::<S>(PI) * s - (c::<S>(4.0 * PI) * s).sin() / c(4.0)) / c(4.0 + PI);
    let h = s - c(0.5);
    let slow = c::<S>(PI) * h + c::<S>(2.25) * (c::<S>(4.0 / 3.0 * PI) * h).sin();
    let middle = c::<S>(0.5) + slow / c(4.0 + PI);
    pieces(s, quick(s), [(0.125, middle), (0.875, c::<S>(1.0) - quick(c::<S>(1.0) - s))])
}

/// y″ = A sin 4πs up to s = 1/8, A up to 3/8, -A sin(4π(s - 1/2)) up to 5/8, and the opposite of the mirror image, with
/// A = 8π/(2 + π), which follows from y(1) = 1. The greatest velocity is 2.
fn modified_trapezoid<S: Real>(s: S) -> S {
    let total = 2.0 + PI;
    let sine = |s: S| (c::<S>(4.0 * PI) * s).sin() / c(2.0 * PI);
    let growing = |s: S| (c::<S>(2.0) * s - sine(s)) / c(total);
    let constant = |s: S| {
        let d = s - c(0.125);
        (c::<S>(2.0) * s + c::<S>(4.0 * PI) * d * d - c(0.5 / PI)) / c(total)
    };
    let mirror = c::<S>(1.0) - s;
    let h = s - c(0.5);
    let middle = c::<S>(0.5) + (c::<S>(2.0 + 2.0 * PI) * h + sine(h)) / c(total);
    let later = [
        (0.125, constant(s)),
        (0.375, middle),
        (0.625, c::<S>(1.0) - constant(mirror)),
        (0.875, c::<S>(1.0) - growing(mirror)),
    ];
    pieces(s, growing(s), later)
}
