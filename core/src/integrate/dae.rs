//! Constrained mechanical systems as differential-algebraic equations (DAE), for implicit methods:
//!
//! ```text
//! q′ = v        M(q, t) v′ + Φ_qᵀ λ - Q(t, q, v, z) = 0        Φ(q, t) = 0
//!               z′ - f(t, q, v, z) = 0
//! ```
//!
//! An integration method provides the iterates and the coefficients of the matrices of Newton's iteration. The system
//! evaluates the residuals, stores its tangent and factorises the matrices. Observers receive y = (q, v, z,
//! quadratures), so output, interpolants and events work as for the explicit methods.

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
    /// Number of columns of equal length of which each part consists, for instance the motion and its derivatives.
    pub columns: usize,
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

    /// Length of a correction of Newton's iteration, which has the parts (q or v, z, λ).
    pub fn unknowns(&self) -> usize {
        self.coordinates + self.states + self.multipliers
    }
}

/// Coordinates, velocities, accelerations, multipliers and states. They need not satisfy any equation.
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
    /// Rates of the first-order states.
    pub dz: &'a [f64],
}

/// The constraint equations that a method solves together with the balance of forces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConstraintLevel {
    /// Φ: index 3.
    Position,
    /// Φ_q v + Φ_t: index 2.
    Velocity,
}

/// Memory for the residuals.
#[derive(Debug)]
pub struct DaeResidual<'a> {
    /// M a + Φ_qᵀ λ - Q, of the length of q.
    pub forces: &'a mut [f64],
    /// z′ - f, of the length of z.
    pub states: &'a mut [f64],
    /// The constraint equations at the given level, of the length of λ.
    pub rows: &'a mut [f64],
    /// Rates of the quadratures.
    pub powers: &'a mut [f64],
}

/// Memory for the results of [`Dae::accelerate`].
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
/// K and D are the derivatives of the balance of forces with respect to q and v. B is the derivative of Φ_q v + Φ_t
/// with respect to q.
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
    /// Error of the system, passed on unchanged.
    type Stop;

    /// Lengths of the parts of the DAE.
    fn lengths(&self) -> DaeLengths;

    /// Computes a and λ at a state (q, v, z) that satisfies the constraints, from the second derivative of the
    /// constraints. Also computes the rates of z and of the quadratures.
    ///
    /// # Errors
    /// An error ends the integration. For a state that is not finite, return NaN instead.
    fn accelerate(
        &mut self,
        t: f64,
        state: [&[f64]; 3],
        out: DaeRates<'_>,
    ) -> Result<(), Self::Stop>;

    /// Number of parts of the unknowns that Newton's iteration solves one after the other. A part depends only on those
    /// before it.
    fn parts(&self) -> usize {
        1
    }

    /// Begins the iteration of a part. [`residual`](Self::residual) is then zero for the other parts.
    fn begin_part(&mut self, part: usize) {
        let _ = part;
    }

    /// Computes the residuals at an iterate.
    fn residual(&mut self, t: f64, at: Iterate<'_>, level: ConstraintLevel, out: DaeResidual<'_>);

    /// Computes and stores M, D, K, B, Φ_q and the derivatives of Q and f at an iterate.
    fn linearize(&mut self, t: f64, at: Iterate<'_>);

    /// The magnitude of the quadratures to which their errors are relative, as [`Ode::quadrature_scale`], after the
    /// residuals at the end of a trial step, where the quadratures are `works`.
    ///
    /// [`Ode::quadrature_scale`]: super::Ode::quadrature_scale
    fn quadrature_scale(&self, works: &[f64]) -> Option<f64> {
        let _ = works;
        None
    }

    /// Factorises the matrix with the last tangent. Returns false if the matrix is singular; a shorter step may then
    /// help.
    fn factor(&mut self, coefficients: NewtonCoefficients) -> bool;

    /// Factorises the matrix with complex coefficients. The real factors are kept as well.
    fn factor_complex(&mut self, coefficients: NewtonCoefficients<Complex>) -> bool;

    /// Solves with the real factors, in place. x has the parts (q, z, λ).
    fn solve(&mut self, x: &mut [f64]);

    /// Solves with the complex factors, in place.
    fn solve_complex(&mut self, x: &mut [Complex]);

    /// Computes (M x - K s, y + f_q s, -B s) with the last tangent into `out`, which has the parts (q, z, λ). x and s
    /// have the length of q, y has that of z.
    fn times(&self, x: &[f64], y: &[f64], s: &[f64], out: &mut [f64]);

    /// Replaces x by its component normal to the constraints in the metric of M, at the state of the last
    /// [`accelerate`](Self::accelerate).
    fn normal(&mut self, x: &mut [f64]);

    /// Projects q and v onto the constraints, if the options of the integration require it; v also if the method
    /// requires it (`velocities`). Returns whether they changed.
    ///
    /// # Errors
    /// An error ends the integration.
    fn project(
        &mut self,
        t: f64,
        state: DaeState<'_>,
        velocities: bool,
    ) -> Result<bool, Self::Stop>;

    /// Error with which the integration ends if the matrix is singular for every step size.
    fn singular(&mut self, t: f64, state: [&[f64]; 3]) -> Option<Self::Stop>;
}

/// A state to be projected.
#[derive(Debug)]
pub struct DaeState<'a> {
    /// Coordinates.
    pub q: &'a mut [f64],
    /// Velocities.
    pub v: &'a mut [f64],
    /// First-order states. The projection does not change them.
    pub z: &'a [f64],
}
