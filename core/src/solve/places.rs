//! Where the transformed rows U = A Lw⁻ᵀ of a [`Pattern`](super::Pattern) stand, and the entries they come from.

use super::pattern::RowBlock;
use super::plan::index;
use super::steps::{Pair, Touch};

/// Arms in groups at which all are pairs of rows [±I b], rows of U in the others; both in the order in which
/// they are eliminated.
#[derive(Clone, Debug, Default)]
pub(super) struct Places {
    /// Rows of entries that have a row in U.
    pub general: Vec<Owner>,
    /// Pairs of rows [±I b] that have an arm.
    pub arms: Vec<Owner>,
    /// Arms of row blocks that have rows in U as well.
    pub mixed: Vec<u32>,
    /// Row blocks with nothing but arms, in the order in which they are eliminated.
    pub armed: Vec<Armed>,
}

/// A row block whose rows are [±I b] at every group that it touches, and which shares these with none but
/// its like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Armed {
    /// Its place among the row blocks.
    pub block: u32,
    /// The arm at the first group that it touches; those at the others follow.
    pub arm: u32,
    /// Where its diagonal block stands.
    pub diagonal: u32,
}

/// Whether a row block that touches something has nothing but arms.
pub(super) fn is_armed(touches: &[Touch]) -> bool {
    !touches.is_empty() && touches.iter().all(|touch| touch.sign != 0.0)
}

/// Where a row of three entries of A, or a pair of them, stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Owner {
    /// The row of entries, the first of a pair.
    pub row: u32,
    pub group: u32,
    /// Of the unit block of an arm.
    pub sign: f32,
    pub coupled: bool,
}

impl Places {
    /// With what each row block touches.
    pub fn new(coupled: &[bool], blocks: &[RowBlock], order: &[usize]) -> (Self, Vec<Vec<Touch>>) {
        let mut with_arms = vec![true; coupled.len()];
        for block in blocks {
            let unit = block.size == 2 && block.signs.len() == block.touches.len();
            assert!(unit || block.signs.is_empty(), "one sign for each group, of two rows");
            block.touches.iter().for_each(|&(group, _)| with_arms[group] &= unit);
        }
        let mut places = Self::default();
        let mut touches = vec![Vec::new(); blocks.len()];
        for &k in order {
            touches[k] = places.push(&blocks[k], coupled, &with_arms);
            let arms = touches[k].iter().filter(|touch| touch.sign != 0.0).map(|touch| touch.first);
            if is_armed(&touches[k]) {
                let arm = touches[k][0].first;
                places.armed.push(Armed { block: index(k), arm, diagonal: 0 });
            } else {
                places.mixed.extend(arms);
            }
        }
        (places, touches)
    }

    /// The rows of one block.
    fn push(&mut self, block: &RowBlock, coupled: &[bool], with_arms: &[bool]) -> Vec<Touch> {
        let touch = |(k, &(group, first)): (usize, &(usize, usize))| {
            let sign = if with_arms[group] { block.signs[k] as f32 } else { 0.0 };
            let owner = |r| Owner {
                row: index(first / 3 + r),
                group: index(group),
                sign,
                coupled: coupled[group],
            };
            let (list, rows) = match with_arms[group] {
                true => (&mut self.arms, 1),
                false => (&mut self.general, block.size),
            };
            let first = index(list.len());
            list.extend((0..rows).map(owner));
            Touch { first, group: index(group), sign }
        };
        block.touches.iter().enumerate().map(touch).collect()
    }
}

/// Two row blocks in each group that they share.
pub(super) fn pairs<'a>(one: &'a [Touch], other: &'a [Touch]) -> impl Iterator<Item = Pair> + 'a {
    one.iter().filter_map(|own| {
        let partner = other.iter().find(|t| t.group == own.group)?;
        let sign = f64::from(own.sign) * f64::from(partner.sign);
        Some(Pair { first: [own.first, partner.first], sign })
    })
}

/// Number of rows of three entries.
///
/// # Panics
/// If blocks share an entry, or leave one out.
pub(super) fn check_entries(blocks: &[RowBlock]) -> usize {
    let touches = || blocks.iter().flat_map(|b| b.touches.iter().map(move |t| (b.size, t.1)));
    let mut owned = vec![false; touches().map(|(size, _)| size).sum()];
    for (size, first) in touches() {
        assert!(first % 3 == 0, "whole rows of entries");
        for owned in &mut owned[first / 3..first / 3 + size] {
            assert!(!*owned, "an entry belongs to one block");
            *owned = true;
        }
    }
    owned.len()
}

/// First rows of the blocks that begin with ±I, with the sign.
pub(super) fn units(blocks: &[RowBlock]) -> Vec<(u32, f32)> {
    let of = |b: &RowBlock| {
        let firsts = b.touches.iter().map(|(_, first)| index(first / 3));
        firsts.zip(b.signs.iter().map(|sign| *sign as f32)).collect::<Vec<_>>()
    };
    blocks.iter().flat_map(of).collect()
}
