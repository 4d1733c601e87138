//! Symbolic factorisation: elimination order, fill, and the elimination program.

use super::block::numbers;
use super::order::groups_first;
use super::records::{Below, Left, Pair, Program, Row, Start, Touch, Update};
use super::storage::is_pin_only;
use super::structure::{index, row_starts, RowBlock};
use crate::math::{each, Listed};

/// The program with all products, row by row, and the number of values in the blocks of L.
pub(super) fn program(
    blocks: &[RowBlock],
    first_rows: &[usize],
    order: &[usize],
    rows_below: &[Vec<usize>],
    touches: &[Vec<Touch>],
) -> (Program, usize) {
    let (of_rows, n_factors) = Factors::new(blocks, order, rows_below);
    let updates = of_rows.updates(blocks, order, rows_below);
    let (row, size) = (|own: usize| index(first_rows[own]), |own: usize| index(blocks[own].size));
    let mut program = Program::default();
    for (place, &own) in order.iter().enumerate() {
        let first = (program.left.len(), program.below.len());
        for &Place { column, at, block } in &of_rows.left[place] {
            let (other, before) = (order[column], program.pairs.len());
            program.pairs.extend(pairs(&touches[own], &touches[other]));
            let updates = &updates[column][at];
            program.updates.extend(updates);
            program.left.push(Left {
                block,
                diagonal: of_rows.diagonals[column],
                row: row(other),
                size: size(other),
                pairs: index(program.pairs.len() - before),
                updates: index(updates.len()),
            });
        }
        for (&r, &block) in rows_below[place].iter().zip(&of_rows.below[place]) {
            program.below.push(Below { block, row: row(order[r]), size: size(order[r]) });
        }
        let (left, below) = (&program.left[first.0..], &program.below[first.1..]);
        let pins = is_pin_only(&touches[own]) && left.iter().all(|left| left.size == 2);
        program.rows.push(Row {
            row: row(own),
            diagonal: of_rows.diagonals[place],
            left: index(left.len()),
            below: index(below.len()),
            size: blocks[own].size as u8,
            pins,
            pins_below: pins && below.iter().all(|below| below.size == 2),
        });
    }
    program.starts(order, touches);
    (program, n_factors)
}

impl Program {
    /// Adds the row blocks with their diagonal blocks, except those that consist of pin blocks only.
    fn starts(&mut self, order: &[usize], touches: &[Vec<Touch>]) {
        for (&own, row) in
            order.iter().zip(&self.rows).filter(|(own, _)| !is_pin_only(&touches[**own]))
        {
            let (count, size) = (index(touches[own].len()), row.size.into());
            self.starts.push(Start { row: row.row, diagonal: row.diagonal, touches: count, size });
            self.touches.extend(&touches[own]);
        }
    }
}

/// Two row blocks, once for each group that they share.
fn pairs<'a>(one: &'a [Touch], other: &'a [Touch]) -> impl Iterator<Item = Pair> + 'a {
    one.iter().filter_map(|own| {
        let partner = other.iter().find(|t| t.group == own.group)?;
        let [sign, of_partner] = each([own, partner], |touch| f64::from(touch.sign));
        let sign = if sign == 0.0 { of_partner } else { sign * of_partner };
        Some(Pair { first: [own.first, partner.first], sign })
    })
}

/// A block of L left of the diagonal: its column, its position below the diagonal in this column, and its index.
struct Place {
    column: usize,
    at: usize,
    block: u32,
}

/// The places of the blocks of L.
struct Factors {
    diagonals: Vec<u32>,
    /// The blocks of each row.
    left: Vec<Vec<Place>>,
    /// The indices of the same blocks, by column and position in it.
    below: Vec<Vec<u32>>,
}

impl Factors {
    fn new(blocks: &[RowBlock], order: &[usize], rows_below: &[Vec<usize>]) -> (Self, usize) {
        let mut left: Vec<Vec<Place>> = order.iter().map(|_| Vec::new()).list();
        for (column, rows) in rows_below.iter().enumerate() {
            for (at, &r) in rows.iter().enumerate() {
                left[r].push(Place { column, at, block: 0 });
            }
        }
        let mut below: Vec<Vec<u32>> = rows_below.iter().map(|rows| vec![0; rows.len()]).list();
        let (mut diagonals, mut n) = (Vec::with_capacity(order.len()), 0);
        for (left, &own) in left.iter_mut().zip(order) {
            let size = blocks[own].size;
            for place in left {
                place.block = index(n);
                below[place.column][place.at] = place.block;
                n += size * blocks[order[place.column]].size;
            }
            diagonals.push(index(n));
            n += numbers(size);
        }
        (Self { diagonals, left, below }, n)
    }

    /// The products that are subtracted from each block below the diagonal, by column and position in it. Each is a
    /// product of two blocks of an earlier column, one column after the other.
    fn updates(
        &self,
        blocks: &[RowBlock],
        order: &[usize],
        rows_below: &[Vec<usize>],
    ) -> Vec<Vec<Vec<Update>>> {
        let none = |rows: &Vec<usize>| vec![Vec::new(); rows.len()];
        let mut updates: Vec<Vec<Vec<Update>>> = rows_below.iter().map(none).list();
        for (place, (rows, below)) in rows_below.iter().zip(&self.below).enumerate() {
            let (diagonal, size) = (self.diagonals[place], index(blocks[order[place]].size));
            for (a, &r) in rows.iter().enumerate() {
                let mut at = 0;
                for (b, &s) in rows.iter().enumerate().skip(a + 1) {
                    at += rows_below[r][at..].partition_point(|&row| row < s);
                    updates[r][at].push(Update { blocks: [below[b], below[a]], diagonal, size });
                }
            }
        }
        updates
    }
}

/// The order in which row blocks are eliminated, after all groups.
pub(super) fn order(groups: usize, blocks: &[RowBlock]) -> Vec<usize> {
    let (n_first, starts) = (3 * groups, row_starts(blocks));
    let first: Vec<usize> =
        (0..n_first).step_by(3).chain(blocks.iter().zip(&starts).map(|(_, s)| n_first + s)).list();
    let entries: Vec<(usize, usize)> = blocks
        .iter()
        .zip(&starts)
        .flat_map(|(b, s)| b.touches.iter().map(move |&(group, _)| (n_first + s, 3 * group)))
        .list();
    let n = n_first + starts[blocks.len()];
    let order = groups_first(n_first, n, &entries, Some(&first));
    let starting = |i: &usize| i.checked_sub(n_first).and_then(|i| starts.binary_search(&i).ok());
    order.iter().filter_map(starting).list()
}

/// For each column, the block rows below its diagonal in ascending order: later row blocks that share a group with
/// it, and fill.
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
        sharing.copied().filter(|&other| other > place).list()
    };
    fill(order.iter().enumerate().map(later).list())
}

/// Adds the fill. The parent of a column is its first row, and inherits its other rows.
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
