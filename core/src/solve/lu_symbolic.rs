//! Symbolic LU factorisation without pivoting between blocks: order, fill, and where each product goes, found once.
//!
//! For a matrix of blocks of at most 3 × 3 with a symmetric pattern (its numbers need not be): bodies
//! coupled by forces and constraints. Symbolic factorisation by the elimination tree: the pattern below
//! column k is what k is joined to, and what its children in the tree leave (Liu, *The role of
//! elimination trees in sparse factorization*, SIAM J. Matrix Anal. Appl. 11 (1990) 134).

use super::order::touched_first;
use std::ops::Range;

/// Pattern, order and plan of a block matrix [S Gᵀ; G -μ].
#[derive(Clone, Debug)]
pub struct LuPlan {
    /// Number of rows of each block, in the caller's numbering.
    sizes: Vec<usize>,
    /// First unknown of each block.
    starts: Vec<usize>,
    /// `order[k]` is eliminated k-th.
    pub(super) order: Vec<usize>,
    position: Vec<usize>,
    /// For each step of the elimination, its part of `below`.
    pub(super) columns: Vec<Range<usize>>,
    /// Positions of the blocks below the diagonal, ascending in each column.
    pub(super) below: Vec<u32>,
    /// For each column, the blocks that receive L U, row by row.
    pub(super) targets: Vec<u32>,
}

impl LuPlan {
    /// For blocks of `sizes` rows (1 to 3), of which the first `n_first` are to be eliminated before
    /// those of the others that they have an entry with. `entries` are the positions (block, block) that
    /// may differ from zero, in one triangle or both; the diagonal is always stored.
    ///
    /// # Panics
    /// If a size is not 1 to 3, or an index is outside the blocks.
    pub fn new(sizes: Vec<usize>, n_first: usize, entries: &[(usize, usize)]) -> Self {
        assert!(sizes.iter().all(|size| (1..=3).contains(size)), "blocks of 1 to 3 rows");
        let n = sizes.len();
        let order = touched_first(n_first, n, entries);
        let mut position = vec![0; n];
        order.iter().enumerate().for_each(|(k, &block)| position[block] = k);
        let starts = sizes
            .iter()
            .scan(0, |next, size| {
                let start = *next;
                *next += size;
                Some(start)
            })
            .collect();
        let (columns, below) = structure(&position, entries);
        let mut plan = Self { sizes, starts, order, position, columns, below, targets: Vec::new() };
        plan.targets = plan.plan();
        plan
    }

    /// Number of blocks along the diagonal.
    pub fn blocks(&self) -> usize {
        self.sizes.len()
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.sizes.iter().sum()
    }

    /// Number of blocks stored: diagonal, lower and upper.
    pub fn stored(&self) -> usize {
        self.blocks() + 2 * self.below.len()
    }

    /// Rows of the k-th eliminated block among the unknowns.
    pub(super) fn rows(&self, k: usize) -> Range<usize> {
        let block = self.order[k];
        self.starts[block]..self.starts[block] + self.sizes[block]
    }

    /// Where the block at (row, column) is stored.
    ///
    /// # Panics
    /// If it is not in the pattern.
    pub fn slot(&self, row: usize, column: usize) -> usize {
        self.place(self.position[row], self.position[column])
    }

    /// The same by positions in the order of elimination.
    fn place(&self, i: usize, j: usize) -> usize {
        if i == j {
            return i;
        }
        let (k, other) = (i.min(j), i.max(j));
        let range = self.columns[k].clone();
        let found = self.below[range.clone()].binary_search(&(other as u32));
        let at = range.start + found.expect("a block of the pattern");
        self.blocks() + at + if i > j { 0 } else { self.below.len() }
    }

    fn plan(&self) -> Vec<u32> {
        let mut targets = Vec::new();
        for range in &self.columns {
            let below = &self.below[range.clone()];
            for &i in below {
                for &j in below {
                    targets.push(self.place(i as usize, j as usize) as u32);
                }
            }
        }
        targets
    }
}

/// Pattern of L by columns.
fn structure(position: &[usize], entries: &[(usize, usize)]) -> (Vec<Range<usize>>, Vec<u32>) {
    let n = position.len();
    let mut own = vec![Vec::new(); n];
    for &(a, b) in entries {
        let (a, b) = (position[a], position[b]);
        if a != b {
            own[a.min(b)].push(a.max(b));
        }
    }
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); n];
    let mut seen = vec![usize::MAX; n];
    let (mut columns, mut below) = (Vec::<Range<usize>>::with_capacity(n), Vec::new());
    for k in 0..n {
        let start = below.len();
        seen[k] = k;
        let mut add = |i: usize, below: &mut Vec<u32>| {
            if seen[i] != k {
                seen[i] = k;
                below.push(i as u32);
            }
        };
        own[k].iter().for_each(|&i| add(i, &mut below));
        for &child in &children[k] {
            let range: Range<usize> = columns[child].clone();
            for at in range {
                add(below[at] as usize, &mut below);
            }
        }
        below[start..].sort_unstable();
        if let Some(&parent) = below.get(start) {
            children[parent as usize].push(k);
        }
        columns.push(start..below.len());
    }
    (columns, below)
}
