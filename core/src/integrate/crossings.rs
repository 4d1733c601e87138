//! Locates the sign changes of several functions of the state within a step, including several changes of a function.
//!
//! The functions are sampled at [`PARTS`] + 1 times of the interpolant. Bisection and inverse quadratic interpolation
//! locate a sign change between two samples (`events`). Where the samples approach zero and turn back, a parabola
//! through three samples shows whether the function reaches zero between them. An even number of changes within
//! 1/[`PARTS`] of a step can be missed; a shorter step finds them.

use super::events::{Bracket, Direction};
use super::step::Step;

/// Number of intervals between the samples of a step.
const PARTS: usize = 12;
/// Two sign changes count as one time if they differ by at most this number of floating-point spacings.
const TOGETHER: f64 = 8.0;
/// Multiple of that time for which rounding errors may shift a sign change. A change within it before the first one
/// counts as simultaneous; a change within it after a change that ends the step is kept.
const NEAR: f64 = 8.0;
/// Largest number of parabolas that search for a zero between samples of equal sign.
const PARABOLAS: usize = 4;

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
    /// Indices of the functions that are negative at all samples after the beginning.
    pub negative: Vec<usize>,
}

/// Evaluates functions at a time and a state and writes the values into the last argument. NaN has no sign.
pub type Functions<'a> = &'a mut dyn FnMut(f64, &[f64], &mut [f64]);

/// Samples `count` functions over a step and locates the first sign changes to within four floating-point spacings. A
/// change at the very beginning belongs to the step before. A change of function `i` after the time `until(i)` is
/// ignored.
pub fn scan(
    step: &Step<'_>,
    count: usize,
    functions: Functions<'_>,
    direction: Direction,
    until: &dyn Fn(usize) -> Option<f64>,
) -> Scan {
    let mut sampled = Sampled::new(step, count, functions);
    let (mut changes, mut negative) = (Vec::new(), Vec::new());
    for (index, points) in sampled.points().into_iter().enumerate() {
        changes.extend(sampled.changes(index, &points, direction, 1));
        if points[1..].iter().all(|(_, value)| *value < 0.0) {
            negative.push(index);
        }
    }
    Scan { first: sampled.first(changes, until), negative }
}

