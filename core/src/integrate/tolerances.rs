//! The scale of the errors of a step: atolᵢ + rtol max(|yᵢ|, |y_newᵢ|).

use super::ode::Structure;
use super::stages::{room, Block};
use super::step_control::Atol;
use crate::math::{each, indexed, Lanes, Real, ShortArray};

/// Tolerances of all controlled components.
pub(super) struct Tolerances {
    rtol: f64,
    /// Absolute tolerances of the controlled components, padded with infinity.
    atol: Vec<Block>,
    /// Number of controlled components.
    pub controlled: usize,
}

impl Tolerances {
    /// Tolerances for the first `controlled` components.
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

    /// Tolerances of the quadratures, which follow the other components. Their scale is 1.
    pub fn of_quadratures(rtol: f64, structure: Structure) -> Self {
        let mut atol = vec![f64::INFINITY; structure.controlled()];
        atol.resize(structure.total(), rtol);
        let tolerances = Self::new(0.0, &Atol::Each(atol), structure.total());
        Self { controlled: structure.quadratures, ..tolerances }
    }

    /// √(Σ (xᵢ / scaleᵢ)² / n) at one state; 0 without controlled components.
    #[inline]
    pub fn norm(&self, y: &[Block], x: impl Fn(usize) -> Lanes) -> f64 {
        let [sum] = self.squares([y, y], |i| [x(i)]);
        (sum / self.components()).sqrt()
    }

    /// The number of controlled components, at least 1.
    #[inline]
    pub fn components(&self) -> f64 {
        self.controlled.max(1) as f64
    }
}

/// Sums of squares over the controlled components.
pub(super) trait Squares {
    /// One sum, or a sum for each lane.
    type Sum: Copy;

    /// Σ (xᵢ / scaleᵢ)² for blocks xᵢ of several quantities. The scale follows from the states y and y_new.
    fn squares<const Q: usize>(
        &self,
        states: [&[Block]; 2],
        x: impl Fn(usize) -> [Lanes; Q],
    ) -> [Self::Sum; Q];
}

impl Squares for Tolerances {
    type Sum = f64;

    /// One pass over the components, four at a time.
    #[inline(always)]
    fn squares<const Q: usize>(
        &self,
        [y, y_new]: [&[Block]; 2],
        x: impl Fn(usize) -> [Lanes; Q],
    ) -> [f64; Q] {
        let n = self.atol.len();
        let (y, y_new) = (&y[..n], &y_new[..n]);
        let rtol = Lanes::constant(self.rtol);
        let mut sums = [Lanes::zero(); Q];
        for i in 0..n {
            let scale = scale([y[i], y_new[i]], (Lanes::new(self.atol[i]), rtol));
            add_squares(&mut sums, x(i), scale);
        }
        each(sums, |sum: Lanes| {
            let [a, b, c, d] = sum.to_array();
            (a + b) + (c + d)
        })
    }
}

/// atol + rtol max(|y|, |y_new|).
#[inline(always)]
fn scale(states: [Block; 2], (atol, rtol): (Lanes, Lanes)) -> Lanes {
    let [y, y_new] = states.each(|y| Lanes::new(y).abs());
    atol.plus_product(rtol, y.max(y_new))
}

#[inline(always)]
fn add_squares<const Q: usize>(sums: &mut [Lanes; Q], x: [Lanes; Q], scale: Lanes) {
    for (sum, x) in sums.iter_mut().zip(x) {
        let scaled = x / scale;
        *sum = sum.plus_product(scaled, scaled);
    }
}

/// The tolerances of one integration in each lane. A block contains one component of all lanes.
#[derive(Clone, Debug, Default)]
pub struct LaneTolerances {
    rtol: Block,
    /// One block for each controlled component.
    atol: Vec<Block>,
}

impl LaneTolerances {
    /// Sets the tolerances of a lane.
    #[inline]
    pub(super) fn set(&mut self, lane: usize, of: &Tolerances) {
        self.rtol[lane] = of.rtol;
        self.atol.resize(of.controlled, [f64::INFINITY; Lanes::WIDTH]);
        for (to, atol) in self.atol.iter_mut().zip(of.atol.as_flattened()) {
            to[lane] = *atol;
        }
    }

    /// Copies the tolerances of a lane to another lane.
    #[inline]
    pub fn repeat(&mut self, from: usize, to: usize) {
        let blocks = self.atol.iter_mut().chain([&mut self.rtol]);
        blocks.for_each(|block| block[to] = block[from]);
    }

    /// The number of controlled components, at least 1.
    #[inline]
    pub fn components(&self) -> f64 {
        self.atol.len().max(1) as f64
    }
}

impl Squares for LaneTolerances {
    type Sum = Block;

    /// Computes the same sums as for each integration alone, to the last bit, because the components are added in the
    /// same order.
    #[inline(always)]
    fn squares<const Q: usize>(
        &self,
        [y, y_new]: [&[Block]; 2],
        x: impl Fn(usize) -> [Lanes; Q],
    ) -> [Block; Q] {
        let rtol = Lanes::new(self.rtol);
        let mut sums = [[Lanes::zero(); Q]; Lanes::WIDTH];
        for (i, atol) in self.atol.iter().enumerate() {
            let scale = scale([y[i], y_new[i]], (Lanes::new(*atol), rtol));
            add_squares(&mut sums[i % Lanes::WIDTH], x(i), scale);
        }
        let [a, b, c, d] = sums;
        indexed(|q| ((a[q] + b[q]) + (c[q] + d[q])).to_array())
    }
}
