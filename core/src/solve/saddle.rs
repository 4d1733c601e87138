//! Solving [W Aᵀ; A -μI] [x; λ] = [f; g] by its Schur complement, block by block on a static pattern.
//!
//! The complement is the Gram matrix S = A W⁻¹ Aᵀ + μ I of the rows of A, in the scalar product of W⁻¹:
//!
//! ```text
//! S λ = A W⁻¹ f - g,   x = W⁻¹ (f - Aᵀ λ),   S = L D Lᵀ
//! ```
//!
//! W enters as its own factors, W = Lw Dw Lwᵀ group by group: with U = A Lw⁻ᵀ, S = U Dw⁻¹ Uᵀ is a sum of
//! products without cancellation on its diagonal. A pivot d of S is judged by that sum: it is refused
//! when d ≤ [`PIVOT_TOLERANCE`] S_kk. A dependent row of A leaves a ratio near 1e-16 whatever its scale;
//! a mechanism near a singular position a small one, which [`Saddle::cancellation`] shows.

use super::block::{
    add, factorise, part, part_mut, subtract, subtract_times, subtract_transposed, Diagonal, Row,
};
use super::pattern::{Below, Column, Earlier, Pattern, Touch};
use super::weight::{above_zero, check, Dependent, Weight};
use crate::math::Real;

/// Smallest ratio of a pivot to the diagonal entry it was cancelled from that is still trusted.
pub const PIVOT_TOLERANCE: f64 = 1e-13;

/// A matrix and its factors; all memory is taken in [`Saddle::new`].
///
/// Between a factorisation and the solutions that use it the matrix must stay as it is.
#[derive(Clone, Debug)]
pub struct Saddle<S> {
    /// W, one for each group.
    pub weights: Vec<Weight<S>>,
    /// Entries of A in rows of three, as the pattern places them.
    pub entries: Vec<[S; 3]>,
    /// μ, one for each row.
    pub damping: Vec<S>,
    /// Smallest ratio of a pivot to S_kk that is accepted; [`PIVOT_TOLERANCE`] at first.
    pub(super) least: f64,
    /// Part of S_kk that is added to it, 0 at first.
    pub(super) ridge: f64,
    /// Rows of U, as those of A are stored.
    u: Vec<Row<S>>,
    /// Rows of the diagonal blocks of L.
    diagonal: Vec<Pivot<S>>,
    /// Rows of the blocks of L D and of L below the diagonal.
    lower: Vec<Row<S>>,
}

/// One row of a diagonal block.
#[derive(Clone, Copy, Debug)]
struct Pivot<S> {
    /// L left of the diagonal, within the block.
    lower: [S; 3],
    /// 1 / d.
    inverse: S,
    /// S_kk.
    magnitude: S,
}

impl<S: Real> Saddle<S> {
    /// Memory for matrices of the given pattern: W = I, A = 0, μ = 0.
    pub fn new(pattern: &Pattern) -> Self {
        let (zero, none) = (S::zero(), [S::zero(); 3]);
        let weight = Weight { inverse: [S::one(); 3], shift: [zero; 2] };
        let row = Row { plain: none, scaled: none };
        Self {
            weights: vec![weight; pattern.coupled.len()],
            entries: vec![none; pattern.owners.len()],
            damping: vec![zero; pattern.n_rows],
            least: PIVOT_TOLERANCE,
            ridge: 0.0,
            u: vec![row; pattern.owners.len()],
            diagonal: vec![Pivot { lower: none, inverse: zero, magnitude: zero }; pattern.n_rows],
            lower: vec![row; pattern.n_lower],
        }
    }

    /// Factorises.
    ///
    /// # Errors
    /// The first pivot that is not positive, not finite or cancelled below [`PIVOT_TOLERANCE`] (in any
    /// lane); the factor must then not be used.
    ///
    /// # Panics
    /// If the matrix is of another pattern.
    pub fn factor(&mut self, pattern: &Pattern) -> Result<(), Dependent> {
        self.transform(pattern)?;
        self.eliminate::<false>(pattern, &mut [])
    }

    /// Factorises as [`factor`](Self::factor) and solves as [`solve`](Self::solve). The right side is
    /// eliminated beside the blocks, which hides that half of the solution behind their latency.
    ///
    /// # Errors
    /// As [`factor`](Self::factor); `x` is then lost.
    ///
    /// # Panics
    /// As [`factor`](Self::factor) and [`solve`](Self::solve).
    pub fn factor_and_solve(&mut self, pattern: &Pattern, x: &mut [S]) -> Result<(), Dependent> {
        self.transform(pattern)?;
        self.decouple(pattern, x);
        self.eliminate::<true>(pattern, x)?;
        self.substitute_back(pattern, x);
        Ok(())
    }

