//! The layout of states with derivatives: one state after the other, or one part after the other for implicit methods.

use crate::equations::sensitivity::{Slope, ABREAST};
use crate::math::{Dual, Field, Real, ShortArray};

/// The columns of an implicit method.
pub(super) struct SlopeColumns {
    /// The magnitudes of the variables of all blocks.
    sizes: Vec<f64>,
    /// The lengths of the parts q, v, z and works of a column.
    parts: [usize; 4],
}

impl SlopeColumns {
    pub fn new(sizes: Vec<f64>, parts: [usize; 4]) -> Self {
        Self { sizes, parts }
    }

    /// The number of columns.
    pub fn count(&self) -> usize {
        1 + self.sizes.len()
    }

    /// The first column of each part.
    pub fn first<'x>(&self, parts: [&'x [f64]; 3]) -> [&'x [f64]; 3] {
        parts.each(|x| &x[..x.len() / self.count()])
    }

    /// Calls `put` with the place of each number in a row of whole states, with its place in the parts, and the magnitude
    /// of its variable.
    fn each_place(&self, mut put: impl FnMut(usize, usize, f64)) {
        let (count, n_y) = (self.count(), self.parts.iter().sum::<usize>());
        let mut first = 0;
        for width in self.parts {
            for (j, size) in std::iter::once(&1.0).chain(&self.sizes).enumerate() {
                (0..width)
                    .for_each(|k| put(j * n_y + first + k, count * first + j * width + k, *size));
            }
            first += width;
        }
    }

    /// A row of whole states, in parts.
    pub fn in_parts(&self, y: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; y.len()];
        self.each_place(|own, place, size| out[place] = y[own] * size);
        out
    }

    /// The inverse of [`in_parts`](Self::in_parts).
    pub fn in_states(&self, parts: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; parts.len()];
        self.each_place(|own, place, size| out[own] = parts[place] / size);
        out
    }

    /// A part with derivatives by the variables of block `b`.
    pub fn read(&self, b: usize, part: &[f64]) -> Vec<Slope> {
        let mut out = vec![Slope::constant(0.0); part.len() / self.count()];
        gather(out.len(), b, part, &mut out);
        for x in &mut out {
            let sizes = &self.sizes[ABREAST * b..];
            x.slope.iter_mut().zip(sizes).for_each(|(slope, size)| *slope /= size);
        }
        out
    }

    /// Writes numbers with derivatives by the variables of block `b` into a part.
    pub fn write(&self, b: usize, numbers: &[Slope], part: &mut [f64]) {
        let n = numbers.len();
        for (k, x) in numbers.iter().enumerate() {
            part[k] = x.value;
            for (place, slope) in x.slope.iter().enumerate() {
                let j = ABREAST * b + place;
                part[n * (1 + j) + k] = slope * self.sizes[j];
            }
        }
    }

    /// Changes each column of a vector with the parts (q, z, λ).
    pub fn each_column<F: Field>(
        &self,
        lengths: [usize; 3],
        x: &mut [F],
        mut f: impl FnMut(&mut [F]),
    ) {
        let mut column = Vec::new();
        for j in 0..self.count() {
            let mut first = 0;
            let places = lengths.each(|n| {
                let place = first + j * n;
                first += self.count() * n;
                place..place + n
            });
            column.clear();
            places.iter().for_each(|of| column.extend_from_slice(&x[of.clone()]));
            f(&mut column);
            let mut from = &column[..];
            for of in places {
                let (part, rest) = from.split_at(of.len());
                x[of].copy_from_slice(part);
                from = rest;
            }
        }
    }
}

/// Reads a state with derivatives.
pub(super) fn gather(n_y: usize, b: usize, y: &[f64], state: &mut [Slope]) {
    for (k, x) in state.iter_mut().enumerate() {
        let mut slope = [0.0; ABREAST];
        for (place, slope) in slope.iter_mut().enumerate() {
            *slope = y[n_y * (1 + ABREAST * b + place) + k];
        }
        *x = Dual { value: y[k], slope };
    }
}
