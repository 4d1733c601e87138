//! What matrices of a model have in common, whatever their numbers: pattern, order and plan of elimination.

use super::anchor::Anchor;
use super::Compiled;
use crate::math::Real;
use crate::model::{Block, Model, Slots, StateLayout};
use crate::solve::{Armed, Bytes, Pattern, RowBlock};

/// A plan of elimination for one model over any scalar; found once, shared by any number of matrices.
#[derive(Debug)]
pub struct Plan {
    pub(super) pattern: Pattern,
    /// The pins whose rows of Φ_q matrices give by their arms.
    pub(super) armed: Vec<ArmedPin>,
    /// The other constraints, but for anchors.
    pub(super) others: Vec<u32>,
    /// Whether bodies that are pinned to ground are anchored there.
    pub(super) anchored: bool,
}

/// A pin all of whose rows have arms.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArmedPin {
    /// Its place among the pins.
    pub pin: u32,
    /// Its place in the matrix.
    pub rows: Armed,
}

impl Plan {
    /// Of the equations of motion of a model: anchored, unless redundant constraints are accepted.
    pub fn of_motion<P: Real>(model: &Model<P>) -> Self {
        match model.allow_redundancy {
            true => Self::free(model),
            false => Self::anchored(model),
        }
    }

    /// Bodies first, then the constraints by minimum degree, so that every pivot is safe while Φ_q has full rank.
    pub fn free<P: Real>(model: &Model<P>) -> Self {
        Self::with(model, &Compiled::new(model), &[], false)
    }

    /// The same for W = M without damping: pins to ground are eliminated with the bodies that they hold.
    pub fn anchored<P: Real>(model: &Model<P>) -> Self {
        let compiled = Compiled::new(model);
        let constraint =
            |anchor: &Anchor<P>| compiled.pins[anchor.pin as usize].constraint as usize;
        let anchors: Vec<usize> = compiled.anchors.iter().map(constraint).collect();
        Self::with(model, &compiled, &anchors, true)
    }

    fn with<P>(
        model: &Model<P>,
        compiled: &Compiled<P>,
        anchors: &[usize],
        anchored: bool,
    ) -> Self {
        let coupled = compiled.inertias.iter().map(|inertia| inertia.coupled);
        let pattern = Pattern::new(coupled.collect(), &row_blocks(&model.layout), anchors);
        let (armed, others) = split(model, compiled, &pattern);
        Self { pattern, armed, others, anchored }
    }

    /// Bytes of it.
    pub fn bytes(&self) -> Bytes {
        self.pattern.bytes() + Bytes::touched(&self.armed) + Bytes::touched(&self.others)
    }
}

/// The pins that arms can give, and the other constraints.
fn split<P>(
    model: &Model<P>,
    compiled: &Compiled<P>,
    pattern: &Pattern,
) -> (Vec<ArmedPin>, Vec<u32>) {
    let mut pin: Vec<Option<u32>> = vec![None; model.constraints.len()];
    (0..).zip(&compiled.pins).for_each(|(k, p)| pin[p.constraint as usize] = Some(k));
    let mut others = vec![true; model.constraints.len()];
    pattern.anchors().iter().for_each(|anchor| others[anchor.block as usize] = false);
    let mut armed = Vec::with_capacity(pattern.armed().len());
    for &rows in pattern.armed() {
        let block = rows.block as usize;
        armed.push(ArmedPin { pin: pin[block].expect("unit blocks are those of pins"), rows });
        others[block] = false;
    }
    (armed, (0..).zip(others).filter(|(_, other)| *other).map(|(k, _)| k).collect())
}

/// The constraints as blocks of rows.
fn row_blocks(layout: &StateLayout) -> Vec<RowBlock> {
    let touches =
        |blocks: &[Block]| blocks.iter().map(|block| (block.owner, block.first)).collect();
    let block = |slots: &Slots| RowBlock {
        size: slots.rows.len(),
        touches: touches(&slots.blocks),
        signs: slots.blocks.iter().map(|block| block.sign).filter(|sign| *sign != 0.0).collect(),
    };
    layout.constraints.iter().map(block).collect()
}
