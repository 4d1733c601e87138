//! The centre line of a piece of a beam: four nodes with a pose each, between which position and angle are
//! interpolated.
//!
//! The nodes are at the Gauss–Lobatto points of the reference interval ξ ∈ [-1, 1], so that masses lumped at them
//! integrate polynomials of degree five exactly. Position and angle are the polynomials of degree three through the
//! nodes. In the plane angles add, so that this interpolation is objective: a rigid rotation of the nodes rotates
//! every section by the same angle.

use crate::math::{Local, Pose, Real, Rotation, Twist, Vec2};

/// Number of nodes of a piece.
pub const NODES: usize = 4;

/// 1/√5.
const INNER: f64 = 0.447_213_595_499_958;
/// The nodes in ξ.
pub const PLACES: [f64; NODES] = [-1.0, -INNER, INNER, 1.0];
/// The parts of the length that the nodes carry: the weights of the Gauss–Lobatto rule, divided by two.
pub const SHARES: [f64; NODES] = [1.0 / 12.0, 5.0 / 12.0, 5.0 / 12.0, 1.0 / 12.0];

/// √(3/5).
const OUTER: f64 = 0.774_596_669_241_483_4;
/// The three Gauss points, in which strains are evaluated. This reduced integration avoids locking (Simo and Vu-Quoc
/// 1986).
pub const GAUSS: [f64; 3] = [-OUTER, 0.0, OUTER];
/// The weights of the Gauss points, divided by two: parts of the length.
pub const WEIGHTS: [f64; 3] = [5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0];
/// The interpolation in the Gauss points.
pub const AT_GAUSS: [Interpolated; 3] = [at(GAUSS[0]), at(GAUSS[1]), at(GAUSS[2])];

/// Number of places at which results are reported: both ends and the Gauss points.
pub const STATIONS: usize = 5;
/// Their interpolation.
pub const AT_STATIONS: [Interpolated; STATIONS] =
    [at(-1.0), AT_GAUSS[0], AT_GAUSS[1], AT_GAUSS[2], at(1.0)];

/// A quantity in the stations: in the Gauss points as given, and at the ends that of the parabola through them.
pub fn in_stations<S: Real>(of: [S; 3]) -> [S; STATIONS] {
    let x = GAUSS[2];
    // Lagrange's formula at ξ = ±1
    let near = S::constant((1.0 + x) / (2.0 * x * x));
    let far = S::constant((1.0 - x) / (2.0 * x * x));
    let middle = S::constant(1.0 - 1.0 / (x * x));
    let first = near * of[0] + middle * of[1] + far * of[2];
    let last = far * of[0] + middle * of[1] + near * of[2];
    [first, of[0], of[1], of[2], last]
}

/// Values of the four polynomials of the nodes, and their derivatives with respect to ξ.
#[derive(Clone, Copy, Debug)]
pub struct Interpolated {
    /// The values.
    pub value: [f64; NODES],
    /// The derivatives.
    pub slope: [f64; NODES],
}

/// The interpolation at ξ, by Lagrange's formula.
pub const fn at(x: f64) -> Interpolated {
    let (mut value, mut slope) = ([1.0; NODES], [0.0; NODES]);
    let mut k = 0;
    while k < NODES {
        let mut m = 0;
        while m < NODES {
            if m != k {
                value[k] *= (x - PLACES[m]) / (PLACES[k] - PLACES[m]);
                let mut factor = 1.0 / (PLACES[k] - PLACES[m]);
                let mut l = 0;
                while l < NODES {
                    if l != k && l != m {
                        factor *= (x - PLACES[l]) / (PLACES[k] - PLACES[l]);
                    }
                    l += 1;
                }
                slope[k] += factor;
            }
            m += 1;
        }
        k += 1;
    }
    Interpolated { value, slope }
}

/// A section: its rotation, and the derivatives of position and angle with respect to the arc length.
#[derive(Clone, Copy, Debug)]
pub struct Section<S> {
    /// Angle, rad.
    pub angle: S,
    /// Its rotation.
    pub rotation: Rotation<S>,
    /// Aᵀ r′: the tangent in the frame of the section.
    pub tangent: Local<S>,
    /// φ′, rad/m.
    pub curvature: S,
}

/// The section at a place of a piece. `per_length` is dξ/ds.
#[allow(clippy::needless_range_loop)] // loops over indices are inlined without optimisation across crates
#[inline(always)]
pub fn section<S: Real>(nodes: [&Pose<S>; NODES], of: &Interpolated, per_length: S) -> Section<S> {
    let first = nodes[0];
    let (mut x, mut y) = (S::zero(), S::zero());
    let (mut angle, mut curvature) = (S::zero(), S::zero());
    // differences from the first node: the sums of the values and of the slopes are one and zero
    for k in 1..NODES {
        let (value, slope) = (S::constant(of.value[k]), S::constant(of.slope[k]));
        let turned = nodes[k].angle - first.angle;
        x += slope * (nodes[k].r.x - first.r.x);
        y += slope * (nodes[k].r.y - first.r.y);
        angle += value * turned;
        curvature += slope * turned;
    }
    let angle = first.angle + angle;
    let rotation = Rotation::new(angle);
    let tangent = rotation.inverse(Vec2::new(x, y).scale(per_length));
    Section { angle, rotation, tangent, curvature: curvature * per_length }
}

impl<S: Real> Section<S> {
    /// The rates of the tangent in the frame of the section, and of the curvature, for the twists of the nodes.
    #[allow(clippy::needless_range_loop)] // as in `section`
    #[inline(always)]
    pub fn rates(
        &self,
        twists: [&Twist<S>; NODES],
        of: &Interpolated,
        per_length: S,
    ) -> (Local<S>, S) {
        let mut stretching = Vec2::zero();
        let (mut omega, mut bending) = (S::zero(), S::zero());
        for k in 0..NODES {
            let (value, slope) = (S::constant(of.value[k]), S::constant(of.slope[k]));
            stretching = stretching + twists[k].velocity.scale(slope);
            omega += value * twists[k].omega;
            bending += slope * twists[k].omega;
        }
        let along = self.rotation.inverse(stretching.scale(per_length));
        let turning = Local::new(self.tangent.y, -self.tangent.x).scale(omega);
        (along + turning, bending * per_length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interpolation_is_exact_for_cubic_polynomials() {
        let (f, slope) = (|x: f64| 2.0 - x + 3.0 * x * x * x, |x: f64| -1.0 + 9.0 * x * x);
        for x in [-1.0, -0.6, 0.0, 0.33, 1.0] {
            let of = at(x);
            let sum =
                |parts: [f64; NODES]| (0..NODES).map(|k| parts[k] * f(PLACES[k])).sum::<f64>();
            assert!((sum(of.value) - f(x)).abs() < 1e-14);
            assert!((sum(of.slope) - slope(x)).abs() < 1e-13);
        }
    }

    #[test]
    fn the_shares_integrate_polynomials_of_degree_five() {
        for degree in 0..6 {
            let exact = if degree % 2 == 0 { 1.0 / f64::from(degree + 1) } else { 0.0 };
            let sum: f64 = (0..NODES).map(|k| SHARES[k] * PLACES[k].powi(degree)).sum();
            assert!((sum - exact).abs() < 1e-15, "{degree}");
        }
    }
}
