//! What a constrained mechanical system and an implicit method promise each other.
//!
//! ```text
//! q′ = v        M(q, t) v′ + Φ_qᵀ λ - Q(t, q, v) = 0        Φ(q, t) = 0
//! ```
//!
//! The method forms the iterates; the system evaluates residuals, holds its own tangent and the factors
//! of the matrices of Newton's iteration, of which the method names only the coefficients. What is shown
//! to an [`Observer`] is y = (q, v, quadratures), so output, dense output and events are those of the
//! explicit methods.

use super::failure::Failure;
use super::ode::{Observer, Statistics};
use crate::math::Complex;

/// Coordinates, velocities, accelerations and multipliers, which need not satisfy anything.
#[derive(Clone, Copy, Debug)]
pub struct Iterate<'a> {
    /// Coordinates.
    pub q: &'a [f64],
    /// Velocities.
    pub v: &'a [f64],
    /// Accelerations.
    pub a: &'a [f64],
    /// Multipliers.
    pub lam: &'a [f64],
}

/// Which constraints a method puts beside the balance of forces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConstraintLevel {
    /// Φ: index 3.
    Position,
    /// Φ_q v + Φ_t: index 2.
    Velocity,
}

/// Where residuals go.
#[derive(Debug)]
pub struct DaeResidual<'a> {
    /// M a + Φ_qᵀ λ - Q, as long as q.
    pub forces: &'a mut [f64],
    /// The constraints at the level asked for, as long as λ.
    pub rows: &'a mut [f64],
    /// Rates of the quadratures.
    pub powers: &'a mut [f64],
}

/// Coefficients of the matrix of Newton's iteration,
///
/// ```text
/// [ mass M + damping D + stiffness K   Φ_qᵀ ]
/// [ Φ_q + rate B                        0   ]
/// ```
///
/// with K and D the derivatives of the balance of forces by q and v, and B that of Φ_q v + Φ_t by q.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonCoefficients<F = f64> {
    /// Of M.
    pub mass: F,
    /// Of D.
    pub damping: F,
    /// Of K.
    pub stiffness: F,
    /// Of B.
    pub rate: F,
}

/// A matrix without a factorisation, at the state where it was linearised: a shorter step may help.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SingularMatrix;

/// A constrained mechanical system.
pub trait Dae {
    /// Why the system cannot go on; passed through untouched.
    type Stop;

    /// Number of coordinates.
    fn coordinates(&self) -> usize;

    /// Number of constraints.
    fn multipliers(&self) -> usize;

    /// Number of quadratures.
    fn quadratures(&self) -> usize;

    /// a and λ at a state that meets its constraints, from their second derivative, and the rates of
    /// the quadratures.
    ///
    /// # Errors
    /// Ends the integration. A state that is not finite should yield NaN instead.
    fn accelerate(
        &mut self,
        t: f64,
        state: [&[f64]; 2],
        a: &mut [f64],
        lam: &mut [f64],
        powers: &mut [f64],
    ) -> Result<(), Self::Stop>;

    /// Residuals at a point.
    fn residual(&mut self, t: f64, at: Iterate<'_>, level: ConstraintLevel, out: DaeResidual<'_>);

    /// Finds and keeps M, D, K, B and Φ_q at a point.
    fn linearize(&mut self, t: f64, at: Iterate<'_>);

    /// Factorises the matrix with the last tangent.
    ///
    /// # Errors
    /// [`SingularMatrix`].
    fn factor(&mut self, coefficients: NewtonCoefficients) -> Result<(), SingularMatrix>;

    /// The same with complex coefficients; both factors are kept.
    ///
    /// # Errors
    /// [`SingularMatrix`].
    fn factor_complex(
        &mut self,
        coefficients: NewtonCoefficients<Complex>,
    ) -> Result<(), SingularMatrix>;

    /// Solves with the real factors, in place; (q part, λ part).
    fn solve(&mut self, x: &mut [f64]);

    /// Solves with the complex factors, in place.
    fn solve_complex(&mut self, x: &mut [Complex]);

    /// (M x - K s, -B s) with the last tangent, into `out`: (q part, λ part).
    fn times(&self, x: &[f64], s: &[f64], out: &mut [f64]);

    /// Replaces x by its part normal to the constraints in the metric of M, at the state of the last
    /// [`accelerate`](Self::accelerate).
    fn normal(&mut self, x: &mut [f64]);

    /// Puts q and v onto the constraints, if that was asked for; whether they changed.
    ///
    /// # Errors
    /// Ends the integration.
    fn project(&mut self, t: f64, q: &mut [f64], v: &mut [f64]) -> Result<bool, Self::Stop>;

    /// What to end with where no step, however short, has a matrix with a factorisation.
    fn singular(&mut self, t: f64, q: &[f64], v: &[f64]) -> Option<Self::Stop>;
}

/// An implicit scheme with its options.
pub trait ImplicitMethod {
    /// Integrates as [`Method::integrate`](super::Method::integrate) does; `y` = (q, v, quadratures).
    ///
    /// # Errors
    /// [`Failure`], with the time and the state reached.
    fn integrate<Y: Dae, O: Observer>(
        &self,
        system: &mut Y,
        t0: f64,
        t_end: f64,
        y: &mut [f64],
        observer: &mut O,
    ) -> Result<Statistics, Failure<Y::Stop>>;
}
