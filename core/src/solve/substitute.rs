//! The solution with the factors of a [`Saddle`]: forward substitution, back substitution, then the unknowns of the
//! groups.

use super::block::{
    add_transposed, backward, columns, forward, part, part_mut, scaled, subtract_products,
    subtract_times,
};
use super::pattern::Pattern;
use super::records::{last, next, Ahead, Below, Left, Row};
use super::saddle::Saddle;
use crate::math::{each, indexed, Real};

impl<S: Real> Saddle<S> {
    /// Solves in place: (f, g) becomes (x, λ), of length unknowns + rows.
    ///
    /// # Panics
    /// If `x` has another length.
    pub fn solve(&self, pattern: &Pattern, x: &mut [S]) {
        let (f, g) = self.begin(pattern, x);
        self.put_right_sides_of_pins(pattern, f, g);
        self.put_other_right_sides(pattern, f, g);
        let mut ahead = pattern.program.ahead();
        for row in &pattern.program.rows {
            match row.size {
                1 => self.forward::<1>(row, &mut ahead, g),
                2 => self.forward::<2>(row, &mut ahead, g),
                _ => self.forward::<3>(row, &mut ahead, g),
            }
        }
        self.substitute_back(pattern, g);
        self.update_groups(pattern, f, g);
    }

