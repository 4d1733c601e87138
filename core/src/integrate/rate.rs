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

    /// Tells the system that a step of length `h` from t is about to be tried; dy, the derivative at
    /// its beginning, anew where that changes it; whether it does.
    #[inline]
    pub fn begin(
        &mut self,
        t: f64,
        h: f64,
        y: &[f64],
        dy: &mut [f64],
    ) -> Result<bool, Trouble<Y::Stop>> {
        let changed = self.system.trying(t, y, h);
        if changed {
            self.at(t, y, dy)?;
        }
        Ok(changed)
    }
}

/// Whether every number is finite; as a sum of bits, so that it vectorises.
#[inline]
pub(crate) fn all_finite(x: &[f64]) -> bool {
    // 0 x is ±0 for finite x and NaN otherwise; the shift drops the sign
    (x.iter().fold(0, |bits, v| bits | (0.0 * v).to_bits()) << 1) == 0
}
