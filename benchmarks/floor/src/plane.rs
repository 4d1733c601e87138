//! Vectors of the plane and symmetric 2 × 2 matrices.

use std::ops::{Add, Mul, Neg, Sub};

/// (x, y).
#[derive(Clone, Copy, Debug)]
pub struct Vec2(pub f64, pub f64);

impl Vec2 {
    /// Scalar product.
    #[inline(always)]
    pub fn dot(self, o: Self) -> f64 {
        self.0 * o.0 + self.1 * o.1
    }
    /// Rotated by a right angle, counter-clockwise.
    #[inline(always)]
    pub fn turned(self) -> Self {
        Self(-self.1, self.0)
    }
}
impl Add for Vec2 {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self(self.0 + o.0, self.1 + o.1)
    }
}
impl Sub for Vec2 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self(self.0 - o.0, self.1 - o.1)
    }
}
impl Neg for Vec2 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}
impl Mul<Vec2> for f64 {
    type Output = Vec2;
    #[inline(always)]
    fn mul(self, o: Vec2) -> Vec2 {
        Vec2(self * o.0, self * o.1)
    }
}

/// [xx xy; xy yy].
#[derive(Clone, Copy, Debug)]
pub struct Sym2 {
    /// First diagonal entry.
    pub xx: f64,
    /// Off-diagonal entry.
    pub xy: f64,
    /// Second diagonal entry.
    pub yy: f64,
}

impl Sym2 {
    /// a I + b n nᵀ.
    #[inline(always)]
    pub fn dyad(a: f64, b: f64, n: Vec2) -> Self {
        Self { xx: a + b * n.0 * n.0, xy: b * n.0 * n.1, yy: a + b * n.1 * n.1 }
    }
    /// Determinant.
    #[inline(always)]
    pub fn det(self) -> f64 {
        self.xx * self.yy - self.xy * self.xy
    }
    /// Adjugate: the inverse times the determinant.
    #[inline(always)]
    pub fn adjugate(self) -> Self {
        Self { xx: self.yy, xy: -self.xy, yy: self.xx }
    }
    /// All entries times a number.
    #[inline(always)]
    pub fn scaled(self, s: f64) -> Self {
        Self { xx: s * self.xx, xy: s * self.xy, yy: s * self.yy }
    }
    /// A x.
    #[inline(always)]
    pub fn times(self, x: Vec2) -> Vec2 {
        Vec2(self.xx * x.0 + self.xy * x.1, self.xy * x.0 + self.yy * x.1)
    }
    /// O A O for a symmetric O.
    #[inline(always)]
    pub fn between(self, o: Self) -> Self {
        let (first, second) = (o.times(Vec2(self.xx, self.xy)), o.times(Vec2(self.xy, self.yy)));
        // rows of O A are (first.0, second.0) and (first.1, second.1)
        Self {
            xx: first.0 * o.xx + second.0 * o.xy,
            xy: first.0 * o.xy + second.0 * o.yy,
            yy: first.1 * o.xy + second.1 * o.yy,
        }
    }
}
impl Add for Sym2 {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self { xx: self.xx + o.xx, xy: self.xy + o.xy, yy: self.yy + o.yy }
    }
}
impl Sub for Sym2 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self { xx: self.xx - o.xx, xy: self.xy - o.xy, yy: self.yy - o.yy }
    }
}
