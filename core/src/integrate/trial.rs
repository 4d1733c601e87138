//! A trial step of a Runge–Kutta method.

use super::failure::Cause;
use super::ode::Ode;
use super::right_hand_side::RightHandSide;
use super::stages::{combine, Block};

/// A step that is tried.
pub(super) struct Trial<'r, 's, Y> {
    rhs: &'r mut RightHandSide<'s, Y>,
    t: f64,
    h: f64,
    y: &'r [Block],
    /// The argument of the stage under way.
    work: &'r mut [Block],
    /// When the last stage was evaluated.
    last: f64,
}

impl<'r, 's, Y: Ode> Trial<'r, 's, Y> {
    /// Of length h from y at t; `work` is scratch.
    #[inline(always)]
    pub fn new(
        rhs: &'r mut RightHandSide<'s, Y>,
        (t, h): (f64, f64),
        y: &'r [Block],
        work: &'r mut [Block],
    ) -> Self {
        Self { rhs, t, h, y, work, last: t }
    }

    /// out = f(t + c h, y + h Σₛ aₛ kₛ). The result is checked to be finite only in the sums that use it: the last of
    /// the stages k must be the one before, with a weight that is not zero.
    #[inline(always)]
    pub fn stage<const S: usize>(
        &mut self,
        c: f64,
        a: [f64; S],
        k: [&[Block]; S],
        out: &mut [Block],
    ) -> Result<(), Cause<Y::Stop>> {
        debug_assert!(a[S - 1] != 0.0, "what the stage before is like shows here alone");
        if !combine(self.y, self.h, a, k, self.work) {
            return Err(Cause::NotFinite { t: self.last });
        }
        self.last = self.t + c * self.h;
        self.rhs.unchecked(self.last, self.work, out)
    }

    /// out = y + h Σₛ aₛ kₛ, all finite; with k as there.
    #[inline(always)]
    pub fn end<const S: usize>(
        &mut self,
        a: [f64; S],
        k: [&[Block]; S],
        out: &mut [Block],
    ) -> Result<(), Cause<Y::Stop>> {
        match combine(self.y, self.h, a, k, out) {
            true => Ok(()),
            false => Err(Cause::NotFinite { t: self.last }),
        }
    }
}
