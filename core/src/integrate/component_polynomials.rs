//! An interpolant as one polynomial for each component.

use crate::math::{Lanes, Real};

/// Highest degree of the interpolant of any method.
pub(crate) const HIGHEST: usize = 9;

/// Values of four components at the beginning, then their coefficients of θ … θ⁹ divided by h.
pub(super) type Four = [Lanes; HIGHEST + 1];

/// The continuous extension of a step, component by component.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polynomials<'a> {
    /// The coordinates, four components in each entry.
    pub q: &'a [Four],
    /// All components after the coordinates.
    pub rates: &'a [Four],
    /// Number of coordinates.
    pub positions: usize,
}

impl Polynomials<'_> {
    /// Computes the state at θ. `ahead` = h θ is the time since the beginning.
    pub fn evaluate(&self, ahead: f64, theta: f64, out: &mut [f64]) {
        let (ahead, theta) = (Lanes::constant(ahead), Lanes::constant(theta));
        let at = |[begin, c @ .., last]: &Four| {
            let sum = c.iter().rev().fold(*last, |sum, c| c.plus_product(sum, theta));
            begin.plus_product(ahead, sum)
        };
        // the last block of q overwrites the first rates, which are stored afterwards
        for (first, all) in [(0, self.q), (self.positions, self.rates)] {
            let (mut blocks, mut all) = (out[first..].chunks_exact_mut(Lanes::WIDTH), all.iter());
            for (out, four) in (&mut blocks).zip(&mut all) {
                out.copy_from_slice(&at(four).to_array());
            }
            if let Some(four) = all.next() {
                store(at(four), blocks.into_remainder());
            }
        }
    }

    /// Computes the coefficients of θ … θ⁹ of each component, divided by h. `out` is row-major, (len of y) × 9.
    pub fn coefficients(&self, out: &mut [f64]) {
        let (of_q, of_rates) = out.split_at_mut(self.positions * HIGHEST);
        for (all, out) in [(self.q, of_q), (self.rates, of_rates)] {
            for (four, rows) in all.iter().zip(out.chunks_mut(Lanes::WIDTH * HIGHEST)) {
                for (lane, row) in rows.chunks_exact_mut(HIGHEST).enumerate() {
                    row.iter_mut().zip(&four[1..]).for_each(|(out, c)| *out = c.to_array()[lane]);
                }
            }
        }
    }
}

const _: () = assert!(HIGHEST == 9, "ten numbers of q");

/// Stores as many of the four numbers as `out` has room for.
#[inline(always)]
pub(super) fn store(x: Lanes, out: &mut [f64]) {
    match out.first_chunk_mut() {
        Some(four) => *four = x.to_array(),
        None => store_part(x, out),
    }
}

#[inline(never)]
fn store_part(x: Lanes, out: &mut [f64]) {
    out.iter_mut().zip(x.to_array()).for_each(|(out, x)| *out = x);
}
