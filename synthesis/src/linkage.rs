//! The residuals of a four-bar OABD at its positions.

use crate::least_squares::Problem;
use kempe::math::Real;

/// Points and poses of the coupler, some with the angle of the crank.
///
/// Unknowns: O (2), a, b, p (2; the point in the frame of the coupler, x from A to B), D (2), c, the crank angle at
/// the origin of the given ones, and the angle of the moving frame in that of the coupler; at a position the angles of
/// the crank and the coupler.
#[derive(Clone, Debug)]
pub struct Coupler {
    /// x, y, angle of the moving frame and of the crank at each position; an angle is NaN if it is free.
    pub targets: Vec<[f64; 4]>,
    /// Factors of the closure and of the crank angle, and of the angle of the moving frame.
    pub weights: [f64; 2],
}

impl Problem for Coupler {
    fn unknowns(&self) -> usize {
        11
    }
    fn positions(&self) -> usize {
        self.targets.len()
    }
    fn residuals<S: Real>(&self, k: usize, linkage: &[S], position: [S; 2]) -> [S; 5] {
        let [x, y, frame, crank] = self.targets[k];
        let [closing, turning] = self.weights;
        let number = S::constant;
        let (sine, cosine) = position[0].sin_cos();
        let (along, across) = {
            let (s, c) = position[1].sin_cos();
            (c, s)
        };
        let a = [linkage[0] + linkage[2] * cosine, linkage[1] + linkage[2] * sine];
        let (b, p) = (linkage[3], [linkage[4], linkage[5]]);
        let to = [a[0] + b * along - linkage[6], a[1] + b * across - linkage[7]];
        let length = (to[0] * to[0] + to[1] * to[1] + number(1e-300)).sqrt();
        // O = D and b = 0 close at all positions, so that a short coupler must close better
        let narrow = (number(1.0) + number(1.0) / (b * b)).sqrt();
        let of = |given: f64, factor: f64, value: S| {
            if given.is_nan() {
                S::zero()
            } else {
                number(factor) * (value - number(given))
            }
        };
        [
            a[0] + p[0] * along - p[1] * across - number(x),
            a[1] + p[0] * across + p[1] * along - number(y),
            number(closing) * narrow * (length - linkage[8]),
            of(frame, turning, position[1] + linkage[10]),
            of(crank, closing, position[0] - linkage[9]),
        ]
    }
}

/// Pairs of angles of crank and rocker of a four-bar with O = (0, 0) and D = (1, 0).
///
/// Unknowns: a, b, c, the offsets of both angles and their scales; at a position the angles of the rocker and the
/// coupler.
#[derive(Clone, Debug)]
pub struct Pairs {
    /// Angles of crank and rocker at each position.
    pub targets: Vec<[f64; 2]>,
    /// Factor of the closure, in lengths of the rocker.
    pub closing: f64,
}

impl Problem for Pairs {
    fn unknowns(&self) -> usize {
        7
    }
    fn positions(&self) -> usize {
        self.targets.len()
    }
    fn residuals<S: Real>(&self, k: usize, linkage: &[S], position: [S; 2]) -> [S; 5] {
        let number = S::constant;
        let [crank, rocker] = self.targets[k].map(number);
        let [a, b, c] = [linkage[0], linkage[1], linkage[2]];
        let (sine, cosine) = (linkage[3] + linkage[5] * crank).sin_cos();
        let (y, x) = position[0].sin_cos();
        let (across, along) = position[1].sin_cos();
        // relative to c, since a = c = 0 closes at all angles
        let closing = number(self.closing) / c;
        [
            closing * (a * cosine + b * along - number(1.0) - c * x),
            closing * (a * sine + b * across - c * y),
            (position[0] - linkage[4]) / linkage[6] - rocker,
            S::zero(),
            S::zero(),
        ]
    }
}
