//! The storage map: where the rows U of a [`Pattern`](super::Pattern) are stored, and the entries from which they
//! come.
//!
//! At groups where all row blocks are pairs [±I b], each pair is a pin block. The rows at other groups are stored one by
//! one. Both are stored in the order of elimination.

use super::records::{PinEnd, Touch};
use super::structure::{index, RowBlock};
use crate::math::Listed;

/// The storage map.
#[derive(Clone, Debug, Default)]
pub(super) struct Storage {
    /// The source of each row of U.
    pub rows: Vec<Source>,
    /// The pin blocks of row blocks that also have rows in U, or touch more than two groups.
    pub mixed: Vec<PinEnd>,
    /// Number of pin blocks.
    pub n_pins: usize,
}

/// The row of three entries from which a row of U comes, and its group.
#[derive(Clone, Copy, Debug)]
pub(super) struct Source {
    pub entry: u32,
    pub group: u32,
}

impl Storage {
    /// The storage of the `blocks` to be eliminated, and the groups that each of them touches. `starts` contains the
    /// first unknown of each group.
    pub fn new(starts: &[usize], blocks: &[RowBlock], order: &[usize]) -> (Self, Vec<Vec<Touch>>) {
        let mut with_pins = vec![true; starts.len()];
        for block in blocks.iter().filter(|block| block.signs.is_empty()) {
            block.touches.iter().for_each(|&(group, _)| with_pins[group] = false);
        }
        let mut storage = Self::default();
        let mut touches = vec![Vec::new(); blocks.len()];
        for &k in order {
            touches[k] = storage.push(&blocks[k], starts, &with_pins);
            if !is_pin_only(&touches[k]) {
                let pins = touches[k].iter().filter(|touch| touch.sign != 0.0);
                pins.map(PinEnd::new).append_to(&mut storage.mixed);
            }
        }
        (storage, touches)
    }

    /// Assigns the storage of one row block.
    fn push(&mut self, block: &RowBlock, starts: &[usize], with_pins: &[bool]) -> Vec<Touch> {
        let touch = |(k, &(group, first)): (usize, &(usize, usize))| {
            let (entry, sign) = (index(first / 3), block.signs.get(k).filter(|_| with_pins[group]));
            let stored = if sign.is_some() {
                self.n_pins += 1;
                self.n_pins - 1
            } else {
                let sources = (0..index(block.size)).map(|r| (entry + r, index(group)));
                sources.map(|(entry, group)| Source { entry, group }).append_to(&mut self.rows);
                self.rows.len() - block.size
            };
            let (first, at) = (index(stored), index(starts[group]));
            Touch {
                first,
                entry,
                group: index(group),
                at,
                sign: sign.map_or(0.0, |sign| *sign as f32),
            }
        };
        block.touches.iter().enumerate().map(touch).list()
    }
}

/// Whether a row block consists of pin blocks only, at one or two groups.
#[inline]
pub(super) fn is_pin_only(touches: &[Touch]) -> bool {
    (1..=2).contains(&touches.len()) && touches.iter().all(|touch| touch.sign != 0.0)
}
