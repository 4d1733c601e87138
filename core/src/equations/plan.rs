//! The structure of the augmented matrix of a model without its numbers: pattern and elimination program.

use super::compiled::Compiled;
use super::inertia::Inertia;
use crate::math::{each, Listed, Real};
use crate::model::{Block, Columns, Model, Slots, StateLayout};
use crate::solve::{Group, Pattern, RowBlock};

/// Largest number of rows of a block of the solver. An element with more rows has several blocks.
const ROWS: usize = 3;

/// Structure and symbolic factorisation for one model over any scalar. Computed once and shared by any number of
/// matrices.
#[derive(Debug)]
pub struct Plan {
    pub(super) pattern: Pattern,
    /// The constraints that are condensed with their grounded bodies, in the order of these bodies.
    pub(super) condensed: Vec<usize>,
    /// The constraints whose rows are added to the matrix as pins during an evaluation, in the order of
    /// [`Pattern::pin_rows`].
    pub(super) pins: Vec<usize>,
    /// The columns of every owner of coordinates.
    pub(super) owners: Vec<Columns>,
    /// Whether grounded bodies are condensed.
    pub(super) condenses: bool,
    /// Row, column and index of each entry of Φ_q.
    pub(super) positions: Vec<[u32; 3]>,
}

impl Plan {
    /// The plan of the equations of motion of a model. Grounded bodies are condensed unless redundant constraints are
    /// accepted.
    #[inline]
    pub fn of_motion<S: Real>(model: &Model<S>) -> Self {
        Self::with(model, !model.allow_redundancy)
    }

    /// The plan of a model whose constraints are not redundant, even if redundant constraints are accepted.
    #[inline]
    pub fn without_redundancy<S: Real>(model: &Model<S>) -> Self {
        Self::with(model, true)
    }

    /// Whether another variant of the model has the same plan. The numbers determine which bodies are condensed and
    /// coupled.
    #[inline]
    pub(super) fn is_like(&self, other: &Self) -> bool {
        let coupled = each([self, other], |plan| plan.pattern.coupled());
        self.condensed == other.condensed && coupled[0] == coupled[1]
    }

    /// Whether redundant constraints are accepted.
    #[inline]
    pub(super) fn accepts_redundancy<S: Real>(&self, model: &Model<S>) -> bool {
        model.allow_redundancy && !self.condenses
    }

    /// A plan that eliminates bodies first, then the constraints by minimum degree. No pivot vanishes if Φ_q has full
    /// rank.
    #[inline]
    pub fn free<S: Real>(model: &Model<S>) -> Self {
        Self::with(model, false)
    }

    fn with<S: Real>(model: &Model<S>, condenses: bool) -> Self {
        let compiled = Compiled::new(model);
        let (blocks, owners) = row_blocks(&model.layout);
        let first = |k: usize| owners.partition_point(|owner| *owner < k);
        let grounded = compiled.grounded.iter().filter(|_| condenses);
        let condensed: Vec<usize> = grounded.map(|grounded| grounded.constraint).list();
        let condensed_blocks: Vec<usize> = condensed.iter().map(|k| first(*k)).list();
        let groups = groups(model, &compiled.light.inertias);
        let pattern = Pattern::new(&groups, &blocks, &condensed_blocks);
        let pins = pattern.pin_rows().iter().map(|rows| owners[rows.block as usize]).list();
        let owners = model.layout.owners.clone();
        let positions = model.layout.positions();
        let positions = positions.map(|(row, column, at)| each([row, column, at], |k| k as u32));
        Self { pattern, condensed, pins, owners, condenses, positions: positions.list() }
    }

    /// Number of unknowns of the solver: the coordinates, and the padding of a last group with fewer than three.
    #[inline]
    pub(super) fn n_unknowns(&self) -> usize {
        self.pattern.n_unknowns()
    }

    /// Number of block products in one elimination.
    #[inline]
    pub fn n_products(&self) -> usize {
        self.pattern.n_products()
    }
}

/// The owners of coordinates as groups of unknowns.
#[inline]
pub(super) fn groups<S: Real>(model: &Model<S>, inertias: &[Inertia<S>]) -> Vec<Group> {
    let bodies = inertias.iter().map(|inertia| inertia.coupled);
    let coupled = bodies.chain(std::iter::repeat(false));
    let owners = model.layout.owners.iter().zip(coupled);
    owners.map(|(columns, coupled)| Group { size: columns.count, coupled }).list()
}

/// The constraints as blocks of at most three rows, and the constraint of each block.
pub(super) fn row_blocks(layout: &StateLayout) -> (Vec<RowBlock>, Vec<usize>) {
    let (mut row_blocks, mut owners) = (Vec::new(), Vec::new());
    for (k, Slots { rows, blocks, .. }) in layout.constraints.iter().enumerate() {
        for skipped in (0..rows.len()).step_by(ROWS) {
            let touch = |block: &Block| (block.owner, block.row(skipped).start);
            let signs = blocks.iter().map(|block| block.sign).filter(|sign| *sign != 0.0);
            owners.push(k);
            row_blocks.push(RowBlock {
                size: (rows.len() - skipped).min(ROWS),
                touches: blocks.iter().map(touch).list(),
                signs: signs.list(),
            });
        }
    }
    (row_blocks, owners)
}
