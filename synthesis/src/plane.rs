//! Points and vectors of the plane as complex numbers.

use kempe::math::Complex;

/// The distance from zero.
pub fn abs(z: Complex) -> f64 {
    z.re.hypot(z.im)
}

/// The direction, rad.
pub fn angle(z: Complex) -> f64 {
    z.im.atan2(z.re)
}

/// The mirror image at the real axis.
pub fn conjugate(z: Complex) -> Complex {
    Complex::new(z.re, -z.im)
}

/// The third component of the cross product.
pub fn cross(x: Complex, y: Complex) -> f64 {
    x.re * y.im - x.im * y.re
}

/// The number of length 1 with this direction.
pub fn turn(angle: f64) -> Complex {
    let (sine, cosine) = angle.sin_cos();
    Complex::new(cosine, sine)
}

/// A multiple.
pub fn scaled(z: Complex, factor: f64) -> Complex {
    Complex::new(z.re * factor, z.im * factor)
}
