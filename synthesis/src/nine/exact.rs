//! Complex numbers of twice as many digits, for the differences that decide where a large four-bar is.

use kempe::math::Complex;
use std::ops::{Add, Mul, Neg};

/// The sum of a number and what its rounding lost (Dekker 1971).
#[derive(Clone, Copy)]
struct Twofold(f64, f64);

impl Add for Twofold {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let sum = self.0 + other.0;
        let part = sum - self.0;
        let lost = (self.0 - (sum - part)) + (other.0 - part) + (self.1 + other.1);
        let whole = sum + lost;
        Self(whole, lost - (whole - sum))
    }
}

impl Mul for Twofold {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = self.0 * other.0;
        let lost = self.0.mul_add(other.0, -product) + (self.0 * other.1 + self.1 * other.0);
        let whole = product + lost;
        Self(whole, lost - (whole - product))
    }
}

impl Neg for Twofold {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

/// A complex number of twice as many digits.
#[derive(Clone, Copy)]
pub(super) struct Exact(Twofold, Twofold);

impl Exact {
    pub(super) fn rounded(self) -> Complex {
        Complex::new(self.0 .0, self.1 .0)
    }
}

impl From<Complex> for Exact {
    fn from(z: Complex) -> Self {
        Self(Twofold(z.re, 0.0), Twofold(z.im, 0.0))
    }
}

impl Add for Exact {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }
}

impl Mul for Exact {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let re = self.0 * other.0 + -(self.1 * other.1);
        Self(re, self.0 * other.1 + self.1 * other.0)
    }
}
