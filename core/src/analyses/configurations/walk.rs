//! All closures of dyads, rods and meshed wheels.

use super::found::Positions;
use super::turns;
use crate::analyses::assemble::{following_before, place, Targets};
use crate::analyses::closing::{Closing, Halt};
use crate::model::{row_scales, Model};

/// Largest number of combinations.
const MOST: usize = 20_000;
/// Largest number of combinations with a body that is placed by an assumption.
const MOST_ASSUMED: usize = 256;
/// Largest residual of a position whose bodies are all placed exactly, relative to the size of the mechanism.
const CLOSED: f64 = 1e-7;

/// Adds the positions for all combinations of closures and meshes. Returns whether the list is complete.
///
/// Each body has one of finitely many poses beside the bodies placed before it, so no freedom is left in these
/// positions, however near to each other the pins of a dyad are. If a combination leaves a body open, such as a dyad on
/// one pin with arms of equal length, the other combinations are still computed.
pub(super) fn walk(model: &Model, t: f64, found: &mut Positions<'_>, stop: Halt<'_>) -> bool {
    let mut targets = Targets::of(model, t);
    targets.soft.fill([None; 3]);
    targets.every_solution = true;
    let mut closing = Closing::new(model, t, stop);
    let scales = row_scales(model);
    let mut choices = Some(Vec::new());
    // a dyad closes for any whole turns of its bodies
    let mut proven = turns::follow(model, &closing, &mut targets);
    let mut assumed = 0;
    for _ in 0..MOST {
        let Some(taken) = choices.take() else { return proven };
        let placement = place(model, &targets, &taken);
        let most = placement.assumed.unwrap_or(placement.options.len());
        choices = following_before(most, taken, &placement);
        if placement.assumed.is_some() {
            proven = false;
            assumed += 1;
            if assumed == MOST_ASSUMED || stop() {
                return false;
            }
            continue;
        }
        let mut q = placement.q;
        crate::analyses::assemble::wind(model, t, &mut q);
        let phi = closing.phi(&q);
        // joints that no dyad used must also close
        let closes = placement.gaps.is_empty()
            && phi.iter().zip(&scales).all(|(phi, scale)| phi.abs() <= CLOSED * scale);
        if closes && closing.close(&mut q).1 {
            found.add_isolated(q);
        }
        if found.is_full() || stop() {
            return false;
        }
    }
    false
}
