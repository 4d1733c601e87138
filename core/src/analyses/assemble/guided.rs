//! Closing near guesses for quantities of points and elements.
//!
//! A driver for each guess leads Newton's method to the guess, or as near to it as the joints allow. From there the
//! mechanism is closed without these drivers. This is repeated from several placements, and the result nearest to the
//! guesses is used.

use super::angle_winding::wind;
use super::attempt::{close_from, given, Closed, MOST_TRIES};
use super::holding::extended;
use super::placements::Placements;
use super::request::Request;
use super::target::{of_positions, of_quantities, Target};
use super::targets::Targets;
use crate::analyses::closing::Closing;
use crate::model::{row_scales, Model};

/// Largest scaled distance from the guesses that counts as zero.
const MET: f64 = 1e-9;

/// The position nearest to the guesses of quantities. None without such guesses, or if the mechanism does not close.
pub(super) fn close(
    model: &Model,
    request: &Request,
    asked: &Targets,
    internal: &[(usize, f64)],
    closing: &mut Closing<'_>,
) -> Option<Closed> {
    of_quantities(&request.guess).next()?;
    let quantity = |target: &&Target| matches!(target, Target::Quantity(_));
    let guesses = of_positions(&request.guess).filter(quantity);
    let leading = extended(model, of_positions(&request.set).chain(guesses));
    let stop = closing.stop();
    let mut towards = Closing::new(&leading, request.t, stop);
    let holding = closing.model();
    let placed =
        |model| Placements::new(model, asked).take(MOST_TRIES).map(|placement| placement.q);
    let starts = given(model, asked).into_iter().chain(placed(&leading)).chain(placed(holding));
    let mut best: Option<(f64, Closed)> = None;
    for mut q in starts {
        wind(&leading, request.t, &mut q);
        towards.close(&mut q);
        if !q.iter().all(|q| q.is_finite()) {
            continue;
        }
        let Ok(found) = close_from(closing, internal, q, Vec::new()) else { continue };
        let off = distance(&towards.phi(&found.q), holding.layout.n_rows, &row_scales(&leading));
        let nearer = best.as_ref().is_none_or(|(least, _)| off < *least);
        if nearer {
            best = Some((off, found));
        }
        if off <= MET || stop() {
            break;
        }
    }
    best.map(|(_, found)| found)
}

/// The length of the scaled residuals of the guesses, which are the last rows.
fn distance(phi: &[f64], first: usize, scales: &[f64]) -> f64 {
    let scaled = phi.iter().zip(scales).skip(first).map(|(phi, scale)| (phi / scale).powi(2));
    scaled.sum::<f64>().sqrt()
}
