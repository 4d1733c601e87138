//! The singular positions that a run passes, and the instants that are close enough together to search for maxima but
//! not closer.
//!
//! The regularity s of a position is proportional to the distance from the next singular position. Near such a
//! position, errors e of the state cause errors of about e / s² in multipliers, and the integrator may take very short
//! steps. Values there have no meaning, however smooth they are. Instants nearer to the position than an eighth of its
//! neighbourhood are therefore omitted, so that the instants beside it ([`NEAR`](super::maxima::NEAR)) cover the
//! neighbourhood.

use super::maxima::{refine, Best, NEAR};
use super::Read;
use crate::math::{each, Listed, Ordered};

/// Regularity below which a local minimum is examined.
pub const EXAMINED: f64 = 0.05;
/// Largest regularity of a singular position. Beside one, factors have a ridge, which leaves 1e-5.
const SINGULAR: f64 = 1e-4;
/// Regularity up to which errors of states may hide a value.
const HIDDEN: f64 = 5e-3;
/// Factor on the fall of the regularity between two instants.
const SLACK: f64 = 2.0;
/// Half-width of the omission around a position, as a multiple of its neighbourhood.
const AROUND: f64 = 8.0;
/// Largest number of minima that are examined.
const MOST: usize = 500;

/// Singular positions and instants.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SingularInstants {
    /// The indices of the instants that are kept, ascending.
    pub keep: Vec<usize>,
    /// The index of each singular position among the kept instants.
    pub near: Vec<usize>,
    /// The times of the singular positions, s.
    pub near_t: Vec<f64>,
}

/// A singular position.
struct Position {
    t: f64,
    /// Time up to which values are hidden, on either side, s.
    width: f64,
}

impl SingularInstants {
    /// Searches the singular positions at instants `t` with the given regularity of the position. `read` returns the
    /// regularity at other times.
    pub fn find(t: &[f64], regularity: &[f64], read: Read<'_>) -> Self {
        let positions = positions(t, regularity, read);
        let keep = kept(t, &positions);
        let nearest = |position: &Position| {
            let apart = |k: &usize| (t[keep[*k]] - position.t).abs();
            (0..keep.len()).min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap_or(0)
        };
        let near = positions.iter().map(nearest).list();
        let near_t = positions.iter().map(|position| position.t).list();
        Self { keep, near, near_t }
    }
}

fn positions(t: &[f64], regularity: &[f64], read: Read<'_>) -> Vec<Position> {
    let at = |k: Option<usize>| k.and_then(|k| regularity.get(k)).copied().unwrap_or(f64::INFINITY);
    let is_minimum = |k: &usize| {
        let own = regularity[*k];
        own < EXAMINED && own <= at(k.checked_sub(1)) && own <= at(Some(k + 1))
    };
    // a value that falls at the rate of one neighbour reaches zero before the other neighbour
    let may_vanish = |k: &usize| {
        let (own, first, last) = (regularity[*k], k.saturating_sub(1), (k + 1).min(t.len() - 1));
        let [before, after] = each([first, last], |other| (t[other] - t[*k]).abs());
        let falls = |other: usize, apart: f64| (regularity[other] - own) / apart;
        let most = (falls(first, before) * after).max(falls(last, after) * before);
        own <= SINGULAR || own <= SLACK * most
    };
    let mut minima: Vec<usize> = (0..t.len()).filter(is_minimum).filter(may_vanish).list();
    minima.order_by(|a, b| regularity[*a].total_cmp(&regularity[*b]));
    let mut found: Vec<Position> = Vec::new();
    let mut examined = 0;
    for k in minima {
        let hidden = |position: &Position| (t[k] - position.t).abs() <= position.width;
        if found.iter().any(hidden) || examined == MOST {
            continue;
        }
        examined += 1;
        let bracket = [t[k.saturating_sub(1)], t[(k + 1).min(t.len() - 1)]];
        let mut negative = |t: &[f64]| Some(read(t)?.into_iter().map(|s| -s).list());
        let refined = refine(vec![bracket], &mut negative);
        let Some(Best { value, t: time }) = refined.first() else { continue };
        if -value <= SINGULAR {
            // without a value, the search has no time
            let time = if value.is_finite() { *time } else { t[k] };
            found.push(Position { t: time, width: width(t, regularity, (k, time)) });
        }
    }
    found.order_by(|a, b| a.t.total_cmp(&b.t));
    found
}

