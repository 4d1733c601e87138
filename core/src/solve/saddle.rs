//! Solving [W Aᵀ; A -μI] [x; λ] = [f; g] by its Schur complement, block by block on a static pattern.
//!
//! The complement is the Gram matrix S = A W⁻¹ Aᵀ + μ I of the rows of A, in the scalar product of W⁻¹:
//!
//! ```text
//! S λ = A W⁻¹ f - g,   x = W⁻¹ (f - Aᵀ λ),   S = L D Lᵀ
//! ```
//!
//! W⁻¹ = diag(d₀⁻¹, d₁⁻¹, 0) + d₂⁻¹ e eᵀ, group by group, so that S is a sum of products without cancellation on its
//! diagonal. A pivot d of S is judged by that sum: it is refused when d ≤ [`PIVOT_TOLERANCE`] S_kk. A dependent row of A
//! leaves a ratio near 1e-16 whatever its scale; a mechanism near a singular position leaves a small one, which
//! [`Saddle::cancellation`] returns.

use super::block::{
    add, columns, factorise, forward, part, part_mut, scaled, store, subtract, subtract_times,
    DiagonalBlock, DiagonalFactor, TransformedRow,
};
use super::breakdown::Breakdown;
use super::condensed::CondensedGroup;
use super::mass_block::{above_zero, check, is_usable, InverseMass, PIVOT_TOLERANCE};
use super::pattern::Pattern;
use super::pin_block::PinBlock;
use super::records::{next, Ahead, Left, Row, Update};
use crate::math::Real;

/// Smallest pivot of all: its inverse is still a number, and that of a matrix with NaN or inf is refused.
const LEAST_PIVOT: f64 = 1e-300;

/// A matrix and its factors; all memory is taken in [`Saddle::new`]. The table in [`solve`](super) describes every array.
///
/// The matrix must not change between a factorisation and the solutions that use it.
#[derive(Clone, Debug)]
pub struct Saddle<S> {
    /// W⁻¹, one for each group.
    pub masses: Vec<InverseMass<S>>,
    /// W of the condensed groups.
    pub condensed: Vec<CondensedGroup<S>>,
    /// Entries of A in rows of three, as the pattern places them.
    pub entries: Vec<[S; 3]>,
    /// μ, one for each row; empty for none. Condensed rows are not damped.
    pub damping: Vec<S>,
    /// Smallest ratio of a pivot to S_kk that is accepted; [`PIVOT_TOLERANCE`] at first.
    pub(super) least: f64,
    /// Part of S_kk that is added to it, 0 at first.
    pub(super) ridge: f64,
    /// The pairs of rows [±I b].
    pub(super) pins: Vec<PinBlock<S>>,
    /// The other rows of A, transformed.
    pub(super) u: Vec<TransformedRow<S>>,
    /// For each row of blocks L D of those left of the diagonal, then its diagonal block.
    pub(super) factors: Vec<S>,
}

