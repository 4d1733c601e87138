//! The operations on real or complex numbers that linear algebra needs.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

/// A field with a magnitude: the numbers of systems of linear equations.
pub trait Field:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
{
    /// A real number in the field.
    fn from_real(x: f64) -> Self;
    /// 1/x; not finite for 0.
    fn reciprocal(self) -> Self;
    /// |x|, or an upper bound within a factor of √2. Pivots are compared by it.
    fn magnitude(self) -> f64;

    /// Zero.
    fn zero() -> Self {
        Self::from_real(0.0)
    }
    /// One.
    fn one() -> Self {
        Self::from_real(1.0)
    }
}

impl Field for f64 {
    #[inline(always)]
    fn from_real(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn reciprocal(self) -> Self {
        1.0 / self
    }
    #[inline(always)]
    fn magnitude(self) -> f64 {
        self.abs()
    }
}
