//! Working out a [`Pattern`](super::Pattern): order, fill, and the list of products.

use super::order::groups_first;
use super::pattern::{Below, Column, Earlier, Owner, Pair, RowBlock, Touch, Update, MOST};

/// Lists every product, column by column; with the number of columns of the blocks below the diagonal.
pub(super) fn columns(
    blocks: &[RowBlock],
    starts: &[usize],
    order: &[usize],
    rows_below: &[Vec<usize>],
    places: &Places,
) -> (Vec<Column>, usize) {
    let mut lists = Lists::new(rows_below);
    let (mut columns, mut n_lower) = (Vec::with_capacity(order.len()), 0);
    for (place, rows) in rows_below.iter().enumerate() {
        let own = order[place];
        let (size, row) = (index(blocks[own].size), index(starts[own]));
        let mut offsets = Vec::with_capacity(rows.len());
        for _ in rows {
            offsets.push(index(n_lower));
            n_lower += blocks[own].size;
        }
        lists.eliminate(rows_below, place, &offsets, (row, size));
        let below = rows.iter().zip(&offsets).zip(&lists.updates[place]);
        let below = below.map(|((&r, &block), updates)| Below {
            block,
            size: index(blocks[order[r]].size),
            row: index(starts[order[r]]),
            pairs: places.pairs(order[r], own).into(),
            updates: updates.as_slice().into(),
        });
        let mut column = Column {
            size,
            row,
            pins: false,
            touches: places.touches[own].as_slice().into(),
            earlier: lists.earlier[place].as_slice().into(),
            below: below.collect(),
        };
        column.pins = column.is_of_pins();
        columns.push(column);
    }
    (columns, n_lower)
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
pub(super) fn starts(blocks: &[RowBlock]) -> Vec<usize> {
    let mut starts = vec![0];
    for block in blocks {
        assert!((1..=MOST).contains(&block.size), "blocks of one to three rows");
        starts.push(starts[starts.len() - 1] + block.size);
    }
    starts
}

/// Number of rows of three entries.
///
/// # Panics
/// If blocks share an entry, or leave one out.
pub(super) fn check_entries(blocks: &[RowBlock]) -> usize {
    let touches = || blocks.iter().flat_map(|b| b.touches.iter().map(move |t| (b.size, t.1)));
    let mut owned = vec![false; touches().map(|(size, _)| size).sum()];
    for (size, first) in touches() {
        assert!(first % 3 == 0, "whole rows of entries");
        for owned in &mut owned[first / 3..first / 3 + size] {
            assert!(!*owned, "an entry belongs to one block");
            *owned = true;
        }
    }
    owned.len()
}

/// First rows of the blocks that begin with ±I, with the sign.
pub(super) fn units(blocks: &[RowBlock]) -> Vec<(usize, f64)> {
    let of = |b: &RowBlock| {
        let firsts = b.touches.iter().map(|(_, first)| first / 3);
        firsts.zip(b.signs.iter().copied()).collect::<Vec<_>>()
    };
    blocks.iter().flat_map(of).collect()
}

/// Where the transformed rows of each row block are: arms in groups at which all are pairs of rows
/// [±I b], rows of U in the others.
pub(super) struct Places {
    /// For each row block.
    pub touches: Vec<Vec<Touch>>,
    pub general: Vec<Owner>,
    pub arms: Vec<Owner>,
}

impl Places {
    pub fn new(coupled: &[bool], blocks: &[RowBlock]) -> Self {
        let mut with_arms = vec![true; coupled.len()];
        for block in blocks {
            let unit = block.size == 2 && block.signs.len() == block.touches.len();
            assert!(unit || block.signs.is_empty(), "one sign for each group, of two rows");
            block.touches.iter().for_each(|&(group, _)| with_arms[group] &= unit);
        }
        let mut places = Self { touches: vec![], general: vec![], arms: vec![] };
        for block in blocks {
            let touch = |(k, &(group, first)): (usize, &(usize, usize))| {
                let sign = if with_arms[group] { block.signs[k] } else { 0.0 };
                let owner = |r| Owner {
                    row: index(first / 3 + r),
                    group: index(group),
                    coupled: coupled[group],
                    sign,
                };
                let (list, rows) = match with_arms[group] {
                    true => (&mut places.arms, 1),
                    false => (&mut places.general, block.size),
                };
                let first = index(list.len());
                list.extend((0..rows).map(owner));
                Touch { first, unknown: index(3 * group), sign }
            };
            let touches = block.touches.iter().enumerate().map(touch).collect();
            places.touches.push(touches);
        }
        places
    }

    /// Two row blocks in each group that they share.
    fn pairs(&self, one: usize, other: usize) -> Vec<Pair> {
        let other = &self.touches[other];
        let with = |own: &Touch| {
            let partner = other.iter().find(|t| t.unknown == own.unknown)?;
            Some(Pair { first: [own.first, partner.first], sign: own.sign * partner.sign })
        };
        self.touches[one].iter().filter_map(with).collect()
    }
}

/// The order in which row blocks are eliminated, after all groups.
pub(super) fn order(groups: usize, blocks: &[RowBlock], starts: &[usize]) -> Vec<usize> {
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
pub(super) struct Shared {
    /// Elimination place of each row block.
    place: Vec<usize>,
    /// Row blocks at each group.
    at: Vec<Vec<usize>>,
}

impl Shared {
    pub fn new(groups: usize, blocks: &[RowBlock], order: &[usize]) -> Self {
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
    pub fn rows_below(&self, blocks: &[RowBlock], order: &[usize]) -> Vec<Vec<usize>> {
        let later = |place: usize, block: &RowBlock| {
            let at = block.touches.iter().flat_map(|&(group, _)| &self.at[group]);
            at.map(|&other| self.place[other]).filter(|&other| other > place).collect()
        };
        order.iter().enumerate().map(|(place, &own)| later(place, &blocks[own])).collect()
    }
}

/// Adds the fill: the parent of a column is its first row, and inherits its other rows.
pub(super) fn fill(rows: &[Vec<usize>]) -> Vec<Vec<usize>> {
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
