//! A trial step of a Runge–Kutta method.

use super::failure::Cause;
use super::ode::Ode;
use super::right_hand_side::RightHandSide;
use super::runge_kutta::TrialStages;
use super::stages::{combine, Block};
use crate::math::{Lanes, Real};

/// A trial step.
pub(super) struct Trial<'r, 's, Y> {
    rhs: &'r mut RightHandSide<'s, Y>,
    t: f64,
    t_new: f64,
    h: f64,
    /// The state at the beginning of the step.
    pub y: &'r [Block],
    /// The argument of the current stage.
    work: &'r mut [Block],
    /// Time of the last stage.
    last: f64,
}

impl<'r, 's, Y: Ode> Trial<'r, 's, Y> {
    /// A trial step from y at t to t_new. `work` is scratch memory of the length of y.
    #[inline(always)]
    pub fn new(
        rhs: &'r mut RightHandSide<'s, Y>,
        (t, t_new): (f64, f64),
        y: &'r [Block],
        work: &'r mut [Block],
    ) -> Self {
        Self { rhs, t, t_new, h: t_new - t, y, work, last: t }
    }
}

impl<Y: Ode> TrialStages for Trial<'_, '_, Y> {
    type Stop = Cause<Y::Stop>;

    #[inline(always)]
    fn width(&self) -> usize {
        self.y.len()
    }

    #[inline(always)]
    fn stage<const S: usize>(
        &mut self,
        c: f64,
        a: [f64; S],
        k: [&[Block]; S],
        out: &mut [Block],
    ) -> Result<(), Self::Stop> {
        debug_assert!(a[S - 1] != 0.0, "what the stage before is like shows here alone");
        if !combine(self.y, Lanes::constant(self.h), a, k, self.work) {
            return Err(Cause::NotFinite { t: self.last });
        }
        self.last = self.t + c * self.h;
        self.rhs.unchecked(self.last, self.work, out)
    }

    #[inline(always)]
    fn end<const S: usize>(
        &mut self,
        divisor: f64,
        a: [f64; S],
        k: [&[Block]; S],
        out: &mut [Block],
    ) -> Result<(), Self::Stop> {
        match combine(self.y, Lanes::constant(self.h / divisor), a, k, out) {
            true => Ok(()),
            false => Err(Cause::NotFinite { t: self.last }),
        }
    }

    #[inline(always)]
    fn rate_at_end(&mut self, y_new: &[Block], dy: &mut [Block]) -> Result<(), Self::Stop> {
        self.rhs.at(self.t_new, y_new, dy)
    }

    #[inline(always)]
    fn finite(&self, stage: &[Block]) -> Result<(), Self::Stop> {
        self.rhs.finite(self.last, stage)
    }
}
