//! Powers of forces and drivers.

use crate::elements::Nature;
use crate::math::Real;

/// Powers that the energy balance integrates, W.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Powers<S = f64> {
    /// Lost in dampers and friction.
    pub dissipated: S,
    /// Put in by drivers: -λᵀ Φ_q q̇ over their rows.
    pub drivers: S,
    /// Put in by forces that are neither conservative nor dissipative.
    pub applied: S,
}

impl<S: Real> Powers<S> {
    /// No power.
    pub fn zero() -> Self {
        Self { dissipated: S::zero(), drivers: S::zero(), applied: S::zero() }
    }

    /// Adds the power of a part of a force; `law`: whether time or state enters its formulas.
    #[inline(always)]
    pub(super) fn add(&mut self, nature: Nature, law: bool, power: impl Fn() -> S) {
        match (law, nature) {
            (false, Nature::Conservative) | (_, Nature::Exchanged) => {}
            (_, Nature::Dissipative) => self.dissipated -= power(),
            _ => self.applied += power(), // a law of time or state has no potential
        }
    }
}
