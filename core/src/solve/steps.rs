//! The plan of an elimination as a program: records in the order in which they are used.
//!
//! Each kind of record has one list, read from its first to its last by the elimination and backwards by the
//! substitution; a record says how many of the next list belong to it. Nothing is looked up, so that long
//! lists stream from memory.

/// All records.
#[derive(Clone, Debug, Default)]
pub(super) struct Steps {
    /// Row blocks with their diagonal blocks; those that [`Saddle`](super::Saddle) has to be told by their
    /// arms last.
    pub starts: Vec<Start>,
    pub touches: Vec<Touch>,
    /// How many of the row blocks are not of these.
    pub n_mixed: usize,
    /// Rows of blocks of L, in elimination order.
    pub rows: Vec<Row>,
    pub left: Vec<Left>,
    pub pairs: Vec<Pair>,
    pub updates: Vec<Update>,
    /// The blocks of `left` once more, column by column.
    pub below: Vec<Below>,
}

/// A row block, and its diagonal block of S.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start {
    /// The first of its rows.
    pub row: u32,
    /// Where the diagonal block stands among the factors.
    pub diagonal: u32,
    /// Number of groups that it touches.
    pub touches: u32,
    pub size: u32,
}

/// One row of blocks of L, and the column that begins with its diagonal block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// First of the rows of its row block.
    pub row: u32,
    /// Where the diagonal block stands among the factors.
    pub diagonal: u32,
    /// Number of blocks left of its diagonal block.
    pub left: u32,
    /// Number of blocks below it.
    pub below: u32,
    /// Rows of its row block.
    pub size: u8,
    /// Whether it has nothing but arms.
    pub armed: bool,
    /// Whether the same is true of all that stand left of it or below, as at pin joints among themselves.
    pub pins: bool,
}

/// A group that a row block touches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    /// First row of U, or the arm.
    pub first: u32,
    pub group: u32,
    /// Of the unit block of an arm; 0 where rows of U are touched.
    pub sign: f32,
}

/// A block of L left of a diagonal block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Left {
    /// Where it begins among the factors, and the diagonal block of its column.
    pub block: u32,
    pub diagonal: u32,
    /// First row, and size, of the row block eliminated there.
    pub row: u32,
    pub size: u32,
    /// Number of groups shared with it.
    pub pairs: u32,
    /// Number of products subtracted from the block.
    pub updates: u32,
}

/// A block of L below the diagonal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Below {
    /// Where it begins among the factors.
    pub block: u32,
    /// First row and size of its row block.
    pub row: u32,
    pub size: u32,
}

/// Two row blocks in a group that they share.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    /// First rows of U, or arms: of the row's row block, of the column's.
    pub first: [u32; 2],
    /// Product of the signs of two arms; 0 for rows of U.
    pub sign: f64,
}

/// Two blocks of an earlier column whose product is subtracted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Update {
    /// In the row of the block that is made, and in that of the row block whose column it stands in.
    pub blocks: [u32; 2],
    /// The diagonal block of the earlier column, and its size.
    pub diagonal: u32,
    pub size: u32,
}

/// The records of blocks left of the diagonal that are not yet read.
#[derive(Clone, Debug)]
pub(super) struct Ahead<'a> {
    pub left: &'a [Left],
    pub pairs: &'a [Pair],
    pub updates: &'a [Update],
}

impl Steps {
    /// All of them.
    pub fn ahead(&self) -> Ahead<'_> {
        Ahead { left: &self.left, pairs: &self.pairs, updates: &self.updates }
    }
}

/// Takes the next `count` records.
#[inline(always)]
pub(super) fn next<'a, T>(ahead: &mut &'a [T], count: u32) -> &'a [T] {
    let (own, rest) = ahead.split_at(count as usize);
    *ahead = rest;
    own
}

/// Takes the last `count` records.
#[inline(always)]
pub(super) fn last<'a, T>(ahead: &mut &'a [T], count: u32) -> &'a [T] {
    let (rest, own) = ahead.split_at(ahead.len() - count as usize);
    *ahead = rest;
    own
}
