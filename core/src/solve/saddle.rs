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

use super::arm::{bent, Arm};
use super::block::{add, factorise, part, part_mut, subtract, Diagonal, Twin};
use super::pattern::{Below, Column, Pattern, Touch, Update};
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
    /// Entries of A in rows of three, as the pattern places them.
    pub entries: Vec<[S; 3]>,
    /// μ, one for each row.
    pub damping: Vec<S>,
    /// Smallest ratio of a pivot to S_kk that is accepted; [`PIVOT_TOLERANCE`] at first.
    pub(super) least: f64,
    /// Part of S_kk that is added to it, 0 at first.
    pub(super) ridge: f64,
    /// Rows of U.
    pub(super) u: Vec<Twin<S>>,
    /// Pairs of rows of U that begin with ±I.
    pub(super) arms: Vec<Arm<S>>,
    /// Rows of the diagonal blocks of L.
    pub(super) diagonal: Vec<Pivot<S>>,
    /// Columns of the blocks of L D and of L below the diagonal.
    pub(super) lower: Vec<Twin<S>>,
}

/// One row of a diagonal block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pivot<S> {
    /// L left of the diagonal, within the block.
    pub lower: [S; 3],
    /// 1 / d.
    pub inverse: S,
    /// S_kk.
    magnitude: S,
}

