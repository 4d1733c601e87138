//! Powers of forces and drivers.

use crate::elements::{Nature, OwnPowers};
use crate::math::Real;

/// Powers in the energy balance, W.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Powers<S = f64> {
    /// Dissipated in dampers and friction.
    pub dissipated: S,
    /// Supplied by drivers: -λᵀ Φ_q q̇ over their rows.
    pub drivers: S,
    /// Supplied by forces that are neither conservative nor dissipative.
    pub applied: S,
}

impl<S: Real> Powers<S> {
    /// Zero powers.
    #[inline]
    pub fn zero() -> Self {
        Self { dissipated: S::zero(), drivers: S::zero(), applied: S::zero() }
    }

    /// Adds the powers of an element that are not those of its wrenches.
    #[inline(always)]
    pub(super) fn add_own(&mut self, own: OwnPowers<S>) {
        self.dissipated += own.dissipated;
        self.applied += own.applied;
    }

    /// Adds the power of one part of a force.
    #[inline(always)]
    pub(super) fn add(&mut self, nature: Nature, power: impl Fn() -> S) {
        match nature {
            Nature::Conservative | Nature::Exchanged => {}
            Nature::Dissipative => self.dissipated -= power(),
            Nature::Applied => self.applied += power(),
        }
    }
}
