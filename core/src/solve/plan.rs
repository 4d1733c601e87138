//! Working out a [`Pattern`](super::Pattern): order, fill, and the list of products.

use super::block::numbers;
use super::order::counted;
use super::pattern::{RowBlock, MOST};
use super::places::{is_armed, pairs};
use super::steps::{Below, Column, Earlier, Start, Steps, Touch, Update};

/// Lists every product, column by column; with the numbers that the blocks of L take.
pub(super) fn steps(
    blocks: &[RowBlock],
    first_rows: &[usize],
    order: &[usize],
    rows_below: &[Vec<usize>],
    touches: &[Vec<Touch>],
) -> (Steps, usize) {
    let mut lists = Lists::new(rows_below);
    let (mut steps, mut n_factors) = (Steps::default(), 0);
    for (place, rows) in rows_below.iter().enumerate() {
        let own = order[place];
        let size = blocks[own].size;
        let diagonal = index(n_factors);
        n_factors += numbers(size);
        let first = steps.below.len();
        for (&r, updates) in rows.iter().zip(&std::mem::take(&mut lists.updates[place])) {
            let other = order[r];
            let before = steps.pairs.len();
            steps.pairs.extend(pairs(&touches[other], &touches[own]));
            steps.updates.extend(updates);
            steps.below.push(Below {
                block: index(n_factors),
                size: index(blocks[other].size),
                row: index(first_rows[other]),
                pairs: index(steps.pairs.len() - before),
                updates: index(updates.len()),
            });
            n_factors += size * blocks[other].size;
        }
        let (row, size_there) = (index(first_rows[own]), index(size));
        let own_block = Earlier { block: 0, diagonal, row, size: size_there };
        lists.eliminate(rows_below, place, &steps.below[first..], own_block);
        let earlier = std::mem::take(&mut lists.earlier[place]);
        steps.earlier.extend(&earlier);
        steps.columns.push(Column {
            row,
            diagonal,
            earlier: index(earlier.len()),
            below: index(rows.len()),
            size: size as u8,
            pins: size == 2
                && touches[own].iter().all(|touch| touch.sign != 0.0)
                && earlier.iter().all(|earlier| earlier.size == 2)
                && steps.below[first..].iter().all(|below| below.size == 2),
        });
    }
    steps.starts(order, touches);
    (steps, n_factors)
}

impl Steps {
    /// The row blocks, once their columns are there: those with arms alone last.
    fn starts(&mut self, order: &[usize], touches: &[Vec<Touch>]) {
        let armed = |own: usize| is_armed(&touches[own]);
        let columns = || order.iter().zip(&self.columns);
        let mixed = columns().filter(|(own, _)| !armed(**own));
        let all: Vec<_> = mixed.chain(columns().filter(|(own, _)| armed(**own))).collect();
        self.n_mixed = all.iter().filter(|(own, _)| !armed(**own)).count();
        let start = |(own, column): &(&usize, &Column)| Start {
            row: column.row,
            diagonal: column.diagonal,
            touches: index(touches[**own].len()),
            size: column.size.into(),
        };
        self.starts = all.iter().map(start).collect();
        self.touches = all.iter().flat_map(|(own, _)| &touches[**own]).copied().collect();
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

    /// The products of the blocks of one column.
    fn eliminate(
        &mut self,
        rows_below: &[Vec<usize>],
        place: usize,
        below: &[Below],
        earlier: Earlier,
    ) {
        let rows = &rows_below[place];
        for (a, &r) in rows.iter().enumerate() {
            let block = below[a].block;
            self.earlier[r].push(Earlier { block, ..earlier });
            let mut at = 0;
            for (b, &s) in rows.iter().enumerate().skip(a + 1) {
                at += rows_below[r][at..].partition_point(|&row| row < s);
                let blocks = [below[b].block, block];
                self.updates[r][at].push(Update {
                    blocks,
                    diagonal: earlier.diagonal,
                    size: earlier.size,
                });
            }
        }
    }
}

pub(super) fn index(i: usize) -> u32 {
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

/// The order in which row blocks are eliminated, after all groups; with the work it took.
pub(super) fn order(groups: usize, blocks: &[RowBlock]) -> (Vec<usize>, usize) {
    let (n_first, starts) = (3 * groups, starts(blocks));
    let first: Vec<usize> = (0..n_first)
        .step_by(3)
        .chain(blocks.iter().zip(&starts).map(|(_, s)| n_first + s))
        .collect();
    let entries: Vec<(usize, usize)> = blocks
        .iter()
        .zip(&starts)
        .flat_map(|(b, s)| b.touches.iter().map(move |&(group, _)| (n_first + s, 3 * group)))
        .collect();
    let n = n_first + starts[blocks.len()];
    let (order, work) = counted(n_first, n, &entries, Some(&first));
    let starting = |i: &usize| i.checked_sub(n_first).and_then(|i| starts.binary_search(&i).ok());
    (order.iter().filter_map(starting).collect(), work)
}

/// For each column the rows of blocks below its diagonal, by place, ascending: later row blocks that share a
/// group with it, and fill.
pub(super) fn rows_below(groups: usize, blocks: &[RowBlock], order: &[usize]) -> Vec<Vec<usize>> {
    let mut place = vec![0; blocks.len()];
    order.iter().enumerate().for_each(|(k, &block)| place[block] = k);
    let mut at = vec![Vec::new(); groups];
    for (k, block) in blocks.iter().enumerate() {
        for &(group, _) in &block.touches {
            assert!(at[group].last() != Some(&place[k]), "a group is touched once");
            at[group].push(place[k]);
        }
    }
    let later = |(place, &own): (usize, &usize)| -> Vec<usize> {
        let sharing = blocks[own].touches.iter().flat_map(|&(group, _)| &at[group]);
        sharing.copied().filter(|&other| other > place).collect()
    };
    fill(order.iter().enumerate().map(later).collect())
}

/// Adds the fill: the parent of a column is its first row, and inherits its other rows.
fn fill(mut rows: Vec<Vec<usize>>) -> Vec<Vec<usize>> {
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
