//! Solves [W Aᵀ; A -μI] [x; λ] = [f; g] with the Schur complement, block by block on a static pattern.
//!
//! The Schur complement is the Gram matrix S = A W⁻¹ Aᵀ + μ I of the rows of A, in the scalar product of W⁻¹:
//!
//! ```text
//! S λ = A W⁻¹ f - g,   x = W⁻¹ (f - Aᵀ λ),   S = L D Lᵀ
//! ```
//!
//! With W⁻¹ = diag(d₀⁻¹, d₁⁻¹, 0) + d₂⁻¹ e eᵀ for each group, the diagonal of S is a sum without cancellation. A
//! pivot d of S is compared with this sum, and refused if d ≤ [`PIVOT_TOLERANCE`] S_kk. A dependent row of A leaves a
//! ratio near 1e-16, whatever its scale. A mechanism near a singular position leaves a small ratio, which
//! [`Saddle::cancellation`] returns.

#![allow(clippy::needless_range_loop)] // as in block.rs

use super::block::{
    add, columns, factorise, forward, part, part_mut, scaled, store, subtract, subtract_times,
    DiagonalBlock, DiagonalFactor, TransformedRow,
};
use super::breakdown::Breakdown;
use super::condensed::CondensedGroup;
use super::mass_block::{above_zero, check, is_usable, InverseMass, PIVOT_TOLERANCE};
use super::pattern::Pattern;
use super::pin_block::PinBlock;
use super::records::{next, Ahead, Left, LightRow, Row, Update};
use crate::math::Real;

/// Smallest accepted pivot. Its inverse is finite. Pivots of a matrix with NaN or inf are refused.
const LEAST_PIVOT: f64 = 1e-300;

/// A matrix and its factors. All memory is allocated in [`Saddle::new`]. The table in [`solve`](super) describes
/// every array.
///
/// The matrix must not change between a factorisation and the solutions that use it.
#[derive(Clone, Debug)]
pub struct Saddle<S> {
    /// W⁻¹, one block for each group.
    pub masses: Vec<InverseMass<S>>,
    /// W of the condensed groups.
    pub condensed: Vec<CondensedGroup<S>>,
    /// Entries of A in rows of three, in the places that the pattern assigns.
    pub entries: Vec<[S; 3]>,
    /// μ of each row; empty if zero. Condensed rows are not damped.
    pub damping: Vec<S>,
    /// The rows at light groups.
    pub(super) light: Vec<LightRow>,
    /// Smallest accepted ratio of a pivot to S_kk; [`PIVOT_TOLERANCE`] by default.
    pub(super) least: f64,
    /// Fraction of S_kk that is added to the diagonal; 0 by default.
    pub(super) ridge: f64,
    /// The pairs of rows [±I b].
    pub(super) pins: Vec<PinBlock<S>>,
    /// The other rows of A, transformed by W⁻¹.
    pub(super) u: Vec<TransformedRow<S>>,
    /// For each block row, the blocks L D left of the diagonal and then the diagonal block.
    pub(super) factors: Vec<S>,
}

