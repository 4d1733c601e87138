//! Locates the sign changes of several functions of the state within a step, all of them.
//!
//! A function is bounded over parts of the step ([`Watch::bounds`]). A part is left where the bounds exclude zero. The
//! signs at its ends are compared where the bounds of the slope exclude zero, or where the bounds do not exceed
//! rounding errors. Every other part is halved. Bisection and inverse quadratic interpolation locate each sign change
//! (`events`).
//!
//! Functions without bounds, such as those of reactions, are smooth in time while no body turns far. They are sampled
//! so densely that they follow parabolas.

use super::events::{Bracket, Direction};
use super::path::{Bounds, Path};
use super::step::Step;
use crate::math::{Interval, Real};
use std::collections::HashMap;

/// Two sign changes count as one time if they differ by at most this number of floating-point spacings.
const TOGETHER: f64 = 8.0;
/// Multiple of that time for which rounding errors may shift a sign change. A change within it before the first one
/// counts as simultaneous; a change within it after a change that ends the step is kept.
const NEAR: f64 = 8.0;
/// Bounds count as rounding errors if they are at most this number of times as wide as those at a single time.
const NOISE: f64 = 4.0;
/// Largest number of parts of a step for one function.
const MOST_PARTS: usize = 1_000_000;
/// Largest number of times of which the values of all functions are kept.
const MOST_KEPT: usize = 4_096;

/// A change of sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Index of the function.
    pub index: usize,
    /// Time just past the change.
    pub t: f64,
    /// Whether the function increases at `t`.
    pub rising: bool,
}

/// The signs of functions over a step.
#[derive(Clone, Debug, Default)]
pub struct Scan {
    /// The earliest sign changes in the given direction. It contains several changes, in the order of the functions,
    /// if the functions change sign together.
    pub first: Vec<Crossing>,
    /// Indices of the functions that are negative at all times after the beginning.
    pub negative: Vec<usize>,
}

/// A function that may change its sign more often in a step than can be followed: its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooFast(pub usize);

/// Functions of the state whose changes of sign are wanted.
pub trait Watch {
    /// Writes the values of all functions at a time and a state. NaN has no sign.
    fn values(&mut self, t: f64, y: &[f64], out: &mut [f64]);

