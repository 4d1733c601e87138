//! Evaluations of f, counted and checked.

use super::contract::FirstOrder;

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
    /// dy = f(t, y).
    #[inline]
    pub fn at(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Trouble<Y::Stop>> {
        self.evaluations += 1;
        self.system.rate(t, y, dy).map_err(Trouble::Stop)?;
        if all_finite(dy) {
            Ok(())
        } else {
            Err(Trouble::NotFinite(t))
        }
    }
}

/// Whether every number is finite; without early exit, so that it vectorises.
#[inline]
pub(super) fn all_finite(x: &[f64]) -> bool {
    x.iter().fold(true, |ok, v| ok & v.is_finite())
}
