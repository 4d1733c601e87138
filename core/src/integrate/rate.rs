//! Evaluations of f, counted and checked.

use super::contract::FirstOrder;
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
pub(super) struct Rate<'a, Y> {
    pub system: &'a mut Y,
    pub evaluations: usize,
}

impl<Y: FirstOrder> Rate<'_, Y> {
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
        self.system.rate_accepted(t, y, rates).map_err(Trouble::Stop)?;
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
        let changed = self.system.trying(t, &y.as_flattened()[..self.system.len()], h);
        if changed {
            self.at(t, y, dy)?;
        }
        Ok(changed)
    }
}

/// Whether every number is finite.
#[inline(always)]
pub(crate) fn all_finite(x: &[f64]) -> bool {
    // 0 x is zero for finite x and NaN otherwise; four at once, in two sums of which neither waits for the other
    let zero = Lanes::zero();
    let block = |x: &[f64]| Lanes::new([x[0], x[1], x[2], x[3]]);
    let pairs = x.chunks_exact(2 * Lanes::WIDTH);
    let left = pairs.remainder().chunks_exact(Lanes::WIDTH);
    let rest: f64 = left.remainder().iter().map(|x| 0.0 * x).sum();
    let mut sums = [Lanes::constant(rest), zero];
    for pair in pairs {
        sums[0] = sums[0].plus_product(zero, block(pair));
        sums[1] = sums[1].plus_product(zero, block(&pair[Lanes::WIDTH..]));
    }
    for x in left {
        sums[0] = sums[0].plus_product(zero, block(x));
    }
    let [a, b, c, d] = (sums[0] + sums[1]).to_array();
    (a + b) + (c + d) == 0.0
}