    /// Bounds of a function and of its time derivative between two times of a step. None if they are not known.
    fn bounds(&mut self, index: usize, path: &Path<'_>, span: [f64; 2]) -> Option<Bounds>;
}

/// Locates the first sign changes of `count` functions to within four floating-point spacings. A change at the very
/// beginning belongs to the step before. A change of function `i` after the time `until(i)` is ignored. Functions
/// without bounds are sampled in at least `parts` parts.
///
/// # Errors
/// [`TooFast`].
pub fn scan(
    path: &Path<'_>,
    (count, parts): (usize, usize),
    watch: &mut dyn Watch,
    direction: Direction,
    until: &dyn Fn(usize) -> Option<f64>,
) -> Result<Scan, TooFast> {
    let mut search = Search::new(path, (count, parts), watch);
    let (mut changes, mut negative) = (Vec::new(), Vec::new());
    for index in 0..count {
        let found = search.changes(index, direction, (1, None))?;
        changes.extend(found.changes);
        if found.negative {
            negative.push(index);
        }
    }
    Ok(Scan { first: search.first(changes, until), negative })
}

/// Returns all sign changes, with a direction for each function. They are sorted by time, and simultaneous changes by
/// function. Changes after the first change of a function that `ends` the step are omitted.
///
/// # Errors
/// [`TooFast`].
pub fn crossings(
    path: &Path<'_>,
    parts: usize,
    directions: &[Direction],
    watch: &mut dyn Watch,
    ends: &dyn Fn(usize) -> bool,
) -> Result<Vec<Crossing>, TooFast> {
    let (step, count) = (path.step, directions.len());
    let mut search = Search::new(path, (count, parts), watch);
    let mut changes: Vec<SignChange> = Vec::new();
    let mut end = None;
    for index in (0..count).filter(|index| ends(*index)) {
        let found = search.changes(index, directions[index], (1, end))?.changes;
        end = found.last().map(|change| change.new.0).or(end);
        changes.extend(found);
    }
    for index in (0..count).filter(|index| !ends(*index)) {
        changes.extend(search.changes(index, directions[index], (usize::MAX, end))?.changes);
    }
    changes.sort_by_key(|change| change.index);
    let around = search.earliest(changes.iter().filter(|change| ends(change.index)));
    let mut all = match &around {
        None => changes.iter().map(|change| search.close(change)).collect(),
        Some(around) => search.up_to(around, &changes),
    };
    sort(step, &mut all);
    all.dedup_by(|b, a| a.index == b.index && (b.t - a.t).abs() <= together(step));
    Ok(all)
}

/// Largest difference of the times of two sign changes that count as simultaneous.
#[inline]
fn together(step: &Step<'_>) -> f64 {
    TOGETHER * f64::EPSILON * step.t.abs().max(step.t_old.abs())
}

/// Sorts by time, and simultaneous changes by function.
#[inline]
fn sort(step: &Step<'_>, crossings: &mut [Crossing]) {
    let sign = (step.t - step.t_old).signum();
    crossings.sort_by(|a, b| (sign * a.t).total_cmp(&(sign * b.t)));
    for group in crossings.chunk_by_mut(|a, b| (b.t - a.t).abs() <= together(step)) {
        group.sort_by_key(|crossing| crossing.index);
    }
}

/// A time and the value of a function at this time.
type Point = (f64, f64);
/// A time and the values of all functions at this time.
type Sample = (f64, Vec<f64>);

/// A change of sign between two times.
#[derive(Clone, Copy, Debug)]
struct SignChange {
    index: usize,
    old: Point,
    new: Point,
    rising: bool,
}

impl SignChange {
    /// Whether a value lies on the new side of zero, so that the function has already changed sign.
    #[inline]
    fn is_past(&self, value: f64) -> bool {
        if self.rising {
            value >= 0.0
        } else {
            value <= 0.0
        }
    }

    #[inline]
    fn at(&self, t: f64) -> Crossing {
        Crossing { index: self.index, t, rising: self.rising }
    }
}

/// The sign changes of a function.
struct Changes {
    changes: Vec<SignChange>,
    /// Whether the function is negative at all times after the beginning.
    negative: bool,
}

/// What is known of a function over a part of a step.
enum Part {
    /// It has this sign throughout.
    Sign(f64),
    /// It changes its sign at most once.
    Ends,
    /// The part is divided at this time.
    Divided(f64),
}

/// Place of a further sample between two samples. The middle is avoided because samples could repeat the period of a
/// function.
const BETWEEN: f64 = 0.45;
/// Largest number of divisions of one part.
const DEEPEST: usize = 10;

/// Whether a function may have further sign changes among three samples. It may if a parabola through the values a
/// and b with the curvature of the samples can have two zeros.
#[inline]
fn may_turn([a, m, b]: [f64; 3]) -> bool {
    let line = a + BETWEEN * (b - a);
    let bend = (m - line).abs() / (BETWEEN * (1.0 - BETWEEN));
    bend > a.abs() + b.abs()
}

/// The sign of bounds that exclude zero.
fn sign_of(value: Interval) -> Option<f64> {
    match value {
        Interval { low, .. } if low > 0.0 => Some(1.0),
        Interval { high, .. } if high < 0.0 => Some(-1.0),
        _ => None,
    }
}

struct Search<'a, 'b, 'w> {
    path: &'a Path<'b>,
    step: &'b Step<'b>,
    watch: &'w mut dyn Watch,
    count: usize,
    /// Number of parts for functions without bounds.
    parts: usize,
    y: Vec<f64>,
    /// The values of all functions at times that were evaluated.
    known: HashMap<u64, Vec<f64>>,
}

