//! Counted and checked evaluations of f.

use super::failure::Cause;
use super::ode::Ode;
use super::stages::Block;
use crate::math::{Lanes, Real};

/// A system with the count of its evaluations.
pub(super) struct RightHandSide<'a, Y> {
    pub system: &'a mut Y,
    pub evaluations: usize,
}

impl<Y: Ode> RightHandSide<'_, Y> {
    /// dy = f(t, y), both in blocks. Does not check that dy is finite.
    #[inline(always)]
    pub fn unchecked(
        &mut self,
        t: f64,
        y: &[Block],
        dy: &mut [Block],
    ) -> Result<(), Cause<Y::Stop>> {
        let n = self.system.len();
        self.evaluations += 1;
        let (y, rates) = (&y.as_flattened()[..n], &mut dy.as_flattened_mut()[..n]);
        self.system.rate(t, y, rates).map_err(|error| Cause::Equations { t, error })
    }

    /// dy = f(t, y), both in blocks. Checks that dy is finite.
    #[inline]
    pub fn at(&mut self, t: f64, y: &[Block], dy: &mut [Block]) -> Result<(), Cause<Y::Stop>> {
        self.unchecked(t, y, dy)?;
        self.finite(t, dy)
    }

    /// dy = f(t, y) at an accepted state, which projection may have changed.
    pub fn at_accepted(
        &mut self,
        projected: bool,
        t: f64,
        y: &[Block],
        dy: &mut [Block],
    ) -> Result<(), Cause<Y::Stop>> {
        let n = self.system.len();
        match self.system.manifold().filter(|_| projected) {
            None => return self.at(t, y, dy),
            Some(manifold) => {
                let (y, rates) = (&y.as_flattened()[..n], &mut dy.as_flattened_mut()[..n]);
                let rated = manifold.rate_projected(t, y, rates);
                rated.map_err(|error| Cause::Equations { t, error })?;
            }
        }
        self.evaluations += 1;
        self.finite(t, dy)
    }

    /// Returns an error if the derivative at t is not finite.
    #[inline(always)]
    pub fn finite(&self, t: f64, dy: &[Block]) -> Result<(), Cause<Y::Stop>> {
        // exclude the padding: a vector load that spans two recent stores cannot be forwarded and stalls
        match all_finite(&dy.as_flattened()[..self.system.len()]) {
            true => Ok(()),
            false => Err(Cause::NotFinite { t }),
        }
    }

    /// Announces a trial step of length `h` from t. If this changes f, evaluates dy at the beginning again and
    /// returns true.
    #[inline]
    pub fn before_trial(
        &mut self,
        t: f64,
        h: f64,
        y: &[Block],
        dy: &mut [Block],
    ) -> Result<bool, Cause<Y::Stop>> {
        let n = self.system.len();
        let Some(changes) = self.system.trial_changes() else { return Ok(false) };
        let changed = changes.before_trial(t, &y.as_flattened()[..n], h);
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
