//! Piecewise polynomials through given points, over any scalar: linear, cubic, quintic and monotone.
//!
//! The natural cubic spline is C² and minimises ∫ y″² dx; the natural quintic spline is C⁴ and minimises ∫ y‴² dx
//! (Schoenberg 1964). The unknowns at each knot are y′, and for the quintic spline also y″. The condition of the
//! minimum is a symmetric positive definite block tridiagonal system, cyclic for a periodic spline, which is solved
//! without pivoting. The monotone spline is that of Fritsch and Butland (1984), C¹.

use super::array::indexed;
use super::real::Real;
use super::spline_system::{clamped, solve, Stretch};
use crate::math::Listed;

/// The interpolation between the points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// Straight lines, C⁰.
    Linear,
    /// Cubic, C²; y″ = 0 at open ends.
    Cubic,
    /// Quintic, C⁴; y‴ = y⁗ = 0 at open ends.
    Quintic,
    /// Cubic without overshoot, C¹.
    Monotone,
}

impl Interpolation {
    /// All kinds, in the order of their names.
    pub const ALL: [Self; 4] = [Self::Linear, Self::Cubic, Self::Quintic, Self::Monotone];

    /// The name in a case file.
    pub fn name(self) -> &'static str {
        ["linear", "cubic", "quintic", "monotone"][self as usize]
    }
    /// The kind with the given name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
    /// The smallest number of points that determines the curve. A periodic curve repeats its first point.
    pub fn least(self, periodic: bool) -> usize {
        match self {
            _ if periodic => 4,
            Self::Quintic => 3,
            _ => 2,
        }
    }
    /// Degree of the polynomials.
    fn degree(self) -> usize {
        match self {
            Self::Linear => 1,
            Self::Cubic | Self::Monotone => 3,
            Self::Quintic => 5,
        }
    }
}

/// A piecewise polynomial with its knots.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline<S = f64> {
    knots: Vec<S>,
    /// Coefficients of the powers of x - knot, with one row for each interval.
    pieces: Vec<[S; 6]>,
    degree: usize,
    periodic: bool,
}

impl Spline {
    /// The pieces of the quintic spline whose first and second derivatives at its ends are given: the coefficients of the
    /// powers of x - knot.
    ///
    /// # Panics
    /// If there are fewer than two points, or x and y differ in length.
    pub fn clamped(x: &[f64], y: &[f64], ends: [[f64; 2]; 2]) -> Vec<[f64; 6]> {
        assert!(x.len() == y.len() && x.len() > 1, "too few points");
        let stretches = stretches(x, y);
        let mut pieces = quintic(&stretches, &clamped(&stretches, ends));
        pieces.iter_mut().zip(y).for_each(|(piece, y)| piece[0] = *y);
        pieces
    }
}

impl<S: Real> Spline<S> {
    /// The spline through the points (x, y) with increasing x. A periodic spline has equal first and last y.
    ///
    /// # Panics
    /// If there are fewer points than [`Interpolation::least`], or x and y differ in length.
    pub fn new(kind: Interpolation, periodic: bool, x: &[S], y: &[S]) -> Self {
        assert!(x.len() == y.len() && x.len() >= kind.least(periodic), "too few points");
        let stretches = stretches(x, y);
        let pieces = match kind {
            Interpolation::Linear => linear(&stretches),
            Interpolation::Cubic => cubic(&stretches, &solve(&stretches, periodic, Stretch::cubic)),
            Interpolation::Monotone => cubic(&stretches, &monotone(&stretches, periodic)),
            Interpolation::Quintic => {
                quintic(&stretches, &solve(&stretches, periodic, Stretch::quintic))
            }
        };
        let start = |(k, mut piece): (usize, [S; 6])| {
            piece[0] = y[k];
            piece
        };
        let pieces = pieces.into_iter().enumerate().map(start).list();
        Self { knots: x.to_vec(), pieces, degree: kind.degree(), periodic }
    }

    /// The knots, in increasing order.
    pub fn knots(&self) -> &[S] {
        &self.knots
    }

    /// Whether the spline is periodic.
    pub fn periodic(&self) -> bool {
        self.periodic
    }

    /// The value at x. Outside the knots, the first and the last polynomial are extended; a periodic spline repeats.
    /// `lift` converts the numbers of the spline to the scalar of x.
    pub fn value<T: Real>(&self, x: T, lift: impl Fn(S) -> T + Copy) -> T {
        self.derivatives::<T, 1>(x, lift)[0]
    }

    /// The value of the polynomial that begins at knot `k`, extended beyond its interval.
    pub fn extended<T: Real>(&self, k: usize, x: T, lift: impl Fn(S) -> T) -> T {
        let [value] = self.piece(k, x, lift);
        value
    }

    /// The value and the derivatives of order 1 to N - 1 at x, as [`value`](Self::value).
    pub fn derivatives<T: Real, const N: usize>(
        &self,
        x: T,
        lift: impl Fn(S) -> T + Copy,
    ) -> [T; N] {
        let x = match self.periodic {
            true => self.wrapped(x, lift),
            false => x,
        };
        let found = self.pieces_at(x.in_lanes());
        let [mut k, .., last] = found;
        let mut result = self.piece(k, x, lift);
        // lanes on different pieces, or a range over all pieces between its ends
        while k < last {
            k += 1;
            if found.contains(&k) || x.spread() > 0.0 {
                // the later piece applies where x is beyond its first knot
                let beyond = x - lift(self.knots[k]);
                let piece: [T; N] = self.piece(k, x, lift);
                result = indexed(|n| T::select(beyond, piece[n], result[n]));
            }
        }
        result
    }

