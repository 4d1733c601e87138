//! Gains of Baumgarte's stabilization (Haug 7.3.8).

/// Baumgarte's gains. If both are zero, γ is unchanged.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gains {
    /// α, 1/s.
    pub alpha: f64,
    /// β, 1/s.
    pub beta: f64,
}