impl<S: Real> Saddle<S> {
    /// Memory for matrices of the given pattern: W = I, A = 0 except for the unit blocks, μ = 0.
    pub fn new(pattern: &Pattern) -> Self {
        let (zero, one, none) = (S::zero(), S::one(), [S::zero(); 3]);
        let mut entries = vec![none; pattern.n_entries];
        for &(row, sign) in &pattern.units {
            let (row, sign) = (row as usize, S::constant(sign));
            (entries[row][0], entries[row + 1][1]) = (sign, sign);
        }
        let n_pins = pattern.storage.n_pins;
        let condensed = CondensedGroup::new(one, [zero; 2], one);
        Self {
            masses: vec![InverseMass::diagonal([one; 3]); pattern.starts.len()],
            condensed: vec![condensed; pattern.condensed.len()],
            entries,
            damping: Vec::new(),
            least: PIVOT_TOLERANCE,
            ridge: 0.0,
            pins: vec![PinBlock::zero(); n_pins],
            u: vec![TransformedRow { plain: none, scaled: none }; pattern.storage.rows.len()],
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
    pub fn factor(&mut self, pattern: &Pattern) -> Result<(), Breakdown> {
        self.reduce_all(pattern);
        self.check(pattern)?;
        self.factor_reduced(pattern)
    }

    /// The same once condensed groups are reduced.
    pub(super) fn factor_reduced(&mut self, pattern: &Pattern) -> Result<(), Breakdown> {
        self.put_other_rows(pattern);
        self.put_all_pin_rows(pattern);
        self.eliminate::<false>(pattern, &mut []).map_err(Breakdown::Row)
    }

    /// Factorises as [`factor`](Self::factor) and solves as [`solve`](Self::solve). The right side is
    /// eliminated beside the blocks, which hides that half of the solution behind their latency.
    ///
    /// # Errors
    /// As [`factor`](Self::factor); `x` is then lost.
    ///
    /// # Panics
    /// As [`factor`](Self::factor) and [`solve`](Self::solve).
    pub fn factor_and_solve(&mut self, pattern: &Pattern, x: &mut [S]) -> Result<(), Breakdown> {
        self.reduce_all(pattern);
        let (f, g) = self.begin(pattern, x);
        self.put_all_pin_rows(pattern);
        self.put_right_sides_of_pins(pattern, f, g);
        self.finish(pattern, x)
    }

    /// e of condensed groups from the entries, and what follows from it.
    fn reduce_all(&mut self, pattern: &Pattern) {
        assert_eq!(self.entries.len(), pattern.n_entries, "a matrix of this pattern");
        for (place, group) in pattern.condensed.iter().zip(&mut self.condensed) {
            let mass = &mut self.masses[place.group as usize];
            group.reduce(place.sign, part(&self.entries, place.entry), mass);
        }
    }

    /// The rows of the `k`-th condensation: keeps them, and turns f of their group and their right side `g` into x
    /// for λ = 0 of all others, in `x`, and what λ of the rows follows from, which is returned.
    #[inline(always)]
    pub fn condense(
        &mut self,
        pattern: &Pattern,
        k: usize,
        rows: &[[S; 3]; 2],
        x: &mut [S],
        mut g: [S; 2],
    ) -> [S; 2] {
        let (place, group) = (&pattern.condensed[k], &mut self.condensed[k]);
        let mass = &mut self.masses[place.group as usize];
        *part_mut(&mut self.entries, place.entry) = *rows;
        group.reduce(place.sign, rows, mass);
        group.begin(place.sign, mass, part_mut(x, place.at), &mut g);
        g
    }

    /// Solves once all condensed groups are [condensed](Self::condense), x = W⁻¹ f stands for the other groups, and
    /// the diagonal blocks and right sides of [`Pattern::pin_rows`] are in place.
    ///
    /// # Errors
    /// As [`factor`](Self::factor); `x` is then lost.
    #[inline(always)] // once in an evaluation
    pub fn finish(&mut self, pattern: &Pattern, x: &mut [S]) -> Result<(), Breakdown> {
        self.put_other_rows(pattern);
        let (f, g) = x.split_at_mut(pattern.n_unknowns());
        self.put_other_right_sides(pattern, f, g);
        // an unusable mass spoils a pivot, or else the unknowns of its group
        if let Err(row) = self.eliminate::<true>(pattern, g) {
            return self.check(pattern).and(Err(Breakdown::Row(row)));
        }
        self.substitute_back(pattern, g);
        self.update_groups(pattern, f, g);
        Ok(())
    }

    /// Whether every pivot of W is usable.
    fn check(&self, pattern: &Pattern) -> Result<(), Breakdown> {
        let useless = |group: u32| !is_usable(self.masses[group as usize].along);
        let mut rows = pattern.condensed.iter().filter(|place| place.sign == 0.0);
        match rows.find(|place| useless(place.group)) {
            Some(place) => Err(Breakdown::Row(place.row as usize)),
            None => check(&self.masses, &pattern.free, &pattern.starts),
        }
    }

    /// The row whose pivot was cancelled most, and its ratio d / S_kk: 1 means nothing was lost, 1e-10
    /// that ten digits were. `None` without rows.
    pub fn cancellation(&self, pattern: &Pattern) -> Option<(usize, f64)> {
        // S_kk / d, of which the largest is sought: one division
        let mut worst = None;
        for row in &pattern.program.rows {
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

    /// The same ratio in each lane; 1 without rows.
    pub fn cancellations(&self, pattern: &Pattern) -> S {
        let mut worst = S::one();
        for row in &pattern.program.rows {
            let size = usize::from(row.size);
            let (inverse, rest) = self.factors[row.diagonal as usize..].split_at(size);
            for (inverse, magnitude) in inverse.iter().zip(rest) {
                worst = worst.max((*inverse * *magnitude).abs());
            }
        }
        S::one() / worst
    }

    /// Row by row; with `RHS` the right side as well. The error is the row that depends on others.
    #[inline(never)] // with few pointers, most of them stay in registers
    fn eliminate<const RHS: bool>(&mut self, pattern: &Pattern, g: &mut [S]) -> Result<(), usize> {
        let mut ahead = pattern.program.ahead();
        for row in &pattern.program.rows {
            if row.pins {
                self.row::<2, RHS, true>(row, &mut ahead, g)?;
            } else {
                ahead = self.mixed_row::<RHS>(row, ahead, g)?;
            }
        }
        Ok(())
    }

    /// A row of any kind, apart from those of pins alone; returns the records that are then ahead, so that the loop
    /// over rows need not keep them in memory.
    #[inline(never)] // as above
    fn mixed_row<'a, const RHS: bool>(
        &mut self,
        row: &Row,
        mut ahead: Ahead<'a>,
        g: &mut [S],
    ) -> Result<Ahead<'a>, usize> {
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
    ) -> Result<(), usize> {
        let DiagonalBlock { mut s, magnitude } = DiagonalBlock::read(&self.factors, row.diagonal);
        let mut y = if RHS { *part(g, row.row) } else { [S::zero(); N] };
        if !RHS {
            // a regularised matrix is never factorised and solved at once
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
        diagonal: &DiagonalFactor<S, N>,
        magnitude: &[S; N],
    ) -> Result<(), usize> {
        for (i, magnitude) in magnitude.iter().enumerate() {
            let least = *magnitude * S::constant(self.least) + S::constant(LEAST_PIVOT);
            if !above_zero(diagonal.pivot[i] - least) {
                return Err(row.row as usize + i);
            }
        }
        diagonal.store(&mut self.factors, row.diagonal, magnitude);
        Ok(())
    }

    /// One block left of the diagonal, of K columns: S_ik - Σ L D Lᵀ of earlier columns, then · L_kk⁻ᵀ. Then the
    /// diagonal block s -= (L D) Lᵀ, and with `RHS` y -= L y′.
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
                let [own, other] = [own, other].map(|pin| &self.pins[pin as usize]);
                other.add_product(&own.along, pair.sign, &mut block);
            } else {
                add(&mut block, part(&self.u, other), part(&self.u, own));
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