    /// The pieces of the numbers in the lanes, in increasing order.
    fn pieces_at(&self, x: [f64; 4]) -> [usize; 4] {
        let inner = &self.knots[1..self.knots.len() - 1];
        let mut found =
            indexed(|lane| inner.partition_point(|knot| knot.in_lanes()[lane] < x[lane]));
        found.sort_unstable();
        found
    }

    /// x shifted into the first period.
    fn wrapped<T: Real>(&self, x: T, lift: impl Fn(S) -> T) -> T {
        let first = lift(self.knots[0]);
        let period = lift(self.knots[self.knots.len() - 1]) - first;
        x - ((x - first) / period).floor() * period
    }

    /// Value and derivatives of one polynomial, by Horner's scheme.
    fn piece<T: Real, const N: usize>(&self, k: usize, x: T, lift: impl Fn(S) -> T) -> [T; N] {
        let t = x - lift(self.knots[k]);
        let mut result = [T::zero(); N];
        let mut power = self.degree + 1;
        while power > 0 {
            power -= 1;
            let mut n = N - 1;
            while n > 0 {
                result[n] = result[n] * t + result[n - 1];
                n -= 1;
            }
            result[0] = result[0] * t + lift(self.pieces[k][power]);
        }
        let (mut n, mut factorial) = (2, 1.0);
        while n < N {
            factorial *= n as f64;
            result[n] = result[n] * T::constant(factorial);
            n += 1;
        }
        result
    }
}

fn linear<S: Real>(stretches: &[Stretch<S>]) -> Vec<[S; 6]> {
    let zero = S::zero();
    stretches.iter().map(|s| [zero, s.rise / s.width, zero, zero, zero, zero]).list()
}

/// The pieces of a cubic spline, from the slopes at the knots.
fn cubic<S: Real>(stretches: &[Stretch<S>], slopes: &[[S; 2]]) -> Vec<[S; 6]> {
    let (two, three, zero) = (S::constant(2.0), S::constant(3.0), S::zero());
    let piece = |(k, s): (usize, &Stretch<S>)| {
        let ([d0, _], [d1, _], h) = (slopes[k], slopes[k + 1], s.width);
        let m = s.rise / h;
        let second = (three * m - two * d0 - d1) / h;
        [zero, d0, second, (d0 + d1 - two * m) / (h * h), zero, zero]
    };
    stretches.iter().enumerate().map(piece).list()
}

/// The intervals between points.
fn stretches<S: Real>(x: &[S], y: &[S]) -> Vec<Stretch<S>> {
    (1..x.len()).map(|k| Stretch { width: x[k] - x[k - 1], rise: y[k] - y[k - 1] }).list()
}

/// The pieces of a quintic spline, from the first and second derivatives at the knots.
fn quintic<S: Real>(stretches: &[Stretch<S>], ends: &[[S; 2]]) -> Vec<[S; 6]> {
    let c = S::constant;
    let piece = |(k, s): (usize, &Stretch<S>)| {
        let ([d0, s0], [d1, s1], h) = (ends[k], ends[k + 1], s.width);
        let h2 = h * h;
        let (m, a0, b0, a1, b1) = (s.rise, d0 * h, s0 * h2, d1 * h, s1 * h2);
        let third = c(10.0) * m - c(6.0) * a0 - c(1.5) * b0 - c(4.0) * a1 + c(0.5) * b1;
        let fourth = c(-15.0) * m + c(8.0) * a0 + c(1.5) * b0 + c(7.0) * a1 - b1;
        let fifth = c(6.0) * m - c(3.0) * a0 - c(0.5) * b0 - c(3.0) * a1 + c(0.5) * b1;
        let h3 = h2 * h;
        [S::zero(), d0, c(0.5) * s0, third / h3, fourth / (h2 * h2), fifth / (h2 * h3)]
    };
    stretches.iter().enumerate().map(piece).list()
}

/// Slopes without overshoot: a weighted harmonic mean of the slopes on both sides of the knot, or zero if they differ
/// in sign.
fn monotone<S: Real>(stretches: &[Stretch<S>], periodic: bool) -> Vec<[S; 2]> {
    let (two, three) = (S::constant(2.0), S::constant(3.0));
    let inner = |a: &Stretch<S>, b: &Stretch<S>| {
        let (left, right) = (a.rise / a.width, b.rise / b.width);
        let (w1, w2) = (two * b.width + a.width, b.width + two * a.width);
        let product = left * right;
        let divisor = S::select(product, w1 * right + w2 * left, S::one());
        S::select(product, (w1 + w2) * product / divisor, S::zero())
    };
    // the end slope of a parabola through three points, limited to prevent overshoot
    let end = |a: &Stretch<S>, b: &Stretch<S>| {
        let (near, far) = (a.rise / a.width, b.rise / b.width);
        let slope = ((two * a.width + b.width) * near - a.width * far) / (a.width + b.width);
        let limit = three * near;
        let limited = S::select(slope.abs() - limit.abs(), limit, slope);
        let bounded = S::select(near * far, slope, limited);
        S::select(slope * near, bounded, S::zero())
    };
    let n = stretches.len();
    let alone = |slope: S| [slope, S::zero()];
    let mut slopes: Vec<[S; 2]> = Vec::with_capacity(n + 1);
    let ends = match n {
        1 => [stretches[0].rise / stretches[0].width; 2],
        _ if periodic => [inner(&stretches[n - 1], &stretches[0]); 2],
        _ => [end(&stretches[0], &stretches[1]), end(&stretches[n - 1], &stretches[n - 2])],
    };
    slopes.push(alone(ends[0]));
    stretches.windows(2).map(|pair| alone(inner(&pair[0], &pair[1]))).append_to(&mut slopes);
    slopes.push(alone(ends[1]));
    slopes
}
