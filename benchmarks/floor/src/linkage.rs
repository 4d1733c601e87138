//! The numbers of the flagship, and the solution of its equations of motion.

/// Coordinates: x, y, angle of crank, coupler and rocker.
pub const N_Q: usize = 9;
/// Rows of the constraints: two for each of the joints A, B, C, D; Φ = point_j - point_i.
pub const N_ROWS: usize = 8;
/// y = (q, v).
pub const N_Y: usize = 2 * N_Q;

/// Masses, kg.
pub const MASS: [f64; 3] = [3.0, 5.0, 4.0];
/// Half the lengths, m: the ends of a bar are at (∓half, 0) of its frame.
pub const HALF: [f64; 3] = [5.0, 13.0, 9.0];
/// Inertias of uniform slender bars about their centres, kg m².
pub const INERTIA: [f64; 3] = [
    MASS[0] * HALF[0] * HALF[0] / 3.0,
    MASS[1] * HALF[1] * HALF[1] / 3.0,
    MASS[2] * HALF[2] * HALF[2] / 3.0,
];
/// x of the ground point D, m; A is the origin and y of both is 0.
pub const D: f64 = 20.0;
/// m/s², along -y.
pub const GRAVITY: f64 = 9.81;
/// Torsion spring and damper between ground and rocker: N m/rad, N m s/rad, rad.
pub const STIFFNESS: f64 = 1e6;
/// See [`STIFFNESS`].
pub const DAMPING: f64 = 1e4;
/// See [`STIFFNESS`].
pub const FREE_ANGLE: f64 = 1.5 * std::f64::consts::PI;

/// Baumgarte's gains for the right-hand side: 2α and β².
#[derive(Clone, Copy, Debug)]
pub struct Gains {
    /// 2α, 1/s.
    pub damping: f64,
    /// β², 1/s².
    pub stiffness: f64,
}

/// α = 10, β = 200.
pub const BAUMGARTE: Gains = Gains { damping: 20.0, stiffness: 4e4 };
/// γ without stabilization.
pub const NONE: Gains = Gains { damping: 0.0, stiffness: 0.0 };

/// Accelerations and multipliers.
#[derive(Clone, Copy, Debug)]
pub struct Solution {
    /// q̈.
    pub a: [f64; N_Q],
    /// λ.
    pub lam: [f64; N_ROWS],
}

/// A solver of the augmented equations of the flagship.
pub trait Equations {
    /// q̈ and λ at y = (q, v).
    fn solve(y: &[f64; N_Y], gains: Gains) -> Solution;
}

/// Torque of spring and damper on the rocker, N m.
#[inline(always)]
pub fn torque(y: &[f64; N_Y]) -> f64 {
    -STIFFNESS * (y[8] - FREE_ANGLE) - DAMPING * y[17]
}
