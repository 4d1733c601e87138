//! Evaluations of f, counted and checked.

use super::ode::Ode;
use super::stages::Block;
use crate::math::{Lanes, Real};

/// Why an evaluation is of no use.
pub(super) enum Trouble<E> {
    /// Not finite at this time: a shorter step may help.
    NotFinite(f64),
    /// The system stops.
    Stop(E),
}

/// A system with the count of its evaluations.
pub(super) struct RightHandSide<'a, Y> {
    pub system: &'a mut Y,
    pub evaluations: usize,
}

impl<Y: Ode> RightHandSide<'_, Y> {
    /// dy = f(t, y), both in blocks; not asked whether that is finite.
    #[inline(always)]
    pub fn unasked(
        &mut self,
        t: f64,
        y: &[Block],
        dy: &mut [Block],
    ) -> Result<(), Trouble<Y::Stop>> {
        let n = self.system.len();
        self.evaluations += 1;
        let (y, rates) = (&y.as_flattened()[..n], &mut dy.as_flattened_mut()[..n]);
        self.system.rate(t, y, rates).map_err(Trouble::Stop)
    }

    /// dy = f(t, y), both in blocks.
    #[inline]
    pub fn at(&mut self, t: f64, y: &[Block], dy: &mut [Block]) -> Result<(), Trouble<Y::Stop>> {
        self.unasked(t, y, dy)?;
        self.finite(t, dy)
    }

    /// The same after the system has accepted y; whether it `changed` it.
    pub fn at_accepted(
        &mut self,
        changed: bool,
        t: f64,
        y: &[Block],
        dy: &mut [Block],
    ) -> Result<(), Trouble<Y::Stop>> {
        if !changed {
            return self.at(t, y, dy);
        }
        let n = self.system.len();
        self.evaluations += 1;
        let (y, rates) = (&y.as_flattened()[..n], &mut dy.as_flattened_mut()[..n]);
        self.system.rate_projected(t, y, rates).map_err(Trouble::Stop)?;
        self.finite(t, dy)
    }

    /// Whether a derivative at t is finite.
    #[inline(always)]
    pub fn finite(&self, t: f64, dy: &[Block]) -> Result<(), Trouble<Y::Stop>> {
        // without what fills the last block: of what was stored in parts just now no vector can be loaded soon
        if all_finite(&dy.as_flattened()[..self.system.len()]) {
            Ok(())
        } else {
            Err(Trouble::NotFinite(t))
        }
    }

    /// Tells the system that a step of length `h` from t is about to be tried; dy, the derivative at
    /// its beginning, anew where that changes it; whether it does.
    #[inline]
    pub fn begin(
        &mut self,
        t: f64,
        h: f64,
        y: &[Block],
        dy: &mut [Block],
    ) -> Result<bool, Trouble<Y::Stop>> {
        let changed = self.system.before_trial(t, &y.as_flattened()[..self.system.len()], h);
        if changed {
            self.at(t, y, dy)?;
        }
        Ok(changed)
    }
}

/// Whether every number is finite.
#[inline(always)]
pub(crate) fn all_finite(x: &[f64]) -> bool {
    // 0 x is zero for finite x and NaN otherwise
    let (zero, blocks) = (Lanes::zero(), x.chunks_exact(Lanes::WIDTH));
    let rest: f64 = blocks.remainder().iter().map(|x| 0.0 * x).sum();
    let none = blocks.fold(Lanes::constant(rest), |none, x| {
        none.plus_product(zero, Lanes::new([x[0], x[1], x[2], x[3]]))
    });
    none.are_zero()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_number_that_is_not_finite_is_found_wherever_it_is() {
        for n in 0..20 {
            let x: Vec<f64> = (0..n).map(|k| 1e300 * f64::from(k - 7)).collect();
            assert!(all_finite(&x), "{n}");
            for at in 0..x.len() {
                for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    let mut x = x.clone();
                    x[at] = bad;
                    assert!(!all_finite(&x), "{bad} at {at} of {n}");
                }
            }
        }
    }
}