impl<S: Real> Saddle<S> {
    /// A matrix of the given pattern with W = I, A = 0 except for the unit blocks, and μ = 0.
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
            light: Vec::new(),
            least: PIVOT_TOLERANCE,
            ridge: 0.0,
            pins: vec![PinBlock::zero(); n_pins],
            u: vec![TransformedRow { plain: none, scaled: none }; pattern.storage.rows.len()],
            factors: vec![zero; pattern.n_factors],
        }
    }

    /// Factorises the matrix.
    ///
    /// # Errors
    /// The first pivot that is not positive, not finite or below [`PIVOT_TOLERANCE`] after cancellation (in any
    /// lane). The factors must then not be used.
    ///
    /// # Panics
    /// If the matrix has another pattern.
    #[inline]
    pub fn factor(&mut self, pattern: &Pattern) -> Result<(), Breakdown> {
        self.reduce_all(pattern);
        self.check(pattern)?;
        self.factor_reduced(pattern)
    }

    /// Factorises the matrix after the condensed groups are reduced.
    #[inline]
    pub(super) fn factor_reduced(&mut self, pattern: &Pattern) -> Result<(), Breakdown> {
        self.put_other_rows(pattern);
        self.put_all_pin_rows(pattern);
        self.eliminate::<false>(pattern, &mut []).map_err(Breakdown::Row)
    }

    /// Factorises as [`factor`](Self::factor) and solves as [`solve`](Self::solve). The right side is eliminated
    /// together with the blocks, which hides this half of the solution behind their latency.
    ///
    /// # Errors
    /// As [`factor`](Self::factor). `x` is then invalid.
    ///
    /// # Panics
    /// As [`factor`](Self::factor) and [`solve`](Self::solve).
    #[inline]
    pub fn factor_and_solve(&mut self, pattern: &Pattern, x: &mut [S]) -> Result<(), Breakdown> {
        self.reduce_all(pattern);
        let (f, g) = self.begin(pattern, x);
        self.put_all_pin_rows(pattern);
        self.put_right_sides_of_pins(pattern, f, g);
        self.finish(pattern, x)
    }

    /// Computes e of the condensed groups from the entries, and the quantities that depend on e.
    #[inline]
    fn reduce_all(&mut self, pattern: &Pattern) {
        assert_eq!(self.entries.len(), pattern.n_entries, "a matrix of this pattern");
        for (place, group) in pattern.condensed.iter().zip(&mut self.condensed) {
            let mass = &mut self.masses[place.group as usize];
            group.reduce(place.sign, part(&self.entries, place.entry), mass);
        }
    }

    /// Stores the rows of the `k`-th condensation. Replaces f of their group in `x` by x with λ = 0 in all other
    /// rows. Returns Pᵀ f, from which λ of the rows is computed later; `g` is the right side of the rows.
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

    /// Solves after all condensed groups are [condensed](Self::condense), `x` contains W⁻¹ f for the other groups,
    /// and the diagonal blocks and right sides of [`Pattern::pin_rows`] are stored.
    ///
    /// # Errors
    /// As [`factor`](Self::factor). `x` is then invalid.
    #[inline(always)] // one call in an evaluation
    pub fn finish(&mut self, pattern: &Pattern, x: &mut [S]) -> Result<(), Breakdown> {
        self.put_other_rows(pattern);
        let (f, g) = x.split_at_mut(pattern.n_unknowns());
        self.put_other_right_sides(pattern, f, g);
        // an unusable mass makes a pivot unusable, or else the unknowns of its group
        if let Err(row) = self.eliminate::<true>(pattern, g) {
            return self.check(pattern).and(Err(Breakdown::Row(row)));
        }
        self.substitute_back(pattern, g);
        self.update_groups(pattern, f, g);
        Ok(())
    }

    /// Checks that every pivot of W is usable.
    fn check(&self, pattern: &Pattern) -> Result<(), Breakdown> {
        let useless = |group: u32| !is_usable(self.masses[group as usize].along);
        let mut rows = pattern.condensed.iter().filter(|place| place.sign == 0.0);
        match rows.find(|place| useless(place.group)) {
            Some(place) => Err(Breakdown::Row(place.row as usize)),
            None => check(&self.masses, &pattern.free, &pattern.starts),
        }
    }

    /// The row whose pivot has lost most digits by cancellation, and its ratio d / S_kk. A ratio of 1 means that no
    /// digits were lost, 1e-10 that ten were. `None` without rows.
    pub fn cancellation(&self, pattern: &Pattern) -> Option<(usize, f64)> {
        // searches for the largest S_kk / d, so that only one division is needed
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

    /// The smallest ratio d / S_kk in each lane; 1 without rows.
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

    /// The logarithm of the determinant of S; 0 without rows.
    pub fn log_determinant(&self, pattern: &Pattern) -> S {
        let mut sum = S::zero();
        for row in &pattern.program.rows {
            let inverses = &self.factors[row.diagonal as usize..][..usize::from(row.size)];
            sum -= inverses.iter().fold(S::one(), |product, d| product * *d).abs().ln();
        }
        sum
    }

    /// Eliminates row by row, with `RHS` also the right side. The error is the row that depends on other rows.
    #[inline(never)] // with few pointers, most of them remain in registers
    fn eliminate<const RHS: bool>(&mut self, pattern: &Pattern, g: &mut [S]) -> Result<(), usize> {
        if !self.light.is_empty() {
            self.count_light_as_reference();
        }
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

    /// Eliminates a row that does not consist of pins only. Returns the remaining records, so that the loop over rows
    /// need not store them in memory.
    #[inline(never)] // as for `eliminate`
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

    /// Eliminates one block row with N rows. With `PINS` it consists of pins only.
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
            // a regularised matrix is never factorised and solved in one call
            for i in 0..N {
                s[i][i] += magnitude[i] * S::constant(self.ridge);
            }
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
                diagonal.back(&mut y); // λ, since nothing is below
            }
            *part_mut(g, row.row) = y;
        }
        self.keep(row, &diagonal, &magnitude)
    }

    /// Checks the pivots of a diagonal block and stores it.
    #[inline(always)]
    fn keep<const N: usize>(
        &mut self,
        row: &Row,
        diagonal: &DiagonalFactor<S, N>,
        magnitude: &[S; N],
    ) -> Result<(), usize> {
        for i in 0..N {
            let least = magnitude[i] * S::constant(self.least) + S::constant(LEAST_PIVOT);
            if !above_zero(diagonal.pivot[i] - least) {
                return Err(row.row as usize + i);
            }
        }
        diagonal.store(&mut self.factors, row.diagonal, magnitude);
        Ok(())
    }

    /// Computes one block left of the diagonal, with K columns: S_ik - Σ L D Lᵀ over earlier columns, times L_kk⁻ᵀ.
    /// Then updates the diagonal block, s -= (L D) Lᵀ, and with `RHS` the right side, y -= L y′.
    #[inline(always)]
    fn left<const N: usize, const K: usize, const RHS: bool, const PINS: bool>(
        &mut self,
        left: &Left,
        ahead: &mut Ahead<'_>,
        g: &[S],
        (s, y): (&mut [[S; N]; N], &mut [S; N]),
    ) {
        // transposed, in the order of storage
        let mut block = [[S::zero(); N]; K];
        for pair in next(&mut ahead.pairs, left.pairs) {
            let [own, other] = pair.first;
            if PINS || N == 2 && K == 2 && pair.sign != 0.0 {
                let (own, other) = (&self.pins[own as usize], &self.pins[other as usize]);
                other.add_product(&own.along, pair.sign, &mut block);
            } else if N == 1 && K == 2 && pair.sign != 0.0 {
                let (pin, row) = (&self.pins[other as usize], &self.u[own as usize]);
                pin.add_product_with_row(&row.scaled, pair.sign, &mut block);
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

    /// s -= ((L D) Lᵀ)ᵀ with two blocks of one earlier column, which has K columns.
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
