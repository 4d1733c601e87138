//! The scale of the errors of a step: atolᵢ + rtol max(|yᵢ|, |y_newᵢ|).

use super::stages::{room, Block};
use super::step_control::Atol;
use crate::math::{Lanes, Real};

/// Tolerances of every component.
pub(super) struct Tolerances {
    rtol: f64,
    /// Absolute tolerances of the components that count; infinite behind the last one.
    atol: Vec<Block>,
    /// Number of components that count.
    pub controlled: usize,
}

impl Tolerances {
    /// For components of which the first `controlled` count.
    pub fn new(rtol: f64, atol: &Atol, controlled: usize) -> Self {
        let mut blocks = room(1, controlled);
        let numbers = blocks.as_flattened_mut();
        numbers.fill(f64::INFINITY);
        let counting = numbers.iter_mut().take(controlled);
        match atol {
            Atol::Scalar(atol) | Atol::Scaled(atol) => counting.for_each(|to| *to = *atol),
            Atol::Each(atol) => counting.zip(atol).for_each(|(to, atol)| *to = *atol),
        }
        Self { rtol, atol: blocks, controlled }
    }

    /// Σ (xᵢ / scaleᵢ)², of blocks xᵢ of several quantities; one pass over the components.
    #[inline(always)]
    pub fn squares<const Q: usize>(
        &self,
        (y, y_new): (&[Block], &[Block]),
        x: impl Fn(usize) -> [Lanes; Q],
    ) -> [f64; Q] {
        let n = self.atol.len();
        let (y, y_new) = (&y[..n], &y_new[..n]);
        let rtol = Lanes::constant(self.rtol);
        let mut sums = [Lanes::zero(); Q];
        for i in 0..n {
            let [y, y_new] = [y[i], y_new[i]].map(|y| Lanes::new(y).abs());
            let scale = Lanes::new(self.atol[i]).plus_product(rtol, y.max(y_new));
            for (sum, x) in sums.iter_mut().zip(x(i)) {
                let scaled = x / scale;
                *sum = sum.plus_product(scaled, scaled);
            }
        }
        sums.map(|sum| {
            let [a, b, c, d] = sum.to_array();
            (a + b) + (c + d)
        })
    }

    /// √(Σ (xᵢ / scaleᵢ)² / n) at one state; 0 without components that count.
    pub fn norm(&self, y: &[Block], x: impl Fn(usize) -> Lanes) -> f64 {
        let [sum] = self.squares((y, y), |i| [x(i)]);
        self.mean(sum).sqrt()
    }

    /// The mean over the components that count, from the sum; 0 without them.
    pub fn mean(&self, sum: f64) -> f64 {
        sum / self.controlled.max(1) as f64
    }
}
