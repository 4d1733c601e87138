//! Constrained mechanical systems as differential-algebraic equations (DAE), for implicit methods:
//!
//! ```text
//! q′ = v        M(q, t) v′ + Φ_qᵀ λ - Q(t, q, v, z) = 0        Φ(q, t) = 0
//!               z′ - f(t, q, v, z) = 0
//! ```
//!
//! The method forms the iterates and the coefficients of the matrices of Newton's iteration; the system
//! evaluates residuals, stores its own tangent and factorises the matrices. Observers see y = (q, v, z,
//! quadratures), so output, interpolants and events are those of the explicit methods.

use crate::math::Complex;

/// Lengths of the parts of a DAE.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DaeLengths {
    /// Number of components of q, v and v′.
    pub coordinates: usize,
    /// Number of components of λ.
    pub multipliers: usize,
    /// Number of components of z.
    pub states: usize,
    /// Number of quadratures.
    pub quadratures: usize,
}

impl DaeLengths {
    /// Number of components that enter the error norm: q, v and z.
    pub fn controlled(&self) -> usize {
        2 * self.coordinates + self.states
    }

    /// Length of y = (q, v, z, quadratures).
    pub fn total(&self) -> usize {
        self.controlled() + self.quadratures
    }

    /// Length of a correction of Newton's iteration: (q or v part, z part, λ part).
    pub fn unknowns(&self) -> usize {
        self.coordinates + self.states + self.multipliers
    }
}

/// Coordinates, velocities, accelerations, multipliers and states, which need not satisfy any equation.
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
    /// First-order states.
    pub z: &'a [f64],
    /// Their rates.
    pub dz: &'a [f64],
}

/// The constraints that a method adds to the balance of forces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConstraintLevel {
    /// Φ: index 3.
    Position,
    /// Φ_q v + Φ_t: index 2.
    Velocity,
}

/// Where residuals are written.
#[derive(Debug)]
pub struct DaeResidual<'a> {
    /// M a + Φ_qᵀ λ - Q, as long as q.
    pub forces: &'a mut [f64],
    /// z′ - f, as long as z.
    pub states: &'a mut [f64],
    /// The constraints at the given level, as long as λ.
    pub rows: &'a mut [f64],
    /// Rates of the quadratures.
    pub powers: &'a mut [f64],
}

/// Where [`Dae::accelerate`] writes.
#[derive(Debug)]
pub struct DaeRates<'a> {
    /// Accelerations.
    pub a: &'a mut [f64],
    /// Multipliers.
    pub lam: &'a mut [f64],
    /// Rates of the first-order states.
    pub dz: &'a mut [f64],
    /// Rates of the quadratures.
    pub powers: &'a mut [f64],
}

/// Coefficients of the matrix of Newton's iteration,
///
/// ```text
/// [ mass M + damping D + stiffness K           - state_force Q_z    Φ_qᵀ ]
/// [ - state_velocity f_v - state_position f_q    I - state_rate f_z   0  ]
/// [ Φ_q + rate B                                 0                    0  ]
/// ```
///
/// with K and D the derivatives of the balance of forces by q and v, and B that of Φ_q v + Φ_t by q.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonCoefficients<F = f64> {
    /// Factor of M.
    pub mass: F,
    /// Factor of D.
    pub damping: F,
    /// Factor of K.
    pub stiffness: F,
    /// Factor of B.
    pub rate: F,
    /// Factor of Q_z.
    pub state_force: F,
    /// Factor of f_v.
    pub state_velocity: F,
    /// Factor of f_q.
    pub state_position: F,
    /// Factor of f_z.
    pub state_rate: F,
}

/// A constrained mechanical system.
pub trait Dae {
    /// The error of the system; it is passed on unchanged.
    type Stop;

    /// Lengths of its parts.
    fn lengths(&self) -> DaeLengths;

    /// a and λ at a state (q, v, z) that meets its constraints, from their second derivative; the rates of z and
    /// of the quadratures.
    ///
    /// # Errors
    /// Ends the integration. A state that is not finite should yield NaN instead.
    fn accelerate(
        &mut self,
        t: f64,
        state: [&[f64]; 3],
        out: DaeRates<'_>,
    ) -> Result<(), Self::Stop>;

    /// Residuals at an iterate.
    fn residual(&mut self, t: f64, at: Iterate<'_>, level: ConstraintLevel, out: DaeResidual<'_>);

    /// Computes and stores M, D, K, B, Φ_q and the derivatives of Q and f at an iterate.
    fn linearize(&mut self, t: f64, at: Iterate<'_>);

    /// Factorises the matrix with the last tangent. Returns false if it is singular; a shorter step may help.
    fn factor(&mut self, coefficients: NewtonCoefficients) -> bool;

    /// Factorises the matrix with complex coefficients; both factors are kept.
    fn factor_complex(&mut self, coefficients: NewtonCoefficients<Complex>) -> bool;

    /// Solves with the real factors, in place; (q part, z part, λ part).
    fn solve(&mut self, x: &mut [f64]);

    /// Solves with the complex factors, in place.
    fn solve_complex(&mut self, x: &mut [Complex]);

    /// (M x - K s, y + f_q s, -B s) with the last tangent, into `out` = (q part, z part, λ part); x and s are as
    /// long as q, y is as long as z.
    fn times(&self, x: &[f64], y: &[f64], s: &[f64], out: &mut [f64]);

    /// Replaces x by its part normal to the constraints in the metric of M, at the state of the last
    /// [`accelerate`](Self::accelerate).
    fn normal(&mut self, x: &mut [f64]);

    /// Projects q and v onto the constraints, if that is an option of the run. Returns whether they changed.
    ///
    /// # Errors
    /// Ends the integration.
    fn project(&mut self, t: f64, state: DaeState<'_>) -> Result<bool, Self::Stop>;

    /// The error with which the run ends if the matrix cannot be factorised for any step.
    fn singular(&mut self, t: f64, state: [&[f64]; 3]) -> Option<Self::Stop>;
}

/// A state to be projected.
#[derive(Debug)]
pub struct DaeState<'a> {
    /// Coordinates.
    pub q: &'a mut [f64],
    /// Velocities.
    pub v: &'a mut [f64],
    /// First-order states, which projection does not change.
    pub z: &'a [f64],
}
