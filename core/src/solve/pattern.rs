//! The pattern of a saddle-point matrix [W Aᵀ; A -μI] and the plan of its elimination, worked out once.
//!
//! W is block diagonal, 3 × 3 for each group of three unknowns; the rows of A come in blocks of one to
//! three that touch the same groups. What is factorised is S = A W⁻¹ Aᵀ + μ I, one block for each two
//! row blocks that share a group, and fill (Davis, *Direct Methods for Sparse Linear Systems*, 2006,
//! ch. 4). The plan is left-looking: for every block of L it names the products that make it, so that a
//! block is computed in registers and written once.

use super::plan::{self, Places, Shared};

/// Most rows of a block, and unknowns of a group.
pub(super) const MOST: usize = 3;

/// Some rows of A that touch the same groups.
#[derive(Clone, Debug, PartialEq)]
pub struct RowBlock {
    /// Number of rows, 1 to 3.
    pub size: usize,
    /// The groups touched, each once, with the first of the three entries of A there: row by row
    /// `size` × 3 entries. The index is a multiple of three.
    pub touches: Vec<(usize, usize)>,
    /// For two rows whose first two columns are I or -I in every group touched: the signs, one for
    /// each. Empty for other rows.
    pub signs: Vec<f64>,
}

/// The pattern and the plan, shared by any number of factors.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// Whether the third unknown of each group is coupled to the other two in W.
    pub(super) coupled: Vec<bool>,
    pub(super) n_rows: usize,
    pub(super) n_entries: usize,
    /// Rows of entries that have a row in U.
    pub(super) general: Vec<Owner>,
    /// Pairs of rows [±I b] that have an arm.
    pub(super) arms: Vec<Owner>,
    /// First rows of the blocks that begin with ±I, with the sign.
    pub(super) units: Vec<(usize, f64)>,
    /// Columns of L, in elimination order.
    pub(super) columns: Vec<Column>,
    /// Columns of all blocks of L below the diagonal.
    pub(super) n_lower: usize,
}

/// Where a row of three entries of A, or a pair of them, stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Owner {
    /// The row of entries, the first of a pair.
    pub row: u32,
    pub group: u32,
    pub coupled: bool,
    /// Of the unit block of an arm.
    pub sign: f64,
}

/// One column of blocks of L.
#[derive(Clone, Debug)]
pub(super) struct Column {
    /// Rows of its row block.
    pub size: u32,
    /// The first of them.
    pub row: u32,
    /// Whether nothing but pairs of rows with arms takes part in it, as at pin joints among themselves.
    pub pins: bool,
    pub touches: Box<[Touch]>,
    /// The blocks left of its diagonal block.
    pub earlier: Box<[Earlier]>,
    pub below: Box<[Below]>,
}

/// A group that a row block touches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    /// First row of U, or the arm.
    pub first: u32,
    /// First unknown of the group.
    pub unknown: u32,
    /// Of the unit block of an arm; 0 where rows of U are touched.
    pub sign: f64,
}

/// A block of L left of a diagonal block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Earlier {
    /// Its first column in the store of L.
    pub block: u32,
    /// First row, and size, of the row block eliminated there.
    pub row: u32,
    pub size: u32,
}

/// A block of L below the diagonal.
#[derive(Clone, Debug)]
pub(super) struct Below {
    /// Its first column in the store of L.
    pub block: u32,
    /// Size and first row of its row block.
    pub size: u32,
    pub row: u32,
    /// In each shared group.
    pub pairs: Box<[Pair]>,
    pub updates: Box<[Update]>,
}

/// Two row blocks in a group that they share.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    /// First rows of U, or arms: of the block's own row block, of the column's.
    pub first: [u32; 2],
    /// Product of the signs of two arms; 0 for rows of U.
    pub sign: f64,
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
        let starts = plan::starts(blocks);
        let order = plan::order(coupled.len(), blocks, &starts);
        let shared = Shared::new(coupled.len(), blocks, &order);
        let rows_below = plan::fill(&shared.rows_below(blocks, &order));
        let places = Places::new(&coupled, blocks);
        let (columns, n_lower) = plan::columns(blocks, &starts, &order, &rows_below, &places);
        Self {
            coupled,
            n_rows: starts[blocks.len()],
            n_entries: plan::check_entries(blocks),
            general: places.general,
            arms: places.arms,
            units: plan::units(blocks),
            columns,
            n_lower,
        }
    }

    /// Each row of three entries with the group it belongs to.
    pub(super) fn groups(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let of_arm = |arm: &Owner| [(arm.row, arm.group), (arm.row + 1, arm.group)];
        let of_arms = self.arms.iter().flat_map(of_arm);
        let general = self.general.iter().map(|owner| (owner.row, owner.group));
        general.chain(of_arms).map(|(row, group)| (row as usize, group as usize))
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
}

impl Column {
    /// Whether every block that meets here has two rows, and every product is one of arms.
    pub(super) fn is_of_pins(&self) -> bool {
        let below = |below: &Below| {
            below.size == 2
                && below.pairs.iter().all(|pair| pair.sign != 0.0)
                && below.updates.iter().all(|update| update.size == 2)
        };
        self.size == 2
            && self.touches.iter().all(|touch| touch.sign != 0.0)
            && self.earlier.iter().all(|earlier| earlier.size == 2)
            && self.below.iter().all(below)
    }
}
