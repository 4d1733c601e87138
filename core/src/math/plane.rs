//! Geometry of the plane (Haug 2.4): A(φ) = [cos φ, -sin φ; sin φ, cos φ], B(φ) = dA/dφ.
//!
//! Global vectors ([`Vec2`]) and body-fixed vectors ([`Local`]) are different types. Only a [`Rotation`] converts one
//! into the other, so that a missing A(φ) is a compile error.

use super::real::{Lift, Real};
use std::ops::{Add, Mul, Neg, Sub};

/// A vector in the global frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vec2<S = f64> {
    /// Component along global x.
    pub x: S,
    /// Component along global y.
    pub y: S,
}

/// A vector in a body frame: s′.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Local<S = f64> {
    /// Component along the body's x axis.
    pub x: S,
    /// Component along the body's y axis.
    pub y: S,
}

macro_rules! vector {
    ($V:ident) => {
        impl<S: Real> $V<S> {
            /// From components.
            #[inline]
            pub fn new(x: S, y: S) -> Self {
                Self { x, y }
            }
            /// The null vector.
            #[inline]
            pub fn zero() -> Self {
                Self::new(S::zero(), S::zero())
            }
            /// Scalar product.
            #[inline]
            pub fn dot(self, o: Self) -> S {
                self.x * o.x + self.y * o.y
            }
            /// z component of the vector product.
            #[inline]
            pub fn cross(self, o: Self) -> S {
                self.x * o.y - self.y * o.x
            }
            /// The vector turned by +90°: (-y, x).
            #[inline]
            pub fn perp(self) -> Self {
                Self::new(-self.y, self.x)
            }
            /// Length.
            #[inline]
            pub fn norm(self) -> S {
                self.dot(self).sqrt()
            }
            /// Multiplied by a scalar.
            #[inline]
            pub fn scale(self, k: S) -> Self {
                Self::new(self.x * k, self.y * k)
            }
            /// The same vector over a scalar that contains this one.
            #[inline]
            pub fn lift<T: Lift<S>>(self) -> $V<T> {
                $V { x: T::lift(self.x), y: T::lift(self.y) }
            }
        }
        impl<S: Real> Add for $V<S> {
            type Output = Self;
            #[inline]
            fn add(self, o: Self) -> Self {
                Self::new(self.x + o.x, self.y + o.y)
            }
        }
        impl<S: Real> Sub for $V<S> {
            type Output = Self;
            #[inline]
            fn sub(self, o: Self) -> Self {
                Self::new(self.x - o.x, self.y - o.y)
            }
        }
        impl<S: Real> Neg for $V<S> {
            type Output = Self;
            #[inline]
            fn neg(self) -> Self {
                Self::new(-self.x, -self.y)
            }
        }
    };
}
vector!(Vec2);
vector!(Local);

/// The rotation A(φ).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation<S = f64> {
    /// cos φ.
    pub cos: S,
    /// sin φ.
    pub sin: S,
}

impl<S: Real> Rotation<S> {
    /// A(φ).
    #[inline]
    pub fn new(angle: S) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { cos, sin }
    }
    /// Aᵀ v: the body-fixed components of a global vector.
    #[inline]
    pub fn inverse(self, v: Vec2<S>) -> Local<S> {
        Local::new(self.cos * v.x + self.sin * v.y, self.cos * v.y - self.sin * v.x)
    }
}

impl<S: Real> Mul<Local<S>> for Rotation<S> {
    type Output = Vec2<S>;
    #[inline]
    fn mul(self, s: Local<S>) -> Vec2<S> {
        let (across, along) = (self.cos * s.x, self.sin * s.x);
        Vec2::new(across.minus_product(self.sin, s.y), along.plus_product(self.cos, s.y))
    }
}

/// A body-fixed vector s′, prepared for B s′: pairs of numbers that are rotated by the same operations.
#[derive(Clone, Copy, Debug)]
pub struct Lever<S = f64> {
    /// (-y′, -y′).
    across: [S; 2],
    /// (-x′, x′).
    along: [S; 2],
}

impl<S: Real> From<Local<S>> for Lever<S> {
    #[inline]
    fn from(s: Local<S>) -> Self {
        Self { across: [-s.y, -s.y], along: [-s.x, s.x] }
    }
}

/// The pose of a body frame: its origin r, its angle φ, and A(φ).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<S = f64> {
    /// Origin of the body frame, m.
    pub r: Vec2<S>,
    /// Angle of the body frame, rad, continuous (not modulo 2π).
    pub angle: S,
    /// A(φ).
    pub rotation: Rotation<S>,
}