impl<'a, 'b, 'w> Search<'a, 'b, 'w> {
    #[inline]
    fn new(path: &'a Path<'b>, (count, parts): (usize, usize), watch: &'w mut dyn Watch) -> Self {
        let step = path.step;
        Self { path, step, watch, count, parts, y: step.y.to_vec(), known: HashMap::new() }
    }

    /// Evaluates all functions at a time.
    fn at(&mut self, t: f64) -> &[f64] {
        let Self { step, watch, count, y, known, .. } = self;
        if known.len() > MOST_KEPT {
            known.clear();
        }
        known.entry(t.to_bits()).or_insert_with(|| {
            if t == step.t {
                y.copy_from_slice(step.y);
            } else if t == step.t_old {
                y.copy_from_slice(step.y_old);
            } else {
                step.interpolate(t, y);
            }
            let mut values = vec![0.0; *count];
            watch.values(t, y, &mut values);
            values
        })
    }

    /// The first `most` sign changes of a function. Those after `end` may be missing.
    fn changes(
        &mut self,
        index: usize,
        direction: Direction,
        (most, end): (usize, Option<f64>),
    ) -> Result<Changes, TooFast> {
        let (t_old, t) = (self.step.t_old, self.step.t);
        let sign = (t - t_old).signum();
        let mut last = (t_old, self.at(t_old)[index]);
        let mut found = Changes { changes: Vec::new(), negative: true };
        // a stack, with the next part on top; each has the number of divisions before it
        let mut ahead = vec![([t_old, t], 0)];
        let mut looked = 0;
        while let Some(([from, to], depth)) = ahead.pop() {
            if found.changes.len() >= most || end.is_some_and(|end| sign * (from - end) > 0.0) {
                break;
            }
            looked += 1;
            if looked > MOST_PARTS {
                return Err(TooFast(index));
            }
            let sign = match self.part(index, [from, to], depth) {
                Part::Divided(between) => {
                    ahead.push(([between, to], depth + 1));
                    ahead.push(([from, between], depth + 1));
                    continue;
                }
                Part::Sign(sign) => Some(sign),
                Part::Ends => None,
            };
            // the state at the end may differ from the interpolant
            let end = (sign.is_none() || to == t).then(|| self.at(to)[index]);
            for value in [sign, end].into_iter().flatten() {
                let new = (to, value);
                found.negative &= value < 0.0;
                if let Some(rising) = direction.counts(last.1, value) {
                    found.negative = false;
                    let (old, new) = (self.point(index, last), self.point(index, new));
                    found.changes.push(SignChange { index, old, new, rising });
                }
                last = new;
            }
        }
        Ok(found)
    }

    /// A point of which the sign is known, with its value.
    fn point(&mut self, index: usize, (t, sign): Point) -> Point {
        let value = self.at(t)[index];
        (t, if value * sign > 0.0 { value } else { sign })
    }

    /// What is known of a function over a part of the step.
    fn part(&mut self, index: usize, [from, to]: [f64; 2], depth: usize) -> Part {
        let Some(bounds) = self.watch.bounds(index, self.path, [from, to]) else {
            return self.sampled(index, [from, to], depth);
        };
        if let Some(sign) = sign_of(bounds.value) {
            return Part::Sign(sign);
        }
        let middle = from + 0.5 * (to - from);
        if middle == from || middle == to {
            return Part::Ends;
        }
        let value = self.at(middle)[index];
        if value.is_nan() {
            return self.sampled(index, [from, to], depth);
        }
        let [slope] = bounds.slope;
        let moved = slope * Interval::around(0.0, 0.5 * (to - from).abs());
        let nearer = bounds.value.and(Interval::new(value, value) + moved);
        if let Some(sign) = sign_of(nearer) {
            return Part::Sign(sign);
        }
        if sign_of(slope).is_some() {
            return Part::Ends;
        }
        let there = self.watch.bounds(index, self.path, [middle, middle]);
        match there.is_some_and(|there| nearer.spread() <= NOISE * there.spread()) {
            true => Part::Ends,
            false => Part::Divided(middle),
        }
    }

