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

use super::anchor::Anchor;
use super::arm::Arm;
use super::block::{
    add, columns, factorise, forward, part, part_mut, scaled, store, subtract, subtract_times,
    Diagonal, Open, Twin,
};
use super::pattern::Pattern;
use super::steps::{next, Ahead, Left, Row, Start, Update};
use super::weight::{above_zero, check, Dependent, Weight};
use crate::math::Real;

/// Smallest ratio of a pivot to the diagonal entry it was cancelled from that is still trusted.
pub const PIVOT_TOLERANCE: f64 = 1e-13;

/// Smallest pivot of all: its inverse is still a number, and that of a matrix with NaN or inf is refused.
const LEAST_PIVOT: f64 = 1e-300;

/// A matrix and its factors; all memory is taken in [`Saddle::new`].
///
/// Between a factorisation and the solutions that use it the matrix must stay as it is.
#[derive(Clone, Debug)]
pub struct Saddle<S> {
    /// W, one for each group.
    pub weights: Vec<Weight<S>>,
    /// The rest of W where rows are anchored; the weight of such a group is that of its third unknown alone.
    pub anchors: Vec<Anchor<S>>,
    /// Entries of A in rows of three, as the pattern places them.
    pub entries: Vec<[S; 3]>,
    /// The pairs of rows [±I b], as the pattern places them.
    pub arms: Vec<Arm<S>>,
    /// μ, one for each row; empty for none.
    pub damping: Vec<S>,
    /// Smallest ratio of a pivot to S_kk that is accepted; [`PIVOT_TOLERANCE`] at first.
    pub(super) least: f64,
    /// Part of S_kk that is added to it, 0 at first.
    pub(super) ridge: f64,
    /// Rows of U.
    pub(super) u: Vec<Twin<S>>,
    /// For each row of blocks L D of those left of the diagonal, then what its diagonal block came to.
    pub(super) factors: Vec<S>,
}

