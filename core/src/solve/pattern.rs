//! The pattern of a saddle-point matrix [W Aᵀ; A -μI] and its elimination program, computed once.
//!
//! W is block diagonal, with one block for each group of one to three unknowns. The rows of A form blocks of one to
//! three rows that touch the same groups. The factorised matrix S = A W⁻¹ Aᵀ + μ I has one block for each two row
//! blocks that share a group, and fill (Davis, *Direct Methods for Sparse Linear Systems*, 2006, ch. 4). The program
//! is up-looking, row by row. For every block of L it lists the products that contribute to the block, so that the
//! block is computed in registers and written once.

use super::condensed::{condensations, Condensation, Loads};
use super::mass_block::kinds;
use super::records::{next, PinRows, Program, Row};
use super::storage::{is_pin_only, Storage};
use super::structure::{count_entries, group_starts, index, row_starts, Group, RowBlock};
use super::symbolic;
use crate::math::Listed;

/// A row of three entries at a group.
#[derive(Clone, Copy, Debug)]
pub(super) struct GroupRow {
    pub entry: u32,
    pub group: u32,
    /// Index, among the factors, of the sum with which the pivot of the row is compared.
    pub sum: u32,
}

/// The pattern and the program, shared by any number of matrices.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// First unknown of each group.
    pub(super) starts: Vec<u32>,
    /// Groups that are not condensed, with a diagonal block of W and with a coupled one.
    pub(super) diagonal: Vec<u32>,
    pub(super) coupled: Vec<u32>,
    /// All groups that are not condensed.
    pub(super) free: Vec<u32>,
    pub(super) condensed: Vec<Condensation>,
    /// The other row blocks at condensed groups.
    pub(super) loads: Loads,
    n_unknowns: usize,
    /// Number of unknowns of the last group.
    last: usize,
    n_rows: usize,
    pub(super) n_entries: usize,
    pub(super) storage: Storage,
    /// Row blocks that consist of pin blocks only, in the order of elimination.
    pub(super) pin_rows: Vec<PinRows>,
    /// The first rows of entries of blocks that begin with ±I, and their signs.
    pub(super) units: Vec<(u32, f64)>,
    pub(super) program: Program,
    /// Number of values in the factors.
    pub(super) n_factors: usize,
}

impl Pattern {
    /// The pattern for groups of unknowns and the row blocks of A. `condensed` contains the indices of the row blocks
    /// to be condensed. Each of these is a pair of rows at a single group, which no other condensed row block
    /// touches.
    ///
    /// # Panics
    /// If a row block does not have 1 to 3 rows, a group does not exist or is touched twice, the entries do not fill
    /// a list without gaps, or an index exceeds 32 bits.
    #[inline]
    pub fn new(groups: &[Group], blocks: &[RowBlock], condensed: &[usize]) -> Self {
        let (starts, n_unknowns) = group_starts(groups);
        let rows = row_starts(blocks);
        let (condensed_blocks, loads) = condensations(&starts, blocks, &rows, condensed);
        let remaining = Remaining::new(blocks, &rows, condensed);
        let order = symbolic::order(groups.len(), &remaining.blocks);
        let rows_below = symbolic::rows_below(groups.len(), &remaining.blocks, &order);
        let (storage, touches) = Storage::new(&starts, &remaining.blocks, &order);
        let (program, n_factors) =
            symbolic::program(&remaining.blocks, &remaining.rows, &order, &rows_below, &touches);
        let pin_only = |(own, _): &(&usize, &Row)| is_pin_only(&touches[**own]);
        let record =
            |(own, row): (&usize, &Row)| PinRows::new(&touches[*own], remaining.numbers[*own], row);
        let pin_rows = order.iter().zip(&program.rows).filter(pin_only).map(record).list();
        let mut is_condensed = vec![false; groups.len()];
        condensed_blocks.iter().for_each(|block| is_condensed[block.group as usize] = true);
        let [diagonal, coupled, free] = kinds(groups, &is_condensed);
        Self {
            starts: starts.into_iter().map(index).list(),
            diagonal,
            coupled,
            free,
            condensed: condensed_blocks,
            loads,
            n_unknowns,
            last: groups.last().map_or(0, |group| group.size),
            n_rows: rows[blocks.len()],
            n_entries: count_entries(blocks),
            storage,
            pin_rows,
            units: units(blocks),
            program,
            n_factors,
        }
    }

    /// Each row of three entries at a group, except those of condensed row blocks.
    pub(super) fn rows_of_groups(&self) -> Vec<GroupRow> {
        let mut rows = Vec::new();
        let mut add = |entry, group, diagonal, size| {
            rows.extend((0..size).map(|k| GroupRow {
                entry: entry + k,
                group,
                sum: diagonal + size + k,
            }));
        };
        for pins in &self.pin_rows {
            pins.ends().iter().for_each(|end| add(end.entry, end.group, pins.diagonal, 2));
        }
        let mut touches = &self.program.touches[..];
        for start in &self.program.starts {
            let own = next(&mut touches, start.touches);
            own.iter().for_each(|at| add(at.entry, at.group, start.diagonal, start.size));
        }
        rows
    }

    /// Number of unknowns of a group.
    pub(super) fn size(&self, group: usize) -> usize {
        let end = self.starts.get(group + 1);
        end.map_or(self.last, |end| (*end - self.starts[group]) as usize)
    }

    /// The row blocks that consist of pin blocks only, in the order of elimination.
    #[inline]
    pub fn pin_rows(&self) -> &[PinRows] {
        &self.pin_rows
    }

    /// The condensed row blocks, in the given order.
    #[inline]
    pub fn condensed(&self) -> &[Condensation] {
        &self.condensed
    }

    /// The groups coupled in W that are not condensed.
    #[inline]
    pub fn coupled(&self) -> &[u32] {
        &self.coupled
    }

    /// Number of unknowns in groups, plus up to two as padding if the last group has fewer than three.
    #[inline]
    pub fn n_unknowns(&self) -> usize {
        self.n_unknowns
    }

    /// Number of rows of A.
    #[inline]
    pub fn n_rows(&self) -> usize {
        self.n_rows
    }

    /// Number of blocks of L below the diagonal, including fill.
    #[inline]
    pub fn fill(&self) -> usize {
        self.program.below.len()
    }

    /// Number of block products in one elimination.
    #[inline]
    pub fn n_products(&self) -> usize {
        self.program.pairs.len() + self.program.updates.len()
    }
}

/// The row blocks that are not condensed.
struct Remaining {
    blocks: Vec<RowBlock>,
    /// The first row of each block.
    rows: Vec<usize>,
    /// Their indices among all row blocks.
    numbers: Vec<u32>,
}

impl Remaining {
    fn new(blocks: &[RowBlock], starts: &[usize], condensed: &[usize]) -> Self {
        let mut remains = vec![true; blocks.len()];
        condensed.iter().for_each(|block| remains[*block] = false);
        let numbers = || (0..blocks.len()).filter(|k| remains[*k]);
        Self {
            blocks: numbers().map(|k| blocks[k].clone()).list(),
            rows: numbers().map(|k| starts[k]).list(),
            numbers: numbers().map(index).list(),
        }
    }
}

/// The first rows of entries of blocks that begin with ±I, and their signs.
#[inline]
fn units(blocks: &[RowBlock]) -> Vec<(u32, f64)> {
    let of = |block: &RowBlock| {
        let firsts = block.touches.iter().map(|(_, first)| index(first / 3));
        firsts.zip(block.signs.clone()).list()
    };
    blocks.iter().flat_map(of).list()
}
