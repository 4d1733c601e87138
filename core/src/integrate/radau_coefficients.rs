//! Radau IIA of order 5 with three stages: nodes, coefficient matrix, its transformation, and collocation
//! polynomials.
//!
//! The matrix A⁻¹ has one real eigenvalue and a pair of complex eigenvalues. T⁻¹ A⁻¹ T is block diagonal with these
//! eigenvalues, so that the equations of Newton's iteration separate into a real and a complex system (Hairer and
//! Wanner, *Solving Ordinary Differential Equations II*, IV.5 and IV.8).

use super::dae::NewtonCoefficients;
use crate::math::{indexed, Complex, Field};
use std::sync::LazyLock;

/// √6.
const ROOT: f64 = 2.449_489_742_783_178;

/// Nodes cᵢ.
pub(super) const C: [f64; 3] = [(4.0 - ROOT) / 10.0, (4.0 + ROOT) / 10.0, 1.0];

/// Coefficient matrix A. Its last row contains the weights bᵢ.
pub(super) const A: [[f64; 3]; 3] = [
    [(88.0 - 7.0 * ROOT) / 360.0, (296.0 - 169.0 * ROOT) / 1800.0, (-2.0 + 3.0 * ROOT) / 225.0],
    [(296.0 + 169.0 * ROOT) / 1800.0, (88.0 + 7.0 * ROOT) / 360.0, (-2.0 - 3.0 * ROOT) / 225.0],
    [(16.0 - ROOT) / 36.0, (16.0 + ROOT) / 36.0, 1.0 / 9.0],
];

/// A⁻¹.
pub(super) const INVERSE: [[f64; 3]; 3] = [
    [2.0 + 0.5 * ROOT, (29.0 * ROOT - 36.0) / 30.0, (6.0 - 4.0 * ROOT) / 15.0],
    [(-29.0 * ROOT - 36.0) / 30.0, 2.0 - 0.5 * ROOT, (6.0 + 4.0 * ROOT) / 15.0],
    [(8.0 * ROOT - 3.0) / 3.0, (-8.0 * ROOT - 3.0) / 3.0, 5.0],
];

/// Real eigenvalue of A⁻¹: 3 + 3^(2/3) - 3^(1/3).
pub(super) const REAL: f64 = 3.637_834_252_744_496;
/// Complex eigenvalue of A⁻¹, for the pair (w₁, w₂) written as w₁ + i w₂.
pub(super) const COMPLEX: [f64; 2] = [2.681_082_873_627_752_3, -3.050_430_199_247_411];

/// Transformation T.
pub(super) const T: [[f64; 3]; 3] = [
    [0.094_438_762_488_975_24, -0.141_255_295_020_954_2, 0.030_029_194_105_147_42],
    [0.250_213_122_965_333_3, 0.204_129_352_293_799_94, -0.382_942_112_757_261_9],
    [1.0, 1.0, 0.0],
];

/// T⁻¹.
pub(super) const T_INVERSE: [[f64; 3]; 3] = [
    [4.178_718_591_551_904, 0.327_682_820_761_062_37, 0.523_376_445_499_449_5],
    [-4.178_718_591_551_904, -0.327_682_820_761_062_37, 0.476_623_554_500_550_44],
    [0.502_872_634_945_786_8, -2.571_926_949_855_605, 0.596_039_204_828_224_9],
];

/// Factors of the stages in the error estimate, in addition to h f(y₀) divided by the real eigenvalue. The estimate
/// is the difference from an embedded method of order 3.
pub(super) const ERROR: [f64; 3] =
    [(-13.0 - 7.0 * ROOT) / (3.0 * REAL), (-13.0 + 7.0 * ROOT) / (3.0 * REAL), -1.0 / (3.0 * REAL)];

/// Degree of the continuous extension.
pub(super) const DEGREE: usize = 4;

