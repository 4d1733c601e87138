//! Points and vectors of the plane as complex numbers.

use kempe::math::Complex;

/// The distance from zero; other than `hypot`, it has the same digits on every machine.
pub fn abs(z: Complex) -> f64 {
    (z.re * z.re + z.im * z.im).sqrt()
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

/// The direction of a number.
pub fn unit(z: Complex) -> Complex {
    scaled(z, 1.0 / abs(z).max(f64::MIN_POSITIVE))
}

/// The direction of a coupler between its pin and the pivot of the rocker, on the side of a sign; as near as possible to
/// closing if it cannot close.
pub fn closed(far: Complex, [bar, rocker]: [f64; 2], side: f64) -> Complex {
    let length = abs(far).max(f64::MIN_POSITIVE);
    let cosine = (bar * bar + length * length - rocker * rocker) / (2.0 * bar * length);
    let cosine = cosine.clamp(-1.0, 1.0);
    let sine = (1.0 - cosine * cosine).sqrt().copysign(side);
    unit(far) * Complex::new(cosine, sine)
}
