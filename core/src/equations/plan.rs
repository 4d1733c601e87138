//! The structure of the augmented matrix of a model, whatever its numbers: pattern and program of elimination.

use super::pairs::runs;
use super::Compiled;
use crate::math::Real;
use crate::model::{Layout, Model, Slots};
use crate::solve::{Group, Pattern, PinRows, RowBlock};
use std::ops::Range;

/// Most rows of a block of the solver: an element of more rows has several blocks.
const ROWS: usize = 3;

/// Structure and symbolic factorisation for one model over any scalar; found once, shared by any number of matrices.
#[derive(Debug)]
pub struct Plan {
    pub(super) pattern: Pattern,
    /// The pins whose rows an evaluation puts into the matrix one by one, sorted by types.
    pub(super) pins: Vec<PinJoint>,
    /// Ranges of these of one type.
    pub(super) pin_runs: Vec<Range<usize>>,
    /// The constraints that are neither among these nor condensed.
    pub(super) others: Vec<u32>,
    /// Whether grounded bodies are condensed.
    pub(super) condenses: bool,
}

/// A pin among bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct PinJoint {
    /// Its place among the [`Pair`](super::pairs::Pair)s.
    pub pair: u32,
    /// Its place in the matrix.
    pub rows: PinRows,
}

impl Plan {
    /// Of the equations of motion of a model: grounded bodies are condensed, unless redundant constraints are
    /// accepted.
    pub fn of_motion<S: Real>(model: &Model<S>) -> Self {
        Self::with(model, !model.allow_redundancy)
    }

    /// Bodies first, then the constraints by minimum degree, so that every pivot is safe while Φ_q has full rank.
    pub fn free<S: Real>(model: &Model<S>) -> Self {
        Self::with(model, false)
    }

    fn with<S: Real>(model: &Model<S>, condenses: bool) -> Self {
        let compiled = Compiled::new(model);
        let (blocks, firsts) = row_blocks(&model.layout);
        let grounded = compiled.grounded.iter().filter(|_| condenses);
        let condensed: Vec<usize> = grounded.map(|g| firsts[g.constraint as usize]).collect();
        let pattern = Pattern::new(&groups(&compiled), &blocks, &condensed);
        let mut pair_of = vec![None; blocks.len()];
        for (k, pair) in (0..).zip(&compiled.pairs) {
            pair_of[firsts[pair.constraint as usize]] = Some(k);
        }
        let mut others = vec![true; blocks.len()];
        condensed.iter().for_each(|block| others[*block] = false);
        let mut pins = Vec::with_capacity(pattern.pin_rows().len());
        for &rows in pattern.pin_rows() {
            let block = rows.block as usize;
            pins.push(PinJoint { pair: pair_of[block].expect("pins are pairs of rows"), rows });
            others[block] = false;
        }
        let kind = |pin: &PinJoint| compiled.pairs[pin.pair as usize].element.kind();
        pins.sort_by_key(kind);
        let pin_runs = runs(&pins, kind);
        let others = (0..).zip(&firsts).filter(|(_, block)| others[**block]).map(|(k, _)| k);
        Self { others: others.collect(), pattern, pins, pin_runs, condenses }
    }

    /// Number of products of blocks in one elimination.
    pub fn n_products(&self) -> usize {
        self.pattern.n_products()
    }
}

/// The groups of unknowns: one for each moving body.
pub(super) fn groups<S>(compiled: &Compiled<S>) -> Vec<Group> {
    compiled.inertias.iter().map(|inertia| Group::body(inertia.coupled)).collect()
}

/// The constraints as blocks of at most three rows, and the first block of each.
pub(super) fn row_blocks(layout: &Layout) -> (Vec<RowBlock>, Vec<usize>) {
    let (mut blocks, mut firsts) = (Vec::new(), Vec::new());
    for Slots { rows, blocks: touched } in &layout.constraints {
        firsts.push(blocks.len());
        for skipped in (0..rows.len()).step_by(ROWS) {
            let touch = |block: &crate::model::Block| (block.body.0 - 1, block.first + 3 * skipped);
            let signs = touched.iter().map(|block| block.sign).filter(|sign| *sign != 0.0);
            blocks.push(RowBlock {
                size: (rows.len() - skipped).min(ROWS),
                touches: touched.iter().map(touch).collect(),
                signs: signs.collect(),
            });
        }
    }
    (blocks, firsts)
}