/// Coefficients of θ … θ⁴ for each row. The first four rows belong to the derivatives of q and the quadratures at the
/// beginning and at the stages; they integrate the cubic through these derivatives. The next three belong to the
/// derivatives of the other components at the stages; they integrate the parabola through them. The last row, 3θ² -
/// 2θ³, belongs to the jump of a projection.
pub(super) static EXTENSION: LazyLock<[f64; 8 * DEGREE]> = LazyLock::new(|| {
    let mut table = [0.0; 8 * DEGREE];
    let four = [0.0, C[0], C[1], C[2]];
    for k in 0..4 {
        table[k * DEGREE..][..DEGREE].copy_from_slice(&integrated(&four, k));
    }
    for k in 0..3 {
        table[(4 + k) * DEGREE..][..DEGREE].copy_from_slice(&integrated(&C, k));
    }
    table[7 * DEGREE..].copy_from_slice(&[0.0, 3.0, -2.0, 0.0]);
    table
});

/// ∫₀^θ of the k-th Lagrange polynomial, as coefficients of θ … θ⁴.
fn integrated(nodes: &[f64], k: usize) -> [f64; DEGREE] {
    let mut polynomial = [1.0, 0.0, 0.0, 0.0];
    for (j, node) in nodes.iter().enumerate().filter(|(j, _)| *j != k) {
        let scale = 1.0 / (nodes[k] - nodes[j]);
        for power in (0..DEGREE).rev() {
            let lower = if power > 0 { polynomial[power - 1] } else { 0.0 };
            polynomial[power] = scale * (lower - node * polynomial[power]);
        }
    }
    indexed(|power| polynomial[power] / (power + 1) as f64)
}

/// Σ aᵢ bᵢ.
#[inline(always)]
pub(super) fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Values at θ of the Lagrange polynomials for the nodes.
pub(super) fn lagrange<const N: usize>(nodes: [f64; N], theta: f64) -> [f64; N] {
    indexed(|k| {
        let others = nodes.iter().enumerate().filter(|(j, _)| *j != k);
        others.fold(1.0, |product, (_, node)| product * (theta - node) / (nodes[k] - node))
    })
}

/// Coefficients of the matrix for an eigenvalue. `step` is h divided by the eigenvalue.
pub(super) fn coefficients<F: Field>(step: F) -> NewtonCoefficients<F> {
    NewtonCoefficients {
        mass: F::one(),
        damping: step,
        stiffness: step * step,
        rate: step,
        state_force: step,
        state_velocity: step,
        state_position: step * step,
        state_rate: step,
    }
}

/// h divided by the complex eigenvalue.
pub(super) fn complex_step(h: f64) -> Complex {
    Complex::new(COMPLEX[0], COMPLEX[1]).reciprocal() * Field::from_real(h)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn product(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
        indexed(|i| indexed(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
    }

    fn close(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3]) {
        for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
            assert!((a - b).abs() < 2e-14, "{a} {b}");
        }
    }

    const UNIT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    #[test]
    fn the_inverses_are_inverse() {
        close(&product(&A, &INVERSE), &UNIT);
        close(&product(&T, &T_INVERSE), &UNIT);
    }

    #[test]
    fn the_transformation_separates_the_eigenvalues() {
        let [re, im] = COMPLEX;
        let blocks = [[REAL, 0.0, 0.0], [0.0, re, -im], [0.0, im, re]];
        close(&product(&product(&T_INVERSE, &INVERSE), &T), &blocks);
    }

    /// Order 5 of the quadrature, stage order 3 (B(5) and C(3) of the book).
    #[test]
    fn the_order_conditions_hold() {
        for k in 1..=5 {
            let sum: f64 = (0..3).map(|j| A[2][j] * C[j].powi(k - 1)).sum();
            assert!((sum - 1.0 / f64::from(k)).abs() < 1e-15, "B {k}");
        }
        for k in 1..=3 {
            for i in 0..3 {
                let sum: f64 = (0..3).map(|j| A[i][j] * C[j].powi(k - 1)).sum();
                assert!((sum - C[i].powi(k) / f64::from(k)).abs() < 1e-15, "C {k}");
            }
        }
    }

    /// At θ = 1 both rows of integrals give the weights of the method, and v at the beginning none.
    #[test]
    fn the_extension_ends_where_the_step_does() {
        let at_end = |row: usize| EXTENSION[row * DEGREE..][..DEGREE].iter().sum::<f64>();
        assert!(at_end(0).abs() < 1e-15);
        for (k, weight) in A[2].iter().enumerate() {
            assert!((at_end(1 + k) - weight).abs() < 1e-15);
            assert!((at_end(4 + k) - weight).abs() < 1e-15);
        }
    }
}
