//! The solution with the factors of a [`Saddle`]: forward through L, then back.

use super::block::{
    backward, columns, forward, part, part_mut, scaled, subtract_products, subtract_times,
};
use super::pattern::Pattern;
use super::saddle::Saddle;
use super::steps::{last, next, Ahead, Below, Left, Row};
use super::weight::Weight;
use crate::math::Real;

impl<S: Real> Saddle<S> {
    /// Solves in place: (f, g) becomes (x, λ), shape (unknowns + rows).
    ///
    /// # Panics
    /// If `x` has another length.
    pub fn solve(&self, pattern: &Pattern, x: &mut [S]) {
        self.weigh(pattern, x);
        let (f, g) = x.split_at_mut(pattern.n_unknowns());
        let starts = &pattern.steps.starts;
        self.right_sides(pattern, starts, f, g);
        let mut ahead = pattern.steps.ahead();
        for row in &pattern.steps.rows {
            match row.size {
                1 => self.forward::<1>(row, &mut ahead, g),
                2 => self.forward::<2>(row, &mut ahead, g),
                _ => self.forward::<3>(row, &mut ahead, g),
            }
        }
        self.substitute_back(pattern, g);
        self.spread_all(pattern, starts, f, g);
        self.unbend(pattern, x);
    }

    /// f ← Dw⁻¹ Lw⁻¹ f; with anchors, see there.
    ///
    /// # Panics
    /// If `x` has another length than unknowns and rows together.
    #[inline(always)]
    pub fn weigh(&self, pattern: &Pattern, x: &mut [S]) {
        assert_eq!(x.len(), pattern.n_unknowns() + pattern.n_rows(), "one right side for each row");
        self.anchor(pattern, x);
        self.weigh_others(pattern, x);
    }

    /// [`weigh`](Self::weigh) once all anchors [hold](super::Anchor::hold) their groups.
    #[inline(always)]
    pub fn weigh_others(&self, pattern: &Pattern, x: &mut [S]) {
        for &group in &pattern.coupled {
            let [x, y, angle] = part_mut(x, 3 * group);
            let Weight { shift, .. } = &self.weights[group as usize];
            *angle = *angle - shift[0] * *x - shift[1] * *y;
        }
        for &group in &pattern.loose {
            let x = part_mut::<S, 3>(x, 3 * group);
            let Weight { inverse, .. } = &self.weights[group as usize];
            // all at once: what is written as a pair of numbers is read as one
            *x = [x[0] * inverse[0], x[1] * inverse[1], x[2] * inverse[2]];
        }
    }

    /// x ← Lw⁻ᵀ x, and λ of anchors.
    #[inline(always)]
    pub fn unbend(&self, pattern: &Pattern, x: &mut [S]) {
        self.release(pattern, x);
        for &group in &pattern.coupled {
            let [x, y, angle] = part_mut(x, 3 * group);
            let Weight { shift, .. } = &self.weights[group as usize];
            *x -= shift[0] * *angle;
            *y -= shift[1] * *angle;
        }
    }

    /// y ← L⁻¹ y of one row block, or λ where nothing is below.
    fn forward<const N: usize>(&self, row: &Row, ahead: &mut Ahead<'_>, g: &mut [S]) {
        let mut y = *part::<S, N>(g, row.row);
        for left in next(&mut ahead.left, row.left) {
            match left.size {
                1 => self.subtract_known::<N, 1>(left, g, &mut y),
                2 => self.subtract_known::<N, 2>(left, g, &mut y),
                _ => self.subtract_known::<N, 3>(left, g, &mut y),
            }
        }
        let mut y = y.map(|y| [y]);
        forward(&self.factors, row.diagonal, &mut y);
        let mut y = y.map(|[y]| y);
        if row.below == 0 {
            let inverse = part::<S, N>(&self.factors, row.diagonal);
            y = std::array::from_fn(|i| y[i] * inverse[i]);
            backward(&self.factors, row.diagonal, &mut y);
        }
        *part_mut(g, row.row) = y;
    }

    /// y -= L y′ with the y′ of the column where the block stands.
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

    /// λ = L⁻ᵀ D⁻¹ y; columns with nothing below have it already.
    #[inline(always)]
    pub(super) fn substitute_back(&self, pattern: &Pattern, g: &mut [S]) {
        let mut below = &pattern.steps.below[..];
        for row in pattern.steps.rows.iter().rev() {
            if row.below == 0 {
                continue;
            }
            let below = last(&mut below, row.below);
            if row.pins {
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

    /// λ of one row block, into g; with `PINS` one of pins alone.
    #[inline(always)]
    fn back<const N: usize, const PINS: bool>(&self, row: &Row, below: &[Below], g: &mut [S]) {
        let inverse = part::<S, N>(&self.factors, row.diagonal);
        let y = part::<S, N>(g, row.row);
        let mut lambda: [S; N] = std::array::from_fn(|i| y[i] * inverse[i]);
        // the newest unknown is waited for last
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

    /// λ -= Lᵀ λ′ of a block whose rows are solved for in g.
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