impl<S: Real> Pose<S> {
    /// The pose with the given coordinates.
    #[inline]
    pub fn new(x: S, y: S, angle: S) -> Self {
        Self { r: Vec2::new(x, y), angle, rotation: Rotation::new(angle) }
    }
    /// The pose of ground.
    #[inline]
    pub fn identity() -> Self {
        Self {
            r: Vec2::zero(),
            angle: S::zero(),
            rotation: Rotation { cos: S::one(), sin: S::zero() },
        }
    }
    /// A s′: a body-fixed vector in the global frame.
    #[inline]
    pub fn global(&self, s: Local<S>) -> Vec2<S> {
        self.rotation * s
    }
    /// B s′ = (A s′)⊥: the derivative of a body-fixed vector with respect to the angle (Haug 2.6.4).
    #[inline(always)]
    pub fn turning(&self, s: &Lever<S>) -> Vec2<S> {
        let Rotation { cos, sin } = self.rotation;
        Vec2 {
            x: (sin * s.along[0]).plus_product(cos, s.across[0]),
            y: (cos * s.along[1]).plus_product(sin, s.across[1]),
        }
    }
    /// The same pose over a scalar that contains this one.
    #[inline]
    pub fn lift<T: Lift<S>>(&self) -> Pose<T> {
        let Rotation { cos, sin } = self.rotation;
        Pose {
            r: self.r.lift(),
            angle: T::lift(self.angle),
            rotation: Rotation { cos: T::lift(cos), sin: T::lift(sin) },
        }
    }
    /// r + A s′: a point of the body in the global frame (Haug 2.4.8).
    #[inline]
    pub fn point(&self, s: Local<S>) -> Vec2<S> {
        self.r + self.rotation * s
    }
}

/// The velocity of a body frame: velocity of its origin, and angular velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist<S = f64> {
    /// Velocity of the frame's origin, m/s.
    pub velocity: Vec2<S>,
    /// Angular velocity, rad/s.
    pub omega: S,
}

impl<S: Real> Twist<S> {
    /// The twist at rest.
    #[inline]
    pub fn zero() -> Self {
        Self { velocity: Vec2::zero(), omega: S::zero() }
    }
}

/// Position and velocity of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion<S = f64> {
    /// The pose.
    pub pose: Pose<S>,
    /// The twist.
    pub twist: Twist<S>,
}

impl<S: Real> Motion<S> {
    /// At rest in the global frame, like ground.
    #[inline]
    pub fn ground() -> Self {
        Self { pose: Pose::identity(), twist: Twist::zero() }
    }
    /// The same motion over a scalar that contains this one.
    #[inline]
    pub fn lift<T: Lift<S>>(&self) -> Motion<T> {
        let Twist { velocity, omega } = self.twist;
        Motion {
            pose: self.pose.lift(),
            twist: Twist { velocity: velocity.lift(), omega: T::lift(omega) },
        }
    }
    /// Velocity of a body-fixed point: ṙ + B s′ φ̇ (Haug 2.6.4).
    #[inline]
    pub fn point_velocity(&self, s: Local<S>) -> Vec2<S> {
        self.twist.velocity + self.pose.global(s).perp().scale(self.twist.omega)
    }
}

/// A force and a torque on a body, reduced to the origin of its frame, in global components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<S = f64> {
    /// Force, N.
    pub force: Vec2<S>,
    /// Torque about the frame's origin, N·m.
    pub torque: S,
}

impl<S: Real> Wrench<S> {
    /// Zero force and torque.
    #[inline]
    pub fn zero() -> Self {
        Self { force: Vec2::zero(), torque: S::zero() }
    }
    /// A pure torque.
    #[inline]
    pub fn torque(torque: S) -> Self {
        Self { force: Vec2::zero(), torque }
    }
    /// A force at `arm`, in global components from the origin of the frame.
    #[inline]
    pub fn at(arm: Vec2<S>, force: Vec2<S>) -> Self {
        Self { force, torque: arm.cross(force) }
    }
    /// Power of the wrench on a moving body, W.
    #[inline]
    pub fn power(self, twist: Twist<S>) -> S {
        self.force.dot(twist.velocity) + self.torque * twist.omega
    }
}

impl<S: Real> Neg for Wrench<S> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { force: -self.force, torque: -self.torque }
    }
}
impl<S: Real> Add for Wrench<S> {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        Self { force: self.force + o.force, torque: self.torque + o.torque }
    }
}

#[cfg(test)]
mod tests {
    use super::{Lever, Local, Pose};

    /// Equal to the last bit, except for the sign of zero.
    #[test]
    fn a_lever_gives_the_turned_vector() {
        for k in 0..100 {
            let pose = Pose::new(1.0, 2.0, 0.37 * f64::from(k) - 11.0);
            let s = Local::new(0.1 * f64::from(k) - 3.0, 1.7 - 0.3 * f64::from(k));
            assert_eq!(pose.turning(&Lever::from(s)), pose.global(s).perp(), "{s:?}");
        }
    }
}
