//! The pattern of a saddle-point matrix [W Aᵀ; A -μI] and the plan of its elimination, worked out once.
//!
//! W is block diagonal, 3 × 3 for each group of three unknowns; the rows of A come in blocks of one to
//! three that touch the same groups. What is factorised is S = A W⁻¹ Aᵀ + μ I, one block for each two
//! row blocks that share a group, and fill (Davis, *Direct Methods for Sparse Linear Systems*, 2006,
//! ch. 4). The plan is left-looking: for every block of L it names the products that make it, so that a
//! block is computed in registers and written once.

use super::order::groups_first;

/// Most rows of a block, and unknowns of a group.
pub(super) const MOST: usize = 3;

/// Some rows of A that touch the same groups.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowBlock {
    /// Number of rows, 1 to 3.
    pub size: usize,
    /// The groups touched, each once, with the first of the three entries of A there: row by row
    /// `size` × 3 entries. The index is a multiple of three.
    pub touches: Vec<(usize, usize)>,
}

/// The pattern and the plan, shared by any number of factors.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// Whether the third unknown of each group is coupled to the other two in W.
    pub(super) coupled: Vec<bool>,
    pub(super) n_rows: usize,
    /// The owner of each row of three entries of A.
    pub(super) owners: Vec<Owner>,
    /// Columns of L, in elimination order.
    pub(super) columns: Vec<Column>,
    /// Rows of all blocks of L below the diagonal.
    pub(super) n_lower: usize,
}

/// The group that a row of three entries of A belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Owner {
    pub group: u32,
    pub coupled: bool,
}

/// One column of blocks of L.
#[derive(Clone, Debug)]
pub(super) struct Column {
    /// Rows of its row block.
    pub size: u32,
    /// The first of them.
    pub row: u32,
    pub touches: Box<[Touch]>,
    /// The blocks left of its diagonal block.
    pub earlier: Box<[Earlier]>,
    pub below: Box<[Below]>,
}

/// A group that a row block touches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    /// First row of three entries.
    pub first: u32,
    /// First unknown of the group.
    pub unknown: u32,
}

/// A block of L left of a diagonal block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Earlier {
    /// Its first row in the store of L.
    pub block: u32,
    /// First row, and size, of the row block eliminated there.
    pub row: u32,
    pub size: u32,
}

/// A block of L below the diagonal.
#[derive(Clone, Debug)]
pub(super) struct Below {
    /// Its first row in the store of L.
    pub block: u32,
    /// Size and first row of its row block.
    pub size: u32,
    pub row: u32,
    /// Rows of entries (of the block's own row block, of the column's) in each shared group.
    pub pairs: Box<[[u32; 2]]>,
    pub updates: Box<[Update]>,
}

/// Two blocks of an earlier column whose product is subtracted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Update {
    /// In the rows of the block that is made, and in those of the column it stands in.
    pub blocks: [u32; 2],
    /// Size of the row block eliminated there.
    pub size: u32,
}

impl Pattern {
    /// For groups of three unknowns, each `coupled` or diagonal in W, and the row blocks of A.
    ///
    /// # Panics
    /// If a row block has not 1 to 3 rows, a group does not exist or is touched twice, the entries do
    /// not fill a list without gaps, or an index exceeds 32 bits.
    pub fn new(coupled: Vec<bool>, blocks: &[RowBlock]) -> Self {
        let starts = starts(blocks);
        let order = order(coupled.len(), blocks, &starts);
        let shared = Shared::new(coupled.len(), blocks, &order);
        let rows_below = fill(&shared.rows_below(blocks, &order));
        let owner = |g| Owner { group: index(g), coupled: coupled[g] };
        let owners = group_of_rows(blocks).into_iter().map(owner).collect();
        let n_rows = starts[blocks.len()];
        let mut pattern = Self { coupled, n_rows, owners, columns: vec![], n_lower: 0 };
        pattern.plan(blocks, &starts, &order, &rows_below, &shared);
        pattern
    }

    /// Number of unknowns in groups.
    pub fn n_unknowns(&self) -> usize {
        3 * self.coupled.len()
    }

    /// Number of rows of A.
    pub fn n_rows(&self) -> usize {
        self.n_rows
    }

    /// Number of blocks of L below the diagonal, fill included.
    pub fn fill(&self) -> usize {
        self.columns.iter().map(|c| c.below.len()).sum()
    }

    /// Lists every product, column by column.
    fn plan(
        &mut self,
        blocks: &[RowBlock],
        starts: &[usize],
        order: &[usize],
        rows_below: &[Vec<usize>],
        shared: &Shared,
    ) {
        let mut lists = Lists::new(rows_below);
        for (place, rows) in rows_below.iter().enumerate() {
            let own = order[place];
            let (size, row) = (index(blocks[own].size), index(starts[own]));
            let mut offsets = Vec::with_capacity(rows.len());
            for &r in rows {
                offsets.push(index(self.n_lower));
                self.n_lower += blocks[order[r]].size;
            }
            lists.eliminate(rows_below, place, &offsets, (row, size));
            let below = rows.iter().zip(&offsets).zip(&lists.updates[place]);
            let below = below.map(|((&r, &block), updates)| Below {
                block,
                size: index(blocks[order[r]].size),
                row: index(starts[order[r]]),
                pairs: shared.pairs(blocks, order[r], own).into(),
                updates: updates.as_slice().into(),
            });
            let touch = |&(group, first): &(usize, usize)| Touch {
                first: index(first / 3),
                unknown: index(3 * group),
            };
            self.columns.push(Column {
                size,
                row,
                touches: blocks[own].touches.iter().map(touch).collect(),
                earlier: lists.earlier[place].as_slice().into(),
                below: below.collect(),
            });
        }
    }
}

