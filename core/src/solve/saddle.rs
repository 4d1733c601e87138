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
    add, backward, factorise, part, part_mut, rows, subtract, subtract_times, subtract_transposed,
    take, take_back, Diagonal,
};
use super::pattern::{Below, Column, Earlier, Pattern, Touch, Update};
use crate::math::Real;

/// Smallest ratio of a pivot to the diagonal entry it was cancelled from that is still trusted.
pub const PIVOT_TOLERANCE: f64 = 1e-13;

/// The block of W of one group, [d₀ 0 b₀; 0 d₁ b₁; b₀ b₁ d₂], by its factors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weight<S = f64> {
    /// 1/d₀, 1/d₁ and 1/(d₂ - b₀²/d₀ - b₁²/d₁).
    pub inverse: [S; 3],
    /// b₀/d₀ and b₁/d₁; not read for groups that are not coupled.
    pub shift: [S; 2],
}

/// The numbers of a matrix.
#[derive(Clone, Copy, Debug)]
pub struct Values<'a, S> {
    /// W, one for each group.
    pub weights: &'a [Weight<S>],
    /// Entries of A, as the pattern places them.
    pub entries: &'a [S],
    /// μ, one for each row.
    pub damping: &'a [S],
}

/// What cannot be eliminated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dependent {
    /// A row of A that depends on the others.
    Row(usize),
    /// An unknown whose pivot in W is not positive.
    Column(usize),
}

/// The factors; all memory is taken in [`Saddle::new`].
#[derive(Clone, Debug)]
pub struct Saddle<S> {
    weights: Vec<Weight<S>>,
    /// Rows of U and of U Dw⁻¹, three entries each, as those of A are stored.
    u: Vec<[S; 3]>,
    w: Vec<[S; 3]>,
    /// Triangles of the diagonal blocks of L, one row for each row of S.
    triangle: Vec<[S; 3]>,
    /// 1 / D, and S_kk, by row.
    inverse: Vec<S>,
    magnitude: Vec<S>,
    /// Blocks of L below the diagonal, and those of L D.
    lower: Vec<[S; 3]>,
    unscaled: Vec<[S; 3]>,
}

impl<S: Real> Saddle<S> {
    /// Memory for factors of the given pattern.
    pub fn new(pattern: &Pattern) -> Self {
        let (zero, none) = (S::zero(), [S::zero(); 3]);
        let (n, m) = (pattern.group.len(), pattern.n_rows);
        Self {
            weights: vec![Weight { inverse: none, shift: [zero; 2] }; pattern.coupled.len()],
            u: vec![none; n],
            w: vec![none; n],
            triangle: vec![none; m],
            inverse: vec![zero; m],
            magnitude: vec![zero; m],
            lower: vec![none; pattern.n_lower],
            unscaled: vec![none; pattern.n_lower],
        }
    }

    /// Factorises.
    ///
    /// # Errors
    /// The first pivot that is not positive, not finite or cancelled below [`PIVOT_TOLERANCE`] (in any
    /// lane); the factor must then not be used.
    ///
    /// # Panics
    /// If the numbers do not fit the pattern, or the factor is of another pattern.
    pub fn factor(&mut self, pattern: &Pattern, values: Values<'_, S>) -> Result<(), Dependent> {
        self.eliminate::<false>(pattern, values, &mut [])
    }

    /// Factorises as [`factor`](Self::factor) and solves as [`solve`](Self::solve). The right side is
    /// eliminated beside the blocks, which hides that half of the solution behind their latency.
    ///
    /// # Errors
    /// As [`factor`](Self::factor); `x` is then lost.
    ///
    /// # Panics
    /// As [`factor`](Self::factor) and [`solve`](Self::solve).
    pub fn factor_and_solve(
        &mut self,
        pattern: &Pattern,
        values: Values<'_, S>,
        x: &mut [S],
    ) -> Result<(), Dependent> {
        self.decouple(pattern, values.weights, x);
        self.eliminate::<true>(pattern, values, x)?;
        self.substitute_back(pattern, x);
        Ok(())
    }

    /// Solves in place: (f, g) becomes (x, λ), shape (unknowns + rows).
    ///
    /// # Panics
    /// If `x` has another length.
    pub fn solve(&self, pattern: &Pattern, x: &mut [S]) {
        self.decouple(pattern, &self.weights, x);
        let mut sweep = Sweep::new(pattern, &self.u, &self.w);
        let (f, g) = x.split_at_mut(pattern.n_unknowns());
        for column in &pattern.columns {
            match column.size {
                1 => self.forward::<1>(&mut sweep, column, f, g),
                2 => self.forward::<2>(&mut sweep, column, f, g),
                _ => self.forward::<3>(&mut sweep, column, f, g),
            }
        }
        self.substitute_back(pattern, x);
    }

