//! Parameters of the generalized-α method, and the coefficients that follow from them.
//!
//! ```text
//! q₁ = q₀ + h v₀ + h² ((½ - β) a₀ + β a₁)          v₁ = v₀ + h ((1 - γ) a₀ + γ a₁)
//! (1 - α_m) a₁ + α_m a₀ = (1 - α_f) v̇₁ + α_f v̇₀
//! ```
//!
//! The variable a approximates, to second order, the acceleration at t + Δ h with Δ = α_m - α_f. (Chung and Hulbert,
//! *A time integration algorithm for structural dynamics with improved numerical dissipation: the generalized-α
//! method*, J. Appl. Mech. 60 (1993) 371; Arnold and Brüls, *Convergence of the generalized-α scheme for constrained
//! mechanical systems*, Multibody Syst. Dyn. 18 (2007) 185.)

/// The parameters α_m, α_f, β and γ. β and γ give order 2 with the largest damping of high frequencies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlphaParameters {
    /// Shift of the accelerations, α_m.
    pub alpha_m: f64,
    /// Shift of the forces, α_f.
    pub alpha_f: f64,
    /// Newmark's parameter β.
    pub beta: f64,
    /// Newmark's parameter γ.
    pub gamma: f64,
}

impl AlphaParameters {
    fn of_order_two(alpha_m: f64, alpha_f: f64) -> Self {
        let gamma = 0.5 + alpha_f - alpha_m;
        Self { alpha_m, alpha_f, beta: 0.25 * (gamma + 0.5) * (gamma + 0.5), gamma }
    }

    /// The parameters of Chung and Hulbert. `rho` in [0, 1) is the spectral radius at infinite frequency.
    pub fn chung_hulbert(rho: f64) -> Self {
        Self::of_order_two((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0))
    }

    /// The parameters of Hilber, Hughes and Taylor. `alpha` is in [-1/3, 0); a smaller value gives more damping
    /// (*Improved numerical dissipation for time integration algorithms in structural dynamics*, Earthquake Eng.
    /// Struct. Dyn. 5 (1977) 283).
    pub fn hht(alpha: f64) -> Self {
        Self::of_order_two(0.0, -alpha)
    }

    /// The parameters for first-order states z with the same spectral radius ρ = (1 - x) / (1 + x), x = α_f - α_m. In
    /// the equations above, z and z′ replace v and v̇ (Jansen, Whiting and Hulbert, *A generalized-α method for
    /// integrating the filtered Navier–Stokes equations with a stabilized finite element method*, Comput. Methods
    /// Appl. Mech. Eng. 190 (2000) 305).
    pub fn of_states(&self) -> Self {
        let x = self.alpha_f - self.alpha_m;
        Self::of_order_two(0.5 - x, 0.5 * (1.0 - x))
    }

    /// Δ = α_m - α_f.
    pub fn shift(&self) -> f64 {
        self.alpha_m - self.alpha_f
    }

    /// Coefficient C of the local error C h³ v̈ of q: C = 1/6 - β - Δ/2.
    pub fn position_error(&self) -> f64 {
        1.0 / 6.0 - self.beta - 0.5 * self.shift()
    }

    /// Coefficient C of the local error C h³ v⃛ of v: C = 1/6 - (Δ² + 2 Δ γ + γ)/2 - κ. The last of the equations
    /// above determines κ in a = v̇(t + Δ h) + κ h² v⃛.
    pub fn velocity_error(&self) -> f64 {
        let (shift, gamma) = (self.shift(), self.gamma);
        let kappa =
            0.5 * (1.0 - self.alpha_f) - 0.5 * shift * shift - (1.0 - self.alpha_m) * (shift + 0.5);
        1.0 / 6.0 - 0.5 * (shift * shift + 2.0 * shift * gamma + gamma) - kappa
    }

    /// dv̇₁/da₁.
    pub fn acceleration_share(&self) -> f64 {
        (1.0 - self.alpha_m) / (1.0 - self.alpha_f)
    }
}
