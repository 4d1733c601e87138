//! The rows that remove the inertia added to light bodies during the elimination (`equations/lending.rs`).
//!
//! Let P be the matrix of the equations with the addition κ uᵀ u, where u is a unit vector of one coordinate. A further
//! row u with a negative damping -1/κ gives the solution without the addition:
//!
//! ```text
//! [ P   uᵀ  ] [ a ]   [ f ]
//! [ u   1/κ ] [ μ ] = [ 0 ],   μ = -κ u a,   (P - κ uᵀ u) a = f
//! ```
//!
//! Its pivot -(1 - g)/κ with g = κ u P⁻¹ uᵀ has lost digits if the constraints before it leave the coordinate no other
//! inertia. The row is therefore eliminated after the constraints of all light bodies that are connected with its own.
//! If g is near 1 even then, the solution is corrected with the remainder of the equations
//! ([`correct`](super::refine::correct)). If this does not converge, `equations/take_back.rs` removes the addition in
//! another way.

use super::added_mass::Added;
use super::loans::Addition;
use crate::model::StateLayout;
use crate::solve::RowBlock;

/// Largest number of additions among connected light bodies. Their rows fill the factors with about the square of this
/// number.
const MOST: usize = 32;

/// The row of one addition.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Downdate {
    /// The coordinate.
    pub column: usize,
    /// The index of its row of three entries, and the coordinate's place among them.
    pub entry: [usize; 2],
}

/// The rows that remove all additions; none if there are too many. Appends their blocks to those of the constraints, and
/// returns for each of them the blocks that are eliminated before it.
pub(super) fn downdates(
    layout: &StateLayout,
    added: &[Added],
    additions: &[Addition],
    blocks: &mut Vec<RowBlock>,
) -> (Vec<Downdate>, Vec<Vec<usize>>) {
    let owner = |column: usize| {
        let at = layout.owners.partition_point(|columns| columns.range().end <= column);
        (at, column - layout.owners[at].first)
    };
    let mut clusters = Clusters::new(layout, added, blocks);
    let (mut rows, mut before) = (Vec::new(), Vec::new());
    for (k, Addition { column, .. }) in additions.iter().enumerate() {
        let (owner, place) = owner(*column);
        let Some(connected) = clusters.of(owner) else { return (Vec::new(), Vec::new()) };
        before.push(connected);
        rows.push(Downdate { column: *column, entry: [layout.n_entries / 3 + k, place] });
    }
    blocks.extend(rows.iter().map(|Downdate { column, entry }| RowBlock {
        size: 1,
        touches: vec![(owner(*column).0, 3 * entry[0])],
        signs: Vec::new(),
    }));
    (rows, before)
}

/// Groups of connected light bodies and internal coordinates.
struct Clusters<'a> {
    blocks: &'a [RowBlock],
    light: Vec<bool>,
    /// The row blocks of each owner of coordinates.
    of_owner: Vec<Vec<usize>>,
    /// For the first owner of each group that was found, the number of its additions.
    count: Vec<usize>,
}

impl<'a> Clusters<'a> {
    fn new(layout: &StateLayout, added: &[Added], blocks: &'a [RowBlock]) -> Self {
        let n = layout.owners.len();
        let mut of_owner = vec![Vec::new(); n];
        for (k, block) in blocks.iter().enumerate() {
            block.touches.iter().for_each(|(owner, _)| of_owner[*owner].push(k));
        }
        let light = (0..n).map(|k| added.get(k).is_none_or(Added::any)).collect();
        Self { blocks, light, of_owner, count: vec![0; n] }
    }

    /// The row blocks of all light owners that are connected with this one. None if they have too many additions.
    fn of(&mut self, owner: usize) -> Option<Vec<usize>> {
        let (mut seen, mut found) = (vec![false; self.light.len()], vec![false; self.blocks.len()]);
        let mut next = vec![owner];
        seen[owner] = true;
        while let Some(one) = next.pop() {
            for &block in &self.of_owner[one] {
                found[block] = true;
                for (other, _) in &self.blocks[block].touches {
                    if self.light[*other] && !std::mem::replace(&mut seen[*other], true) {
                        next.push(*other);
                    }
                }
            }
        }
        let first = seen.iter().position(|seen| *seen).unwrap_or(owner);
        self.count[first] += 1;
        let rows = || (0..found.len()).filter(|k| found[*k]).collect();
        (self.count[first] <= MOST).then(rows)
    }
}
