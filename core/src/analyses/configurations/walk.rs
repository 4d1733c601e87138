//! All closures of dyads, rods and meshed wheels.

use super::found::Positions;
use super::turns;
use crate::analyses::assemble::{following, place, Targets};
use crate::analyses::closing::{Closing, Halt};
use crate::model::{row_scales, Model};

/// Largest number of combinations.
const MOST: usize = 20_000;
/// Largest residual of a position whose bodies are all placed exactly, relative to the size of the mechanism.
const CLOSED: f64 = 1e-7;

/// Adds the positions for all combinations of closures and meshes. Returns whether the list is complete.
pub(super) fn walk(model: &Model, t: f64, found: &mut Positions<'_>, stop: Halt<'_>) -> bool {
    let mut targets = Targets::of(model, t);
    targets.soft.fill([None; 3]);
    targets.every_solution = true;
    let mut closing = Closing::new(model, t, stop);
    let scales = row_scales(model);
    let mut choices = Some(Vec::new());
    // a dyad closes for any whole turns of its bodies
    let proven = turns::follow(model, &closing, &mut targets);
    for _ in 0..MOST {
        let Some(taken) = choices.take() else { return proven };
        let placement = place(model, &targets, &taken);
        if placement.assumed {
            return false;
        }
        choices = following(taken, &placement);
        let mut q = placement.q;
        crate::analyses::assemble::wind(model, t, &mut q);
        let phi = closing.phi(&q);
        // joints that no dyad used must also close
        let closes = placement.gaps.is_empty()
            && phi.iter().zip(&scales).all(|(phi, scale)| phi.abs() <= CLOSED * scale);
        if closes && closing.close(&mut q).1 {
            found.add(q);
        }
        if found.is_full() || stop() {
            return false;
        }
    }
    false
}