    /// Solves in place: (f, g) becomes (x, λ), shape (unknowns + rows).
    ///
    /// # Panics
    /// If `x` has another length.
    pub fn solve(&self, pattern: &Pattern, x: &mut [S]) {
        self.decouple(pattern, x);
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

    /// The row whose pivot was cancelled most, and its ratio d / S_kk: 1 means nothing was lost, 1e-10
    /// that ten digits were. `None` without rows.
    pub fn cancellation(&self) -> Option<(usize, f64)> {
        let ratios = self.diagonal.iter().map(|p| S::one() / (p.inverse * p.magnitude));
        ratios.map(S::least_magnitude).enumerate().min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// f ← Lw⁻¹ f.
    #[inline(always)]
    fn decouple(&self, pattern: &Pattern, x: &mut [S]) {
        assert_eq!(x.len(), pattern.n_unknowns() + pattern.n_rows, "one right side for each row");
        for ((x, weight), coupled) in x.chunks_exact_mut(3).zip(&self.weights).zip(&pattern.coupled)
        {
            if *coupled {
                x[2] = x[2] - weight.shift[0] * x[0] - weight.shift[1] * x[1];
            }
        }
    }

    /// U = A Lw⁻ᵀ and U Dw⁻¹.
    #[inline(always)]
    fn transform(&mut self, pattern: &Pattern) -> Result<(), Dependent> {
        assert_eq!(self.entries.len(), pattern.owners.len(), "a matrix of this pattern");
        check(&self.weights)?;
        for ((row, owner), u) in self.entries.iter().zip(&pattern.owners).zip(&mut self.u) {
            let Weight { inverse, shift } = &self.weights[owner.group as usize];
            let mut row = *row;
            if owner.coupled {
                row[2] = row[2] - shift[0] * row[0] - shift[1] * row[1];
            }
            u.plain = row;
            u.scaled = [row[0] * inverse[0], row[1] * inverse[1], row[2] * inverse[2]];
        }
        Ok(())
    }

    /// Column by column; with `RHS` the right side as well.
    #[inline(always)]
    fn eliminate<const RHS: bool>(
        &mut self,
        pattern: &Pattern,
        x: &mut [S],
    ) -> Result<(), Dependent> {
        let (f, g) = x.split_at_mut(if RHS { pattern.n_unknowns() } else { 0 });
        for column in &pattern.columns {
            match column.size {
                1 => self.column::<1, RHS>(column, f, g)?,
                2 => self.column::<2, RHS>(column, f, g)?,
                _ => self.column::<3, RHS>(column, f, g)?,
            }
        }
        Ok(())
    }

    /// One column of L, of N rows and columns on the diagonal.
    #[inline(always)]
    fn column<const N: usize, const RHS: bool>(
        &mut self,
        column: &Column,
        f: &[S],
        g: &mut [S],
    ) -> Result<(), Dependent> {
        let mut s = [[S::zero(); N]; N];
        for (i, mu) in part::<S, N>(&self.damping, column.row).iter().enumerate() {
            s[i][i] = *mu;
        }
        let mut y = if RHS { part(g, column.row).map(|g: S| -g) } else { [S::zero(); N] };
        for touch in &column.touches {
            let u = part::<_, N>(&self.u, touch.first);
            add::<S, N, N, 3>(&mut s, u, u);
            if RHS {
                load(u, part(f, touch.unknown), &mut y);
            }
        }
        let magnitude: [S; N] = std::array::from_fn(|i| s[i][i]);
        for (i, magnitude) in magnitude.iter().enumerate() {
            s[i][i] += *magnitude * S::constant(self.ridge);
        }
        for block in &column.earlier {
            self.subtract::<N, N>([block.block, block.block], block.size, &mut s);
            if RHS {
                block.subtract(&self.lower, g, &mut y);
            }
        }
        let diagonal = factorise(s);
        if RHS {
            diagonal.forward(&mut y);
            *part_mut(g, column.row) = y;
        }
        self.keep(column, &diagonal, magnitude)?;
        for block in &column.below {
            match block.size {
                1 => self.below::<1, N>(block, &diagonal),
                2 => self.below::<2, N>(block, &diagonal),
                _ => self.below::<3, N>(block, &diagonal),
            }
        }
        Ok(())
    }

    /// Judges and stores a diagonal block.
    #[inline(always)]
    fn keep<const N: usize>(
        &mut self,
        column: &Column,
        diagonal: &Diagonal<S, N>,
        magnitude: [S; N],
    ) -> Result<(), Dependent> {
        let rows = part_mut::<_, N>(&mut self.diagonal, column.row);
        for (i, row) in rows.iter_mut().enumerate() {
            let margin = diagonal.pivot[i] - magnitude[i] * S::constant(self.least);
            if !(above_zero(margin) && diagonal.inverse[i].is_finite()) {
                return Err(Dependent::Row(column.row as usize + i));
            }
            row.inverse = diagonal.inverse[i];
            row.magnitude = magnitude[i];
            row.lower[..i].copy_from_slice(&diagonal.lower[i][..i]);
        }
        Ok(())
    }

    /// One block below the diagonal: S_ik - Σ L D Lᵀ of earlier columns, then · L_kk⁻ᵀ and · D⁻¹.
    #[inline(always)]
    fn below<const M: usize, const N: usize>(&mut self, block: &Below, diagonal: &Diagonal<S, N>) {
        let mut s = [[S::zero(); N]; M];
        for &[own, other] in &block.pairs {
            add::<S, M, N, 3>(&mut s, part(&self.u, own), part(&self.u, other));
        }
        for update in &block.updates {
            self.subtract::<M, N>(update.blocks, update.size, &mut s);
        }
        let rows = part_mut::<_, M>(&mut self.lower, block.block);
        for (s, row) in s.iter_mut().zip(rows) {
            diagonal.forward(s);
            row.plain[..N].copy_from_slice(s);
            for ((scaled, s), inverse) in row.scaled.iter_mut().zip(s).zip(&diagonal.inverse) {
                *scaled = *s * *inverse;
            }
        }
    }

    /// s -= (L D) Lᵀ with two blocks of one earlier column.
    #[inline(always)]
    fn subtract<const M: usize, const N: usize>(
        &self,
        [left, right]: [u32; 2],
        size: u32,
        s: &mut [[S; N]; M],
    ) {
        let (left, right) = (part(&self.lower, left), part(&self.lower, right));
        match size {
            1 => subtract::<S, M, N, 1>(s, left, right),
            2 => subtract::<S, M, N, 2>(s, left, right),
            _ => subtract::<S, M, N, 3>(s, left, right),
        }
    }

    /// y = L⁻¹ (A W⁻¹ f - g) of one column, into g.
    fn forward<const N: usize>(&self, column: &Column, f: &[S], g: &mut [S]) {
        let mut y = part::<S, N>(g, column.row).map(|g| -g);
        for touch in &column.touches {
            load(part(&self.u, touch.first), part(f, touch.unknown), &mut y);
        }
        for block in &column.earlier {
            block.subtract(&self.lower, g, &mut y);
        }
        let rows = part::<_, N>(&self.diagonal, column.row);
        for i in 1..N {
            for j in 0..i {
                y[i] -= rows[i].lower[j] * y[j];
            }
        }
        *part_mut(g, column.row) = y;
    }

    /// λ = L⁻ᵀ D⁻¹ y and x = W⁻¹ (f - Aᵀ λ).
    #[inline(always)]
    fn substitute_back(&self, pattern: &Pattern, x: &mut [S]) {
        let (f, g) = x.split_at_mut(pattern.n_unknowns());
        for column in pattern.columns.iter().rev() {
            match column.size {
                1 => self.back::<1>(column, f, g),
                2 => self.back::<2>(column, f, g),
                _ => self.back::<3>(column, f, g),
            }
        }
        let groups = f.chunks_exact_mut(3).zip(&self.weights).zip(&pattern.coupled);
        for ((f, Weight { inverse, shift }), coupled) in groups {
            for (f, inverse) in f.iter_mut().zip(inverse) {
                *f = *f * *inverse;
            }
            if *coupled {
                f[0] -= shift[0] * f[2];
                f[1] -= shift[1] * f[2];
            }
        }
    }

    /// λ of one column, into g, and its share of f - Aᵀ λ.
    #[inline(always)]
    fn back<const N: usize>(&self, column: &Column, f: &mut [S], g: &mut [S]) {
        let rows = part::<_, N>(&self.diagonal, column.row);
        let y = part::<S, N>(g, column.row);
        let mut lambda: [S; N] = std::array::from_fn(|i| y[i] * rows[i].inverse);
        for block in column.below.iter().rev() {
            match block.size {
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
        for Touch { first, unknown } in &column.touches {
            let u = part::<Row<S>, N>(&self.u, *first).iter().map(|u| u.plain);
            subtract_transposed(part_mut::<S, 3>(f, *unknown), u, &lambda);
        }
    }

    /// λ -= Lᵀ λ' of a block whose rows are solved for in g.
    #[inline(always)]
    fn pull<const M: usize, const N: usize>(&self, block: &Below, g: &[S], lambda: &mut [S; N]) {
        let rows = part::<Row<S>, M>(&self.lower, block.block).iter().map(|row| row.scaled);
        subtract_transposed(lambda, rows, part::<S, M>(g, block.row));
    }
}

/// y += U Dw⁻¹ f in one group.
#[inline(always)]
fn load<S: Real, const N: usize>(u: &[Row<S>; N], f: &[S; 3], y: &mut [S; N]) {
    for (y, Row { scaled: w, .. }) in y.iter_mut().zip(u) {
        *y += w[0] * f[0] + w[1] * f[1] + w[2] * f[2];
    }
}

impl Earlier {
    /// y -= L y' with the y' of the column where the block stands.
    #[inline(always)]
    fn subtract<S: Real, const N: usize>(&self, lower: &[Row<S>], g: &[S], y: &mut [S; N]) {
        let block = part::<_, N>(lower, self.block);
        match self.size {
            1 => subtract_times(y, block, part::<S, 1>(g, self.row)),
            2 => subtract_times(y, block, part::<S, 2>(g, self.row)),
            _ => subtract_times(y, block, part::<S, 3>(g, self.row)),
        }
    }
}
