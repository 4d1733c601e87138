//! Local maxima on the interpolant, and the singular positions near which values have no meaning.
//!
//! A run passes positions at which constraints lose rank. Near such a position, a multiplier is the quotient of two
//! small numbers. It may have a pole there, and small errors of the state, divided by a small number, exceed it. A
//! maximum that a search finds there depends on how close to the position the search comes.

use super::{largest, place_of_largest, Read};
use crate::math::{Listed, Ordered, ShortArray};

/// Local maxima above this fraction of the largest are refined together, up to a number of maxima.
const SHARE: f64 = 0.9;
const TOGETHER: usize = 8;
/// Number of rounds of refinement of a bracket, and number of intervals in each round.
const ROUNDS: usize = 4;
const INTERVALS: usize = 16;
/// Largest number of groups of maxima that are examined.
const GROUPS: usize = 64;
/// Largest excess of a maximum between instants over the value at an instant, as a multiple of the change to the
/// neighbouring instants. Each step of the integrator has several instants, so the excess is an eighth of this change
/// at a smooth maximum and the whole change at a kink. `ERROR` is the error of states, as a fraction of the value.
const STEEP: f64 = 2.0;
const ERROR: f64 = 1e-3;
/// Number of instants on either side of a singular position at which errors of states may hide the value.
pub const NEAR: usize = 8;

/// The largest local maxima of a quantity, except those near singular positions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Maxima {
    /// The largest maxima that were found. Empty if all are near singular positions.
    pub values: Vec<f64>,
    /// Their times, s.
    pub t: Vec<f64>,
    /// The indices of singular positions, including those found during the search.
    pub near: Vec<usize>,
    /// More accurate times of these positions, s.
    pub near_t: Vec<f64>,
}

impl Maxima {
    /// Searches the maxima of a quantity with the values `sampled` at instants `t`.
    ///
    /// `known` are indices and times of singular positions. `resolved` states whether each step has an instant, so
    /// that only errors are steeper than the change between instants.
    pub fn search(
        (t, sampled): (&[f64], &[f64]),
        known: (&[usize], &[f64]),
        resolved: bool,
        read: Read<'_>,
    ) -> Self {
        let (near, near_t) = (known.0.to_vec(), known.1.to_vec());
        let mut found = Self { near, near_t, ..Self::default() };
        let mut left = local_maxima(sampled);
        for _ in 0..GROUPS {
            left.retain(|k| found.is_clear(*k));
            let Some(&best) = left.first().filter(|_| found.values.is_empty()) else { break };
            let least = sampled[best] - (1.0 - SHARE) * sampled[best].abs();
            let group: Vec<usize> =
                left.iter().copied().filter(|k| sampled[*k] >= least).take(TOGETHER).list();
            found.examine(&group, (t, sampled), resolved, read);
            left.retain(|k| !group.contains(k));
        }
        found
    }

    fn is_clear(&self, k: usize) -> bool {
        self.near.iter().all(|near| k.abs_diff(*near) > NEAR)
    }

    /// Refines some maxima, and keeps those that do not belong to a singular position.
    fn examine(
        &mut self,
        group: &[usize],
        (t, sampled): (&[f64], &[f64]),
        resolved: bool,
        read: Read<'_>,
    ) {
        let beside = |k: usize| [k.saturating_sub(1), (k + 1).min(t.len() - 1)];
        let brackets: Vec<[f64; 2]> = group.iter().map(|k| beside(*k).each(|b| t[b])).list();
        let refined = refine(brackets, read);
        let steep = |(k, best): (&usize, &Best)| {
            let here = sampled[*k];
            let change = largest(beside(*k).each(|b| (sampled[b] - here).abs()));
            resolved && best.value - here > STEEP * change + ERROR * here.abs()
        };
        let is_steep: Vec<bool> = group.iter().zip(&refined).map(steep).list();
        for ((k, best), _) in group.iter().zip(&refined).zip(&is_steep).filter(|(_, steep)| **steep)
        {
            self.near.push(*k);
            self.near_t.push(best.t);
        }
        for ((k, best), steep) in group.iter().zip(&refined).zip(is_steep) {
            if !steep && self.is_clear(*k) {
                self.values.push(best.value);
                self.t.push(best.t);
            }
        }
    }
}

/// The largest value in a bracket and its time.
pub(super) struct Best {
    pub value: f64,
    pub t: f64,
}

/// Indices of the local maxima, the largest first.
fn local_maxima(values: &[f64]) -> Vec<usize> {
    let at = |k: Option<usize>| k.and_then(|k| values.get(k)).copied().unwrap_or(f64::NEG_INFINITY);
    let is_maximum =
        |k: &usize| values[*k] >= at(k.checked_sub(1)) && values[*k] >= at(Some(k + 1));
    let mut found: Vec<usize> = (0..values.len()).filter(is_maximum).list();
    found.order_by(|a, b| values[*b].partial_cmp(&values[*a]).unwrap_or(std::cmp::Ordering::Equal));
    found
}

/// The largest value in each bracket and its time; ∞ if the quantity has no value.
///
/// Each bracket shrinks to the intervals next to its largest value.
pub(super) fn refine(mut brackets: Vec<[f64; 2]>, read: Read<'_>) -> Vec<Best> {
    let start = |bracket: &[f64; 2]| Best { value: f64::NEG_INFINITY, t: bracket[0] };
    let mut found: Vec<Best> = brackets.iter().map(start).list();
    for _ in 0..ROUNDS {
        let share = |k: usize| k as f64 / INTERVALS as f64;
        let inside = |[first, last]: &[f64; 2]| {
            let (first, width) = (*first, last - first);
            (0..=INTERVALS).map(move |k| first + share(k) * width)
        };
        let times: Vec<f64> = brackets.iter().flat_map(inside).list();
        let Some(values) = read(&times) else {
            if let [best] = found.as_mut_slice() {
                best.value = f64::INFINITY;
                return found;
            }
            return brackets.iter().flat_map(|one| refine(vec![*one], read)).list();
        };
        let rows = times.chunks_exact(INTERVALS + 1).zip(values.chunks_exact(INTERVALS + 1));
        for ((bracket, best), (times, values)) in brackets.iter_mut().zip(&mut found).zip(rows) {
            let k = place_of_largest(values);
            *best = Best { value: values[k], t: times[k] };
            *bracket = [times[k.saturating_sub(1)], times[(k + 1).min(INTERVALS)]];
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn searched(f: impl Fn(f64) -> f64) -> Maxima {
        let t: Vec<f64> = (0..=40).map(|k| f64::from(k) / 10.0).collect();
        let sampled: Vec<f64> = t.iter().map(|t| f(*t)).collect();
        let mut read = |t: &[f64]| Some(t.iter().map(|t| f(*t)).collect());
        Maxima::search((&t, &sampled), (&[], &[]), true, &mut read)
    }

    #[test]
    fn a_maximum_between_instants_is_found() {
        let found = searched(|t| -(t - 1.2345).powi(2));
        assert!((found.t[0] - 1.2345).abs() < 1e-4 && found.values[0].abs() < 1e-8);
        assert!(found.near.is_empty());
    }

    #[test]
    fn a_pole_is_no_maximum() {
        let found = searched(|t| 1.0 / (t - 2.03).abs() + if t < 1.0 { 5.0 } else { 0.0 });
        assert_eq!(found.near, [20]);
        assert!((found.near_t[0] - 2.03).abs() < 1e-3);
        assert!(found.values[0] < 7.0);
    }
}