impl<S: Real> Saddle<S> {
    /// Memory for matrices of the given pattern: W = I, A = 0 but for the unit blocks, μ = 0.
    pub fn new(pattern: &Pattern) -> Self {
        let (zero, none) = (S::zero(), [S::zero(); 3]);
        let weight = Weight { inverse: [S::one(); 3], shift: [zero; 2] };
        let twin = Twin { plain: none, scaled: none };
        let mut entries = vec![none; pattern.n_entries];
        for &(row, sign) in &pattern.units {
            let sign = S::constant(sign);
            (entries[row][0], entries[row + 1][1]) = (sign, sign);
        }
        Self {
            weights: vec![weight; pattern.coupled.len()],
            entries,
            damping: vec![zero; pattern.n_rows],
            least: PIVOT_TOLERANCE,
            ridge: 0.0,
            u: vec![twin; pattern.general.len()],
            arms: vec![Arm::zero(); pattern.arms.len()],
            diagonal: vec![Pivot { lower: none, inverse: zero, magnitude: zero }; pattern.n_rows],
            lower: vec![twin; pattern.n_lower],
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
        check(&self.weights)?;
        self.transform(pattern);
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
        self.transform(pattern);
        self.weigh(pattern, x);
        // a useless weight spoils a pivot, or else the unknowns of its group
        self.eliminate::<true>(pattern, x).or_else(|row| check(&self.weights).and(Err(row)))?;
        self.substitute_back(pattern, x);
        Ok(())
    }

    /// The row whose pivot was cancelled most, and its ratio d / S_kk: 1 means nothing was lost, 1e-10
    /// that ten digits were. `None` without rows.
    pub fn cancellation(&self) -> Option<(usize, f64)> {
        let ratios = self.diagonal.iter().map(|p| S::one() / (p.inverse * p.magnitude));
        ratios.map(S::least_magnitude).enumerate().min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// U = A Lw⁻ᵀ and U Dw⁻¹, one after the other as they are stored.
    #[inline(always)]
    fn transform(&mut self, pattern: &Pattern) {
        assert_eq!(self.entries.len(), pattern.n_entries, "a matrix of this pattern");
        for (owner, u) in pattern.general.iter().zip(&mut self.u) {
            let Weight { inverse, shift } = &self.weights[owner.group as usize];
            let mut row = self.entries[owner.row as usize];
            if owner.coupled {
                row[2] = row[2] - shift[0] * row[0] - shift[1] * row[1];
            }
            u.plain = row;
            u.scaled = [row[0] * inverse[0], row[1] * inverse[1], row[2] * inverse[2]];
        }
        for (owner, arm) in pattern.arms.iter().zip(&mut self.arms) {
            let weight = &self.weights[owner.group as usize];
            *arm = Arm::new(bent(part(&self.entries, owner.row), weight, owner), weight);
        }
    }

    /// Column by column; with `RHS` the right side as well.
    #[inline(always)]
    fn eliminate<const RHS: bool>(
        &mut self,
        pattern: &Pattern,
        x: &mut [S],
    ) -> Result<(), Dependent> {
        let (x, g) = x.split_at_mut(if RHS { pattern.n_unknowns() } else { 0 });
        for column in &pattern.columns {
            if column.pins {
                self.column::<2, RHS, true>(column, x, g)?;
            } else {
                self.mixed_column::<RHS>(column, x, g)?;
            }
        }
        Ok(())
    }

    /// A column of any kind, apart from those of pins alone: the loop over these stays in registers.
    #[inline(never)]
    fn mixed_column<const RHS: bool>(
        &mut self,
        column: &Column,
        x: &[S],
        g: &mut [S],
    ) -> Result<(), Dependent> {
        match column.size {
            1 => self.column::<1, RHS, false>(column, x, g),
            2 => self.column::<2, RHS, false>(column, x, g),
            _ => self.column::<3, RHS, false>(column, x, g),
        }
    }

    /// One column of L, of N rows and columns on the diagonal; with `PINS` one of pins alone.
    #[inline(always)]
    fn column<const N: usize, const RHS: bool, const PINS: bool>(
        &mut self,
        column: &Column,
        x: &[S],
        g: &mut [S],
    ) -> Result<(), Dependent> {
        let mut s = [[S::zero(); N]; N];
        for (i, mu) in part::<S, N>(&self.damping, column.row).iter().enumerate() {
            s[i][i] = *mu;
        }
        let mut y = if RHS { part(g, column.row).map(|g: S| -g) } else { [S::zero(); N] };
        for Touch { first, unknown, sign } in &column.touches {
            if PINS || N == 2 && *sign != 0.0 {
                let arm = &self.arms[*first as usize];
                arm.add_square(&mut s);
                if RHS {
                    arm.add_times(*sign, part(x, *unknown), &mut y);
                }
                continue;
            }
            let u = part::<_, N>(&self.u, *first);
            add::<S, N, N, 3>(&mut s, u, u);
            if RHS {
                Twin::add_times(u, part(x, *unknown), &mut y);
            }
        }
        let magnitude: [S; N] = std::array::from_fn(|i| s[i][i]);
        if self.ridge > 0.0 {
            for (i, magnitude) in magnitude.iter().enumerate() {
                s[i][i] += *magnitude * S::constant(self.ridge);
            }
        }
        for block in &column.earlier {
            let size = if PINS { 2 } else { block.size };
            self.subtract::<N, N>([block.block, block.block], size, &mut s);
            if RHS {
                block.subtract(size, &self.lower, g, &mut y);
            }
        }
        let diagonal = factorise(s);
        if RHS {
            let mut y = y.map(|y| [y]);
            diagonal.forward(&mut y);
            *part_mut(g, column.row) = y.map(|[y]| y);
        }
        self.keep(column, &diagonal, magnitude)?;
        for block in &column.below {
            match block.size {
                _ if PINS => self.below::<2, N, true>(block, &diagonal),
                1 => self.below::<1, N, false>(block, &diagonal),
                2 => self.below::<2, N, false>(block, &diagonal),
                _ => self.below::<3, N, false>(block, &diagonal),
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
            let least = magnitude[i] * S::constant(self.least) + S::constant(LEAST_PIVOT);
            if !above_zero(diagonal.pivot[i] - least) {
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
    fn below<const M: usize, const N: usize, const PINS: bool>(
        &mut self,
        block: &Below,
        diagonal: &Diagonal<S, N>,
    ) {
        // transposed, as it is stored
        let mut s = [[S::zero(); M]; N];
        for pair in &block.pairs {
            let [own, other] = pair.first;
            if PINS || N == 2 && M == 2 && pair.sign != 0.0 {
                let own = &self.arms[own as usize];
                self.arms[other as usize].add_product(own, pair.sign, &mut s);
            } else {
                add::<S, N, M, 3>(&mut s, part(&self.u, other), part(&self.u, own));
            }
        }
        for Update { blocks: [left, right], size } in &block.updates {
            let size = if PINS { 2 } else { *size };
            self.subtract::<N, M>([*right, *left], size, &mut s);
        }
        diagonal.forward(&mut s);
        let columns = part_mut::<_, N>(&mut self.lower, block.block);
        for ((s, column), inverse) in s.iter().zip(columns).zip(&diagonal.inverse) {
            column.plain[..M].copy_from_slice(s);
            column.scaled[..M].copy_from_slice(&s.map(|s| s * *inverse));
        }
    }

    /// s -= (L D) Lᵀ with two blocks of one earlier column, of `size` rows.
    #[inline(always)]
    fn subtract<const M: usize, const N: usize>(
        &self,
        [left, right]: [u32; 2],
        size: u32,
        s: &mut [[S; N]; M],
    ) {
        let l = &self.lower;
        match size {
            1 => subtract::<S, M, N, 1>(s, part(l, left), part(l, right)),
            2 => subtract::<S, M, N, 2>(s, part(l, left), part(l, right)),
            _ => subtract::<S, M, N, 3>(s, part(l, left), part(l, right)),
        }
    }
}
