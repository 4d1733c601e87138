//! The residuals of a four-bar at pairs of angles.

use crate::least_squares::Problem;
use kempe::math::Real;

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
