//! Starts of a search: four-bars through some of the points, random ones, and their positions at the other points.

use super::timed::timed;
use crate::defects::{Linkage, Output};
use crate::fit::Posed;
use crate::plane::{abs, closed, conjugate, scaled, turn, unit};
use crate::random::chosen;
use crate::wanted::{Traced, Wanted};
use kempe::math::{Complex, Random};
use std::f64::consts::TAU;

/// Four-bars that pass some of the points at their crank angles, as starts for all of them.
pub(super) fn through(all: &Wanted, chosen: &[usize], counts: [usize; 2], seed: u64) -> Vec<Posed> {
    let part = all.part(chosen);
    let found = timed(&part.places, &part.cranks, part.offset, seed, counts).unwrap_or_default();
    let start = |one: &Traced| {
        let start = part.start_of(one);
        let back = conjugate(start.turned[0]);
        let cranks: Vec<Complex> = all.cranks.iter().map(|given| turn(*given) * back).collect();
        all.spread(&part, &start, &cranks)
    };
    found.iter().map(start).filter(|one| one.lengths.iter().all(|x| x.is_finite())).collect()
}

/// A start in the frame of another task.
pub(super) fn moved(of: &Posed, from: &Wanted, to: &Wanted) -> Posed {
    let cranks: Vec<Complex> = of.at.iter().map(|at| at[0]).collect();
    let mut found = to.spread(from, of, &cranks);
    found.at.clone_from(&of.at);
    found
}

/// Directions of the crank at all positions, between those at some of them.
pub(super) fn between(few: &Posed, chosen: &[usize]) -> Vec<Complex> {
    let mut found = vec![few.at[0][0]];
    for (k, two) in chosen.windows(2).enumerate() {
        let (from, to) = (few.at[k][0], few.at[k + 1][0]);
        let steps = two[1] - two[0];
        let share = |j: usize| unit(from + scaled(to - from, j as f64 / steps as f64));
        found.extend((1..=steps).map(share));
    }
    found
}

/// A random number that is rarely large, nearly with an exponential distribution, by operations that are rounded exactly.
fn rare(random: &mut Random) -> f64 {
    let share = random.uniform();
    (1.0 - share) / (share + 0.2)
}

/// Random angles of a crank that turns one way through the points.
pub(super) fn passing(random: &mut Random, n: usize) -> Vec<f64> {
    let steps: Vec<f64> = (1..n).map(|_| 0.2 + rare(random)).collect();
    let most = TAU * (n - 1) as f64 / n as f64;
    let span = 1.0 + (most - 1.0) * random.uniform();
    let span = if random.uniform() < 0.5 { -span } else { span };
    let whole: f64 = steps.iter().sum();
    let mut angles = vec![0.0];
    steps.iter().for_each(|step| angles.push(angles[angles.len() - 1] + span * step / whole));
    angles
}

/// Some of n places, in order.
pub(super) fn some(random: &mut Random, n: usize, count: usize) -> Vec<usize> {
    chosen(random, n, count)
        .iter()
        .enumerate()
        .filter_map(|(k, taken)| taken.then_some(k))
        .collect()
}

/// A random four-bar: P is at all points, and A and B turn about O and D only nearly.
pub(super) fn scattered(wanted: &Wanted, random: &mut Random) -> Posed {
    let places = &wanted.places;
    let size = wanted.size();
    let mut side = |given: Option<Complex>| {
        let pivot = given.unwrap_or_else(|| {
            let way = Complex::new(random.uniform() - 0.5, random.uniform() - 0.5);
            places[0] + scaled(unit(way), 1.7 * size * rare(random).sqrt())
        });
        let far: Vec<f64> = places.iter().map(|at| abs(*at - pivot)).collect();
        let low = far.iter().fold(f64::INFINITY, |least, far| least.min(*far));
        let high = far.iter().fold(0.0_f64, |most, far| most.max(*far));
        let radius = 0.5 * (high - low) * (1.0 + 0.7 * rare(random))
            + size * (0.02 + 0.28 * random.uniform());
        let ends = ((high - radius).abs(), low + radius);
        let bar = ends.0 + (ends.1 - ends.0) * random.uniform();
        let sign = random.uniform() - 0.5;
        let pin = |at: &Complex| pivot + scaled(closed(*at - pivot, [radius, bar], sign), radius);
        (pivot, places.iter().map(pin).collect())
    };
    let ((o, a), (d, b)) = (side(wanted.pivots[0]), side(wanted.pivots[1]));
    let linkage = Linkage { o, a, b, output: Output::Rocker(d) };
    wanted.start_of(&Traced { linkage, points: places.clone(), frame: 0.0, error: 0.0 })
}
