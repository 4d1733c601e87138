//! The solution with the factors of a [`Saddle`]: forward through L, then back.

use super::block::{part, part_mut, subtract_products, subtract_times, subtract_transposed, Twin};
use super::pattern::{Below, Column, Earlier, Pattern, Touch};
use super::saddle::Saddle;
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
        for column in &pattern.columns {
            match column.size {
                1 => self.forward::<1>(column, f, g),
                2 => self.forward::<2>(column, f, g),
                _ => self.forward::<3>(column, f, g),
            }
        }
        self.substitute_back(pattern, x);
    }

    /// f ← Dw⁻¹ Lw⁻¹ f.
    #[inline(always)]
    pub(super) fn weigh(&self, pattern: &Pattern, x: &mut [S]) {
        assert_eq!(x.len(), pattern.n_unknowns() + pattern.n_rows(), "one right side for each row");
        let groups = x.chunks_exact_mut(3).zip(&self.weights).zip(&pattern.coupled);
        for ((x, Weight { inverse, shift }), coupled) in groups {
            if *coupled {
                x[2] = x[2] - shift[0] * x[0] - shift[1] * x[1];
            }
            for (x, inverse) in x.iter_mut().zip(inverse) {
                *x = *x * *inverse;
            }
        }
    }

    /// y = L⁻¹ (A W⁻¹ f - g) of one column, into g.
    fn forward<const N: usize>(&self, column: &Column, x: &[S], g: &mut [S]) {
        let mut y = part::<S, N>(g, column.row).map(|g| -g);
        for Touch { first, unknown, sign } in &column.touches {
            let x = part(x, *unknown);
            if N == 2 && *sign != 0.0 {
                self.arms[*first as usize].add_times(*sign, x, &mut y);
            } else {
                Twin::add_times(part(&self.u, *first), x, &mut y);
            }
        }
        for block in &column.earlier {
            block.subtract(block.size, &self.lower, g, &mut y);
        }
        let rows = part::<_, N>(&self.diagonal, column.row);
        for i in 1..N {
            for j in 0..i {
                y[i] -= rows[i].lower[j] * y[j];
            }
        }
        *part_mut(g, column.row) = y;
    }

    /// λ = L⁻ᵀ D⁻¹ y and x = Lw⁻ᵀ (Dw⁻¹ Lw⁻¹ f - Dw⁻¹ Uᵀ λ).
    #[inline(always)]
    pub(super) fn substitute_back(&self, pattern: &Pattern, x: &mut [S]) {
        let (f, g) = x.split_at_mut(pattern.n_unknowns());
        for column in pattern.columns.iter().rev() {
            if column.pins {
                self.back::<2, true>(column, f, g);
            } else {
                self.mixed_back(column, f, g);
            }
        }
        let groups = f.chunks_exact_mut(3).zip(&self.weights).zip(&pattern.coupled);
        for ((f, Weight { shift, .. }), coupled) in groups {
            if *coupled {
                f[0] -= shift[0] * f[2];
                f[1] -= shift[1] * f[2];
            }
        }
    }

    #[inline(never)]
    fn mixed_back(&self, column: &Column, x: &mut [S], g: &mut [S]) {
        match column.size {
            1 => self.back::<1, false>(column, x, g),
            2 => self.back::<2, false>(column, x, g),
            _ => self.back::<3, false>(column, x, g),
        }
    }

    /// λ of one column, into g, and its share of x; with `PINS` one of pins alone.
    #[inline(always)]
    fn back<const N: usize, const PINS: bool>(&self, column: &Column, x: &mut [S], g: &mut [S]) {
        let rows = part::<_, N>(&self.diagonal, column.row);
        let y = part::<S, N>(g, column.row);
        let mut lambda: [S; N] = std::array::from_fn(|i| y[i] * rows[i].inverse);
        for block in column.below.iter().rev() {
            match block.size {
                _ if PINS => self.pull::<2, N>(block, g, &mut lambda),
                1 => self.pull::<1, N>(block, g, &mut lambda),
                2 => self.pull::<2, N>(block, g, &mut lambda),
                _ => self.pull::<3, N>(block, g, &mut lambda),
            }
        }
        for j in (0..N).rev() {
            for i in j + 1..N {
                lambda[j] -= rows[i].lower[j] * lambda[i];
            }
        }
        *part_mut(g, column.row) = lambda;
        for Touch { first, unknown, sign } in &column.touches {
            let x = part_mut::<S, 3>(x, *unknown);
            if PINS || N == 2 && *sign != 0.0 {
                self.arms[*first as usize].subtract_transposed(*sign, &lambda, x);
            } else {
                let u = part::<Twin<S>, N>(&self.u, *first).iter().map(|u| u.scaled);
                subtract_transposed(x, u, &lambda);
            }
        }
    }

    /// λ -= Lᵀ λ' of a block whose rows are solved for in g.
    #[inline(always)]
    fn pull<const M: usize, const N: usize>(&self, block: &Below, g: &[S], lambda: &mut [S; N]) {
        subtract_products::<S, M, N>(lambda, part(&self.lower, block.block), part(g, block.row));
    }
}

impl Earlier {
    /// y -= L y' with the y' of the column where the block stands, of `size` rows.
    #[inline(always)]
    pub(super) fn subtract<S: Real, const N: usize>(
        &self,
        size: u32,
        lower: &[Twin<S>],
        g: &[S],
        y: &mut [S; N],
    ) {
        match size {
            1 => subtract_times::<S, N, 1>(y, part(lower, self.block), part(g, self.row)),
            2 => subtract_times::<S, N, 2>(y, part(lower, self.block), part(g, self.row)),
            _ => subtract_times::<S, N, 3>(y, part(lower, self.block), part(g, self.row)),
        }
    }
}