/// What elimination subtracts, collected while columns are eliminated one after the other.
struct Lists {
    /// From each diagonal block.
    earlier: Vec<Vec<Earlier>>,
    /// From each block below the diagonal, by column and position in it.
    updates: Vec<Vec<Vec<Update>>>,
}

impl Lists {
    fn new(rows_below: &[Vec<usize>]) -> Self {
        let earlier = vec![Vec::new(); rows_below.len()];
        let updates = rows_below.iter().map(|rows| vec![Vec::new(); rows.len()]).collect();
        Self { earlier, updates }
    }

    /// The products of the blocks of one column, stored at `offsets`.
    fn eliminate(
        &mut self,
        rows_below: &[Vec<usize>],
        place: usize,
        offsets: &[u32],
        (row, size): (u32, u32),
    ) {
        let rows = &rows_below[place];
        for (a, &r) in rows.iter().enumerate() {
            self.earlier[r].push(Earlier { block: offsets[a], row, size });
            let mut at = 0;
            for (b, &s) in rows.iter().enumerate().skip(a + 1) {
                at += rows_below[r][at..].partition_point(|&row| row < s);
                self.updates[r][at].push(Update { blocks: [offsets[b], offsets[a]], size });
            }
        }
    }
}

fn index(i: usize) -> u32 {
    u32::try_from(i).expect("fewer than 2^32 entries")
}

/// First row of each row block, and the number of rows.
fn starts(blocks: &[RowBlock]) -> Vec<usize> {
    let mut starts = vec![0];
    for block in blocks {
        assert!((1..=MOST).contains(&block.size), "blocks of one to three rows");
        starts.push(starts[starts.len() - 1] + block.size);
    }
    starts
}

/// The group that each row of three entries belongs to.
fn group_of_rows(blocks: &[RowBlock]) -> Vec<usize> {
    let touches = || blocks.iter().flat_map(|b| b.touches.iter().map(move |t| (b.size, t)));
    let mut group = vec![usize::MAX; touches().map(|(size, _)| size).sum()];
    for (size, &(g, first)) in touches() {
        assert!(first % 3 == 0, "whole rows of entries");
        for owner in &mut group[first / 3..first / 3 + size] {
            assert!(*owner == usize::MAX, "an entry belongs to one block");
            *owner = g;
        }
    }
    group
}

/// The order in which row blocks are eliminated, after all groups.
fn order(groups: usize, blocks: &[RowBlock], starts: &[usize]) -> Vec<usize> {
    let n_first = 3 * groups;
    let first: Vec<usize> = (0..n_first)
        .step_by(3)
        .chain(blocks.iter().zip(starts).map(|(_, s)| n_first + s))
        .collect();
    let entries: Vec<(usize, usize)> = blocks
        .iter()
        .zip(starts)
        .flat_map(|(b, s)| b.touches.iter().map(move |&(group, _)| (n_first + s, 3 * group)))
        .collect();
    let order = groups_first(n_first, n_first + starts[blocks.len()], &entries, Some(&first));
    let starting = |i: &usize| i.checked_sub(n_first).and_then(|i| starts.binary_search(&i).ok());
    order.iter().filter_map(starting).collect()
}

/// Which row blocks share a group.
struct Shared {
    /// Elimination place of each row block.
    place: Vec<usize>,
    /// Row blocks at each group.
    at: Vec<Vec<usize>>,
}

impl Shared {
    fn new(groups: usize, blocks: &[RowBlock], order: &[usize]) -> Self {
        let mut place = vec![0; blocks.len()];
        order.iter().enumerate().for_each(|(k, &block)| place[block] = k);
        let mut at = vec![Vec::new(); groups];
        for (k, block) in blocks.iter().enumerate() {
            for &(group, _) in &block.touches {
                assert!(at[group].last() != Some(&k), "a group is touched once");
                at[group].push(k);
            }
        }
        Self { place, at }
    }

    /// For each column the later row blocks that share a group with it, by place, with repeats.
    fn rows_below(&self, blocks: &[RowBlock], order: &[usize]) -> Vec<Vec<usize>> {
        let later = |place: usize, block: &RowBlock| {
            let at = block.touches.iter().flat_map(|&(group, _)| &self.at[group]);
            at.map(|&other| self.place[other]).filter(|&other| other > place).collect()
        };
        order.iter().enumerate().map(|(place, &own)| later(place, &blocks[own])).collect()
    }

    /// Rows of entries of two row blocks in each group they share.
    fn pairs(&self, blocks: &[RowBlock], one: usize, other: usize) -> Vec<[u32; 2]> {
        let other = &blocks[other].touches;
        let with = |&(group, first): &(usize, usize)| {
            let (_, partner) = other.iter().find(|(g, _)| *g == group)?;
            Some([index(first / 3), index(partner / 3)])
        };
        blocks[one].touches.iter().filter_map(with).collect()
    }
}

/// Adds the fill: the parent of a column is its first row, and inherits its other rows.
fn fill(rows: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let mut rows = rows.to_vec();
    for k in 0..rows.len() {
        rows[k].sort_unstable();
        rows[k].dedup();
        let (head, tail) = rows.split_at_mut(k + 1);
        if let Some((&parent, rest)) = head[k].split_first() {
            tail[parent - k - 1].extend_from_slice(rest);
        }
    }
    rows
}
