//! The assembly nearest to the guesses.
//!
//! A guess is a starting value. The mechanism is closed from the placements that take the guesses as they are. A driver
//! for each guess leads Newton's method to it, or as near as the joints allow, and the mechanism is then closed without
//! these drivers. If the result does not meet the guesses, the placements without them follow. Of all results, the
//! nearest in the guessed quantities is used.

use super::angle_winding::wind;
use super::attempt::{close_from, given, Closed, MOST_TRIES};
use super::holding::extended;
use super::placements::Placements;
use super::report;
use super::request::Request;
use super::target::{of_positions, of_quantities};
use super::targets::Targets;
use crate::analyses::closing::Closing;
use crate::elements::QuantityKind;
use crate::math::Listed;
use crate::model::{listed, row_scales, Model};
use std::f64::consts::TAU;

/// Largest scaled distance from the guesses that counts as zero.
const MET: f64 = 1e-9;
/// Part by which another assembly must be nearer.
const NEARER: f64 = 1e-5;

/// The assembly nearest to the guesses of positions. None without such guesses, or if the mechanism does not close.
/// `unguessed` are the targets without the guesses.
pub(super) fn close(
    model: &Model,
    request: &Request,
    [asked, unguessed]: [&Targets; 2],
    internal: &[(usize, f64)],
    closing: &mut Closing<'_>,
) -> Option<Closed> {
    of_positions(&request.guess).next()?;
    let leading = extended(model, of_positions(&request.set).chain(of_positions(&request.guess)));
    let (holding, stop) = (closing.model(), closing.stop());
    let towards = Closing::new(&leading, request.t, stop);
    let mut search = NearestSearch { closing, towards, internal, best: None };
    let placed = |model, targets| {
        Placements::new(model, targets)
            .take(MOST_TRIES)
            .map(|placed| (placed.q, report::folded(holding, &placed.dyads)))
    };
    let of_points = of_quantities(&request.guess).next().is_some();
    let by_guesses = of_points.then(|| placed(&leading, asked)).into_iter().flatten();
    let given = given(model, asked).map(|q| (q, Vec::new())).into_iter();
    // more guesses than freedoms only tell which assembly is meant
    let led = of_points || leading.layout.n_rows <= leading.layout.n_q;
    for (q, warnings) in given.chain(by_guesses).chain(placed(holding, asked)) {
        if search.ends_with(&q, warnings, led) {
            break;
        }
    }
    let at_guess = search.best.is_some();
    if !search.is_met() {
        for (q, _) in placed(holding, unguessed) {
            let led = !at_guess && search.ends_with(&q, Vec::new(), true);
            if led || search.ends_with(&q, Vec::new(), false) {
                break;
            }
        }
    }
    let NearestSearch { best, .. } = search;
    let (_, mut found) = best?;
    if !at_guess {
        let all = of_positions(&request.guess).map(|target| target.written(model)).list();
        let guesses = listed(&all.iter().map(String::as_str).list());
        let warning = "the mechanism does not close near the guess";
        let nearest = "the nearest assembly of those from other positions is used";
        found.warnings.push(format!("{warning} {guesses}; {nearest}"));
    }
    Some(found)
}

/// The search for the assembly nearest to the guesses.
struct NearestSearch<'c, 'm, 'l> {
    closing: &'c mut Closing<'m>,
    /// The equations with a driver for each guess, which come last.
    towards: Closing<'l>,
    internal: &'c [(usize, f64)],
    /// The nearest assembly with its distance from the guesses.
    best: Option<(f64, Closed)>,
}

impl NearestSearch<'_, '_, '_> {
    /// Closes the mechanism from a position, which drivers of the guesses first lead towards them. Returns whether
    /// the search ends.
    fn ends_with(&mut self, q: &[f64], warnings: Vec<String>, led: bool) -> bool {
        let mut q = q.to_vec();
        if led {
            wind(self.towards.model(), self.towards.time(), &mut q);
            self.towards.close(&mut q);
        }
        if q.iter().all(|q| q.is_finite()) {
            if let Ok(found) = close_from(self.closing, self.internal, q, warnings) {
                let off = self.distance(&found.q);
                let least = self.best.as_ref().map_or(f64::INFINITY, |(least, _)| *least);
                if off < (1.0 - NEARER) * least || self.best.is_none() {
                    self.best = Some((off, found));
                }
            }
        }
        self.is_met() || self.closing.stopped()
    }

    /// Whether the guesses are met.
    fn is_met(&self) -> bool {
        self.best.as_ref().is_some_and(|(off, _)| *off <= MET)
    }

    /// The distance from the guesses: lengths are relative to the size of the mechanism, and whole turns do not count.
    fn distance(&self, q: &[f64]) -> f64 {
        let (model, first) = (self.towards.model(), self.closing.model().layout.n_rows);
        let (phi, scales) = (self.towards.phi(q), row_scales(model));
        let off = |row: usize| {
            let (k, equation) = model.layout.owner(row);
            let phi = match model.constraints[k].equations[equation].kind {
                QuantityKind::Angle => phi[row] - TAU * (phi[row] / TAU).round(),
                _ => phi[row],
            };
            (phi / scales[row]).powi(2)
        };
        (first..phi.len()).map(off).sum::<f64>().sqrt()
    }
}