    /// The row whose pivot was cancelled most, and its ratio d / S_kk: 1 means nothing was lost, 1e-10
    /// that ten digits were. `None` without rows.
    pub fn cancellation(&self) -> Option<(usize, f64)> {
        let ratios = self.inverse.iter().zip(&self.magnitude).map(|(&i, &m)| S::one() / (i * m));
        ratios.map(S::least_magnitude).enumerate().min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// f ← Lw⁻¹ f.
    #[inline(always)]
    fn decouple(&self, pattern: &Pattern, weights: &[Weight<S>], x: &mut [S]) {
        assert_eq!(x.len(), pattern.n_unknowns() + pattern.n_rows, "one right side for each row");
        for ((x, weight), coupled) in x.chunks_exact_mut(3).zip(weights).zip(&pattern.coupled) {
            if *coupled {
                x[2] = x[2] - weight.shift[0] * x[0] - weight.shift[1] * x[1];
            }
        }
    }

    /// U = A Lw⁻ᵀ and U Dw⁻¹.
    #[inline(always)]
    fn transform(&mut self, pattern: &Pattern, values: &Values<'_, S>) -> Result<(), Dependent> {
        self.weights.copy_from_slice(values.weights);
        check(&self.weights)?;
        let entries = values.entries.chunks_exact(3).zip(&pattern.group);
        for ((entries, &group), (u, w)) in entries.zip(self.u.iter_mut().zip(&mut self.w)) {
            let weight = &self.weights[group as usize];
            let mut row = [entries[0], entries[1], entries[2]];
            if pattern.coupled[group as usize] {
                row[2] = row[2] - weight.shift[0] * row[0] - weight.shift[1] * row[1];
            }
            let d = &weight.inverse;
            *w = [row[0] * d[0], row[1] * d[1], row[2] * d[2]];
            *u = row;
        }
        Ok(())
    }

    /// Column by column; with `RHS` the right side as well.
    #[inline(always)]
    fn eliminate<const RHS: bool>(
        &mut self,
        pattern: &Pattern,
        values: Values<'_, S>,
        x: &mut [S],
    ) -> Result<(), Dependent> {
        assert_eq!(values.entries.len(), 3 * pattern.group.len(), "the entries of the pattern");
        assert_eq!(self.lower.len(), pattern.n_lower, "a factor of this pattern");
        self.transform(pattern, &values)?;
        let mut factors = Factors {
            sweep: Sweep::new(pattern, &self.u, &self.w),
            triangle: &mut self.triangle,
            inverse: &mut self.inverse,
            magnitude: &mut self.magnitude,
            lower: &mut self.lower,
            unscaled: &mut self.unscaled,
            end: 0,
        };
        let (f, g) = x.split_at_mut(if RHS { pattern.n_unknowns() } else { 0 });
        for column in &pattern.columns {
            match column.size {
                1 => factors.column::<1, RHS>(column, values.damping, f, g)?,
                2 => factors.column::<2, RHS>(column, values.damping, f, g)?,
                _ => factors.column::<3, RHS>(column, values.damping, f, g)?,
            }
        }
        Ok(())
    }

    /// y = L⁻¹ (A W⁻¹ f - g) of one column, into g.
    fn forward<const N: usize>(
        &self,
        sweep: &mut Sweep<'_, S>,
        column: &Column,
        f: &[S],
        g: &mut [S],
    ) {
        let mut y = part::<S, N>(g, column.row).map(|g| -g);
        for touch in take(&mut sweep.touches, column.touches) {
            sweep.load(touch, f, &mut y);
        }
        for block in take(&mut sweep.earlier, column.earlier) {
            block.subtract(&self.lower, g, &mut y);
        }
        let triangle = rows::<S, N>(&self.triangle, column.row);
        for i in 1..N {
            for j in 0..i {
                y[i] -= triangle[i][j] * y[j];
            }
        }
        *part_mut(g, column.row) = y;
    }

    /// λ = L⁻ᵀ D⁻¹ y and x = W⁻¹ (f - Aᵀ λ).
    #[inline(always)]
    fn substitute_back(&self, pattern: &Pattern, x: &mut [S]) {
        let (f, g) = x.split_at_mut(pattern.n_unknowns());
        let (mut touches, mut below) = (&pattern.touches[..], &pattern.below[..]);
        let mut end = pattern.n_lower as u32;
        for column in pattern.columns.iter().rev() {
            let touches = take_back(&mut touches, column.touches);
            let below = take_back(&mut below, column.below);
            match column.size {
                1 => self.back::<1>(column, touches, below, &mut end, f, g),
                2 => self.back::<2>(column, touches, below, &mut end, f, g),
                _ => self.back::<3>(column, touches, below, &mut end, f, g),
            }
        }
        for ((f, weight), coupled) in f.chunks_exact_mut(3).zip(&self.weights).zip(&pattern.coupled)
        {
            for (f, inverse) in f.iter_mut().zip(&weight.inverse) {
                *f = *f * *inverse;
            }
            if *coupled {
                f[0] -= weight.shift[0] * f[2];
                f[1] -= weight.shift[1] * f[2];
            }
        }
    }

    #[inline(always)]
    fn back<const N: usize>(
        &self,
        column: &Column,
        touches: &[Touch],
        below: &[Below],
        end: &mut u32,
        f: &mut [S],
        g: &mut [S],
    ) {
        let (y, inverse) = (part::<S, N>(g, column.row), part::<S, N>(&self.inverse, column.row));
        let mut lambda: [S; N] = std::array::from_fn(|i| y[i] * inverse[i]);
        for block in below.iter().rev() {
            *end -= block.size;
            match block.size {
                1 => self.pull::<1, N>(*end, block.row, g, &mut lambda),
                2 => self.pull::<2, N>(*end, block.row, g, &mut lambda),
                _ => self.pull::<3, N>(*end, block.row, g, &mut lambda),
            }
        }
        backward(rows(&self.triangle, column.row), &mut lambda);
        *part_mut(g, column.row) = lambda;
        for touch in touches {
            let f = part_mut::<S, 3>(f, touch.unknown);
            subtract_transposed(f, rows::<S, N>(&self.u, touch.first), &lambda);
        }
    }

    /// λ -= Lᵀ λ' of the block of L at `first`, whose rows are solved for in g.
    #[inline(always)]
    fn pull<const M: usize, const N: usize>(
        &self,
        first: u32,
        row: u32,
        g: &[S],
        lambda: &mut [S; N],
    ) {
        subtract_transposed(lambda, rows::<S, M>(&self.lower, first), part(g, row));
    }
}

/// Whether every pivot of W is positive, in every lane.
#[inline(always)]
fn check<S: Real>(weights: &[Weight<S>]) -> Result<(), Dependent> {
    let good = |i: &S| above_zero(*i) && i.is_finite();
    if weights.iter().all(|w| w.inverse.iter().all(good)) {
        return Ok(());
    }
    let bad = weights.iter().flat_map(|w| &w.inverse).position(|i| !good(i));
    bad.map_or(Ok(()), |column| Err(Dependent::Column(column)))
}

/// x > 0 in every lane; NaN is not.
#[inline(always)]
fn above_zero<S: Real>(x: S) -> bool {
    S::select(x, S::one(), S::zero()).least_magnitude() > 0.0
}

/// What remains of the lists of a pattern while columns take their share off the front.
struct Sweep<'a, S> {
    touches: &'a [Touch],
    earlier: &'a [Earlier],
    below: &'a [Below],
    pairs: &'a [[u32; 2]],
    updates: &'a [Update],
    u: &'a [[S; 3]],
    w: &'a [[S; 3]],
}

