//! Locates the sign changes of several functions of the state within a step, all of them.
//!
//! A function is bounded over parts of the step (`watched`). Bisection and inverse quadratic interpolation locate each
//! sign change (`events`).
//!
//! Functions without bounds, such as those of reactions, are smooth in time while no body turns far. They are sampled
//! so densely that they follow parabolas.

use super::events::{Bracket, Direction};
use super::path::StepPath;
use super::step::Step;
use super::watched::{sign_of, Part, TooFast, Watch, WatchedStep};
use crate::math::{Listed, Ordered, Real, ShortArray};

/// Two sign changes count as one time if they differ by at most this number of floating-point spacings.
const TOGETHER: f64 = 8.0;
/// Multiple of that time for which rounding errors may shift a sign change. A change within it before the first one
/// counts as simultaneous; a change within it after a change that ends the step is kept.
const NEAR: f64 = 8.0;
/// A part of a function counts as flat if its bounds are at most this fraction of the range of minima apart.
const FLAT: f64 = 0.1;
/// Largest number of parts of a step in which minima within a range are looked for.
const MOST_MINIMA: usize = 4_096;
/// Largest number of parts of a step for one function.
const MOST_PARTS: usize = 1_000_000;

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

/// Locates the first sign changes of `count` functions to within four floating-point spacings. A change at the very
/// beginning belongs to the step before. A change of function `i` after the time `until(i)` is ignored. Functions
/// without bounds are sampled in at least `parts` parts.
///
/// # Errors
/// [`TooFast`].
pub fn scan(
    path: &StepPath<'_>,
    (count, parts): (usize, usize),
    watch: &mut dyn Watch,
    direction: Direction,
    until: &dyn Fn(usize) -> Option<f64>,
) -> Result<Scan, TooFast> {
    let mut search = WatchedStep::new(path, (count, parts), watch);
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
    path: &StepPath<'_>,
    parts: usize,
    directions: &[Direction],
    watch: &mut dyn Watch,
    ends: &dyn Fn(usize) -> bool,
) -> Result<Vec<Crossing>, TooFast> {
    let (step, count) = (path.step, directions.len());
    let mut search = WatchedStep::new(path, (count, parts), watch);
    let mut changes: Vec<SignChange> = Vec::new();
    let mut end = None;
    for index in (0..count).filter(|index| ends(*index)) {
        let found = search.changes(index, directions[index], (1, end))?.changes;
        end = found.last().map(|change| change.new.0).or(end);
        changes.extend(found);
    }
    let mut minima = Vec::new();
    for index in (0..count).filter(|index| !ends(*index)) {
        match search.watch.minima(index) {
            Some(range) => minima.extend(search.minima(index, range)),
            None => {
                changes.extend(search.changes(index, directions[index], (usize::MAX, end))?.changes)
            }
        }
    }
    changes.order_by_key(|change| change.index);
    let sampled = changes.iter().map(|change| change.index).list();
    let ending = changes.iter().filter(|change| ends(change.index));
    let around = search.earliest(ending, &sampled);
    let mut all = match &around {
        None => changes.iter().map(|change| search.close(change)).list(),
        Some(around) => search.up_to(around, &changes),
    };
    let sign = (step.t - step.t_old).signum();
    minima.retain(|found| around.as_ref().is_none_or(|[_, (end, _)]| sign * (end - found.t) > 0.0));
    all.append(&mut minima);
    sort(step, &mut all);
    all.dedup_by(|b, a| a.index == b.index && (b.t - a.t).abs() <= together(step));
    Ok(all)
}

/// Largest difference of the times of two sign changes that count as simultaneous.
fn together(step: &Step<'_>) -> f64 {
    TOGETHER * f64::EPSILON * step.t.abs().max(step.t_old.abs())
}

/// Sorts by time, and simultaneous changes by function.
fn sort(step: &Step<'_>, crossings: &mut [Crossing]) {
    let sign = (step.t - step.t_old).signum();
    crossings.order_by(|a, b| (sign * a.t).total_cmp(&(sign * b.t)));
    for group in crossings.chunk_by_mut(|a, b| (b.t - a.t).abs() <= together(step)) {
        group.order_by_key(|crossing| crossing.index);
    }
}

/// A time and the value of a function at this time.
type Point = (f64, f64);
/// A time and the values of functions at this time.
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
    fn is_past(&self, value: f64) -> bool {
        if self.rising {
            value >= 0.0
        } else {
            value <= 0.0
        }
    }

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