/// The distance to the first instants with a regularity above [`HIDDEN`], on either side.
fn width(t: &[f64], regularity: &[f64], (k, time): (usize, f64)) -> f64 {
    let clear = |k: &usize| regularity[*k] >= HIDDEN;
    let sides = [(0..=k).rev().find(clear), (k..t.len()).find(clear)];
    sides.into_iter().flatten().map(|k| (t[k] - time).abs()).fold(0.0, f64::max)
}

/// The instants without those that are too close together around a position.
fn kept(t: &[f64], positions: &[Position]) -> Vec<usize> {
    let mut keep: Vec<usize> = Vec::with_capacity(t.len());
    for (k, &time) in t.iter().enumerate() {
        let around = positions.iter().filter(|one| (time - one.t).abs() < AROUND * one.width);
        let least = around.map(|one| one.width / NEAR as f64).fold(0.0, f64::max);
        // the tolerance leaves equally spaced instants as they are
        let apart = keep.last().map_or(f64::INFINITY, |last| (time - t[*last]).abs());
        if apart >= 0.999 * least {
            keep.push(k);
        }
    }
    keep
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(t: &[f64], s: impl Fn(f64) -> f64) -> SingularInstants {
        let sampled: Vec<f64> = t.iter().map(|t| s(*t)).collect();
        let mut read = |t: &[f64]| Some(t.iter().map(|t| s(*t)).collect());
        SingularInstants::find(t, &sampled, &mut read)
    }

    /// Instants at a distance of 0.01, and many near 2.0301.
    fn instants() -> Vec<f64> {
        let regular = (0..=400).map(|k| f64::from(k) / 100.0);
        let close = (1..2000).map(|k| 2.0301 + f64::from(k - 1000) * 1e-6);
        let mut t: Vec<f64> = regular.chain(close).collect();
        t.sort_by(f64::total_cmp);
        t
    }

    #[test]
    fn positions_are_found_and_instants_beside_them_are_apart() {
        let t = instants();
        let found = found(&t, |t| (t - 2.0301).abs().min(0.3 * (t - 1.005).abs()));
        assert_eq!(found.near_t.len(), 2);
        assert!((found.near_t[0] - 1.005).abs() < 1e-5 && (found.near_t[1] - 2.0301).abs() < 1e-5);
        let place = |k: usize| t[found.keep[found.near[k]]];
        assert!((place(0) - 1.005).abs() < 0.0051 && (place(1) - 2.0301).abs() < 1e-3);
        // the eight instants on either side reach farther than the hidden neighbourhood
        for k in [found.near[1] - 8, found.near[1] + 8] {
            assert!((t[found.keep[k]] - 2.0301).abs() > 5e-3);
        }
        assert!(found.keep.len() > 400 && found.keep.len() < 420);
    }

    #[test]
    fn a_position_that_is_only_approached_is_not_singular() {
        let t = instants();
        let found = found(&t, |t| (t - 2.0301).hypot(1e-3));
        assert!(found.near.is_empty());
        assert_eq!(found.keep.len(), t.len());
    }

    #[test]
    fn a_position_without_a_value_is_singular() {
        let t: Vec<f64> = (0..=40).map(|k| f64::from(k) / 10.0).collect();
        let s: Vec<f64> = t.iter().map(|t| 0.1 * (t - 2.03).abs()).collect();
        let found = SingularInstants::find(&t, &s, &mut |_| None);
        assert_eq!(found.near, [20]);
    }
}
