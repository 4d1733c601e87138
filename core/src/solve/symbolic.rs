//! The pattern of a sparse LDLᵀ factor, worked out once for all numbers to come.
//!
//! Column k of L has the pattern of column k of A below the diagonal, united with the patterns of its
//! children in the elimination tree (Davis, *Direct Methods for Sparse Linear Systems*, 2006, ch. 4).
//! Elimination is right-looking: column k subtracts its outer product from the columns after it; where
//! each product lands is stored here, so that the numeric phase only multiplies.

/// Up to this many rows a column stores where each product lands, above it runs of products: an index
/// each is fastest for the short columns of mechanisms, runs vectorise and save memory for long ones.
pub(super) const SHORT: usize = 8;

/// No entry: beyond the end of any list of values.
const NONE: u32 = u32::MAX;

/// The static pattern of A = L D Lᵀ (with A symmetrically permuted), shared by any number of factors.
#[derive(Clone, Debug)]
pub struct Symbolic {
    /// Number of unknowns.
    pub(super) n: usize,
    /// Unknown eliminated k-th.
    pub(super) order: Vec<u32>,
    /// Positions of the entries, in the numbering of the caller.
    pub(super) entries: Vec<(u32, u32)>,
    /// The entry that stands first in each slot, [`NONE`] where fill begins with zero. Slots are the
    /// diagonal, then the positions of L; length n + fill.
    pub(super) source: Vec<u32>,
    /// Further entries (entry, slot) at positions that were named before.
    pub(super) repeated: Vec<(u32, u32)>,
    /// First position of each column of L, and the end of the last; length n + 1.
    pub(super) column: Vec<u32>,
    /// Row of each position of L, in elimination order; ascending within a column.
    pub(super) row: Vec<u32>,
    /// The same row in the numbering of the caller.
    pub(super) unknown: Vec<u32>,
    /// Column by column: its rows, then where products of its rows a < b land, counted from the end of
    /// that column in L: one place per product for a short column, (first, length) of each run for a
    /// long one.
    pub(super) plan: Vec<u32>,
}

impl Symbolic {
    /// Pattern of a symmetric n × n matrix given by `entries`, the structural (row, column) positions
    /// of one triangle, eliminated in `order` (a permutation of `0..n`).
    ///
    /// An entry off the diagonal stands for its mirror image too; entries at the same position, or at
    /// mirrored ones, are summed. A diagonal position need not be listed: it is then zero.
    ///
    /// # Panics
    /// If an index is outside `0..n`, `order` is no permutation, or the factor has 2³² entries.
    pub fn new(n: usize, entries: &[(usize, usize)], order: &[usize]) -> Self {
        Self::sparse(n, entries, &vec![true; entries.len()], order)
    }

    /// The same with entries that are zero whatever happens: those not `present` get no place in the
    /// factor, and their values are not read by it.
    ///
    /// # Panics
    /// As [`Symbolic::new`], or if `present` is not as long as `entries`.
    pub fn sparse(n: usize, entries: &[(usize, usize)], present: &[bool], order: &[usize]) -> Self {
        assert_eq!(entries.len(), present.len(), "a flag for each entry");
        let place = inverse(n, order);
        let stored: Vec<_> = entries.iter().copied().enumerate().filter(|e| present[e.0]).collect();
        let below = below_diagonal(n, stored.iter().map(|e| e.1), &place);
        let patterns = fill(below);
        let mut column = vec![0_u32];
        let mut row = Vec::new();
        for pattern in &patterns {
            row.extend_from_slice(pattern);
            column.push(index(row.len()));
        }
        let (mut source, mut repeated) = (vec![NONE; n + row.len()], Vec::new());
        for &(entry, position) in &stored {
            let slot = slot(n, position, &place, &column, &row);
            match &mut source[slot as usize] {
                first if *first == NONE => *first = index(entry),
                _ => repeated.push((index(entry), slot)),
            }
        }
        let plan = plan(n, &column, &row);
        Self {
            n,
            order: order.iter().map(|&i| index(i)).collect(),
            entries: entries.iter().map(|&(i, j)| (index(i), index(j))).collect(),
            source,
            repeated,
            unknown: row.iter().map(|&r| index(order[r as usize])).collect(),
            column,
            row,
            plan,
        }
    }

