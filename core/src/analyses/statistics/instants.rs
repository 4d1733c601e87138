//! Instants close enough for smooth curves on the interpolant of a run.

use crate::math::{Listed, Ordered};
/// Smallest and largest number of instants in a step of the integrator.
const LEAST: usize = 4;
const MOST: usize = 32;
const WISHED: usize = 3000;
/// Largest total number of values in the arrays of a motion at these instants, and largest number of instants.
const MOST_NUMBERS: usize = 6_000_000;
const MOST_INSTANTS: usize = 50_000;

/// The boundaries of the integrator's steps and 3 to 31 instants in each step. There are fewer if they would exceed
/// 50 000 in total; with more than 100 000 steps, some boundaries are omitted.
///
/// The instants do not depend on the output times, with one exception: a time with two outputs, before and after a
/// jump, is an instant, and so is the floating-point number before it. `numbers` is the count of numbers in the state
/// at an instant.
///
/// # Panics
/// If there are fewer than two boundaries.
pub fn instants(bounds: &[f64], outputs: &[f64], numbers: usize) -> Vec<f64> {
    let steps = bounds.len() - 1;
    let most = (MOST_NUMBERS / numbers.max(1)).clamp(2, MOST_INSTANTS);
    let mut pieces = WISHED.div_ceil(steps).clamp(LEAST, MOST);
    if pieces * steps > most {
        pieces = (most / steps).max(1);
    }
    let mut found = Vec::with_capacity(pieces * steps + 1);
    for ends in bounds.windows(2) {
        let share = |k: usize| k as f64 / pieces as f64;
        (0..pieces).map(|k| ends[0] + share(k) * (ends[1] - ends[0])).append_to(&mut found);
    }
    found.push(bounds[steps]);
    if found.len() > 2 * most {
        let every = found.len().div_ceil(most);
        found = found.into_iter().step_by(every).list();
    }
    with_jumps(found, outputs)
}

/// Adds the times with two outputs and the floating-point numbers before them.
fn with_jumps(mut instants: Vec<f64>, outputs: &[f64]) -> Vec<f64> {
    let jumps: Vec<f64> =
        outputs.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[1]).list();
    let (Some(first), Some(last)) = (outputs.first(), outputs.last()) else { return instants };
    if jumps.is_empty() {
        return instants;
    }
    let forward = if last >= first { 1.0 } else { -1.0 };
    jumps.iter().map(|t| forward * below(forward * t)).append_to(&mut instants);
    instants.extend(jumps);
    instants.order_by(|a, b| (forward * a).total_cmp(&(forward * b)));
    instants.dedup();
    instants
}

/// The largest floating-point number below a finite number.
pub(super) fn below(x: f64) -> f64 {
    if x == 0.0 {
        return -f64::from_bits(1);
    }
    f64::from_bits(if x > 0.0 { x.to_bits() - 1 } else { x.to_bits() + 1 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_step_has_its_instants() {
        assert_eq!(instants(&[0.0, 1.0, 3.0], &[0.0, 3.0], 10).len(), 2 * MOST + 1);
        let many: Vec<f64> = (0..=2000).map(f64::from).collect();
        let found = instants(&many, &[0.0, 2000.0], 10);
        assert_eq!((found.len(), found[1], found[4]), (LEAST * 2000 + 1, 0.25, 1.0));
    }

    #[test]
    fn a_jump_has_an_instant_before_it() {
        let found = instants(&[0.0, 1.0, 2.0], &[0.0, 0.3, 0.3, 2.0], 10);
        let at = found.iter().position(|t| *t == 0.3).expect("the jump");
        assert!(found[at - 1] < 0.3 && found[at - 1] + 2.0 * f64::EPSILON > 0.3);
        let back = instants(&[2.0, 1.0, 0.0], &[2.0, 0.3, 0.3, 0.0], 10);
        let at = back.iter().position(|t| *t == 0.3).expect("the jump");
        assert!(back[at - 1] > 0.3 && back.windows(2).all(|pair| pair[0] > pair[1]));
    }
}