impl<S: Real> Saddle<S> {
    /// Memory for matrices of the given pattern: W = I, A = 0 but for the unit blocks, μ = 0.
    pub fn new(pattern: &Pattern) -> Self {
        let (zero, none) = (S::zero(), [S::zero(); 3]);
        let weight = Weight { inverse: [S::one(); 3], shift: [zero; 2], held: zero };
        let mut entries = vec![none; pattern.n_entries];
        for &(row, sign) in &pattern.units {
            let (row, sign) = (row as usize, S::constant(sign.into()));
            (entries[row][0], entries[row + 1][1]) = (sign, sign);
        }
        Self {
            weights: vec![weight; pattern.n_groups],
            anchors: vec![Anchor::unit(); pattern.anchors.len()],
            entries,
            arms: vec![Arm::zero(); pattern.places.arms.len()],
            damping: Vec::new(),
            least: PIVOT_TOLERANCE,
            ridge: 0.0,
            u: vec![Twin { plain: none, scaled: none }; pattern.places.general.len()],
            factors: vec![zero; pattern.n_factors],
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
        check(&self.weights, &pattern.loose)?;
        self.transform::<true>(pattern);
        self.begin_all(pattern, &pattern.steps.starts);
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
        self.transform::<true>(pattern);
        self.weigh(pattern, x);
        self.finish(pattern, &pattern.steps.starts, x)?;
        self.unbend(pattern, x);
        Ok(())
    }

    /// The same once all row blocks of [`Pattern::armed`] are begun: their entries are not read, `x` was
    /// weighed, their right sides stand in it, and it lacks -Dw⁻¹ Uᵀ λ of these rows in the end.
    ///
    /// # Errors
    /// As [`factor`](Self::factor); `x` is then lost.
    ///
    /// # Panics
    /// As [`factor`](Self::factor) and [`solve`](Self::solve).
    #[inline(always)] // once in an evaluation
    pub fn finish_begun(&mut self, pattern: &Pattern, x: &mut [S]) -> Result<(), Dependent> {
        self.transform::<false>(pattern);
        self.finish(pattern, &pattern.steps.starts[..pattern.steps.n_mixed], x)
    }

    /// From x = Dw⁻¹ Lw⁻¹ f to Lwᵀ x, with the row blocks of `starts` still to be begun.
    #[inline(always)]
    fn finish(
        &mut self,
        pattern: &Pattern,
        starts: &[Start],
        x: &mut [S],
    ) -> Result<(), Dependent> {
        self.begin_all(pattern, starts);
        let (f, g) = x.split_at_mut(pattern.n_unknowns());
        self.right_sides(pattern, starts, f, g);
        // a useless weight spoils a pivot, or else the unknowns of its group
        self.eliminate::<true>(pattern, g)
            .or_else(|row| check(&self.weights, &pattern.loose).and(Err(row)))?;
        self.substitute_back(pattern, g);
        self.spread_all(pattern, starts, f, g);
        Ok(())
    }

    /// The row whose pivot was cancelled most, and its ratio d / S_kk: 1 means nothing was lost, 1e-10
    /// that ten digits were. `None` without rows.
    pub fn cancellation(&self, pattern: &Pattern) -> Option<(usize, f64)> {
        // S_kk / d, of which the largest is sought: one division
        let mut worst = None;
        for row in &pattern.steps.rows {
            let (first, size) = (row.row as usize, usize::from(row.size));
            let (inverse, rest) = self.factors[row.diagonal as usize..].split_at(size);
            for (k, (inverse, magnitude)) in inverse.iter().zip(rest).enumerate() {
                let lost = (*inverse * *magnitude).largest_magnitude();
                if worst.is_none_or(|(at, most)| lost > most || lost == most && first + k < at) {
                    worst = Some((first + k, lost));
                }
            }
        }
        worst.map(|(row, lost)| (row, 1.0 / lost))
    }

    /// Row by row; with `RHS` the right side as well.
    #[inline(never)] // with few pointers, most of them stay in registers
    fn eliminate<const RHS: bool>(
        &mut self,
        pattern: &Pattern,
        g: &mut [S],
    ) -> Result<(), Dependent> {
        let mut ahead = pattern.steps.ahead();
        for row in &pattern.steps.rows {
            if row.pins {
                self.row::<2, RHS, true>(row, &mut ahead, g)?;
            } else {
                ahead = self.mixed_row::<RHS>(row, ahead, g)?;
            }
        }
        Ok(())
    }

    /// A row of any kind, apart from those of pins alone; gives what is then ahead, so that the loop over these
    /// need not leave that in memory.
    #[inline(never)] // as above
    fn mixed_row<'a, const RHS: bool>(
        &mut self,
        row: &Row,
        mut ahead: Ahead<'a>,
        g: &mut [S],
    ) -> Result<Ahead<'a>, Dependent> {
        match row.size {
            1 => self.row::<1, RHS, false>(row, &mut ahead, g),
            2 => self.row::<2, RHS, false>(row, &mut ahead, g),
            _ => self.row::<3, RHS, false>(row, &mut ahead, g),
        }
        .map(|()| ahead)
    }

    /// One row of L, of N rows; with `PINS` one of pins alone.
    #[inline(always)]
    fn row<const N: usize, const RHS: bool, const PINS: bool>(
        &mut self,
        row: &Row,
        ahead: &mut Ahead<'_>,
        g: &mut [S],
    ) -> Result<(), Dependent> {
        let Open { mut s, magnitude } = Open::read(&self.factors, row.diagonal);
        let mut y = if RHS { *part(g, row.row) } else { [S::zero(); N] };
        if !RHS {
            // near singular positions, where it is not 0, are never factorised and solved at once
            (0..N).for_each(|i| s[i][i] += magnitude[i] * S::constant(self.ridge));
        }
        for left in next(&mut ahead.left, row.left) {
            let own = (&mut s, &mut y);
            match left.size {
                _ if PINS => self.left::<N, 2, RHS, true>(left, ahead, g, own),
                1 => self.left::<N, 1, RHS, false>(left, ahead, g, own),
                2 => self.left::<N, 2, RHS, false>(left, ahead, g, own),
                _ => self.left::<N, 3, RHS, false>(left, ahead, g, own),
            }
        }
        let diagonal = factorise(s);
        if RHS {
            diagonal.forward(&mut y);
            if row.below == 0 {
                diagonal.back(&mut y); // λ: nothing else is waited for
            }
            *part_mut(g, row.row) = y;
        }
        self.keep(row, &diagonal, &magnitude)
    }

    /// Judges and stores a diagonal block.
    #[inline(always)]
    fn keep<const N: usize>(
        &mut self,
        row: &Row,
        diagonal: &Diagonal<S, N>,
        magnitude: &[S; N],
    ) -> Result<(), Dependent> {
        for (i, magnitude) in magnitude.iter().enumerate() {
            let least = *magnitude * S::constant(self.least) + S::constant(LEAST_PIVOT);
            if !above_zero(diagonal.pivot[i] - least) {
                return Err(Dependent::Row(row.row as usize + i));
            }
        }
        diagonal.store(&mut self.factors, row.diagonal, magnitude);
        Ok(())
    }

    /// One block left of the diagonal, of K columns: S_ik - Σ L D Lᵀ of earlier columns, then · L_kk⁻ᵀ. What follows
    /// from it for the diagonal block: s -= (L D) Lᵀ, with `RHS` y -= L y′ as well.
    #[inline(always)]
    fn left<const N: usize, const K: usize, const RHS: bool, const PINS: bool>(
        &mut self,
        left: &Left,
        ahead: &mut Ahead<'_>,
        g: &[S],
        (s, y): (&mut [[S; N]; N], &mut [S; N]),
    ) {
        // transposed, as it is stored
        let mut block = [[S::zero(); N]; K];
        for pair in next(&mut ahead.pairs, left.pairs) {
            let [own, other] = pair.first;
            if PINS || N == 2 && K == 2 && pair.sign != 0.0 {
                let [own, other] = [own, other].map(|arm| &self.arms[arm as usize]);
                other.add_product(&own.plain, pair.sign, &mut block);
            } else {
                add::<S, K, N, 3>(&mut block, part(&self.u, other), part(&self.u, own));
            }
        }
        for update in next(&mut ahead.updates, left.updates) {
            match update.size {
                _ if PINS => self.subtract_product::<N, K, 2>(update, &mut block),
                1 => self.subtract_product::<N, K, 1>(update, &mut block),
                2 => self.subtract_product::<N, K, 2>(update, &mut block),
                _ => self.subtract_product::<N, K, 3>(update, &mut block),
            }
        }
        forward(&self.factors, left.diagonal, &mut block);
        store(&mut self.factors, left.block, &block);
        let scaled = scaled(&block, part(&self.factors, left.diagonal));
        subtract(s, &block, &scaled);
        if RHS {
            subtract_times(y, &scaled, part::<S, K>(g, left.row));
        }
    }

    /// s -= ((L D) Lᵀ)ᵀ with two blocks of one earlier column, of K columns.
    #[inline(always)]
    fn subtract_product<const M: usize, const N: usize, const K: usize>(
        &self,
        &Update { blocks: [left, right], diagonal, .. }: &Update,
        s: &mut [[S; M]; N],
    ) {
        let left = scaled(&columns::<S, M, K>(&self.factors, left), part(&self.factors, diagonal));
        subtract(s, &columns::<S, N, K>(&self.factors, right), &left);
    }
}