    /// Number of unknowns.
    pub fn len(&self) -> usize {
        self.n
    }

    /// Whether there are no unknowns.
    pub fn is_empty(&self) -> bool {
        self.n == 0
    }

    /// Number of entries of L below the diagonal, fill included.
    pub fn fill(&self) -> usize {
        self.row.len()
    }

    /// Positions of column k in L.
    #[inline(always)]
    pub(super) fn range(&self, k: usize) -> std::ops::Range<usize> {
        self.column[k] as usize..self.column[k + 1] as usize
    }
}

fn index(i: usize) -> u32 {
    u32::try_from(i).expect("fewer than 2^32 entries")
}

/// place[i]: when unknown i is eliminated.
fn inverse(n: usize, order: &[usize]) -> Vec<usize> {
    assert_eq!(order.len(), n, "the order names every unknown once");
    let mut place = vec![n; n];
    for (k, &i) in order.iter().enumerate() {
        assert!(place[i] == n, "unknown {i} is eliminated twice");
        place[i] = k;
    }
    place
}

/// Rows of A below the diagonal of each column, in elimination order, unsorted, with repeats.
fn below_diagonal(
    n: usize,
    entries: impl Iterator<Item = (usize, usize)>,
    place: &[usize],
) -> Vec<Vec<u32>> {
    let mut below = vec![Vec::new(); n];
    for (i, j) in entries {
        let (a, b) = (place[i], place[j]);
        if a != b {
            below[a.min(b)].push(index(a.max(b)));
        }
    }
    below
}

/// Adds the fill: the parent of column k is its first row, and inherits its other rows.
fn fill(mut patterns: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
    let n = patterns.len();
    for k in 0..n {
        patterns[k].sort_unstable();
        patterns[k].dedup();
        let (head, tail) = patterns.split_at_mut(k + 1);
        if let Some((&parent, rest)) = head[k].split_first() {
            tail[parent as usize - k - 1].extend_from_slice(rest);
        }
    }
    patterns
}

fn slot(n: usize, (i, j): (usize, usize), place: &[usize], column: &[u32], row: &[u32]) -> u32 {
    let (a, b) = (place[i].min(place[j]), place[i].max(place[j]));
    if a == b {
        return index(a);
    }
    index(n + position(a, index(b), column, row))
}

/// Position in L of `row` in column k; the pattern contains it.
fn position(k: usize, wanted: u32, column: &[u32], row: &[u32]) -> usize {
    let (start, end) = (column[k] as usize, column[k + 1] as usize);
    start + row[start..end].partition_point(|&r| r < wanted)
}

/// The rows of each column and where its products land.
fn plan(n: usize, column: &[u32], row: &[u32]) -> Vec<u32> {
    let mut plan = Vec::new();
    let mut places = Vec::new();
    for k in 0..n {
        let (first, end) = (column[k] as usize, column[k + 1] as usize);
        let pattern = &row[first..end];
        plan.extend_from_slice(pattern);
        for (a, &j) in pattern.iter().enumerate() {
            landing(j as usize, &pattern[a + 1..], column, row, end, &mut places);
            if pattern.len() <= SHORT {
                plan.extend_from_slice(&places);
            } else {
                push_runs(&places, &mut plan);
            }
        }
    }
    plan
}

/// Positions of `rows` in column j, counted from `base`.
fn landing(
    j: usize,
    rows: &[u32],
    column: &[u32],
    row: &[u32],
    base: usize,
    places: &mut Vec<u32>,
) {
    places.clear();
    let Some(&first) = rows.first() else { return };
    let mut at = position(j, first, column, row);
    for &r in rows {
        while row[at] != r {
            at += 1;
        }
        places.push(index(at - base));
    }
}

fn push_runs(places: &[u32], plan: &mut Vec<u32>) {
    let mut rest = places;
    while let Some(&first) = rest.first() {
        let length = rest.iter().zip(first..).take_while(|(&place, next)| place == *next).count();
        plan.extend([first, index(length)]);
        rest = &rest[length..];
    }
}