    /// Replaces f by x with λ = 0 in all rows but the condensed ones. Returns it with the right sides of the rows.
    ///
    /// # Panics
    /// If the length of `x` is not the number of unknowns and rows.
    pub(super) fn begin<'a>(
        &self,
        pattern: &Pattern,
        x: &'a mut [S],
    ) -> (&'a mut [S], &'a mut [S]) {
        assert_eq!(x.len(), pattern.n_unknowns() + pattern.n_rows(), "one right side for each row");
        let (f, g) = x.split_at_mut(pattern.n_unknowns());
        for (place, group) in pattern.condensed.iter().zip(&self.condensed) {
            let mass = &self.masses[place.group as usize];
            group.begin(place.sign, mass, part_mut(f, place.at), part_mut(g, place.row));
        }
        self.divide_by_masses(pattern, f);
        (f, g)
    }

    /// f ← W⁻¹ f for all groups that are not condensed.
    #[inline(always)]
    pub fn divide_by_masses(&self, pattern: &Pattern, f: &mut [S]) {
        for &group in &pattern.diagonal {
            let x = part_mut::<S, 3>(f, pattern.starts[group as usize]);
            let mass = &self.masses[group as usize];
            let ([d0, d1], d2) = (mass.translation, mass.along);
            // in one assignment: numbers written as a pair are read as one
            *x = [x[0] * d0, x[1] * d1, x[2] * d2];
        }
        for &group in &pattern.coupled {
            let x = part_mut::<S, 3>(f, pattern.starts[group as usize]);
            *x = self.masses[group as usize].times(x);
        }
    }

    /// x -= W⁻¹ Aᵀ λ, then computes λ of the condensed rows.
    #[inline(always)]
    pub(super) fn update_groups(&self, pattern: &Pattern, x: &mut [S], g: &mut [S]) {
        self.subtract_other_rows(pattern, x, g);
        self.subtract_pin_rows(pattern, x, g);
        let (mut pins, mut others) = (&pattern.loads.pins[..], &pattern.loads.others[..]);
        for (place, group) in pattern.condensed.iter().zip(&self.condensed) {
            let mut sum = [S::zero(); 3];
            for load in next(&mut pins, place.pins) {
                let (sign, lambda) = (S::constant(load.sign), part::<S, 2>(g, load.row));
                for i in 0..2 {
                    sum[i] = sum[i].plus_product(sign, lambda[i]);
                }
            }
            for load in next(&mut others, place.others) {
                let rows = &self.entries[load.entry as usize..][..load.size as usize];
                add_transposed(rows, &g[load.row as usize..], &mut sum);
            }
            group.finish(place.sign, part(x, place.at), &sum, part_mut(g, place.row));
        }
    }

    /// y ← L⁻¹ y for one row block. Computes λ if no block is below.
    fn forward<const N: usize>(&self, row: &Row, ahead: &mut Ahead<'_>, g: &mut [S]) {
        let mut y = *part::<S, N>(g, row.row);
        for left in next(&mut ahead.left, row.left) {
            match left.size {
                1 => self.subtract_known::<N, 1>(left, g, &mut y),
                2 => self.subtract_known::<N, 2>(left, g, &mut y),
                _ => self.subtract_known::<N, 3>(left, g, &mut y),
            }
        }
        let mut y = each(y, |y| [y]);
        forward(&self.factors, row.diagonal, &mut y);
        let mut y = each(y, |[y]| y);
        if row.below == 0 {
            let inverse = part::<S, N>(&self.factors, row.diagonal);
            y = indexed(|i| y[i] * inverse[i]);
            backward(&self.factors, row.diagonal, &mut y);
        }
        *part_mut(g, row.row) = y;
    }

    /// y -= L y′ with y′ of the column of the block.
    #[inline(always)]
    fn subtract_known<const N: usize, const K: usize>(
        &self,
        &Left { block, diagonal, row, .. }: &Left,
        g: &[S],
        y: &mut [S; N],
    ) {
        let plain = columns::<S, N, K>(&self.factors, block);
        subtract_times(y, &scaled(&plain, part(&self.factors, diagonal)), part::<S, K>(g, row));
    }

    /// λ = L⁻ᵀ D⁻¹ y. Columns with no block below already contain λ.
    #[inline(always)]
    pub(super) fn substitute_back(&self, pattern: &Pattern, g: &mut [S]) {
        let mut below = &pattern.program.below[..];
        for row in pattern.program.rows.iter().rev() {
            if row.below == 0 {
                continue;
            }
            let below = last(&mut below, row.below);
            if row.pins_below {
                self.back::<2, true>(row, below, g);
            } else {
                self.mixed_back(row, below, g);
            }
        }
    }

    #[inline(never)]
    fn mixed_back(&self, row: &Row, below: &[Below], g: &mut [S]) {
        match row.size {
            1 => self.back::<1, false>(row, below, g),
            2 => self.back::<2, false>(row, below, g),
            _ => self.back::<3, false>(row, below, g),
        }
    }

    /// Computes λ of one row block into g. With `PINS` it consists of pins only.
    #[inline(always)]
    fn back<const N: usize, const PINS: bool>(&self, row: &Row, below: &[Below], g: &mut [S]) {
        let inverse = part::<S, N>(&self.factors, row.diagonal);
        let y = part::<S, N>(g, row.row);
        let mut lambda: [S; N] = indexed(|i| y[i] * inverse[i]);
        // the most recent unknown comes last, to hide its latency
        for block in below.iter().rev() {
            match block.size {
                _ if PINS => self.pull::<2, N>(block, inverse, g, &mut lambda),
                1 => self.pull::<1, N>(block, inverse, g, &mut lambda),
                2 => self.pull::<2, N>(block, inverse, g, &mut lambda),
                _ => self.pull::<3, N>(block, inverse, g, &mut lambda),
            }
        }
        backward(&self.factors, row.diagonal, &mut lambda);
        *part_mut(g, row.row) = lambda;
    }

    /// λ -= Lᵀ λ′ with λ′ of a block, already solved for, in g.
    #[inline(always)]
    fn pull<const M: usize, const N: usize>(
        &self,
        block: &Below,
        inverse: &[S; N],
        g: &[S],
        lambda: &mut [S; N],
    ) {
        let plain = columns::<S, M, N>(&self.factors, block.block);
        subtract_products(lambda, &scaled(&plain, inverse), part(g, block.row));
    }
}
