//! Which entries of the augmented matrix can ever differ from zero.
//!
//! Found once from the formulas of the model, whatever the parameters: an entry of Φ_q is stored by
//! the factor only if the residual of its row depends on the coordinate of its column.

use super::laws::Laws;
use crate::elements::{BodyId, Constraint, Coordinate, MOST_EQUATIONS};
use crate::expression::Tape;
use crate::math::{Pose, Real, Tracer, Twist};
use crate::model::{Block, Model};

/// For each stored entry of Φ_q, in the order of the layout, whether it can differ from zero.
pub fn jacobian<S>(model: &Model<S>) -> Vec<bool> {
    let formulas = model.blueprint.constraints.iter().map(|(_, _, formula)| formula);
    formulas
        .zip(&model.layout.constraints)
        .flat_map(|(formula, slots)| slots.blocks.iter().map(move |block| (formula, slots, block)))
        .flat_map(|(formula, slots, block)| block_entries(model, formula, slots.rows.len(), block))
        .collect()
}

fn block_entries<S>(
    model: &Model<S>,
    formula: &Constraint<Tape>,
    equations: usize,
    block: &Block,
) -> Vec<bool> {
    let pose = |body: BodyId| -> Pose<Tracer> {
        match body == block.body {
            true => Pose::new(Tracer::variable(0), Tracer::variable(1), Tracer::variable(2)),
            false => Pose::identity(),
        }
    };
    let parameters = vec![Tracer::zero(); model.parameters.len()];
    let coordinate =
        |body: BodyId, c: Coordinate| -> Tracer { c.of(&pose(body), &Twist::<Tracer>::zero()) };
    let values = Laws { parameters: &parameters, t: Tracer::zero(), coordinate };
    let element = formula.map(&mut |tape| tape.evaluate(&values));
    let [i, j] = element.ends().map(pose);
    let mut phi = [Tracer::zero(); MOST_EQUATIONS];
    element.residual(&i, &j, Tracer::zero(), &mut phi[..equations]);
    phi[..equations].iter().flat_map(|phi| [0, 1, 2].map(|c| phi.depends_on(c))).collect()
}

/// For each moving body, whether its mass centre can be off the origin of its frame: only then are
/// rotation and translation coupled.
pub fn coupled<S>(model: &Model<S>) -> impl Iterator<Item = bool> + '_ {
    let zero = |tape: &Tape| tape.constant() == Some(0.0);
    model.blueprint.bodies[1..].iter().map(move |b| !(zero(&b.center.x) && zero(&b.center.y)))
}
