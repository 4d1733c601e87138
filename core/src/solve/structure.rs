//! The structure of a saddle-point matrix [W Aᵀ; A -μI], as its owner describes it: groups of unknowns and blocks of
//! rows.

/// Largest number of rows of a block, and of unknowns of a group.
pub(super) const MOST: usize = 3;

/// One to three unknowns that W couples only with each other, such as the coordinates of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Group {
    /// Number of unknowns, 1 to 3.
    pub size: usize,
    /// Whether W couples the third unknown with the first two.
    pub coupled: bool,
}

impl Group {
    /// A group of three unknowns.
    #[inline]
    pub fn body(coupled: bool) -> Self {
        Self { size: MOST, coupled }
    }
}

/// One to three rows of A that touch the same groups.
#[derive(Clone, Debug, PartialEq)]
pub struct RowBlock {
    /// Number of rows, 1 to 3.
    pub size: usize,
    /// The groups touched, each once, with the index of the first of the entries of A at this group: `size` × 3
    /// entries, row by row. The index is a multiple of three. Groups with fewer unknowns are padded with zeros.
    pub touches: Vec<(usize, usize)>,
    /// For two rows whose first two columns are I or -I in every group touched, the sign for each group. Empty for
    /// other rows.
    pub signs: Vec<f64>,
}

/// Converts an index to 32 bits.
///
/// # Panics
/// If the index needs more than 32 bits.
#[inline]
pub(super) fn index(i: usize) -> u32 {
    u32::try_from(i).expect("fewer than 2^32 entries")
}

/// First row of each row block, and the number of rows.
pub(super) fn row_starts(blocks: &[RowBlock]) -> Vec<usize> {
    let mut starts = vec![0];
    for RowBlock { size, touches, signs } in blocks {
        assert!((1..=MOST).contains(size), "blocks of one to three rows");
        let unit = *size == 2 && signs.len() == touches.len();
        assert!(unit || signs.is_empty(), "one sign for each group, of two rows");
        starts.push(starts[starts.len() - 1] + size);
    }
    starts
}

/// First unknown of each group, and the number of unknowns including those that pad the last group to three.
pub(super) fn group_starts(groups: &[Group]) -> (Vec<usize>, usize) {
    let (mut starts, mut next) = (Vec::with_capacity(groups.len()), 0);
    for group in groups {
        assert!((1..=MOST).contains(&group.size), "groups of one to three unknowns");
        assert!(group.size == MOST || !group.coupled, "a coupled group has three unknowns");
        starts.push(next);
        next += group.size;
    }
    let padded = starts.last().map_or(0, |last| last + MOST);
    (starts, padded)
}

/// Number of rows of three entries.
///
/// # Panics
/// If blocks share an entry, or an entry belongs to no block.
pub(super) fn count_entries(blocks: &[RowBlock]) -> usize {
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