/// Returns all sign changes, with a direction for each function. They are sorted by time, and simultaneous changes by
/// function. Changes after the first change of a function that `ends` the step are omitted. The step is divided into
/// `parts`. A part is divided further where a parabola through three samples reaches zero or the samples do not
/// follow a parabola. This resolves functions that oscillate within a step.
pub fn crossings(
    step: &Step<'_>,
    parts: usize,
    directions: &[Direction],
    functions: Functions<'_>,
    ends: &dyn Fn(usize) -> bool,
) -> Vec<Crossing> {
    let mut sampled = Sampled::new(step, directions.len(), functions);
    let rows = sampled.resolved(parts);
    let mut changes = Vec::new();
    for (index, direction) in directions.iter().enumerate() {
        let points: Vec<Point> = rows.iter().map(|(t, row)| (*t, row[index])).collect();
        changes.extend(sampled.changes(index, &points, *direction, usize::MAX));
    }
    let around = sampled.earliest(changes.iter().filter(|change| ends(change.index)));
    let mut all = match &around {
        None => changes.iter().map(|change| sampled.close(change)).collect(),
        Some(around) => sampled.up_to(around, &changes),
    };
    sort(step, &mut all);
    all.dedup_by(|b, a| a.index == b.index && (b.t - a.t).abs() <= together(step));
    all
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

struct Sampled<'a, 'b> {
    step: &'a Step<'a>,
    functions: Functions<'b>,
    y: Vec<f64>,
    values: Vec<f64>,
}

impl<'a, 'b> Sampled<'a, 'b> {
    #[inline]
    fn new(step: &'a Step<'a>, count: usize, functions: Functions<'b>) -> Self {
        Self { step, functions, y: step.y.to_vec(), values: vec![0.0; count] }
    }

    /// Samples each function.
    #[inline]
    fn points(&mut self) -> Vec<Vec<Point>> {
        let times: Vec<f64> = (0..=PARTS).map(|k| self.time(k as f64 / PARTS as f64)).collect();
        let rows: Vec<Vec<f64>> = times.iter().map(|t| self.at(*t).to_vec()).collect();
        let of = |index: usize| times.iter().zip(&rows).map(move |(t, row)| (*t, row[index]));
        (0..self.values.len()).map(|index| of(index).collect()).collect()
    }

    /// Samples all functions so densely that they are resolved.
    fn resolved(&mut self, parts: usize) -> Vec<Sample> {
        let times: Vec<f64> = (0..=parts).map(|k| self.time(k as f64 / parts as f64)).collect();
        let mut coarse = times.into_iter().map(|t| (t, self.at(t).to_vec())).collect::<Vec<_>>();
        let mut found = vec![coarse.remove(0)];
        // a stack, with the next sample on top; each sample has the number of divisions before it
        let mut ahead: Vec<(Sample, usize)> = coarse.into_iter().rev().map(|s| (s, 0)).collect();
        while let Some((next, depth)) = ahead.pop() {
            let last = found.last().expect("the first sample");
            let t = last.0 + BETWEEN * (next.0 - last.0);
            if depth == DEEPEST || t == last.0 || t == next.0 {
                found.push(next);
                continue;
            }
            let between = (t, self.at(t).to_vec());
            let last = found.last().expect("the first sample");
            if (0..between.1.len()).any(|k| may_turn([last, &between, &next].map(|s| s.1[k]))) {
                ahead.push((next, depth + 1));
                ahead.push((between, depth + 1));
            } else {
                found.extend([between, next]);
            }
        }
        found
    }

    #[inline]
    fn time(&self, part: f64) -> f64 {
        match part {
            1.0 => self.step.t,
            part => self.step.t_old + part * (self.step.t - self.step.t_old),
        }
    }

    /// Evaluates all functions at a time.
    fn at(&mut self, t: f64) -> &[f64] {
        if t == self.step.t {
            self.y.copy_from_slice(self.step.y);
        } else if t == self.step.t_old {
            self.y.copy_from_slice(self.step.y_old);
        } else {
            self.step.interpolate(t, &mut self.y);
        }
        (self.functions)(t, &self.y, &mut self.values);
        &self.values
    }

    /// The first `most` sign changes of a function with the given samples.
    fn changes(
        &mut self,
        index: usize,
        points: &[Point],
        direction: Direction,
        most: usize,
    ) -> Vec<SignChange> {
        let between = |old: Point, new: Point| {
            direction.counts(old.1, new.1).map(|rising| SignChange { index, old, new, rising })
        };
        let mut found = Vec::new();
        for k in 1..points.len() {
            if found.len() >= most {
                break;
            }
            if let Some(change) = between(points[k - 1], points[k]) {
                found.push(change);
                continue;
            }
            // the samples approach zero and turn back
            let Some(next) = points.get(k + 1) else { continue };
            if let Some([before, beyond, after]) =
                self.turn(index, [points[k - 1], points[k], *next])
            {
                found.extend(between(before, beyond));
                found.extend(between(beyond, after));
            }
        }
        found.truncate(most);
        found
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

    /// Searches between three samples of equal sign for a point on the other side of zero. Returns the point with its
    /// two neighbours.
    fn turn(&mut self, index: usize, mut points: [Point; 3]) -> Option<[Point; 3]> {
        let sign = points[1].1.signum();
        for _ in 0..PARABOLAS {
            let [a, b, c] = points.map(|(_, value)| sign * value);
            if !(b > 0.0 && b <= a && b <= c && (b < a || b < c)) {
                return None;
            }
            let t = vertex(points)?;
            let latest = (t, self.at(t)[index]);
            if sign * latest.1 <= 0.0 {
                let earlier = (t - points[1].0) * (points[2].0 - points[0].0) < 0.0;
                return Some(match earlier {
                    true => [points[0], latest, points[1]],
                    false => [points[1], latest, points[2]],
                });
            }
            points = around([points[0], points[1], points[2]], latest, sign);
        }
        None
    }
}

/// The time at which the parabola through three points has its extremum, if its value there is near zero.
fn vertex([a, b, c]: [Point; 3]) -> Option<f64> {
    let (left, right) = ((b.1 - a.1) / (b.0 - a.0), (c.1 - b.1) / (c.0 - b.0));
    let bend = (right - left) / (c.0 - a.0);
    let slope = left + bend * (b.0 - a.0); // at b
    let by = -0.5 * slope / bend;
    let value = b.1 + 0.5 * slope * by;
    let near = value * b.1 < 0.5 * b.1 * b.1;
    (near && by != 0.0 && by.is_finite()).then_some(b.0 + by)
}

/// The three points around the smallest absolute value, after one more evaluation.
fn around([a, b, c]: [Point; 3], latest: Point, sign: f64) -> [Point; 3] {
    let earlier = (latest.0 - b.0) * (c.0 - a.0) < 0.0;
    match (sign * latest.1 < sign * b.1, earlier) {
        (true, true) => [a, latest, b],
        (true, false) => [b, latest, c],
        (false, true) => [latest, b, c],
        (false, false) => [a, b, latest],
    }
}
