//! The pattern of a saddle-point matrix [W Aᵀ; A -μI] and the plan of its elimination, worked out once.
//!
//! W is block diagonal, 3 × 3 for each group of three unknowns; the rows of A come in blocks of one to
//! three that touch the same groups. What is factorised is S = A W⁻¹ Aᵀ + μ I, one block for each two
//! row blocks that share a group, and fill (Davis, *Direct Methods for Sparse Linear Systems*, 2006,
//! ch. 4). The plan is up-looking, row by row: for every block of L it names the products that make it, so that
//! a block is computed in registers and written once.

use super::anchor::{anchors, Anchored, Loads};
use super::places::{self, Armed, Owner, Places};
use super::plan;
use super::steps::Steps;

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
    pub(super) n_groups: usize,
    /// The groups whose third unknown is coupled to the other two in W, without those of anchors.
    pub(super) coupled: Vec<u32>,
    /// The groups without anchor.
    pub(super) loose: Vec<u32>,
    /// Row blocks that are eliminated with two unknowns of a group.
    pub(super) anchors: Vec<Anchored>,
    /// The other row blocks at their groups.
    pub(super) loads: Loads,
    pub(super) n_rows: usize,
    pub(super) n_entries: usize,
    /// Where the transformed rows stand.
    pub(super) places: Places,
    /// First rows of the blocks that begin with ±I, with the sign.
    pub(super) units: Vec<(u32, f32)>,
    /// What elimination does, in order.
    pub(super) steps: Steps,
    /// Neighbours and elements looked at to find the order.
    visits: usize,
    /// Numbers of the factors.
    pub(super) n_factors: usize,
}

impl Pattern {
    /// For groups of three unknowns, each `coupled` or diagonal in W, and the row blocks of A; those of them that
    /// are to be `anchored` touch one group alone, and no other of these touches it.
    ///
    /// # Panics
    /// If a row block has not 1 to 3 rows, a group does not exist or is touched twice, the entries do
    /// not fill a list without gaps, or an index exceeds 32 bits.
    pub fn new(coupled: Vec<bool>, blocks: &[RowBlock], anchored: &[usize]) -> Self {
        let (groups, starts) = (coupled.len(), plan::starts(blocks));
        let (anchors, loads) = anchors(groups, blocks, &starts, anchored);
        let free = Free::new(blocks, &starts, anchored);
        let mut bent = coupled.clone();
        anchors.iter().for_each(|anchor| bent[anchor.group as usize] = true);
        let (order, visits) = plan::order(groups, &free.blocks);
        let rows_below = plan::rows_below(groups, &free.blocks, &order);
        let (mut places, touches) = Places::new(&bent, &free.blocks, &order);
        let (steps, n_factors) =
            plan::steps(&free.blocks, &free.rows, &order, &rows_below, &touches);
        for (armed, start) in places.armed.iter_mut().zip(&steps.starts[steps.n_mixed..]) {
            (armed.diagonal, armed.block) = (start.diagonal, free.numbers[armed.block as usize]);
        }
        let mut loose = vec![true; groups];
        anchors.iter().for_each(|anchor| loose[anchor.group as usize] = false);
        let select = |which: &dyn Fn(usize) -> bool| {
            (0..groups).filter(|k| which(*k)).map(plan::index).collect::<Vec<u32>>()
        };
        Self {
            n_groups: groups,
            coupled: select(&|k| coupled[k] && loose[k]),
            loose: select(&|k| loose[k]),
            anchors,
            loads,
            n_rows: starts[blocks.len()],
            n_entries: places::check_entries(blocks),
            places,
            units: places::units(blocks),
            steps,
            n_factors,
            visits,
        }
    }

    /// Each row of three entries with the group it belongs to.
    pub(super) fn groups(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let of_arm = |arm: &Owner| [(arm.row, arm.group), (arm.row + 1, arm.group)];
        let of_arms = self.places.arms.iter().flat_map(of_arm);
        let general = self.places.general.iter().map(|owner| (owner.row, owner.group));
        general.chain(of_arms).map(|(row, group)| (row as usize, group as usize))
    }

    /// The row blocks that [`Saddle::begin`](super::Saddle::begin) takes, in the order in which they are
    /// eliminated.
    pub fn armed(&self) -> &[Armed] {
        &self.places.armed
    }

    /// The anchors, in the order in which they were given.
    pub fn anchors(&self) -> &[Anchored] {
        &self.anchors
    }

    /// The groups coupled in W, without those of anchors.
    pub fn coupled(&self) -> &[u32] {
        &self.coupled
    }

    /// Number of unknowns in groups.
    pub fn n_unknowns(&self) -> usize {
        3 * self.n_groups
    }

    /// Number of rows of A.
    pub fn n_rows(&self) -> usize {
        self.n_rows
    }

    /// The work of finding order and plan, which does not depend on the machine: neighbours looked at, and
    /// products listed.
    pub fn effort(&self) -> usize {
        let Steps { touches, left, below, pairs, updates, .. } = &self.steps;
        let products = left.len() + below.len() + pairs.len() + updates.len();
        self.visits + touches.len() + products
    }

    /// Number of blocks of L below the diagonal, fill included.
    pub fn fill(&self) -> usize {
        self.steps.below.len()
    }
}

/// The row blocks that are no anchors.
struct Free {
    blocks: Vec<RowBlock>,
    /// The first row of each.
    rows: Vec<usize>,
    /// Their places among all.
    numbers: Vec<u32>,
}

impl Free {
    fn new(blocks: &[RowBlock], starts: &[usize], anchored: &[usize]) -> Self {
        let mut free = vec![true; blocks.len()];
        anchored.iter().for_each(|block| free[*block] = false);
        let numbers = || (0..blocks.len()).filter(|k| free[*k]);
        Self {
            blocks: numbers().map(|k| blocks[k].clone()).collect(),
            rows: numbers().map(|k| starts[k]).collect(),
            numbers: numbers().map(plan::index).collect(),
        }
    }
}