impl<'a, S: Real> Sweep<'a, S> {
    fn new(pattern: &'a Pattern, u: &'a [[S; 3]], w: &'a [[S; 3]]) -> Self {
        Self {
            touches: &pattern.touches,
            earlier: &pattern.earlier,
            below: &pattern.below,
            pairs: &pattern.pairs,
            updates: &pattern.updates,
            u,
            w,
        }
    }

    /// y += U Dw⁻¹ f in one group.
    #[inline(always)]
    fn load<const N: usize>(&self, touch: &Touch, f: &[S], y: &mut [S; N]) {
        let f = part::<S, 3>(f, touch.unknown);
        for (y, w) in y.iter_mut().zip(rows::<S, N>(self.w, touch.first)) {
            *y += w[0] * f[0] + w[1] * f[1] + w[2] * f[2];
        }
    }
}

impl Earlier {
    /// y -= L y' with the y' of the column where the block stands.
    #[inline(always)]
    fn subtract<S: Real, const N: usize>(&self, lower: &[[S; 3]], g: &[S], y: &mut [S; N]) {
        let block = rows::<S, N>(lower, self.block);
        match self.size {
            1 => subtract_times(y, block, part::<S, 1>(g, self.row)),
            2 => subtract_times(y, block, part::<S, 2>(g, self.row)),
            _ => subtract_times(y, block, part::<S, 3>(g, self.row)),
        }
    }
}