impl WatchedStep<'_, '_, '_> {
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
        // the last time at which a function that may be shallow was positive
        let (shallow, mut firm) = (self.watch.shallow(index), last);
        if shallow > 0.0 {
            firm.1 = firm.1.max(f64::MIN_POSITIVE);
            last.1 += shallow;
        }
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
            let exact = (sign.is_none() || to == t || shallow > 0.0).then(|| match to == t {
                true => self.at(to)[index],
                false => self.some(to, &[index])[index],
            });
            // a function that is negative at the end may not return
            let depth = if to == t { 0.0 } else { shallow };
            for value in [sign, exact.map(|value| value + depth)].into_iter().flatten() {
                let new = (to, value);
                found.negative &= value < 0.0;
                if let Some(rising) = direction.counts(last.1, value) {
                    found.negative = false;
                    let old = if shallow > 0.0 { firm } else { self.point(index, last) };
                    let new = self.point(index, new);
                    found.changes.push(SignChange { index, old, new, rising });
                }
                last = new;
            }
            if let Some(value) = exact.filter(|value| *value > 0.0) {
                firm = (to, value);
            }
        }
        Ok(found)
    }

    /// The minima of a function whose values lie in a range.
    ///
    /// A function that stays within the range has none, and is left undivided after [`MOST_MINIMA`] parts.
    fn minima(&mut self, index: usize, [low, high]: [f64; 2]) -> Vec<Crossing> {
        let mut found = Vec::new();
        let mut falling = false;
        let mut ahead = vec![[self.step.t_old, self.step.t]];
        let mut looked = 0;
        let sign = (self.step.t - self.step.t_old).signum();
        while let Some([from, to]) = ahead.pop() {
            let Some(bounds) = self.watch.bounds(index, self.path, [from, to]) else { break };
            looked += 1;
            if looked > MOST_MINIMA {
                break;
            }
            let (middle, [slope]) = (from + 0.5 * (to - from), bounds.slope);
            if bounds.value.low > high || bounds.value.high < low {
                falling = false;
            } else if sign_of(slope).is_some_and(|slope| sign * slope < 0.0) {
                falling = true;
            } else if sign_of(slope).is_some() {
                if falling && (low..=high).contains(&self.some(from, &[index])[index]) {
                    found.push(Crossing { index, t: from, rising: false });
                }
                falling = false;
            } else if middle != from && middle != to && bounds.value.spread() > FLAT * (high - low)
            {
                ahead.extend([[middle, to], [from, middle]]);
            }
        }
        found
    }

    /// A point of which the sign is known, with its value.
    fn point(&mut self, index: usize, (t, sign): Point) -> Point {
        let value = self.some(t, &[index])[index];
        (t, if value * sign > 0.0 { value } else { sign })
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
        change.at(bracket.close(4.0 * spacing, |t| sign * self.some(t, &[index])[index]))
    }

    /// Samples of the functions `all` just before and just past the earliest change. A change is located only if it may
    /// come before the changes located so far. Only few changes come earlier, unless they are simultaneous up to
    /// rounding errors.
    fn earliest<'c>(
        &mut self,
        changes: impl Iterator<Item = &'c SignChange>,
        all: &[usize],
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
                around = Some([before, t].each(|t| self.sample(t, all)));
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
        let all = changes.iter().map(|change| change.index).list();
        changes.retain(|change| {
            let Some(t) = until(change.index) else { return true };
            let sample = limit.take().filter(|limit| limit.0 == t);
            let sample = limit.insert(sample.unwrap_or_else(|| self.sample(t, &all)));
            self.has_changed(change, sample)
        });
        let Some([_, first]) = self.earliest(changes.iter(), &all) else { return Vec::new() };
        let together = changes.iter().filter(|change| self.has_changed(change, &first));
        together.map(|change| change.at(first.0)).list()
    }

    /// The changes up to the earliest one that ends the step, and those shortly after it.
    fn up_to(&mut self, [before, first]: &[Sample; 2], changes: &[SignChange]) -> Vec<Crossing> {
        let sign = (self.step.t - self.step.t_old).signum();
        let all = changes.iter().map(|change| change.index).list();
        let after = self.sample(first.0 + sign * NEAR * together(self.step), &all);
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
    fn has_changed(&self, change: &SignChange, (t, row): &Sample) -> bool {
        let sign = (self.step.t - self.step.t_old).signum();
        let (from, to) = (sign * change.old.0, sign * change.new.0);
        sign * t > from && (sign * t >= to || change.is_past(row[change.index]))
    }

    /// The values of some functions at a time.
    fn sample(&mut self, t: f64, some: &[usize]) -> Sample {
        (t, self.some(t, some).to_vec())
    }
}
