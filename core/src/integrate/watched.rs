//! Functions of the state during a step: their values, and what is known of them over parts of the step.
//!
//! A part is left where the bounds of a function exclude zero. The signs at its ends are compared where the bounds of
//! the slope exclude zero, or where the bounds do not exceed rounding errors. Every other part is halved.

use super::path::{Bounds, StepPath};
use super::step::Step;
use crate::math::{each, Interval, Listed, Real};
use std::collections::HashMap;

/// Bounds count as rounding errors if they are at most this number of times as wide as those at a single time.
const NOISE: f64 = 4.0;
/// Number of divisions after which bounds of distances are compared with rounding errors.
const ROUGH: usize = 8;
/// Largest number of times of which the values of all functions are kept.
const MOST_KEPT: usize = 4_096;

/// A function that may change its sign more often in a step than can be followed: its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooFast(pub usize);

/// Functions of the state whose changes of sign are wanted.
pub trait Watch {
    /// Writes the values of `some` functions at a time and a state to their places. NaN has no sign.
    fn values(&mut self, t: f64, y: &[f64], some: &[usize], out: &mut [f64]);

    /// Bounds of a function and of its time derivative between two times of a step. None if they are not known.
    fn bounds(&mut self, index: usize, path: &StepPath<'_>, span: [f64; 2]) -> Option<Bounds>;

    /// Whether the bounds of a function converge with the square of the length of a part, as those of distances do.
    fn converges(&self, index: usize) -> bool {
        let _ = index;
        false
    }

    /// The values of minima that are wanted in place of the changes of sign of a function with bounds.
    fn minima(&self, index: usize) -> Option<[f64; 2]> {
        let _ = index;
        None
    }

    /// The depth below zero up to which a function that returns counts as positive.
    fn shallow(&self, index: usize) -> f64 {
        let _ = index;
        0.0
    }
}

/// Writes the state at a time of a step.
fn state(step: &Step<'_>, t: f64, y: &mut [f64]) {
    if t == step.t {
        y.copy_from_slice(step.y);
    } else if t == step.t_old {
        y.copy_from_slice(step.y_old);
    } else {
        step.interpolate(t, y);
    }
}

/// What is known of a function over a part of a step.
pub(super) enum Part {
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
fn may_turn([a, m, b]: [f64; 3]) -> bool {
    let line = a + BETWEEN * (b - a);
    let bend = (m - line).abs() / (BETWEEN * (1.0 - BETWEEN));
    bend > a.abs() + b.abs()
}

/// The sign of bounds that exclude zero.
pub(super) fn sign_of(value: Interval) -> Option<f64> {
    match value {
        Interval { low, .. } if low > 0.0 => Some(1.0),
        Interval { high, .. } if high < 0.0 => Some(-1.0),
        _ => None,
    }
}

/// The functions during a step.
pub(super) struct WatchedStep<'a, 'b, 'w> {
    pub path: &'a StepPath<'b>,
    pub step: &'b Step<'b>,
    pub watch: &'w mut dyn Watch,
    /// The functions whose changes of sign are wanted.
    all: Vec<usize>,
    /// Number of parts for functions without bounds.
    parts: usize,
    y: Vec<f64>,
    /// The values of all functions at times that were evaluated, and those of single functions.
    known: HashMap<u64, Vec<f64>>,
    values: Vec<f64>,
}

impl<'a, 'b, 'w> WatchedStep<'a, 'b, 'w> {
    /// Nothing is evaluated. Functions without bounds have at least `parts` parts.
    pub fn new(
        path: &'a StepPath<'b>,
        (count, parts): (usize, usize),
        watch: &'w mut dyn Watch,
    ) -> Self {
        let (step, y, values) = (path.step, path.step.y.to_vec(), vec![f64::NAN; count]);
        let all = (0..count).filter(|index| watch.minima(*index).is_none()).list();
        Self { path, step, watch, all, parts, y, known: HashMap::new(), values }
    }

    /// Evaluates all functions whose changes of sign are wanted at a time.
    pub fn at(&mut self, t: f64) -> &[f64] {
        let Self { step, watch, all, y, known, values, .. } = self;
        if known.len() > MOST_KEPT {
            known.clear();
        }
        known.entry(t.to_bits()).or_insert_with(|| {
            let mut values = values.clone();
            state(step, t, y);
            watch.values(t, y, all, &mut values);
            values
        })
    }

    /// Evaluates some functions at a time. The values of the others are of no use.
    pub fn some(&mut self, t: f64, some: &[usize]) -> &[f64] {
        if let Some(known) = self.known.get(&t.to_bits()) {
            let all = some.iter().all(|index| self.all.binary_search(index).is_ok());
            if all {
                return known;
            }
        }
        state(self.step, t, &mut self.y);
        self.watch.values(t, &self.y, some, &mut self.values);
        &self.values
    }

    /// What is known of a function over a part of the step.
    pub fn part(&mut self, index: usize, [from, to]: [f64; 2], depth: usize) -> Part {
        let Some(bounds) = self.watch.bounds(index, self.path, [from, to]) else {
            return self.sampled(index, [from, to], depth);
        };
        let shallow = Interval::around(self.watch.shallow(index), 0.0);
        if let Some(sign) = sign_of(bounds.value + shallow) {
            return Part::Sign(sign);
        }
        let middle = from + 0.5 * (to - from);
        if middle == from || middle == to {
            return Part::Ends;
        }
        // the mean value form is not better, and rounding errors matter in short parts only
        if self.watch.converges(index) && sign_of(bounds.slope[0]).is_none() && depth < ROUGH {
            return Part::Divided(middle);
        }
        let Some(there) = self.watch.bounds(index, self.path, [middle, middle]) else {
            return Part::Ends;
        };
        let [slope] = bounds.slope;
        let moved = slope * Interval::around(0.0, 0.5 * (to - from).abs());
        let nearer = bounds.value.and(there.value + moved);
        if let Some(sign) = sign_of(nearer + shallow) {
            return Part::Sign(sign);
        }
        if sign_of(slope).is_some() {
            return Part::Ends;
        }
        match nearer.spread() <= NOISE * there.spread() {
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
            let values = each([from, between, to], |t| self.at(t)[index]);
            if !may_turn(values) && values.iter().all(|value| value * values[0] > 0.0) {
                return Part::Sign(values[0].signum());
            }
            if !may_turn(values) {
                return Part::Ends;
            }
        }
        Part::Divided(between)
    }
}
