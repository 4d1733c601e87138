//! Powers of forces and drivers.

use crate::elements::{Nature, OwnPowers};
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

    /// Adds the powers of an element beside those of its wrenches.
    #[inline(always)]
    pub(super) fn add_own(&mut self, own: OwnPowers<S>) {
        self.dissipated += own.dissipated;
        self.applied += own.applied;
    }

    /// Adds the power of a part of a force.
    #[inline(always)]
    pub(super) fn add(&mut self, nature: Nature, power: impl Fn() -> S) {
        match nature {
            Nature::Conservative | Nature::Exchanged => {}
            Nature::Dissipative => self.dissipated -= power(),
            Nature::Applied => self.applied += power(),
        }
    }
}
