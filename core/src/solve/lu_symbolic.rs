//! Symbolic LU factorisation without pivoting between blocks: elimination order, fill, and the target of each
//! product.
//!
//! The matrix consists of blocks of at most 3 × 3 and has a symmetric pattern, but its values need not be symmetric.
//! Such a matrix describes bodies coupled by forces and constraints. The factorisation uses the elimination tree: the
//! pattern below column k is the union of its own entries and of the patterns that its children leave (Liu, *The role
//! of elimination trees in sparse factorization*, SIAM J. Matrix Anal. Appl. 11 (1990) 134).

use super::order::touched_first;
use crate::math::Listed;
use std::ops::Range;

/// Pattern, elimination order and plan of a block matrix [S Gᵀ; G -μ].
#[derive(Clone, Debug)]
pub struct LuPlan {
    /// Number of rows of each block, in the caller's numbering.
    sizes: Vec<usize>,
    /// First unknown of each block.
    starts: Vec<usize>,
    /// The block `order[k]` is eliminated k-th.
    pub(super) order: Vec<usize>,
    position: Vec<usize>,
    /// For each step of the elimination, its range of `below`.
    pub(super) columns: Vec<Range<usize>>,
    /// Positions of the blocks below the diagonal, ascending in each column.
    pub(super) below: Vec<u32>,
    /// For each column, the blocks from which a product L U is subtracted, row by row.
    pub(super) targets: Vec<u32>,
}

impl LuPlan {
    /// A plan for blocks with `sizes` rows (1 to 3). Each of the first `n_first` blocks is eliminated before the
    /// later blocks with which it shares an entry. `entries` are the positions (block, block) that may be nonzero, in
    /// one triangle or both. The diagonal is always stored.
    ///
    /// # Panics
    /// If a size is not 1 to 3, or an index is out of range.
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
            .list();
        let (columns, below) = structure(&position, entries);
        let mut plan = Self { sizes, starts, order, position, columns, below, targets: Vec::new() };
        plan.targets = plan.plan();
        plan
    }

    /// Number of blocks along the diagonal.
    #[inline]
    pub fn blocks(&self) -> usize {
        self.sizes.len()
    }

    /// Number of unknowns.
    #[inline]
    pub fn unknowns(&self) -> usize {
        self.sizes.iter().sum()
    }

    /// Number of stored blocks: diagonal, lower and upper.
    #[inline]
    pub fn stored(&self) -> usize {
        self.blocks() + 2 * self.below.len()
    }

    /// The unknowns of the k-th eliminated block.
    #[inline]
    pub(super) fn rows(&self, k: usize) -> Range<usize> {
        let block = self.order[k];
        self.starts[block]..self.starts[block] + self.sizes[block]
    }

    /// The slot in which the block at (row, column) is stored.
    ///
    /// # Panics
    /// If the block is not in the pattern.
    #[inline]
    pub fn slot(&self, row: usize, column: usize) -> usize {
        self.place(self.position[row], self.position[column])
    }

    /// The slot of a block, by positions in the order of elimination.
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

/// Pattern of L, by columns.
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
