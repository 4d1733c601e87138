//! Four-bars whose coupler takes two to five poses exactly: pairs of dyads.

use super::conditions::{all_dyads, conditions, ends, Choices, Frame, Refused};
use super::defects::{Linkage, Output};
use super::plane::{abs, turn};
use super::random::chosen;
use kempe::math::{Complex, Field, Random};

/// Pairs of dyads that are judged.
const PAIRS: usize = 20_000;

/// Poses of the coupler, and what is chosen.
#[derive(Clone, Debug)]
pub struct Poses {
    /// The origin of the moving frame at each pose, m.
    pub places: Vec<Complex>,
    /// Its angle, rad.
    pub angles: Vec<f64>,
    /// The ground pivots of crank and rocker, if they are fixed.
    pub pivots: [Option<Complex>; 2],
    /// Number of dyads that are sampled if some of their choices are free.
    pub samples: usize,
    /// Seed of the samples.
    pub seed: u64,
}

/// Four-bars with their errors, m, and whether these are all.
pub type FourBars = (Vec<(Linkage, f64)>, bool);

/// A pin at the first pose and its pivot.
type Bar = (Complex, Complex);

/// Four-bars of pairs of dyads.
pub fn four_bars(task: &Poses) -> Result<FourBars, Refused> {
    distinct(task)?;
    let (free, own) = match task.pivots {
        [Some(_), Some(_)] => (None, true),
        [None, None] => (Some(dyads_of(task, None)?), false),
        _ => (Some(dyads_of(task, None)?), true),
    };
    let mut sides = Vec::new();
    for pivot in task.pivots {
        let side = match (pivot, &free) {
            (None, Some(free)) => free.clone(),
            _ => dyads_of(task, pivot)?,
        };
        sides.push(side);
    }
    let [(first, all), (second, all_too)] = <[_; 2]>::try_from(sides).expect("two sides");
    check(task, &first, &second)?;
    let chosen = pairs(first.len(), own.then_some(second.len()), task.seed);
    let made = chosen.into_iter().map(|(i, j)| linkage(task, first[i], second[j]));
    Ok((made.collect(), all && all_too))
}

/// Refuse a single pose, and two poses that are the same.
fn distinct(task: &Poses) -> Result<(), Refused> {
    let n = task.places.len();
    if n < 2 {
        let message = format!("poses: {n} pose{}; at least two", if n == 1 { "" } else { "s" });
        return Err(Refused::new(message, "add a pose"));
    }
    let frame = Frame::of(&task.places);
    let apart = |j: usize, k: usize| {
        let moved = frame.inward(task.places[k]) - frame.inward(task.places[j]);
        let turned = turn(task.angles[k]) - turn(task.angles[j]);
        moved.magnitude().max(turned.magnitude())
    };
    let mut pairs = (1..n).flat_map(|k| (0..k).map(move |j| (j, k)));
    match pairs.find(|(j, k)| apart(*j, *k) < 1e-9) {
        None => Ok(()),
        Some((j, k)) => {
            let message = format!("poses: poses {} and {} are the same", j + 1, k + 1);
            Err(Refused::new(message, "leave one of them out"))
        }
    }
}

/// The dyads of the poses with two pins, in the plane, and whether these are all.
fn dyads_of(task: &Poses, pivot: Option<Complex>) -> Result<(Vec<Bar>, bool), Refused> {
    let frame = Frame::of(&task.places);
    let rows = conditions(&task.places, &task.angles);
    let seed = task.seed + u64::from(pivot.is_some());
    let choices = Choices::new(task.samples, seed, pivot.map(|at| frame.inward(at)));
    let (found, complete) = all_dyads(&rows, rows.len(), &choices)?;
    let pins = found.iter().filter_map(ends);
    let placed = pins.map(|(w, g)| (frame.outward(w), pivot.unwrap_or(frame.outward(g))));
    Ok((placed.collect(), complete))
}

/// Pairs of places in two lists; in one list if there is no second one. Of more than `PAIRS`, some are chosen.
pub fn pairs(first: usize, second: Option<usize>, seed: u64) -> Vec<(usize, usize)> {
    let all: Vec<(usize, usize)> = match second {
        Some(n) => (0..first).flat_map(|i| (0..n).map(move |j| (i, j))).collect(),
        None => (0..first).flat_map(|i| (i + 1..first).map(move |j| (i, j))).collect(),
    };
    if all.len() <= PAIRS {
        return all;
    }
    let kept = chosen(&mut Random::new(seed), all.len(), PAIRS);
    all.into_iter().zip(kept).filter_map(|(pair, kept)| kept.then_some(pair)).collect()
}

/// The four-bar of two dyads at all poses, and the largest change of its crank and rocker.
fn linkage(task: &Poses, (pin_a, o): Bar, (pin_b, d): Bar) -> (Linkage, f64) {
    let first = (task.places[0], task.angles[0]);
    let moved = |pin: Complex| -> Vec<Complex> {
        let at = task.places.iter().zip(&task.angles);
        at.map(|(place, angle)| *place + (pin - first.0) * turn(angle - first.1)).collect()
    };
    let (a, b) = (moved(pin_a), moved(pin_b));
    let changes = |pins: &[Complex], pivot: Complex| {
        let length = abs(pins[0] - pivot);
        pins.iter().map(|pin| (abs(*pin - pivot) - length).abs()).fold(0.0, f64::max)
    };
    let error = changes(&a, o).max(changes(&b, d));
    (Linkage { o, a, b, output: Output::Rocker(d) }, error)
}

/// Refuse poses that no four-bar takes.
fn check(task: &Poses, first: &[Bar], second: &[Bar]) -> Result<(), Refused> {
    let n = task.places.len();
    for ((name, side), pivot) in ["O", "D"].iter().zip([first, second]).zip(task.pivots) {
        if pivot.is_some() && side.is_empty() {
            let hint = format!("move the pivot {name}, let it be free, or leave out a pose");
            let message = format!("no dyad with the pivot {name} takes the {n} poses");
            return Err(Refused::new(message, hint));
        }
    }
    if task.pivots == [None, None] && first.len() < 2 {
        let count = if first.is_empty() { "no real dyads" } else { "1 real dyad" };
        let message = format!("poses: no four-bar takes all {n}: they have {count}");
        return Err(Refused::new(message, "leave out or move a pose"));
    }
    Ok(())
}
