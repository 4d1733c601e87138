//! The pattern of a sparse LDLᵀ factor, worked out once for all numbers to come.
//!
//! Column k of L has the pattern of column k of A below the diagonal, united with the patterns of its
//! children in the elimination tree (Davis, *Direct Methods for Sparse Linear Systems*, 2006, ch. 4).
//! Elimination is right-looking: column k subtracts its outer product from the columns after it; where
//! each product lands is stored here, so that the numeric phase only multiplies.

/// Up to this many rows a column lists its products one by one, above it runs of neighbouring products:
/// a list is fastest for the short columns of mechanisms, runs vectorise and save memory for long ones.
pub(super) const SHORT: usize = 8;

/// A product of rows a < b of a short column, and where it lands in the lower part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Product {
    pub target: u32,
    pub a: u32,
    pub b: u32,
}

/// Neighbouring products of a long column: of one row with `length` rows from the next unused one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub target: u32,
    pub length: u32,
}

/// Where a column finds its rows and products.
#[derive(Clone, Copy, Debug)]
pub(super) struct Column {
    /// Positions in the lower part.
    pub start: u32,
    pub end: u32,
    /// In `products` for a short column, in `runs` for a long one.
    pub first_update: u32,
    pub end_update: u32,
}

/// The static pattern of A = L D Lᵀ (with A symmetrically permuted), shared by any number of factors.
#[derive(Clone, Debug)]
pub struct Symbolic {
    /// Number of unknowns.
    pub(super) n: usize,
    /// Unknown eliminated k-th.
    pub(super) order: Vec<u32>,
    /// Positions of the entries, in the numbering of the caller.
    pub(super) entries: Vec<(u32, u32)>,
    /// Where each entry is summed: k for the diagonal, n + position in the lower part below it.
    pub(super) slot: Vec<u32>,
    pub(super) columns: Vec<Column>,
    /// Row of each position of the lower part, in elimination order; ascending within a column.
    pub(super) row: Vec<u32>,
    /// Column and row of each position, in the numbering of the caller.
    pub(super) unknowns: Vec<(u32, u32)>,
    pub(super) products: Vec<Product>,
    pub(super) runs: Vec<Run>,
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
        let place = inverse(n, order);
        let below = below_diagonal(n, entries, &place);
        let pattern = Pattern::new(&fill(below));
        let slot = entries.iter().map(|&e| slot(n, e, &place, &pattern)).collect();
        let mut symbolic = Self {
            n,
            order: order.iter().map(|&i| index(i)).collect(),
            entries: entries.iter().map(|&(i, j)| (index(i), index(j))).collect(),
            slot,
            columns: Vec::with_capacity(n),
            unknowns: pattern.unknowns(order),
            row: Vec::new(),
            products: Vec::new(),
            runs: Vec::new(),
        };
        for k in 0..n {
            symbolic.push_column(k, &pattern);
        }
        symbolic.row = pattern.row;
        symbolic
    }

    /// Stores where the products of column k land.
    fn push_column(&mut self, k: usize, pattern: &Pattern) {
        let rows = pattern.rows(k);
        let short = rows.len() <= SHORT;
        let count = |s: &Self| index(if short { s.products.len() } else { s.runs.len() });
        let first_update = count(self);
        let start = pattern.start[k];
        for (a, &j) in rows.iter().enumerate() {
            let places = pattern.landing(j as usize, &rows[a + 1..]);
            if short {
                self.products.extend(places.iter().zip(a + 1..).map(|(&target, b)| Product {
                    target,
                    a: start + index(a),
                    b: start + index(b),
                }));
            } else {
                push_runs(&places, &mut self.runs);
            }
        }
        self.columns.push(Column {
            start: pattern.start[k],
            end: pattern.start[k + 1],
            first_update,
            end_update: count(self),
        });
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
fn below_diagonal(n: usize, entries: &[(usize, usize)], place: &[usize]) -> Vec<Vec<u32>> {
    let mut below = vec![Vec::new(); n];
    for &(i, j) in entries {
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

/// The lower part of L, column by column.
struct Pattern {
    /// First position of each column, and the end of the last; length n + 1.
    start: Vec<u32>,
    row: Vec<u32>,
}

impl Pattern {
    fn new(columns: &[Vec<u32>]) -> Self {
        let (mut start, mut row) = (vec![0], Vec::new());
        for rows in columns {
            row.extend_from_slice(rows);
            start.push(index(row.len()));
        }
        Self { start, row }
    }

    fn rows(&self, k: usize) -> &[u32] {
        &self.row[self.start[k] as usize..self.start[k + 1] as usize]
    }

    /// Position of `row` in column k, which contains it.
    fn position(&self, k: usize, row: u32) -> usize {
        self.start[k] as usize + self.rows(k).partition_point(|&r| r < row)
    }

    /// Positions of ascending `rows` in column j, which contains them.
    fn landing(&self, j: usize, rows: &[u32]) -> Vec<u32> {
        let Some(&first) = rows.first() else { return Vec::new() };
        let mut at = self.position(j, first);
        let place = |&r: &u32| {
            while self.row[at] != r {
                at += 1;
            }
            index(at)
        };
        rows.iter().map(place).collect()
    }

    fn unknowns(&self, order: &[usize]) -> Vec<(u32, u32)> {
        let columns = order.iter().enumerate();
        columns
            .flat_map(|(k, &i)| {
                self.rows(k).iter().map(move |&r| (index(i), index(order[r as usize])))
            })
            .collect()
    }
}

fn slot(n: usize, (i, j): (usize, usize), place: &[usize], pattern: &Pattern) -> u32 {
    let (a, b) = (place[i].min(place[j]), place[i].max(place[j]));
    if a == b {
        return index(a);
    }
    index(n + pattern.position(a, index(b)))
}

fn push_runs(places: &[u32], runs: &mut Vec<Run>) {
    let mut rest = places;
    while let Some(&target) = rest.first() {
        let length = rest.iter().zip(target..).take_while(|(&place, next)| place == *next).count();
        runs.push(Run { target, length: index(length) });
        rest = &rest[length..];
    }
}