/// The factors under construction.
struct Factors<'a, S> {
    sweep: Sweep<'a, S>,
    triangle: &'a mut [[S; 3]],
    inverse: &'a mut [S],
    magnitude: &'a mut [S],
    lower: &'a mut [[S; 3]],
    unscaled: &'a mut [[S; 3]],
    /// Rows of L made so far.
    end: usize,
}

impl<S: Real> Factors<'_, S> {
    /// One column of L, of N rows and columns on the diagonal.
    #[inline(always)]
    fn column<const N: usize, const RHS: bool>(
        &mut self,
        column: &Column,
        damping: &[S],
        f: &[S],
        g: &mut [S],
    ) -> Result<(), Dependent> {
        let damping = part::<S, N>(damping, column.row);
        let mut s: [[S; N]; N] = std::array::from_fn(|i| {
            std::array::from_fn(|j| if i == j { damping[i] } else { S::zero() })
        });
        let mut y = [S::zero(); N];
        if RHS {
            y = part::<S, N>(g, column.row).map(|g| -g);
        }
        for touch in take(&mut self.sweep.touches, column.touches) {
            let (u, w) = (rows::<S, N>(self.sweep.u, touch.first), rows(self.sweep.w, touch.first));
            add::<S, N, N, 3>(&mut s, u, w);
            if RHS {
                self.sweep.load(touch, f, &mut y);
            }
        }
        let magnitude: [S; N] = std::array::from_fn(|i| s[i][i]);
        for block in take(&mut self.sweep.earlier, column.earlier) {
            self.subtract::<N, N>([block.block, block.block], block.size, &mut s);
            if RHS {
                block.subtract(self.lower, g, &mut y);
            }
        }
        let diagonal = factorise(s);
        if RHS {
            diagonal.forward(&mut y);
            *part_mut(g, column.row) = y;
        }
        self.keep(column, &diagonal, magnitude)?;
        for block in take(&mut self.sweep.below, column.below) {
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
        for i in 0..N {
            let margin = diagonal.pivot[i] - magnitude[i] * S::constant(PIVOT_TOLERANCE);
            if !(above_zero(margin) && diagonal.inverse[i].is_finite()) {
                return Err(Dependent::Row(column.row as usize + i));
            }
        }
        *part_mut(self.inverse, column.row) = diagonal.inverse;
        *part_mut(self.magnitude, column.row) = magnitude;
        let triangle = part_mut::<[S; 3], N>(self.triangle, column.row);
        for (to, from) in triangle.iter_mut().zip(&diagonal.lower) {
            to[..N].copy_from_slice(from);
        }
        Ok(())
    }

    /// One block below the diagonal: S_ik - Σ L D Lᵀ of earlier columns, then · L_kk⁻ᵀ and · D⁻¹.
    #[inline(always)]
    fn below<const M: usize, const N: usize>(&mut self, block: &Below, diagonal: &Diagonal<S, N>) {
        let mut s = [[S::zero(); N]; M];
        for &[u, w] in take(&mut self.sweep.pairs, block.pairs) {
            add::<S, M, N, 3>(&mut s, rows(self.sweep.u, u), rows(self.sweep.w, w));
        }
        for update in take(&mut self.sweep.updates, block.updates) {
            self.subtract::<M, N>(update.blocks, update.size, &mut s);
        }
        let range = self.end..self.end + M;
        self.end += M;
        let (unscaled, lower) = (&mut self.unscaled[range.clone()], &mut self.lower[range]);
        for (s, (unscaled, lower)) in s.iter_mut().zip(unscaled.iter_mut().zip(lower)) {
            diagonal.forward(s);
            for j in 0..N {
                unscaled[j] = s[j];
                lower[j] = s[j] * diagonal.inverse[j];
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
        let (left, right) = (rows(self.unscaled, left), rows(self.lower, right));
        match size {
            1 => subtract::<S, M, N, 1>(s, left, right),
            2 => subtract::<S, M, N, 2>(s, left, right),
            _ => subtract::<S, M, N, 3>(s, left, right),
        }
    }
}