    /// Whether a function without bounds follows a parabola.
    fn sampled(&mut self, index: usize, [from, to]: [f64; 2], depth: usize) -> Part {
        let least = self.parts.next_power_of_two().trailing_zeros() as usize;
        let between = from + if depth < least { 0.5 } else { BETWEEN } * (to - from);
        if depth >= least + DEEPEST || between == from || between == to {
            return Part::Ends;
        }
        if depth >= least {
            let values = [from, between, to].map(|t| self.at(t)[index]);
            if !may_turn(values) && values.iter().all(|value| value * values[0] > 0.0) {
                return Part::Sign(values[0].signum());
            }
            if !may_turn(values) {
                return Part::Ends;
            }
        }
        Part::Divided(between)
    }

    /// The time just past a sign change.
    fn close(&mut self, change: &SignChange) -> Crossing {
        let SignChange { index, old, new, .. } = *change;
        if new.1 == 0.0 {
            return change.at(new.0);
        }
        let sign = new.1.signum();
        let bracket = Bracket { old: (old.0, sign * old.1), new: (new.0, sign * new.1) };
        let spacing = f64::EPSILON * old.0.abs().max(new.0.abs());
        change.at(bracket.close(4.0 * spacing, |t| sign * self.at(t)[index]))
    }

    /// Samples just before and just past the earliest change. A change is located only if it may come before the
    /// changes located so far. Only few changes come earlier, unless they are simultaneous up to rounding errors.
    fn earliest<'c>(
        &mut self,
        changes: impl Iterator<Item = &'c SignChange>,
    ) -> Option<[Sample; 2]> {
        let sign = (self.step.t - self.step.t_old).signum();
        let mut around: Option<[Sample; 2]> = None;
        for change in changes {
            if around.as_ref().is_some_and(|[before, _]| !self.has_changed(change, before)) {
                continue;
            }
            let t = self.close(change).t;
            if around.as_ref().is_none_or(|[_, first]| sign * t < sign * first.0) {
                let before = t - sign * NEAR * together(self.step);
                around = Some([before, t].map(|t| self.sample(t)));
            }
        }
        around
    }

    /// The earliest changes. A change of a function after the time `until` of its index is ignored.
    fn first(
        &mut self,
        mut changes: Vec<SignChange>,
        until: &dyn Fn(usize) -> Option<f64>,
    ) -> Vec<Crossing> {
        let mut limit: Option<Sample> = None;
        changes.retain(|change| {
            let Some(t) = until(change.index) else { return true };
            let sample = limit.take().filter(|limit| limit.0 == t);
            let sample = limit.insert(sample.unwrap_or_else(|| self.sample(t)));
            self.has_changed(change, sample)
        });
        let Some([_, first]) = self.earliest(changes.iter()) else { return Vec::new() };
        let together = changes.iter().filter(|change| self.has_changed(change, &first));
        together.map(|change| change.at(first.0)).collect()
    }

    /// The changes up to the earliest one that ends the step, and those shortly after it.
    fn up_to(&mut self, [before, first]: &[Sample; 2], changes: &[SignChange]) -> Vec<Crossing> {
        let sign = (self.step.t - self.step.t_old).signum();
        let after = self.sample(first.0 + sign * NEAR * together(self.step));
        let mut found = Vec::new();
        for change in changes {
            // rounding errors may hide at a later sample a change that the first sample shows
            if !self.has_changed(change, before) && self.has_changed(change, first) {
                found.push(change.at(first.0));
            } else if self.has_changed(change, before) || self.has_changed(change, &after) {
                found.push(self.close(change));
            }
        }
        found
    }

    /// Whether a function has changed sign at a sample.
    #[inline]
    fn has_changed(&self, change: &SignChange, (t, row): &Sample) -> bool {
        let sign = (self.step.t - self.step.t_old).signum();
        let (from, to) = (sign * change.old.0, sign * change.new.0);
        sign * t > from && (sign * t >= to || change.is_past(row[change.index]))
    }

    #[inline]
    fn sample(&mut self, t: f64) -> Sample {
        (t, self.at(t).to_vec())
    }
}
