//! The elimination program: records in the order in which they are used.
//!
//! Each kind of record has one list. The elimination reads the list forward, the substitution backward. A record
//! contains the number of records of the next list that belong to it. This requires no look-ups, so that long lists
//! are read sequentially from memory.

/// The lists of all records.
#[derive(Clone, Debug, Default)]
pub(super) struct Program {
    /// Row blocks with their diagonal blocks, except those in [`PinRows`].
    pub starts: Vec<Start>,
    pub touches: Vec<Touch>,
    /// Rows of blocks of L, in elimination order.
    pub rows: Vec<Row>,
    pub left: Vec<Left>,
    pub pairs: Vec<Pair>,
    pub updates: Vec<Update>,
    /// The blocks of `left` again, column by column.
    pub below: Vec<Below>,
}

/// A row block that consists of pin blocks only: rows [±I b] at one or two groups.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PinRows {
    /// Index among the row blocks.
    pub block: u32,
    /// The first row of the row block.
    pub row: u32,
    /// Index of its diagonal block among the factors.
    pub(super) diagonal: u32,
    /// Number of groups.
    count: u32,
    ends: [PinEnd; 2],
}

impl PinRows {
    /// From the index among all row blocks and the record of the row.
    #[inline]
    pub(super) fn new(touches: &[Touch], block: u32, row: &Row) -> Self {
        let mut ends = [PinEnd::default(); 2];
        ends.iter_mut().zip(touches).for_each(|(end, touch)| *end = PinEnd::new(touch));
        let &Row { row, diagonal, .. } = row;
        Self { block, row, diagonal, count: touches.len() as u32, ends }
    }

    /// The pin blocks.
    #[inline(always)]
    pub fn ends(&self) -> &[PinEnd] {
        &self.ends[..(self.count as usize).min(2)]
    }
}

/// A pin block.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PinEnd {
    /// Index among the pin blocks.
    pub(super) pin: u32,
    /// The first of its two rows of three entries.
    pub(super) entry: u32,
    /// Its group, and the first unknown of the group.
    pub(super) group: u32,
    pub(super) at: u32,
    /// Sign of the unit block.
    pub sign: f64,
}

impl PinEnd {
    #[inline]
    pub(super) fn new(touch: &Touch) -> Self {
        let Touch { first: pin, entry, group, at, sign } = *touch;
        Self { pin, entry, group, at, sign: sign.into() }
    }
}

/// A row block and its diagonal block of S.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start {
    /// The first row of the row block.
    pub row: u32,
    /// Index of the diagonal block among the factors.
    pub diagonal: u32,
    /// Number of groups that the row block touches.
    pub touches: u32,
    pub size: u32,
}

/// One block row of L, and the block column that begins with its diagonal block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// The first row of its row block.
    pub row: u32,
    /// Index of the diagonal block among the factors.
    pub diagonal: u32,
    /// Number of blocks left of the diagonal block.
    pub left: u32,
    /// Number of blocks below the diagonal block.
    pub below: u32,
    /// Number of rows of its row block.
    pub size: u8,
    /// Whether it consists of pin blocks only, and all blocks left of its diagonal block are 2 × 2.
    pub pins: bool,
    /// Whether in addition all blocks below its diagonal block are 2 × 2.
    pub pins_below: bool,
}

/// A group that a row block touches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    /// First row of U, or index of the pin block.
    pub first: u32,
    /// The first row of three entries.
    pub entry: u32,
    pub group: u32,
    /// The first unknown of the group.
    pub at: u32,
    /// Sign of the unit block of a pin block; 0 for rows of U.
    pub sign: f32,
}

/// A block of L left of a diagonal block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Left {
    /// Index of the block among the factors, and of the diagonal block of its column.
    pub block: u32,
    pub diagonal: u32,
    /// First row and size of the row block eliminated in this column.
    pub row: u32,
    pub size: u32,
    /// Number of groups that both row blocks share.
    pub pairs: u32,
    /// Number of products subtracted from the block.
    pub updates: u32,
}

/// A block of L below the diagonal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Below {
    /// Index of the block among the factors.
    pub block: u32,
    /// First row and size of its row block.
    pub row: u32,
    pub size: u32,
}

/// Two row blocks in a group that they share.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    /// First rows of U, or indices of pin blocks: of the block's row, then of its column.
    pub first: [u32; 2],
    /// Product of the signs of two pin blocks, or the sign of one pin block beside a row of U; 0 for rows of U.
    pub sign: f64,
}

/// Two blocks of an earlier column whose product is subtracted from a block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Update {
    /// The blocks in the row of the computed block and in the row of its column.
    pub blocks: [u32; 2],
    /// The diagonal block of the earlier column, and its size.
    pub diagonal: u32,
    pub size: u32,
}

/// A row of A at a light group, and the sum of its pivot.
#[derive(Clone, Copy, Debug)]
pub(super) struct LightRow {
    /// The row of three entries.
    pub entry: u32,
    pub group: u32,
    /// Index of the sum among the factors.
    pub sum: u32,
    /// The parts of the terms that do not count.
    pub excess: [f64; 2],
}

/// The records of blocks left of the diagonal that have not been read yet.
#[derive(Clone, Debug)]
pub(super) struct Ahead<'a> {
    pub left: &'a [Left],
    pub pairs: &'a [Pair],
    pub updates: &'a [Update],
}

impl Program {
    /// All records of blocks left of the diagonal.
    #[inline]
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
